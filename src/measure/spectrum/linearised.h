/* A system linearised at given positions, at rest: M x'' + C x' + K x = 0 over the free particles.
 *
 *   K = sum of kappa u u^T + max(0, T/r) (I - u u^T)     C = sum of gamma u u^T, plus drag
 *
 * each in the pattern (B, -B; -B, B) over the ends of a spring; and the elements of all other forces
 * (element.h). A compressed spring is clamped: its stiffness across, which is negative, counts as 0. A spring
 * that only pulls counts as taut; one of no length as stiff and damped in all directions. Particles of a
 * rigid body move as one (rigid.h).
 *
 * Vectors are displacements of all particles, x, y and z apart (3n), 0 where a particle is constrained.
 * Eigenvalues come in units of `rate`, a bound of the fastest motion, so that neither stiffness nor masses
 * overflow: K is divided by rate^2, C by rate. */
#pragma once

#include "kernel/spring/tangent_loops.h"
#include "measure/spectrum/rigid.h"
#include "measure/trial/budget.h"
#include "model/force/force.h"

struct hk_linearised {
  const hooke_system *system;
  int64_t size;              /* 3n */
  int64_t unknowns;          /* three a free particle in no body, and those of bodies */
  double rate;               /* [1/s] */
  double slow_step;          /* a step [s] of the order of the fastest motion; infinity: none */
  int64_t clamped, products; /* clamped springs; products with K and C so far */
  int32_t across_any, damped;
  int32_t points_damped;  /* some spring of no length is damped, in all directions */
  int32_t bends;          /* some force with constant K and C moves something */
  double *mass, *inverse; /* n; the inverse is 0 where a particle is constrained */
  /* springs: by number, or in the order of batches, in one run of our own */
  int64_t run_count;
  const struct hk_run *run;
  struct hk_run own;
  int32_t *ends;                         /* of that */
  double *u[3], *kappa, *across, *gamma; /* over rate^2 and rate */
  double drag;                           /* over rate */
  struct hk_rigid rigid;                 /* in units of the system */
  double spin;                           /* largest angular velocity of a body, over rate */
  double unit_k, unit_c;                 /* 1 over rate^2 and rate: of forces with constant K and C */
  /* of other forces, and of springs with curves: elements that move something, over rate^2 and rate */
  int64_t element_count;
  struct hk_element *element;
  /* a K + b C, from the last hk_linearised_combine() */
  struct hk_tangent tangent;
  double *g[3], *g_across, brake, constant_k, constant_c;
  double *along, *beside; /* of each element: its coefficients along and across */
  /* set by the owner of a search for eigenvalues: budget that ends it with HOOKE_STOPPED (NULL: none); and
   * bytes that a basis may take (0: the default) */
  struct hk_budget *budget;
  double memory;
};

/* Maximum memory [bytes], including that of a search for the largest eigenvalue. */
double hk_linearised_bytes(const hooke_system *system);

/* At positions q (3n). Velocities (3n, on which only `spin` and what is not linear in them depend), factors
 * on kappa and gamma, one a spring, and on masses (n; 1 in a body) may be NULL. HOOKE_BAD_VALUE for
 * non-finite numbers; HOOKE_NO_MEMORY. */
int32_t hk_linearised_create(const hooke_system *system, const double *q, const double *v,
                             const double *spring_scale, const double *mass_scale,
                             struct hk_linearised *linearised);
void hk_linearised_release(struct hk_linearised *linearised);

/* Sets the matrix of products to a K + b C; a, b >= 0. */
void hk_linearised_combine(struct hk_linearised *linearised, double a, double b);

/* out += (a K + b C) x; values at constrained particles are undefined. In a body these are the masses times
 * the accelerations that the forces make. */
void hk_linearised_add_product(struct hk_linearised *linearised, const double *x, double *out);

/* out = M^-1 (a K + b C) x. */
void hk_linearised_multiply(struct hk_linearised *linearised, const double *x, double *out);

/* The symmetric matrix M^-1/2 (a K + b C) M^-1/2 over the unknowns, in rows. HOOKE_NO_MEMORY. */
int32_t hk_linearised_assemble(struct hk_linearised *linearised, double *matrix);

/* x.(a K + b C) x */
double hk_linearised_energy(const struct hk_linearised *linearised, const double *x);

/* x.My */
double hk_linearised_dot(const struct hk_linearised *linearised, const double *x, const double *y);

/* x = a start for iterations, always the same: numbers between -1 and 1, 0 at constrained particles. */
void hk_linearised_start(const struct hk_linearised *linearised, double *x);

/* x becomes the nearest motion in which bodies are rigid. */
void hk_linearised_project(const struct hk_linearised *linearised, double *x);

/* The unknowns are the components of the free particles in turn, times the root of their masses (`unknowns`
 * long), then those of bodies (rigid.h). */
void hk_linearised_pack(const struct hk_linearised *linearised, const double *x, double *unknown);
void hk_linearised_unpack(const struct hk_linearised *linearised, const double *unknown, double *x);
