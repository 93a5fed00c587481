/* Finds the strided batches of a system: each spring joins the earliest batch of its offset that has space
 * for it and keeps an order of items. */
#include "model/sum/strided.h"

#include "core/memory.h"

#include <string.h>

/* A pass computes every batch at every particle, and to set a batch up costs as much as some particles: with
 * fewer springs than this fraction of that, other ways are faster; and a system of few particles gains
 * nothing. */
static const double LEAST_FILLED = 0.3;
enum { PARTICLES_A_SET_UP = 16, LEAST_PARTICLES = 64, MOST_WINDOW = 1 << 18 };

/* Indices of three numbers a particle have 32 bits. */
enum { MOST_PARTICLES = 1 << 30 };

/* Items count from 1 here: 2 k + 1 are the ends of batch k, 2 k + 2 its beginnings, 0 is none. */
struct finder {
  struct hk_strided_batches *strided;
  int64_t particles;
  uint8_t *at;                          /* last item so far of the springs of each particle */
  uint64_t after[HOOKE_MOST_ITEMS + 1]; /* bits of the items that must precede an item, and its own */
  int32_t failed;                       /* no memory */
};

static uint64_t bit_of(int32_t item) {
  return item ? (uint64_t)1 << (item - 1) : 0;
}

static int has_spring(const struct hk_strided_batch *batch, int64_t low) {
  return batch->present[low / HOOKE_STRIDED_UNIT] >> low % HOOKE_STRIDED_UNIT & 1;
}

/* True if an order remains when the end of batch k follows item `high`, and its beginning follows `low`. */
static int keeps_order(const struct finder *finder, int32_t k, int32_t low, int32_t high) {
  const uint64_t end = finder->after[2 * k + 1], begin = finder->after[2 * k + 2];
  if (begin & bit_of(low) || end & bit_of(high)) return 0;
  return !(begin & bit_of(high) && end & bit_of(low));
}

static void put_behind(struct finder *finder, int32_t before, int32_t item) {
  if (before == 0 || finder->after[before] & bit_of(item)) return;
  const uint64_t more = finder->after[item];
  for (int32_t i = 1; i <= 2 * finder->strided->count; i++) {
    if (finder->after[i] & bit_of(before)) finder->after[i] |= more;
  }
}

/* Room for batch k of that offset, which begins at `low`; 0 if there is none. */
static int begin_batch(struct finder *finder, int32_t k, int64_t offset, int64_t low) {
  if (k == HOOKE_MOST_STRIDED) return 0;
  const int64_t bytes = finder->particles / HOOKE_STRIDED_UNIT + 1;
  struct hk_strided_batch *batch = &finder->strided->batch[k];
  *batch = (struct hk_strided_batch){.offset = offset, .first = low, .last = low, .reach = offset};
  batch->present = hk_new(bytes, sizeof *batch->present);
  finder->failed |= batch->present == NULL;
  finder->strided->memory += bytes;
  return batch->present != NULL;
}

static int32_t new_batch(struct finder *finder, int64_t offset, int64_t low, const struct hk_run *run) {
  const int32_t k = finder->strided->count;
  if (!begin_batch(finder, k, offset, low)) return -1;
  finder->strided->batch[k].shape = run->shape & HOOKE_RUN_PULL_ONLY;
  finder->strided->batch[k].scaling = run->scaling;
  finder->after[2 * k + 1] = bit_of(2 * k + 1);
  finder->after[2 * k + 2] = bit_of(2 * k + 2);
  return finder->strided->count++;
}

/* Strided batch of a spring; -1 if there is none. */
static int32_t choose(struct finder *finder, int64_t low, int64_t high, const struct hk_run *run) {
  const int64_t offset = high - low;
  const int32_t shape = run->shape & HOOKE_RUN_PULL_ONLY;
  for (int32_t k = 0; k < finder->strided->count; k++) {
    const struct hk_strided_batch *batch = &finder->strided->batch[k];
    if (batch->offset == offset && batch->shape == shape && batch->scaling == run->scaling &&
        !has_spring(batch, low) && keeps_order(finder, k, finder->at[low], finder->at[high]))
      return k;
  }
  return new_batch(finder, offset, low, run);
}

