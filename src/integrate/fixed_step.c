/* What all fixed-step methods share: forces and rates that are counted, loading and storing. */
#include "integrate/integrator.h"

#include "core/status.h"
#include "model/force.h"

#include <stddef.h>
#include <string.h>

static int32_t keep_stop_value(hooke_integrator *it, int32_t status) {
  if (status == HOOKE_STOPPED) it->stop_value = it->motion->stop_value;
  return status;
}

int32_t hooke_integrator_forces(hooke_integrator *it, double t) {
  return hooke_integrator_forces_without(it, t, NULL);
}

int32_t hooke_integrator_forces_without(hooke_integrator *it, double t,
                                        const struct hooke_force_row *left_out) {
  it->count.force_evaluations++;
  return keep_stop_value(it, hooke_motion_forces_without(it->system, it->motion, t, left_out));
}

int32_t hooke_integrator_move(hooke_integrator *it, int32_t kind) {
  const hooke_system *system = it->system;
  struct hooke_motion *m = it->motion;
  const double step = it->schedule.step;
  if (m->f[0] == NULL) {
    struct hooke_move move = {kind, system->has_gravity, step, system->drag, {0.0}};
    memcpy(move.gravity, system->gravity, sizeof move.gravity);
    it->count.force_evaluations++;
    hooke_motion_pass(system, m, &move);
    return HOOKE_OK;
  }
  const int32_t status = hooke_integrator_forces(it, it->t);
  if (status != HOOKE_OK) return status;
  hooke_step_loop *loop = hooke_step_loop_of(kind);
  for (int64_t s = 0; s < system->span_count; s++) {
    const int64_t from = system->span[s].from;
    for (int a = 0; a < 3; a++) {
      loop(system->span[s].count, step, system->inverse_mass + from, m->f[a] + from,
           system->has_gravity ? &system->gravity[a] : NULL, m->q[a] + from, m->v[a] + from);
    }
  }
  return HOOKE_OK;
}

double hooke_integrator_next_time(const hooke_integrator *it) {
  return it->t0 + (double)(it->k + 1) * it->schedule.step;
}

int32_t hooke_integrator_drive(hooke_integrator *it, double t) {
  if (it->system == NULL || it->system->drive_count == 0) return HOOKE_OK;
  return keep_stop_value(it, hooke_motion_drive(it->system, it->motion, t));
}

int32_t hooke_integrator_hold(hooke_integrator *it, double t) {
  const int32_t status = hooke_integrator_drive(it, t);
  if (status == HOOKE_OK) hooke_motion_hold(it->system, it->motion);
  return status;
}

int32_t hooke_integrator_rate(hooke_integrator *it, double t, const double *x, double *slope) {
  it->count.force_evaluations++;
  const int32_t value = it->rate(it->size, t, x, slope, it->rate_ctx);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hooke_fail(HOOKE_STOPPED, NULL, "the rate callback returned %d at t = %.17g s", (int)value, t);
}

int32_t hooke_fixed_begin(hooke_integrator *it, const hooke_state *state) {
  if (it->motion)
    hooke_motion_load(it->system, it->motion, state->q, state->v);
  else
    memcpy(it->x, state->q, (size_t)it->size * sizeof(double));
  return HOOKE_OK;
}

int32_t hooke_fixed_store(hooke_integrator *it, double t, hooke_state *state) {
  if (it->motion)
    hooke_motion_store(it->motion, state->q, state->v);
  else
    memcpy(state->q, it->x, (size_t)it->size * sizeof(double));
  *state->t = t;
  return HOOKE_OK;
}
