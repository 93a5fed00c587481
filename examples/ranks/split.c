#include "split.h"

#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *split_zeros(int64_t count, size_t size) {
  void *memory = calloc((size_t)(count > 0 ? count : 1), size);
  if (memory) return memory;
  fprintf(stderr, "out of memory\n");
  MPI_Abort(MPI_COMM_WORLD, 5);
  return NULL;
}

/* MPI waits at full speed; here a rank that waits leaves its core to another. */
static void wait_for(int count, MPI_Request *request) {
  MPI_Status status;
  for (int k = 0, done = 0; k < count; k += done) {
    MPI_Test(&request[k], &done, &status);
    if (!done) sched_yield();
  }
}

void split_reduce(MPI_Comm all, const void *own, void *result, int count, MPI_Datatype type, MPI_Op op) {
  MPI_Request request;
  MPI_Iallreduce(own, result, count, type, op, all, &request);
  wait_for(1, &request);
}

int32_t split_agree(MPI_Comm all, int32_t status) {
  int rank, ranks;
  MPI_Comm_rank(all, &rank);
  MPI_Comm_size(all, &ranks);
  int32_t own[3] = {-status, status, status == HOOKE_OK ? -ranks : -rank}, most[3];
  split_reduce(all, own, most, 3, MPI_INT32_T, MPI_MAX);
  if (status != HOOKE_OK && most[2] == -rank)
    fprintf(stderr, "rank %d: %s: %s\n", rank, hooke_status_name(status),
            status == HOOKE_DIVERGED
                ? "numbers that are not finite, or more energy than the run may have; take a smaller step"
                : hooke_last_error());
  return most[0] > 0 ? -most[0] : most[1];
}

/* ---- who owns what ---- */

int split_depth(const hooke_integrator *integrator) {
  static const struct {
    const char *method;
    int depth;
  } known[] = {{"forward-euler", 1}, {"symplectic-euler", 1}, {"verlet", 2}, {"heun", 2}, {"rk4", 4}};
  const char *method = hooke_options_text(hooke_integrator_options(integrator), "method");
  const char *damping = hooke_options_text(hooke_integrator_options(integrator), "verlet_damping");
  const int solves = strcmp(method, "verlet") == 0 && strcmp(damping, "implicit") == 0;
  for (size_t k = 0; k < sizeof known / sizeof *known && !solves; k++)
    if (strcmp(known[k].method, method) == 0) return known[k].depth;
  return 0;
}

static const double *sort_q;
static int sort_axis;

static int by_axis(const void *a, const void *b) {
  const int64_t i = *(const int64_t *)a, j = *(const int64_t *)b;
  const double d = sort_q[3 * i + sort_axis] - sort_q[3 * j + sort_axis];
  return d < 0 ? -1 : d > 0 ? 1 : (i > j) - (i < j);
}

/* Across the longest side of the box, into parts as large as the ranks that they are for. */
static void bisect(int64_t *some, int64_t count, int first, int ranks, int32_t *owner) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int64_t k = 0; k < count && ranks == 1; k++)
    owner[some[k]] = first;
  if (ranks == 1) return;
  for (int64_t k = 0; k < 3 * count; k++) {
    const double x = sort_q[3 * some[k / 3] + k % 3];
    low[k % 3] = fmin(low[k % 3], x);
    high[k % 3] = fmax(high[k % 3], x);
  }
  sort_axis = 0;
  for (int a = 1; a < 3; a++)
    if (high[a] - low[a] > high[sort_axis] - low[sort_axis]) sort_axis = a;
  qsort(some, (size_t)count, sizeof *some, by_axis);
  const int left = ranks / 2;
  const int64_t cut = count * left / ranks;
  bisect(some, cut, first, left, owner);
  bisect(some + cut, count - cut, first + left, ranks - left, owner);
}

static void choose_owners(const double *q, unsigned seed, struct split *s) {
  int64_t *every = split_zeros(s->n, sizeof *every);
  s->owner = split_zeros(s->n, sizeof *s->owner);
  for (int64_t p = 0; p < s->n; p++)
    every[p] = p;
  sort_q = q;
  if (seed == 0) bisect(every, s->n, 0, s->ranks, s->owner);
  for (int64_t p = 0; p < s->n && seed > 0; p++) {
    seed = 1664525u * seed + 1013904223u;
    s->owner[p] = (int32_t)((seed >> 16) % (unsigned)s->ranks);
  }
  free(every);
}

