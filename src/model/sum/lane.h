/* Lanes: how the forces of a whole system are summed in one pass over the particles.
 *
 * A lane is made of springs of one offset o > 0, one at most from each particle: spring l joins particles l
 * and l + o. A particle sees a lane as two items, the springs that end there and those that begin there. The
 * items of all lanes are in one order in which the springs of every particle come in ascending spring number,
 * so that sums have the bits of the plain order. The pass goes over the particles once;
 * kernel/lane_loops.h says how. */
#ifndef HOOKE_MODEL_SUM_LANE_H
#define HOOKE_MODEL_SUM_LANE_H

#include "kernel/lane_loops.h"
#include "model/force/spring.h"

enum { HOOKE_TILE = 256, HOOKE_MOST_ITEMS = 2 * HOOKE_MOST_LANES };

struct hk_lane {
  int64_t offset, first, last; /* the lowest and the highest lower end */
  int32_t shape;               /* HOOKE_RUN_*, never indexed */
  uint8_t *present;            /* a bit for each particle: whether a spring begins there */
};

/* `count` 0: the springs do not form lanes, or too few of them for lanes to pay. */
struct hk_lanes {
  int32_t count;
  int64_t reach; /* the largest offset, in whole units */
  struct hk_lane lane[HOOKE_MOST_LANES];
  struct hk_lane_material material[HOOKE_MOST_LANES];
  uint8_t item[HOOKE_MOST_ITEMS]; /* in the order of sums: 2 k the ends of lane k, 2 k + 1 its beginnings */
  uint8_t *lane_of;               /* of each spring; NULL if no run looks its material up */
  int64_t memory;
};

/* HOOKE_NO_MEMORY. Material that is stored one by one goes from the springs to the lanes, where the runs then
 * look it up. */
int32_t hk_lanes_create(struct hk_springs *springs, int64_t particle_count, struct hk_lanes *lanes);
void hk_lanes_release(struct hk_lanes *lanes);

/* The part of it that takes the material over, from lanes that are there. HOOKE_NO_MEMORY. */
int32_t hk_lanes_take_material(struct hk_springs *springs, int64_t particle_count, struct hk_lanes *lanes);

/* Rings of one pass at a time by `workers` threads, for systems with lanes; NULL without memory. */
struct hk_rings;
struct hk_rings *hk_rings_create(const struct hk_lanes *lanes, int32_t workers);
void hk_rings_destroy(struct hk_rings *rings);
int64_t hk_rings_memory(const struct hk_rings *rings);

struct hk_motion;
struct hooke_system;

/* One pass over the particles of `motion` that are stepped; returns how many springs had a rest length but no
 * direction. */
int64_t hk_lanes_pass(const struct hooke_system *system, struct hk_motion *motion,
                      const struct hk_move *move);

#endif
