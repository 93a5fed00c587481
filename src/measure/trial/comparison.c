/* Comparison: one scene by several methods, against a reference that checks itself, frame by frame. */
#include "measure/trial/comparison.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/trial/method_list.h"

#include <math.h>
#include <stddef.h>

static const struct hk_option_row comparison_rows[] = {
    {.name = "methods", .type = HOOKE_OPTION_TEXT, .doc = "methods, separated by commas; all if not given"},
};

static const struct hk_option_table comparison_table = {"comparison", HOOKE_OPTION_ROWS(comparison_rows)};

/* ---- creating ---- */

static int32_t create(hooke_measurement *m) {
  if (!hooke_method_is_built("cvode-adams")) {
    return hk_fail(HOOKE_NOT_BUILT, NULL,
                   "a comparison needs SUNDIALS for its reference, which this build is without");
  }
  struct hk_comparison *c = m->object = hk_new(1, sizeof *c);
  if (c == NULL) return HOOKE_NO_MEMORY;
  c->measurement = m;
  c->system = m->system;
  c->run = m->run;
  const char *method[HOOKE_LISTED_METHODS];
  int32_t count;
  const int32_t status = hk_method_list_read(c->system, hooke_options_text(m->options, "methods"),
                                             hooke_method_is_built, method, &count);
  c->row = status == HOOKE_OK ? hk_new(count, sizeof *c->row) : NULL;
  for (; c->row && c->row_count < count; c->row_count++)
    c->row[c->row_count] = (struct hk_comparison_row){.method = method[c->row_count], .trial = hk_no_trial};
  return status == HOOKE_OK && c->row == NULL ? HOOKE_NO_MEMORY : status;
}

static void release_results(struct hk_comparison *c) {
  for (int64_t k = 0; k < c->row_count; k++)
    hk_trial_release(&c->row[k].trial);
  hk_reference_release(&c->reference);
  c->frame_count = c->runs_begun = 0;
  c->told = 0.0;
}

static void destroy(void *object) {
  struct hk_comparison *c = object;
  if (c == NULL) return;
  release_results(c);
  hk_free(c->row);
  hk_free(c);
}

int32_t hooke_comparison_on_frame(hooke_measurement *m, hooke_comparison_frame *observer, void *ctx) {
  const int32_t status = hk_measurement_require(m, &hk_comparison_kind, "hooke_comparison_on_frame");
  if (status != HOOKE_OK) return status;
  struct hk_comparison *c = m->object;
  c->on_frame = observer;
  c->on_frame_ctx = ctx;
  return HOOKE_OK;
}

/* ---- preparing ---- */

/* The schedule that all rows share: that of a fixed-step method if the options have a step. */
int32_t hk_comparison_prepare(struct hk_comparison *c) {
  struct hk_schedule schedule;
  int has_fixed = 0;
  if (c->frame_count > 0) return HOOKE_OK;
  for (int64_t k = 0; k < c->row_count; k++)
    has_fixed |= !hooke_method_is_adaptive(c->row[k].method);
  const struct hk_method *method = hk_method_find(has_fixed ? "forward-euler" : "cvode-adams");
  const int32_t status = hk_schedule_read(method, c->run, &schedule);
  if (status != HOOKE_OK) return status;
  if (schedule.frames == 0) {
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  c->frame_count = schedule.frames;
  return HOOKE_OK;
}

/* ---- running ---- */

static const char *name_of_run(const struct hk_comparison *c) {
  return c->runs_begun == 1 ? "reference" : c->row[c->runs_begun - 2].method;
}

static int32_t tell_progress(double share, void *ctx) {
  struct hk_comparison *c = ctx;
  const double done = ((double)(c->runs_begun - 1) + share) / (double)(c->row_count + 1);
  c->told = fmax(c->told, done);
  return hk_measurement_tell(c->measurement, c->told, name_of_run(c));
}

static int32_t tell_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  const struct hk_comparison *c = ctx;
  return frame < c->frame_count ? c->on_frame(name_of_run(c), frame, step, state, c->on_frame_ctx) : 0;
}

static struct hk_listener listener_of(struct hk_comparison *c) {
  return (struct hk_listener){
      .on_progress = tell_progress, .on_frame = c->on_frame ? tell_frame : NULL, .ctx = c};
}

static int32_t make_reference(struct hk_comparison *c) {
  const struct hk_listener listener = {.on_progress = tell_progress, .ctx = c};
  const struct hk_reference_request request = {.run = c->run,
                                               .frame_count = c->frame_count,
                                               .digits = NAN,
                                               .brief = 1,
                                               .budget = INFINITY,
                                               .listener = &listener};
  c->runs_begun++;
  return hk_reference_create(c->system, &request, &c->reference);
}

/* Its last run once more, since its frames are kept without velocities and steps. */
static int32_t show_reference(struct hk_comparison *c) {
  const struct hk_listener listener = listener_of(c);
  struct hk_reference *r = &c->reference;
  hooke_options *options = NULL;
  int32_t status = hk_reference_options(c->run, r->method, r->rtol, r, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "atol", r->atol);
  if (status == HOOKE_OK) status = hk_frames_run(&r->frames, options, &listener, NULL);
  hooke_options_destroy(options);
  return status;
}

static int32_t run_row(struct hk_comparison *c, struct hk_comparison_row *row) {
  const struct hk_reference *r = &c->reference;
  const struct hk_listener listener = listener_of(c);
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(c->run, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", row->method);
  c->runs_begun++;
  if (status == HOOKE_OK) status = hk_trial_create(&r->frames, &row->trial);
  if (status == HOOKE_OK) status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, &listener);
  hooke_options_destroy(options);
  return status;
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_comparison *c = m->object;
  int32_t status = hk_measurement_require_fresh(m, state);
  if (status != HOOKE_OK) return status;
  /* it failed after frames had been shown */
  if (c->runs_begun > 0) return hk_fail(HOOKE_BAD_CALL, NULL, "the comparison has been run; make a new one");
  status = hk_comparison_prepare(c);
  if (status == HOOKE_OK) status = make_reference(c);
  if (status == HOOKE_OK && c->on_frame) status = show_reference(c);
  for (int64_t k = 0; k < c->row_count && status == HOOKE_OK; k++)
    status = run_row(c, &c->row[k]);
  /* as before, unless frames have been shown */
  if (status < 0 && c->on_frame == NULL) {
    release_results(c);
  }
  return status;
}

const struct hk_measurement_kind hk_comparison_kind = {.name = "comparison",
                                                       .options = &comparison_table,
                                                       .needs_run = 1,
                                                       .tables = hk_comparison_tables,
                                                       .create = create,
                                                       .run = run,
                                                       .destroy = destroy};
