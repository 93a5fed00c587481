/* The tables of a study. */
#include "measure/study/study.h"

#include <math.h>
#include <stddef.h>

static const double NEAR = 10.0; /* times a floor */

static int is_made(const struct hk_study *study) {
  return study->reference.frames.count > 0;
}

/* ---- the study ---- */

HOOKE_READER(double, frames, struct hk_study, is_made(it) ? (double)it->reference.trusted : NAN)

static const struct hk_column study_columns[] = {
    HOOKE_COLUMN(struct hk_study, duration, NUMBER, "s", "duration of the run"),
    HOOKE_COLUMN_BY(frames, frames, COUNT, "", "frames over which errors are judged"),
    HOOKE_COLUMN(struct hk_study, budget_spent, FLAG, "", "rows are missing for lack of time"),
};

static const struct hk_table study_table = {
    .name = "study",
    .doc = "the study itself",
    .record = 1,
    HOOKE_TABLE_COLUMNS(study_columns),
};

/* ---- the reference ---- */

static const char *how_it_ended(const struct hk_reference *r) {
  if (r->trusted == r->frames.count && !r->coarse) return "agreed";
  return r->hurried ? "time" : "rounding";
}

HOOKE_READER(const void *, find_reference, struct hk_study, is_made(it) ? &it->reference : NULL)
HOOKE_READER(const char *, ended, struct hk_study, how_it_ended(&it->reference))
HOOKE_READER(double, trusted_until, struct hk_study,
             hk_reference_time(&it->reference, it->reference.trusted, it->duration))
HOOKE_READER(double, checked_until, struct hk_study,
             hk_reference_time(&it->reference, it->reference.checked, it->duration))
HOOKE_COUNTER(trusted, struct hk_study, it->reference.trusted)

static const struct hk_column reference_columns[] = {
    HOOKE_COLUMN(
        struct hk_reference, agreement, NUMBER, "m",
        "twice the largest distance of a particle between the two over the frames that are trusted, and of "
        "what rounding may do to one; no error below it means anything, and none within ten times of it "
        "much; NaN if no frame after the start is trusted"),
    HOOKE_COLUMN_BY(trusted_until, trusted_until, NUMBER, "s",
                    "time up to which the two agree to the wanted digits; errors are judged up to there"),
    HOOKE_COLUMN(
        struct hk_reference, growth, NUMBER, "",
        "factor by which a small displacement of the start grows at most, with growth_probability; NaN "
        "where that is not known"),
    HOOKE_COLUMN(struct hk_reference, growth_probability, NUMBER, "", "probability that growth holds"),
    HOOKE_COLUMN(struct hk_reference, growth_seen, NUMBER, "",
                 "the largest growth of the displacements tried"),
    HOOKE_COLUMN(struct hk_reference, displacements, COUNT, "", "displacements tried"),
    HOOKE_COLUMN(struct hk_reference, energy_agreement, NUMBER, "J",
                 "twice the largest difference of their energies there"),
    HOOKE_COLUMN_BY(
        ended, ended, TEXT, "",
        "why they were tightened no further: agreed, time (the budget was short), or rounding (it keeps "
        "them apart at the tightest tolerances)"),
    HOOKE_COLUMN(struct hk_reference, method, TEXT, "", "integrator that made the reference"),
    HOOKE_COLUMN(struct hk_reference, check, TEXT, "",
                 "integrator that checked it; they share only the forces"),
    HOOKE_COLUMN_BY(checked_until, checked_until, NUMBER, "s",
                    "time up to which the two were compared; before the end where the budget was spent"),
    HOOKE_COLUMN_AS(struct hk_reference, frames.zero_passages, zero_passages, TEXT, "",
                    "of springs that passed through length zero in it; empty where none did"),
    HOOKE_COLUMN_AS(struct hk_reference, frames.time, time, SERIES, "s",
                    "times of the frames that are judged"),
};

static const struct hk_table reference_table = {
    .name = "reference",
    .doc = "the solution that errors are measured against, made by two integrators that check each other",
    .record = 1,
    HOOKE_TABLE_COLUMNS(reference_columns),
    .row = find_reference,
    .length = trusted,
};

/* ---- rows ---- */

