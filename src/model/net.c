/* Makes the net of a system at commit. */
#include "model/net.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* Runs of constant offset are faster than a net if there are more of them than this; and in a system of few springs there
 * is nothing to gain. */
static const double MOST_IN_RUNS = 0.7;
enum { LEAST_SPRINGS = 64, MOST_DEGREE = UINT16_MAX };

/* A window and ring of more bytes than this, and than this a particle, would hold most of the system, for want of any order. */
static const double MOST_BYTES = 4194304.0, MOST_BYTES_A_PARTICLE = 64.0;

/* Their own numbering is kept unless the springs of another one reach less than this share as far. */
static const double WORTH_NUMBERING = 0.6;

/* What is needed on the way. */
struct maker {
  struct hooke_net *net;
  struct hooke_springs *springs;
  int32_t *head, *tail;   /* of all springs */
  int32_t *order, *place; /* of particles */
  int32_t *class_of;      /* of runs */
  int32_t *at;            /* place of each spring */
  int64_t *next;          /* counters */
};

static int32_t maker_create(struct hooke_springs *springs, struct hooke_net *net, struct maker *maker) {
  const int64_t n = net->particles, m = springs->count;
  *maker = (struct maker){.net = net,
                          .springs = springs,
                          .head = hooke_new(2 * m, sizeof(int32_t)),
                          .order = hooke_new(2 * n, sizeof(int32_t)),
                          .class_of = hooke_new(springs->run_count, sizeof(int32_t)),
                          .at = hooke_new(m, sizeof(int32_t)),
                          .next = hooke_new(n + 1 + net->tiles * HOOKE_NET_CLASSES, sizeof(int64_t))};
  if (!maker->head || !maker->order || !maker->class_of || !maker->at || !maker->next) return HOOKE_NO_MEMORY;
  maker->tail = maker->head + m;
  maker->place = maker->order + n;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hooke_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hooke_spring spring = hooke_run_spring(run, k);
      maker->head[run->first + k] = (int32_t)spring.head;
      maker->tail[run->first + k] = (int32_t)spring.tail;
    }
  }
  return HOOKE_OK;
}

static void maker_release(struct maker *maker) {
  hooke_free(maker->head);
  hooke_free(maker->order);
  hooke_free(maker->class_of);
  hooke_free(maker->at);
  hooke_free(maker->next);
}

static int32_t lower_end(const struct maker *maker, int64_t spring) {
  const int32_t i = maker->place[maker->head[spring]], j = maker->place[maker->tail[spring]];
  return i < j ? i : j;
}

static int32_t upper_end(const struct maker *maker, int64_t spring) {
  const int32_t i = maker->place[maker->head[spring]], j = maker->place[maker->tail[spring]];
  return i < j ? j : i;
}

/* ---- the working numbering ---- */

static double mean_reach(const struct maker *maker) {
  double sum = 0.0;
  for (int64_t s = 0; s < maker->springs->count; s++)
    sum += (double)(upper_end(maker, s) - lower_end(maker, s));
  return sum;
}

static void number_as_given(const struct maker *maker) {
  for (int64_t p = 0; p < maker->net->particles; p++)
    maker->order[p] = maker->place[p] = (int32_t)p;
}

static int32_t number(struct maker *maker, const double *inverse_mass) {
  struct hooke_net *net = maker->net;
  number_as_given(maker);
  const double given = mean_reach(maker);
  const int32_t status = hooke_net_number(net->particles, maker->springs->count, maker->head, maker->tail,
                                          maker->order, maker->place);
  if (status != HOOKE_OK) return status;
  if (mean_reach(maker) >= WORTH_NUMBERING * given) {
    number_as_given(maker);
    return HOOKE_OK;
  }
  net->order = hooke_new(net->particles, sizeof(int32_t));
  net->inverse_mass = hooke_new(net->particles, sizeof(double));
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

/* By lower end first, then, which keeps that order, by tile and class. `by_end` is `springs` long. */
static void sort(struct maker *maker, int32_t *by_end) {
  struct hooke_net *net = maker->net;
  const struct hooke_springs *springs = maker->springs;
  int64_t *next = maker->next, *bin = maker->next + net->particles + 1;
  for (int64_t s = 0; s < springs->count; s++)
    next[lower_end(maker, s)]++;
  sum_up(next, net->particles);
  for (int64_t s = 0; s < springs->count; s++)
    by_end[next[lower_end(maker, s)]++] = (int32_t)s;

  int32_t *class_of_spring = maker->at; /* until places are known */
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++)
      class_of_spring[springs->run[r].first + k] = maker->class_of[r];
  }
  for (int64_t s = 0; s < springs->count; s++)
    net->batch[lower_end(maker, s) / HOOKE_TILE * net->classes + class_of_spring[s]]++;
  for (int64_t k = 0; k < net->tiles * net->classes; k++)
    bin[k] = net->batch[k];
  sum_up(bin, net->tiles * net->classes);
  for (int64_t k = 0; k < springs->count; k++) {
    const int32_t s = by_end[k];
    maker->at[s] = (int32_t)bin[lower_end(maker, s) / HOOKE_TILE * net->classes + class_of_spring[s]]++;
  }
  for (int64_t t = 0; t < net->tiles; t++)
    net->tile[t].end = bin[t * net->classes + net->classes - 1];
}

