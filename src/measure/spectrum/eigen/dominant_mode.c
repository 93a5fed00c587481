#include "measure/spectrum/eigen/dominant_mode.h"

#include "core/memory.h"
#include "measure/spectrum/eigen/dense.h"

#include <math.h>
#include <string.h>

enum { DENSE_UNKNOWNS = 100 };

static const double TIGHTER = 1e-6; /* of few unknowns */

static const double NOISE = 0.1;

static int32_t dense(struct hk_linearised *lin, double *value, double *mode) {
  const int64_t n = lin->unknowns;
  double *matrix = hk_new((2 * n + 1) * n, sizeof(double));
  if (matrix == NULL) return HOOKE_NO_MEMORY;
  double *vector = matrix + n * n, *values = vector + n * n;
  int32_t status = hk_linearised_assemble(lin, matrix);
  if (status == HOOKE_OK) status = hk_dense_symmetric(n, matrix, values, vector);
  if (status == HOOKE_OK) {
    *value = values[0];
    hk_linearised_unpack(lin, vector, mode);
  }
  hk_free(matrix);
  return status;
}

/* A start with components in modes that the neighbouring problem does not excite. */
static void begin(const struct hk_linearised *lin, const double *start, double *mode) {
  hk_linearised_start(lin, mode);
  if (start == NULL) return;
  const double size = sqrt(hk_linearised_dot(lin, mode, mode));
  const double length = sqrt(hk_linearised_dot(lin, start, start));
  for (int64_t k = 0; k < lin->size && length > 0.0 && size > 0.0; k++)
    mode[k] = start[k] / length + NOISE * mode[k] / size;
  hk_linearised_project(lin, mode);
}

int32_t hk_dominant_mode(struct hk_linearised *lin, double a, double b, const double *start, double accuracy,
                         double *value, double *mode) {
  *value = 0.0;
  memset(mode, 0, (size_t)lin->size * sizeof(double));
  if (lin->unknowns == 0) return HOOKE_OK;
  hk_linearised_combine(lin, a, b);
  if (lin->unknowns <= DENSE_UNKNOWNS) return dense(lin, value, mode);
  double *work = hk_new(lin->size, sizeof(double));
  if (work == NULL) return HOOKE_NO_MEMORY;
  begin(lin, start, work);
  const int few = lin->unknowns <= HOOKE_FEW_UNKNOWNS;
  const int32_t status =
      hk_dominant_mode_lanczos(lin, few ? fmax(1e-13, TIGHTER * accuracy) : accuracy, value, work);
  memcpy(mode, work, (size_t)lin->size * sizeof(double));
  hk_free(work);
  return status;
}
