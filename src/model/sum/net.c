/* Makes the net of a system at commit. */
#include "model/sum/net.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* Runs of constant offset are faster than a net if there are more of them than this; and in a system of few
 * springs there is nothing to gain. */
static const double MOST_IN_RUNS = 0.7;
enum { LEAST_SPRINGS = 64, MOST_DEGREE = UINT16_MAX };

/* A window and ring of more bytes than this, and than this a particle, would hold most of the system, for
 * want of any order. */
static const double MOST_BYTES = 4194304.0, MOST_BYTES_A_PARTICLE = 64.0;

/* Their own numbering is kept unless the springs of another one reach less than this share as far. */
static const double WORTH_NUMBERING = 0.6;

/* What is needed on the way. */
struct maker {
  struct hk_net *net;
  struct hk_springs *springs;
  int32_t *lower, *upper; /* ends of all springs, by number in `place` */
  int32_t *order, *place; /* of particles */
  int32_t *class_of;      /* of runs */
  int32_t *at;            /* place of each spring */
  int64_t *next;          /* counters */
};

static int32_t maker_create(struct hk_springs *springs, struct hk_net *net, struct maker *maker) {
  const int64_t n = net->particles, m = springs->count, bins = net->tiles * HOOKE_NET_CLASSES;
  *maker = (struct maker){.net = net,
                          .springs = springs,
                          .lower = hk_new(2 * m, sizeof(int32_t)),
                          .order = hk_new(2 * n, sizeof(int32_t)),
                          .class_of = hk_new(springs->run_count, sizeof(int32_t)),
                          .at = hk_new(m, sizeof(int32_t)),
                          .next = hk_new(n > bins ? n : bins, sizeof(int64_t))};
  if (!maker->lower || !maker->order || !maker->class_of || !maker->at || !maker->next)
    return HOOKE_NO_MEMORY;
  maker->upper = maker->lower + m;
  maker->place = maker->order + n;
  return HOOKE_OK;
}

static void maker_release(struct maker *maker) {
  hk_free(maker->lower);
  hk_free(maker->order);
  hk_free(maker->class_of);
  hk_free(maker->at);
  hk_free(maker->next);
}

/* Springs are in no order, and what they lead to comes late unless it is asked for so many springs early. */
enum { EARLY = 16 };

static int64_t ahead(int64_t s, int64_t count) {
  return s + EARLY < count ? s + EARLY : s;
}

/* ---- the working numbering ---- */

static void number_as_given(const struct maker *maker) {
  for (int64_t p = 0; p < maker->net->particles; p++)
    maker->order[p] = maker->place[p] = (int32_t)p;
}

static void number_ends(const struct maker *maker) {
  const struct hk_springs *springs = maker->springs;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      const int32_t i = maker->place[spring.head], j = maker->place[spring.tail];
      maker->lower[run->first + k] = i < j ? i : j;
      maker->upper[run->first + k] = i < j ? j : i;
    }
  }
}

static double sum_of_reaches(const struct maker *maker) {
  double sum = 0.0;
  for (int64_t s = 0; s < maker->springs->count; s++)
    sum += (double)(maker->upper[s] - maker->lower[s]);
  return sum;
}

static int32_t number(struct maker *maker, const double *inverse_mass) {
  struct hk_net *net = maker->net;
  number_as_given(maker);
  number_ends(maker);
  const double given = sum_of_reaches(maker);
  const int32_t status = hk_net_number(net->particles, maker->springs->count, maker->lower, maker->upper,
                                       maker->order, maker->place);
  if (status != HOOKE_OK) return status;
  number_ends(maker);
  if (sum_of_reaches(maker) >= WORTH_NUMBERING * given) {
    number_as_given(maker);
    number_ends(maker);
    return HOOKE_OK;
  }
  net->order = hk_new(net->particles, sizeof(int32_t));
  net->inverse_mass = hk_new(net->particles, sizeof(double));
  if (net->order == NULL || net->inverse_mass == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < net->particles; p++) {
    net->order[p] = maker->order[p];
    net->inverse_mass[p] = inverse_mass[maker->order[p]];
  }
  return HOOKE_OK;
}

