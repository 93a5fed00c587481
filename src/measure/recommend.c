/* The recommendation: the cheapest step or tolerance whose error is at most what is wanted. Predicted on the measured
 * curves, then searched for by runs, so that what is recommended has been seen to hold. */
#include "measure/study.h"

#include "core/status.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MOST_METHODS = 3, MOST_RUNS = 8 };
static const double CLOSE_STEP = 1.1,
                    CLOSE_TOLERANCE = 1.6; /* a search ends when its bracket is this narrow */
static const double FARTHEST = 64.0;       /* beyond the finest row, times in step */

/* What is known of a method: the coarsest value that meets the want, and the finest coarser one that does not. */
struct candidate {
  int32_t method;
  double meets, fails; /* NaN: none */
  double error_at_fails, error_at_meets;
  double cost;                 /* predicted wall time of the best value [s] */
  struct hooke_study_row best; /* the row at `meets`, its trial owned if `owned` */
  int32_t owned;
};

static double floor_of(const hooke_study *study) {
  return study->reference.agreement;
}

/* The reference is only known to its agreement, so that much is added to every error. */
static int32_t meets(const hooke_study *study, const struct hooke_trial *trial, double want) {
  return trial->error + floor_of(study) <= want;
}

static struct candidate look_up(const hooke_study *study, int32_t method, double want) {
  struct candidate c = {.method = method, .meets = NAN, .fails = NAN, .cost = INFINITY};
  for (int64_t k = study->row_count - 1; k >= 0; k--) {
    const struct hooke_study_row *row = &study->row[k];
    if (row->method != method) continue;
    if (meets(study, &row->trial, want)) {
      c.meets = row->value;
      c.error_at_meets = row->trial.error;
      c.best = *row;
      c.fails = NAN;
    } else if (isnan(c.fails)) {
      c.fails = row->value;
      c.error_at_fails = row->trial.error;
      if (isnan(c.meets)) c.best = *row;
    }
  }
  return c;
}

/* Where the straight line between two points in logarithms has the error that is wanted, with a little to spare. */
static double interpolate(const struct candidate *c, double want) {
  const double goal = log(0.9 * want), high = log(c->error_at_fails), low = log(c->error_at_meets);
  if (!(c->error_at_fails > c->error_at_meets) || !(c->error_at_meets > 0.0))
    return sqrt(c->meets * c->fails);
  const double share = fmin(0.95, fmax(0.05, (goal - low) / (high - low)));
  return exp(log(c->meets) + share * (log(c->fails) - log(c->meets)));
}

/* Wall time in proportion to the steps; an error-controlled method's goes as rtol to the -1/6 or so. */
static void predict_cost(const hooke_study *study, struct candidate *c, double want) {
  const double power = hooke_study_is_adaptive(study, c->method) ? 1.0 / 6.0 : 1.0;
  const double seconds = c->best.trial.wall_seconds;
  if (!isnan(c->meets)) {
    const double value = isnan(c->fails) || isnan(c->error_at_fails) ? c->meets : interpolate(c, want);
    c->cost = seconds * pow(c->meets / value, power);
  } else if (!isnan(c->fails) && c->error_at_fails > 0.0 && want > floor_of(study)) {
    c->cost = seconds * fmin(FARTHEST, c->error_at_fails / want);
  }
}

/* ---- searching by runs ---- */

static int32_t try_value(hooke_study *study, struct candidate *c, double value, double want) {
  struct hooke_study_row row;
  const int32_t status = hooke_study_measure(study, c->method, value, &row);
  if (status != HOOKE_OK || row.trial.status == NULL) {
    hooke_trial_release(&row.trial);
    return status;
  }
  if (meets(study, &row.trial, want)) {
    if (c->owned) hooke_trial_release(&c->best.trial);
    c->best = row;
    c->owned = 1;
    c->meets = row.value;
    c->error_at_meets = row.trial.error;
  } else {
    c->fails = row.value;
    c->error_at_fails = row.trial.error;
    hooke_trial_release(&row.trial);
  }
  return HOOKE_OK;
}

/* Beyond the finest row, by the slope of the order that the method has; NaN when it leads too far. */
static double extrapolate(const hooke_study *study, const struct candidate *c, double want, double finest) {
  const double order = study->order[c->method].order;
  const double slope = isnan(order) || order < 0.5 ? 1.0 : order;
  const double value = c->fails * pow(0.8 * want / c->error_at_fails, 1.0 / slope);
  return value >= finest / FARTHEST && value < c->fails ? value : NAN;
}

