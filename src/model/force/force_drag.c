/* Ether drag f = -c v on every free particle. It brakes free fall too; spring damping does not. */
#include "model/force/force.h"

#include "core/sum.h"

static int32_t present(const hooke_system *system) {
  return system->drag > 0.0;
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
  for (int64_t k = 0; k < system->held_count; k++) {
    brake(system, motion, from, system->held_particle[k]);
    from = system->held_particle[k] + 1;
  }
  brake(system, motion, from, motion->n);
  return HOOKE_OK;
}

static double heat(const hooke_system *system, const double *q, const double *v) {
  (void)q;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->held[p]) continue;
    hk_sum_add(&sum, (v[3 * p] * v[3 * p] + v[3 * p + 1] * v[3 * p + 1]) + v[3 * p + 2] * v[3 * p + 2]);
  }
  return system->drag * hk_sum_value(&sum);
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->held[p]) continue;
    for (int a = 0; a < 3; a++)
      out[3 * p + a] -= system->drag * point->dv[3 * p + a];
  }
  return 0;
}

static void add_blocks(const hooke_system *system, const double *q, const double *v,
                       const struct hk_pattern *pattern, double *dfdq, double *dfdv) {
  (void)q, (void)v, (void)dfdq;
  for (int64_t p = 0; dfdv && p < system->particle_count; p++) {
    if (system->held[p]) continue;
    double *block = dfdv + 9 * hk_pattern_block(pattern, p, p);
    for (int64_t a = 0; a < 3; a++)
      block[4 * a] -= system->drag;
  }
}

const struct hk_force_row hk_force_drag = {.name = "drag",
                                           .present = present,
                                           .add = add,
                                           .heat = heat,
                                           .add_product = add_product,
                                           .add_blocks = add_blocks};
