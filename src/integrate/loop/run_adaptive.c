/* The run loop of error-controlled methods: internal steps, frames within them, and checkpoints.
 *
 * The history of a solver cannot be saved. So with the option `checkpoint` the method restarts from (t, q, v)
 * at every t0 + k DT, whether or not anything is written there: a run that continues from such a point then
 * repeats this one. The part of the step past that time is discarded. */
#include "integrate/loop/run_loop.h"

#include "core/clock.h"
#include "core/status.h"

#include <float.h>
#include <math.h>

enum { PARTS = 8 }; /* of a step, at whose ends its motion is shown */

int64_t hk_run_first_after(double t0, double every, double t) {
  int64_t low = 0, high = HOOKE_MOST_STEPS;
  while (high - low > 1) {
    const int64_t middle = low + (high - low) / 2;
    if (t0 + (double)middle * every > t)
      high = middle;
    else
      low = middle;
  }
  return high;
}

/* ---- checkpoints ---- */

static int starts_anew(const hooke_integrator *it) {
  return it->method->adaptive && !isnan(it->schedule.checkpoint);
}

/* Time of the next checkpoint. */
static double next_point(const hooke_integrator *it) {
  return starts_anew(it) ? it->t0 + (double)it->point * it->schedule.checkpoint : INFINITY;
}

int32_t hk_run_keep_restart(hooke_integrator *it, const hooke_state *state) {
  struct hk_restart *restart = &it->restart;
  if (!starts_anew(it)) return HOOKE_OK;
  if (restart->state == NULL) {
    const int32_t status = hk_state_create_sized(hooke_state_size(state), state->has_v, &restart->state);
    if (status != HOOKE_OK) return status;
  }
  restart->standing = it->standing;
  return hooke_state_copy(state, restart->state);
}

/* The step has reached or passed the checkpoint at time t: the method restarts from the solution there. */
static int32_t start_anew(hooke_integrator *it, double t, hooke_state *state) {
  int32_t status = hk_run_store(it, t, state, 0);
  if (status == HOOKE_OK) status = hk_divergence_check(it, state, 1);
  if (status == HOOKE_OK) status = hk_run_place_driven(it, state);
  if (status != HOOKE_OK) return status;
  it->t = t;
  it->point = hk_run_first_after(it->t0, it->schedule.checkpoint, t);
  status = it->method->steps->begin(it, state);
  return status == HOOKE_OK ? hk_run_keep_restart(it, state) : status;
}

/* ---- steps ---- */

/* One internal step; if it fails, the state is the one before it. */
static int32_t take_step(hooke_integrator *it, hooke_state *state) {
  const double begun = hk_clock_seconds();
  const int32_t status = it->method->steps->step(it);
  it->wall_seconds += hk_clock_seconds() - begun;
  if (status == HOOKE_OK)
    it->k++;
  else if (it->k > 0)
    it->method->steps->store(it, it->t, state);
  return status;
}

/* Checks and observers of an internal step. */
static int32_t report_step(hooke_integrator *it, hooke_state *state) {
  int32_t status = HOOKE_OK;
  const int watched = it->on_step.observer && it->k % it->on_step.stride == 0;
  const int checked = it->k % HOOKE_CHECK_STEPS == 0;
  if (watched || checked) status = hk_run_store(it, it->t, state, 0);
  if (status == HOOKE_OK && checked) status = hk_divergence_check(it, state, 1);
  if (status == HOOKE_OK && watched) status = hk_run_observe(it, &it->on_step, state);
  return status;
}

/* Progress; if that stops, the state is that of the step. */
static int32_t tell_step(hooke_integrator *it, hooke_state *state) {
  const int32_t status = hk_run_tell(it, 1);
  const int32_t stored = status == HOOKE_OK ? HOOKE_OK : hk_run_store(it, it->t, state, 0);
  return stored == HOOKE_OK ? status : stored;
}

int32_t hk_run_internal_steps(hooke_integrator *it, hooke_state *state, int64_t steps, int32_t shows) {
  int32_t status = HOOKE_OK;
  for (int64_t s = 0; s < steps && status == HOOKE_OK; s++) {
    const double point = it->goal = next_point(it), from = it->t;
    status = take_step(it, state);
    const int anew = status == HOOKE_OK && it->t >= point;
    if (anew) status = start_anew(it, point, state);
    if (status == HOOKE_OK) status = hk_passages_count(it, from, it->t);
    if (status == HOOKE_OK) status = report_step(it, state);
    if (status == HOOKE_OK && anew) status = hk_run_observe(it, &it->on_checkpoint, state);
    if (status == HOOKE_OK) status = tell_step(it, state);
  }
  if (status != HOOKE_OK || !shows) return status;
  status = hk_run_store(it, it->t, state, 0);
  return status == HOOKE_OK ? hk_divergence_check(it, state, it->thorough) : status;
}

/* ---- a whole run ---- */

static double frame_time(const hooke_integrator *it, const struct hk_schedule *schedule, int64_t frame,
                         double end) {
  return frame < schedule->frames ? fmin(it->t0 + (double)frame * schedule->every, end) : end;
}

