/* The tables of a study. */
#include "measure/study/study.h"

#include <math.h>
#include <stddef.h>

static const double NEAR = 10.0; /* times a floor */

static int is_made(const struct hk_study *study) {
  return study->reference.frames.count > 0;
}

/* ---- the study ---- */

struct study_line {
  double duration, frames, budget_spent;
};

static void read_study(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  (void)row;
  *(struct study_line *)line =
      (struct study_line){.duration = study->duration,
                          .frames = is_made(study) ? (double)study->reference.trusted : NAN,
                          .budget_spent = (double)study->budget_spent};
}

static const struct hk_column study_columns[] = {
    HOOKE_COLUMN(struct study_line, duration, NUMBER, "s", "duration of the run"),
    HOOKE_COLUMN(struct study_line, frames, COUNT, "", "frames over which errors are judged"),
    HOOKE_COLUMN(struct study_line, budget_spent, FLAG, "", "rows are missing for lack of time"),
};

static const struct hk_table study_table = {
    .name = "study",
    .doc = "the study itself",
    .record = 1,
    HOOKE_TABLE_COLUMNS(study_columns, struct study_line),
    .read = read_study,
};

/* ---- the reference ---- */

struct reference_line {
  const char *method, *check, *ended, *zero_passages;
  double agreement, energy_agreement, trusted_until, checked_until;
  double growth, growth_probability, growth_seen, displacements;
  struct hk_series time;
};

static const char *how_it_ended(const struct hk_reference *r) {
  if (r->trusted == r->frames.count && !r->coarse) return "agreed";
  return r->hurried ? "time" : "rounding";
}

static void read_reference(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_reference *r = &study->reference;
  (void)row;
  if (!is_made(study)) {
    *(struct reference_line *)line =
        (struct reference_line){NULL, NULL, NULL, NULL, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, {NULL, 0}};
    return;
  }
  *(struct reference_line *)line = (struct reference_line){
      .method = r->method,
      .check = r->check,
      .ended = how_it_ended(r),
      .zero_passages = r->frames.zero_passages,
      .agreement = r->agreement,
      .energy_agreement = r->energy_agreement,
      .trusted_until = hk_reference_time(r, r->trusted, study->duration),
      .checked_until = hk_reference_time(r, r->checked, study->duration),
      .growth = r->growth,
      .growth_probability = r->growth_probability,
      .growth_seen = r->growth_seen,
      .displacements = (double)r->displacements,
      .time = {r->frames.time, r->trusted},
  };
}

static const struct hk_column reference_columns[] = {
    HOOKE_COLUMN(
        struct reference_line, agreement, NUMBER, "m",
        "twice the largest distance of a particle between the two over the frames that are trusted, and of "
        "what rounding may do to one; no error below it means anything, and none within ten times of it "
        "much; NaN if no frame after the start is trusted"),
    HOOKE_COLUMN(struct reference_line, trusted_until, NUMBER, "s",
                 "time up to which the two agree to the wanted digits; errors are judged up to there"),
    HOOKE_COLUMN(
        struct reference_line, growth, NUMBER, "",
        "factor by which a small displacement of the start grows at most, with growth_probability; NaN "
        "where that is not known"),
    HOOKE_COLUMN(struct reference_line, growth_probability, NUMBER, "", "probability that growth holds"),
    HOOKE_COLUMN(struct reference_line, growth_seen, NUMBER, "",
                 "the largest growth of the displacements tried"),
    HOOKE_COLUMN(struct reference_line, displacements, COUNT, "", "displacements tried"),
    HOOKE_COLUMN(struct reference_line, energy_agreement, NUMBER, "J",
                 "twice the largest difference of their energies there"),
    HOOKE_COLUMN(
        struct reference_line, ended, TEXT, "",
        "why they were tightened no further: agreed, time (the budget was short), or rounding (it keeps "
        "them apart at the tightest tolerances)"),
    HOOKE_COLUMN(struct reference_line, method, TEXT, "", "integrator that made the reference"),
    HOOKE_COLUMN(struct reference_line, check, TEXT, "",
                 "integrator that checked it; they share only the forces"),
    HOOKE_COLUMN(struct reference_line, checked_until, NUMBER, "s",
                 "time up to which the two were compared; before the end where the budget was spent"),
    HOOKE_COLUMN(struct reference_line, zero_passages, TEXT, "",
                 "of springs that passed through length zero in it; empty where none did"),
    HOOKE_COLUMN(struct reference_line, time, SERIES, "s", "times of the frames that are judged"),
};

static const struct hk_table reference_table = {
    .name = "reference",
    .doc = "the solution that errors are measured against, made by two integrators that check each other",
    .record = 1,
    HOOKE_TABLE_COLUMNS(reference_columns, struct reference_line),
    .read = read_reference,
};

/* ---- rows ---- */

struct row_line {
  struct hk_trial_line trial; /* first: its columns are those of the line */
  double wall_median, repeats, near_floor, near_energy_floor, timed_alone;
};

