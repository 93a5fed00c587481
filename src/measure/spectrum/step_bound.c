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
static double bound_by_damping(const struct hk_node_blocks *blocks, int32_t degree, double frequency,
                               double rate) {
  if (frequency == 0.0) return rate > 0.0 ? 2.0 / rate : INFINITY;
  const double by_drag = least_drag_rate(blocks) / (frequency * frequency);
  const double ratio = fmax(blocks->least_ratio, by_drag);
  return fmin(degree == 1 ? ratio : cbrt(4.0 * ratio / (frequency * frequency)), 2.0 / rate);
}

static int32_t allowed_by_damping(const struct hk_node_blocks *blocks, int32_t degree, double h,
                                  int64_t *particle) {
  if (!hk_node_blocks_stay_below(blocks, 0.0, h, 2.0, particle)) return 0;
  const double ratio = blocks->least_ratio, drag = least_drag_rate(blocks);
  if (degree > 1)
    return hk_node_blocks_stay_below(blocks, h * h, 0.0, fmax(4.0 * ratio / h, 2.0 * sqrt(drag * h)),
                                     particle);
  return h <= ratio || hk_node_blocks_stay_below(blocks, h, 0.0, drag, particle);
}

/* An eigenvalue is at most omega where it oscillates, and at most c where it does not. */
static double polynomial_bound(const struct hk_node_blocks *blocks, const struct hk_stability *stability) {
  const double frequency = hk_node_blocks_frequency(blocks), rate = hk_node_blocks_damping_rate(blocks);
  const double fastest = fmax(frequency, rate);
  if (stability->axis == 0.0) return bound_by_damping(blocks, stability->degree, frequency, rate);
  return fastest > 0.0 ? stability->half_disc / fastest : INFINITY;
}

static int32_t polynomial_allows(const struct hk_node_blocks *blocks, const struct hk_stability *stability,
                                 double h, int64_t *particle) {
  const double most = stability->half_disc;
  if (stability->axis == 0.0) return allowed_by_damping(blocks, stability->degree, h, particle);
  return hk_node_blocks_stay_below(blocks, h * h, 0.0, most * most, particle) &&
         hk_node_blocks_stay_below(blocks, 0.0, h, most, particle);
}

static double bound_by_stiffness(const struct hk_node_blocks *blocks) {
  const double frequency = hk_node_blocks_frequency(blocks);
  return frequency > 0.0 ? 2.0 / frequency : INFINITY;
}

/* Eigenvalues are -k/gamma. */
static double overdamped_bound(const struct hk_node_blocks *blocks, const struct hk_stability *stability) {
  const double frequency = hk_node_blocks_frequency(blocks);
  return frequency > 0.0 ? hk_real_reach(stability->degree) / (frequency * frequency) : INFINITY;
}

int32_t hk_step_is_bounded(const char *method) {
  const int32_t kind = hk_method_stability(method)->kind;
  return kind != HOOKE_STABILITY_UNKNOWN && kind != HOOKE_STABLE_ALWAYS;
}

int32_t hk_step_is_safe(const struct hk_node_blocks *blocks, const char *method, double h,
                        int64_t *particle) {
  const struct hk_stability *stability = hk_method_stability(method);
  if (blocks->system->mover_count > 0 || blocks->unknown) return 1;
  if (blocks->system->overdamped && stability->kind == HOOKE_STABLE_BY_POLYNOMIAL)
    return hk_node_blocks_stay_below(blocks, h, 0.0, hk_real_reach(stability->degree), particle);
  switch (stability->kind) {
  case HOOKE_STABLE_BY_K:
    return hk_node_blocks_stay_below(blocks, h * h, 0.0, 4.0, particle);
  case HOOKE_STABLE_BY_K_AND_C:
    return hk_node_blocks_stay_below(blocks, h * h, 2.0 * h, 4.0, particle);
  case HOOKE_STABLE_BY_POLYNOMIAL:
    return polynomial_allows(blocks, stability, h, particle);
  default:
    return 1;
  }
}

/* With rigid bodies, where tensions and gravity are stiffness about a pin or an axis, and without lengths. */
static double unknown_bound(const char *method) {
  return hooke_method_is_adaptive(method) ? INFINITY : (double)NAN;
}

double hk_step_bound_of(const struct hk_node_blocks *blocks, const char *method) {
  const struct hk_stability *stability = hk_method_stability(method);
  if (blocks->system->mover_count > 0 || blocks->unknown) return unknown_bound(method);
  if (blocks->system->overdamped && !hk_method_suits(method, blocks->system)) return NAN;
  if (blocks->system->overdamped && stability->kind == HOOKE_STABLE_BY_POLYNOMIAL)
    return overdamped_bound(blocks, stability);
  switch (stability->kind) {
  case HOOKE_STABLE_BY_K:
    return bound_by_stiffness(blocks);
  case HOOKE_STABLE_BY_K_AND_C:
    return hk_node_blocks_step(blocks);
  case HOOKE_STABLE_BY_POLYNOMIAL:
    return polynomial_bound(blocks, stability);
  default:
    return stability->kind == HOOKE_STABLE_ALWAYS || hooke_method_is_adaptive(method) ? INFINITY
                                                                                      : (double)NAN;
  }
}

int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q, double *bound) {
  struct hk_node_blocks blocks = {.system = system};
  if (method && hooke_method_is_adaptive(method) < 0)
    return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  const int one_pass = system->mover_count == 0 && (method == NULL || hk_step_is_bounded(method));
  if (one_pass) status = hk_node_blocks_create(system, q, &blocks);
  if (status != HOOKE_OK) return status;
  if (method) *bound = hk_step_bound_of(&blocks, method);
  for (int64_t k = 0; method == NULL && k < hooke_method_count(); k++)
    bound[k] = hk_step_bound_of(&blocks, hooke_method_name(k));
  if (one_pass) hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}

/* Explicit steps that are a step which solves for its damping, on a cloth of 32 x 32. */
static const double STEPS_OF_SOLVE = 8.0;

int32_t hk_step_cheapest(const hooke_system *system, const char *method, double *step) {
  const struct hk_method *row = hk_method_find(method);
  double most = 0.0;
  if (row == NULL || row->explicit_step == NULL) return HOOKE_OK;
  const int32_t status = row->explicit_step(system, &most);
  if (most > *step / STEPS_OF_SOLVE) *step = fmin(*step, most);
  return status;
}
