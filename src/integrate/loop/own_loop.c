/* Time loops of the caller's own: steps that leave a valid state, and steps of the motion only, with access
 * to it. */
#include "integrate/loop/run_loop.h"

#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* 1 if the last call left a motion that steps can continue. */
static int goes_on(const hooke_integrator *it) {
  return it->phase == HOOKE_AT_CHECKPOINT ||
         (it->phase == HOOKE_BEGUN && (it->outcome == HOOKE_OK || it->outcome == HOOKE_STOPPED));
}

/* 1 if that is at `state`, to the bit. For an error-controlled method the states it returned count. */
static int is_at(const hooke_integrator *it, const hooke_state *state) {
  const hooke_state *last = hk_recent_state(&it->recent, 0, NULL);
  const size_t bytes = (size_t)state->size * sizeof(double);
  if (it->method->adaptive)
    return last && memcmp(last->t, state->t, (state->has_v ? 2 : 1) * bytes + sizeof(double)) == 0;
  if (memcmp(&it->t, state->t, sizeof(double)) != 0) return 0;
  return it->motion ? hk_motion_is_at(it->motion, state->q, state->v)
                    : memcmp(it->numbers.x, state->q, bytes) == 0;
}

static int32_t check_steps(int64_t steps) {
  if (steps >= 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "steps", "%lld is not allowed; 0 or more are", (long long)steps);
}

static int32_t check_total(const hooke_integrator *it, int64_t steps) {
  if (steps <= HOOKE_MOST_STEPS - it->k) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "steps", "%lld after %lld are too many; allowed: %lld in all",
                 (long long)steps, (long long)it->k, (long long)HOOKE_MOST_STEPS);
}

static int32_t take_steps(hooke_integrator *it, hooke_state *state, int64_t steps, int32_t shows) {
  it->stop_value = 0; /* of a call that was stopped */
  const int32_t status = it->method->adaptive ? hk_run_internal_steps(it, state, steps, shows)
                                              : hk_run_fixed(it, state, it->k + steps, 0, shows);
  return hk_run_end(it, state, status);
}

static void leave_checkpoint(hooke_integrator *it) {
  if (it->phase == HOOKE_AT_CHECKPOINT) it->phase = HOOKE_BEGUN;
}

int32_t hooke_integrator_step(hooke_integrator *it, hooke_state *state, int64_t steps) {
  int32_t status = hk_run_check_state(it, state);
  if (status == HOOKE_OK) status = check_steps(steps);
  if (status != HOOKE_OK) return status;
  if (it->k == 0 || !goes_on(it) || !is_at(it, state)) status = hk_run_begin(it, state);
  leave_checkpoint(it);
  if (status != HOOKE_OK) return hk_run_end(it, state, status);
  status = check_total(it, steps);
  return status == HOOKE_OK ? take_steps(it, state, steps, 1) : status;
}

static int32_t check_begin(const hooke_integrator *it, const hooke_state *state, double t0, int64_t step) {
  const double t = t0 + (double)step * it->schedule.step;
  if (it->method->adaptive)
    return hk_fail(HOOKE_UNSUITED, "method", "%s chooses its steps; allowed: methods with a fixed step",
                   it->method->name);
  if (step < 0 || step > HOOKE_MOST_STEPS)
    return hk_fail(HOOKE_BAD_VALUE, "step", "%lld is not allowed; 0 to %lld are", (long long)step,
                   (long long)HOOKE_MOST_STEPS);
  if (memcmp(&t, state->t, sizeof t) == 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "state", "is at %.17g s; after %lld steps from %.17g s it is %.17g s",
                 *state->t, (long long)step, t0, t);
}

int32_t hooke_integrator_begin(hooke_integrator *it, hooke_state *state, double t0, int64_t step) {
  const struct hk_standing before = it->standing;
  const int goes_on = it->phase != HOOKE_NOT_BEGUN && before.t0 == t0 && before.k < step;
  int32_t status = hk_run_check_state(it, state);
  if (status == HOOKE_OK) status = check_begin(it, state, t0, step);
  if (status != HOOKE_OK) return status;
  status = hk_run_begin_later(it, state);
  hk_recent_set_first(&it->recent, NULL);
  if (goes_on) it->standing = before;
  it->t0 = t0;
  it->t = *state->t;
  it->k = it->recent.step[it->recent.newest] = step;
  if (goes_on && status == HOOKE_OK) status = hk_divergence_check(it, state, 1);
  return hk_run_end(it, state, status);
}

static int32_t require_motion(const hooke_integrator *it) {
  if (goes_on(it)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL, "%s; hooke_integrator_step() with 0 steps begins one at a state",
                 it->phase == HOOKE_BEGUN ? "the motion has ended early" : "there is no motion");
}

/* A state of the integrator's own. */
static int32_t make_shown(hooke_integrator *it) {
  if (it->shown) return HOOKE_OK;
  return hk_state_create_sized(hk_integrator_numbers(it), it->system != NULL, &it->shown);
}

/* A copy of the last good state, since the caller's is left alone. */
static int32_t keep_start(hooke_integrator *it) {
  if (it->recent.count == 0) { /* stopped where the run had nothing to check */
    it->good.t = it->t;
    it->good.step = it->k;
    it->good.unkept = 1;
  }
  return it->good.unkept || it->recent.capacity == 0 ? hk_divergence_keep(it) : HOOKE_OK;
}

