/* The material of strided batches, which stores units of springs that are equal to the bit once: rest lengths
 * of rounded positions differ in their last bits only, and take few values. */
#include "model/sum/strided.h"

#include "core/memory.h"

#include <string.h>

/* More units than this do not fit the second-level cache, and are prefetched so many ahead. */
enum { UNITS_IN_CACHE = 2500, EARLY = 8 };

enum { NUMBERS = HOOKE_STRIDED_NUMBERS, UNIT_BYTES = HOOKE_STRIDED_UNIT * sizeof(double) };

/* One number of a batch during construction. */
struct column {
  int64_t units; /* from that of the first spring to that of the last */
  double *value; /* number of these */
  int32_t *kind; /* for each of them the first equal one */
};

static double number_in(const struct hk_material *material, int32_t j) {
  const double number[NUMBERS] = {[HOOKE_STRIDED_KAPPA] = material->kappa,
                                  [HOOKE_STRIDED_GAMMA] = material->gamma,
                                  [HOOKE_STRIDED_REST] = material->rest_length};
  return number[j];
}

/* ---- sharing between springs ---- */

struct sharing {
  struct hk_material material[HOOKE_MOST_STRIDED]; /* of the first spring */
  int64_t seen[HOOKE_MOST_STRIDED];                /* 1 + the last run examined; 0: none yet */
  uint8_t differs[HOOKE_MOST_STRIDED][NUMBERS];
};

static void look_at(struct sharing *sharing, int32_t batch, const struct hk_material *own) {
  struct hk_material *first = &sharing->material[batch];
  if (sharing->seen[batch] == 0) *first = *own;
  for (int32_t j = 0; j < NUMBERS; j++) {
    const double a = number_in(own, j), b = number_in(first, j);
    sharing->differs[batch][j] |= memcmp(&a, &b, sizeof a) != 0;
  }
}

static void find_shared(const struct hk_springs *springs, struct hk_strided_batches *strided,
                        struct sharing *sharing) {
  *sharing = (struct sharing){.seen = {0}};
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const int32_t batch = strided->batch_of[run->first + k];
      if (sharing->seen[batch] == r + 1 && !(run->shape & HOOKE_RUN_MIXED)) continue;
      const struct hk_material own = hk_run_material(run, k);
      look_at(sharing, batch, &own);
      sharing->seen[batch] = r + 1;
      if (own.gamma != 0.0) strided->batch[batch].shape |= HOOKE_RUN_DAMPED;
    }
  }
}

/* ---- equal units ---- */

static uint64_t mix(const double *value) {
  uint64_t word[HOOKE_STRIDED_UNIT], sum = 0;
  memcpy(word, value, sizeof word);
  for (int k = 0; k < HOOKE_STRIDED_UNIT; k++) {
    sum = (sum ^ word[k]) * 0x9E3779B97F4A7C15u;
    sum ^= sum >> 29;
  }
  return sum;
}

/* Finds for each unit the first equal one, by a hash table of `capacity` slots, a power of two; returns the
 * number of distinct ones, or 0 if they exceed half the table. */
static int64_t find_equal(const struct column *column, int32_t *table, int64_t capacity) {
  int64_t kinds = 0;
  for (int64_t u = 0; u < column->units; u++) {
    const double *value = column->value + HOOKE_STRIDED_UNIT * u;
    int64_t at = (int64_t)(mix(value) & (uint64_t)(capacity - 1));
    while (table[at] &&
           memcmp(column->value + HOOKE_STRIDED_UNIT * (int64_t)(table[at] - 1), value, UNIT_BYTES))
      at = (at + 1) & (capacity - 1);
    if (table[at] == 0) {
      if (2 * ++kinds > capacity) return 0;
      table[at] = (int32_t)u + 1;
    }
    column->kind[u] = table[at] - 1;
  }
  return kinds;
}

/* Shares units if at most a quarter are distinct, so that it pays; otherwise stores all. */
static int32_t find_kinds(struct column *column) {
  int64_t capacity = 2;
  while (2 * capacity <= column->units / 2)
    capacity *= 2;
  int32_t *table = hk_new(capacity, sizeof *table);
  if (table == NULL) return HOOKE_NO_MEMORY;
  const int64_t kinds = find_equal(column, table, capacity);
  hk_free(table);
  for (int64_t u = 0; u < column->units && kinds == 0; u++)
    column->kind[u] = (int32_t)u;
  return HOOKE_OK;
}

/* Keeps the first unit of each kind, and stores its index, counted from unit `base`, in every third entry of
 * `unit`. Returns the number of units. */
static int32_t keep_kinds(struct column *column, int32_t base, uint32_t *unit) {
  int32_t kept = 0;
  for (int64_t u = 0; u < column->units; u++) {
    const int32_t kind = column->kind[u];
    const int64_t place = HOOKE_STRIDED_UNIT * ((int64_t)base + kept);
    unit[NUMBERS * u] = kind < u ? unit[NUMBERS * (int64_t)kind] : (uint32_t)place;
    if (kind < u) continue;
    memmove(column->value + HOOKE_STRIDED_UNIT * (int64_t)kept++, column->value + HOOKE_STRIDED_UNIT * u,
            UNIT_BYTES);
  }
  return kept;
}

