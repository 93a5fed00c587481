/* Comparison: one scene by several methods, against CVODE at tight tolerance, frame by frame. */
#include "measure/trial/comparison.h"

#include "core/status.h"

#include <stddef.h>

static const char *name_of_run(const hooke_comparison *c) {
  return c->runs_begun == 1 ? "reference" : c->row[c->runs_begun - 2].method;
}

static int32_t tell_progress(double share, void *ctx) {
  const hooke_comparison *c = ctx;
  const double done = ((double)(c->runs_begun - 1) + share) / (double)(c->row_count + 1);
  return c->progress(done, name_of_run(c), c->progress_ctx);
}

static int32_t tell_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  const hooke_comparison *c = ctx;
  return frame < c->frame_count ? c->on_frame(name_of_run(c), frame, step, state, c->on_frame_ctx) : 0;
}

static struct hk_listener listener_of(hooke_comparison *c) {
  return (struct hk_listener){.on_progress = c->progress ? tell_progress : NULL,
                              .on_frame = c->on_frame ? tell_frame : NULL,
                              .ctx = c};
}

static int32_t run_reference(hooke_comparison *c) {
  const struct hk_listener listener = listener_of(c);
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(c->options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", c->reference);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "rtol", 1e-10);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "atol", 1e-12);
  if (status == HOOKE_OK) status = hooke_options_unset(options, "atol_velocity");
  if (status == HOOKE_OK) status = hooke_options_unset(options, "max_order");
  if (status == HOOKE_OK) status = hooke_options_unset(options, "max_steps");
  c->runs_begun++;
  if (status == HOOKE_OK) status = hk_frames_run(&c->frames, options, &listener, NULL, NULL);
  hooke_options_destroy(options);
  return status;
}

static int32_t run_row(hooke_comparison *c, struct hk_comparison_row *row) {
  const struct hk_listener listener = listener_of(c);
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(c->options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", row->method);
  c->runs_begun++;
  if (status == HOOKE_OK) status = hk_trial_run(&row->trial, &c->frames, c->frames.count, options, &listener);
  hooke_options_destroy(options);
  return status;
}

int32_t hooke_comparison_run(hooke_comparison *c) {
  if (c->runs_begun > 0) return hk_fail(HOOKE_BAD_CALL, NULL, "the comparison has been run; make a new one");
  int32_t status = hk_comparison_prepare(c);
  if (status == HOOKE_OK) status = run_reference(c);
  for (int64_t k = 0; k < c->row_count && status == HOOKE_OK; k++)
    status = run_row(c, &c->row[k]);
  /* as before, unless frames have been handed out */
  if (status < 0 && c->on_frame == NULL) {
    hk_comparison_release_room(c);
    c->runs_begun = 0;
  }
  return status;
}
