/* Gravity, U = -m g.q. It is an acceleration that a step adds to w f, so it has no force function. */
#include "model/force/force.h"

#include "core/sum.h"

static int32_t present(const hooke_system *system) {
  return system->has_gravity;
}

static double energy(const hooke_system *system, const double *q) {
  const double *g = system->gravity;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    hk_sum_add(&sum, -system->mass[p] * ((g[0] * q[3 * p] + g[1] * q[3 * p + 1]) + g[2] * q[3 * p + 2]));
  }
  return hk_sum_value(&sum);
}

const struct hk_force_row hk_force_gravity = {.name = "gravity", .present = present, .energy = energy};
