/* Creates the tiled batch of a system at commit. */
#include "model/sum/tiled.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Above this length runs of constant offset are faster than a tiled batch, and so are very few springs. In a
 * small system springs and particles keep their order: all of it is near. */
static const double MOST_IN_RUNS = 0.7;
enum { LEAST_SPRINGS = 10, LEAST_STORED = 64, MOST_DEGREE = UINT16_MAX };

/* A window and ring of more bytes than this, and than this a particle, would hold most of the system, for
 * lack of locality. */
static const double MOST_BYTES = 4194304.0, MOST_BYTES_A_PARTICLE = 64.0;

/* The caller's numbering is kept unless springs reach less than this fraction as far in another one. */
static const double WORTH_NUMBERING = 0.6;

/* Working data. */
struct maker {
  struct hk_tiled *tiled;
  struct hk_springs *springs;
  int32_t *lower, *upper; /* ends of all springs, by number in `slot` */
  int32_t *order, *slot;  /* of particles */
  int32_t *kind_of;       /* of runs */
  int32_t *at;            /* index of each spring */
  int64_t *next;          /* counters */
};

static int32_t maker_create(struct hk_springs *springs, struct hk_tiled *tiled, struct maker *maker) {
  const int64_t n = tiled->particles, m = springs->count, bins = tiled->tiles * HOOKE_TILED_KINDS;
  *maker = (struct maker){.tiled = tiled,
                          .springs = springs,
                          .lower = hk_new(2 * m, sizeof(int32_t)),
                          .order = hk_new(2 * n, sizeof(int32_t)),
                          .kind_of = hk_new(springs->run_count, sizeof(int32_t)),
                          .at = hk_new(m, sizeof(int32_t)),
                          .next = hk_new(n > bins ? n : bins, sizeof(int64_t))};
  if (!maker->lower || !maker->order || !maker->kind_of || !maker->at || !maker->next) return HOOKE_NO_MEMORY;
  maker->upper = maker->lower + m;
  maker->slot = maker->order + n;
  return HOOKE_OK;
}

static void maker_release(struct maker *maker) {
  hk_free(maker->lower);
  hk_free(maker->order);
  hk_free(maker->kind_of);
  hk_free(maker->at);
  hk_free(maker->next);
}

/* Springs are in no order, so their data are prefetched this many springs ahead. */
enum { EARLY = 16 };

static int64_t ahead(int64_t s, int64_t count) {
  return s + EARLY < count ? s + EARLY : s;
}

/* ---- the working numbering ---- */

static void number_as_given(const struct maker *maker) {
  for (int64_t p = 0; p < maker->tiled->particles; p++)
    maker->order[p] = maker->slot[p] = (int32_t)p;
}

static void number_ends(const struct maker *maker) {
  const struct hk_springs *springs = maker->springs;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      const int32_t i = maker->slot[spring.head], j = maker->slot[spring.tail];
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
  struct hk_tiled *tiled = maker->tiled;
  number_as_given(maker);
  number_ends(maker);
  if (!tiled->stored) return HOOKE_OK;
  const double given = sum_of_reaches(maker);
  const int32_t status = hk_tiled_number(tiled->particles, maker->springs->count, maker->lower, maker->upper,
                                         maker->order, maker->slot);
  if (status != HOOKE_OK) return status;
  number_ends(maker);
  if (sum_of_reaches(maker) >= WORTH_NUMBERING * given) {
    number_as_given(maker);
    number_ends(maker);
    return HOOKE_OK;
  }
  tiled->order = hk_new(tiled->particles, sizeof(int32_t));
  tiled->inverse_mass = hk_new(tiled->particles + HOOKE_STRIDED_UNIT, sizeof(double)); /* whole vectors */
  if (tiled->order == NULL || tiled->inverse_mass == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < tiled->particles; p++) {
    tiled->order[p] = maker->order[p];
    tiled->inverse_mass[p] = inverse_mass[maker->order[p]];
  }
  return HOOKE_OK;
}

/* ---- springs by tile, kind and lower end ---- */

static void sum_up(int64_t *count, int64_t size) {
  int64_t sum = 0;
  for (int64_t k = 0; k < size; k++) {
    const int64_t own = count[k];
    count[k] = sum;
    sum += own;
  }
}

