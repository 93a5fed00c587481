#include "measure/spectrum/eigen/dense.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

void hk_damped_modes_release(struct hk_damped_modes *modes) {
  hk_free(modes->real);
  memset(modes, 0, sizeof *modes);
}

#if HOOKE_HAVE_LAPACK

/* In Fortran: matrices by columns, everything by address, the lengths of texts at the end. */
extern void dsyev_(const char *job, const char *triangle, const int *n, double *a, const int *stride,
                   double *value, double *work, const int *work_size, int *info, size_t, size_t);
extern void dsyevx_(const char *job, const char *range, const char *triangle, const int *n, double *a,
                    const int *stride, const double *low, const double *high, const int *first,
                    const int *last, const double *accuracy, int *found, double *value, double *vector,
                    const int *vector_stride, double *work, const int *work_size, int *whole, int *failed,
                    int *info, size_t, size_t, size_t);
extern void dstevx_(const char *job, const char *range, const int *n, double *diagonal, double *beside,
                    const double *low, const double *high, const int *first, const int *last,
                    const double *accuracy, int *found, double *value, double *vector, const int *stride,
                    double *work, int *whole, int *failed, int *info, size_t, size_t);
extern void dgeev_(const char *left_job, const char *right_job, const int *n, double *a, const int *stride,
                   double *real, double *imaginary, double *left, const int *left_stride, double *right,
                   const int *right_stride, double *work, const int *work_size, int *info, size_t, size_t);

#else

/* Stand-ins that nothing calls: check() refuses before. */
static void dsyev_(const char *job, ...) {
  (void)job;
}
#define dsyevx_ dsyev_
#define dstevx_ dsyev_
#define dgeev_  dsyev_

#endif

/* LAPACK ends the process for some non-finite matrices, and counts by int. */
static int32_t check(int64_t n, int64_t count, const double *matrix) {
  if (!HOOKE_HAVE_LAPACK)
    return hk_fail(HOOKE_NOT_BUILT, NULL, "limits need LAPACK, which this build is without");
  if (n > INT_MAX / 4) {
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%lld unknowns are too many for dense eigenvalues", (long long)n);
  }
  for (int64_t k = 0; k < count; k++) {
    if (!isfinite(matrix[k]))
      return hk_fail(HOOKE_SOLVER_FAILED, NULL, "eigenvalues of a matrix that is not finite");
  }
  return HOOKE_OK;
}

static int32_t not_found(void) {
  return hk_fail(HOOKE_SOLVER_FAILED, NULL, "the eigenvalues were not found");
}

/* ---- symmetric ---- */

static void swap_rows(int64_t n, double *a, double *b) {
  for (int64_t k = 0; k < n; k++) {
    const double other = a[k];
    a[k] = b[k];
    b[k] = other;
  }
}

int32_t hk_dense_symmetric(int64_t n, double *matrix, double *value, double *vector) {
  if (n == 0) return HOOKE_OK;
  int32_t status = check(n, n * n, matrix);
  if (status != HOOKE_OK) return status;
  const char *job = vector ? "V" : "N";
  const int size = (int)n, ask = -1;
  int info = 0;
  double best = 0.0;
  dsyev_(job, "U", &size, matrix, &size, value, &best, &ask, &info, 1, 1);
  const int work_size = (int)best;
  double *work = hk_new(work_size, sizeof(double));
  if (work == NULL) return HOOKE_NO_MEMORY;
  dsyev_(job, "U", &size, matrix, &size, value, work, &work_size, &info, 1, 1);
  hk_free(work);
  if (info != 0) return not_found();
  /* the smallest is first; its columns are our rows */
  for (int64_t k = 0; k < n / 2; k++) {
    swap_rows(1, value + k, value + n - 1 - k);
    if (vector) swap_rows(n, matrix + k * n, matrix + (n - 1 - k) * n);
  }
  if (vector) memcpy(vector, matrix, (size_t)(n * n) * sizeof(double));
  return HOOKE_OK;
}