/* How far tiles look ahead and back, and what a window and a ring have to hold for that. */
static void measure(struct maker *maker) {
  struct hooke_net *net = maker->net;
  for (int64_t t = 0; t < net->tiles; t++) {
    const int64_t end = (t + 1) * HOOKE_TILE;
    net->tile[t].reach = (int32_t)(end < net->particles ? end : net->particles);
    net->tile[t].before = t > 0 ? net->tile[t - 1].end : 0;
  }
  for (int64_t s = 0; s < net->springs; s++) {
    const int32_t upper = upper_end(maker, s);
    struct hooke_net_tile *from = &net->tile[lower_end(maker, s) / HOOKE_TILE];
    struct hooke_net_tile *to = &net->tile[upper / HOOKE_TILE];
    if (from->reach <= upper) from->reach = upper + 1;
    if (to->before > maker->at[s]) to->before = maker->at[s];
  }
  for (int64_t t = 1; t < net->tiles; t++) {
    if (net->tile[t].reach < net->tile[t - 1].reach) net->tile[t].reach = net->tile[t - 1].reach;
  }
  for (int64_t t = 0; t < net->tiles; t++) {
    const int64_t rows = net->tile[t].reach - t * HOOKE_TILE, pairs = net->tile[t].end - net->tile[t].before;
    if (rows > net->rows) net->rows = rows;
    if (pairs > net->pairs) net->pairs = pairs;
  }
  net->rows = (net->rows + HOOKE_TILE - 1) / HOOKE_TILE * HOOKE_TILE; /* no tile is cut */
  net->wide = net->rows > UINT16_MAX || 2 * net->pairs > UINT16_MAX;
}

static void put(void *index, int64_t at, int64_t value, int32_t wide) {
  if (wide)
    ((uint32_t *)index)[at] = (uint32_t)value;
  else
    ((uint16_t *)index)[at] = (uint16_t)value;
}

static int count_degrees(struct maker *maker) {
  struct hooke_net *net = maker->net;
  for (int64_t s = 0; s < net->springs; s++) {
    uint16_t *i = &net->degree[lower_end(maker, s)], *j = &net->degree[upper_end(maker, s)];
    if (*i == MOST_DEGREE || *j == MOST_DEGREE) return 0;
    ++*i;
    ++*j;
  }
  return 1;
}

static int32_t fill_ends(struct maker *maker) {
  struct hooke_net *net = maker->net;
  const int64_t m = net->springs, width = net->wide ? sizeof(uint32_t) : sizeof(uint16_t);
  net->lower = hooke_new(m, 1);
  net->upper = hooke_new(m, (size_t)width);
  net->half = hooke_new(2 * m, (size_t)width);
  if (!net->lower || !net->upper || !net->half) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < net->particles; p++)
    maker->next[p] = net->degree[p];
  sum_up(maker->next, net->particles);
  for (int64_t s = 0; s < m; s++) {
    const int32_t i = lower_end(maker, s), j = upper_end(maker, s), at = maker->at[s];
    net->lower[at] = (uint8_t)(i % HOOKE_TILE);
    put(net->upper, at, j % net->rows, net->wide);
    put(net->half, maker->next[i]++, 2 * (at % net->pairs) + 1, net->wide);
    put(net->half, maker->next[j]++, 2 * (at % net->pairs), net->wide);
  }
  return HOOKE_OK;
}

/* ---- material ---- */

