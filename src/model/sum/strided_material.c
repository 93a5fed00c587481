/* The material of strided batches, which stores units of springs that are equal to the bit once: rest lengths
 * of rounded positions differ in their last bits only, and take few values. */
#include "model/sum/strided.h"

#include "core/memory.h"

#include <string.h>

/* More units than this do not fit the second-level cache, and are prefetched so many ahead. */
enum { UNITS_IN_CACHE = 800, EARLY = 8 };

enum { NUMBERS = HOOKE_STRIDED_NUMBERS, ROW = HOOKE_STRIDED_ROW, ROW_BYTES = ROW * sizeof(double) };

/* What springs of a batch differ in. */
enum { IN_REST_LENGTH = 1, IN_OTHERS = 2 };

/* The numbers of a batch during construction. */
struct rows {
  int64_t count; /* from the unit of the first spring to that of the last */
  double *value; /* of these */
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
  uint8_t differs[HOOKE_MOST_STRIDED];
};

static void look_at(struct sharing *sharing, int32_t batch, const struct hk_material *own) {
  struct hk_material *first = &sharing->material[batch];
  if (sharing->seen[batch] == 0) *first = *own;
  for (int32_t j = 0; j < NUMBERS; j++) {
    const double a = number_in(own, j), b = number_in(first, j);
    if (memcmp(&a, &b, sizeof a))
      sharing->differs[batch] |= j == HOOKE_STRIDED_REST ? IN_REST_LENGTH : IN_OTHERS;
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
  uint64_t word[ROW], sum = 0;
  memcpy(word, value, sizeof word);
  for (int k = 0; k < ROW; k++) {
    sum = (sum ^ word[k]) * 0x9E3779B97F4A7C15u;
    sum ^= sum >> 29;
  }
  return sum;
}

/* Finds for each unit the first equal one, by a hash table of `capacity` slots, a power of two; returns the
 * number of distinct ones, or 0 if they exceed half the table. */
static int64_t find_equal(const struct rows *rows, int32_t *table, int64_t capacity) {
  int64_t kinds = 0;
  for (int64_t u = 0; u < rows->count; u++) {
    const double *value = rows->value + ROW * u;
    int64_t at = (int64_t)(mix(value) & (uint64_t)(capacity - 1));
    while (table[at] && memcmp(rows->value + ROW * (int64_t)(table[at] - 1), value, ROW_BYTES))
      at = (at + 1) & (capacity - 1);
    if (table[at] == 0) {
      if (2 * ++kinds > capacity) return 0;
      table[at] = (int32_t)u + 1;
    }
    rows->kind[u] = table[at] - 1;
  }
  return kinds;
}

/* Shares units if at most a quarter are distinct, so that it pays; otherwise stores all. */
static int32_t find_kinds(struct rows *rows) {
  int64_t capacity = 2;
  while (2 * capacity <= rows->count / 2)
    capacity *= 2;
  int32_t *table = hk_new(capacity, sizeof *table);
  if (table == NULL) return HOOKE_NO_MEMORY;
  const int64_t kinds = find_equal(rows, table, capacity);
  hk_free(table);
  for (int64_t u = 0; u < rows->count && kinds == 0; u++)
    rows->kind[u] = (int32_t)u;
  return HOOKE_OK;
}

/* Keeps the first unit of each kind, and stores where it is. Returns the number of units. */
static int32_t keep_kinds(struct rows *rows, uint32_t *unit) {
  int32_t kept = 0;
  for (int64_t u = 0; u < rows->count; u++) {
    const int32_t kind = rows->kind[u];
    unit[u] = kind < u ? unit[kind] : (uint32_t)(ROW * (int64_t)kept);
    if (kind == u) memmove(rows->value + ROW * (int64_t)kept++, rows->value + ROW * u, ROW_BYTES);
  }
  return kept;
}

/* ---- own numbers ---- */

static void put(const struct hk_material *own, double *value) {
  for (int32_t j = 0; j < NUMBERS; j++)
    value[HOOKE_STRIDED_UNIT * j] = number_in(own, j);
}

static void collect(const struct hk_springs *springs, const struct hk_strided_batches *strided, int32_t batch,
                    int64_t first, double *value) {
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      if (strided->batch_of[run->first + k] != batch) continue;
      const struct hk_material own = hk_run_material(run, k);
      const int64_t low = hk_run_lower(run, k);
      put(&own, value + ROW * (low / HOOKE_STRIDED_UNIT - first) + low % HOOKE_STRIDED_UNIT);
    }
  }
}

