/* Safe steps, one rule for each fixed-step method: a row here goes with a row in the table of methods. */
#include "core/status.h"
#include "measure/spectrum/step_bound.h"

#include "hooke/measure.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Drag over the mass of the heaviest free particle [1/s]. */
static double least_drag_rate(const struct hk_node_blocks *blocks) {
  const hooke_system *system = blocks->system;
  double heaviest = 0.0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (!system->held[p]) heaviest = fmax(heaviest, system->mass[p]);
  }
  return system->drag / heaviest;
}

/* Stable where h <= c/k for every mode with k its stiffness and c its damping, and h <= 2/c. Along springs
 * c/k is at least the smallest gamma/kappa; across a taut spring, in bending, and where a spring is undamped,
 * only drag damps. */
static double forward_euler(const struct hk_node_blocks *blocks) {
  const double frequency = hk_node_blocks_frequency(blocks), rate = hk_node_blocks_damping_rate(blocks);
  if (frequency == 0.0) return rate > 0.0 ? 2.0 / rate : INFINITY;
  const double by_springs = blocks->across ? 0.0 : blocks->least_ratio;
  const double by_drag = least_drag_rate(blocks) / (frequency * frequency);
  return fmin(fmax(by_springs, by_drag), 2.0 / rate);
}

/* Damping is implicit, so the limit is that of the undamped modes. */
static double verlet(const struct hk_node_blocks *blocks) {
  const double frequency = hk_node_blocks_frequency(blocks);
  return frequency > 0.0 ? 2.0 / frequency : INFINITY;
}

/* The half disc of this radius in the left half plane lies within |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1; an
 * eigenvalue is at most omega where it oscillates, and at most c where it does not. */
static double rk4(const struct hk_node_blocks *blocks) {
  const double frequency = hk_node_blocks_frequency(blocks), rate = hk_node_blocks_damping_rate(blocks);
  const double fastest = fmax(frequency, rate);
  return fastest > 0.0 ? 2.6156 / fastest : INFINITY;
}

/* ---- the same, asked of one step ---- */

static int32_t forward_euler_allows(const struct hk_node_blocks *blocks, double h, int64_t *particle) {
  if (!hk_node_blocks_stay_below(blocks, 0.0, h, 2.0, particle)) return 0;
  if (!blocks->across && h <= blocks->least_ratio) return 1;
  return hk_node_blocks_stay_below(blocks, h, 0.0, least_drag_rate(blocks), particle);
}

static int32_t symplectic_euler_allows(const struct hk_node_blocks *blocks, double h, int64_t *particle) {
  return hk_node_blocks_stay_below(blocks, h * h, 2.0 * h, 4.0, particle);
}

static int32_t verlet_allows(const struct hk_node_blocks *blocks, double h, int64_t *particle) {
  return hk_node_blocks_stay_below(blocks, h * h, 0.0, 4.0, particle);
}

static int32_t rk4_allows(const struct hk_node_blocks *blocks, double h, int64_t *particle) {
  return hk_node_blocks_stay_below(blocks, h * h, 0.0, 2.6156 * 2.6156, particle) &&
         hk_node_blocks_stay_below(blocks, 0.0, h, 2.6156, particle);
}

/* Without a limit where `bound` is NULL. */
static const struct rule {
  const char *method;
  double (*bound)(const struct hk_node_blocks *blocks);
  int32_t (*allows)(const struct hk_node_blocks *blocks, double h, int64_t *particle);
} rules[] = {
    {"forward-euler", forward_euler, forward_euler_allows},
    {"symplectic-euler", hk_node_blocks_step, symplectic_euler_allows},
    {"verlet", verlet, verlet_allows},
    {"rk4", rk4, rk4_allows},
    {"backward-euler", NULL, NULL},
};

static const struct rule *rule_of(const char *method) {
  for (size_t k = 0; k < sizeof rules / sizeof rules[0]; k++) {
    if (strcmp(rules[k].method, method) == 0) return &rules[k];
  }
  return NULL;
}

int32_t hk_step_is_bounded(const char *method) {
  const struct rule *rule = rule_of(method);
  return rule != NULL && rule->bound != NULL;
}

int32_t hk_step_is_safe(const struct hk_node_blocks *blocks, const char *method, double h,
                        int64_t *particle) {
  const struct rule *rule = rule_of(method);
  return rule == NULL || rule->allows == NULL || rule->allows(blocks, h, particle);
}

double hk_step_bound_of(const struct hk_node_blocks *blocks, const char *method) {
  if (hooke_method_is_adaptive(method)) return INFINITY;
  const struct rule *rule = rule_of(method);
  if (rule == NULL) return NAN;
  return rule->bound ? rule->bound(blocks) : (double)INFINITY;
}

int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q, double *bound) {
  const int32_t adaptive = hooke_method_is_adaptive(method);
  if (adaptive < 0) return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  struct hk_node_blocks blocks = {.system = system};
  if (hk_step_is_bounded(method)) status = hk_node_blocks_create(system, q, &blocks);
  if (status != HOOKE_OK) return status;
  *bound = hk_step_bound_of(&blocks, method);
  if (hk_step_is_bounded(method)) hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}

int32_t hooke_step_bounds(const hooke_system *system, const double *q, double *bounds) {
  struct hk_node_blocks blocks;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_node_blocks_create(system, q, &blocks);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < hooke_method_count(); k++)
    bounds[k] = hk_step_bound_of(&blocks, hooke_method_name(k));
  hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}
