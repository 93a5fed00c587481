/* Finds the lanes of a system: each spring joins the earliest lane of its offset that has room for it and
 * keeps an order of items. */
#include "model/sum/lane.h"

#include "core/memory.h"

#include <string.h>

/* A pass computes every lane at every particle: with fewer springs than this share of that, others are
 * faster; and in a system of few particles there is nothing to gain. */
static const double LEAST_FILLED = 0.3;
enum { LEAST_PARTICLES = 64, MOST_WINDOW = 1 << 18 };

/* Places of three numbers a particle have 32 bits. */
enum { MOST_PARTICLES = 1 << 30 };

/* Items count from 1 here: 2 k + 1 are the ends of lane k, 2 k + 2 its beginnings, 0 is none. */
struct finder {
  struct hk_lanes *lanes;
  int64_t particles;
  uint8_t *at;                          /* the last item of the springs of each particle so far */
  uint64_t after[HOOKE_MOST_ITEMS + 1]; /* bits of the items that an item must not come behind, and its own */
  int32_t failed;                       /* no memory */
};

static uint64_t bit_of(int32_t item) {
  return item ? (uint64_t)1 << (item - 1) : 0;
}

static int has_spring(const struct hk_lane *lane, int64_t low) {
  return lane->present[low / HOOKE_LANE_UNIT] >> low % HOOKE_LANE_UNIT & 1;
}

/* Whether an order is left if the end of lane k comes behind item `high`, and its beginning behind `low`. */
static int keeps_order(const struct finder *finder, int32_t k, int32_t low, int32_t high) {
  const uint64_t end = finder->after[2 * k + 1], begin = finder->after[2 * k + 2];
  if (begin & bit_of(low) || end & bit_of(high)) return 0;
  return !(begin & bit_of(high) && end & bit_of(low));
}

static void put_behind(struct finder *finder, int32_t before, int32_t item) {
  if (before == 0 || finder->after[before] & bit_of(item)) return;
  const uint64_t more = finder->after[item];
  for (int32_t i = 1; i <= 2 * finder->lanes->count; i++) {
    if (finder->after[i] & bit_of(before)) finder->after[i] |= more;
  }
}

static int32_t new_lane(struct finder *finder, int64_t offset, int64_t low, int32_t shape) {
  struct hk_lanes *lanes = finder->lanes;
  if (lanes->count == HOOKE_MOST_LANES) return -1;
  const int64_t bytes = finder->particles / HOOKE_LANE_UNIT + 1;
  const int32_t k = lanes->count;
  uint8_t *present = hk_new(bytes, sizeof *present);
  finder->failed |= present == NULL;
  if (present == NULL) return -1;
  lanes->lane[k] =
      (struct hk_lane){.offset = offset, .first = low, .last = low, .shape = shape, .present = present};
  finder->after[2 * k + 1] = bit_of(2 * k + 1);
  finder->after[2 * k + 2] = bit_of(2 * k + 2);
  lanes->memory += bytes;
  return lanes->count++;
}

/* Lane of a spring; -1 if there is none. */
static int32_t choose(struct finder *finder, int64_t low, int64_t high, int32_t shape) {
  const int64_t offset = high - low;
  for (int32_t k = 0; k < finder->lanes->count; k++) {
    const struct hk_lane *lane = &finder->lanes->lane[k];
    if (lane->offset == offset && lane->shape == shape && !has_spring(lane, low) &&
        keeps_order(finder, k, finder->at[low], finder->at[high]))
      return k;
  }
  return new_lane(finder, offset, low, shape);
}

static int add_spring(struct finder *finder, const struct hk_run *run, int64_t k) {
  const int64_t low = hk_run_lower(run, k), high = hk_run_upper(run, k);
  const int32_t chosen = choose(finder, low, high, run->shape & HOOKE_RUN_PULL_ONLY);
  if (chosen < 0) return 0;
  struct hk_lane *lane = &finder->lanes->lane[chosen];
  put_behind(finder, finder->at[low], 2 * chosen + 2);
  put_behind(finder, finder->at[high], 2 * chosen + 1);
  finder->at[low] = (uint8_t)(2 * chosen + 2);
  finder->at[high] = (uint8_t)(2 * chosen + 1);
  lane->present[low / HOOKE_LANE_UNIT] |= (uint8_t)(1u << low % HOOKE_LANE_UNIT);
  if (low < lane->first) lane->first = low;
  if (low > lane->last) lane->last = low;
  finder->lanes->lane_of[run->first + k] = (uint8_t)chosen;
  return 1;
}

static int pays(const struct hk_lanes *lanes, int64_t springs) {
  int64_t window = 0, reached = 0;
  for (int32_t k = 0; k < lanes->count; k++) {
    window += lanes->lane[k].offset;
    reached += lanes->lane[k].last + lanes->lane[k].offset - lanes->lane[k].first;
  }
  return window <= MOST_WINDOW && (double)springs >= LEAST_FILLED * (double)reached;
}

/* An item that others come behind has more of them behind it than these have. */
static void put_in_order(const struct finder *finder) {
  struct hk_lanes *lanes = finder->lanes;
  int32_t done = 0;
  for (int32_t behind = 2 * lanes->count; behind > 0; behind--) {
    for (int32_t i = 1; i <= 2 * lanes->count; i++) {
      if (__builtin_popcountll(finder->after[i]) == behind) lanes->item[done++] = (uint8_t)(i - 1);
    }
  }
}

/* 1 if all springs are in lanes, and these pay. */
static int find(struct finder *finder, const struct hk_springs *springs) {
  struct hk_lanes *lanes = finder->lanes;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++) {
      if (!add_spring(finder, &springs->run[r], k)) return 0;
    }
  }
  for (int32_t k = 0; k < lanes->count; k++) {
    const int64_t offset = lanes->lane[k].offset,
                  whole = (offset + HOOKE_LANE_UNIT - 1) / HOOKE_LANE_UNIT * HOOKE_LANE_UNIT;
    if (whole > lanes->reach) lanes->reach = whole;
  }
  put_in_order(finder);
  return lanes->count > 0 && pays(lanes, springs->count);
}

int32_t hk_lanes_create(struct hk_springs *springs, int64_t particle_count, struct hk_lanes *lanes) {
  *lanes = (struct hk_lanes){0};
  if (particle_count < LEAST_PARTICLES || particle_count > MOST_PARTICLES) return HOOKE_OK;
  struct finder finder = {
      .lanes = lanes, .particles = particle_count, .at = hk_new(particle_count, sizeof *finder.at)};
  lanes->lane_of = hk_new(springs->count, sizeof *lanes->lane_of);
  finder.failed = finder.at == NULL || lanes->lane_of == NULL;
  const int found = !finder.failed && find(&finder, springs);
  int32_t status = finder.failed ? HOOKE_NO_MEMORY : HOOKE_OK;
  hk_free(finder.at);
  if (found) status = hk_lanes_take_material(springs, particle_count, lanes);
  if (!found || status != HOOKE_OK) hk_lanes_release(lanes);
  return status;
}

void hk_lanes_release(struct hk_lanes *lanes) {
  for (int32_t k = 0; k < lanes->count; k++) {
    hk_free(lanes->lane[k].present);
    hk_free(lanes->material[k].value);
    hk_free(lanes->material[k].unit);
  }
  hk_free(lanes->lane_of);
  memset(lanes, 0, sizeof *lanes);
}