static int32_t new_material(struct hooke_net *net, int32_t mixed) {
  net->rest_length = hooke_new(net->springs, sizeof(double));
  net->place = hooke_new(net->springs, sizeof(int32_t));
  if (mixed) net->kappa = hooke_new(net->springs, sizeof(double));
  if (mixed) net->gamma = hooke_new(net->springs, sizeof(double));
  const int there = net->rest_length && net->place && (!mixed || (net->kappa && net->gamma));
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void point_to_net(const struct hooke_net *net, const struct hooke_net_class *class,
                         struct hooke_run *run) {
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
  struct hooke_net *net = maker->net;
  struct hooke_springs *springs = maker->springs;
  const int32_t material = net->class[0].shape & HOOKE_NET_MIXED;
  if (material == 0) return HOOKE_OK;
  const int32_t status = new_material(net, material == HOOKE_NET_MIXED);
  if (status != HOOKE_OK) return status;
  memcpy(net->place, maker->at, (size_t)net->springs * sizeof *net->place);
  for (int64_t r = 0; r < springs->run_count; r++) {
    struct hooke_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hooke_material own = hooke_run_material(run, k);
      const int32_t at = maker->at[run->first + k];
      net->rest_length[at] = own.rest_length;
      if (net->kappa) net->kappa[at] = own.kappa;
      if (net->gamma) net->gamma[at] = own.gamma;
    }
    if (run->shape & HOOKE_RUN_MIXED) point_to_net(net, &net->class[maker->class_of[r]], run);
  }
  hooke_springs_drop_material(springs);
  return HOOKE_OK;
}

/* ---- all of it ---- */

static int may_pay(const struct hooke_springs *springs) {
  return springs->count >= LEAST_SPRINGS &&
         (double)(springs->count - springs->indexed_count) <= MOST_IN_RUNS * (double)springs->count;
}

static int32_t make(struct maker *maker, const double *inverse_mass) {
  struct hooke_net *net = maker->net;
  int32_t status = number(maker, inverse_mass);
  if (status != HOOKE_OK) return status;
  hooke_net_classify(maker->springs, net, maker->class_of);
  net->tile = hooke_new(net->tiles, sizeof *net->tile);
  net->batch = hooke_new(net->tiles * net->classes, sizeof *net->batch);
  net->degree = hooke_new(net->particles, sizeof *net->degree);
  int32_t *by_end = hooke_new(net->springs, sizeof *by_end);
  if (net->tile && net->batch && net->degree && by_end)
    sort(maker, by_end);
  else
    status = HOOKE_NO_MEMORY;
  hooke_free(by_end);
  if (status != HOOKE_OK) return status;
  measure(maker);
  const double bytes = (double)(net->rows + net->pairs) * (HOOKE_NET_ROW * sizeof(double));
  if (!count_degrees(maker) || bytes > fmax(MOST_BYTES, MOST_BYTES_A_PARTICLE * (double)net->particles)) {
    hooke_net_release(net);
    return HOOKE_OK;
  }
  status = fill_ends(maker);
  return status == HOOKE_OK ? move_material(maker) : status;
}

int32_t hooke_net_create(struct hooke_springs *springs, int64_t particle_count, const double *inverse_mass,
                         struct hooke_net *net) {
  *net = (struct hooke_net){0};
  if (!may_pay(springs)) return HOOKE_OK;
  net->particles = particle_count;
  net->springs = springs->count;
  net->tiles = (particle_count + HOOKE_TILE - 1) / HOOKE_TILE;
  struct maker maker;
  int32_t status = maker_create(springs, net, &maker);
  if (status == HOOKE_OK) status = make(&maker, inverse_mass);
  maker_release(&maker);
  if (status != HOOKE_OK) hooke_net_release(net);
  return status;
}

void hooke_net_release(struct hooke_net *net) {
  void *const block[] = {net->tile,  net->order, net->inverse_mass, net->batch, net->lower,  net->upper,
                         net->kappa, net->gamma, net->rest_length,  net->place, net->degree, net->half};
  for (size_t k = 0; k < sizeof block / sizeof block[0]; k++)
    hooke_free(block[k]);
  memset(net, 0, sizeof *net);
}

int64_t hooke_net_memory(const struct hooke_net *net) {
  const int64_t width = net->wide ? sizeof(uint32_t) : sizeof(uint16_t), number = sizeof(double);
  int64_t a_spring = 1 + 3 * width, a_particle = (int64_t)sizeof(uint16_t);
  if (net->rest_length) a_spring += number + (int64_t)sizeof(int32_t);
  if (net->kappa) a_spring += 2 * number;
  if (net->order) a_particle += number + (int64_t)sizeof(int32_t);
  const int64_t a_tile = (int64_t)sizeof *net->tile + net->classes * (int64_t)sizeof *net->batch;
  return a_spring * net->springs + a_particle * net->particles + a_tile * net->tiles;
}
