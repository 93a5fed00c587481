/* A system linearised at given positions, at rest, as a system of real springs, so that every integrator runs
 * on it with its own loops, including implicit treatment of spring damping.
 *
 * The scene is enlarged: positions times a factor, about the middle, until the shortest spring is 1e5 to 1e9
 * m long, and displacements are of the order of 1 m. Springs then turn by 1e-5 or less, so the motion is
 * linear; and rounding of positions, 1e-16 of the extent, stays as far below the displacements. (Equally
 * small displacements of the original scene would be the same in principle; but rest lengths have to be set
 * anew anyway, and numbers about 1 are simpler.) A spring keeps kappa and gamma; its rest length l0/r of its
 * new length keeps tension over length, the stiffness across. A compressed one is clamped: its rest length is
 * its length. One that only pulls counts as taut. Those between the same ends may be one. One of length 0,
 * stiff and damped in all directions, one with a curve, and the elements of other forces are linear ones
 * (force_linear.c). A
 * constant force balances the tensions. Gravity and callbacks are left out, driven particles are pinned.
 * Rigid bodies that move are rigid bodies, their geometric stiffness (rigid.h) a part of the force that
 * balances. */
#pragma once

#include "measure/spectrum/linearised.h"

struct hk_twin {
  hooke_system *system;     /* committed */
  struct hk_linearised lin; /* of the original, which has the same K, C and M; the matrix of products is K */
  double *origin;           /* its rest positions, 3n */
  double *balance;          /* the constant force, 3n */
  double *moved;            /* scratch, 6n */
  /* clamped, with a free particle: springs of no length, and those of other forces but springs and drag */
  struct hk_element *element;
};

/* `q`: 3n positions of a committed system, which has to exist as long as the twin. HOOKE_BAD_VALUE,
 * HOOKE_NO_MEMORY. */
int32_t hk_twin_create(const hooke_system *system, const double *q, const double *v, struct hk_twin *twin);
void hk_twin_release(struct hk_twin *twin);

/* Twice the energy of the displacement from `origin` and the velocity (3n each): x.Kx + v.Mv. */
double hk_twin_energy(const struct hk_twin *twin, const double *q, const double *v);

/* out = M^-1 (t^2 K + t C) x, 3n each, t being the slow step: projects any x onto motion that springs and
 * drag act on. */
void hk_twin_push(struct hk_twin *twin, const double *x, double *out);
