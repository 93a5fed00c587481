#include "model/medium.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/check_value.h"
#include "model/system.h"
#include "model/variant/variant.h"

#include <math.h>
#include <string.h>

/* ---- building ---- */

static void release_each(struct hk_each *each) {
  hk_free(each->value);
  *each = (struct hk_each){.value = NULL};
}

static int32_t check_each(const char *name, const char *unit, int64_t count, const double *value) {
  for (int64_t k = 0; k < count; k++) {
    if (value[k] >= 0.0 && isfinite(value[k])) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a number >= 0 (%s) is", value[k], unit);
    return count == 1 ? hk_fail_within(HOOKE_BAD_VALUE, "%s", name)
                      : hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", name, (long long)k);
  }
  return HOOKE_OK;
}

static int32_t set_each(const hooke_system *system, const char *name, const char *unit, int64_t count,
                        const double *value, struct hk_each *each) {
  struct hk_each made = {.count = count};
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = check_each(name, unit, count, value);
  if (status == HOOKE_OK && count > 1 && (made.value = hk_new(count, sizeof(double))) == NULL)
    status = HOOKE_NO_MEMORY;
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < count; k++) {
    if (made.value) made.value[k] = fabs(value[k]);
    made.most = fmax(made.most, fabs(value[k]));
  }
  release_each(each);
  *each = made;
  return HOOKE_OK;
}

int32_t hk_medium_set_drag(hooke_system *system, int64_t count, const double *value) {
  const int32_t status = set_each(system, "drag", "N s/m", count, value, &system->medium->drag);
  if (status == HOOKE_OK) system->drag = system->medium->drag.value ? 0.0 : system->medium->drag.most;
  return status;
}

int32_t hooke_system_set_drag(hooke_system *system, double coefficient) {
  return hk_medium_set_drag(system, 1, &coefficient);
}

int32_t hk_medium_set_quadratic_drag(hooke_system *system, int64_t count, const double *value) {
  return set_each(system, "quadratic_drag", "kg/m", count, value, &system->medium->quadratic_drag);
}

int32_t hk_medium_set_wind(hooke_system *system, int64_t samples, const double *time,
                           const double *velocity) {
  struct hk_course wind = {.width = 3};
  int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  if (samples > 0) {
    status = hk_course_set_table(&wind, "velocity", samples, time, velocity, hk_parabolic_slopes);
    if (status != HOOKE_OK) hk_fail_within(status, "wind");
  } else {
    status = hk_require_finite("wind", 3, 1, velocity);
    memcpy(wind.mean, velocity, sizeof wind.mean);
  }
  if (status != HOOKE_OK) {
    hk_course_release(&wind);
    return status;
  }
  hk_course_release(&system->medium->wind);
  system->medium->wind = wind;
  system->medium->blows = samples > 0 || velocity[0] != 0.0 || velocity[1] != 0.0 || velocity[2] != 0.0;
  return HOOKE_OK;
}

void hk_medium_release(struct hk_medium *medium) {
  release_each(&medium->drag);
  release_each(&medium->quadratic_drag);
  hk_course_release(&medium->wind);
}

static int32_t check_count(const hooke_system *system, const char *name, const struct hk_each *each) {
  if (each->value == NULL || each->count == system->particle_count) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, name, "%lld numbers for %lld particles; allowed: one, or one for each",
                 (long long)each->count, (long long)system->particle_count);
}

int32_t hk_medium_check(const hooke_system *system) {
  const int32_t status = check_count(system, "drag", &system->medium->drag);
  return status == HOOKE_OK ? check_count(system, "quadratic_drag", &system->medium->quadratic_drag) : status;
}

/* ---- copying ---- */

static int32_t copy_each(const struct hk_variant_maker *maker, const char *what, const struct hk_each *each,
                         double factor,
                         int32_t (*set)(hooke_system *system, int64_t count, const double *value)) {
  const int64_t n = maker->made->particle_count;
  const double most = factor * each->most;
  if (each->value == NULL) return set(maker->made, 1, &most);
  double *value = hk_new(n, sizeof *value);
  int32_t status = value ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < each->count && status == HOOKE_OK; p++) {
    if (maker->map->to[p] < 0) continue;
    value[maker->map->to[p]] = factor * each->value[p];
    if (!hk_variant_is_same(maker->map, p))
      status = hk_fail(HOOKE_UNSUITED, NULL, "%s of each particle says nothing of those between", what);
  }
  if (status == HOOKE_OK) status = set(maker->made, n, value);
  hk_free(value);
  return status;
}

int32_t hk_medium_copy_drag(const struct hk_variant_maker *maker) {
  return copy_each(maker, "drag", &maker->from->medium->drag, maker->variant->drag, hk_medium_set_drag);
}

int32_t hk_medium_copy_quadratic_drag(const struct hk_variant_maker *maker) {
  return copy_each(maker, "quadratic drag", &maker->from->medium->quadratic_drag, 1.0,
                   hk_medium_set_quadratic_drag);
}

int32_t hk_medium_copy_wind(const struct hk_variant_maker *maker) {
  maker->made->medium->blows = maker->from->medium->blows;
  return hk_course_copy(&maker->from->medium->wind, &maker->made->medium->wind);
}

/* ---- values ---- */

void hk_wind_at(const hooke_system *system, double t, double wind[3]) {
  wind[0] = wind[1] = wind[2] = 0.0;
  if (system->medium->blows) hk_course_at(&system->medium->wind, t, wind, NULL);
}

void hk_medium_check_value(const hooke_system *system, const struct hk_each *each, uint32_t *value) {
  for (int64_t p = 0; p < system->particle_count && each; p++) {
    const double c = hk_each_at(each, p);
    hk_check_add(value, &c, 1, sizeof c);
  }
  hk_check_whole(value, system->medium->blows);
  if (system->medium->blows) hk_course_check(&system->medium->wind, value);
}
