/* Gravity, U = -m phi g.q, phi = 1 unless given. It is an acceleration that a step adds to w f, so it has no
 * force function. */
#include "model/force/force.h"

#include "core/sum.h"
#include "model/check_value.h"
#include "model/variant/variant.h"

#include <math.h>

static int32_t present(const hooke_system *system) {
  return system->has_gravity;
}

static double factor_of(const hooke_system *system, int64_t p) {
  return system->gravity_factor ? system->gravity_factor[p] : 1.0;
}

static double energy(const hooke_system *system, double t, const double *q) {
  (void)t;
  const double *g = system->gravity, *mass = system->mass, *factor = system->gravity_factor;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    const double height = (g[0] * q[3 * p] + g[1] * q[3 * p + 1]) + g[2] * q[3 * p + 2];
    hk_sum_add(&sum, -(factor ? factor[p] * mass[p] : mass[p]) * height);
  }
  return hk_sum_value(&sum);
}

static void add_pull(const hooke_system *system, double *force, double *kick) {
  const double *g = system->gravity;
  double mass = 0.0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    const double factor = fabs(factor_of(system, p)), weight = factor * system->mass[p];
    *force += weight * ((fabs(g[0]) + fabs(g[1])) + fabs(g[2]));
    mass += system->constrained[p] ? 0.0 : factor * weight;
  }
  *kick += mass * ((g[0] * g[0] + g[1] * g[1]) + g[2] * g[2]);
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_add(value, system->gravity, 3, sizeof(double));
  if (system->gravity_factor)
    hk_check_add(value, system->gravity_factor, system->particle_count, sizeof(double));
}

static int32_t copy(const struct hk_variant_maker *maker) {
  return hooke_system_set_gravity(maker->made, maker->from->gravity);
}

/* ---- in an overdamped system it is a force, and copied with gravity ---- */

static int32_t weighs(const hooke_system *system) {
  return system->overdamped && system->has_gravity;
}

static int32_t add_weight(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < motion->n; p++)
      motion->f[a][p] +=
          system->constrained[p] ? 0.0 : system->mass[p] * (factor_of(system, p) * system->gravity[a]);
  }
  return HOOKE_OK;
}

const struct hk_force_row hk_force_weight = {
    .name = "weight", .in_scenes = 1, .check = check, .present = weighs, .add = add_weight};

const struct hk_force_row hk_force_gravity = {.name = "gravity",
                                              .in_scenes = 1,
                                              .check = check,
                                              .copy = copy,
                                              .present = present,
                                              .energy = energy,
                                              .add_pull = add_pull};
