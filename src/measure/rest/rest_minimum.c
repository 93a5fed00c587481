#include "measure/rest/rest_minimum.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/spectrum/eigen/dense.h"
#include "model/force/force.h"

#include <math.h>
#include <string.h>

/* Eigenvalues below this share of the largest are 0. */
static const double NOTHING = 1e-11;
enum { MOST_FREE = 200 };

/* Column k of -M^-1/2 (df/dq) M^-1/2 over the free particles `of`. */
static int32_t find_column(const hooke_system *system, const struct hk_point *point, const int32_t *of,
                           int64_t size, int64_t k, double *dq, double *out, double *matrix) {
  const int64_t place = 3 * of[k / 3] + k % 3;
  dq[place] = 1.0;
  const int32_t status = hk_forces_product(system, point, 0, out);
  dq[place] = 0.0;
  for (int64_t j = 0; j < size; j++)
    matrix[j * size + k] =
        -out[3 * of[j / 3] + j % 3] / sqrt(system->inertia[of[j / 3]] * system->inertia[of[k / 3]]);
  return status;
}

static void count_modes(struct hk_resting *r, int64_t size, const double *value) {
  const double nothing = size > 0 ? NOTHING * fmax(fabs(value[0]), fabs(value[size - 1])) : 0.0;
  r->minimum = 1;
  r->zero_modes = 0;
  for (int64_t k = 0; k < size; k++) {
    r->zero_modes += fabs(value[k]) <= nothing;
    r->minimum &= value[k] >= -nothing;
  }
  if (size > 0) r->softest = value[size - 1];
}

static int32_t find_modes(struct hk_resting *r, struct hk_point *point, const int32_t *of, int64_t size) {
  const int64_t numbers = 3 * r->m->system->particle_count;
  double *block = hk_new(2 * numbers + size * size + size, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  double *dq = block, *out = dq + numbers, *matrix = out + numbers, *value = matrix + size * size;
  int32_t status = HOOKE_OK;
  point->dq = dq;
  for (int64_t k = 0; k < size && status == HOOKE_OK; k++)
    status = find_column(r->m->system, point, of, size, k, dq, out, matrix);
  for (int64_t k = 0; k < size; k++)
    for (int64_t j = 0; j < k; j++)
      matrix[k * size + j] = matrix[j * size + k] = 0.5 * (matrix[k * size + j] + matrix[j * size + k]);
  if (status == HOOKE_OK) status = hk_dense_symmetric(size, matrix, value, NULL);
  if (status == HOOKE_OK) count_modes(r, size, value);
  hk_free(block);
  return status == HOOKE_NOT_BUILT ? HOOKE_OK : status;
}

int32_t hk_rest_see_minimum(struct hk_resting *r, double t, const double *v) {
  const hooke_system *system = r->m->system;
  const int64_t n = system->particle_count, count = n - system->constrained_count;
  int32_t stop_value = 0;
  struct hk_point point = {.t = t, .q = r->position, .v = v, .dv = v, .stop_value = &stop_value};
  if (system->mover_count > 0 || count > MOST_FREE || !r->rest.has_energy) return HOOKE_OK;
  int32_t *of = hk_new(count, sizeof *of);
  if (of == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0, k = 0; p < n; p++)
    if (!system->constrained[p]) of[k++] = (int32_t)p;
  const int32_t status = find_modes(r, &point, of, 3 * count);
  hk_free(of);
  return status;
}