int32_t hk_study_is_near_floor(const struct hk_study *study, const struct hk_study_row *row) {
  return row->trial.error <= NEAR * fmax(study->reference.agreement, row->trial.rounding);
}

HOOKE_READER(const void *, find_row, struct hk_study, &it->row[row])
HOOKE_READER(const char *, row_method, struct hk_study, it->method[it->row[row].method])
HOOKE_READER(double, near_floor, struct hk_study, hk_study_is_near_floor(it, &it->row[row]))
HOOKE_READER(double, near_energy_floor, struct hk_study,
             it->row[row].trial.energy_drift <= NEAR * it->reference.energy_agreement)

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN_BY(row_method, method, TEXT, "", "method"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.step, step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.rtol, rtol, NUMBER, "",
                    "relative tolerance of an error-controlled method"),
    HOOKE_TRIAL_COLUMNS(struct hk_study_row),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.wall_seconds, wall_seconds, NUMBER, "s",
                    "wall time, the least of the repeated runs"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.status, status, TEXT, "",
                    "finished, diverged, stopped or failed"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.atol, atol, NUMBER, "m", "absolute tolerance of positions"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.linear_iterations, linear_iterations, COUNT, "",
                    "iterations of linear solvers"),
    HOOKE_COLUMN(struct hk_study_row, wall_median, NUMBER, "s", "median of the repeated runs"),
    HOOKE_COLUMN(struct hk_study_row, repeats, COUNT, "", "runs that were timed"),
    HOOKE_COLUMN_BY(near_floor, near_floor, FLAG, "",
                    "the error is within ten times of the agreement, or of what rounding may do"),
    HOOKE_COLUMN_BY(near_energy_floor, near_energy_floor, FLAG, "",
                    "the energy drift is within ten times of the agreement of energies"),
    HOOKE_COLUMN(struct hk_study_row, timed_alone, FLAG, "",
                 "0: timed while other rows were running, so its time may be too long"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.error_at, error_at, SERIES, "m",
                    "root mean square distance at every frame"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.error_max_at, error_max_at, SERIES, "m",
                    "largest distance of any free particle at every frame"),
    HOOKE_COLUMN_AS(struct hk_study_row, trial.drift_at, energy_drift_at, SERIES, "J",
                    "energy less that of the reference at every frame"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "a method with one step or tolerance each, the coarsest first",
    HOOKE_TABLE_COLUMNS(row_columns),
    HOOKE_TABLE_COUNT(struct hk_study, row_count),
    .row = find_row,
    .length = trusted,
};

/* ---- orders ---- */

HOOKE_READER(const void *, find_order, struct hk_study, &it->order[row])
HOOKE_READER(const char *, order_method, struct hk_study, it->method[row])
HOOKE_COUNTER(count_orders, struct hk_study, is_made(it) ? it->method_count : 0)

static const struct hk_column order_columns[] = {
    HOOKE_COLUMN_BY(order_method, method, TEXT, "", "method"),
    HOOKE_COLUMN(
        struct hk_study_order, order, NUMBER, "",
        "slope of log error over log step by least squares, over the finest rows clear of the floor; NaN "
        "with fewer than three of them, and for an error-controlled method"),
    HOOKE_COLUMN(
        struct hk_study_order, low, NUMBER, "",
        "lower end of the 95 % confidence interval of that slope, as if errors scattered about a line by "
        "chance"),
    HOOKE_COLUMN(struct hk_study_order, high, NUMBER, "", "upper end of that interval"),
    HOOKE_COLUMN(struct hk_study_order, theory, NUMBER, "", "the method's order"),
    HOOKE_COLUMN(struct hk_study_order, note, TEXT, "", "why they may differ"),
};

static const struct hk_table order_table = {
    .name = "orders",
    .doc = "the order that each method showed",
    HOOKE_TABLE_COLUMNS(order_columns),
    .count = count_orders,
    .row = find_order,
};

/* ---- the recommendation ---- */

double hk_study_setting(const struct hk_study *study, int32_t method, double value, int32_t adaptive) {
  return adaptive == (method < 0 || hk_study_is_adaptive(study, method)) ? value : NAN;
}

HOOKE_READER(const char *, recommended_method, struct hk_study,
             it->recommendation.method < 0 ? NULL : it->method[it->recommendation.method])
