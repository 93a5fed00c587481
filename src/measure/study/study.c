/* A study: a reference that checks itself, ladders of every method, orders, a recommendation. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/handle.h"
#include "core/memory.h"
#include "core/table/option.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "model/generalized.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The reference gets this fraction of a budget, and at least so many seconds. */
static const double REFERENCE_SHARE = 0.4, REFERENCE_SECONDS = 0.5;
/* Fraction of the budget for an ensemble, if one is needed. */
static const double ENSEMBLE_SHARE = 0.3;

static const struct hk_option_row study_rows[] = {
    HOOKE_OPTION("methods", .type = HOOKE_OPTION_TEXT, NULL,
                 "methods, separated by commas; all if not given"),
    HOOKE_OPTION("points", HOOKE_OPTION_WHOLE(6, 40), "6",
                 "steps or tolerances for each method; if not given, fewer where they cannot win"),
    HOOKE_OPTION(
        "steps", HOOKE_OPTION_EACH_POSITIVE("s"), NULL,
        "steps of the fixed-step methods, coarse to fine; from the safe step down by halves if not given"),
    HOOKE_OPTION(
        "tolerances", .type = HOOKE_OPTION_NUMBERS, NULL,
        "rtol of the error-controlled methods, coarse to fine; from 1e-3 down by tenths if not given",
        .low = 1e-14, .high = 0.1, .min_count = 1),
    HOOKE_OPTION(
        "want", HOOKE_OPTION_WANT, NULL,
        "error that one can live with, the largest distance of any free particle, for a recommendation" HOOKE_WANT_FORMS),
    HOOKE_OPTION("budget", HOOKE_OPTION_POSITIVE("s"), NULL,
                 "time that the study may take; no limit if not given"),
    HOOKE_OPTION("watch", .type = HOOKE_OPTION_TEXT, NULL,
                 "quantities whose values and errors are told too: " HOOKE_WATCHED_FORMS,
                 .example = "0.y,energy"),
    HOOKE_OPTION("ensemble", HOOKE_OPTION_WHOLE(0.0, 1e6), "0",
                 "displaced starts of which each method's means and spreads are told where the motion is too "
                 "chaotic to be judged; 0: none"),
    HOOKE_OPTION("seed", HOOKE_OPTION_WHOLE(0.0, 9007199254740992.0), "1", "of the noise of those starts"),
    HOOKE_OPTION(
        "once", .type = HOOKE_OPTION_FLAG, "false",
        "a first look: each method once, with the step and the tolerances of the run, in place of ladders; "
        "the reference ends where its two runs part, and an HDF5 file has the motions, too"),
};

static const struct hk_option_table study_table = {"study", HOOKE_OPTION_ROWS(study_rows)};

/* ---- creating ---- */

/* Rows of the run's own step share the frames of a run of it. */
static int32_t read_times(struct hk_study *study) {
  struct hk_schedule schedule;
  int32_t status = HOOKE_OK;
  study->budget = hooke_options_number(study->m->options, "budget");
  if (isnan(study->budget)) study->budget = INFINITY;
  study->once = hooke_options_number(study->m->options, "once") == 1.0;
  for (int32_t m = 0; study->once && status == HOOKE_OK && m < study->method_count; m++)
    status = hk_schedule_read(hk_method_find(study->method[m]), study->m->run, &schedule);
  return status == HOOKE_OK ? hk_step_times(study->m->run, &study->duration, &study->every) : status;
}

static int32_t read_watch(struct hk_study *study) {
  const char *text = hooke_options_text(study->m->options, "watch");
  const char *const of_scenes[] = {"watch", "ensemble"};
  for (int k = 0; k < 2; k++) {
    if (!hooke_options_is_set(study->m->options, of_scenes[k])) continue;
    const int32_t status = hk_system_require_scene(study->m->system, of_scenes[k], "");
    if (status != HOOKE_OK) return status;
  }
  study->watched.system = study->m->system;
  if (hooke_options_number(study->m->options, "ensemble") == 1.0) {
    return hk_fail(HOOKE_BAD_VALUE, "ensemble",
                   "1 is not allowed: one start has no spread; allowed: 0 (none), or at least 2");
  }
  const int32_t status = text[0] ? hk_watched_read(&study->watched, "watch", text) : HOOKE_OK;
  return status == HOOKE_OK ? hk_wants_read(&study->wants, &study->watched, study->m->options) : status;
}

