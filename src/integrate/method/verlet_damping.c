/* With A = h^2 M^-1 K and B = h M^-1 C the explicit step is stable where A + 2 B <= 4; of one mode it is up
 * to A < 4 - 2 B + B^2, B < 2. The bound below holds wherever the particles are: of every element it takes
 * the stiffness and the damping in all directions, and gives each particle its row of g g^T. So the choice
 * depends on the system and the step alone, and a run that goes on from any of its states makes the same one.
 * */
#include "integrate/method/verlet_damping.h"

#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "model/force/altitude.h"
#include "model/force/force.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

static const double MARGIN = 0.8; /* of the bound */

static double larger(double along, double across, double over) {
  return fmax(0.0, fmax(along, across)) / over;
}

/* Stiffness and damping of all elements but drag at every particle, 2n. */
static void add_rows(const hooke_system *system, double *stiffness, double *damping) {
  struct hk_elements at;
  hk_begin_elements(system, system->position, NULL, &at);
  at.kinds = ~HOOKE_UNIFORM;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    const double k = larger(e->k_along, e->k_across, e->over), c = larger(e->c_along, e->c_across, e->over);
    for (int j = 0; j < e->count; j++) {
      const double row = hk_element_row(system->constrained, e, j);
      stiffness[e->particle[j]] += row * k;
      damping[e->particle[j]] += row * c;
    }
  }
}

/* The largest step [s] that is stable for certain, at any positions. HOOKE_NO_MEMORY. */
static int32_t find_bound(const hooke_system *system, double *bound) {
  const int64_t n = system->particle_count;
  double *stiffness = hk_new(2 * n, sizeof(double)), *damping = stiffness ? stiffness + n : NULL;
  if (stiffness == NULL) return HOOKE_NO_MEMORY;
  add_rows(system, stiffness, damping);
  *bound = INFINITY;
  for (int64_t p = 0; p < n; p++) {
    const double w = system->inverse_mass[p], k = w * stiffness[p], c = w * damping[p];
    if (k > 0.0 || c > 0.0) *bound = fmin(*bound, 4.0 / (c + sqrt(c * c + 4.0 * k)));
  }
  hk_free(stiffness);
  return HOOKE_OK;
}

/* 1 if no bound holds wherever the particles are, and however fast: with dampers of springs that only pull,
 * and with altitude springs, of which one of seven altitudes acts, with weights of its own. */
static int32_t depends_on_state(const hooke_system *system) {
  int32_t depends = system->altitudes->count > 0;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const int32_t both = HOOKE_RUN_DAMPED | HOOKE_RUN_PULL_ONLY;
    depends |= (system->springs->run[r].shape & both) == both;
  }
  return depends;
}

int32_t hk_verlet_explicit_step(const hooke_system *system, double *step) {
  *step = hk_system_is_damped(system, ~HOOKE_UNIFORM) ? 0.0 : INFINITY;
  if (isinf(*step) || depends_on_state(system)) return HOOKE_OK;
  const int32_t status = find_bound(system, step);
  *step *= MARGIN;
  return status;
}

static int32_t refuse_step(double step, double most) {
  char given[HOOKE_NUMBER_SIZE], allowed[HOOKE_NUMBER_SIZE];
  hk_number_print(step, given);
  hk_number_print(most, allowed);
  return hk_fail(HOOKE_BAD_VALUE, "step",
                 "%s s is too large for damping that is explicit; "
                 "allowed: up to %s s, or verlet_damping \"implicit\"",
                 given, allowed);
}

/* Damping is taken at the predicted velocity. */
static int32_t choose_with_bodies(hooke_integrator *it, const char *asked) {
  it->explicit_damping = hk_system_is_damped(it->system, ~HOOKE_UNIFORM);
  if (strcmp(asked, "implicit") != 0) return HOOKE_OK;
  return hk_fail(HOOKE_UNSUITED, "verlet_damping",
                 "implicit does not know rigid bodies yet; allowed: auto, explicit");
}

int32_t hk_verlet_choose(hooke_integrator *it) {
  const char *asked = hooke_options_text(it->options, "verlet_damping");
  if (it->system->mover_count > 0) return choose_with_bodies(it, asked);
  const int required = strcmp(asked, "explicit") == 0;
  double most;
  if (!hk_system_is_damped(it->system, ~HOOKE_UNIFORM)) {
    if (it->by_tiles) it->by_tiles |= HOOKE_MOTION_KEEPS;
    return HOOKE_OK;
  }
  if (required && depends_on_state(it->system))
    return hk_fail(HOOKE_UNSUITED, "verlet_damping",
                   "damping is solved for where damped springs only pull, and beside altitude springs");
  const int32_t status = hk_verlet_explicit_step(it->system, &most);
  if (status != HOOKE_OK) return status;
  const int32_t allowed = it->schedule.step <= most;
  if (required && !allowed) return refuse_step(it->schedule.step, most);
  it->explicit_damping = allowed && strcmp(asked, "implicit") != 0;
  if (!it->explicit_damping) it->by_tiles = 0;
  return hooke_options_set_text(it->options, "verlet_damping",
                                it->explicit_damping ? "explicit" : "implicit");
}