/* ---- springs by tile, class and lower end ---- */

static void sum_up(int64_t *count, int64_t size) {
  int64_t sum = 0;
  for (int64_t k = 0; k < size; k++) {
    const int64_t own = count[k];
    count[k] = sum;
    sum += own;
  }
}

/* Springs of one tile and class, `sorted` until now by number alone, get their places by lower end. */
static void sort_bin(struct maker *maker, const int32_t *sorted, int64_t from, int64_t count) {
  int64_t next[HOOKE_TILE] = {0};
  for (int64_t k = 0; k < count; k++)
    next[maker->lower[sorted[k]] % HOOKE_TILE]++;
  sum_up(next, HOOKE_TILE);
  for (int64_t k = 0; k < count; k++)
    maker->at[sorted[k]] = (int32_t)(from + next[maker->lower[sorted[k]] % HOOKE_TILE]++);
}

/* By tile and class, then by lower end. `sorted` is `springs` long. */
static void sort(struct maker *maker, int32_t *sorted) {
  struct hk_net *net = maker->net;
  const struct hk_springs *springs = maker->springs;
  const int64_t bins = net->tiles * net->classes;
  int64_t *next = maker->next;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t s = springs->run[r].first; s < springs->run[r].first + springs->run[r].count; s++)
      net->batch[maker->lower[s] / HOOKE_TILE * net->classes + maker->class_of[r]]++;
  }
  for (int64_t k = 0; k < bins; k++)
    next[k] = net->batch[k];
  sum_up(next, bins);
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t s = springs->run[r].first; s < springs->run[r].first + springs->run[r].count; s++)
      sorted[next[maker->lower[s] / HOOKE_TILE * net->classes + maker->class_of[r]]++] = (int32_t)s;
  }
  for (int64_t k = 0; k < bins; k++) {
    const int64_t from = next[k] - net->batch[k];
    sort_bin(maker, sorted + from, from, net->batch[k]);
  }
  for (int64_t t = 0; t < net->tiles; t++)
    net->tile[t].end = next[t * net->classes + net->classes - 1];
}

/* How far tiles look ahead and back, and what a window and a ring have to hold for that. */
static void measure(struct maker *maker) {
  struct hk_net *net = maker->net;
  for (int64_t t = 0; t < net->tiles; t++) {
    const int64_t end = (t + 1) * HOOKE_TILE;
    net->tile[t].reach = (int32_t)(end < net->particles ? end : net->particles);
    net->tile[t].before = t > 0 ? net->tile[t - 1].end : 0;
  }
  for (int64_t s = 0; s < net->springs; s++) {
    const int32_t upper = maker->upper[s];
    struct hk_net_tile *from = &net->tile[maker->lower[s] / HOOKE_TILE];
    struct hk_net_tile *to = &net->tile[upper / HOOKE_TILE];
    if (from->reach <= upper) from->reach = upper + 1;
    if (to->before > maker->at[s]) to->before = maker->at[s];
  }
  for (int64_t t = 1; t < net->tiles; t++) {
    if (net->tile[t].reach < net->tile[t - 1].reach) net->tile[t].reach = net->tile[t - 1].reach;
  }
  for (int64_t t = 0; t < net->tiles; t++) {
    const int64_t rows = net->tile[t].reach - t * HOOKE_TILE, ring = net->tile[t].end - net->tile[t].before,
                  list = net->tile[t].end - (t > 0 ? net->tile[t - 1].end : 0);
    if (rows > net->rows) net->rows = rows;
    if (ring > net->ring) net->ring = ring;
    if (list > net->list) net->list = list;
  }
  net->rows = (net->rows + HOOKE_TILE - 1) / HOOKE_TILE * HOOKE_TILE; /* no tile is cut */
  net->wide = net->rows > UINT16_MAX || net->list + net->ring > UINT16_MAX;
}

