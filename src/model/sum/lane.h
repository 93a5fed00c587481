/* Lanes: how the forces of a whole system are summed in one pass over the particles.
 *
 * A lane is made of runs of one constant offset o > 0 whose lower ends ascend: spring l joins particles l and
 * l + o. Lanes are in an order in which the springs of every particle, taken lane by lane and in each lane
 * the one that ends there before the one that begins there, come in ascending spring number, so that sums
 * have the bits of the plain order. The pass goes over the particles once; kernel/lane_loops.h says how. */
#ifndef HOOKE_MODEL_SUM_LANE_H
#define HOOKE_MODEL_SUM_LANE_H

#include "kernel/lane_loops.h"
#include "model/force/spring.h"

enum { HOOKE_TILE = 256 };

struct hk_lane {
  int64_t offset, first, last;            /* lower ends of the first spring and the last */
  int32_t shape;                          /* HOOKE_RUN_*, never indexed */
  uint8_t *present;                       /* a bit for each particle: whether a spring begins there */
  double kappa, gamma, rest_length;       /* shared */
  double *kappas, *gammas, *rest_lengths; /* mixed: from the unit of `first` on, to that of `last` */
};

/* `count` 0: the springs do not form lanes, or too few of them for lanes to pay. */
struct hk_lanes {
  int32_t count;
  int64_t reach; /* the largest offset, in whole units */
  struct hk_lane lane[HOOKE_MOST_LANES];
  int64_t memory;
};

/* HOOKE_NO_MEMORY. Material that is stored one by one goes from the springs to the lanes, where the runs then
 * have it. */
int32_t hk_lanes_create(struct hk_springs *springs, int64_t particle_count, struct hk_lanes *lanes);
void hk_lanes_release(struct hk_lanes *lanes);

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
