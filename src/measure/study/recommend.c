/* The recommendation: what 'run --want' picks (measure/recommend), held against the reference of the study. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/print.h"
#include "core/status.h"
#include "measure/recommend/pick.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PICKS = 3 };
static const double AIM = 0.6; /* of the want, where a pick of the beginning was too coarse for the run */

static int32_t tell_pick(double share, const char *what, void *ctx) {
  struct hk_study *study = ctx;
  study->under_way = what;
  return hk_study_tell_row(share, study);
}

static int32_t method_number(const struct hk_study *study, const char *name) {
  for (int32_t m = 0; m < study->method_count; m++)
    if (strcmp(study->method[m], name) == 0) return m;
  return -1;
}

static void keep(struct hk_study *study, const struct hk_study_row *row) {
  struct hk_study_recommendation *r = &study->recommendation;
  r->method = row->method;
  r->value = row->value;
  r->atol = row->trial.atol;
  r->error = row->trial.error_max;
  r->wall_seconds = row->trial.wall_seconds;
  r->wall_median = row->wall_median;
  r->force_evaluations = row->trial.force_evaluations;
}

/* ---- when nothing meets the wanted error ---- */

static void explain(struct hk_study *study) {
  struct hk_study_recommendation *r = &study->recommendation;
  if (study->budget_spent && r->method < 0) {
    hk_print(r->note, sizeof r->note, "the budget of %g s ended before a run was found; give a larger one",
             study->budget);
  } else if (r->method < 0) {
    snprintf(r->note, sizeof r->note, "no run finished with a step clear of its stability limit");
  } else if (r->want <= study->reference.agreement) {
    hk_print(r->note, sizeof r->note,
             "%.3g m is below %.3g m, to which the reference itself is known; want more than that", r->want,
             study->reference.agreement);
  } else {
    hk_print(r->note, sizeof r->note, "no run comes within %.3g m; the closest is %.3g m off; %s", r->want,
             r->error,
             study->budget_spent ? "a larger budget would try finer steps"
                                 : "finer steps or tighter tolerances, or other methods, might");
  }
}

/* 1 if nothing but the start is trusted, where every run is right. */
static int is_untrusted(struct hk_study *study) {
  const struct hk_reference *reference = &study->reference;
  if (reference->trusted > 1) return 0;
  hk_print(study->recommendation.note, sizeof study->recommendation.note,
           "the two references part before %g s, the first frame after the start, so no error is known",
           reference->frames.time[1]);
  return 1;
}

/* ---- picking ---- */

/* Measures the picked run as rows are; a closest one only if there is none yet. */
static int32_t measure(struct hk_study *study, const struct hk_pick *pick, double *error) {
  struct hk_study_recommendation *r = &study->recommendation;
  const int32_t method = pick->best.method ? method_number(study, pick->best.method) : -1;
  struct hk_study_row row;
  *error = NAN;
  if (method < 0) return HOOKE_OK;
  study->row_deadline = study->deadline;
  const int32_t status = hk_study_measure(study, method, pick->best.value, &row);
  if (status == HOOKE_OK && row.trial.status) {
    *error = row.trial.error_max;
    r->met = pick->met && *error <= r->want;
    keep(study, &row);
    if (r->met) hk_pick_say_reversal(pick, r->note, sizeof r->note);
  }
  hk_trial_release(&row.trial);
  return status;
}

/* Picks for `want`, by one pick. */
static int32_t pick_once(struct hk_study *study, double want, double *error, int32_t *met) {
  struct hk_pick pick;
  study->late = 0;
  study->row_deadline = study->deadline;
  int32_t status = hk_pick_run(&pick, study->system, study->run, want, study->method_count, study->method,
                               tell_pick, study);
  if (status == HOOKE_STOPPED && study->late) {
    study->budget_spent = 1;
    status = HOOKE_OK;
  }
  if (status == HOOKE_OK) status = measure(study, &pick, error);
  *met = pick.met;
  hk_pick_release(&pick);
  return status;
}

static void clear(struct hk_study *study, double want) {
  study->recommendation = (struct hk_study_recommendation){.made = 1,
                                                           .method = -1,
                                                           .want = want,
                                                           .value = NAN,
                                                           .atol = NAN,
                                                           .error = NAN,
                                                           .wall_seconds = NAN,
                                                           .wall_median = NAN,
                                                           .force_evaluations = NAN,
                                                           .margin = {NAN, {NAN, NAN}, {NAN, NAN}}};
  study->work_ahead = 0.0;
}

int32_t hk_study_find_cheapest(struct hk_study *study, double want) {
  struct hk_study_recommendation *r = &study->recommendation;
  double error = NAN, aim = want;
  int32_t status = HOOKE_OK, met = 1;
  clear(study, want);
  if (is_untrusted(study)) return HOOKE_OK;
  for (int k = 0; k < MOST_PICKS && met && !r->met && status == HOOKE_OK; k++) {
    if (error > want) aim *= AIM * want / error;
    status = pick_once(study, aim, &error, &met);
  }
  if (status != HOOKE_OK) return status;
  if (r->met) return hk_study_find_margin(study);
  explain(study);
  return HOOKE_OK;
}

int32_t hooke_study_recommend(hooke_measurement *m, double want) {
  int32_t status = hk_measurement_require(m, &hk_study_kind, "hooke_study_recommend");
  if (status != HOOKE_OK) return status;
  struct hk_study *study = m->object;
  if (study->reference.frames.count == 0)
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "the study has not been run yet; call hooke_measurement_run() first");
  if (!(want > 0.0)) return hk_fail(HOOKE_BAD_VALUE, "want", "%g is not allowed; a number > 0 [m] is", want);
  /* the budget starts anew */
  study->begun = hk_clock_seconds();
  study->deadline = study->begun + study->budget;
  study->told = 0.0;
  return hk_study_find_cheapest(study, want);
}