static void put(void *index, int64_t at, int64_t value, int32_t wide) {
  if (wide)
    ((uint32_t *)index)[at] = (uint32_t)value;
  else
    ((uint16_t *)index)[at] = (uint16_t)value;
}

int64_t hk_net_numbers(const struct hk_net *net) {
  return HOOKE_NET_ROW * net->rows + HOOKE_NET_FORCE * (net->list + net->ring);
}

static int count_degrees(struct maker *maker) {
  struct hk_net *net = maker->net;
  for (int64_t s = 0; s < net->springs; s++) {
    uint16_t *i = &net->degree[maker->lower[s]], *j = &net->degree[maker->upper[s]];
    if (*i == MOST_DEGREE || *j == MOST_DEGREE) return 0;
    ++*i;
    ++*j;
  }
  return 1;
}

static void ask_for_places(const struct maker *maker, int64_t s) {
  const struct hk_net *net = maker->net;
  const int64_t width = net->wide ? sizeof(uint32_t) : sizeof(uint16_t), at = maker->at[s];
  __builtin_prefetch(net->lower + at, 1);
  __builtin_prefetch((char *)net->upper + at * width, 1);
  __builtin_prefetch(maker->next + maker->lower[s], 1);
  __builtin_prefetch(maker->next + maker->upper[s], 1);
}

static int32_t fill_ends(struct maker *maker) {
  struct hk_net *net = maker->net;
  const int64_t m = net->springs, width = net->wide ? sizeof(uint32_t) : sizeof(uint16_t);
  net->lower = hk_new(m, 1);
  net->upper = hk_new(m, (size_t)width);
  net->force = hk_new(2 * m, (size_t)width);
  if (!net->lower || !net->upper || !net->force) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < net->particles; p++)
    maker->next[p] = net->degree[p];
  sum_up(maker->next, net->particles);
  for (int64_t s = 0; s < m; s++) {
    const int32_t i = maker->lower[s], j = maker->upper[s], at = maker->at[s];
    ask_for_places(maker, ahead(s, m));
    const int64_t tile = i / HOOKE_TILE, first = tile > 0 ? net->tile[tile - 1].end : 0;
    net->lower[at] = (uint8_t)(i % HOOKE_TILE);
    put(net->upper, at, j % net->rows, net->wide);
    put(net->force, maker->next[i]++, at - first, net->wide);
    put(net->force, maker->next[j]++, net->list + at % net->ring, net->wide);
  }
  return HOOKE_OK;
}

/* ---- material ---- */

static int32_t new_material(struct hk_net *net, int32_t mixed) {
  net->rest_length = hk_new(net->springs, sizeof(double));
  net->place = hk_new(net->springs, sizeof(int32_t));
  if (mixed) net->kappa = hk_new(net->springs, sizeof(double));
  if (mixed) net->gamma = hk_new(net->springs, sizeof(double));
  const int there = net->rest_length && net->place && (!mixed || (net->kappa && net->gamma));
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void point_to_net(const struct hk_net *net, const struct hk_net_class *class, struct hk_run *run) {
  run->place = net->place + run->first;
  run->kappas = net->kappa;
  run->gammas = net->gamma;
  run->rest_lengths = net->rest_length;
  run->kappa = class->kappa;
  run->gamma = class->gamma;
  run->strain = (class->shape & HOOKE_NET_MIXED) == HOOKE_NET_STRAIN;
}

/* Materials go to their places in the net, and runs look them up there. */
static int32_t move_material(struct maker *maker) {
  struct hk_net *net = maker->net;
  struct hk_springs *springs = maker->springs;
  const int32_t material = net->class[0].shape & HOOKE_NET_MIXED;
  if (material == 0) return HOOKE_OK;
  const int32_t status = new_material(net, material == HOOKE_NET_MIXED);
  if (status != HOOKE_OK) return status;
  memcpy(net->place, maker->at, (size_t)net->springs * sizeof *net->place);
  for (int64_t r = 0; r < springs->run_count; r++) {
    struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_material own = hk_run_material(run, k);
      const int32_t at = maker->at[run->first + k];
      net->rest_length[at] = own.rest_length;
      if (net->kappa) net->kappa[at] = own.kappa;
      if (net->gamma) net->gamma[at] = own.gamma;
    }
    if (run->shape & HOOKE_RUN_MIXED) point_to_net(net, &net->class[maker->class_of[r]], run);
  }
  hk_springs_drop_material(springs);
  return HOOKE_OK;
}

