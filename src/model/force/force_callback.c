/* The callback force. */
#include "model/force/force.h"

#include "core/status.h"
#include "model/callbacks.h"
#include "model/check_value.h"
#include "model/variant/variant.h"

#include <math.h>
#include <string.h>

static int32_t present(const hooke_system *system) {
  return system->force != NULL;
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_whole(value, system->force_product != NULL);
}

static int32_t copy(const struct hk_variant_maker *maker) {
  const hooke_system *from = maker->from;
  if (!present(from)) return HOOKE_OK;
  const int32_t status = hk_variant_require_numbers(maker, "a force callback");
  maker->made->force_scale = from->force_scale;
  if (status != HOOKE_OK) return status;
  (void)hooke_system_set_force(maker->made, from->force, from->force_product, from->force_ctx); /* is open */
  char *const *name = hk_force_from(from);
  return name ? hooke_system_name_force(maker->made, name[HOOKE_FORCE_FILE], name[HOOKE_FORCE_NAME],
                                        name[HOOKE_FORCE_DIGEST])
              : HOOKE_OK;
}

static int32_t stopped(const hooke_system *system, int32_t value, double t) {
  char name[512];
  return hk_fail(HOOKE_STOPPED, NULL, "%s returned %d at t = %.6g s",
                 hk_force_called(system, name, sizeof name), (int)value, t);
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  const int64_t n = motion->n;
  if (hk_rows_renew(9 * n, &motion->rows) != HOOKE_OK) return HOOKE_NO_MEMORY;
  double *q = motion->rows, *v = q + 3 * n, *f = v + 3 * n;
  hk_rows_from_components(n, motion->q, q);
  hk_rows_from_components(n, motion->v, v);
  if (system->overdamped) memset(v, 0, (size_t)(3 * n) * sizeof(double));
  hk_rows_from_components(n, motion->f, f);
  const int32_t value = system->force(n, t, q, v, f, system->force_ctx);
  if (value != 0) {
    motion->stop_value = value;
    return stopped(system, value, t);
  }
  hk_components_from_rows(n, f, motion->f);
  for (int64_t k = 0; k < 3 * n && system->force_scale; k++)
    motion->f[k % 3][k / 3] *= system->force_scale[k];
  return 0;
}

/* The largest magnitude, and the largest distance from the first particle along an axis. */
static double largest(int64_t count, const double *value) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++)
    most = fmax(most, fabs(value[k]));
  return most;
}

static double extent(int64_t n, const double *q) {
  double most = 0.0;
  for (int64_t k = 3; k < 3 * n; k++)
    most = fmax(most, fabs(q[k] - q[k % 3]));
  return most;
}

/* Central difference of the callback along (dq, dv). The error of order step^2 balances rounding near
 * cbrt(2^-52). */
static int32_t add_difference(const hooke_system *system, const struct hk_point *point, double *out) {
  const int64_t n = system->particle_count, size = 3 * n;
  const double length = fmax(extent(n, point->q), 1e-3), speed = fmax(largest(size, point->v), length);
  const double fraction = fmax(largest(size, point->dq) / length, largest(size, point->dv) / speed);
  if (!(fraction > 0.0)) return 0;
  const double step = 6e-6 / fraction;
  double *rows[2] = {hk_rows_new(3 * size), hk_rows_new(3 * size)}; /* ahead and behind */
  int32_t value = 0;
  for (int side = 0; side < 2 && rows[0] && rows[1] && value == 0; side++) {
    double *q = rows[side], *v = q + size;
    const double from = side == 0 ? step : -step;
    for (int64_t k = 0; k < size; k++) {
      q[k] = point->q[k] + from * point->dq[k];
      v[k] = system->overdamped ? 0.0 : point->v[k] + from * point->dv[k];
    }
    value = system->force(n, point->t, q, v, v + size, system->force_ctx);
  }
  const int32_t missing = rows[0] == NULL || rows[1] == NULL;
  for (int64_t k = 0; k < size && value == 0 && !missing; k++)
    out[k] += (rows[0][2 * size + k] - rows[1][2 * size + k]) / (2.0 * step);
  hooke_rows_hold(rows[0], -1);
  hooke_rows_hold(rows[1], -1);
  if (missing) return HOOKE_NO_MEMORY;
  *point->stop_value = value;
  return value == 0 ? HOOKE_OK : stopped(system, value, point->t);
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  if (system->force_product == NULL) return add_difference(system, point, out);
  const int64_t n = system->particle_count, size = 3 * n;
  const int32_t still = system->overdamped, own = still || !point->in_rows;
  double *rows = own ? hk_rows_new(5 * size) : NULL;
  if (own && rows == NULL) return HOOKE_NO_MEMORY;
  const double *const from[5] = {point->q, still ? NULL : point->v, point->dq, still ? NULL : point->dv, out};
  for (int k = 0; k < 5 && own; k++)
    if (from[k]) memcpy(rows + k * size, from[k], (size_t)size * sizeof *rows);
  double *q = own ? rows : (double *)(uintptr_t)point->q, *dq = q + 2 * size;
  const int32_t value =
      system->force_product(n, point->t, q, q + size, dq, dq + size, dq + 2 * size, system->force_ctx);
  if (own) memcpy(out, rows + 4 * size, (size_t)size * sizeof *out);
  hooke_rows_hold(rows, -1);
  *point->stop_value = value;
  return value == 0 ? HOOKE_OK : stopped(system, value, point->t);
}

const struct hk_force_row hk_force_callback = {.name = "callback",
                                               .kind = HOOKE_CALLED,
                                               .check = check,
                                               .copy = copy,
                                               .present = present,
                                               .add = add,
                                               .add_product = add_product};
