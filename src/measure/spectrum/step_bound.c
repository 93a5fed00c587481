/* Safe steps, one rule for each kind of stability in the table of methods. */
#include "core/status.h"
#include "integrate/method.h"
#include "measure/spectrum/limit_rules.h"
#include "measure/spectrum/step_bound.h"

#include "hooke/measurement.h"
#include "model/system.h"

#include <math.h>

/* Drag over the mass of the heaviest free particle [1/s]. */
static double least_drag_rate(const struct hk_node_blocks *blocks) {
  const hooke_system *system = blocks->system;
  double heaviest = 0.0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (!system->constrained[p]) heaviest = fmax(heaviest, system->inertia[p]);
  }
  return system->brake / heaviest;
}

/* The imaginary axis is not stable: h k <= c of Euler's method and h^3 k^2 <= 4 c of degree 2, for every
 * mode with k its stiffness and c its damping, and h <= 2/c. Of elements c/k is at least the smallest
 * gamma/kappa, which is 0 across a taut spring, in bending, and where a spring is undamped; there only drag
 * damps. */
static double bound_by_damping(const struct hk_node_blocks *blocks, int32_t degree, double most,
                               int64_t *particle) {
  const double softness = hk_node_blocks_reach(blocks, (struct hk_node_limit){.k = 1.0}, INFINITY, particle);
  if (isfinite(softness)) { /* 1/k of the stiffest mode */
    const double ratio = fmax(blocks->least_ratio, least_drag_rate(blocks) * softness);
    most = fmin(most, degree == 1 ? ratio : cbrt(4.0 * ratio * softness));
  }
  return hk_node_blocks_reach(blocks, (struct hk_node_limit){.c = 0.5}, most, particle);
}

/* An eigenvalue is at most omega where it oscillates, and at most c where it does not. */
static double polynomial_bound(const struct hk_node_blocks *blocks, const struct hk_stability *stability,
                               double most, int64_t *particle) {
  const double per = 1.0 / stability->half_disc;
  if (stability->axis == 0.0) return bound_by_damping(blocks, stability->degree, most, particle);
  most = hk_node_blocks_reach(blocks, (struct hk_node_limit){.kk = per * per}, most, particle);
  return hk_node_blocks_reach(blocks, (struct hk_node_limit){.c = per}, most, particle);
}

int32_t hk_step_is_bounded(const char *method) {
  const int32_t kind = hk_method_stability(method)->kind;
  return kind != HOOKE_STABILITY_UNKNOWN && kind != HOOKE_STABLE_ALWAYS;
}

/* Bodies have none: tensions and gravity are stiffness about a pin or an axis. Of an overdamped system the
 * eigenvalues are -k/gamma. */
double hk_step_bound_of(const struct hk_node_blocks *blocks, const char *method, double most,
                        int64_t *particle) {
  const hooke_system *system = blocks->system;
  const struct hk_stability *stability = hk_method_stability_in(method, system);
  const double without = hooke_method_is_adaptive(method) ? most : (double)NAN;
  if (system->mover_count > 0 || blocks->unknown) return without;
  if (!hk_method_suits(method, system)) return NAN;
  switch (stability->kind) {
  case HOOKE_STABLE_ALWAYS:
    return most;
  case HOOKE_STABLE_BY_K:
    return hk_node_blocks_reach(blocks, (struct hk_node_limit){.kk = 0.25}, most, particle);
  case HOOKE_STABLE_BY_K_AND_C:
  case HOOKE_STABLE_BY_PREDICTION: /* within it */
    return hk_node_blocks_reach(blocks, (struct hk_node_limit){.kk = 0.25, .c = 0.5}, most, particle);
  case HOOKE_STABLE_BY_POLYNOMIAL:
    if (!system->overdamped) return polynomial_bound(blocks, stability, most, particle);
    return hk_node_blocks_reach(blocks,
                                (struct hk_node_limit){.k = 1.0 / hk_ray_reach(stability->degree, -1.0, 0.0)},
                                most, particle);
  default:
    return without;
  }
}

int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q, double *bound) {
  return hk_step_bound_at(system, method, q, NULL, bound);
}

int32_t hk_step_bound_at(const hooke_system *system, const char *method, const double *q, const double *v,
                         double *bound) {
  struct hk_node_blocks blocks = {.system = system};
  if (method && hooke_method_is_adaptive(method) < 0)
    return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  const int one_pass = system->mover_count == 0 && (method == NULL || hk_step_is_bounded(method));
  if (one_pass) status = hk_node_blocks_create(system, q, v, &blocks);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < (method ? 1 : hooke_method_count()); k++)
    bound[k] = hk_step_bound_of(&blocks, method ? method : hooke_method_name(k), INFINITY, NULL);
  if (one_pass) hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}