static void put_at(struct hk_strided_batch *batch, int64_t low) {
  batch->present[low / HOOKE_STRIDED_UNIT] |= (uint8_t)(1u << low % HOOKE_STRIDED_UNIT);
  if (low < batch->first) batch->first = low;
  if (low > batch->last) batch->last = low;
}

static int add_spring(struct finder *finder, const struct hk_run *run, int64_t k) {
  const int64_t low = hk_run_lower(run, k), high = hk_run_upper(run, k);
  const int32_t chosen = choose(finder, low, high, run);
  if (chosen < 0) return 0;
  struct hk_strided_batch *batch = &finder->strided->batch[chosen];
  put_behind(finder, finder->at[low], 2 * chosen + 2);
  put_behind(finder, finder->at[high], 2 * chosen + 1);
  finder->at[low] = (uint8_t)(2 * chosen + 2);
  finder->at[high] = (uint8_t)(2 * chosen + 1);
  put_at(batch, low);
  finder->strided->batch_of[run->first + k] = (uint8_t)chosen;
  return 1;
}

/* Batches that one pass sets up: at the first particle, and wherever one begins or ends, all that are there.
 */
static int64_t set_ups(const struct hk_strided_batches *strided) {
  int64_t count = 0;
  for (int64_t at = 0, next; at < INT64_MAX; at = next) {
    next = INT64_MAX;
    for (int32_t k = 0; k < strided->count + strided->bent; k++) {
      const struct hk_strided_batch *batch = &strided->batch[k];
      const int64_t begin = batch->first / HOOKE_STRIDED_UNIT * HOOKE_STRIDED_UNIT,
                    end = hk_whole_units(batch->last + batch->reach + 1);
      count += begin <= at && at < end;
      if (begin > at && begin < next) next = begin;
      if (end > at && end < next) next = end;
    }
  }
  return count;
}

static int pays(const struct hk_strided_batches *strided, int64_t members) {
  int64_t window = 0, reached = PARTICLES_A_SET_UP * set_ups(strided);
  for (int32_t k = 0; k < strided->count + strided->bent; k++) {
    window += strided->batch[k].reach;
    reached += strided->batch[k].last + strided->batch[k].reach - strided->batch[k].first;
  }
  return window <= MOST_WINDOW && (double)members >= LEAST_FILLED * (double)reached;
}

/* And the reach. HOOKE_NO_MEMORY. */
static int32_t find_whole_units(struct hk_strided_batches *strided, int64_t particles) {
  const int64_t units = particles / HOOKE_STRIDED_UNIT + 1;
  strided->present = hk_new(units, sizeof *strided->present);
  if (strided->present == NULL) return HOOKE_NO_MEMORY;
  memset(strided->present, 0xff, (size_t)units);
  strided->memory += units;
  for (int32_t k = 0; k < strided->count + strided->bent; k++) {
    const struct hk_strided_batch *batch = &strided->batch[k];
    const int64_t whole = hk_whole_units(batch->reach);
    if (whole > strided->reach) strided->reach = whole;
    for (int64_t u = batch->first / HOOKE_STRIDED_UNIT;
         u <= (batch->last + batch->reach) / HOOKE_STRIDED_UNIT; u++)
      strided->present[u] &= batch->present[u];
  }
  return HOOKE_OK;
}

/* An item with successors has more of them than any of these. */
static void put_in_order(const struct finder *finder) {
  struct hk_strided_batches *strided = finder->strided;
  int32_t done = 0;
  for (int32_t behind = 2 * strided->count; behind > 0; behind--) {
    for (int32_t i = 1; i <= 2 * strided->count; i++) {
      if (__builtin_popcountll(finder->after[i]) == behind) strided->item[done++] = (uint8_t)(i - 1);
    }
  }
}

/* 1 if all springs are in batches, and these pay. */
static int find(struct finder *finder, const struct hk_springs *springs) {
  struct hk_strided_batches *strided = finder->strided;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++) {
      if (!add_spring(finder, &springs->run[r], k)) return 0;
    }
  }
  put_in_order(finder);
  return strided->count > 0 && pays(strided, springs->count);
}