/* ---- all of it ---- */

static int may_pay(const struct hk_springs *springs) {
  return springs->count >= LEAST_SPRINGS &&
         (double)(springs->count - springs->indexed_count) <= MOST_IN_RUNS * (double)springs->count;
}

static int32_t make(struct maker *maker, const double *inverse_mass) {
  struct hk_net *net = maker->net;
  int32_t status = number(maker, inverse_mass);
  if (status != HOOKE_OK) return status;
  hk_net_classify(maker->springs, net, maker->class_of);
  net->tile = hk_new(net->tiles, sizeof *net->tile);
  net->batch = hk_new(net->tiles * net->classes, sizeof *net->batch);
  net->degree = hk_new(net->particles, sizeof *net->degree);
  int32_t *sorted = hk_new(net->springs, sizeof *sorted);
  if (net->tile && net->batch && net->degree && sorted)
    sort(maker, sorted);
  else
    status = HOOKE_NO_MEMORY;
  hk_free(sorted);
  if (status != HOOKE_OK) return status;
  measure(maker);
  const double bytes = (double)(hk_net_numbers(net) * (int64_t)sizeof(double));
  if (!count_degrees(maker) || bytes > fmax(MOST_BYTES, MOST_BYTES_A_PARTICLE * (double)net->particles)) {
    hk_net_release(net);
    return HOOKE_OK;
  }
  status = fill_ends(maker);
  return status == HOOKE_OK ? move_material(maker) : status;
}

int32_t hk_net_create(struct hk_springs *springs, int64_t particle_count, const double *inverse_mass,
                      struct hk_net *net) {
  *net = (struct hk_net){0};
  if (!may_pay(springs)) return HOOKE_OK;
  net->particles = particle_count;
  net->springs = springs->count;
  net->tiles = (particle_count + HOOKE_TILE - 1) / HOOKE_TILE;
  struct maker maker;
  int32_t status = maker_create(springs, net, &maker);
  if (status == HOOKE_OK) status = make(&maker, inverse_mass);
  maker_release(&maker);
  if (status != HOOKE_OK) hk_net_release(net);
  return status;
}

void hk_net_release(struct hk_net *net) {
  void *const block[] = {net->tile,  net->order, net->inverse_mass, net->batch, net->lower,  net->upper,
                         net->kappa, net->gamma, net->rest_length,  net->place, net->degree, net->force};
  for (size_t k = 0; k < sizeof block / sizeof block[0]; k++)
    hk_free(block[k]);
  memset(net, 0, sizeof *net);
}

int64_t hk_net_spring_memory(const struct hk_net *net) {
  const int64_t width = net->wide ? sizeof(uint32_t) : sizeof(uint16_t), number = sizeof(double);
  int64_t a_spring = 1 + 3 * width;
  if (net->rest_length) a_spring += number + (int64_t)sizeof(int32_t);
  if (net->kappa) a_spring += 2 * number;
  return a_spring * net->springs;
}

int64_t hk_net_memory(const struct hk_net *net) {
  int64_t a_particle = (int64_t)sizeof(uint16_t);
  if (net->order) a_particle += (int64_t)(sizeof(double) + sizeof(int32_t));
  const int64_t a_tile = (int64_t)sizeof *net->tile + net->classes * (int64_t)sizeof *net->batch;
  return hk_net_spring_memory(net) + a_particle * net->particles + a_tile * net->tiles;
}
