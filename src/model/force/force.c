/* Forces at a point and their derivatives, of all rows together. */
#include "model/system.h"

#include "core/memory.h"

#include <string.h>

/* ---- forces at a point, for callers with their own arrays ---- */

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
  for (int64_t p = 0; system->falls && p < motion->n; p++) {
    if (system->constrained[p]) continue;
    for (int a = 0; a < 3; a++)
      force[3 * p + a] += system->mass[p] * hk_fall(system, p, a);
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
      if (system->constrained[p])
        *value = 0.0;
      else
        *value = system->falls ? w * motion->f[a][p] + hk_fall(system, p, a) : w * motion->f[a][p];
    }
  }
  hk_movers_accelerate(system, motion, acceleration);
  hk_motion_destroy(motion);
  return HOOKE_OK;
}

/* ---- derivatives: a force without a function of its own has them from its elements ---- */

static void add_changes(const hooke_system *system, const struct hk_force_row *row,
                        const struct hk_point *point, double *out) {
  struct hk_member_change change;
  const int64_t count = hk_force_count(system, row);
  for (int64_t k = 0; k < count; k++) {
    if (!row->change(system, k, point, &change)) continue;
    for (int j = 0; j < change.count; j++) {
      double *to = out + 3 * (int64_t)change.particle[j];
      for (int a = 0; a < 3; a++)
        to[a] += change.force[j][a];
    }
  }
}

static int32_t add_product(const hooke_system *system, const struct hk_force_row *row,
                           const struct hk_point *point, double *out) {
  if (row->add_product) return row->add_product(system, point, out);
  if (row->change) {
    add_changes(system, row, point, out);
    return HOOKE_OK;
  }
  const double *const dq[3] = {point->dq, point->dq + 1, point->dq + 2}, *const dv[3] = {point->dv,
                                                                                         point->dv + 1,
                                                                                         point->dv + 2};
  double *const to[3] = {out, out + 1, out + 2};
  struct hk_elements at;
  hk_begin_elements(system, point->t, point->q, point->v, &at);
  at.only = row;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    hk_element_multiply(e, -e->k_along / e->over, -e->k_across / e->over, 3, dq, to);
    hk_element_multiply(e, -e->c_along / e->over, -e->c_across / e->over, 3, dv, to);
  }
  return HOOKE_OK;
}

static void add_block(const struct hk_pattern *pattern, const struct hk_element *e, double along,
                      double across, double *blocks) {
  for (int k = 0; k < 9 * e->count * e->count && blocks && (along != 0.0 || across != 0.0); k++) {
    const int one = k / 9 / e->count, other = k / 9 % e->count, a = k / 3 % 3, b = k % 3;
    double *block = blocks + 9 * hk_pattern_block(pattern, e->particle[one], e->particle[other]);
    block[3 * a + b] -= e->weight[one] * e->weight[other] *
                        ((along - across) * e->u[a] * e->u[b] + (a == b ? across : 0.0)) / e->over;
  }
}

/* Column `a` of the blocks of particle `j`: what displacing or pushing it along that axis changes. */
static void add_column(const hooke_system *system, const struct hk_force_row *row, int64_t number,
                       const struct hk_point *point, int64_t j, int a, const struct hk_pattern *pattern,
                       double *blocks) {
  struct hk_member_change change;
  if (blocks == NULL || !row->change(system, number, point, &change)) return;
  for (int i = 0; i < change.count; i++) {
    double *column = blocks + 9 * hk_pattern_block(pattern, change.particle[i], j) + a;
    for (int b = 0; b < 3; b++)
      column[3 * b] += change.force[i][b];
  }
}

