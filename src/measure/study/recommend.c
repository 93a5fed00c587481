/* The recommendation: the cheapest step or tolerance whose error is at most the wanted one. It is predicted
 * from the measured curves, then confirmed by runs. */
#include "measure/study/study_search.h"

#include "core/clock.h"
#include "core/print.h"
#include "core/status.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Rows whose times are this close are measured again, in turns. */
enum { MOST_ROUNDS = 7 };
static const double CONTENDS = 1.6, RACE_SECONDS = 0.5;

static void keep(struct hk_study *study, const struct hk_study_candidate *c, int32_t met) {
  struct hk_study_recommendation *r = &study->recommendation;
  r->met = met;
  r->method = c->method;
  r->value = c->best.value;
  r->atol = c->best.trial.atol;
  r->error = c->best.trial.error_max;
  r->wall_seconds = c->best.trial.wall_seconds;
  r->force_evaluations = c->best.trial.force_evaluations;
}

/* ---- when nothing meets the wanted error ---- */

static void explain_no_rows(struct hk_study *study) {
  struct hk_study_recommendation *r = &study->recommendation;
  const struct hk_study_row *finest = NULL;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hk_study_row *row = &study->row[k];
    if (finest == NULL || row->value < finest->value) finest = row;
  }
  if (finest == NULL && study->budget_spent) {
    hk_print(r->note, sizeof r->note, "the budget of %g s ended before the first run did; give a larger one",
             study->budget);
  } else if (finest == NULL) {
    snprintf(r->note, sizeof r->note, "there are no runs to choose from");
  } else {
    const int adaptive = hk_study_is_adaptive(study, finest->method);
    hk_print(
        r->note, sizeof r->note,
        "no run finished, so none comes close: %s %s even at %s %.3g%s; give smaller steps or other methods",
        study->method[finest->method], finest->trial.status, adaptive ? "rtol" : "a step of", finest->value,
        adaptive ? "" : " s");
  }
}