/* Of consecutive rows keeps the rest lengths, after a row of what the springs have in common. Units beyond
 * the springs have those of the nearest. */
static void make_lean(struct hk_strided_material *material, int64_t first, int64_t rows, int64_t units,
                      const struct hk_material *shared) {
  double *value = material->value;
  for (int64_t u = 0; u < rows; u++)
    memmove(value + ROW + HOOKE_STRIDED_UNIT * u, value + ROW * u + HOOKE_STRIDED_UNIT * HOOKE_STRIDED_REST,
            HOOKE_STRIDED_UNIT * sizeof *value);
  for (int k = 0; k < HOOKE_STRIDED_UNIT; k++)
    put(shared, value + k);
  for (int64_t u = 0; u < units; u++) {
    const int64_t row = u < first ? 0 : u - first < rows ? u - first : rows - 1;
    material->unit[u] = (uint32_t)(ROW + HOOKE_STRIDED_UNIT * row);
  }
  material->lean = 1;
  material->ahead = EARLY * HOOKE_STRIDED_UNIT;
}

/* The material of a batch whose springs differ; those that do not exist have zeros. */
static int32_t store(const struct hk_springs *springs, struct hk_strided_batches *strided, int32_t k,
                     const struct sharing *sharing, int64_t units) {
  struct hk_strided_material *material = &strided->material[k];
  struct hk_strided_batch *batch = &strided->batch[k];
  const int64_t first = batch->first / HOOKE_STRIDED_UNIT;
  struct rows rows = {.count = batch->last / HOOKE_STRIDED_UNIT + 1 - first};
  int32_t status = hk_grow((void **)&material->value, 0, ROW * rows.count, sizeof *material->value);
  rows.kind = hk_new(rows.count, sizeof *rows.kind);
  if (rows.kind == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    rows.value = material->value;
    memset(rows.value, 0, (size_t)(rows.count * (int64_t)ROW_BYTES));
    collect(springs, strided, k, first, rows.value);
    status = find_kinds(&rows);
  }
  if (status == HOOKE_OK) {
    const int32_t kept = keep_kinds(&rows, material->unit + first);
    const int far = kept == rows.count && kept > UNITS_IN_CACHE, lean = sharing->differs[k] == IN_REST_LENGTH;
    if (far) material->ahead = EARLY * ROW;
    if (far && lean) make_lean(material, first, kept, units, &sharing->material[k]);
    batch->values = far && lean ? ROW + HOOKE_STRIDED_UNIT * (int64_t)kept : ROW * (int64_t)kept;
    status = hk_grow((void **)&material->value, batch->values, batch->values, sizeof *material->value);
  }
  hk_free(rows.kind);
  return status;
}

static int32_t take(const struct hk_springs *springs, int64_t particles, struct hk_strided_batches *strided,
                    int32_t batch, const struct sharing *sharing) {
  struct hk_strided_material *material = &strided->material[batch];
  const int32_t mixed = sharing->differs[batch];
  const int64_t all = mixed ? particles / HOOKE_STRIDED_UNIT + 1 : 1;
  int32_t status = HOOKE_OK;
  material->mask = mixed ? -1 : 0;
  material->value = hk_new(ROW, sizeof *material->value);
  material->unit = hk_new(all, sizeof *material->unit);
  if (material->value == NULL || material->unit == NULL) return HOOKE_NO_MEMORY;
  strided->batch[batch].values = ROW;
  for (int k = 0; k < HOOKE_STRIDED_UNIT; k++)
    put(&sharing->material[batch], material->value + k);
  if (mixed) {
    strided->batch[batch].shape |= HOOKE_RUN_MIXED;
    status = store(springs, strided, batch, sharing, all);
  }
  strided->memory +=
      all * (int64_t)sizeof *material->unit + strided->batch[batch].values * (int64_t)sizeof *material->value;
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
