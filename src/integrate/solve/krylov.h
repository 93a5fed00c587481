/* Krylov iterations for A x = b, from x = 0, with products of A alone. A should be near the identity: the
 * caller has to scale it. The norm is the Euclidean one. */
#pragma once

#include <stdint.h>

/* out = A x, `size` numbers each; returns a status. */
struct hk_operator {
  int64_t size;
  int32_t (*apply)(void *ctx, const double *x, double *out);
  void *ctx;
};

/* Scratch vectors that each of them needs. */
enum {
  HOOKE_SYMMETRIC_VECTORS = 3,
  HOOKE_GENERAL_SWEEP = 4,
  HOOKE_GENERAL_VECTORS = 2 * HOOKE_GENERAL_SWEEP + 3,
  HOOKE_MINIMAL_SPACE = 30,
  HOOKE_MINIMAL_VECTORS = HOOKE_MINIMAL_SPACE + 1
};

struct hk_solution {
  int32_t converged;
  int64_t iterations;
  double residual; /* relative to b; for the general solver the true one, b - A x */
};

/* Conjugate gradients (Hestenes and Stiefel 1952), for a symmetric positive definite A. Returns a status:
 * HOOKE_OK with `converged` 0 if it did not converge within `limit` iterations. Non-finite numbers are
 * returned in x. For an A that is not positive it ends at the first direction that shows it (Steihaug 1983),
 * with b.x > 0. */
int32_t hk_solve_symmetric(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                           double *scratch, double *x, struct hk_solution *solution);

/* The same for a known size of error: until |x - solution|_A, in the norm of A, is below `absolute` or below
 * `relative` times that of x, as far as the last few iterations tell (Hestenes and Stiefel 1952; Strakos and
 * Tichy 2002), or rounding allows no more. Products of vectors are sums over tiles of 256 particles, each of
 * x, y and z, one after the other, so that whoever has some of the tiles comes to the same bits. */
int32_t hk_solve_positive(const struct hk_operator *a, const double *b, double relative, double absolute,
                          int64_t limit, double *scratch, double *x, struct hk_solution *solution);

/* BiCGSTAB(4) (Sleijpen and Fokkema 1993), for any A that is not singular: two products an iteration. Not
 * converged also where rounding allows no smaller residual; `residual` tells. */
int32_t hk_solve_general(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                         double *scratch, double *x, struct hk_solution *solution);

/* GMRES (Saad and Schultz 1986), restarted each time that its space is full: the smallest residual for so
 * many products, for few of them. `tolerance` is absolute, and so is `residual`. */
int32_t hk_solve_minimal(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                         double *scratch, double *x, struct hk_solution *solution);
