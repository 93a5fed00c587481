/* Frames after divergence, with a fixed step: the motion goes on from where the check failed, unchecked,
 * until a number is not finite. Nothing of it is physics any more; it shows how the run blows up. */
#include "integrate/loop/run_loop.h"

#include "core/status.h"

#include <math.h>

/* Frames to show at most; 0 if none are asked for. */
static int64_t frames_wanted(const hooke_integrator *it) {
  const double most = hooke_options_number(it->options, "frames_after");
  if (it->method->adaptive || it->on_frame.observer == NULL) return 0;
  if (!isnan(most)) return (int64_t)most;
  return hooke_options_number(it->options, "past_divergence") == 1.0 ? INT64_MAX : 0;
}

/* The state now, as a frame. */
static int32_t show(hooke_integrator *it, hooke_state *state) {
  const double t = it->t0 + (double)it->k * it->schedule.step;
  const int32_t status = it->method->steps->store(it, t, state);
  *state->t = t;
  return status == HOOKE_OK ? hk_run_observe(it, &it->on_frame, state) : status;
}

/* From the step that failed the check on; ends for a callback, too, and where a solver gives up. */
static void go_on(hooke_integrator *it, hooke_state *state, int64_t most) {
  const int64_t frame_steps = it->schedule.frame_steps, last = it->schedule.steps;
  int32_t status = HOOKE_OK;
  for (int64_t shown = 0; shown < most && hk_motion_is_finite(it) && status == HOOKE_OK;) {
    const int due = hk_schedule_has_frame(&it->schedule, it->k);
    if (due) status = show(it, state);
    shown += due;
    const int64_t left = last - it->k, steps = frame_steps - it->k % frame_steps;
    if (status != HOOKE_OK || left == 0) return;
    status = hk_run_take_fixed_steps(it, steps < left ? steps : left);
  }
}

int32_t hk_run_beyond(hooke_integrator *it, hooke_state *state, int32_t status) {
  const int64_t most = status == HOOKE_DIVERGED ? frames_wanted(it) : 0;
  const hooke_state *good = hk_recent_state(&it->recent, 0, NULL);
  if (most == 0 || good == NULL) return status;
  const struct hk_standing standing = it->standing;
  const int32_t stop_value = it->stop_value;
  go_on(it, state, most);
  it->standing = standing;
  it->stop_value = stop_value;
  hooke_state_copy(good, state);
  return hk_fail(HOOKE_DIVERGED, NULL, "%s", it->message);
}
