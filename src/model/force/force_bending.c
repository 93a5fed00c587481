/* Bending: U = c/2 |d|^2 with d = x_a - 2 x_b + x_c for every triple; forces are linear in the positions. */
#include "model/force/force.h"

#include "core/sum.h"

#include <stddef.h>

static int32_t present(const hooke_system *system) {
  return system->bending.count > 0;
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const double *const q[3] = {motion->q[0], motion->q[1], motion->q[2]};
  hk_bending_add(&system->bending, 1.0, q, motion->f);
  return HOOKE_OK;
}

static double energy(const hooke_system *system, const double *q) {
  struct hk_sum sum = {0.0, 0.0};
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    double d[3];
    hk_triple_bend(&triple, q, d);
    hk_sum_add(&sum, 0.5 * triple.coefficient * ((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]));
  }
  return hk_sum_value(&sum);
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    double d[3];
    hk_triple_bend(&triple, point->dq, d);
    for (int e = 0; e < 3; e++) {
      for (int a = 0; a < 3; a++)
        out[3 * triple.particle[e] + a] -= hk_triple_factor(e) * (triple.coefficient * d[a]);
    }
  }
  return HOOKE_OK;
}

static void add_blocks(const hooke_system *system, const double *q, const double *v,
                       const struct hk_pattern *pattern, double *dfdq, double *dfdv) {
  (void)q, (void)v, (void)dfdv;
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; dfdq && hk_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++) {
      for (int g = 0; g < 3; g++) {
        double *block = dfdq + 9 * hk_pattern_block(pattern, triple.particle[e], triple.particle[g]);
        for (int64_t a = 0; a < 3; a++)
          block[4 * a] -= triple.coefficient * (hk_triple_factor(e) * hk_triple_factor(g));
      }
    }
  }
}

const struct hk_force_row hk_force_bending = {.name = "bending",
                                              .present = present,
                                              .add = add,
                                              .energy = energy,
                                              .add_product = add_product,
                                              .add_blocks = add_blocks};