/* ---- the particles of this rank ---- */

/* Particles of members that have one within `layer` members of an owned one come to be in the next layer. */
static int32_t grow(const hooke_system *whole, const char *force, int layer, uint8_t *of) {
  const int64_t each = hooke_member_particles(force), count = hooke_system_count(whole, force);
  if (each < 2 || count < 1) return HOOKE_OK;
  int64_t *particle = split_zeros(each * count, sizeof *particle);
  const int32_t status = hooke_system_members(whole, force, particle, NULL, NULL, NULL);
  for (const int64_t *member = particle; member < particle + each * count; member += each) {
    int near = 0;
    for (int64_t e = 0; e < each; e++)
      near |= of[member[e]] <= layer;
    for (int64_t e = 0; e < each && near; e++)
      if (of[member[e]] > layer) of[member[e]] = (uint8_t)(layer + 1);
  }
  free(particle);
  return status;
}

/* `local`: the number of each particle in the system of this rank, -1 if it is not in it. */
static int32_t choose_particles(const hooke_system *whole, int depth, struct split *s, int64_t *local) {
  int32_t status = HOOKE_OK;
  uint8_t *layer = split_zeros(s->n, 1);
  for (int64_t p = 0; p < s->n; p++)
    layer[p] = s->owner[p] == s->rank ? 0 : UINT8_MAX;
  for (int d = 0; d < depth; d++)
    for (int64_t f = 0; hooke_system_force_name(whole, f) && status == HOOKE_OK; f++)
      status = grow(whole, hooke_system_force_name(whole, f), d, layer);
  s->global = split_zeros(s->n, sizeof *s->global);
  s->mine = split_zeros(s->n, sizeof *s->mine);
  for (int64_t p = 0; p < s->n; p++) {
    local[p] = layer[p] <= depth ? s->count : -1;
    if (layer[p] == 0) s->mine[s->own++] = s->count;
    if (layer[p] <= depth) s->global[s->count++] = p;
  }
  free(layer);
  return status;
}

/* ---- what ranks send each other ---- */

static int *list_of(const struct split *s) {
  return split_zeros(s->ranks + 1, sizeof(int));
}

/* Asks the owner of every ghost for it; from then on only ranks that trade with each other know each other.
 */
static void plan_trade(struct split *s, const int64_t *local) {
  int *at = list_of(s), near = 0;
  s->in = list_of(s), s->in_at = list_of(s), s->out = list_of(s), s->out_at = list_of(s);
  for (int64_t k = 0; k < s->count; k++)
    s->in[s->owner[s->global[k]]] += s->owner[s->global[k]] != s->rank;
  MPI_Alltoall(s->in, 1, MPI_INT, s->out, 1, MPI_INT, s->all);
  for (int r = 0; r < s->ranks; r++) {
    s->in_at[r + 1] = s->in_at[r] + s->in[r], s->out_at[r + 1] = s->out_at[r] + s->out[r];
    at[r] = s->in_at[r];
  }
  s->gets = s->in_at[s->ranks], s->gives = s->out_at[s->ranks];
  s->get = split_zeros(s->gets, sizeof *s->get), s->give = split_zeros(s->gives, sizeof *s->give);
  for (int64_t k = 0; k < s->count; k++)
    if (s->owner[s->global[k]] != s->rank) s->get[at[s->owner[s->global[k]]]++] = s->global[k];
  MPI_Alltoallv(s->get, s->in, s->in_at, MPI_INT64_T, s->give, s->out, s->out_at, MPI_INT64_T, s->all);
  for (int64_t k = 0; k < s->gets; k++)
    s->get[k] = local[s->get[k]];
  for (int64_t k = 0; k < s->gives; k++)
    s->give[k] = local[s->give[k]];
  for (int r = 0; r < s->ranks; r++) {
    if (s->in[r] == 0 && s->out[r] == 0) continue;
    s->in[near] = s->in[r], s->in_at[near] = s->in_at[r];
    s->out[near] = s->out[r], s->out_at[near] = s->out_at[r];
    at[near++] = r;
  }
  MPI_Dist_graph_create_adjacent(s->all, near, at, s->in, near, at, s->out, MPI_INFO_NULL, 0, &s->near);
  s->given = split_zeros(6 * s->gives, sizeof(double)), s->got = split_zeros(6 * s->gets, sizeof(double));
  free(at);
}

