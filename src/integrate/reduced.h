/* The linear equations of an implicit step, (M - beta df/dv - alpha df/dq) x = b over the free particles.
 *
 * Products are exact. The equations are scaled by a symmetric positive definite S on the diagonal, one 3x3 block a
 * particle (block Jacobi): M, drag, alpha c (1, 4, 1) of each triple of bending, and of each spring (alpha kappa + beta gamma) u u^T + max(0, alpha T/r) (I - u u^T).
 * With S = L L^T what is iterated on is L^-1 (...) L^-T, whose residual weighs particles by their mass. */
#ifndef HOOKE_INTEGRATE_REDUCED_H
#define HOOKE_INTEGRATE_REDUCED_H

#include "integrate/integrator.h"
#include "integrate/krylov.h"
#include "kernel/tangent_loops.h"

struct hooke_reduced {
  hooke_integrator *integrator;
  int32_t symmetric;   /* alpha = 0, and springs, bending and drag alone */
  int32_t rows_needed; /* some force is none of springs, bending and drag */
  double t, alpha, beta;
  struct hooke_tangent tangent;
  double *diagonal;                /* n: m + beta c */
  double *factor;                  /* 6 n: L^-1, zero where a particle is held */
  double *right, *unknown, *place; /* 3n each: L^-1 b, L^T x, x */
  double *krylov;
  double *rows; /* q, v, dq, dv and a product, in rows of x y z */
};

/* `symmetric`: for alpha = 0 and with callbacks left out, by conjugate gradients; else by BiCGSTAB(4). Its memory is
 * counted as the method's. */
int32_t hooke_reduced_create(hooke_integrator *integrator, int32_t symmetric, struct hooke_reduced *reduced);
void hooke_reduced_release(struct hooke_reduced *reduced);

/* Derivatives at the place of the integrator's motion; t is for callbacks. */
void hooke_reduced_set(struct hooke_reduced *reduced, double t, double alpha, double beta);

/* x = the solution for b (3n each, x y z apart), 0 where a particle is held; `converged` is 0 if `tolerance` was not
 * reached. Iterations and products are counted. HOOKE_STOPPED if a callback asked for it. */
int32_t hooke_reduced_solve(struct hooke_reduced *reduced, const double *b, double tolerance, double *x,
                            struct hooke_solution *solution);

/* By conjugate gradients, as far as `tolerance` or to where the matrix proves not to be positive: a direction with
 * b.x > 0. For corrections far from a solution. */
int32_t hooke_reduced_descend(struct hooke_reduced *reduced, const double *b, double tolerance, double *x);

/* HOOKE_SOLVER_FAILED, with the message, for a solution that did not converge. */
int32_t hooke_reduced_fail(const struct hooke_reduced *reduced, const struct hooke_solution *solution);

/* out = (df/dq) dq + (df/dv) dv of all forces at the place of the last set; 3n each, x y z apart. */
int32_t hooke_reduced_change(struct hooke_reduced *reduced, const double *dq, const double *dv, double *out);

#endif