int32_t hooke_integrator_advance(hooke_integrator *it, int64_t steps) {
  int32_t status = require_motion(it);
  if (status == HOOKE_OK) status = check_steps(steps);
  if (status == HOOKE_OK) status = check_total(it, steps);
  if (status == HOOKE_OK) status = hk_pool_renew(it->pool);
  if (status == HOOKE_OK) status = make_shown(it);
  if (status == HOOKE_OK) status = keep_start(it);
  if (status != HOOKE_OK) return status;
  leave_checkpoint(it);
  return take_steps(it, it->shown, steps, 0);
}

int32_t hooke_integrator_sync(hooke_integrator *it, hooke_state *state) {
  int32_t status = hk_run_check_state(it, state);
  if (status != HOOKE_OK) return status;
  if (it->phase == HOOKE_NOT_BEGUN) return require_motion(it);
  if (it->outcome == HOOKE_DIVERGED && it->phase == HOOKE_BEGUN) return hooke_integrator_recent(it, 0, state);
  status = it->method->steps->store(it, it->t, state);
  *state->t = it->t;
  if (status != HOOKE_OK || !goes_on(it)) return status;
  it->good.unkept = 0; /* the state is that one */
  status = hk_divergence_check(it, state, it->thorough);
  return status == HOOKE_OK ? status : hk_run_end(it, state, status);
}

/* ---- single particles ---- */

/* With the motion of an error-controlled method, which only its solver holds, in `shown`. */
static int32_t prepare_particles(hooke_integrator *it, int64_t count, const int64_t *particles) {
  int32_t status = hk_integrator_require_particles(it, "particles", "has none; take hooke_integrator_sync()");
  if (status == HOOKE_OK) status = require_motion(it);
  if (status == HOOKE_OK && count < 0)
    status = hk_fail(HOOKE_BAD_VALUE, "count", "%lld is not allowed; 0 or more are", (long long)count);
  if (status == HOOKE_OK) status = hk_system_check_particles(it->system, "particles", count, particles, 0);
  if (status != HOOKE_OK) return status;
  if (!it->method->adaptive) return hk_motion_know_numbers(it->motion);
  status = make_shown(it);
  return status == HOOKE_OK ? it->method->steps->store(it, it->t, it->shown) : status;
}

static void get_row(const hooke_integrator *it, int64_t particle, double *const component[3],
                    const double *rows, double *row) {
  const int64_t p = it->method->adaptive ? particle : hk_motion_number(it->motion, particle);
  for (int a = 0; a < 3; a++)
    row[a] = it->method->adaptive ? rows[3 * p + a] : component[a][p];
}

int32_t hooke_integrator_get(hooke_integrator *it, int64_t count, const int64_t *particles, double *q,
                             double *v) {
  const int32_t status = prepare_particles(it, count, particles);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < count; k++) {
    if (q) get_row(it, particles[k], it->motion->q, it->shown ? it->shown->q : NULL, q + 3 * k);
    if (v) get_row(it, particles[k], it->motion->v, it->shown ? it->shown->v : NULL, v + 3 * k);
  }
  return HOOKE_OK;
}

static int32_t check_rows(const char *name, int64_t count, const double *rows) {
  if (rows == NULL || hk_all_finite(3 * count, rows)) return HOOKE_OK;
  int64_t k = 0;
  while (isfinite(rows[k]))
    k++;
  hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a motion has finite numbers", rows[k]);
  return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld][%d]", name, (long long)(k / 3), (int)(k % 3));
}

static void put_rows(hooke_integrator *it, int64_t particle, const double *q, const double *v) {
  if (it->system->constrained[particle] == HOOKE_IS_DRIVEN) return;
  const size_t bytes = 3 * sizeof(double);
  if (!it->method->adaptive)
    hk_motion_place(it->system, it->motion, particle, q, v);
  else {
    if (q) memcpy(it->shown->q + 3 * particle, q, bytes);
    if (v) memcpy(it->shown->v + 3 * particle, v, bytes);
  }
}

int32_t hooke_integrator_put(hooke_integrator *it, int64_t count, const int64_t *particles, const double *q,
                             const double *v) {
  int32_t status = prepare_particles(it, count, particles);
  if (status == HOOKE_OK) status = check_rows("position", count, q);
  if (status == HOOKE_OK) status = check_rows("velocity", count, v);
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    if (!hk_is_carried(it->system, particles[k])) continue;
    hk_fail(HOOKE_UNSUITED, NULL, "particle %lld moves with a rigid body; change a state, and begin there",
            (long long)particles[k]);
    status = hk_fail_within(HOOKE_UNSUITED, "particles[%lld]", (long long)k);
  }
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < count; k++)
    put_rows(it, particles[k], q ? q + 3 * k : NULL, v ? v + 3 * k : NULL);
  hk_passages_begin(it, it->t);
  it->scale0 = INFINITY; /* energy comes from outside: a rise of it proves nothing */
  if (it->method->steps->forget) it->method->steps->forget(it);
  if (it->method->adaptive) return it->method->steps->begin(it, it->shown);
  return hk_integrator_flow(it, it->t);
}
