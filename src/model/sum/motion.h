/* The working copy of a state for computing forces: x, y and z apart, so that loops load whole vectors.
 * Particles have the caller's numbers or, for a method that moves them tile by tile as soon as the springs of
 * a tile are summed, the working numbers of the system's tiled batch. */
#pragma once

#include "core/thread_pool.h"
#include "kernel/move_loops.h"
#include "kernel/spring/spring_body.h"
#include "model/particles.h"

struct hk_rings;
struct hk_tiled_scratch;

struct hk_motion {
  int64_t n;
  struct hk_pool *pool;       /* that goes over tiles; NULL: the caller alone */
  double *q[3], *v[3], *f[3]; /* n each, a stride apart in one block; f NULL if no move keeps forces */
  const int32_t *order;       /* particle that has a working number; NULL: numbers are the caller's */
  int32_t *number;            /* the other way; NULL until hk_motion_know_numbers() */
  const double *w;            /* inverse masses */
  const double *zero;         /* n zeros: forces are without damping, drag included; NULL: with it */
  double *rows;               /* 9n: q, v and force in rows, for a callback; NULL without one */
  double *still;              /* positions of anchored particles, 3 each */
  int64_t drive_count;
  double **driven; /* rows of each drive: q and v, 3 a particle each */
  int32_t *pin,
      *moved; /* numbers here of the anchored particles of the system, and of those of its drives in turn */
  struct hk_rings *rings;         /* of the pass over strided batches; NULL without strided batches */
  struct hk_tiled_scratch *tiled; /* of the pass over a tiled batch; NULL without one */
  int64_t memory;                 /* bytes */
  int64_t coincident;             /* coincident springs in the last force evaluation */
  int32_t near_zero;              /* 1: a spring was shorter than half its rest length, as far as was asked */
  int32_t stop_value;             /* value of a force or drive callback, 0 while all go on */
};

/* 1 if the forces on a tile of particles can be known before the rest of the motion is. */
int32_t hk_goes_by_tiles(const hooke_system *system);

/* Number of threads, up to `most`, that pay for the passes over the particles of a system. */
int32_t hk_motion_members(const hooke_system *system, int32_t most);

/* How a motion is made: only hk_motion_pass() moves it, and only for systems that go by tiles; and, if so,
 * with forces that moves keep. */
enum { HOOKE_MOTION_BY_TILES = 1, HOOKE_MOTION_KEEPS = 2 };

/* The pool (NULL: none) must outlive the motion. */
int32_t hk_motion_create(const hooke_system *system, int32_t how, struct hk_pool *pool,
                         struct hk_motion **motion);
void hk_motion_destroy(struct hk_motion *motion);

/* Between the components of q, v and f. */
static inline ptrdiff_t hk_motion_stride(const struct hk_motion *motion) {
  return motion->q[1] - motion->q[0];
}

/* From and to rows of x y z. */
void hk_motion_load(const hooke_system *system, struct hk_motion *motion, const double *q, const double *v);
void hk_motion_store(const struct hk_motion *motion, double *q, double *v);
/* Exchanges the contents of the motion and the rows. */
void hk_motion_exchange(struct hk_motion *motion, double *q, double *v);
/* 1 if the motion equals the rows, to the bit. */
int32_t hk_motion_is_at(const struct hk_motion *motion, const double *q, const double *v);
/* Prepares hk_motion_number() and hk_motion_place(), which take the caller's numbers. HOOKE_NO_MEMORY. */
int32_t hk_motion_know_numbers(struct hk_motion *motion);
/* Working number of a particle of the caller. */
int64_t hk_motion_number(const struct hk_motion *motion, int64_t particle);
/* Moves a particle of the caller to q, with v (NULL: unchanged), permanently if it is pinned. */
void hk_motion_place(const hooke_system *system, struct hk_motion *motion, int64_t particle, const double *q,
                     const double *v);
/* Positions and velocities to and from `slot`: 6 components of n each. */
void hk_motion_save(const struct hk_motion *motion, double *slot);
void hk_motion_restore(struct hk_motion *motion, double *slot);
void hk_rows_from_components(int64_t n, double *const component[3], double *rows);
void hk_components_from_rows(int64_t n, const double *rows, double *const component[3]);

/* Keeps how short the springs of a force evaluation are (kernel/spring/spring_body.h). */
static inline void hk_motion_keep_short(struct hk_motion *motion, int64_t shortness) {
  motion->coincident = shortness / HOOKE_LOST;
  motion->near_zero |= shortness != 0;
}

/* f = the sum of all forces at time t, without gravity: a = w f + g. HOOKE_STOPPED if a callback asked for
 * it. */
int32_t hk_motion_forces(const hooke_system *system, struct hk_motion *motion, double t);
/* The same without the forces of these kinds. */
int32_t hk_motion_forces_without(const hooke_system *system, struct hk_motion *motion, double t,
                                 int32_t left_out);

/* Sums the springs of time t, and the triples in strided batches, at all particles in one pass over memory,
 * and uses the sums as `move` says; only for systems with strided batches or a tiled batch, and moving
 * particles only for motions that go by tiles. */
void hk_motion_pass(const hooke_system *system, struct hk_motion *motion, double t,
                    const struct hk_move *move);
/* What moves outside a pass move. */
struct hk_moved hk_motion_moved(const struct hk_motion *motion);

/* Calls the drives for the positions of their particles at time t; HOOKE_STOPPED if a callback asked for it.
 */
int32_t hk_motion_drive(const hooke_system *system, struct hk_motion *motion, double t);

/* Restores pinned particles to their loaded positions, at rest, and driven ones to the last result of the
 * drives. */
void hk_motion_hold(const hooke_system *system, struct hk_motion *motion);
