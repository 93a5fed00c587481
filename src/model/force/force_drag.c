/* Ether drag f = -c v on every free particle, with one number and without wind. It brakes free fall too;
 * spring damping does not. */
#include "model/force/force.h"

#include "model/check_value.h"
#include "model/medium.h"
#include "model/variant/variant.h"

static int32_t present(const hooke_system *system) {
  return system->brake > 0.0;
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_add(value, &system->brake, 1, sizeof(double));
}

static int32_t copy(const struct hk_variant_maker *maker) {
  /* in an overdamped system it is no force, and its drag is copied in any case */
  return hk_force_is_present(maker->from, &hk_force_medium) ? HOOKE_OK : hk_medium_copy_drag(maker);
}

static void brake(const hooke_system *system, struct hk_motion *motion, int64_t from, int64_t to) {
  const double c = system->drag;
  for (int a = 0; a < 3; a++) {
    double *f = motion->f[a];
    const double *v = motion->v[a];
    for (int64_t p = from; p < to; p++)
      f[p] -= c * v[p];
  }
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  int64_t from = 0;
  if (motion->zero) return HOOKE_OK;
  for (int64_t k = 0; k < system->constrained_count; k++) {
    brake(system, motion, from, system->constrained_particle[k]);
    from = system->constrained_particle[k] + 1;
  }
  brake(system, motion, from, motion->n);
  return HOOKE_OK;
}

/* One element for each particle; zero if it is constrained. */
static int64_t count(const hooke_system *system) {
  return system->particle_count;
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)t, (void)q, (void)v;
  for (int64_t k = 0; k < wanted; k++) {
    const double c = system->constrained[first + k] ? 0.0 : system->drag;
    out[k] = (struct hk_element){.count = 1,
                                 .particle = {(int32_t)(first + k)},
                                 .weight = {1.0},
                                 .c_along = c,
                                 .c_across = c,
                                 .over = 1.0};
  }
}

static void multiply(const hooke_system *system, double a, double b, const double *const x[3],
                     double *const out[3]) {
  (void)a;
  for (int c = 0; c < 3 && b != 0.0; c++) {
    for (int64_t p = 0; p < system->particle_count; p++)
      out[c][p] += b * system->drag * x[c][p];
  }
}

const struct hk_force_row hk_force_drag = {.name = "drag",
                                           .kind = HOOKE_UNIFORM,
                                           .is_drag = 1,
                                           .in_scenes = 1,
                                           .title = "drag",
                                           .check = check,
                                           .copy = copy,
                                           .present = present,
                                           .add = add,
                                           .count = count,
                                           .elements = elements,
                                           .multiply = multiply,
                                           .damped = present};