/* ---- own numbers ---- */

static void collect(const struct hk_springs *springs, const struct hk_strided_batches *strided, int32_t batch,
                    int32_t j, int64_t first, double *value) {
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      if (strided->batch_of[run->first + k] != batch) continue;
      const struct hk_material own = hk_run_material(run, k);
      value[hk_run_lower(run, k) - first] = number_in(&own, j);
    }
  }
}

/* Number j of a batch, after the `base` units of earlier numbers; *units receives the total. */
static int32_t store(const struct hk_springs *springs, struct hk_strided_batches *strided, int32_t batch,
                     int32_t j, int32_t *units) {
  struct hk_strided_material *material = &strided->material[batch];
  const int64_t first = strided->batch[batch].first / HOOKE_STRIDED_UNIT,
                base = HOOKE_STRIDED_UNIT * (int64_t)*units;
  struct column column = {.units = strided->batch[batch].last / HOOKE_STRIDED_UNIT + 1 - first};
  int32_t status = hk_grow((void **)&material->value, base, base + HOOKE_STRIDED_UNIT * column.units,
                           sizeof *material->value);
  column.kind = hk_new(column.units, sizeof *column.kind);
  if (column.kind == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    column.value = material->value + base;
    memset(column.value, 0, (size_t)(column.units * (int64_t)UNIT_BYTES));
    collect(springs, strided, batch, j, first * HOOKE_STRIDED_UNIT, column.value);
    status = find_kinds(&column);
  }
  if (status == HOOKE_OK) {
    const int32_t kept = keep_kinds(&column, *units, material->unit + NUMBERS * first + j);
    if (kept == column.units && kept > UNITS_IN_CACHE) material->ahead = EARLY * HOOKE_STRIDED_UNIT;
    *units += kept;
  }
  hk_free(column.kind);
  return status;
}

static void share(double value, struct hk_strided_material *material, int32_t j) {
  for (int k = 0; k < HOOKE_STRIDED_UNIT; k++)
    material->value[HOOKE_STRIDED_UNIT * j + k] = value;
}

/* Shared numbers are in the first units, at the index of the number. */
static int32_t take(const struct hk_springs *springs, int64_t particles, struct hk_strided_batches *strided,
                    int32_t batch, const struct sharing *sharing) {
  struct hk_strided_material *material = &strided->material[batch];
  int32_t units = NUMBERS, status = HOOKE_OK, mixed = 0;
  for (int32_t j = 0; j < NUMBERS; j++)
    mixed |= sharing->differs[batch][j];
  const int64_t all = mixed ? particles / HOOKE_STRIDED_UNIT + 1 : 1;
  material->mask = mixed ? -1 : 0;
  material->value = hk_new(NUMBERS * HOOKE_STRIDED_UNIT, sizeof *material->value);
  material->unit = hk_new(NUMBERS * all, sizeof *material->unit);
  if (material->value == NULL || material->unit == NULL) return HOOKE_NO_MEMORY;
  for (int32_t j = 0; j < NUMBERS; j++) {
    share(number_in(&sharing->material[batch], j), material, j);
    for (int64_t u = 0; u < all; u++)
      material->unit[NUMBERS * u + j] = (uint32_t)(HOOKE_STRIDED_UNIT * j);
    if (sharing->differs[batch][j] && status == HOOKE_OK) status = store(springs, strided, batch, j, &units);
    strided->batch[batch].units[j] = units;
  }
  const int64_t kept = HOOKE_STRIDED_UNIT * (int64_t)units;
  if (status == HOOKE_OK) status = hk_grow((void **)&material->value, kept, kept, sizeof *material->value);
  if (mixed) strided->batch[batch].shape |= HOOKE_RUN_MIXED;
  strided->memory += NUMBERS * all * (int64_t)sizeof *material->unit + units * (int64_t)UNIT_BYTES;
  return status;
}

/* ---- whole ---- */

static void look_up_in_batches(struct hk_springs *springs, struct hk_strided_batches *strided) {
  for (int64_t r = 0; r < springs->run_count; r++) {
    struct hk_run *run = &springs->run[r];
    if (!(run->shape & HOOKE_RUN_MIXED)) continue;
    run->batch = strided->batch_of + run->first;
    run->of_batches = strided->material;
    run->kappas = run->gammas = run->rest_lengths = NULL;
  }
  if (springs->stored.mixed > 0) {
    strided->memory += springs->count;
    hk_stored_drop_numbers(&springs->stored);
    return;
  }
  hk_free(strided->batch_of);
  strided->batch_of = NULL;
}

int32_t hk_strided_batches_take_material(struct hk_springs *springs, int64_t particle_count,
                                         struct hk_strided_batches *strided) {
  struct sharing sharing;
  int32_t status = HOOKE_OK;
  find_shared(springs, strided, &sharing);
  for (int32_t k = 0; k < strided->count && status == HOOKE_OK; k++)
    status = take(springs, particle_count, strided, k, &sharing);
  if (status == HOOKE_OK) look_up_in_batches(springs, strided);
  return status;
}
