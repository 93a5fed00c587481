/* The run loop, one for all methods: steps, frames, observers, checks. */
#include "integrate/loop/run_loop.h"

#include "core/thread_pool.h"
#include "core/status.h"
#include "model/coordinates/coordinates.h"

#include <math.h>
#include <stdio.h>

int32_t hk_run_check_state(const hooke_integrator *it, const hooke_state *state) {
  const int32_t status = hk_integrator_check_state(it, state);
  return status == HOOKE_OK ? hk_pool_renew(it->pool) : status;
}

static int32_t check_numbers(const hooke_integrator *it, const hooke_state *state) {
  const int64_t count = (state->has_v ? 2 : 1) * state->size;
  if (!isfinite(*state->t))
    return hk_fail(HOOKE_BAD_VALUE, "time", "%g is not allowed; a run starts at a finite number", *state->t);
  for (int64_t k = 0; k < count; k++) {
    if (isfinite(state->q[k])) continue;
    const long long at = (long long)(k % state->size);
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a run starts at finite numbers", state->q[k]);
    const char *name = it->system == NULL ? "x" : k < state->size ? "position" : "velocity";
    if (it->system == NULL || it->system->generalized)
      return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", name, at);
    return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld][%lld]", name, at / 3, at % 3);
  }
  return HOOKE_OK;
}

int32_t hk_run_begin(hooke_integrator *it, hooke_state *state) {
  const int32_t status = hk_run_begin_later(it, state);
  if (status == HOOKE_OK) hk_recent_set_first(&it->recent, state);
  return status;
}

int32_t hk_run_begin_later(hooke_integrator *it, hooke_state *state) {
  it->t0 = it->t = *state->t;
  it->k = it->frames = 0;
  it->phase = HOOKE_NOT_BEGUN;
  it->point = 1;
  it->stop_value = 0;
  int32_t status = hk_run_place_driven(it, state);
  if (status == HOOKE_OK) status = check_numbers(it, state);
  if (status == HOOKE_OK && it->system) status = hk_movers_check_state(it->system, state);
  if (status == HOOKE_OK) {
    hk_divergence_begin(it, state);
    status = it->method->steps->begin(it, state);
  }
  if (status == HOOKE_OK) status = hk_run_keep_restart(it, state);
  hk_passages_begin(it, it->t0);
  if (status == HOOKE_OK) it->phase = HOOKE_BEGUN;
  return status;
}

static int64_t until_multiple(int64_t k, int64_t stride) {
  return stride - k % stride;
}

static int sees_step(const hooke_integrator *it) {
  return it->on_step.observer && it->k % it->on_step.stride == 0;
}

/* Events after the current step. */
struct due {
  int frame, point, seen, sampled; /* a frame, a checkpoint, observers of steps, a sample */
  int thorough, checked;           /* a check for divergence, with energy or of any kind */
};

/* `shows`: 1 if the state at step `last` is needed in any case. */
static struct due find_due(const hooke_integrator *it, int64_t last, int64_t frame_steps, int64_t point_steps,
                           int64_t sample_steps, int32_t shows) {
  struct due due = {.frame = frame_steps && hk_schedule_has_frame(&it->schedule, it->k),
                    .point = point_steps && it->k % point_steps == 0 && it->k < last,
                    .sampled = sample_steps && hk_schedule_has_frame(&it->sampling, it->k),
                    .seen = it->on_motion.observer || sees_step(it)};
  due.thorough = due.frame || it->thorough || it->k % HOOKE_CHECK_STEPS == 0;
  due.checked = due.thorough || due.point || (shows && it->k == last);
  return due;
}

/* Number of steps before the next event. */
static int64_t steps_to_take(const hooke_integrator *it, int64_t last, int64_t frame_steps,
                             int64_t point_steps, int64_t sample_steps) {
  int64_t count = last - it->k, next = until_multiple(it->k, HOOKE_CHECK_STEPS);
  if (next < count) count = next;
  if (frame_steps && (next = until_multiple(it->k, frame_steps)) < count) count = next;
  if (sample_steps && (next = until_multiple(it->k, sample_steps)) < count) count = next;
  if (point_steps && (next = until_multiple(it->k, point_steps)) < count) count = next;
  if (it->on_motion.observer) return 1;
  if (it->on_step.observer && (next = until_multiple(it->k, it->on_step.stride)) < count) count = next;
  return count;
}

