#include "measure/dense.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

void hooke_damped_modes_release(struct hooke_damped_modes *modes) {
  hooke_free(modes->real);
  memset(modes, 0, sizeof *modes);
}

#if HOOKE_HAVE_GSL

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>

static int32_t no_memory(void) {
  return hooke_fail(HOOKE_NO_MEMORY, NULL, "no memory for eigenvalues");
}

/* ---- symmetric ---- */

static int32_t values_alone(size_t n, gsl_matrix *a, gsl_vector *value) {
  gsl_eigen_symm_workspace *room = gsl_eigen_symm_alloc(n);
  if (room == NULL) return no_memory();
  gsl_eigen_symm(a, value, room);
  gsl_eigen_symm_free(room);
  gsl_sort_vector(value);
  gsl_vector_reverse(value);
  return HOOKE_OK;
}

static int32_t values_and_vectors(size_t n, gsl_matrix *a, gsl_vector *value, double *vector) {
  gsl_eigen_symmv_workspace *room = gsl_eigen_symmv_alloc(n);
  gsl_matrix_view v = gsl_matrix_view_array(vector, n, n);
  if (room == NULL) return no_memory();
  gsl_eigen_symmv(a, value, &v.matrix, room);
  gsl_eigen_symmv_free(room);
  gsl_eigen_symmv_sort(value, &v.matrix, GSL_EIGEN_SORT_VAL_DESC);
  gsl_matrix_transpose(&v.matrix);
  return HOOKE_OK;
}

int32_t hooke_dense_symmetric(int64_t n, double *matrix, double *value, double *vector) {
  if (n == 0) return HOOKE_OK;
  gsl_matrix_view a = gsl_matrix_view_array(matrix, (size_t)n, (size_t)n);
  gsl_vector_view e = gsl_vector_view_array(value, (size_t)n);
  return vector ? values_and_vectors((size_t)n, &a.matrix, &e.vector, vector)
                : values_alone((size_t)n, &a.matrix, &e.vector);
}

int32_t hooke_dense_tridiagonal(int64_t n, const double *diagonal, const double *beside, double *value,
                                double *vector) {
  double *room = hooke_new(2 * n * n + n, sizeof(double));
  if (room == NULL) return HOOKE_NO_MEMORY;
  double *matrix = room, *all = matrix + n * n, *values = all + n * n;
  for (int64_t k = 0; k < n; k++) {
    matrix[k * n + k] = diagonal[k];
    if (k + 1 < n) matrix[k * n + k + 1] = matrix[(k + 1) * n + k] = beside[k];
  }
  const int32_t status = hooke_dense_symmetric(n, matrix, values, vector ? all : NULL);
  *value = values[0];
  if (vector) memcpy(vector, all, (size_t)n * sizeof(double));
  hooke_free(room);
  return status;
}

/* ---- damped ---- */

/* Eigenvalues of K + C below this share of the largest are those of what neither of the two moves. */
static const double NOTHING = 1e-14;

static double *copy_of(int64_t count, const double *from) {
  double *copy = hooke_new(count, sizeof(double));
  if (copy) memcpy(copy, from, (size_t)count * sizeof(double));
  return copy;
}

/* out = Q A Q^T with the r rows of Q. */
static void project(int64_t n, int64_t r, const double *q, const double *a, double *row, double *out,
                    int64_t stride) {
  for (int64_t i = 0; i < r; i++) {
    memset(row, 0, (size_t)n * sizeof(double));
    for (int64_t k = 0; k < n; k++) {
      for (int64_t j = 0; j < n; j++)
        row[j] += q[i * n + k] * a[k * n + j];
    }
    for (int64_t j = 0; j < r; j++) {
      double sum = 0.0;
      for (int64_t k = 0; k < n; k++)
        sum += row[k] * q[j * n + k];
      out[i * stride + j] = sum;
    }
  }
}

/* The rows of `basis` span what K or C moves; returns how many there are. */
static int32_t find_basis(int64_t n, const double *stiffness, const double *damping, double *basis,
                          int64_t *rank) {
  double *sum = copy_of(n * n, stiffness), *value = hooke_new(n, sizeof(double));
  int32_t status = sum && value ? HOOKE_OK : HOOKE_NO_MEMORY;
  /* both of size 1, so that neither hides the other */
  double size[2] = {0.0, 0.0};
  for (int64_t k = 0; k < n; k++) {
    size[0] = fmax(size[0], stiffness[k * n + k]);
    size[1] = fmax(size[1], damping[k * n + k]);
  }
  if (status == HOOKE_OK) {
    for (int64_t k = 0; k < n * n; k++) {
      sum[k] = (size[0] > 0.0 ? stiffness[k] / size[0] : 0.0) + (size[1] > 0.0 ? damping[k] / size[1] : 0.0);
    }
    status = hooke_dense_symmetric(n, sum, value, basis);
  }
  for (*rank = 0; status == HOOKE_OK && *rank < n; ++*rank) {
    if (!(value[*rank] > (double)n * NOTHING * value[0])) break;
  }
  hooke_free(sum);
  hooke_free(value);
  return status;
}

