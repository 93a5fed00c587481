/* The run loop, one for all methods: steps, frames, observers, checks. */
#include "integrate/integrator.h"

#include "core/clock.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

enum { CHECK_STEPS = 1000 };

static int32_t check_state(const hooke_integrator *it, const hooke_state *state) {
  if (state->size == it->size && state->has_v == (it->system != NULL)) return HOOKE_OK;
  return hooke_fail(HOOKE_BAD_VALUE, "state", "a state of %lld numbers does not fit a problem of %lld",
                    (long long)state->size, (long long)it->size);
}

/* Driven particles go where their motion has them at the time of the state, whatever the caller wrote there.
 */
static int32_t place_driven(hooke_integrator *it, hooke_state *state) {
  if (it->system == NULL || it->system->drive_count == 0) return HOOKE_OK;
  hooke_motion_load(it->system, it->motion, state->q, state->v);
  const int32_t status = hooke_integrator_hold(it, *state->t);
  if (status == HOOKE_OK) hooke_motion_store(it->motion, state->q, state->v);
  return status;
}

static int32_t begin(hooke_integrator *it, hooke_state *state) {
  it->t0 = it->t = *state->t;
  it->k = 0;
  it->stop_value = 0;
  int32_t status = place_driven(it, state);
  if (status == HOOKE_OK) status = hooke_divergence_begin(it, state);
  return status == HOOKE_OK ? it->method->begin(it, state) : status;
}

static int32_t observe(hooke_integrator *it, const struct hooke_watch *watch, const hooke_state *state) {
  if (watch->observer == NULL) return HOOKE_OK;
  const int32_t value = watch->observer(it->k, state, watch->ctx);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hooke_fail(HOOKE_STOPPED, NULL, "an observer returned %d at t = %.17g s", (int)value, *state->t);
}

/* Stores the solution at time t, the bits of a frame's time being t itself. */
static int32_t store(hooke_integrator *it, double t, hooke_state *state) {
  const int32_t status = it->method->store(it, t, state);
  *state->t = t;
  return status;
}

/* `count` steps of a fixed-step method; time is t0 + k h, not a running sum. */
static int32_t take_fixed_steps(hooke_integrator *it, int64_t count) {
  int32_t status = HOOKE_OK;
  const double begun = hooke_clock_seconds();
  for (int64_t s = 0; s < count && status == HOOKE_OK; s++) {
    status = it->method->step(it);
    if (status != HOOKE_OK) break;
    it->k++;
    it->count.steps++;
    it->t = it->t0 + (double)it->k * it->schedule.step;
    if (it->system) status = hooke_integrator_hold(it, it->t);
  }
  it->wall_seconds += hooke_clock_seconds() - begun;
  return status;
}

/* One internal step; if it fails, the state is the one before it. */
static int32_t take_adaptive_step(hooke_integrator *it, hooke_state *state) {
  const double begun = hooke_clock_seconds();
  const int32_t status = it->method->step(it);
  it->wall_seconds += hooke_clock_seconds() - begun;
  if (status == HOOKE_OK)
    it->k++;
  else if (it->k > 0)
    it->method->store(it, it->t, state);
  return status;
}

static int64_t until_multiple(int64_t k, int64_t stride) {
  return stride - k % stride;
}

/* On to step `last` with checks and step observers, and frames every `frame_steps` (0: none). */
static int32_t run_fixed(hooke_integrator *it, hooke_state *state, int64_t last, int64_t frame_steps) {
  int32_t status = HOOKE_OK;
  while (it->k < last && status == HOOKE_OK) {
    int64_t count = last - it->k, next = until_multiple(it->k, CHECK_STEPS);
    if (next < count) count = next;
    if (frame_steps && (next = until_multiple(it->k, frame_steps)) < count) count = next;
    if (it->on_step.observer && (next = until_multiple(it->k, it->on_step.stride)) < count) count = next;
    status = take_fixed_steps(it, count);
    const int32_t stored = store(it, it->t0 + (double)it->k * it->schedule.step, state);
    if (status == HOOKE_OK) status = stored;
    const int frame = frame_steps && it->k % frame_steps == 0;
    const int thorough = frame || it->k % CHECK_STEPS == 0;
    if (status == HOOKE_OK && (thorough || it->k == last))
      status = hooke_divergence_check(it, state, thorough);
    if (status == HOOKE_OK && it->on_step.observer && it->k % it->on_step.stride == 0) {
      status = observe(it, &it->on_step, state);
    }
    if (status == HOOKE_OK && frame) status = observe(it, &it->on_frame, state);
  }
  return status;
}

