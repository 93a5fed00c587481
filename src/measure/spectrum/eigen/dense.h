/* Dense eigenvalues, by LAPACK; all return HOOKE_NOT_BUILT without it, and HOOKE_NO_MEMORY. Matrices are in
 * rows. */
#pragma once

#include <stdint.h>

/* Eigenvalues of a symmetric n x n matrix, which is destroyed, the largest first; `vector` (n rows, one a
 * value, of length 1) may be NULL, which is ten times faster. */
int32_t hk_dense_symmetric(int64_t n, double *matrix, double *value, double *vector);

/* The vector (n, of length 1) of the smallest eigenvalue of such a matrix, which is destroyed; n >= 1. */
int32_t hk_dense_softest(int64_t n, double *matrix, double *vector);

/* The largest eigenvalue of the tridiagonal matrix with `diagonal` (n) and `beside` (n - 1), and its vector
 * (n, or NULL). */
int32_t hk_dense_tridiagonal(int64_t n, const double *diagonal, const double *beside, double *value,
                             double *vector);

/* Eigenvalues lambda of lambda^2 I + lambda C + K, K and C symmetric and not negative, with their vectors (n
 * each, real and imaginary part). The common null space of K and C is left out; of conjugates, the one with
 * the positive imaginary part is given. All arrays have space for 2n. */
struct hk_damped_modes {
  int64_t count;
  double *real, *imaginary;
  double *vector_real, *vector_imaginary;
};
int32_t hk_dense_damped(int64_t n, const double *stiffness, const double *damping,
                        struct hk_damped_modes *modes);
void hk_damped_modes_release(struct hk_damped_modes *modes);