static int32_t make_room(int64_t n, struct hooke_damped_modes *modes) {
  double *block = hooke_new(2 * n * (2 + 2 * n), sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  *modes = (struct hooke_damped_modes){.real = block, .imaginary = block + 2 * n};
  modes->vector_real = block + 4 * n;
  modes->vector_imaginary = modes->vector_real + 2 * n * n;
  return HOOKE_OK;
}

/* Takes the vector of eigenvalue k from the companion's, (u, lambda u): from the larger half. */
static void take(int64_t n, int64_t r, const double *basis, const gsl_matrix_complex *vector, size_t k,
                 double size, struct hooke_damped_modes *modes) {
  double *re = modes->vector_real + modes->count * n, *im = modes->vector_imaginary + modes->count * n;
  const int64_t from = size > 1.0 ? r : 0;
  for (int64_t i = 0; i < r; i++) {
    const gsl_complex u = gsl_matrix_complex_get(vector, (size_t)(from + i), k);
    for (int64_t j = 0; j < n; j++) {
      re[j] += GSL_REAL(u) * basis[i * n + j];
      im[j] += GSL_IMAG(u) * basis[i * n + j];
    }
  }
}

static int32_t solve_companion(int64_t n, int64_t r, const double *basis, gsl_matrix *companion,
                               struct hooke_damped_modes *modes) {
  const size_t size = 2 * (size_t)r;
  gsl_vector_complex *value = gsl_vector_complex_alloc(size);
  gsl_matrix_complex *vector = gsl_matrix_complex_alloc(size, size);
  gsl_eigen_nonsymmv_workspace *room = gsl_eigen_nonsymmv_alloc(size);
  int32_t status = value && vector && room ? HOOKE_OK : no_memory();
  if (status == HOOKE_OK && gsl_eigen_nonsymmv(companion, value, vector, room) != 0)
    status = hooke_fail(HOOKE_SOLVER_FAILED, NULL, "the eigenvalues of the damped system were not found");
  for (size_t k = 0; status == HOOKE_OK && k < size; k++) {
    const gsl_complex lambda = gsl_vector_complex_get(value, k);
    if (GSL_IMAG(lambda) < 0.0) continue;
    modes->real[modes->count] = GSL_REAL(lambda);
    modes->imaginary[modes->count] = GSL_IMAG(lambda);
    take(n, r, basis, vector, k, hypot(GSL_REAL(lambda), GSL_IMAG(lambda)), modes);
    modes->count++;
  }
  gsl_eigen_nonsymmv_free(room);
  gsl_matrix_complex_free(vector);
  gsl_vector_complex_free(value);
  return status;
}

int32_t hooke_dense_damped(int64_t n, const double *stiffness, const double *damping,
                           struct hooke_damped_modes *modes) {
  *modes = (struct hooke_damped_modes){.count = 0};
  double *basis = hooke_new(n * n, sizeof(double)), *row = hooke_new(n, sizeof(double)), *matrix = NULL;
  int64_t r = 0;
  int32_t status = basis && row ? make_room(n, modes) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = find_basis(n, stiffness, damping, basis, &r);
  if (status == HOOKE_OK && r > 0) {
    /* (0, I; -K, -C) */
    matrix = hooke_new(4 * r * r, sizeof(double));
    status = matrix ? HOOKE_OK : HOOKE_NO_MEMORY;
  }
  if (status == HOOKE_OK && r > 0) {
    project(n, r, basis, stiffness, row, matrix + 2 * r * r, 2 * r);
    project(n, r, basis, damping, row, matrix + 2 * r * r + r, 2 * r);
    for (int64_t k = 2 * r * r; k < 4 * r * r; k++)
      matrix[k] = -matrix[k];
    for (int64_t k = 0; k < r; k++)
      matrix[k * 2 * r + r + k] = 1.0;
    gsl_matrix_view companion = gsl_matrix_view_array(matrix, 2 * (size_t)r, 2 * (size_t)r);
    status = solve_companion(n, r, basis, &companion.matrix, modes);
  }
  hooke_free(matrix);
  hooke_free(basis);
  hooke_free(row);
  if (status != HOOKE_OK) hooke_damped_modes_release(modes);
  return status;
}

#else

static int32_t not_built(void) {
  return hooke_fail(HOOKE_NOT_BUILT, NULL, "limits need GSL, which this build is without");
}

int32_t hooke_dense_symmetric(int64_t n, double *matrix, double *value, double *vector) {
  (void)n, (void)matrix, (void)value, (void)vector;
  return not_built();
}

int32_t hooke_dense_tridiagonal(int64_t n, const double *diagonal, const double *beside, double *value,
                                double *vector) {
  (void)n, (void)diagonal, (void)beside, (void)value, (void)vector;
  return not_built();
}

int32_t hooke_dense_damped(int64_t n, const double *stiffness, const double *damping,
                           struct hooke_damped_modes *modes) {
  (void)n, (void)stiffness, (void)damping, (void)modes;
  return not_built();
}

#endif
