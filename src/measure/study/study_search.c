#include "measure/study/study_search.h"

#include "core/clock.h"

#include <math.h>
#include <stddef.h>

enum { MOST_RUNS = 16 };
static const double CLOSE_STEP = 1.1,
                    CLOSE_TOLERANCE = 1.5; /* a search ends when its bracket is this narrow */
static const double CLOSE_ERROR = 0.85;    /* or when the error is this fraction of the allowed one */
static const double GOAL = 0.92,
                    BEYOND = 0.8;    /* target, as such a fraction, between rows and beyond the finest */
static const double FARTHEST = 64.0; /* maximum factor in the step beyond the finest row */
static const double LOOSEST = 0.1;   /* largest rtol of a run */
static const double COARSER_STEP = 2.0, COARSER_TOLERANCE = 10.0;  /* while the coarsest row meets the want */
static const double HOPELESS = 4.0;                                /* times the cost of the best */
static const double FINER = 4.0;                                   /* while runs diverge */
static const double FARTHEST_STEP = 8.0, FARTHEST_TOLERANCE = 1e3; /* at a time */
static const double TIGHTEST = 1e-14;                              /* smallest rtol of a run */

/* Wall time scales with the number of steps; that of an error-controlled method with a power of rtol:
 * approximate, and at most. */
static const double USUAL_POWER = 1.0 / 6.0, LARGEST_POWER = 1.0 / 3.0;

static int is_adaptive(const struct hk_study *study, const struct hk_study_candidate *c) {
  return hk_study_is_adaptive(study, c->method);
}

/* Evaluations of forces and products with their derivatives: proportional to time, but the same in every run.
 */
static double work_of(const struct hk_trial *trial) {
  return trial->force_evaluations + fmax(0.0, trial->linear_iterations);
}

double hk_study_candidate_cost(const struct hk_study_candidate *c) {
  return work_of(&c->best.trial) * c->rate;
}

/* ---- prediction from the ladder ---- */

/* Value at which the straight line between two points in logarithms has the allowed error, with a small
 * margin. */
static double interpolate(const struct hk_study_candidate *c) {
  const double goal = log(GOAL * c->most), high = log(c->error_at_fails), low = log(c->error_at_meets);
  if (!(c->error_at_fails > c->error_at_meets) || !(c->error_at_meets > 0.0))
    return sqrt(c->meets * c->fails);
  const double share = fmin(0.95, fmax(0.05, (goal - low) / (high - low)));
  return exp(log(c->meets) + share * (log(c->fails) - log(c->meets)));
}

/* If nothing meets the want yet, extrapolates by the observed order; a value as tight as the reference takes
 * as long. */
static double predict_beyond(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double order = study->order[c->method].order;
  if (!(c->error_at_fails > 0.0) || !(c->most > 0.0)) return INFINITY;
  if (is_adaptive(study, c)) return study->reference.run_work;
  return isnan(order) || order < 0.5
             ? INFINITY
             : hk_study_candidate_cost(c) * pow(c->error_at_fails / c->most, 1.0 / order);
}

static void predict(const struct hk_study *study, struct hk_study_candidate *c) {
  const double power = is_adaptive(study, c) ? USUAL_POWER : 1.0;
  const double value = isnan(c->fails) || isnan(c->error_at_fails) ? c->meets : interpolate(c);
  c->predicted = isnan(c->meets) ? predict_beyond(study, c)
                                 : hk_study_candidate_cost(c) * pow(c->best.value / value, power);
}

/* Adds a row to the state. 1 if it is the best so far. */
static int learn(struct hk_study_candidate *c, const struct hk_study_row *row) {
  const struct hk_trial *trial = &row->trial, *best = &c->best.trial;
  const int had = !isnan(c->meets);
  c->rate = fmin(c->rate, trial->wall_seconds / work_of(trial));
  if (isnan(c->finest) || (!c->finished && !isnan(trial->error_max))) c->finest = row->value;
  c->finished |= !isnan(trial->error_max);
  if (trial->error_max <= c->most) {
    if (!had || row->value > c->meets) {
      c->meets = row->value;
      c->error_at_meets = trial->error_max;
      if (c->fails <= c->meets) c->fails = NAN;
    }
    return !had || work_of(trial) < work_of(best);
  }
  /* a coarser row that meets the want wins over a finer one that does not */
  if ((!had || row->value > c->meets) && !(row->value >= c->fails)) {
    c->fails = row->value;
    c->error_at_fails = trial->error_max;
  }
  return !had && (best->status == NULL || isnan(best->error_max) || trial->error_max < best->error_max);
}

