/* Lanes: how the forces of a whole system are summed in one pass over the particles.
 *
 * A lane is made of runs of one constant offset o > 0 whose lower ends ascend: spring l joins particles l and l + o. Lanes
 * are in an order in which the springs of every particle, taken lane by lane and in each lane the one that ends there before
 * the one that begins there, come in ascending spring number, so that sums have the bits of the plain order. The pass goes
 * over tiles of particles: forces of the springs that begin in a tile go into one window a lane, which reaches back by o,
 * and are then summed. Nothing looks at the particles of a tile after that, so its positions may move at once. */
#ifndef HOOKE_MODEL_LANE_H
#define HOOKE_MODEL_LANE_H

#include "model/spring.h"

enum { HOOKE_MOST_LANES = 32, HOOKE_TILE = 256 };

struct hooke_lane {
  int64_t offset, first, last; /* last: lower end of the last spring */
  int64_t run_count;
  const struct hooke_run **run;
};

/* `count` 0: the springs do not form lanes, or too few of them for lanes to pay. */
struct hooke_lanes {
  int32_t count;
  struct hooke_lane lane[HOOKE_MOST_LANES];
  const struct hooke_run **run; /* of all lanes */
};

/* The windows of one pass at a time, for systems with lanes. */
struct hooke_windows;

struct hooke_motion;
struct hooke_system;

/* Sums over `count` particles from `from` on are in f; may move these particles. */
typedef void hooke_tile(int64_t from, int64_t count, double *const f[3], void *ctx);

/* HOOKE_NO_MEMORY. The runs have to outlive the lanes. */
int32_t hooke_lanes_create(const struct hooke_springs *springs, int64_t particle_count,
                           struct hooke_lanes *lanes);
void hooke_lanes_release(struct hooke_lanes *lanes);

/* NULL without memory. */
struct hooke_windows *hooke_windows_create(const struct hooke_lanes *lanes);
void hooke_windows_destroy(struct hooke_windows *windows);
int64_t hooke_windows_memory(const struct hooke_windows *windows);

/* One pass over the particles of `motion` that are stepped, by the lanes of the system; returns how many springs had a rest length but no direction. */
int64_t hooke_lanes_pass(const struct hooke_system *system, struct hooke_motion *motion, hooke_tile *tile,
                         void *ctx);

#endif
