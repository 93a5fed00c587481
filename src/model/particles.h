/* The system as most of the library reads it: its particles, what acts on all of them, and where the rest is.
 * Whoever reads the rest includes its header. */
#pragma once

#include "hooke/system.h"

enum { HOOKE_IS_PINNED = 1, HOOKE_IS_DRIVEN = 2 };

/* A span of whole tiles of particles (HOOKE_TILE); the last tile is cut at the end. */
struct hk_span {
  int64_t from, count;
};

struct hooke_system {
  /* particles, 3 or 1 doubles each */
  int64_t particle_count;
  double *position, *velocity, *mass; /* velocity NULL from commit on if all are zero */
  uint8_t *constrained;               /* HOOKE_IS_* */
  double *inverse_mass;               /* from commit on: the inverse of `inertia`, 0 where constrained */

  int64_t constrained_count; /* from commit on: pinned and driven particles, ascending */
  int32_t *constrained_particle;
  int64_t idle_count; /* from commit on: pinned particles that nothing acts on */
  int64_t span_count; /* from commit on: spans that are stepped, ascending */
  struct hk_span *span;
  /* from commit on: pinned particles in these spans, restored after a step; ascending */
  int64_t pin_count;
  int32_t *pin;

  double gravity[3];
  int32_t has_gravity;
  double *gravity_factor; /* phi of every particle, with room for whole blocks after them; NULL: 1 */
  double drag;            /* of all particles; 0: none, or one of each (model/medium.h) */
  int32_t overdamped;     /* 1: gamma x' = f, with drag for gamma */
  /* From commit on: what forces and stiffnesses are divided by for a rate, the masses or gamma of every
   * particle; and drag, if it is one number without wind, and the acceleration by gravity: 0 in an overdamped
   * system, where they are gamma and a force. */
  double *inertia, brake, fall[3];
  int32_t falls;
  hooke_force *force;
  hooke_force_product *force_product;
  void *force_ctx;
  const double *force_scale;          /* factors of the callback's force, 3 a particle; NULL: 1 */
  struct hk_generalized *generalized; /* NULL unless it is a problem of coordinates (model/generalized.h) */

  int64_t group_count;
  struct hk_group *group;
  int64_t part_count;
  struct hk_part_record *part; /* part_count, in the order of adding */
  int64_t drive_count;
  struct hk_drive_group *drive;
  int32_t force_row_count; /* from commit on: the present forces */
  const struct hk_force_row **force_row;
  int32_t sums_after_drag; /* 1: some of them comes after drag in the sum */

  struct hk_springs *springs;         /* from commit on */
  struct hk_strided_batches *strided; /* from commit on, for all springs or none */
  struct hk_tiled *tiled;             /* the same, without strided batches */
  struct hk_altitudes *altitudes;     /* from commit on */
  struct hk_bodies *bodies;
  struct hk_medium *medium;
  /* from commit on: things that move by own coordinates (model/coordinates), how many numbers these are, and
   * 1 for each particle that moves with such a thing; NULL without */
  int64_t mover_count, own_count;
  struct hk_mover *mover;
  uint8_t *carried;

  struct hk_system_rest *rest; /* what few read (model/system.h) */
  double moment; /* time of the springs that an analysis of one state sees; 0 but in hk_system_at() */
  int32_t explicit_damping; /* 1: that analysis is of a verlet which takes damping explicitly */
  int32_t borrows; /* 1: by hooke_system_with_force(), all but what depends on its force is another's */
};

/* Acceleration by gravity of a particle along an axis. */
static inline double hk_fall(const hooke_system *system, int64_t particle, int axis) {
  const double *factor = system->gravity_factor;
  return factor ? factor[particle] * system->fall[axis] : system->fall[axis];
}

/* For analyses of a state of time t: good as long as the system is. */
static inline hooke_system hk_system_at(const hooke_system *system, double t) {
  hooke_system at = *system;
  at.moment = t;
  return at;
}

/* 1 if a particle moves with a thing that has coordinates of its own. */
static inline int32_t hk_is_carried(const hooke_system *system, int64_t particle) {
  return system->carried && system->carried[particle];
}
