/* What the loops of all methods are made of: steps with progress told in between, and what is shown of them.
 */
#include "integrate/loop/run_loop.h"

#include "core/clock.h"
#include "core/status.h"
#include "model/coordinates/coordinates.h"

#include <math.h>

static const double LOOK = 1e-3; /* [s] between two clock readings */

int32_t hk_run_place_driven(hooke_integrator *it, hooke_state *state) {
  if (it->system == NULL || (it->system->drive_count == 0 && !it->system->overdamped)) return HOOKE_OK;
  hk_motion_load(it->system, it->motion, state->q, state->v);
  int32_t status = hk_integrator_hold(it, *state->t);
  if (status == HOOKE_OK) status = hk_integrator_flow(it, *state->t);
  if (status == HOOKE_OK) hk_motion_store(it->motion, state->q, state->v);
  return status;
}

int32_t hk_run_observe(hooke_integrator *it, const struct hk_watch *watch, const hooke_state *state) {
  if (watch->observer == NULL) return HOOKE_OK;
  const int32_t value = watch->observer(it->k, state, watch->ctx);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hk_fail(HOOKE_STOPPED, NULL, "an observer returned %d at t = %.6g s", (int)value, *state->t);
}

int32_t hk_run_report(hooke_integrator *it, hooke_state *state) {
  it->frames++;
  state->known = it->energies.system ? &it->energies : NULL;
  const int32_t status = hk_run_observe(it, &it->on_frame, state);
  state->known = NULL;
  return status;
}

int32_t hk_run_store(hooke_integrator *it, double t, hooke_state *state, int32_t checked) {
  it->energies.system = NULL;
  if (it->good.unkept) hk_recent_keep(&it->recent, state, it->good.step); /* so far `state` is that one */
  it->good.unkept = 0;
  const int32_t status = checked ? hk_divergence_store(it, t, state) : it->method->steps->store(it, t, state);
  if (!checked && it->recent.capacity == 0) it->recent.count = 0; /* the last good state is lost */
  *state->t = t;
  return status;
}

static int32_t tell(hooke_integrator *it) {
  const struct hk_teller *teller = &it->teller;
  const double fraction = (it->t - it->t0) / it->schedule.duration; /* NaN without a duration */
  const int32_t value =
      teller->progress(fraction > 0.0 ? fmin(fraction, 1.0) : 0.0, it->method->name, teller->ctx);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop at t = %.6g s", it->t);
}

int32_t hk_integrator_tell(hooke_integrator *it) {
  struct hk_teller *teller = &it->teller;
  if (teller->progress == NULL) return HOOKE_OK;
  const double now = hk_clock_seconds();
  if (now - teller->told < fmax(LOOK, teller->every)) return HOOKE_OK;
  teller->told = now;
  return tell(it);
}

int32_t hk_run_tell(hooke_integrator *it, int64_t steps) {
  struct hk_teller *teller = &it->teller;
  if (teller->progress == NULL || (teller->left -= steps) > 0) return HOOKE_OK;
  const double now = hk_clock_seconds(), since = now - teller->looked;
  if (since < 0.5 * LOOK) teller->stride *= 2;
  if (since > 2.0 * LOOK && teller->stride > 1) teller->stride /= 2;
  teller->left = teller->stride;
  teller->looked = now;
  if (now - teller->told < teller->every) return HOOKE_OK;
  teller->told = now;
  return tell(it);
}

/* `count` steps of a fixed-step method; time is t0 + k h, not a running sum. A callback that stops leaves the
 * last whole step: drives are called for the end of a step before anything moves. */
static int32_t take_untold_steps(hooke_integrator *it, int64_t count) {
  int32_t status = HOOKE_OK;
  const double begun = hk_clock_seconds();
  for (int64_t s = 0; s < count && status == HOOKE_OK; s++) {
    const double next = hk_integrator_next_time(it);
    status = hk_integrator_drive(it, next);
    it->goes_on = s + 1 < count;
    if (status != HOOKE_OK) break;
    if (it->start) hk_motion_save(it->motion, it->start);
    status = it->method->steps->step(it);
    if (status != HOOKE_OK && it->start) hk_motion_restore(it->motion, it->start);
    if (status != HOOKE_OK) break;
    if (it->system && it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
    const double from = it->t;
    it->t = next;
    it->k++;
    it->count.steps++;
    status = hk_passages_count(it, from, next);
  }
  it->wall_seconds += hk_clock_seconds() - begun;
  return status;
}

int32_t hk_run_take_fixed_steps(hooke_integrator *it, int64_t count) {
  const int64_t before = it->k;
  int32_t status = HOOKE_OK;
  while (count > 0 && status == HOOKE_OK) {
    const int64_t left = it->teller.progress ? it->teller.left : count, steps = left < count ? left : count;
    status = take_untold_steps(it, steps);
    if (status == HOOKE_OK) status = hk_run_tell(it, steps);
    count -= steps;
  }
  if (it->k > before && hk_integrator_skips_unacted(it))
    hk_movers_write(it->system, it->motion, it->numbers.x, 0);
  return status;
}
