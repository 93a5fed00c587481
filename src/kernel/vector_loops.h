/* Vectors of `size` numbers. Sums go in eight interleaved parts that are added in one order, so that their bits depend
 * on nothing but the numbers. */
#ifndef HOOKE_KERNEL_VECTOR_LOOPS_H
#define HOOKE_KERNEL_VECTOR_LOOPS_H

#include <stdint.h>

double hooke_dot(int64_t size, const double *x, const double *y);

/* y += a x; y = x + b y. */
void hooke_add_multiple(int64_t size, double a, const double *x, double *y);
void hooke_scale_and_add(int64_t size, double b, const double *x, double *y);

/* The same sum over n particles, x, y and z apart, each weighed by one of n numbers. */
double hooke_dot_weighed(int64_t n, const double *weight, const double *x, const double *y);

/* Half a turn each of Lanczos's recurrence in the norm of masses, on vectors as above:
 * out = a inverse out - b before, returns out.Mx;  out -= c x, returns out.M out. */
double hooke_lanczos_begin(int64_t n, const double *mass, const double *inverse, double a, double b,
                           const double *before, const double *x, double *out);
double hooke_lanczos_end(int64_t n, const double *mass, double c, const double *x, double *out);

/* Lower triangular 3x3 blocks W, one a particle: 11, 22, 33, 21, 31, 32, n numbers each; vectors are n of x, n of y, n of
 * z. y = W^T x; x = W x; y = d x
 * with n numbers d. */
void hooke_apply_factor_transposed(int64_t n, const double *w, const double *x, double *y);
void hooke_apply_factor(int64_t n, const double *w, double *x);
void hooke_apply_diagonal(int64_t n, const double *d, const double *x, double *y);

#endif