/* Springs of one tile and kind, so far sorted by number, are sorted by lower end. */
static void sort_bin(struct maker *maker, const int32_t *sorted, int64_t from, int64_t count) {
  int64_t next[HOOKE_TILE] = {0};
  for (int64_t k = 0; k < count; k++)
    next[maker->lower[sorted[k]] % HOOKE_TILE]++;
  sum_up(next, HOOKE_TILE);
  for (int64_t k = 0; k < count; k++)
    maker->at[sorted[k]] = (int32_t)(from + next[maker->lower[sorted[k]] % HOOKE_TILE]++);
}

/* By tile and kind, then by lower end. `sorted` is `springs` long. */
static void sort(struct maker *maker, int32_t *sorted) {
  struct hk_tiled *tiled = maker->tiled;
  const struct hk_springs *springs = maker->springs;
  const int64_t bins = tiled->tiles * tiled->kinds;
  int64_t *next = maker->next;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t s = springs->run[r].first; s < springs->run[r].first + springs->run[r].count; s++)
      tiled->batch[maker->lower[s] / HOOKE_TILE * tiled->kinds + maker->kind_of[r]]++;
  }
  for (int64_t k = 0; k < bins; k++)
    next[k] = tiled->batch[k];
  sum_up(next, bins);
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t s = springs->run[r].first; s < springs->run[r].first + springs->run[r].count; s++)
      sorted[next[maker->lower[s] / HOOKE_TILE * tiled->kinds + maker->kind_of[r]]++] = (int32_t)s;
  }
  for (int64_t k = 0; k < bins; k++) {
    const int64_t from = next[k] - tiled->batch[k];
    sort_bin(maker, sorted + from, from, tiled->batch[k]);
  }
  for (int64_t t = 0; t < tiled->tiles; t++)
    tiled->tile[t].end = next[t * tiled->kinds + tiled->kinds - 1];
}

/* Distances that tiles look ahead and back, and the sizes of window and ring for them. */
static void measure(struct maker *maker) {
  struct hk_tiled *tiled = maker->tiled;
  for (int64_t t = 0; t < tiled->tiles; t++) {
    const int64_t end = (t + 1) * HOOKE_TILE;
    tiled->tile[t].reach = (int32_t)(end < tiled->particles ? end : tiled->particles);
    tiled->tile[t].before = t > 0 ? tiled->tile[t - 1].end : 0;
  }
  for (int64_t s = 0; s < tiled->springs; s++) {
    const int32_t upper = maker->upper[s];
    struct hk_tiled_tile *from = &tiled->tile[maker->lower[s] / HOOKE_TILE];
    struct hk_tiled_tile *to = &tiled->tile[upper / HOOKE_TILE];
    if (from->reach <= upper) from->reach = upper + 1;
    if (to->before > maker->at[s]) to->before = maker->at[s];
  }
  for (int64_t t = 1; t < tiled->tiles; t++) {
    if (tiled->tile[t].reach < tiled->tile[t - 1].reach) tiled->tile[t].reach = tiled->tile[t - 1].reach;
  }
  for (int64_t t = 0; t < tiled->tiles; t++) {
    const int64_t rows = tiled->tile[t].reach - t * HOOKE_TILE,
                  ring = tiled->tile[t].end - tiled->tile[t].before,
                  list = tiled->tile[t].end - (t > 0 ? tiled->tile[t - 1].end : 0);
    if (rows > tiled->rows) tiled->rows = rows;
    if (ring > tiled->ring) tiled->ring = ring;
    if (list > tiled->list) tiled->list = list;
  }
  tiled->rows = (tiled->rows + HOOKE_TILE - 1) / HOOKE_TILE * HOOKE_TILE; /* no tile is cut */
  tiled->wide = tiled->rows > UINT16_MAX || tiled->list + tiled->ring > UINT16_MAX;
}

static void put(void *index, int64_t at, int64_t value, int32_t wide) {
  if (wide)
    ((uint32_t *)index)[at] = (uint32_t)value;
  else
    ((uint16_t *)index)[at] = (uint16_t)value;
}

int64_t hk_tiled_numbers(const struct hk_tiled *tiled) {
  return HOOKE_TILED_ROW * tiled->rows + HOOKE_TILED_FORCE * (tiled->list + tiled->ring);
}