/* The remaining frames up to time t, within the last step. */
static int32_t report_frames(hooke_integrator *it, hooke_state *state, double t, double end) {
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && it->frames < it->schedule.frames) {
    const double at = frame_time(it, &it->schedule, it->frames, end);
    if (at > t) break;
    status = hk_run_store(it, at, state, 0);
    if (status == HOOKE_OK) status = hk_divergence_check(it, state, 1);
    if (status == HOOKE_OK) status = hk_run_report(it, state);
  }
  return status;
}

/* The same of samples, which are not checked. */
static double sample_time(const hooke_integrator *it, double end) {
  const int some = it->on_sample.observer && it->samples < it->sampling.frames;
  return some ? frame_time(it, &it->sampling, it->samples, end) : INFINITY;
}

static int32_t report_samples(hooke_integrator *it, hooke_state *state, double t, double end) {
  int32_t status = HOOKE_OK;
  for (double at; status == HOOKE_OK && (at = sample_time(it, end)) <= t; it->samples++) {
    status = hk_run_store(it, at, state, 0);
    if (status == HOOKE_OK) status = hk_run_observe(it, &it->on_sample, state);
  }
  return status;
}

/* Of what has the motion: the end of the last step up to time t, and times within it where the method knows
 * them. */
static int32_t show_motion(hooke_integrator *it, hooke_state *state, double from, double t) {
  const int parts = it->method->interpolates ? PARTS : 1;
  int32_t status = HOOKE_OK;
  for (int k = 1; k <= parts && status == HOOKE_OK && it->on_motion.observer; k++) {
    status = hk_run_store(it, k < parts ? from + (double)k / parts * (t - from) : t, state, 0);
    if (status == HOOKE_OK) status = hk_run_observe(it, &it->on_motion, state);
  }
  return status;
}

static int32_t refuse_duration(const hooke_integrator *it) {
  return hk_fail(HOOKE_BAD_VALUE, "duration",
                 "%.6g s does not change the time t = %.6g s; take a longer one, or a fixed-step method",
                 it->schedule.duration, it->t0);
}

static int32_t check_schedule(const hooke_integrator *it, double end) {
  const double resolved = 8.0 * DBL_EPSILON * fmax(fabs(it->t0), fabs(end));
  if (!(end > it->t0)) return refuse_duration(it);
  if (!starts_anew(it) || it->schedule.checkpoint >= resolved) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "checkpoint",
                 "%.17g s hardly changes the time, which goes from %.17g to %.17g s; take a longer one",
                 it->schedule.checkpoint, it->t0, end);
}

static int32_t refuse_more_steps(hooke_integrator *it, int64_t limit, hooke_state *state) {
  const int32_t status = hk_run_store(it, it->t, state, 0);
  if (status != HOOKE_OK) return status;
  return hk_fail(
      HOOKE_STEP_LIMIT, NULL,
      "the run used up max_steps = %lld at t = %.6g s; give it more steps, or try looser tolerances",
      (long long)limit, it->t);
}

static int64_t step_limit(const hooke_integrator *it) {
  const double steps = hooke_options_number(it->options, "max_steps");
  return isnan(steps) ? INT64_MAX : (int64_t)steps;
}

/* One internal step with everything that follows it; frames at the time of a checkpoint come first. */
static int32_t go_on(hooke_integrator *it, hooke_state *state, double end) {
  const double next = next_point(it), point = next < end ? next : INFINITY, from = it->t;
  it->goal = fmin(fmin(frame_time(it, &it->schedule, it->frames, end), sample_time(it, end)), point);
  int32_t status = take_step(it, state);
  if (status == HOOKE_OK) status = show_motion(it, state, from, fmin(it->t, fmin(point, end)));
  if (status == HOOKE_OK) status = report_samples(it, state, fmin(it->t, point), end);
  if (status == HOOKE_OK) status = report_frames(it, state, fmin(it->t, point), end);
  const int anew = status == HOOKE_OK && it->t >= point;
  if (anew) status = start_anew(it, point, state);
  if (status == HOOKE_OK) status = hk_passages_count(it, from, fmin(it->t, end));
  if (status == HOOKE_OK && it->t < end) status = report_step(it, state);
  return status == HOOKE_OK && anew ? hk_run_observe(it, &it->on_checkpoint, state) : status;
}

int32_t hk_run_adaptive(hooke_integrator *it, hooke_state *state) {
  const double end = it->t0 + it->schedule.duration;
  const int64_t limit = step_limit(it), next = hk_run_first_after(it->t0, it->schedule.every, it->t);
  int32_t status = check_schedule(it, end);
  if (it->on_sample.observer) it->samples = hk_run_first_after(it->t0, it->sampling.every, it->t);
  if (it->frames < next) it->frames = next < it->schedule.frames ? next : it->schedule.frames;
  while (it->t < end && status == HOOKE_OK) {
    status = it->k < limit ? go_on(it, state, end) : refuse_more_steps(it, limit, state);
    if (status == HOOKE_OK && it->t < end) status = tell_step(it, state);
  }
  if (status == HOOKE_OK) status = hk_run_store(it, end, state, 0);
  return status == HOOKE_OK ? hk_divergence_check(it, state, 1) : status;
}