/* `unit` has 6n zeros. */
static void add_columns(const hooke_system *system, const struct hk_force_row *row, double t, const double *q,
                        const double *v, double *unit, const struct hk_pattern *pattern, double *dfdq,
                        double *dfdv) {
  const double *none = unit + 3 * system->particle_count;
  const struct hk_point displaced = {.t = t, .q = q, .v = v, .dq = unit, .dv = none},
                        pushed = {.t = t, .q = q, .v = v, .dq = none, .dv = unit};
  struct hk_member_change member;
  const int64_t count = hk_force_count(system, row);
  for (int64_t k = 0; k < count; k++) {
    row->change(system, k, &displaced, &member);
    for (int i = 0; i < 3 * member.count; i++) {
      const int64_t j = member.particle[i / 3];
      unit[3 * j + i % 3] = 1.0;
      add_column(system, row, k, &displaced, j, i % 3, pattern, dfdq);
      add_column(system, row, k, &pushed, j, i % 3, pattern, dfdv);
      unit[3 * j + i % 3] = 0.0;
    }
  }
}

static void add_blocks(const hooke_system *system, const struct hk_force_row *row, double t, const double *q,
                       const double *v, double *unit, const struct hk_pattern *pattern, double *dfdq,
                       double *dfdv) {
  if (row->add_blocks) {
    row->add_blocks(system, t, q, v, pattern, dfdq, dfdv);
    return;
  }
  if (row->change) {
    add_columns(system, row, t, q, v, unit, pattern, dfdq, dfdv);
    return;
  }
  struct hk_elements at;
  hk_begin_elements(system, t, q, v, &at);
  at.only = row;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    add_block(pattern, e, e->k_along, e->k_across, dfdq);
    add_block(pattern, e, e->c_along, e->c_across, dfdv);
  }
}

int32_t hk_forces_product(const hooke_system *system, const struct hk_point *point, int32_t left_out,
                          double *out) {
  memset(out, 0, (size_t)(3 * system->particle_count) * sizeof(double));
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->kind & left_out) continue;
    const int32_t status = add_product(system, row, point, out);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}

int32_t hk_forces_product_in_rows(const hooke_system *system, double t, int32_t left_out, double **rows,
                                  int32_t *stop_value) {
  const int64_t size = 3 * system->particle_count;
  if (size == 0) return HOOKE_OK;
  double *q = *rows, *dq = q + 2 * size;
  const struct hk_point point = {t, q, q + size, dq, dq + size, stop_value, 1};
  const int32_t status = hk_forces_product(system, &point, left_out, q + 4 * size);
  const int32_t renewed = hk_rows_renew(5 * size, rows);
  for (int64_t k = 0; k < size && system->force_scale; k++)
    (*rows)[4 * size + k] *= system->force_scale[k];
  return status == HOOKE_OK ? renewed : status;
}

int32_t hooke_system_derivative_product(const hooke_system *system, double t, const double *q,
                                        const double *v, const double *dq, const double *dv, double *out) {
  int32_t stop_value;
  const struct hk_point point = {t, q, v, dq, dv, &stop_value, 0};
  const int32_t status = hk_system_require_committed(system);
  return status == HOOKE_OK ? hk_forces_product(system, &point, 0, out) : status;
}

int32_t hooke_system_derivative_blocks(const hooke_system *system, const double *q, const double *v,
                                       double *dfdq, double *dfdv) {
  return hooke_system_derivative_blocks_at(system, 0.0, q, v, dfdq, dfdv);
}

int32_t hooke_system_derivative_blocks_at(const hooke_system *system, double t, const double *q,
                                          const double *v, double *dfdq, double *dfdv) {
  struct hk_pattern pattern;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_pattern_create(system, &pattern);
  if (status != HOOKE_OK) return status;
  double *unit = hk_new(6 * system->particle_count, sizeof *unit);
  const size_t bytes = (size_t)(9 * pattern.count) * sizeof(double);
  if (dfdq) memset(dfdq, 0, bytes);
  if (dfdv) memset(dfdv, 0, bytes);
  for (int32_t k = 0; k < system->force_row_count && unit; k++)
    add_blocks(system, system->force_row[k], t, q, v, unit, &pattern, dfdq, dfdv);
  hk_pattern_release(&pattern);
  hk_free(unit);
  return unit ? HOOKE_OK : HOOKE_NO_MEMORY;
}