static void keep_closest(struct hk_study *study, const struct hk_study_candidate *candidates) {
  struct hk_study_recommendation *r = &study->recommendation;
  const struct hk_study_candidate *closest = NULL;
  for (int32_t m = 0; m < study->method_count; m++) {
    const double error = candidates[m].best.trial.error_max;
    if (error >= 0.0 && (closest == NULL || error < closest->best.trial.error_max)) closest = &candidates[m];
  }
  if (closest == NULL) {
    explain_no_rows(study);
    return;
  }
  keep(study, closest, 0);
  if (r->want <= study->reference.agreement) {
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

/* ---- choosing ---- */

static void sort_by_prediction(struct hk_study_candidate *c, int32_t count) {
  for (int32_t k = 1; k < count; k++) {
    for (int32_t i = k; i > 0 && c[i].predicted < c[i - 1].predicted; i--) {
      const struct hk_study_candidate swap = c[i];
      c[i] = c[i - 1];
      c[i - 1] = swap;
    }
  }
}

static struct hk_study_candidate *cheapest_of(struct hk_study_candidate *c, int32_t count) {
  struct hk_study_candidate *best = NULL;
  for (int32_t k = 0; k < count; k++) {
    if (isnan(c[k].meets)) continue;
    if (best == NULL || hk_study_candidate_cost(&c[k]) < hk_study_candidate_cost(best)) best = &c[k];
  }
  return best;
}

/* One more run, for its time. */
static int32_t run_again(struct hk_study *study, struct hk_study_candidate *c, double *seconds) {
  const struct hk_listener listener = {.on_progress = hk_study_tell_row, .ctx = study};
  struct hk_study_row again;
  study->late = 0;
  study->row_deadline = study->deadline;
  study->under_way = study->method[c->method];
  const int32_t status = hk_study_run_row(study, c->method, c->best.value, &listener, &again);
  if (status == HOOKE_OK) *seconds = fmin(*seconds, again.trial.wall_seconds);
  hk_trial_release(&again.trial);
  return status == HOOKE_STOPPED && study->late ? HOOKE_OK : status;
}

/* Rows were measured minutes apart, when the machine was busy or idle: close ones are measured again in
 * turns. */
static int32_t race(struct hk_study *study, struct hk_study_candidate *c, struct hk_study_candidate **best) {
  double seconds[HOOKE_STUDY_METHODS], most;
  const int32_t methods = study->method_count;
  int32_t status = HOOKE_OK, contenders = 0;
  *best = cheapest_of(c, methods);
  if (*best == NULL) return HOOKE_OK;
  most = CONTENDS * hk_study_candidate_cost(*best);
  for (int32_t k = 0; k < methods; k++) {
    seconds[k] = !isnan(c[k].meets) && hk_study_candidate_cost(&c[k]) <= most ? INFINITY : NAN;
    contenders += isinf(seconds[k]) != 0;
  }
  const double begun = hk_clock_seconds();
  for (int32_t round = 0; contenders > 1 && round < MOST_ROUNDS && status == HOOKE_OK; round++) {
    if (hk_clock_seconds() > fmin(begun + RACE_SECONDS, study->deadline)) break;
    for (int32_t k = 0; k < methods && status == HOOKE_OK; k++)
      if (!isnan(seconds[k])) status = run_again(study, &c[k], &seconds[k]);
  }
  for (int32_t k = 0; k < methods; k++) {
    double *least = &c[k].best.trial.wall_seconds;
    *least = fmin(*least, seconds[k]); /* fmin ignores a NaN */
    if (seconds[k] < seconds[*best - c]) *best = &c[k];
  }
  return status;
}

/* The most promising first; a method that cannot become cheaper than the best so far is skipped. */
static int32_t search_all(struct hk_study *study, struct hk_study_candidate *c) {
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < study->method_count && status == HOOKE_OK; k++) {
    const struct hk_study_candidate *best = cheapest_of(c, k);
    status = hk_study_candidate_search(study, &c[k], best ? hk_study_candidate_cost(best) : INFINITY);
  }
  return status;
}

/* 1 if the method is one of the two that made the reference. */
static int made_reference(const struct hk_study *study, const struct hk_study_candidate *c) {
  const char *method = study->method[c->method];
  return strcmp(method, study->reference.method) == 0 || strcmp(method, study->reference.check) == 0;
}

/* Runs as fine as the reference meet the want, since the reference does; then coarsens from there. The
 * reference's own methods first. */
static int32_t search_from_reference(struct hk_study *study, struct hk_study_candidate *c) {
  int32_t status = HOOKE_OK;
  for (int own = 1; own >= 0; own--) {
    for (int32_t k = 0; k < study->method_count && status == HOOKE_OK; k++) {
      if (made_reference(study, &c[k]) != own || cheapest_of(c, study->method_count)) continue;
      status = hk_study_candidate_try_finest(study, &c[k]);
      if (status == HOOKE_OK && !isnan(c[k].meets))
        status = hk_study_candidate_search(study, &c[k], INFINITY);
    }
  }
  return status;
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

static void clear(struct hk_study *study, double want) {
  study->recommendation = (struct hk_study_recommendation){.made = 1,
                                                           .method = -1,
                                                           .want = want,
                                                           .value = NAN,
                                                           .atol = NAN,
                                                           .error = NAN,
                                                           .wall_seconds = NAN,
                                                           .force_evaluations = NAN,
                                                           .margin = {NAN, {NAN, NAN}, {NAN, NAN}}};
  study->work_ahead = 0.0;
}

int32_t hk_study_find_cheapest(struct hk_study *study, double want) {
  struct hk_study_candidate c[HOOKE_STUDY_METHODS];
  clear(study, want);
  if (is_untrusted(study)) return HOOKE_OK;
  for (int32_t m = 0; m < study->method_count; m++)
    hk_study_candidate_create(study, m, want, &c[m]);
  sort_by_prediction(c, study->method_count);
  struct hk_study_candidate *best = NULL;
  /* the cost of the reference is known, that of searches beyond the rows is not */
  const int far = study->method_count > 0 && !(c[0].predicted < study->reference.run_work);
  int32_t status = far ? search_from_reference(study, c) : HOOKE_OK;
  if (status == HOOKE_OK) status = search_all(study, c);
  if (status == HOOKE_OK) status = search_from_reference(study, c);
  if (status == HOOKE_OK)
    status = race(study, c, &best);
  else
    best = cheapest_of(c, study->method_count);
  if (best)
    keep(study, best, 1);
  else
    keep_closest(study, c);
  for (int32_t k = 0; k < study->method_count; k++)
    hk_study_candidate_release(&c[k]);
  return status == HOOKE_OK && best ? hk_study_find_margin(study) : status;
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