void hk_study_candidate_create(const struct hk_study *study, int32_t method, double want,
                               struct hk_study_candidate *c) {
  *c = (struct hk_study_candidate){.method = method,
                                   .most = want - study->reference.agreement,
                                   .meets = NAN,
                                   .fails = NAN,
                                   .error_at_meets = NAN,
                                   .error_at_fails = NAN,
                                   .finest = NAN,
                                   .rate = INFINITY};
  c->best.value = NAN;
  c->best.trial.error_max = NAN;
  /* rows go from coarse to fine */
  for (int64_t k = study->row_count - 1; k >= 0; k--) {
    const struct hk_study_row *row = &study->row[k];
    if (row->method != method) continue;
    if (learn(c, row)) c->best = *row;
  }
  predict(study, c);
}

void hk_study_candidate_release(struct hk_study_candidate *c) {
  if (c->owned) hk_trial_release(&c->best.trial);
  c->owned = 0;
}

/* ---- searching by runs ---- */

static int32_t try_value(struct hk_study *study, struct hk_study_candidate *c, double value) {
  struct hk_study_row row;
  study->row_deadline = study->deadline;
  const int32_t status = hk_study_measure(study, c->method, value, &row);
  if (status == HOOKE_OK && row.trial.status && learn(c, &row)) {
    hk_study_candidate_release(c);
    c->best = row;
    c->owned = 1;
  } else {
    hk_trial_release(&row.trial);
  }
  return status;
}

/* A tolerance as tight as the reference's, whose absolute one is in proportion to the extent; a step that
 * takes as many evaluations of forces. */
static double as_fine_as_reference(const struct hk_study *study, int32_t method) {
  const struct hk_reference *r = &study->reference;
  if (!hk_study_is_adaptive(study, method))
    return hk_study_fitting_step(study, study->duration / fmax(1.0, r->evaluations));
  const double share = hooke_options_number(study->run, "atol") / hooke_options_number(study->run, "rtol");
  return fmax(TIGHTEST, fmin(r->rtol, r->atol / share));
}

/* End of a search: beyond the ladder, and as fine as the reference; for steps with a budget, when that is
 * spent. */
static double least_value(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double least = as_fine_as_reference(study, c->method), farthest = c->finest / FARTHEST;
  if (is_adaptive(study, c)) return least;
  return isinf(study->budget) ? fmin(least, farthest) : 0.0;
}

/* Value at which errors that scale with this power of the step or tolerance reach the wanted one, from the
 * finest row on. */
static double by_slope(const struct hk_study_candidate *c, double slope) {
  return c->fails * pow(BEYOND * c->most / c->error_at_fails, 1.0 / slope);
}

/* By the observed order of the method. */
static double by_order(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double order = study->order[c->method].order;
  return by_slope(c, isnan(order) || order < 0.5 ? 1.0 : order);
}

/* By the highest order that it can have. */
static double by_theory(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double theory = study->order[c->method].theory;
  return by_slope(c, isnan(theory) ? 1.0 : theory);
}

/* Beyond the finest row: by the slope, but in small steps, for it may become steeper; or until a run does not
 * diverge. NaN at the end. */
static double finer(const struct hk_study *study, const struct hk_study_candidate *c) {
  if (c->most <= 0.0) return NAN;
  const double least = least_value(study, c);
  if (c->fails <= least * (1.0 + 1e-9)) return NAN;
  const double farthest = is_adaptive(study, c) ? FARTHEST_TOLERANCE : FARTHEST_STEP;
  const double value = isnan(c->error_at_fails) ? c->fails / FINER : by_order(study, c);
  return fmax(least, fmax(c->fails / farthest, value));
}