void split_trade(struct split *s) {
  MPI_Request request[2];
  for (int a = 0; a < 2; a++)
    MPI_Ineighbor_alltoallv(s->given + a * 3 * s->gives, s->out, s->out_at, s->row, s->got + a * 3 * s->gets,
                            s->in, s->in_at, s->row, s->near, &request[a]);
  wait_for(2, request);
}

int split_is_finite(int64_t count, const double *value) {
  double sum = 0.0; /* 0 times what is not finite is NaN */
  for (int64_t k = 0; k < count; k++)
    sum += 0.0 * value[k];
  return sum == 0.0;
}

static int32_t exchange(struct split *s, hooke_integrator *integrator, int32_t status) {
  if (status == HOOKE_OK)
    status = hooke_integrator_get(integrator, s->gives, s->give, s->given, s->given + 3 * s->gives);
  for (int64_t k = 0; k < 6 * s->gives && status != HOOKE_OK; k++)
    s->given[k] = NAN;
  split_trade(s);
  if (status != HOOKE_OK) return status;
  if (!split_is_finite(6 * s->gets, s->got)) return HOOKE_DIVERGED;
  return hooke_integrator_put(integrator, s->gets, s->get, s->got, s->got + 3 * s->gets);
}

int32_t split_step(struct split *s, hooke_integrator *integrator, int32_t status) {
  const double begun = MPI_Wtime();
  if (status == HOOKE_OK) status = hooke_integrator_advance(integrator, 1);
  const double stepped = MPI_Wtime();
  if (s->ranks > 1) status = exchange(s, integrator, status);
  s->stepping += stepped - begun;
  s->trading += MPI_Wtime() - stepped;
  return status;
}

static void plan_collection(struct split *s) {
  s->owned = list_of(s), s->owned_at = list_of(s);
  s->order = split_zeros(s->n, sizeof *s->order);
  for (int64_t p = 0; p < s->n; p++)
    s->owned[s->owner[p]]++;
  for (int r = 0; r < s->ranks; r++)
    s->owned_at[r + 1] = s->owned_at[r] + s->owned[r];
  int *at = list_of(s);
  memcpy(at, s->owned_at, (size_t)s->ranks * sizeof *at);
  for (int64_t p = 0; p < s->n; p++)
    s->order[at[s->owner[p]]++] = p;
  free(at);
  if (s->rank == 0) s->rows = split_zeros(3 * s->n, sizeof(double));
}

void split_collect(struct split *s, const double *own, double *rows) {
  MPI_Request request;
  MPI_Igatherv(own, (int)s->own, s->row, s->rows, s->owned, s->owned_at, s->row, 0, s->all, &request);
  wait_for(1, &request);
  for (int64_t k = 0; k < s->n && s->rank == 0; k++)
    memcpy(rows + 3 * s->order[k], s->rows + 3 * k, 3 * sizeof(double));
}

int32_t split_make(MPI_Comm all, const hooke_system *whole, const double *q, int depth, unsigned seed,
                   struct split *s) {
  *s = (struct split){.all = all, .n = hooke_system_particle_count(whole)};
  MPI_Comm_rank(all, &s->rank);
  MPI_Comm_size(all, &s->ranks);
  MPI_Type_contiguous(3, MPI_DOUBLE, &s->row);
  MPI_Type_commit(&s->row);
  int64_t *local = split_zeros(s->n, sizeof *local);
  choose_owners(q, seed, s);
  int32_t status = choose_particles(whole, depth, s, local);
  if (status == HOOKE_OK) status = hooke_system_take(whole, s->count, s->global, &s->system);
  plan_trade(s, local);
  plan_collection(s);
  free(local);
  return status;
}

void split_release(struct split *s) {
  hooke_system_destroy(s->system);
  MPI_Comm_free(&s->near);
  MPI_Type_free(&s->row);
  void *arrays[] = {s->owner,  s->global, s->mine,  s->give,  s->get,      s->given, s->got, s->out,
                    s->out_at, s->in,     s->in_at, s->owned, s->owned_at, s->order, s->rows};
  for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
    free(arrays[k]);
}