int32_t hk_dense_softest(int64_t n, double *matrix, double *vector) {
  const int32_t status = check(n, n * n, matrix);
  if (status != HOOKE_OK) return status;
  const int size = (int)n, work_size = 40 * size, first = 1;
  const double none = 0.0;
  double *work = hk_new(work_size + 4 * n, sizeof(double));
  if (work == NULL) return HOOKE_NO_MEMORY;
  double *value = work + work_size;
  int *whole = (int *)(value + n), found = 0, info = 0;
  dsyevx_("V", "I", "U", &size, matrix, &size, &none, &none, &first, &first, &none, &found, value, vector,
          &size, work, &work_size, whole, whole + 5 * n, &info, 1, 1, 1);
  hk_free(work);
  return info == 0 && found == 1 ? HOOKE_OK : not_found();
}

int32_t hk_dense_tridiagonal(int64_t n, const double *diagonal, const double *beside, double *value,
                             double *vector) {
  int32_t status = check(n, n, diagonal);
  if (status == HOOKE_OK) status = check(n, n - 1, beside);
  if (status != HOOKE_OK) return status;
  double *work = hk_new(11 * n, sizeof(double));
  if (work == NULL) return HOOKE_NO_MEMORY;
  double *values = work + 5 * n, *off = values + n, *all = off + n;
  const int size = (int)n;
  const double none = 0.0;
  int *whole = (int *)(all + n), found = 0, info = 0;
  memcpy(values, diagonal, (size_t)n * sizeof(double));
  memcpy(off, beside, (size_t)(n - 1) * sizeof(double));
  dstevx_(vector ? "V" : "N", "I", &size, values, off, &none, &none, &size, &size, &none, &found, all, vector,
          &size, work, whole, whole + 5 * n, &info, 1, 1);
  *value = all[0];
  hk_free(work);
  return info == 0 && found == 1 ? HOOKE_OK : not_found();
}

/* ---- damped ---- */

/* Eigenvalues of K + C below this fraction of the largest belong to its null space. */
static const double NOTHING = 1e-14;

/* out = -Q A Q^T with the r rows of Q. */
static void project(int64_t n, int64_t r, const double *q, const double *a, double *row, double *out,
                    int64_t stride) {
  for (int64_t i = 0; i < r; i++) {
    memset(row, 0, (size_t)n * sizeof(double));
    for (int64_t k = 0; k < n; k++)
      hk_add_multiple(n, q[i * n + k], a + k * n, row);
    for (int64_t j = 0; j < r; j++) {
      double sum = 0.0;
      for (int64_t k = 0; k < n; k++)
        sum += row[k] * q[j * n + k];
      out[i * stride + j] = -sum;
    }
  }
}

/* The rows of `basis` span the range of K and C; returns their number. */
static int32_t find_basis(int64_t n, const double *stiffness, const double *damping, double *basis,
                          int64_t *rank) {
  double *sum = hk_new((n + 1) * n, sizeof(double));
  if (sum == NULL) return HOOKE_NO_MEMORY;
  double *value = sum + n * n;
  /* both scaled to size 1, so that neither hides the other */
  double size[2] = {0.0, 0.0};
  for (int64_t k = 0; k < n; k++) {
    size[0] = fmax(size[0], stiffness[k * n + k]);
    size[1] = fmax(size[1], damping[k * n + k]);
  }
  for (int64_t k = 0; k < n * n; k++)
    sum[k] = (size[0] > 0.0 ? stiffness[k] / size[0] : 0.0) + (size[1] > 0.0 ? damping[k] / size[1] : 0.0);
  const int32_t status = hk_dense_symmetric(n, sum, value, basis);
  for (*rank = 0; status == HOOKE_OK && *rank < n; ++*rank) {
    if (!(value[*rank] > (double)n * NOTHING * value[0])) break;
  }
  hk_free(sum);
  return status;
}

