/* The working copy of a state that forces are computed on: x, y and z apart, so that loops load whole
 * vectors. Particles have the caller's numbers, or, where a method moves them tile by tile as soon as the
 * springs of a tile are summed, the working numbers of the system's tiled batch. */
#ifndef HOOKE_MODEL_SUM_MOTION_H
#define HOOKE_MODEL_SUM_MOTION_H

#include "core/thread_pool.h"
#include "model/system.h"

struct hk_force_row;
struct hk_rings;
struct hk_tiled_scratch;

struct hk_motion {
  int64_t n;
  struct hk_pool *pool;       /* that goes over tiles; NULL: the caller alone */
  double *q[3], *v[3], *f[3]; /* n each, in one block; f NULL if particles are moved by tiles */
  const int32_t *order;       /* particle that has a working number; NULL: numbers are the caller's */
  int32_t *number;            /* the other way; NULL until hk_motion_know_numbers() */
  const double *w;            /* inverse masses */
  double *rows;               /* 9n: q, v and force in rows, for a callback; NULL without one */
  double *still;              /* positions of anchored particles, 3 each */
  double *driven;             /* q and v of each drive in turn, 3 a particle each */
  int32_t *anchor,
      *moved; /* numbers here of the anchored particles of the system, and of those of its drives in turn */
  struct hk_rings *rings;         /* of the pass over strided batches; NULL without strided batches */
  struct hk_tiled_scratch *tiled; /* of the pass over a tiled batch; NULL without one */
  int64_t memory;                 /* bytes */
  int64_t coincident;             /* springs without direction in the last force evaluation */
  int32_t stop_value;             /* what a force or drive callback returned, 0 while all go on */
};

/* 1 if the forces on a tile of particles can be known before the rest of the motion is. */
int32_t hk_goes_by_tiles(const hooke_system *system);

/* How many threads of up to `most` the passes over the particles of a system are worth. */
int32_t hk_motion_members(const hooke_system *system, int32_t most);

/* With `by_tiles` the motion may be moved by hk_motion_pass() alone; only for systems that go by tiles. The
 * pool (NULL: none) has to outlive the motion. */
int32_t hk_motion_create(const hooke_system *system, int32_t by_tiles, struct hk_pool *pool,
                         struct hk_motion **motion);
void hk_motion_destroy(struct hk_motion *motion);

/* From and to rows of x y z. */
void hk_motion_load(const hooke_system *system, struct hk_motion *motion, const double *q, const double *v);
void hk_motion_store(const struct hk_motion *motion, double *q, double *v);
/* What the motion has and what the rows have change places. */
void hk_motion_exchange(struct hk_motion *motion, double *q, double *v);
/* 1 if the motion is there, to the bit. */
int32_t hk_motion_is_at(const struct hk_motion *motion, const double *q, const double *v);
/* Has hk_motion_number() and hk_motion_place() know the caller's numbers. HOOKE_NO_MEMORY. */
int32_t hk_motion_know_numbers(struct hk_motion *motion);
/* The number here of a particle of the caller. */
int64_t hk_motion_number(const struct hk_motion *motion, int64_t particle);
/* Puts a particle of the caller at q, with v (NULL: as it is), for good if it is pinned. */
void hk_motion_place(const hooke_system *system, struct hk_motion *motion, int64_t particle, const double *q,
                     const double *v);
/* Positions and velocities to and from `place`: 6 components of n each. */
void hk_motion_save(const struct hk_motion *motion, double *place);
void hk_motion_restore(struct hk_motion *motion, double *place);
void hk_rows_from_components(int64_t n, double *const component[3], double *rows);
void hk_components_from_rows(int64_t n, const double *rows, double *const component[3]);

/* f = the sum of all forces at time t, gravity left out: a = w f + g. HOOKE_STOPPED if a callback asked for
 * it. */
int32_t hk_motion_forces(const hooke_system *system, struct hk_motion *motion, double t);
/* The same without one force of the table. */
int32_t hk_motion_forces_without(const hooke_system *system, struct hk_motion *motion, double t,
                                 const struct hk_force_row *left_out);

/* Sums the springs at all particles in one pass over memory, and does with the sums what `move` says; only
 * for systems with strided batches or a tiled batch, and to move particles only for motions that go by tiles.
 * */
void hk_motion_pass(const hooke_system *system, struct hk_motion *motion, const struct hk_move *move);

/* Asks the drives where their particles are at time t; HOOKE_STOPPED if a callback asked for it. */
int32_t hk_motion_drive(const hooke_system *system, struct hk_motion *motion, double t);

/* Puts pinned particles back where they were loaded, at rest, and driven ones where the drives have last
 * said. */
void hk_motion_hold(const hooke_system *system, struct hk_motion *motion);

#endif