static double is_near(double value, double floor) {
  return value <= NEAR * floor ? 1.0 : 0.0;
}

int32_t hk_study_is_near_floor(const struct hk_study *study, const struct hk_study_row *row) {
  return row->trial.error <= NEAR * fmax(study->reference.agreement, row->trial.rounding);
}

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_study_row *r = &study->row[row];
  const struct hk_trial *t = &r->trial;
  *(struct row_line *)line = (struct row_line){
      .trial = hk_trial_line(t, study->method[r->method], study->reference.trusted),
      .wall_median = r->wall_median,
      .repeats = (double)r->repeats,
      .near_floor = (double)hk_study_is_near_floor(study, r),
      .near_energy_floor = is_near(t->energy_drift, study->reference.energy_agreement),
      .timed_alone = (double)r->timed_alone,
  };
}

static const struct hk_column row_columns[] = {
    HOOKE_TRIAL_COLUMN(method, TEXT, "", "method"),
    HOOKE_TRIAL_COLUMN(step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_TRIAL_COLUMN(rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
    HOOKE_TRIAL_COLUMNS,
    HOOKE_TRIAL_COLUMN(wall_seconds, NUMBER, "s", "wall time, the least of the repeated runs"),
    HOOKE_TRIAL_COLUMN(status, TEXT, "", "finished, diverged, stopped or failed"),
    HOOKE_TRIAL_COLUMN(atol, NUMBER, "m", "absolute tolerance of positions"),
    HOOKE_TRIAL_COLUMN(linear_iterations, COUNT, "", "iterations of linear solvers"),
    HOOKE_COLUMN(struct row_line, wall_median, NUMBER, "s", "median of the repeated runs"),
    HOOKE_COLUMN(struct row_line, repeats, COUNT, "", "runs that were timed"),
    HOOKE_COLUMN(struct row_line, near_floor, FLAG, "",
                 "the error is within ten times of the agreement, or of what rounding may do"),
    HOOKE_COLUMN(struct row_line, near_energy_floor, FLAG, "",
                 "the energy drift is within ten times of the agreement of energies"),
    HOOKE_COLUMN(struct row_line, timed_alone, FLAG, "",
                 "0: timed while other rows were running, so its time may be too long"),
    HOOKE_TRIAL_COLUMN(error_at, SERIES, "m", "root mean square distance at every frame"),
    HOOKE_TRIAL_COLUMN(error_max_at, SERIES, "m", "largest distance of any free particle at every frame"),
    HOOKE_TRIAL_COLUMN(energy_drift_at, SERIES, "J", "energy less that of the reference at every frame"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "a method with one step or tolerance each, the coarsest first",
    HOOKE_TABLE_COLUMNS(row_columns, struct row_line),
    HOOKE_TABLE_COUNT(struct hk_study, row_count),
    .read = read_row,
};

/* ---- orders ---- */

struct order_line {
  const char *method, *note;
  double order, low, high, theory;
};

static int64_t count_orders(const void *object) {
  const struct hk_study *study = object;
  return is_made(study) ? study->method_count : 0;
}

static void read_order(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_study_order *o = &study->order[row];
  *(struct order_line *)line = (struct order_line){.method = study->method[row],
                                                   .note = o->note,
                                                   .order = o->order,
                                                   .low = o->low,
                                                   .high = o->high,
                                                   .theory = o->theory};
}

static const struct hk_column order_columns[] = {
    HOOKE_COLUMN(struct order_line, method, TEXT, "", "method"),
    HOOKE_COLUMN(
        struct order_line, order, NUMBER, "",
        "slope of log error over log step by least squares, over the finest rows clear of the floor; NaN "
        "with fewer than three of them, and for an error-controlled method"),
    HOOKE_COLUMN(
        struct order_line, low, NUMBER, "",
        "lower end of the 95 % confidence interval of that slope, as if errors scattered about a line by "
        "chance"),
    HOOKE_COLUMN(struct order_line, high, NUMBER, "", "upper end of that interval"),
    HOOKE_COLUMN(struct order_line, theory, NUMBER, "", "the method's order"),
    HOOKE_COLUMN(struct order_line, note, TEXT, "", "why they may differ"),
};

static const struct hk_table order_table = {
    .name = "orders",
    .doc = "the order that each method showed",
    HOOKE_TABLE_COLUMNS(order_columns, struct order_line),
    .count = count_orders,
    .read = read_order,
};

/* ---- the recommendation ---- */

struct recommendation_line {
  const char *method, *note;
  double met, want, step, rtol, atol, error, until, wall_seconds, wall_median, force_evaluations;
};

static void read_recommendation(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_study_recommendation *r = &study->recommendation;
  const int adaptive = r->method >= 0 && hk_study_is_adaptive(study, r->method);
  (void)row;
  *(struct recommendation_line *)line = (struct recommendation_line){
      .method = r->method >= 0 ? study->method[r->method] : NULL,
      .note = r->note,
      .met = (double)r->met,
      .want = r->want,
      .step = adaptive ? NAN : r->value,
      .rtol = adaptive ? r->value : NAN,
      .atol = adaptive ? r->atol : NAN,
      .error = r->error,
      .until = r->until,
      .wall_seconds = r->wall_seconds,
      .wall_median = r->wall_median,
      .force_evaluations = r->force_evaluations,
  };
}

static const struct hk_column recommendation_columns[] = {
    HOOKE_COLUMN(struct recommendation_line, want, NUMBER, "m",
                 "the wanted error, a distance that no free particle exceeds"),
    HOOKE_COLUMN(struct recommendation_line, method, TEXT, "",
                 "method of the cheapest run that meets the wanted error, else of the closest run"),
    HOOKE_COLUMN(struct recommendation_line, step, NUMBER, "s", "its step"),
    HOOKE_COLUMN(struct recommendation_line, rtol, NUMBER, "", "its relative tolerance"),
    HOOKE_COLUMN(struct recommendation_line, error, NUMBER, "m",
                 "its error: the largest distance of any free particle"),
    HOOKE_COLUMN(struct recommendation_line, until, NUMBER, "s",
                 "time up to which that holds; before the end where nobody knows the motion that long"),
    HOOKE_COLUMN(struct recommendation_line, wall_seconds, NUMBER, "s",
                 "its wall time, the least of several"),
    HOOKE_COLUMN(struct recommendation_line, wall_median, NUMBER, "s", "their median"),
    HOOKE_COLUMN(struct recommendation_line, met, FLAG, "", "a run was seen to have at most that error"),
    HOOKE_COLUMN(
        struct recommendation_line, note, TEXT, "",
        "what is in the way where nothing meets it; else empty, or that this machine's times would reverse "
        "the choice, which is by counted work"),
    HOOKE_COLUMN(struct recommendation_line, atol, NUMBER, "m", "its absolute tolerance of positions"),
    HOOKE_COLUMN(struct recommendation_line, force_evaluations, COUNT, "", "its evaluations of the forces"),
};

static const struct hk_table recommendation_table = {
    .name = "recommendation",
    .doc = "which run to make for the wanted error",
    .record = 1,
    HOOKE_TABLE_COLUMNS(recommendation_columns, struct recommendation_line),
    HOOKE_TABLE_COUNT(struct hk_study, recommendation.made),
    .read = read_recommendation,
};

/* ---- its margin ---- */

struct margin_line {
  double error_low, error_high, limit_share, holds_stiffness, error_stiffness, holds_start, error_start;
};

static void read_margin(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_study_recommendation *r = &study->recommendation;
  const double agreement = study->reference.agreement;
  (void)row;
  *(struct margin_line *)line = (struct margin_line){
      .error_low = isnan(r->error) ? NAN : fmax(0.0, r->error - agreement),
      .error_high = r->error + agreement,
      .limit_share = r->margin.limit_share,
      .holds_stiffness = r->margin.holds[HOOKE_STUDY_STIFFNESS],
      .error_stiffness = r->margin.error[HOOKE_STUDY_STIFFNESS],
      .holds_start = r->margin.holds[HOOKE_STUDY_START],
      .error_start = r->margin.error[HOOKE_STUDY_START],
  };
}

static const struct hk_column margin_columns[] = {
    HOOKE_COLUMN(struct margin_line, error_low, NUMBER, "m", "error less the agreement of the reference"),
    HOOKE_COLUMN(struct margin_line, error_high, NUMBER, "m", "error plus the agreement of the reference"),
    HOOKE_COLUMN(struct margin_line, limit_share, NUMBER, "",
                 "its step over the largest stable one at the start"),
    HOOKE_COLUMN(struct margin_line, holds_stiffness, FLAG, "",
                 "the wanted error is met with 10 % more stiffness, and with 10 % less"),
    HOOKE_COLUMN(struct margin_line, error_stiffness, NUMBER, "m", "the larger error of those two"),
    HOOKE_COLUMN(
        struct margin_line, holds_start, FLAG, "",
        "the wanted error is met with 10 % of the largest speed added along (1, 1, 1) at the start, and "
        "against it"),
    HOOKE_COLUMN(struct margin_line, error_start, NUMBER, "m", "the larger error of those two"),
};

static const struct hk_table margin_table = {
    .name = "margin",
    .doc = "what the recommendation has to spare",
    .group = "recommendation",
    .record = 1,
    HOOKE_TABLE_COLUMNS(margin_columns, struct margin_line),
    HOOKE_TABLE_COUNT(struct hk_study, recommendation.made),
    .read = read_margin,
};

/* ---- the list ---- */

const struct hk_table *const hk_study_tables[HOOKE_STUDY_TABLES] = {&study_table,
                                                                    &reference_table,
                                                                    &row_table,
                                                                    &order_table,
                                                                    &recommendation_table,
                                                                    &margin_table,
                                                                    &hk_study_watched_table,
                                                                    &hk_study_error_table,
                                                                    &hk_study_ensemble_table,
                                                                    &hk_study_statistic_table};