static int count_degrees(struct maker *maker) {
  struct hk_tiled *tiled = maker->tiled;
  for (int64_t s = 0; s < tiled->springs; s++) {
    uint16_t *i = &tiled->degree[maker->lower[s]], *j = &tiled->degree[maker->upper[s]];
    if (*i == MOST_DEGREE || *j == MOST_DEGREE) return 0;
    ++*i;
    ++*j;
  }
  return 1;
}

static void ask_for_places(const struct maker *maker, int64_t s) {
  const struct hk_tiled *tiled = maker->tiled;
  const int64_t width = tiled->wide ? sizeof(uint32_t) : sizeof(uint16_t), at = maker->at[s];
  __builtin_prefetch(tiled->lower + at, 1);
  __builtin_prefetch((char *)tiled->upper + at * width, 1);
  __builtin_prefetch(maker->next + maker->lower[s], 1);
  __builtin_prefetch(maker->next + maker->upper[s], 1);
}

static int32_t fill_ends(struct maker *maker) {
  struct hk_tiled *tiled = maker->tiled;
  const int64_t m = tiled->springs, width = tiled->wide ? sizeof(uint32_t) : sizeof(uint16_t);
  tiled->lower = hk_new(m, 1);
  tiled->upper = hk_new(m, (size_t)width);
  tiled->force = hk_new(2 * m, (size_t)width);
  if (!tiled->lower || !tiled->upper || !tiled->force) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < tiled->particles; p++)
    maker->next[p] = tiled->degree[p];
  sum_up(maker->next, tiled->particles);
  for (int64_t s = 0; s < m; s++) {
    const int32_t i = maker->lower[s], j = maker->upper[s], at = maker->at[s];
    ask_for_places(maker, ahead(s, m));
    const int64_t tile = i / HOOKE_TILE, first = tile > 0 ? tiled->tile[tile - 1].end : 0;
    tiled->lower[at] = (uint8_t)(i % HOOKE_TILE);
    put(tiled->upper, at, j % tiled->rows, tiled->wide);
    put(tiled->force, maker->next[i]++, at - first, tiled->wide);
    put(tiled->force, maker->next[j]++, tiled->list + at % tiled->ring, tiled->wide);
  }
  return HOOKE_OK;
}

/* ---- material ---- */

static int32_t new_material(struct hk_tiled *tiled, int32_t mixed) {
  tiled->rest_length = hk_new(tiled->springs, sizeof(double));
  tiled->slot = hk_new(tiled->springs, sizeof(int32_t));
  if (mixed) tiled->kappa = hk_new(tiled->springs, sizeof(double));
  if (mixed) tiled->gamma = hk_new(tiled->springs, sizeof(double));
  const int there = tiled->rest_length && tiled->slot && (!mixed || (tiled->kappa && tiled->gamma));
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void point_to_tiled(const struct hk_tiled *tiled, const struct hk_tiled_kind *kind,
                           struct hk_run *run) {
  run->slot = tiled->slot + run->first;
  run->kappas = tiled->kappa;
  run->gammas = tiled->gamma;
  run->rest_lengths = tiled->rest_length;
  run->kappa = kind->kappa;
  run->gamma = kind->gamma;
  run->strain = (kind->shape & HOOKE_TILED_MIXED) == HOOKE_TILED_STRAIN;
}

/* Materials move to their indices in the tiled batch, where runs look them up. */
static int32_t move_material(struct maker *maker) {
  struct hk_tiled *tiled = maker->tiled;
  struct hk_springs *springs = maker->springs;
  const int32_t material = tiled->kind[0].shape & HOOKE_TILED_MIXED;
  if (material == 0) return HOOKE_OK;
  const int32_t status = new_material(tiled, material == HOOKE_TILED_MIXED);
  if (status != HOOKE_OK) return status;
  memcpy(tiled->slot, maker->at, (size_t)tiled->springs * sizeof *tiled->slot);
  for (int64_t r = 0; r < springs->run_count; r++) {
    struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_material own = hk_run_material(run, k);
      const int32_t at = maker->at[run->first + k];
      tiled->rest_length[at] = own.rest_length;
      if (tiled->kappa) tiled->kappa[at] = own.kappa;
      if (tiled->gamma) tiled->gamma[at] = own.gamma;
    }
    if (run->shape & HOOKE_RUN_MIXED) point_to_tiled(tiled, &tiled->kind[maker->kind_of[r]], run);
  }
  hk_stored_drop_numbers(&springs->stored);
  return HOOKE_OK;
}

