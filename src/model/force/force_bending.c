/* Bending: U = c/2 |d|^2 with d = x_a - 2 x_b + x_c for every triple; forces are linear in the positions. */
#include "model/force/force.h"

#include "core/sum.h"

#include <stddef.h>

static int32_t present(const hooke_system *system) {
  return system->bending.count > 0;
}

static int32_t add(const hooke_system *system, struct hooke_motion *motion, double t) {
  (void)t;
  const double *const q[3] = {motion->q[0], motion->q[1], motion->q[2]};
  hooke_bending_add(&system->bending, 1.0, q, motion->f);
  return HOOKE_OK;
}

static double energy(const hooke_system *system, const double *q) {
  struct hooke_sum sum = {0.0, 0.0};
  struct hooke_triple triple;
  for (struct hooke_triples at = {&system->bending, 0, 0}; hooke_next_triple(&at, &triple);) {
    double d[3];
    hooke_triple_bend(&triple, q, d);
    hooke_sum_add(&sum, 0.5 * triple.coefficient * ((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]));
  }
  return hooke_sum_value(&sum);
}

static int32_t add_product(const hooke_system *system, const struct hooke_point *point, double *out) {
  struct hooke_triple triple;
  for (struct hooke_triples at = {&system->bending, 0, 0}; hooke_next_triple(&at, &triple);) {
    double d[3];
    hooke_triple_bend(&triple, point->dq, d);
    for (int e = 0; e < 3; e++) {
      for (int a = 0; a < 3; a++)
        out[3 * triple.particle[e] + a] -= hooke_triple_factor(e) * (triple.coefficient * d[a]);
    }
  }
  return HOOKE_OK;
}

static void add_blocks(const hooke_system *system, const double *q, const double *v,
                       const struct hooke_pattern *pattern, double *dfdq, double *dfdv) {
  (void)q, (void)v, (void)dfdv;
  struct hooke_triple triple;
  for (struct hooke_triples at = {&system->bending, 0, 0}; dfdq && hooke_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++) {
      for (int g = 0; g < 3; g++) {
        double *block = dfdq + 9 * hooke_pattern_block(pattern, triple.particle[e], triple.particle[g]);
        for (int64_t a = 0; a < 3; a++)
          block[4 * a] -= triple.coefficient * (hooke_triple_factor(e) * hooke_triple_factor(g));
      }
    }
  }
}

const struct hooke_force_row hooke_force_bending = {.name = "bending",
                                                    .present = present,
                                                    .add = add,
                                                    .energy = energy,
                                                    .add_product = add_product,
                                                    .add_blocks = add_blocks};
