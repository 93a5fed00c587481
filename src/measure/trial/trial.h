/* A trial: one method with one step or tolerance, run once and judged against the frames of a reference.
 * Error and cost come from the same run. */
#ifndef HOOKE_MEASURE_TRIAL_TRIAL_H
#define HOOKE_MEASURE_TRIAL_TRIAL_H

#include "hooke/measurement.h"
#include "measure/trial/frames.h"

/* Who wants to hear of a run under way; any function may be NULL. Anything but 0 from the first two stops the
 * run; the third may change the initial state. */
struct hk_listener {
  int32_t (*on_progress)(double share, void *ctx);
  int32_t (*on_frame)(int64_t frame, int64_t step, const hooke_state *state, void *ctx);
  void (*on_start)(hooke_state *state, void *ctx);
  void *ctx;
};

struct hk_trial {
  const char *status;      /* "finished", "diverged", "stopped", "failed"; NULL: not run yet */
  double step, rtol, atol; /* NaN where the method does not take it */
  double error, error_max, error_final, energy_drift; /* NaN unless finished */
  double force_evaluations, steps, linear_iterations, wall_seconds;
  double *error_at, *drift_at;      /* one a frame of the reference, NaN where there is none */
  struct hk_watched_series watched; /* of what the reference watches, with the errors */
};

int32_t hk_trial_create(const struct hk_frames *reference, struct hk_trial *trial);
void hk_trial_release(struct hk_trial *trial);

/* Runs with the options of a run. Divergence, a solver that fails and a step limit are results, and return
 * HOOKE_OK; HOOKE_STOPPED if the listener asked for it; other failures as they are. `frames` counts what is
 * judged: frames of the reference beyond it are left out. */
int32_t hk_trial_run(struct hk_trial *trial, const struct hk_frames *reference, int64_t frames,
                     const hooke_options *options, const struct hk_listener *listener);

/* Runs and keeps every frame, as a reference for trials; any outcome but success comes back. `wall_seconds`
 * and `force_evaluations` may be NULL. */
int32_t hk_frames_run(struct hk_frames *frames, const hooke_options *options,
                      const struct hk_listener *listener, double *wall_seconds, double *force_evaluations);

/* Sets a method and its step or rtol in options of a run; atol keeps its share of rtol, and atol_velocity
 * follows it. */
int32_t hk_trial_set_value(hooke_options *run, const char *method, double value);

#endif
