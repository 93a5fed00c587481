/* What "diverged" means: a component that is not finite; or, where energy can only come from the scene itself (no
 * callbacks, no drives), a rise of energy by more than 100 times what the scene had at the start and what gravity
 * has given since:
 *   E(t) - E(0) > 100 (T(0) + U_springs(0) + max |U_gravity - U_gravity(0)| + 1/2 M g^2 h^2)
 * The last term is what gravity gives a scene at rest in one step: forward Euler has it in v before q has moved. */
#include "integrate/integrator.h"

#include "core/status.h"

#include <math.h>
#include <stddef.h>

static const double RISE = 100.0;

static int has_energy_bound(const hooke_integrator *it) {
  return it->system && it->system->force == NULL && it->system->drive_count == 0;
}

static int all_finite(int64_t count, const double *value) {
  /* 0 * value is 0 or not a number, and one of those stays in the sum */
  double sum = 0.0;
  for (int64_t k = 0; k < count; k++)
    sum += 0.0 * value[k];
  return sum == 0.0;
}

static double first_step_energy(const hooke_integrator *it) {
  const double *g = it->system->gravity, h = it->method->adaptive ? 0.0 : it->schedule.step;
  double mass = 0.0;
  for (int64_t p = 0; p < it->system->particle_count; p++)
    mass += it->system->held[p] ? 0.0 : it->system->mass[p];
  return 0.5 * mass * ((g[0] * g[0] + g[1] * g[1]) + g[2] * g[2]) * h * h;
}

int32_t hooke_divergence_begin(hooke_integrator *it, const hooke_state *state) {
  it->diverged_at = NAN;
  if (has_energy_bound(it)) {
    const double kinetic = hooke_system_kinetic_energy(it->system, state->v);
    const double springs = hooke_system_spring_energy(it->system, state->q);
    it->gravity0 = hooke_system_gravity_energy(it->system, state->q);
    it->gravity_swing = 0.0;
    it->scale0 = kinetic + springs + first_step_energy(it);
    it->energy0 = kinetic + springs + it->gravity0;
  }
  return hooke_state_copy(state, it->good);
}

static int energy_is_bounded(hooke_integrator *it, const hooke_state *state, double *energy) {
  const double gravity = hooke_system_gravity_energy(it->system, state->q);
  it->gravity_swing = fmax(it->gravity_swing, fabs(gravity - it->gravity0));
  *energy = hooke_system_kinetic_energy(it->system, state->v) +
            hooke_system_spring_energy(it->system, state->q) + gravity;
  return *energy - it->energy0 <= RISE * (it->scale0 + it->gravity_swing);
}

int32_t hooke_divergence_check(hooke_integrator *it, hooke_state *state, int32_t with_energy) {
  double energy = NAN;
  const double t = *state->t;
  const int finite =
      all_finite(state->size, state->q) && (!state->has_v || all_finite(state->size, state->v));
  if (finite && (!with_energy || !has_energy_bound(it) || energy_is_bounded(it, state, &energy))) {
    return hooke_state_copy(state, it->good);
  }
  it->diverged_at = t;
  hooke_state_copy(it->good, state);
  if (!finite) {
    return hooke_fail(
        HOOKE_DIVERGED, NULL,
        "the run diverged: a position or velocity is not finite at t = %.17g s; the state kept is that of "
        "t = %.17g s; try a smaller step",
        t, *state->t);
  }
  return hooke_fail(
      HOOKE_DIVERGED, NULL,
      "the run diverged: at t = %.17g s the energy has risen from %g to %g J, over 100 times what the scene "
      "had; the state kept is that of t = %.17g s; try a smaller step",
      t, it->energy0, energy, *state->t);
}