static double coarser(const struct hk_study *study, const struct hk_study_candidate *c) {
  const int adaptive = is_adaptive(study, c);
  const double largest = adaptive ? LOOSEST : study->unit;
  const double value = c->meets * (adaptive ? COARSER_TOLERANCE : COARSER_STEP);
  return c->meets < largest * (1.0 - 1e-9) ? fmin(value, largest) : NAN;
}

/* The step next to `step` that fits, strictly between the known ones; NaN if there is none. */
static double fit_between(const struct hk_study *study, const struct hk_study_candidate *c, double step) {
  const double most = isnan(c->meets) ? INFINITY : round(study->unit / c->meets) - 1.0;
  const double least = isnan(c->fails) ? 1.0 : round(study->unit / c->fails) + 1.0;
  const double parts = fmax(least, fmin(most, round(study->unit / step)));
  return parts <= most ? study->unit / parts : NAN;
}

static int is_close(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double close = is_adaptive(study, c) ? CLOSE_TOLERANCE : CLOSE_STEP;
  return c->fails / c->meets <= close || c->error_at_meets >= CLOSE_ERROR * c->most;
}

/* Alternates between the value where the error should be right and the middle of the bracket, so that both
 * ends move. */
static double next_value(const struct hk_study *study, const struct hk_study_candidate *c, int32_t run) {
  double value;
  if (isnan(c->meets))
    value = isnan(c->fails) ? NAN : finer(study, c);
  else if (isnan(c->fails))
    value = coarser(study, c);
  else if (is_close(study, c))
    return NAN;
  else
    value = isnan(c->error_at_fails) || run % 2 == 1 ? sqrt(c->meets * c->fails) : interpolate(c);
  return isnan(value) || is_adaptive(study, c) ? value : fit_between(study, c, value);
}

/* Minimum wall time of a run of this candidate [s]: costs only grow from coarse to fine. */
static double least_cost(const struct hk_study *study, const struct hk_study_candidate *c) {
  const double seconds = hk_study_candidate_cost(c);
  if (isnan(c->meets)) return isnan(c->error_at_fails) ? 0.0 : seconds;
  const double power = is_adaptive(study, c) ? LARGEST_POWER : 1.0;
  return isnan(c->fails) ? 0.0 : seconds * pow(c->best.value / c->fails, power);
}

/* Predicted time of a run of the next value [s], for the deadline. */
static double next_cost(const struct hk_study *study, const struct hk_study_candidate *c, double value) {
  const double power = is_adaptive(study, c) ? USUAL_POWER : 1.0;
  return hk_study_candidate_cost(c) * pow(c->best.value / value, power);
}

/* While nothing meets the want yet: 1 if the candidate will not come below `cost` even at its theoretical
 * order; nor, if none of its runs finished, if another method has done better. */
static int is_hopeless(const struct hk_study *study, const struct hk_study_candidate *c, double cost) {
  if (!isnan(c->meets) || isinf(cost)) return 0;
  return isnan(c->error_at_fails) || next_cost(study, c, by_theory(study, c)) >= HOPELESS * cost;
}

int32_t hk_study_candidate_search(struct hk_study *study, struct hk_study_candidate *c, double cost) {
  int32_t status = HOOKE_OK;
  for (int32_t run = 0; run < MOST_RUNS && status == HOOKE_OK; run++) {
    const double value = next_value(study, c, run);
    if (isnan(value) || is_hopeless(study, c, cost) || least_cost(study, c) >= cost) break;
    const int late = hk_clock_seconds() + next_cost(study, c, value) > study->deadline;
    study->budget_spent |= late;
    /* if nothing meets the want yet, the remaining time is better spent on this */
    if (late && !isinf(cost)) break;
    status = try_value(study, c, value);
    if (study->late) break;
  }
  return status;
}

int32_t hk_study_candidate_try_finest(struct hk_study *study, struct hk_study_candidate *c) {
  const double value = as_fine_as_reference(study, c->method);
  if (c->most <= 0.0 || !isnan(c->meets) || c->fails <= value) return HOOKE_OK;
  if (hk_clock_seconds() < study->deadline) return try_value(study, c, value);
  study->budget_spent = 1;
  return HOOKE_OK;
}