static int32_t make_space(int64_t n, struct hk_damped_modes *modes) {
  double *block = hk_new(2 * n * (2 + 2 * n), sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  *modes = (struct hk_damped_modes){.real = block, .imaginary = block + 2 * n};
  modes->vector_real = block + 4 * n;
  modes->vector_imaginary = modes->vector_real + 2 * n * n;
  return HOOKE_OK;
}

/* Extracts the vector of an eigenvalue from the companion's, (u, lambda u): from the larger half. */
static void take(int64_t n, int64_t r, const double *basis, const double *real, const double *imaginary,
                 double size, struct hk_damped_modes *modes) {
  double *re = modes->vector_real + modes->count * n, *im = modes->vector_imaginary + modes->count * n;
  const int64_t from = size > 1.0 ? r : 0;
  for (int64_t i = 0; i < r; i++) {
    hk_add_multiple(n, real[from + i], basis + i * n, re);
    if (imaginary) hk_add_multiple(n, imaginary[from + i], basis + i * n, im);
  }
}

/* Column k has the vector of a real eigenvalue; for a pair, columns k and k + 1 are the two parts of the
 * first one's, whose imaginary part is positive. */
static void take_all(int64_t n, int64_t r, const double *basis, const double *real, const double *imaginary,
                     const double *vector, struct hk_damped_modes *modes) {
  for (int64_t k = 0; k < 2 * r; k++) {
    const double *column = vector + k * 2 * r;
    if (imaginary[k] < 0.0) continue;
    modes->real[modes->count] = real[k];
    modes->imaginary[modes->count] = imaginary[k];
    take(n, r, basis, column, imaginary[k] > 0.0 ? column + 2 * r : NULL, hypot(real[k], imaginary[k]),
         modes);
    modes->count++;
  }
}

static int32_t solve_companion(int64_t n, int64_t r, const double *basis, double *companion,
                               struct hk_damped_modes *modes) {
  int32_t status = check(2 * r, 4 * r * r, companion);
  if (status != HOOKE_OK) return status;
  const int size = (int)(2 * r), ask = -1, one = 1;
  int info = 0;
  double best = 0.0, *block = hk_new(2 * r * (2 + 2 * r), sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  double *real = block, *imaginary = real + 2 * r, *vector = imaginary + 2 * r;
  dgeev_("N", "V", &size, companion, &size, real, imaginary, NULL, &one, vector, &size, &best, &ask, &info, 1,
         1);
  const int work_size = (int)best;
  double *work = hk_new(work_size, sizeof(double));
  if (work) {
    dgeev_("N", "V", &size, companion, &size, real, imaginary, NULL, &one, vector, &size, work, &work_size,
           &info, 1, 1);
    if (info == 0)
      take_all(n, r, basis, real, imaginary, vector, modes);
    else
      status = not_found();
  } else {
    status = HOOKE_NO_MEMORY;
  }
  hk_free(work);
  hk_free(block);
  return status;
}

int32_t hk_dense_damped(int64_t n, const double *stiffness, const double *damping,
                        struct hk_damped_modes *modes) {
  *modes = (struct hk_damped_modes){.count = 0};
  double *basis = hk_new((n + 1) * n, sizeof(double)), *matrix = NULL;
  int64_t r = 0;
  int32_t status = basis ? make_space(n, modes) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = find_basis(n, stiffness, damping, basis, &r);
  if (status == HOOKE_OK && r > 0) {
    matrix = hk_new(4 * r * r, sizeof(double));
    status = matrix ? HOOKE_OK : HOOKE_NO_MEMORY;
  }
  if (status == HOOKE_OK && r > 0) {
    /* (0, I; -K, -C) in columns; K and C are symmetric */
    project(n, r, basis, stiffness, basis + n * n, matrix + r, 2 * r);
    project(n, r, basis, damping, basis + n * n, matrix + 2 * r * r + r, 2 * r);
    for (int64_t k = 0; k < r; k++)
      matrix[(r + k) * 2 * r + k] = 1.0;
    status = solve_companion(n, r, basis, matrix, modes);
  }
  hk_free(matrix);
  hk_free(basis);
  if (status != HOOKE_OK) hk_damped_modes_release(modes);
  return status;
}