static int32_t store_and_check(hooke_integrator *it, hooke_state *state, int32_t status, struct due due) {
  const int checked = due.checked && status == HOOKE_OK;
  const int32_t stored = hk_run_store(it, it->t0 + (double)it->k * it->schedule.step, state, checked);
  if (status == HOOKE_OK) status = stored;
  return checked && status == HOOKE_OK ? hk_divergence_check(it, state, due.thorough) : status;
}

/* 1 if only the caller sees states, and then has the last good one. */
static int is_unwatched(const hooke_integrator *it) {
  return it->on_step.observer == NULL && it->on_motion.observer == NULL && it->on_sample.observer == NULL &&
         it->on_checkpoint.observer == NULL && it->checker.look == NULL;
}

int32_t hk_run_fixed(hooke_integrator *it, hooke_state *state, int64_t last, int64_t frame_steps,
                     int32_t shows) {
  const int64_t point_steps = it->on_checkpoint.observer ? it->schedule.checkpoint_steps : 0;
  const int64_t sample_steps = frame_steps && it->on_sample.observer ? it->sampling.frame_steps : 0;
  int32_t status = HOOKE_OK;
  while (it->k < last && status == HOOKE_OK) {
    status = hk_run_take_fixed_steps(it, steps_to_take(it, last, frame_steps, point_steps, sample_steps));
    const struct due due = find_due(it, last, frame_steps, point_steps, sample_steps, shows);
    if (status == HOOKE_OK && !shows && !due.checked && !due.seen && !due.sampled) continue;
    if (status == HOOKE_OK && due.checked && !due.thorough && is_unwatched(it))
      return hk_divergence_glance(it, state);
    status = store_and_check(it, state, status, due);
    if (status == HOOKE_OK && due.seen) status = hk_run_observe(it, &it->on_motion, state);
    if (status == HOOKE_OK && sees_step(it)) status = hk_run_observe(it, &it->on_step, state);
    if (status == HOOKE_OK && due.sampled) status = hk_run_observe(it, &it->on_sample, state);
    if (status == HOOKE_OK && due.frame) status = hk_run_report(it, state);
    if (status == HOOKE_OK && due.point) status = hk_run_observe(it, &it->on_checkpoint, state);
  }
  return status;
}

/* Records the outcome, for a diagnosis, with the state at which a solver gave up. */
int32_t hk_run_end(hooke_integrator *it, hooke_state *state, int32_t status) {
  it->outcome = status;
  it->message[0] = '\0';
  if (status == HOOKE_OK) return status;
  snprintf(it->message, sizeof it->message, "%s", hooke_last_error());
  const int reached = status == HOOKE_SOLVER_FAILED || status == HOOKE_STEP_LIMIT;
  if (reached && hk_all_finite((state->has_v ? 2 : 1) * state->size, state->q))
    hk_recent_keep(&it->recent, state, it->k);
  if (status == HOOKE_DIVERGED && it->recent.capacity == 0 &&
      hk_recent_extend(hk_integrator_numbers(it), 1, &it->recent) == HOOKE_OK)
    hooke_state_copy(state, it->recent.state[0]);
  return status;
}

int32_t hk_run_check_whole(const hooke_integrator *it, const hooke_state *state) {
  const int32_t status = hk_run_check_state(it, state);
  if (status != HOOKE_OK || it->schedule.frames > 0) return status;
  return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
}

int32_t hk_run_to_end(hooke_integrator *it, hooke_state *state) {
  const struct hk_schedule *s = &it->schedule;
  if (!it->method->adaptive) return hk_run_fixed(it, state, s->steps, s->frame_steps, 1);
  return hk_run_adaptive(it, state);
}

int32_t hk_run_whole(hooke_integrator *it, hooke_state *state) {
  int32_t status = hk_run_check_whole(it, state);
  if (status != HOOKE_OK) return status;
  status = hk_run_begin(it, state);
  if (status == HOOKE_OK) status = hk_divergence_check(it, state, 1);
  if (status == HOOKE_OK) it->restart.standing.frames = 1;
  if (status == HOOKE_OK) status = hk_run_observe(it, &it->on_sample, state);
  if (status == HOOKE_OK) status = hk_run_report(it, state);
  if (status == HOOKE_OK) status = hk_run_to_end(it, state);
  return hk_run_end(it, state, status);
}

int32_t hooke_integrator_run(hooke_integrator *it, hooke_state *state) {
  return hk_run_beyond(it, state, hk_run_whole(it, state));
}
