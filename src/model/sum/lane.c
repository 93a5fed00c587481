/* Finds the lanes of a system: each run joins the earliest lane that keeps the order of sums. */
#include "model/sum/lane.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* A pass computes every lane at every particle: with fewer springs than this share of that, plain runs are
 * faster; and in a system of few particles there is nothing to gain. */
static const double LEAST_FILLED = 0.3;
enum { LEAST_PARTICLES = 64, MOST_WINDOW = 1 << 18 };

struct finder {
  struct hk_lanes *lanes;
  int64_t top[HOOKE_MOST_LANES]; /* the highest particle that a lane has reached */
  int32_t *lane_of;              /* of each run */
  int32_t merge;                 /* runs of several materials may share a lane, which has them one by one */
};

static int64_t unit_of(int64_t particle) {
  return particle / HOOKE_LANE_UNIT * HOOKE_LANE_UNIT;
}

static int same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static int same_material(const struct hk_lane *lane, const struct hk_run *run) {
  return !((lane->shape | run->shape) & HOOKE_RUN_MIXED) && same_bits(lane->kappa, run->kappa) &&
         same_bits(lane->gamma, run->gamma) && same_bits(lane->rest_length, run->rest_length);
}

static int suits(const struct finder *finder, const struct hk_lane *lane, const struct hk_run *run) {
  if (lane->offset != labs((long)run->offset) || lane->last >= hk_run_low(run)) return 0;
  if ((lane->shape ^ run->shape) & HOOKE_RUN_PULL_ONLY) return 0;
  return finder->merge || (lane->shape & run->shape & HOOKE_RUN_MIXED) || same_material(lane, run);
}

/* From the last lane backwards, past those that end below the run. */
static int32_t choose(const struct finder *finder, const struct hk_run *run) {
  const struct hk_lanes *lanes = finder->lanes;
  for (int32_t k = lanes->count - 1; k >= 0; k--) {
    if (suits(finder, &lanes->lane[k], run)) return k;
    if (finder->top[k] >= hk_run_low(run)) break;
  }
  return lanes->count;
}

static int add_run(struct finder *finder, const struct hk_run *run, int64_t number) {
  struct hk_lanes *lanes = finder->lanes;
  const int32_t k = choose(finder, run);
  if (run->shape & HOOKE_RUN_INDEXED || k == HOOKE_MOST_LANES) return 0;
  struct hk_lane *lane = &lanes->lane[k];
  if (k == lanes->count) {
    *lane = (struct hk_lane){.offset = labs((long)run->offset),
                             .first = hk_run_low(run),
                             .shape = run->shape,
                             .kappa = run->kappa,
                             .gamma = run->gamma,
                             .rest_length = run->rest_length};
    lanes->count++;
  } else if (!same_material(lane, run)) {
    lane->shape |= HOOKE_RUN_MIXED | (run->shape & HOOKE_RUN_DAMPED);
  }
  lane->last = hk_run_high(run) - 1;
  finder->top[k] = lane->last + lane->offset;
  finder->lane_of[number] = k;
  return 1;
}

static int add_runs(struct finder *finder, const struct hk_springs *springs, int32_t merge) {
  *finder->lanes = (struct hk_lanes){0};
  finder->merge = merge;
  for (int64_t r = 0; r < springs->run_count; r++) {
    if (!add_run(finder, &springs->run[r], r)) return 0;
  }
  return 1;
}

static int pays(const struct hk_lanes *lanes, int64_t springs, int64_t particles) {
  int64_t window = 0, reached = 0;
  for (int32_t k = 0; k < lanes->count; k++) {
    window += lanes->lane[k].offset;
    reached += lanes->lane[k].last + lanes->lane[k].offset - lanes->lane[k].first;
  }
  return particles >= LEAST_PARTICLES && window <= MOST_WINDOW &&
         (double)springs >= LEAST_FILLED * (double)reached;
}

static int32_t new_arrays(int64_t particles, struct hk_lanes *lanes) {
  for (int32_t k = 0; k < lanes->count; k++) {
    struct hk_lane *lane = &lanes->lane[k];
    const int64_t bits = particles / HOOKE_LANE_UNIT + 1,
                  numbers = unit_of(lane->last) + HOOKE_LANE_UNIT - unit_of(lane->first);
    lane->present = hk_new(bits, sizeof *lane->present);
    if (lane->present == NULL) return HOOKE_NO_MEMORY;
    lanes->memory += bits * (int64_t)sizeof *lane->present;
    const int64_t whole = unit_of(lane->offset + HOOKE_LANE_UNIT - 1);
    if (whole > lanes->reach) lanes->reach = whole;
    if (!(lane->shape & HOOKE_RUN_MIXED)) continue;
    lane->kappas = hk_new(3 * numbers, sizeof *lane->kappas);
    if (lane->kappas == NULL) return HOOKE_NO_MEMORY;
    lanes->memory += 3 * numbers * (int64_t)sizeof *lane->kappas;
    lane->gammas = lane->kappas + numbers;
    lane->rest_lengths = lane->gammas + numbers;
  }
  return HOOKE_OK;
}

static void take_over(struct hk_lane *lane, struct hk_run *run) {
  const int64_t low = hk_run_low(run), at = low - unit_of(lane->first);
  for (int64_t k = 0; k < run->count; k++) {
    lane->present[(low + k) / HOOKE_LANE_UNIT] |= (uint8_t)(1u << ((low + k) % HOOKE_LANE_UNIT));
    if (!(lane->shape & HOOKE_RUN_MIXED)) continue;
    const struct hk_material material = hk_run_material(run, k);
    lane->kappas[at + k] = material.kappa;
    lane->gammas[at + k] = material.gamma;
    lane->rest_lengths[at + k] = material.rest_length;
  }
  if (!(run->shape & HOOKE_RUN_MIXED)) return;
  run->kappas = lane->kappas + at;
  run->gammas = lane->gammas + at;
  run->rest_lengths = lane->rest_lengths + at;
}

int32_t hk_lanes_create(struct hk_springs *springs, int64_t particle_count, struct hk_lanes *lanes) {
  struct finder finder = {.lanes = lanes, .lane_of = hk_new(springs->run_count, sizeof(int32_t))};
  *lanes = (struct hk_lanes){0};
  if (finder.lane_of == NULL) return HOOKE_NO_MEMORY;
  const int whole = add_runs(&finder, springs, 0) || add_runs(&finder, springs, 1);
  if (!whole || !pays(lanes, springs->count, particle_count)) lanes->count = 0;
  const int32_t status = new_arrays(particle_count, lanes);
  for (int64_t r = 0; r < springs->run_count && status == HOOKE_OK && lanes->count > 0; r++)
    take_over(&lanes->lane[finder.lane_of[r]], &springs->run[r]);
  if (status == HOOKE_OK && lanes->count > 0) hk_springs_drop_material(springs);
  if (status != HOOKE_OK) hk_lanes_release(lanes);
  hk_free(finder.lane_of);
  return status;
}

void hk_lanes_release(struct hk_lanes *lanes) {
  for (int32_t k = 0; k < lanes->count; k++) {
    hk_free(lanes->lane[k].present);
    hk_free(lanes->lane[k].kappas);
  }
  memset(lanes, 0, sizeof *lanes);
}
