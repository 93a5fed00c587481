/* The working copy of a state that forces are computed on: x, y and z apart, so that loops load whole
 * vectors. */
#ifndef HOOKE_MODEL_MOTION_H
#define HOOKE_MODEL_MOTION_H

#include "model/system.h"

struct hooke_force_row;
struct hooke_windows;

struct hooke_motion {
  int64_t n;
  double *q[3], *v[3], *f[3];    /* n each, in one block */
  double *rows;                  /* 9n: q, v and force in rows, for a callback; NULL without one */
  double *still;                 /* positions of pinned particles, 3 a held particle */
  double *driven;                /* q and v of each drive in turn, 3 a particle each */
  struct hooke_windows *windows; /* of the pass over lanes; NULL without lanes */
  int64_t memory;                /* bytes */
  int64_t coincident;            /* springs without direction in the last force evaluation */
  int32_t stop_value;            /* what a force or drive callback returned, 0 while all go on */
};

int32_t hooke_motion_create(const hooke_system *system, struct hooke_motion **motion);
void hooke_motion_destroy(struct hooke_motion *motion);

/* From and to rows of x y z. */
void hooke_motion_load(const hooke_system *system, struct hooke_motion *motion, const double *q,
                       const double *v);
void hooke_motion_store(const struct hooke_motion *motion, double *q, double *v);
/* Positions and velocities to and from `place`: 6 components of n each. */
void hooke_motion_save(const struct hooke_motion *motion, double *place);
void hooke_motion_restore(struct hooke_motion *motion, const double *place);
void hooke_rows_from_components(int64_t n, double *const component[3], double *rows);
void hooke_components_from_rows(int64_t n, const double *rows, double *const component[3]);

/* f = the sum of all forces at time t, gravity left out: a = w f + g. HOOKE_STOPPED if a callback asked for
 * it. */
int32_t hooke_motion_forces(const hooke_system *system, struct hooke_motion *motion, double t);
/* The same without one force of the table. */
int32_t hooke_motion_forces_without(const hooke_system *system, struct hooke_motion *motion, double t,
                                    const struct hooke_force_row *left_out);

/* Asks the drives where their particles are at time t; HOOKE_STOPPED if a callback asked for it. */
int32_t hooke_motion_drive(const hooke_system *system, struct hooke_motion *motion, double t);

/* Puts pinned particles back where they were loaded, at rest, and driven ones where the drives have last said. */
void hooke_motion_hold(const hooke_system *system, struct hooke_motion *motion);

#endif