HOOKE_READER(double, recommended_step, struct hk_study,
             hk_study_setting(it, it->recommendation.method, it->recommendation.value, 0))
HOOKE_READER(double, recommended_rtol, struct hk_study,
             hk_study_setting(it, it->recommendation.method, it->recommendation.value, 1))

static const struct hk_column recommendation_columns[] = {
    HOOKE_COLUMN_AS(struct hk_study, recommendation.want, want, NUMBER, "m",
                    "the wanted error, a distance that no free particle exceeds"),
    HOOKE_COLUMN_BY(recommended_method, method, TEXT, "",
                    "method of the cheapest run that meets the wanted error, else of the closest run"),
    HOOKE_COLUMN_BY(recommended_step, step, NUMBER, "s", "its step"),
    HOOKE_COLUMN_BY(recommended_rtol, rtol, NUMBER, "", "its relative tolerance"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.error, error, NUMBER, "m",
                    "its error: the largest distance of any free particle"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.until, until, NUMBER, "s",
                    "time up to which that holds; before the end where nobody knows the motion that long"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.wall_seconds, wall_seconds, NUMBER, "s",
                    "its wall time, the least of several"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.wall_median, wall_median, NUMBER, "s", "their median"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.met, met, FLAG, "",
                    "a run was seen to have at most that error"),
    HOOKE_COLUMN_AS(
        struct hk_study, recommendation.note, note, TEXT, "",
        "what is in the way where nothing meets it; else empty, or that this machine's times would reverse "
        "the choice, which is by counted work"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.atol, atol, NUMBER, "m",
                    "its absolute tolerance of positions"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.force_evaluations, force_evaluations, COUNT, "",
                    "its evaluations of the forces"),
};

static const struct hk_table recommendation_table = {
    .name = "recommendation",
    .doc = "which run to make for the wanted error",
    .record = 1,
    HOOKE_TABLE_COLUMNS(recommendation_columns),
    HOOKE_TABLE_COUNT(struct hk_study, recommendation.made),
};

/* ---- its margin ---- */

/* fmax() would take an unknown number for 0. */
static double least_error(const struct hk_study *study) {
  const double least = study->recommendation.error - study->reference.agreement;
  return isnan(study->recommendation.error) ? NAN : fmax(0.0, least);
}

HOOKE_READER(double, error_low, struct hk_study, least_error(it))
HOOKE_READER(double, error_high, struct hk_study, it->recommendation.error + it->reference.agreement)

static const struct hk_column margin_columns[] = {
    HOOKE_COLUMN_BY(error_low, error_low, NUMBER, "m", "error less the agreement of the reference"),
    HOOKE_COLUMN_BY(error_high, error_high, NUMBER, "m", "error plus the agreement of the reference"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.margin.limit_share, limit_share, NUMBER, "",
                    "its step over the largest stable one at the start"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.margin.holds[HOOKE_STUDY_STIFFNESS], holds_stiffness,
                    FLAG, "", "the wanted error is met with 10 % more stiffness, and with 10 % less"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.margin.error[HOOKE_STUDY_STIFFNESS], error_stiffness,
                    NUMBER, "m", "the larger error of those two"),
    HOOKE_COLUMN_AS(
        struct hk_study, recommendation.margin.holds[HOOKE_STUDY_START], holds_start, FLAG, "",
        "the wanted error is met with 10 % of the largest speed added along (1, 1, 1) at the start, and "
        "against it"),
    HOOKE_COLUMN_AS(struct hk_study, recommendation.margin.error[HOOKE_STUDY_START], error_start, NUMBER, "m",
                    "the larger error of those two"),
};

static const struct hk_table margin_table = {
    .name = "margin",
    .doc = "what the recommendation has to spare",
    .group = "recommendation",
    .record = 1,
    HOOKE_TABLE_COLUMNS(margin_columns),
    HOOKE_TABLE_COUNT(struct hk_study, recommendation.made),
};

/* ---- the list ---- */

const struct hk_table *const hk_study_tables[] = {&study_table,
                                                  &reference_table,
                                                  &row_table,
                                                  &order_table,
                                                  &recommendation_table,
                                                  &margin_table,
                                                  &hk_study_watched_table,
                                                  &hk_study_error_table,
                                                  &hk_study_ensemble_table,
                                                  &hk_study_statistic_table,
                                                  NULL};