/* ---- triples ---- */

/* The first batch of the offset behind those of the last triples of all three particles; the triples of a
 * batch ascend. -1 if there is none. */
static int32_t choose_bent(struct finder *finder, const struct hk_triple *triple, int64_t offset) {
  struct hk_strided_batches *strided = finder->strided;
  const int32_t end = strided->count + strided->bent;
  int32_t k = strided->count;
  for (int e = 0; e < 3; e++)
    if (finder->at[triple->particle[e]] > k) k = finder->at[triple->particle[e]];
  while (k < end && (strided->batch[k].offset != offset || strided->batch[k].last >= triple->particle[0]))
    k++;
  if (k < end) return k;
  if (!begin_batch(finder, k, offset, triple->particle[0])) return -1;
  strided->bent++;
  strided->batch[k].reach = 2 * offset;
  strided->material[k].value = hk_new(finder->particles + HOOKE_STRIDED_UNIT, sizeof(double));
  strided->memory += (finder->particles + HOOKE_STRIDED_UNIT) * (int64_t)sizeof(double);
  finder->failed |= strided->material[k].value == NULL;
  return finder->failed ? -1 : k;
}

static int add_triple(struct finder *finder, const struct hk_triple *triple) {
  const int64_t first = triple->particle[0], offset = triple->particle[1] - first;
  if (offset <= 0 || triple->particle[2] != first + 2 * offset) return 0;
  const int32_t k = choose_bent(finder, triple, offset);
  if (k < 0) return 0;
  for (int e = 0; e < 3; e++)
    finder->at[triple->particle[e]] = (uint8_t)k;
  put_at(&finder->strided->batch[k], first);
  finder->strided->material[k].value[first] = triple->coefficient;
  return 1;
}

static void release_from(struct hk_strided_batches *strided, int32_t k) {
  for (; k < strided->count + strided->bent; k++) {
    hk_free(strided->batch[k].present);
    hk_free(strided->material[k].value);
    hk_free(strided->material[k].unit);
  }
}

/* All triples, or none, if there is no room or they do not pay. */
static void find_bent(struct finder *finder, const struct hk_springs *springs,
                      const struct hk_bending *bending) {
  const int64_t memory = finder->strided->memory;
  struct hk_triple triple;
  int found = 1;
  memset(finder->at, 0, (size_t)finder->particles);
  for (struct hk_triples at = {bending, 0, 0}; found && hk_next_triple(&at, &triple);)
    found = add_triple(finder, &triple);
  if (found && pays(finder->strided, springs->count + bending->count)) return;
  release_from(finder->strided, finder->strided->count);
  finder->strided->bent = 0;
  finder->strided->memory = memory;
}

int32_t hk_strided_batches_create(struct hk_springs *springs, const struct hk_bending *bending,
                                  int64_t particle_count, struct hk_strided_batches *strided) {
  *strided = (struct hk_strided_batches){0};
  if (particle_count < LEAST_PARTICLES || particle_count > MOST_PARTICLES || springs->curved > 0)
    return HOOKE_OK;
  struct finder finder = {
      .strided = strided, .particles = particle_count, .at = hk_new(particle_count, sizeof *finder.at)};
  strided->batch_of = hk_new(springs->count, sizeof *strided->batch_of);
  finder.failed = finder.at == NULL || strided->batch_of == NULL;
  const int found = !finder.failed && find(&finder, springs);
  if (found) find_bent(&finder, springs, bending);
  int32_t status = finder.failed ? HOOKE_NO_MEMORY : HOOKE_OK;
  hk_free(finder.at);
  if (found && status == HOOKE_OK) status = find_whole_units(strided, particle_count);
  if (found && status == HOOKE_OK)
    status = hk_strided_batches_take_material(springs, particle_count, strided);
  if (!found || status != HOOKE_OK) hk_strided_batches_release(strided);
  return status;
}

void hk_strided_batches_release(struct hk_strided_batches *strided) {
  release_from(strided, 0);
  hk_free(strided->present);
  hk_free(strided->batch_of);
  memset(strided, 0, sizeof *strided);
}
