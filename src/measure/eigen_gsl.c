#include "measure/eigen.h"

#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_GSL

#include <gsl/gsl_eigen.h>

struct hooke_eigen {
  gsl_eigen_symm_workspace *room;
  gsl_matrix *matrix;
  gsl_vector *value;
};

int32_t hooke_eigen_create(struct hooke_eigen **out) {
  struct hooke_eigen *eigen = hooke_new(1, sizeof *eigen);
  if (eigen == NULL) return HOOKE_NO_MEMORY;
  eigen->room = gsl_eigen_symm_alloc(3);
  eigen->matrix = gsl_matrix_alloc(3, 3);
  eigen->value = gsl_vector_alloc(3);
  if (eigen->room == NULL || eigen->matrix == NULL || eigen->value == NULL) {
    hooke_eigen_destroy(eigen);
    return hooke_fail(HOOKE_NO_MEMORY, NULL, "no memory for eigenvalues");
  }
  *out = eigen;
  return HOOKE_OK;
}

void hooke_eigen_destroy(struct hooke_eigen *eigen) {
  if (eigen == NULL) return;
  gsl_eigen_symm_free(eigen->room);
  gsl_matrix_free(eigen->matrix);
  gsl_vector_free(eigen->value);
  hooke_free(eigen);
}

double hooke_eigen_largest(struct hooke_eigen *eigen, const double matrix[6]) {
  static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (size_t a = 0; a < 3; a++) {
    for (size_t b = 0; b < 3; b++)
      gsl_matrix_set(eigen->matrix, a, b, matrix[place[a][b]]);
  }
  gsl_eigen_symm(eigen->matrix, eigen->value, eigen->room);
  return gsl_vector_max(eigen->value);
}

#else

#include <math.h>
#include <stddef.h>

int32_t hooke_eigen_create(struct hooke_eigen **eigen) {
  (void)eigen;
  return hooke_fail(HOOKE_NOT_BUILT, NULL, "step bounds need GSL, which this build is without");
}

void hooke_eigen_destroy(struct hooke_eigen *eigen) {
  (void)eigen;
}

double hooke_eigen_largest(struct hooke_eigen *eigen, const double matrix[6]) {
  (void)eigen, (void)matrix;
  return NAN;
}

#endif