static int32_t report_step(hooke_integrator *it, hooke_state *state, int64_t limit) {
  int32_t status = HOOKE_OK;
  const int watched = it->on_step.observer && it->k % it->on_step.stride == 0;
  const int checked = it->k % CHECK_STEPS == 0;
  if (watched || checked) status = store(it, it->t, state);
  if (status == HOOKE_OK && checked) status = hooke_divergence_check(it, state, 1);
  if (status == HOOKE_OK && watched) status = observe(it, &it->on_step, state);
  if (status == HOOKE_OK && it->k >= limit) {
    store(it, it->t, state);
    status = hooke_fail(HOOKE_STEP_LIMIT, NULL, "the run used up max_steps = %lld at t = %.17g s",
                        (long long)limit, it->t);
  }
  return status;
}

/* On to frame f = 1, 2, ... by interpolation within internal steps, then to the end of the run. */
static int32_t run_adaptive(hooke_integrator *it, hooke_state *state, double duration, double every,
                            int64_t frames) {
  const double end = it->t0 + duration, steps = hooke_options_number(it->options, "max_steps");
  const int64_t limit = isnan(steps) ? INT64_MAX : (int64_t)steps;
  int32_t status = HOOKE_OK;
  for (int64_t f = 1; f <= frames && status == HOOKE_OK; f++) {
    const double t = f < frames ? fmin(it->t0 + (double)f * every, end) : end;
    while (it->t < t && status == HOOKE_OK) {
      status = take_adaptive_step(it, state);
      if (status == HOOKE_OK && it->t < t) status = report_step(it, state, limit);
    }
    if (status == HOOKE_OK) status = store(it, t, state);
    if (status == HOOKE_OK) status = hooke_divergence_check(it, state, 1);
    if (status == HOOKE_OK && f < frames) status = observe(it, &it->on_frame, state);
  }
  return status;
}

int32_t hooke_integrator_run(hooke_integrator *it, hooke_state *state) {
  int32_t status = check_state(it, state);
  if (status == HOOKE_OK && it->schedule.frames == 0) {
    status = hooke_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  if (status == HOOKE_OK) status = begin(it, state);
  if (status == HOOKE_OK) status = hooke_divergence_check(it, state, 1);
  if (status == HOOKE_OK) status = observe(it, &it->on_frame, state);
  if (status != HOOKE_OK) return status;
  const struct hooke_schedule *s = &it->schedule;
  if (!it->method->adaptive) return run_fixed(it, state, s->steps, s->frame_steps);
  return run_adaptive(it, state, s->duration, s->every, s->frames);
}

/* 1 if the state is, to the bit, the one that the last call left: stepping then goes on where it was. */
static int goes_on(const hooke_integrator *it, const hooke_state *state) {
  const size_t bytes = (size_t)(1 + (state->has_v ? 2 : 1) * state->size) * sizeof(double);
  return it->k > 0 && memcmp(it->good->t, state->t, bytes) == 0;
}

int32_t hooke_integrator_step(hooke_integrator *it, hooke_state *state, int64_t steps) {
  int32_t status = check_state(it, state);
  if (status == HOOKE_OK && steps < 0) {
    status = hooke_fail(HOOKE_BAD_VALUE, "steps", "%lld is not allowed; 0 or more are", (long long)steps);
  }
  if (status == HOOKE_OK && !goes_on(it, state)) status = begin(it, state);
  if (status != HOOKE_OK) return status;
  if (!it->method->adaptive) return run_fixed(it, state, it->k + steps, 0);
  for (int64_t s = 0; s < steps && status == HOOKE_OK; s++) {
    status = take_adaptive_step(it, state);
    if (status == HOOKE_OK) status = report_step(it, state, INT64_MAX);
  }
  if (status == HOOKE_OK) status = store(it, it->t, state);
  return status == HOOKE_OK ? hooke_divergence_check(it, state, 0) : status;
}
