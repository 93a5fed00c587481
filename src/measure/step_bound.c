/* Safe steps, one rule for each fixed-step method: a row here goes with a row in the table of methods. */
#include "core/status.h"
#include "measure/node_blocks.h"

#include "hooke/measure.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Stable where h <= c/k for every mode with k its stiffness and c its damping, and h <= 2/c. Along springs
 * c/k is at least the smallest gamma/kappa; across a taut spring, and where a spring is undamped, only drag
 * damps. */
static double forward_euler(const struct hooke_node_blocks *blocks) {
  const double frequency = hooke_node_blocks_frequency(blocks), rate = hooke_node_blocks_damping_rate(blocks);
  double heaviest = 0.0;
  for (int64_t p = 0; p < blocks->system->particle_count; p++) {
    if (!blocks->system->held[p]) heaviest = fmax(heaviest, blocks->system->mass[p]);
  }
  if (frequency == 0.0) return rate > 0.0 ? 2.0 / rate : INFINITY;
  const double by_springs = blocks->across ? 0.0 : blocks->least_ratio;
  const double by_drag = blocks->system->drag / heaviest / (frequency * frequency);
  return fmin(fmax(by_springs, by_drag), 2.0 / rate);
}

/* Damping is implicit, so the limit is that of the undamped modes. */
static double verlet(const struct hooke_node_blocks *blocks) {
  const double frequency = hooke_node_blocks_frequency(blocks);
  return frequency > 0.0 ? 2.0 / frequency : INFINITY;
}

/* The half disc of this radius in the left half plane lies within |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1; an eigenvalue is
 * at most omega where it oscillates, and at most c where it does not. */
static double rk4(const struct hooke_node_blocks *blocks) {
  const double frequency = hooke_node_blocks_frequency(blocks), rate = hooke_node_blocks_damping_rate(blocks);
  const double fastest = fmax(frequency, rate);
  return fastest > 0.0 ? 2.6156 / fastest : INFINITY;
}

/* Without a limit where `bound` is NULL. */
static const struct {
  const char *method;
  double (*bound)(const struct hooke_node_blocks *blocks);
} rules[] = {
    {"forward-euler", forward_euler},
    {"symplectic-euler", hooke_node_blocks_step},
    {"verlet", verlet},
    {"rk4", rk4},
    {"backward-euler", NULL},
};

int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q, double *bound) {
  const int32_t adaptive = hooke_method_is_adaptive(method);
  if (adaptive < 0) return hooke_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  int32_t status = hooke_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  *bound = adaptive ? INFINITY : NAN;
  for (size_t k = 0; k < sizeof rules / sizeof rules[0]; k++) {
    if (strcmp(rules[k].method, method) != 0) continue;
    *bound = INFINITY;
    if (rules[k].bound == NULL) break;
    struct hooke_node_blocks blocks;
    status = hooke_node_blocks_create(system, q, &blocks);
    if (status != HOOKE_OK) return status;
    *bound = rules[k].bound(&blocks);
    hooke_node_blocks_release(&blocks);
  }
  return HOOKE_OK;
}
