/* Finds the lanes of a system: each run joins the earliest lane that keeps the order of sums. */
#include "model/lane.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* A pass reads every lane at every particle: with fewer springs than this share of that, plain runs are faster; and in a
 * system of few particles there is nothing to gain. */
static const double LEAST_FILLED = 0.3;
enum { LEAST_PARTICLES = 64, MOST_WINDOW = 1 << 18 };

struct finder {
  struct hooke_lanes *lanes;
  int64_t top[HOOKE_MOST_LANES]; /* the highest particle that a lane has reached */
  int32_t *lane_of;              /* of each run */
};

/* From the last lane backwards, past those that end below the run. */
static int32_t choose(const struct finder *finder, const struct hooke_run *run) {
  const struct hooke_lanes *lanes = finder->lanes;
  const int64_t low = hooke_run_low(run);
  for (int32_t k = lanes->count - 1; k >= 0; k--) {
    const struct hooke_lane *lane = &lanes->lane[k];
    if (lane->offset == labs((long)run->offset) && lane->last < low) return k;
    if (finder->top[k] >= low) break;
  }
  return lanes->count;
}

static int add_run(struct finder *finder, const struct hooke_run *run, int64_t number) {
  struct hooke_lanes *lanes = finder->lanes;
  const int32_t k = choose(finder, run);
  if (run->shape & HOOKE_RUN_INDEXED || k == HOOKE_MOST_LANES) return 0;
  struct hooke_lane *lane = &lanes->lane[k];
  if (k == lanes->count) {
    *lane = (struct hooke_lane){.offset = labs((long)run->offset), .first = hooke_run_low(run)};
    lanes->count++;
  }
  lane->last = hooke_run_high(run) - 1;
  lane->run_count++;
  finder->top[k] = lane->last + lane->offset;
  finder->lane_of[number] = k;
  return 1;
}

static int pays(const struct hooke_lanes *lanes, int64_t springs, int64_t particles) {
  int64_t window = 0, reached = 0;
  for (int32_t k = 0; k < lanes->count; k++) {
    window += lanes->lane[k].offset;
    reached += lanes->lane[k].last + lanes->lane[k].offset - lanes->lane[k].first;
  }
  return particles >= LEAST_PARTICLES && window <= MOST_WINDOW &&
         (double)springs >= LEAST_FILLED * (double)reached;
}

static void share_out_runs(const struct hooke_springs *springs, const int32_t *lane_of,
                           struct hooke_lanes *lanes) {
  const struct hooke_run **next = lanes->run;
  for (int32_t k = 0; k < lanes->count; k++) {
    lanes->lane[k].run = next;
    next += lanes->lane[k].run_count;
    lanes->lane[k].run_count = 0;
  }
  for (int64_t r = 0; r < springs->run_count; r++) {
    struct hooke_lane *lane = &lanes->lane[lane_of[r]];
    lane->run[lane->run_count++] = &springs->run[r];
  }
}

int32_t hooke_lanes_create(const struct hooke_springs *springs, int64_t particle_count,
                           struct hooke_lanes *lanes) {
  *lanes = (struct hooke_lanes){0};
  struct finder finder = {.lanes = lanes, .lane_of = hooke_new(springs->run_count, sizeof(int32_t))};
  if (finder.lane_of == NULL) return HOOKE_NO_MEMORY;
  int whole = 1;
  for (int64_t r = 0; r < springs->run_count && whole; r++)
    whole = add_run(&finder, &springs->run[r], r);
  if (whole && pays(lanes, springs->count, particle_count))
    lanes->run = hooke_new(springs->run_count, sizeof *lanes->run);
  else
    lanes->count = 0;
  if (lanes->run) share_out_runs(springs, finder.lane_of, lanes);
  hooke_free(finder.lane_of);
  return lanes->count > 0 && lanes->run == NULL ? HOOKE_NO_MEMORY : HOOKE_OK;
}

void hooke_lanes_release(struct hooke_lanes *lanes) {
  hooke_free(lanes->run);
  memset(lanes, 0, sizeof *lanes);
}