static double next_value(const hooke_study *study, const struct candidate *c, double want, double finest,
                         int32_t run) {
  const int32_t adaptive = hooke_study_is_adaptive(study, c->method);
  double value;
  if (isnan(c->meets))
    value = extrapolate(study, c, want, finest);
  else if (isnan(c->fails))
    return NAN;
  else if (c->fails / c->meets <= (adaptive ? CLOSE_TOLERANCE : CLOSE_STEP))
    return NAN;
  else
    value = run == 0 && !isnan(c->error_at_fails) ? interpolate(c, want) : sqrt(c->meets * c->fails);
  if (isnan(value) || adaptive) return value;
  value = hooke_study_fitting_step(study, value);
  return value < c->fails && !(value <= c->meets) ? value : NAN;
}

static int32_t search(hooke_study *study, struct candidate *c, double want) {
  const double finest = c->best.value;
  int32_t status = HOOKE_OK;
  for (int32_t run = 0; run < MOST_RUNS && status == HOOKE_OK; run++) {
    const double value = next_value(study, c, want, finest, run);
    if (isnan(value)) break;
    status = try_value(study, c, value, want);
  }
  return status;
}

/* ---- choosing ---- */

static void keep(hooke_study *study, const struct candidate *c, int32_t met) {
  struct hooke_study_recommendation *r = &study->recommendation;
  r->met = met;
  r->method = c->method;
  r->value = c->best.value;
  r->atol = c->best.trial.atol;
  r->error = c->best.trial.error;
  r->wall_seconds = c->best.trial.wall_seconds;
  r->force_evaluations = c->best.trial.force_evaluations;
}

static void keep_closest(hooke_study *study, double want) {
  struct hooke_study_recommendation *r = &study->recommendation;
  const struct hooke_study_row *closest = NULL;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hooke_study_row *row = &study->row[k];
    if (row->trial.error >= 0.0 && (closest == NULL || row->trial.error < closest->trial.error))
      closest = row;
  }
  if (closest) {
    const struct candidate c = {.method = closest->method, .best = *closest};
    keep(study, &c, 0);
  }
  if (want <= floor_of(study)) {
    snprintf(r->note, sizeof r->note,
             "%.3g m is below %.3g m, to which the reference itself is known; want more than that", want,
             floor_of(study));
  } else if (closest) {
    snprintf(r->note, sizeof r->note, "no run comes within %.3g m; the closest is %.3g m off; %s", want,
             closest->trial.error,
             study->budget_spent ? "a larger budget would try finer steps"
                                 : "more points would try finer steps");
  } else {
    snprintf(r->note, sizeof r->note, "no run finished: every step tried is too large");
  }
}

static void sort_by_cost(struct candidate *c, int32_t count) {
  for (int32_t k = 1; k < count; k++) {
    for (int32_t i = k; i > 0 && c[i].cost < c[i - 1].cost; i--) {
      const struct candidate swap = c[i];
      c[i] = c[i - 1];
      c[i - 1] = swap;
    }
  }
}

int32_t hooke_study_recommend(hooke_study *study, double want) {
  if (study->reference.frames.count == 0) {
    return hooke_fail(HOOKE_BAD_CALL, NULL, "the study has not been run yet; call hooke_study_run() first");
  }
  if (!(want > 0.0))
    return hooke_fail(HOOKE_BAD_VALUE, "want", "%g is not allowed; a number > 0 [m] is", want);
  struct candidate c[HOOKE_STUDY_METHODS];
  for (int32_t m = 0; m < study->method_count; m++) {
    c[m] = look_up(study, m, want);
    predict_cost(study, &c[m], want);
  }
  sort_by_cost(c, study->method_count);
  study->recommendation = (struct hooke_study_recommendation){.made = 1, .method = -1, .want = want};
  study->work_ahead = 0.0;
  int32_t status = HOOKE_OK;
  const struct candidate *best = NULL;
  for (int32_t k = 0; k < study->method_count && k < MOST_METHODS && status == HOOKE_OK; k++) {
    if (isinf(c[k].cost)) break;
    status = search(study, &c[k], want);
    if (isnan(c[k].meets)) continue;
    if (best == NULL || c[k].best.trial.wall_seconds < best->best.trial.wall_seconds) best = &c[k];
  }
  if (best)
    keep(study, best, 1);
  else
    keep_closest(study, want);
  for (int32_t k = 0; k < study->method_count; k++) {
    if (c[k].owned) hooke_trial_release(&c[k].best.trial);
  }
  return status;
}
