/* Vectors of `size` numbers. Sums go in interleaved parts that are added in a fixed order, so that their bits
 * depend on the numbers alone. The loops are compiled once for each instruction set; these functions use the
 * best one of the machine. */
#pragma once

#include <stdint.h>

double hk_dot(int64_t size, const double *x, const double *y);

/* y += a x; y = x + b y. */
void hk_add_multiple(int64_t size, double a, const double *x, double *y);
void hk_scale_and_add(int64_t size, double b, const double *x, double *y);

/* x += a p and r -= a ap; returns r.r, the same as hk_dot(). */
double hk_descend(int64_t size, double a, const double *p, const double *ap, double *x, double *r);

/* The same sum over n particles, x, y and z apart, each weighted by one of n numbers. */
double hk_dot_weighed(int64_t n, const double *weight, const double *x, const double *y);

/* Half a turn each of Lanczos's recurrence in the norm of masses, on vectors as above:
 * out = a inverse out - b before, returns out.Mx;  out -= c x, returns out.M out. */
double hk_lanczos_begin(int64_t n, const double *mass, const double *inverse, double a, double b,
                        const double *before, const double *x, double *out);
double hk_lanczos_end(int64_t n, const double *mass, double c, const double *x, double *out);

/* The inverse Cholesky factors W of n symmetric 3x3 blocks xx, yy, zz, xy, xz, yz, in their place. */
void hk_factorise_blocks(int64_t n, double *block);

/* Lower triangular 3x3 blocks W, one a particle: 11, 22, 33, 21, 31, 32, n numbers each; vectors are n of x,
 * n of y, n of z. y = W^T x; x = W x; y = d x with n numbers d; and y = W^T x, out = d y. */
void hk_apply_factor_transposed(int64_t n, const double *w, const double *x, double *y);
void hk_apply_factor(int64_t n, const double *w, double *x);
void hk_apply_diagonal(int64_t n, const double *d, const double *x, double *y);
void hk_begin_product(int64_t n, const double *w, const double *d, const double *x, double *y, double *out);

/* N rows of x y z from three vectors; and the number of differing bits between rows and vectors. */
void hk_join_rows(int64_t n, const double *x, const double *y, const double *z, double *rows);
uint64_t hk_differing_bits(int64_t n, const double *x, const double *y, const double *z, const double *rows);

/* Loops for libraries that call them one by one; vectors may be identical, and otherwise do not overlap. z =
 * a x + b y;  z = a x;  z = x y;  z = x/y;  z = 1/x;  z = |x|;  z = a + x */
void hk_linear_sum(int64_t size, double a, const double *x, double b, const double *y, double *z);
void hk_scale(int64_t size, double a, const double *x, double *z);
void hk_multiply(int64_t size, const double *x, const double *y, double *z);
void hk_divide(int64_t size, const double *x, const double *y, double *z);
void hk_invert(int64_t size, const double *x, double *z);
void hk_absolute(int64_t size, const double *x, double *z);
/* The sums of (x y)^2 and of x y in thirty-two parts, and the largest |x|. */
double hk_sum_of_squares(int64_t size, const double *x, const double *y);
double hk_long_dot(int64_t size, const double *x, const double *y);
double hk_largest(int64_t size, const double *x);

/* The loops of one instruction set, under the names above. */
struct hk_vector_set {
  double (*dot)(int64_t, const double *, const double *);
  void (*add_multiple)(int64_t, double, const double *, double *);
  void (*scale_and_add)(int64_t, double, const double *, double *);
  double (*descend)(int64_t, double, const double *, const double *, double *, double *);
  double (*dot_weighed)(int64_t, const double *, const double *, const double *);
  double (*lanczos_begin)(int64_t, const double *, const double *, double, double, const double *,
                          const double *, double *);
  double (*lanczos_end)(int64_t, const double *, double, const double *, double *);
  void (*factorise_blocks)(int64_t, double *);
  void (*apply_factor_transposed)(int64_t, const double *, const double *, double *);
  void (*apply_factor)(int64_t, const double *, double *);
  void (*apply_diagonal)(int64_t, const double *, const double *, double *);
  void (*begin_product)(int64_t, const double *, const double *, const double *, double *, double *);
  void (*linear_sum)(int64_t, double, const double *, double, const double *, double *);
  void (*scale)(int64_t, double, const double *, double *);
  void (*multiply)(int64_t, const double *, const double *, double *);
  void (*divide)(int64_t, const double *, const double *, double *);
  void (*invert)(int64_t, const double *, double *);
  void (*absolute)(int64_t, const double *, double *);
  double (*sum_of_squares)(int64_t, const double *, const double *);
  double (*long_dot)(int64_t, const double *, const double *);
  double (*largest)(int64_t, const double *);
  void (*join_rows)(int64_t, const double *, const double *, const double *, double *);
  uint64_t (*differing_bits)(int64_t, const double *, const double *, const double *, const double *);
};
