/* The linear equations of an implicit step, (M - beta df/dv - alpha df/dq) x = b over the free particles.
 *
 * Products are exact. The equations are scaled by a symmetric positive definite S: M, drag, of each spring
 * (alpha kappa + beta gamma) u u^T + max(0, alpha T/r) (I - u u^T), and of every other element alpha K + beta
 * C, clamped likewise; by its 3x3 blocks on the diagonal (block Jacobi), or by all of it
 * (integrate/solve/factor.h). With S = L L^T the iteration uses L^-1 (...) L^-T, whose residual weighs
 * particles by their mass. */
#pragma once

#include "integrate/solve/factor.h"
#include "integrate/integrator.h"
#include "integrate/solve/krylov.h"
#include "kernel/spring/tangent_loops.h"

/* What is asked: iterations by BiCGSTAB(4), to rounding; by conjugate gradients, for alpha = 0 and with
 * callbacks left out, where forces are linear in velocities; by GMRES, for few of them. The first reads the
 * option `linear_solver`, whose `auto` and `blocks` are by blocks, in every build. */
enum { HOOKE_REDUCED_GENERAL, HOOKE_REDUCED_SYMMETRIC, HOOKE_REDUCED_MINIMAL };

enum { HOOKE_WHOLE_UNKNOWN, HOOKE_WHOLE_READY, HOOKE_WHOLE_IN_USE, HOOKE_WHOLE_NONE };

/* Unknowns beyond those of particles, behind them in all vectors, with their own part of the factor and with
 * the matrix of all, of which `projected` says which. */
struct hk_more_unknowns {
  int64_t count;
  int32_t (*multiply)(void *ctx, const double *x, double *out);
  void (*divide)(void *ctx, double *x), (*divide_transposed)(void *ctx, double *x); /* of their part */
  void *ctx;
};

struct hk_reduced {
  hooke_integrator *integrator;
  struct hk_more_unknowns more;
  int64_t size;        /* of vectors: 3n, and more */
  int32_t symmetric;   /* alpha = 0, and springs, bending, altitude springs and drag alone */
  int32_t direct;      /* by the option `linear_solver`, if it fits: a factor of S at every place */
  int32_t supernodal;  /* that factor may be supernodal */
  int32_t projected;   /* 1: S stands for the matrix */
  int32_t rows_needed; /* the products of some force are made by its own function, in rows */
  double t, alpha, beta;
  struct hk_tangent tangent;
  int64_t element_count;      /* of forces other than springs with variable K and C */
  struct hk_element *element; /* clamped */
  double *diagonal;           /* n: m + beta c */
  double *block;              /* 6 n: diagonal blocks of S, zero where a particle is constrained */
  double *factor;             /* 6 n: L^-1 of these */
  struct hk_factor *whole;    /* of all of S; NULL: not requested, too large, not built */
  int32_t whole_state;        /* HOOKE_WHOLE_* */
  const double *weight;       /* of the norm of the minimal one */
  double *right, *unknown, *place, *moved; /* L^-1 b, L^T x, x, scratch */
  double *krylov;
  double *rows; /* q, v, dq, dv and a product, in rows of x y z */
};

/* Maximum numbers of a factor that is computed: 2 GB. */
enum { HOOKE_MOST_NUMBERS = 100000000 };

/* `more` may be NULL. Its memory is counted as the method's, with that for the analysis of a factor. */
int32_t hk_reduced_create(hooke_integrator *integrator, int32_t kind, const struct hk_more_unknowns *more,
                          struct hk_reduced *reduced);
void hk_reduced_release(struct hk_reduced *reduced);

/* Sets the derivatives at the position of the integrator's motion; t is for callbacks. */
void hk_reduced_set(struct hk_reduced *reduced, double t, double alpha, double beta);

/* x = the solution for b (of particles x y z apart), 0 where a particle is constrained; `converged` is 0 if
 * `tolerance` was not reached. Iterations and products are counted. HOOKE_STOPPED if a callback asked for it.
 * */
int32_t hk_reduced_solve(struct hk_reduced *reduced, const double *b, double tolerance, double *x,
                         struct hk_solution *solution);

/* Makes ready for factors of all of S, once; HOOKE_OK without `whole` where they would be too large, and
 * in a build without CHOLMOD. */
int32_t hk_reduced_prepare_whole(struct hk_reduced *reduced);
/* Factorises S where it was last set; solutions are scaled by it until it is dropped. 1; 0 if it is not
 * positive; HOOKE_NO_MEMORY. */
int32_t hk_reduced_factorise(struct hk_reduced *reduced);
void hk_reduced_drop_factor(struct hk_reduced *reduced);

/* out = M (b_v + b_q/beta) - D b_q: the right-hand side of an implicit equation in z = dv + b_q/beta where
 * dq - beta dv = b_q and M (dv - beta (W K dq + W D dv)) = M b_v, for alpha = beta^2; then dq = beta z. */
int32_t hk_reduced_right(struct hk_reduced *reduced, const double *bq, const double *bv, double *out);

/* By GMRES until |weight . r| <= tolerance for the scaled residual r = S^-1 (b - A x), which is near the
 * error of x. */
int32_t hk_reduced_minimise(struct hk_reduced *reduced, const double *b, const double *weight,
                            double tolerance, int64_t limit, double *x, struct hk_solution *solution);

/* x = S^-1 b, until its error in the norm of S is below `relative` times x or `absolute`, by conjugate
 * gradients or by the factor; b.x > 0. S takes the place of the matrix until the next set: the matrix with
 * all of it that is not symmetric or positive left out, element by element, but for this share of what
 * compression takes from springs sideways. With a share S may be not positive; `converged` is 0 where it
 * proves so. */
int32_t hk_reduced_correct(struct hk_reduced *reduced, double share, const double *b, double relative,
                           double absolute, double *x, struct hk_solution *solution);
/* b.B^-1 b with the diagonal blocks B of S. */
double hk_reduced_square(struct hk_reduced *reduced, const double *b);
/* The sum of the diagonal of S. */
double hk_reduced_trace(const struct hk_reduced *reduced);

/* out = the matrix times x, which is 0 where a particle is constrained. */
int32_t hk_reduced_multiply(struct hk_reduced *reduced, const double *x, double *out);

/* out = (df/dq) dq + (df/dv) dv of all forces at the last set position; 3n each, x y z apart. */
int32_t hk_reduced_change(struct hk_reduced *reduced, const double *dq, const double *dv, double *out);