static int32_t create(hooke_measurement *m) {
  struct hk_study *study = m->object = hk_new(1, sizeof *study);
  if (study == NULL) return HOOKE_NO_MEMORY;
  study->m = study->stage.measurement = m;
  int32_t status = hk_method_list_read(study->m->system, hooke_options_text(study->m->options, "methods"),
                                       hooke_method_is_built, study->method, &study->method_count);
  if (status == HOOKE_OK) status = read_times(study);
  if (status == HOOKE_OK) status = hk_study_check_ladder(study);
  return status == HOOKE_OK ? read_watch(study) : status;
}

static void release_results(struct hk_study *study) {
  for (int64_t k = 0; k < study->row_count; k++)
    hk_trial_release(&study->row[k].trial);
  study->row_count = 0;
  hk_reference_release(&study->reference);
  hk_ensemble_release(study->ensemble);
  study->ensemble = NULL;
}

static void destroy(void *object) {
  struct hk_study *study = object;
  if (study == NULL) return;
  release_results(study);
  hk_watched_release(&study->watched);
  hk_free(study->row);
  hk_free(study);
}

static int compare_rows(const void *a, const void *b) {
  const struct hk_study_row *x = a, *y = b;
  if (x->method != y->method) return (x->method > y->method) - (x->method < y->method);
  return (x->value < y->value) - (x->value > y->value);
}

static int32_t make_reference(struct hk_study *study) {
  const struct hk_listener listener = {.on_progress = hk_stage_tell, .ctx = &study->stage};
  const struct hk_wants *wants = &study->wants;
  const struct hk_reference_request request = {
      .run = study->m->run,
      .frame_count = hk_schedule_frames(study->duration, study->every),
      .digits = wants->most * wants->length / 10.0,
      .wants = wants,
      .brief = study->once,
      .keeps_state = !study->once,
      .budget = fmax(REFERENCE_SECONDS, REFERENCE_SHARE * study->budget),
      .listener = &listener,
      .watched = &study->watched};
  hk_stage_begin(&study->stage, "reference", HOOKE_STUDY_REFERENCE);
  const int32_t status = hk_reference_create(study->m->system, &request, &study->reference);
  if (status == HOOKE_OK && study->reference.hurried &&
      study->reference.trusted < study->reference.frames.count)
    study->budget_spent = 1;
  return status;
}

/* As before the run. */
static void forget(struct hk_study *study) {
  release_results(study);
  memset(&study->recommendation, 0, sizeof study->recommendation);
  study->stage.told = study->stage.until = 0.0;
  study->late = study->budget_spent = 0;
  memset(study->given_up, 0, sizeof study->given_up);
  memset(study->cut, 0, sizeof study->cut);
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_study *study = m->object;
  int32_t status = hk_measurement_require_fresh(m, state);
  if (status != HOOKE_OK) return status;
  const double budget = study->budget;
  study->begun = hk_clock_seconds();
  if (hooke_options_number(study->m->options, "ensemble") > 0.0) study->budget *= 1.0 - ENSEMBLE_SHARE;
  if (!study->once) status = hk_study_find_safe_steps(study);
  if (status == HOOKE_OK) status = make_reference(study);
  if (study->reference.trusted == study->reference.frames.count) study->budget = budget;
  if (status == HOOKE_OK) status = hk_study_run_ladders(study);
  if (study->row_count > 0) qsort(study->row, (size_t)study->row_count, sizeof *study->row, compare_rows);
  for (int32_t k = 0; k < study->method_count; k++)
    hk_study_fit_order(study, k);
  const double want = study->wants.most;
  study->deadline = study->begun + study->budget;
  if (status == HOOKE_OK && !isnan(want)) status = hk_study_find_cheapest(study, want);
  study->budget = budget;
  study->deadline = study->begun + budget;
  if (status == HOOKE_OK) status = hk_ensemble_run(study);
  if (status < 0) forget(study);
  return status;
}

const struct hk_measurement_kind hk_study_kind = {
    .name = "study",
    .takes_problems = 1,
    .options = &study_table,
    .needs_run = 1,
    .tables = hk_study_tables,
    .claim = hk_study_claim,
    .create = create,
    .run = run,
    .destroy = destroy,
};
