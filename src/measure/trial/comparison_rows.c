/* Making a comparison, and reading it. */
#include "measure/trial/comparison.h"

#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/trial/reference.h"

#include <math.h>
#include <string.h>

int32_t hooke_comparison_create(const hooke_system *system, const hooke_options *options,
                                hooke_comparison **out) {
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_run_options_require(options, "options");
  if (status != HOOKE_OK) return status;
  if (!hooke_method_is_built("cvode-adams")) {
    return hk_fail(HOOKE_NOT_BUILT, NULL,
                   "a comparison needs SUNDIALS for its reference, which this build is without");
  }
  hooke_comparison *c = hk_handle_new("hooke_comparison", sizeof *c);
  if (c == NULL) return HOOKE_NO_MEMORY;
  c->system = system;
  status = hooke_options_copy(options, &c->options);
  if (status == HOOKE_OK)
    *out = c;
  else
    hooke_comparison_destroy(c);
  return status;
}

void hk_comparison_release_room(hooke_comparison *c) {
  for (int64_t k = 0; k < c->row_count; k++)
    hk_trial_release(&c->row[k].trial);
  hk_frames_release(&c->frames);
  c->reference = NULL;
}

void hooke_comparison_destroy(hooke_comparison *c) {
  if (c == NULL) return;
  hk_comparison_release_room(c);
  for (int64_t k = 0; k < c->row_count; k++)
    hk_free(c->row[k].method);
  hooke_options_destroy(c->options);
  hk_free(c->row);
  hk_handle_free(c);
}

int32_t hooke_comparison_add(hooke_comparison *c, const char *method) {
  if (c->reference) {
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "the comparison is under way; add methods before it is run or written");
  }
  if (hooke_method_is_adaptive(method) < 0) {
    return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  }
  if (!hooke_method_is_built(method)) {
    return hk_fail(HOOKE_NOT_BUILT, "method", "this build is without %s", method);
  }
  if (c->row_count == c->row_capacity) {
    const int64_t capacity = 2 * c->row_capacity + 4;
    const int32_t status = hk_grow((void **)&c->row, c->row_count, capacity, sizeof *c->row);
    if (status != HOOKE_OK) return status;
    c->row_capacity = capacity;
  }
  char *name = hk_copy_text(method);
  if (name == NULL) return HOOKE_NO_MEMORY;
  c->row[c->row_count++] = (struct hk_comparison_row){.method = name};
  return HOOKE_OK;
}

void hooke_comparison_on_progress(hooke_comparison *comparison, hooke_progress *progress, void *ctx) {
  comparison->progress = progress;
  comparison->progress_ctx = ctx;
}

void hooke_comparison_on_frame(hooke_comparison *comparison, hooke_comparison_frame *observer, void *ctx) {
  comparison->on_frame = observer;
  comparison->on_frame_ctx = ctx;
}

/* ---- preparing ---- */

/* The schedule that all rows share: the one of a fixed-step method if the options have a step. */
static int32_t read_schedule(hooke_comparison *c) {
  struct hk_schedule schedule;
  int has_fixed = 0;
  for (int64_t k = 0; k < c->row_count; k++)
    has_fixed |= !hooke_method_is_adaptive(c->row[k].method);
  const struct hk_method *method = hk_method_find(has_fixed ? "forward-euler" : "cvode-adams");
  const int32_t status = hk_schedule_read(method, c->options, &schedule);
  if (status != HOOKE_OK) return status;
  if (schedule.frames == 0) {
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  c->frame_count = schedule.frames;
  return HOOKE_OK;
}

static int32_t make_room(hooke_comparison *c) {
  int32_t status = hk_frames_create(c->system, c->frame_count, &c->frames);
  for (int64_t k = 0; k < c->row_count && status == HOOKE_OK; k++) {
    status = hk_trial_create(&c->frames, &c->row[k].trial);
  }
  return status;
}

static int32_t add_all_methods(hooke_comparison *c) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_method_count() && status == HOOKE_OK; k++) {
    if (hooke_method_is_built(hooke_method_name(k))) status = hooke_comparison_add(c, hooke_method_name(k));
  }
  return status;
}

int32_t hk_comparison_prepare(hooke_comparison *c) {
  if (c->reference) return HOOKE_OK;
  int32_t status = c->row_count == 0 ? add_all_methods(c) : HOOKE_OK;
  hooke_state *state = NULL;
  if (status == HOOKE_OK) status = read_schedule(c);
  if (status == HOOKE_OK) status = hooke_state_create(c->system, &state);
  if (status == HOOKE_OK) status = make_room(c);
  if (status == HOOKE_OK) status = hk_reference_method(c->system, hooke_state_position(state), &c->reference);
  hooke_state_destroy(state);
  if (status != HOOKE_OK) hk_comparison_release_room(c);
  return status;
}

/* ---- reading ---- */

int64_t hooke_comparison_row_count(const hooke_comparison *comparison) {
  return comparison->row_count;
}

static const struct hk_comparison_row *row_at(const hooke_comparison *c, int64_t row) {
  return row >= 0 && row < c->row_count ? &c->row[row] : NULL;
}

const char *hooke_comparison_text(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hk_comparison_row *r = row_at(c, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "method") == 0) return r->method;
  return strcmp(what, "status") == 0 ? (r->trial.status ? r->trial.status : "not run") : NULL;
}

double hooke_comparison_number(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hk_comparison_row *r = row_at(c, row);
  return r ? hk_trial_number(&r->trial, what) : NAN;
}

const char *hooke_comparison_reference(const hooke_comparison *comparison) {
  return comparison->reference ? comparison->reference : "";
}

int64_t hooke_comparison_frame_count(const hooke_comparison *comparison) {
  return comparison->frame_count;
}

const double *hooke_comparison_series(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hk_comparison_row *r = row_at(c, row);
  if (strcmp(what, "time") == 0) return c->frames.time;
  if (r == NULL) return NULL;
  if (strcmp(what, "error") == 0) return r->trial.error_at;
  return strcmp(what, "energy_drift") == 0 ? r->trial.drift_at : NULL;
}