/* ---- whole ---- */

static int may_pay(const struct hk_springs *springs, int64_t particle_count) {
  return springs->curved == 0 &&
         springs->count >= (particle_count <= HOOKE_TILE ? LEAST_SPRINGS : LEAST_STORED) &&
         (double)(springs->count - springs->stored.indexed) <= MOST_IN_RUNS * (double)springs->count;
}

static int32_t make(struct maker *maker, const double *inverse_mass) {
  struct hk_tiled *tiled = maker->tiled;
  int32_t status = number(maker, inverse_mass);
  if (status != HOOKE_OK) return status;
  if (!hk_tiled_sort_kinds(maker->springs, tiled, maker->kind_of)) {
    hk_tiled_release(tiled);
    return HOOKE_OK;
  }
  tiled->tile = hk_new(tiled->tiles, sizeof *tiled->tile);
  tiled->batch = hk_new(tiled->tiles * tiled->kinds, sizeof *tiled->batch);
  tiled->degree = hk_new(tiled->particles, sizeof *tiled->degree);
  int32_t *sorted = hk_new(tiled->springs, sizeof *sorted);
  if (tiled->tile && tiled->batch && tiled->degree && sorted)
    sort(maker, sorted);
  else
    status = HOOKE_NO_MEMORY;
  hk_free(sorted);
  if (status != HOOKE_OK) return status;
  measure(maker);
  const double bytes = (double)(hk_tiled_numbers(tiled) * (int64_t)sizeof(double));
  if (!count_degrees(maker) || bytes > fmax(MOST_BYTES, MOST_BYTES_A_PARTICLE * (double)tiled->particles)) {
    hk_tiled_release(tiled);
    return HOOKE_OK;
  }
  status = fill_ends(maker);
  return status == HOOKE_OK ? move_material(maker) : status;
}

int32_t hk_tiled_create(struct hk_springs *springs, int64_t particle_count, const double *inverse_mass,
                        struct hk_tiled *tiled) {
  *tiled = (struct hk_tiled){0};
  if (!may_pay(springs, particle_count)) return HOOKE_OK;
  tiled->particles = particle_count;
  tiled->springs = springs->count;
  tiled->stored = springs->count >= LEAST_STORED;
  tiled->tiles = (particle_count + HOOKE_TILE - 1) / HOOKE_TILE;
  struct maker maker;
  int32_t status = maker_create(springs, tiled, &maker);
  if (status == HOOKE_OK) status = make(&maker, inverse_mass);
  maker_release(&maker);
  if (status != HOOKE_OK) hk_tiled_release(tiled);
  return status;
}

void hk_tiled_release(struct hk_tiled *tiled) {
  void *const block[] = {tiled->tile,        tiled->order, tiled->inverse_mass, tiled->batch,
                         tiled->lower,       tiled->upper, tiled->kappa,        tiled->gamma,
                         tiled->rest_length, tiled->slot,  tiled->degree,       tiled->force};
  for (size_t k = 0; k < sizeof block / sizeof block[0]; k++)
    hk_free(block[k]);
  memset(tiled, 0, sizeof *tiled);
}

int64_t hk_tiled_spring_memory(const struct hk_tiled *tiled) {
  const int64_t width = tiled->wide ? sizeof(uint32_t) : sizeof(uint16_t), number = sizeof(double);
  int64_t a_spring = 1 + 3 * width;
  if (tiled->rest_length) a_spring += number + (int64_t)sizeof(int32_t);
  if (tiled->kappa) a_spring += 2 * number;
  return a_spring * tiled->springs;
}

int64_t hk_tiled_memory(const struct hk_tiled *tiled) {
  int64_t a_particle = (int64_t)sizeof(uint16_t);
  if (tiled->order) a_particle += (int64_t)(sizeof(double) + sizeof(int32_t));
  const int64_t a_tile = (int64_t)sizeof *tiled->tile + tiled->kinds * (int64_t)sizeof *tiled->batch;
  return hk_tiled_spring_memory(tiled) + a_particle * tiled->particles + a_tile * tiled->tiles;
}
