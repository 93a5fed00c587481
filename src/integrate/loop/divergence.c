/* Definition of "diverged": a non-finite component; or, if energy can only come from the scene itself (no
 * callbacks, no drives), a rise of energy by more than 100 times the initial energy and the energy from
 * gravity since then, and from constant loads, which count as gravity throughout:
 *   E(t) - E(0) > 100 (T(0) + U(0) + max |U_gravity - U_gravity(0)| + 1/2 M g^2 h^2 + 1/2 K d^2 + 1/2 M u^2)
 * The last terms are for a scene at rest: the energy from gravity in one step (forward Euler has it in v
 * before q has moved; of loads F^2/m in place of M g^2), and the effect of errors: U is that of springs,
 * bending, altitude springs and anchors, which is below 0 for springs with curves alone, whose depth counts
 * as what gravity gives; K the sum of all kappa, 16 c and 4 ks/l, d = 1e-12 times the largest coordinate,
 * which rounding takes some 1e9 steps to reach; with error control d includes atol, and u is atol_velocity.
 * Energies below the smallest normal number prove nothing, and neither do those of a scene that begins with
 * energies above the largest.
 *
 * The last state that passed is kept in `recent`. If a large scene has no space there, the caller's state is
 * that state until the next one is stored by an exchange: the motion then holds the state to restore if the
 * check fails. Steps in a loop of the caller's own are checked before they are stored, so that neither a copy
 * nor an exchange is needed: the caller's state is the last good one until then, and is kept if it is the
 * last. */
#include "integrate/integrator.h"

#include "core/status.h"
#include "kernel/vector_loops.h"
#include "model/force/force.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double RISE = 100.0, ROUNDING = 1e-12;

static int has_energy_bound(const hooke_integrator *it) {
  return it->system && it->system->force == NULL && !hk_system_takes_work(it->system);
}

int32_t hk_all_finite(int64_t count, const double *value) {
  if (isfinite(hk_long_dot(count, value, value))) return 1; /* by far the quickest; squares may overflow */
  /* 0 * value is 0 or NaN, and a NaN stays in the sum */
  double sum = 0.0;
  for (int64_t k = 0; k < count; k++)
    sum += 0.0 * value[k];
  return sum == 0.0;
}

/* Energy that a scene at rest may acquire. */
static double least_energy(const hooke_integrator *it, const hooke_state *state) {
  const hooke_system *system = it->system;
  double mass = 0.0, stiffness = 0.0, extent = 0.0, force = 0.0, kick = 0.0;
  for (int64_t p = 0; p < system->particle_count; p++)
    mass += system->constrained[p] || system->overdamped ? 0.0 : system->mass[p];
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add_stiffness) row->add_stiffness(system, &stiffness);
    if (row->add_pull && !system->overdamped) row->add_pull(system, &force, &kick);
  }
  for (int64_t k = 0; k < state->size; k++)
    extent = fmax(extent, fabs(state->q[k]));
  if (it->method->adaptive) {
    const double d = ROUNDING * extent + hooke_options_number(it->options, "atol");
    const double u = hooke_options_number(it->options, "atol_velocity");
    return 0.5 * stiffness * d * d + 0.5 * mass * u * u;
  }
  const double d = ROUNDING * extent, h = it->schedule.step;
  return 0.5 * kick * h * h + 0.5 * stiffness * d * d;
}

void hk_divergence_begin(hooke_integrator *it, const hooke_state *state) {
  it->diverged_at = NAN;
  it->energies.system = NULL;
  if (has_energy_bound(it)) {
    const struct hk_energies at = hk_state_energies(state, it->system);
    it->gravity0 = at.gravity;
    it->gravity_swing = 0.0;
    it->scale0 = at.kinetic + fabs(at.elastic) + least_energy(it, state);
    it->energy0 = at.kinetic + at.elastic;
  }
  it->recent.count = 0;
  hk_recent_keep(&it->recent, state, 0);
  it->good.t = *state->t;
  it->good.unkept = 0;
}

static int energy_is_bounded(hooke_integrator *it, const hooke_state *state, double *energy) {
  it->energies = hk_state_energies(state, it->system);
  const double gravity = it->energies.gravity, risen = gravity - it->gravity0;
  const double rest = it->energies.kinetic + it->energies.elastic;
  it->gravity_swing = fmax(it->gravity_swing, fmax(fabs(risen), -it->energies.elastic));
  *energy = rest + gravity;
  /* far from the origin gravity's energy has no digits left for the others */
  return !(it->scale0 < INFINITY) ||
         (rest - it->energy0) + risen <= RISE * (it->scale0 + it->gravity_swing) + DBL_MIN;
}

