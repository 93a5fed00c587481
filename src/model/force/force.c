#include "model/force/force.h"

#include "core/memory.h"
#include "core/status.h"

#include <stddef.h>
#include <string.h>

/* The order of the rows is the order of the sum at a particle. Gravity is last: a = w f + g. */
static const struct hk_force_row *const table[] = {
    &hk_force_springs, &hk_force_bending,  &hk_force_altitude,
    &hk_force_drag,    &hk_force_callback, &hk_force_gravity,
};

const struct hk_force_row *hk_force_table(int32_t k) {
  return k >= 0 && k < (int32_t)(sizeof table / sizeof table[0]) ? table[k] : NULL;
}

/* ---- forces at a point, for callers with arrays of their own ---- */

static int32_t forces_at(const hooke_system *system, double t, const double *q, const double *v,
                         struct hk_motion **motion) {
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_motion_create(system, 0, NULL, motion);
  if (status != HOOKE_OK) return status;
  hk_motion_load(system, *motion, q, v);
  status = hk_motion_forces(system, *motion, t);
  if (status != HOOKE_OK) hk_motion_destroy(*motion);
  return status;
}

int32_t hooke_system_force(const hooke_system *system, double t, const double *q, const double *v,
                           double *force) {
  struct hk_motion *motion;
  const int32_t status = forces_at(system, t, q, v, &motion);
  if (status != HOOKE_OK) return status;
  hk_rows_from_components(motion->n, motion->f, force);
  for (int64_t p = 0; system->has_gravity && p < motion->n; p++) {
    if (system->held[p]) continue;
    for (int a = 0; a < 3; a++)
      force[3 * p + a] += system->mass[p] * system->gravity[a];
  }
  hk_motion_destroy(motion);
  return HOOKE_OK;
}

int32_t hooke_system_acceleration(const hooke_system *system, double t, const double *q, const double *v,
                                  double *acceleration) {
  struct hk_motion *motion;
  const int32_t status = forces_at(system, t, q, v, &motion);
  if (status != HOOKE_OK) return status;
  for (int64_t p = 0; p < motion->n; p++) {
    const double w = system->inverse_mass[p];
    for (int a = 0; a < 3; a++) {
      double *value = &acceleration[3 * p + a];
      if (system->held[p])
        *value = 0.0;
      else
        *value = system->has_gravity ? w * motion->f[a][p] + system->gravity[a] : w * motion->f[a][p];
    }
  }
  hk_motion_destroy(motion);
  return HOOKE_OK;
}

int32_t hk_forces_product(const hooke_system *system, const struct hk_point *point,
                          int (*left_out)(const struct hk_force_row *row), double *out) {
  memset(out, 0, (size_t)(3 * system->particle_count) * sizeof(double));
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add_product == NULL || (left_out && left_out(row))) continue;
    const int32_t status = row->add_product(system, point, out);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}

int32_t hooke_system_derivative_product(const hooke_system *system, double t, const double *q,
                                        const double *v, const double *dq, const double *dv, double *out) {
  int32_t stop_value;
  const struct hk_point point = {t, q, v, dq, dv, &stop_value};
  const int32_t status = hk_system_require_committed(system);
  return status == HOOKE_OK ? hk_forces_product(system, &point, NULL, out) : status;
}

int32_t hooke_system_derivative_blocks(const hooke_system *system, const double *q, const double *v,
                                       double *dfdq, double *dfdv) {
  struct hk_pattern pattern;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_pattern_create(system, &pattern);
  if (status != HOOKE_OK) return status;
  const size_t bytes = (size_t)(9 * pattern.count) * sizeof(double);
  if (dfdq) memset(dfdq, 0, bytes);
  if (dfdv) memset(dfdv, 0, bytes);
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add_blocks) row->add_blocks(system, q, v, &pattern, dfdq, dfdv);
  }
  hk_pattern_release(&pattern);
  return HOOKE_OK;
}
