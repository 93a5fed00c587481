/* The signed stiffness of a system at given positions, as a sparse matrix: K of M x'' + K x = 0 in unknowns y
 * whose mass matrix is the identity, three of each free particle that moves by itself and then those of
 * movers (model/coordinates). Unlike the linearised system of limits (linearised.h) nothing is clamped:
 * compressed springs push across, slack ones are 0, and bodies have all of what forces do to their turning.
 * Of forces that are not the gradient of an energy the symmetric part is taken; callbacks are left out, but
 * for what their forces do to bodies that turn. */
#pragma once

#include "integrate/solve/factor_cholmod.h"
#include "model/coordinates/body_tangent.h"
#include "model/sum/pattern.h"

struct hk_stiffness {
  const hooke_system *system;
  struct hk_body_tangents movers;
  int64_t count;  /* of unknowns */
  int64_t *first; /* of each particle, the first of its unknowns, or of those of its mover; -1: none */
  int32_t *width; /* of each particle, how many these are */
  double *turned; /* of a particle of a mover, 18: its displacement by these unknowns, in rows */
  struct hk_pattern pattern;
  double *block;            /* df/dq by the pattern [N/m] */
  double *still, *force;    /* 3n zeros; forces on all particles at rest, gravity among them [N] */
  struct hk_columns matrix; /* the upper triangle of K, every diagonal entry among it [1/s^2] */
  double bound;             /* of the magnitudes of all eigenvalues [1/s^2] */
  double skew;              /* the largest entry of df/dq minus its transpose, over its largest entry */
};

/* At rest at positions q (3n) at the time of system->moment. HOOKE_NO_MEMORY, HOOKE_STOPPED; HOOKE_BAD_VALUE
 * for what is not finite. */
int32_t hk_stiffness_create(const hooke_system *system, const double *q, struct hk_stiffness *stiffness);
void hk_stiffness_release(struct hk_stiffness *stiffness);

/* x = J y (3n, rows of x y z); and of one particle that has unknowns. */
void hk_stiffness_spread(const struct hk_stiffness *stiffness, const double *y, double *x);
void hk_stiffness_displace(const struct hk_stiffness *stiffness, int64_t particle, const double *y,
                           double x[3]);
/* x.Kx of what the forces on bodies do to their turning, of displacements x (3n). */
double hk_stiffness_of_turning(const struct hk_stiffness *stiffness, const double *x);
/* out = K y */
void hk_columns_multiply(const struct hk_columns *matrix, const double *y, double *out);

/* The upper triangle of the symmetric matrix of these entries, of which several may be at one place.
 * HOOKE_NO_MEMORY. */
struct hk_entry {
  int32_t row, column;
  double value;
};
int32_t hk_columns_make(int64_t size, int64_t count, const struct hk_entry *entry, struct hk_columns *matrix);
void hk_columns_release(struct hk_columns *matrix);

/* Of `count` motions without stiffness (rows of unknowns, orthonormal), how many are translations of a
 * connected piece as a whole, and how many other motions of one as a rigid body. HOOKE_NO_MEMORY. */
int32_t hk_stiffness_name_zeros(const struct hk_stiffness *stiffness, const double *q, int64_t count,
                                const double *zero, int64_t *translations, int64_t *rotations);