void hk_divergence_follow(hooke_integrator *it, const hooke_state *state) {
  double energy;
  if (has_energy_bound(it)) energy_is_bounded(it, state, &energy);
}

void hk_store_good(const hooke_integrator *it, hooke_state *state) {
  if (it->motion)
    hk_motion_store(it->motion, state->q, state->v);
  else
    memcpy(state->q, it->numbers.x, (size_t)it->size * sizeof(double));
  *state->t = it->good.t;
}

int32_t hk_divergence_keep(hooke_integrator *it) {
  struct hk_recent *recent = &it->recent;
  const int was_empty = recent->capacity == 0;
  const int32_t status = was_empty ? hk_recent_extend(hk_integrator_numbers(it), 1, recent) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (was_empty && recent->count > 0) hk_store_good(it, recent->state[0]);
  if (it->good.unkept) hk_store_good(it, hk_recent_next(recent, it->good.step));
  it->good.unkept = 0;
  return HOOKE_OK;
}

static const char *advice(const hooke_integrator *it) {
  return it->method->adaptive ? "tighter tolerances" : "a smaller step";
}

int32_t hk_divergence_store(hooke_integrator *it, double t, hooke_state *state) {
  if (it->recent.capacity > 0) return it->method->steps->store(it, t, state);
  hk_motion_exchange(it->motion, state->q, state->v);
  return HOOKE_OK;
}

static void put_back(hooke_integrator *it, hooke_state *state) {
  if (it->recent.capacity > 0) {
    hooke_state_copy(hk_recent_state(&it->recent, 0, NULL), state);
    return;
  }
  hk_motion_exchange(it->motion, state->q, state->v);
  *state->t = it->good.t;
}

static int32_t pass(hooke_integrator *it, const hooke_state *state) {
  hk_recent_keep(&it->recent, state, it->k);
  it->good.t = *state->t;
  if (it->recent.capacity == 0) hk_motion_load(it->system, it->motion, state->q, state->v);
  if (it->checker.look == NULL) return HOOKE_OK;
  it->stop_value = it->checker.look(it, state, it->checker.own);
  if (it->stop_value == 0) return HOOKE_OK;
  return hk_fail(HOOKE_STOPPED, NULL, "a warning callback returned %d at t = %.6g s", (int)it->stop_value,
                 *state->t);
}

static int32_t fail_not_finite(const hooke_integrator *it, double good_time) {
  return hk_fail(HOOKE_DIVERGED, NULL,
                 "the run diverged: a position or velocity is not finite at t = %.6g s; the state kept is "
                 "that of t = %.6g s; try %s",
                 it->diverged_at, good_time, advice(it));
}

int32_t hk_motion_is_finite(const hooke_integrator *it) {
  if (it->motion == NULL) return hk_all_finite(it->size, it->numbers.x);
  int32_t finite = 1;
  for (int a = 0; a < 3; a++) {
    finite &= hk_all_finite(it->motion->n, it->motion->q[a]);
    finite &= hk_all_finite(it->motion->n, it->motion->v[a]);
  }
  return finite;
}

int32_t hk_divergence_glance(hooke_integrator *it, hooke_state *state) {
  if (hk_motion_is_finite(it)) {
    it->good.t = it->t;
    it->good.step = it->k;
    it->good.unkept = it->recent.capacity > 0;
    if (!it->good.unkept) hk_recent_next(&it->recent, it->k);
    return it->method->steps->store(it, it->t, state);
  }
  it->diverged_at = it->t;
  if (it->good.unkept) hk_recent_keep(&it->recent, state, it->good.step);
  it->good.unkept = 0;
  return fail_not_finite(it, *state->t);
}

int32_t hk_divergence_check(hooke_integrator *it, hooke_state *state, int32_t with_energy) {
  it->energies.system = NULL;
  double energy = NAN;
  const double t = *state->t;
  const int finite =
      hk_all_finite(state->size, state->q) && (!state->has_v || hk_all_finite(state->size, state->v));
  if (finite && (!with_energy || !has_energy_bound(it) || energy_is_bounded(it, state, &energy))) {
    return pass(it, state);
  }
  it->diverged_at = t;
  put_back(it, state);
  if (!finite) return fail_not_finite(it, *state->t);
  return hk_fail(
      HOOKE_DIVERGED, NULL,
      "the run diverged: at t = %.6g s the energy has risen from %g to %g J, over 100 times the %g J that "
      "motion, springs and changes of height had; the state kept is that of t = %.6g s; try %s",
      t, it->energy0 + it->gravity0, energy, it->scale0 + it->gravity_swing, *state->t, advice(it));
}
