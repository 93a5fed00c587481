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

/* ---- the reference ---- */

static const char *how_it_ended(const struct hk_study *study) {
  const struct hk_reference *r = &study->reference;
  if (r->trusted == r->frames.count && !r->coarse) return "agreed";
  if (r->hurried || study->once) return r->hurried ? "time" : "parted";
  return hk_reference_is_halved(r) ? "finest" : "rounding";
}

HOOKE_READER(const void *, find_reference, struct hk_study, is_made(it) ? &it->reference : NULL)
HOOKE_READER(const char *, ended, struct hk_study, how_it_ended(it))
HOOKE_READER(double, trusted_until, struct hk_study, hk_study_trusted_until(it))
HOOKE_READER(double, checked_until, struct hk_study,
             hk_reference_time(&it->reference, it->reference.checked, it->duration))
HOOKE_COUNTER(trusted, struct hk_study, it->reference.trusted)

/* ---- rows ---- */

int32_t hk_study_is_near_floor(const struct hk_study *study, const struct hk_study_row *row) {
  return row->trial.error <= NEAR * fmax(study->reference.agreement, row->trial.rounding);
}

HOOKE_READER(const char *, row_method, struct hk_study, it->method[it->row[row].method])
HOOKE_READER(double, near_floor, struct hk_study, hk_study_is_near_floor(it, &it->row[row]))
HOOKE_READER(double, near_energy_floor, struct hk_study,
             it->row[row].trial.energy_drift <= NEAR * it->reference.energy_agreement)

/* ---- orders ---- */

HOOKE_READER(const char *, order_method, struct hk_study, it->method[row])
HOOKE_COUNTER(count_orders, struct hk_study, is_made(it) ? it->method_count : 0)

/* ---- the recommendation ---- */

/* The value of a row, if its method takes its steps from a tolerance (`adaptive` 1) or not (0); else NaN. The
 * method -1 is that of the reference. */
static double setting(const struct hk_study *study, int32_t method, double value, int32_t adaptive) {
  const char *name = method < 0 ? study->reference.method : study->method[method];
  return adaptive == hooke_method_is_adaptive(name) ? value : NAN;
}

HOOKE_READER(const char *, recommended_method, struct hk_study,
             it->recommendation.method < 0 ? NULL : it->method[it->recommendation.method])
HOOKE_READER(double, recommended_step, struct hk_study,
             setting(it, it->recommendation.method, it->recommendation.value, 0))
HOOKE_READER(double, recommended_rtol, struct hk_study,
             setting(it, it->recommendation.method, it->recommendation.value, 1))

double hk_study_trusted_until(const struct hk_study *study) {
  return hk_reference_time(&study->reference, study->reference.trusted, study->duration);
}

int32_t hk_study_recommends(const struct hk_study *study) {
  const struct hk_study_recommendation *r = &study->recommendation;
  return r->made && (r->met || study->m->outcome != HOOKE_STOPPED);
}

int32_t hk_study_knows_met(const struct hk_study *study) {
  const int32_t held = study->recommendation.met || !(hk_study_trusted_until(study) > 0.0);
  return !held || hk_study_trusted_until(study) >= study->duration * (1.0 - 1e-9);
}

HOOKE_COUNTER(count_recommendations, struct hk_study, hk_study_recommends(it))
HOOKE_COUNTER(count_found, struct hk_study,
              hk_study_recommends(it) && it->recommendation.method >= 0 ? it->wants.count : 0)
HOOKE_READER(const char *, command, struct hk_study,
             it->recommendation.met ? it->m->label[HOOKE_LABEL_COMMAND] : NULL)

/* ---- its margin ---- */

/* fmax() would take an unknown number for 0. */
double hk_study_least_error(const struct hk_study *study) {
  const double least = study->recommendation.error - study->reference.wanted_agreement;
  return isnan(study->recommendation.error) ? NAN : fmax(0.0, least);
}

HOOKE_READER(double, error_low, struct hk_study, hk_study_least_error(it))
HOOKE_READER(const char *, unit_of_errors, struct hk_study, it->wants.list ? "wants" : "m")
HOOKE_READER(double, error_high, struct hk_study, it->recommendation.error + it->reference.wanted_agreement)

/* ---- watched quantities ---- */

HOOKE_COUNTER(count_watched, struct hk_study, it->reference.frames.watched.list ? it->watched.count : 0)
HOOKE_READER(const char *, watched_unit, struct hk_study, hk_watched_unit(&it->watched.item[row]))
HOOKE_READER(double, reference_end, struct hk_study,
             hk_watched_series_last(&it->reference.frames.watched, row, it->reference.trusted,
                                    it->reference.frames.time))
HOOKE_READER(double, agreement, struct hk_study, it->reference.frames.watched.figure[row])
HOOKE_READER(const double *, watched_value, struct hk_study,
             hk_watched_series_of(&it->reference.frames.watched, row))

/* ---- their errors ---- */

static const struct hk_watched_series *series_of(const struct hk_study *study, int64_t row) {
  return &study->row[row / count_watched(study)].trial.watched;
}

HOOKE_COUNTER(count_errors, struct hk_study, it->row_count *count_watched(it))
HOOKE_READER(double, row_number, struct hk_study, (double)(row / count_watched(it)))
HOOKE_READER(const char *, error_quantity, struct hk_study, it->watched.item[row % count_watched(it)].text)
HOOKE_READER(const char *, error_unit, struct hk_study,
             hk_watched_unit(&it->watched.item[row % count_watched(it)]))
HOOKE_READER(double, row_end, struct hk_study,
             hk_watched_series_last(series_of(it, row), row % count_watched(it), it->reference.trusted,
                                    it->reference.frames.time))
HOOKE_READER(double, error, struct hk_study, series_of(it, row)->figure[row % count_watched(it)])
HOOKE_READER(const double *, error_value, struct hk_study,
             hk_watched_series_of(series_of(it, row), row % count_watched(it)))

/* ---- the ensemble ---- */

HOOKE_READER(double, seed, struct hk_study, hooke_options_number(it->m->options, "seed"))
HOOKE_COUNTER(count_ensembles, struct hk_study, it->ensemble != NULL)

/* ---- statistics ---- */

HOOKE_COUNTER(count_quantities, struct hk_study, it->ensemble ? it->ensemble->quantities.count : 0)
HOOKE_COUNTER(count_statistics, struct hk_study,
              it->ensemble ? it->ensemble->source_count * it->ensemble->quantities.count : 0)

static const struct hk_ensemble_source *source_of(const struct hk_study *study, int64_t row) {
  return &study->ensemble->source[row / count_quantities(study)];
}

static const struct hk_watched *quantity_of(const struct hk_study *study, int64_t row) {
  return &study->ensemble->quantities.item[row % count_quantities(study)];
}

static const struct hk_statistic *statistic_of(const struct hk_study *study, int64_t row) {
  return &source_of(study, row)->statistic[row % count_quantities(study)];
}

static double mean_of(const struct hk_study *study, int64_t row) {
  const struct hk_statistic *own = statistic_of(study, row);
  return source_of(study, row)->failed || own->members == 0 ? NAN : own->mean;
}

/* Standard deviation. */
static double spread_of(const struct hk_study *study, int64_t row) {
  const struct hk_statistic *own = statistic_of(study, row);
  if (source_of(study, row)->failed || own->members < 2) return NAN;
  return sqrt(own->squares / (double)(own->members - 1));
}

/* Difference of the mean from the reference's, in standard errors of that difference. */
static double bias_of(const struct hk_study *study, int64_t row) {
  const int64_t other = row % count_quantities(study);
  const double spread = spread_of(study, row), others = spread_of(study, other);
  const double variance = spread * spread / (double)statistic_of(study, row)->members +
                          others * others / (double)statistic_of(study, other)->members;
  const double difference = mean_of(study, row) - mean_of(study, other);
  if (row == other) return NAN;
  return difference == 0.0 && variance == 0.0 ? 0.0 : difference / sqrt(variance);
}

static double setting_of(const struct hk_study *study, int64_t row, int32_t adaptive) {
  const struct hk_ensemble_source *source = source_of(study, row);
  return setting(study, source->method, source->value, adaptive);
}

static const char *method_of(const struct hk_study *study, int64_t row) {
  const int32_t method = source_of(study, row)->method;
  return method < 0 ? "reference" : study->method[method];
}

HOOKE_READER(const void *, find_source, struct hk_study, source_of(it, row))
HOOKE_READER(const char *, statistic_method, struct hk_study, method_of(it, row))
HOOKE_READER(const char *, statistic_quantity, struct hk_study, quantity_of(it, row)->text)
HOOKE_READER(const char *, statistic_unit, struct hk_study, hk_watched_unit(quantity_of(it, row)))
HOOKE_READER(double, statistic_step, struct hk_study, setting_of(it, row, 0))
HOOKE_READER(double, statistic_rtol, struct hk_study, setting_of(it, row, 1))
HOOKE_READER(double, statistic_members, struct hk_study, (double)statistic_of(it, row)->members)
HOOKE_READER(double, mean, struct hk_study, mean_of(it, row))
HOOKE_READER(double, spread, struct hk_study, spread_of(it, row))
HOOKE_READER(double, bias, struct hk_study, bias_of(it, row))

/* ---- the tables ---- */

/* A column of a row's trial. */
#define OF_TRIAL(member, kind, units, text)                                                                  \
  HOOKE_COLUMN_AS(struct hk_study_row, trial.member, member, kind, units, text)

const struct hk_table hk_study_tables[] = {
    {.name = "study",
     .doc = "the study itself",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_study, duration, NUMBER, "s", "duration of the run"),
         HOOKE_COLUMN_BY(frames, COUNT, "", "frames over which errors are judged"),
         HOOKE_COLUMN(struct hk_study, budget_spent, FLAG, "", "rows are missing for lack of time"))},
    {.name = "reference",
     .doc = "the solution that errors are measured against, made by two runs that check each other",
     .record = 1,
     .lists = {{"methods", "method", "check"}},
     .row = find_reference,
     .length = trusted,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(
             struct hk_reference, agreement, NUMBER, "m",
             "twice the largest distance of a particle between the two over the frames that are trusted, "
             "and of what rounding may do to one; no error below it means anything, and none within ten "
             "times of it much; NaN if no frame after the start is trusted"),
         HOOKE_COLUMN_BY(
             trusted_until, NUMBER, "s",
             "time up to which the two agree to the wanted digits; errors are judged up to there"),
         HOOKE_COLUMN(struct hk_reference, growth, NUMBER, "",
                      "factor by which a small displacement of the start grows at most, with "
                      "growth_probability; NaN where that is not known"),
         HOOKE_COLUMN(struct hk_reference, growth_probability, NUMBER, "", "probability that growth holds"),
         HOOKE_COLUMN(struct hk_reference, growth_seen, NUMBER, "",
                      "the largest growth of the displacements tried"),
         HOOKE_COLUMN(struct hk_reference, displacements, COUNT, "", "displacements tried"),
         HOOKE_COLUMN(struct hk_reference, energy_agreement, NUMBER, "J",
                      "twice the largest difference of their energies there"),
         HOOKE_COLUMN_BY(
             ended, TEXT, "",
             "why they were tightened no further: agreed, time (the budget was short), rounding (it keeps "
             "them apart at the tightest tolerances), finest (of rk4, whose steps are halved no further), or parted "
             "(which ends a first look)"),
         HOOKE_COLUMN(struct hk_reference, method, TEXT, "", "integrator that made the reference"),
         HOOKE_COLUMN(
             struct hk_reference, check, TEXT, "",
             "integrator that checked it; they share only the forces, or both are rk4, in whole and half "
             "steps, where the build has no other"),
         HOOKE_COLUMN_BY(checked_until, NUMBER, "s",
                         "time up to which the two were compared; before the end where the budget was spent"),
         HOOKE_COLUMN_AS(struct hk_reference, frames.zero_passages, zero_passages, TEXT, "",
                         "of springs that passed through length zero in it; empty where none did"),
         HOOKE_COLUMN_AS(struct hk_reference, frames.time, time, SERIES, "s",
                         "times of the frames that are judged"))},
    {.name = "rows",
     .doc = "a method with one step or tolerance each, the coarsest first",
     HOOKE_TABLE_ROWS(struct hk_study, row, row_count),
     .length = trusted,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY_AS(row_method, method, TEXT, "", "method"),
         OF_TRIAL(step, NUMBER, "s", "step of a fixed-step method"),
         OF_TRIAL(rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
         OF_TRIAL(
             error, NUMBER, "m",
             "largest root mean square over the free particles of the distance to the reference; no error "
             "is below what rounding may do to a position in the steps taken, half a unit in its last "
             "place in each; NaN where nothing after the start is judged"),
         OF_TRIAL(error_max, NUMBER, "m",
                  "largest distance of any free particle, which a wanted error is held against"),
         OF_TRIAL(error_final, NUMBER, "m", "root mean square distance at the last judged frame"),
         OF_TRIAL(energy_drift, NUMBER, "J", "largest difference of energy from the reference"),
         OF_TRIAL(force_evaluations, COUNT, "", "evaluations of the forces"),
         OF_TRIAL(steps, COUNT, "", "steps taken"),
         OF_TRIAL(wall_seconds, NUMBER, "s", "wall time, the least of the repeated runs"),
         OF_TRIAL(status, TEXT, "", "finished, diverged, stopped or failed"),
         OF_TRIAL(atol, NUMBER, "m", "absolute tolerance of positions"),
         OF_TRIAL(linear_iterations, COUNT, "", "iterations of linear solvers"),
         HOOKE_COLUMN(struct hk_study_row, wall_median, NUMBER, "s", "median of the repeated runs"),
         HOOKE_COLUMN(struct hk_study_row, repeats, COUNT, "", "runs that were timed"),
         HOOKE_COLUMN_BY(near_floor, FLAG, "",
                         "the error is within ten times of the agreement, or of what rounding may do"),
         HOOKE_COLUMN_BY(near_energy_floor, FLAG, "",
                         "the energy drift is within ten times of the agreement of energies"),
         HOOKE_COLUMN(struct hk_study_row, error_step, NUMBER, "m",
                      "root mean square error of one step from the reference's state at two fifths of the "
                      "run; NaN where that is not known or rounding hides it"),
         HOOKE_COLUMN(struct hk_study_row, timed_alone, FLAG, "",
                      "0: timed while other rows were running, so its time may be too long"),
         OF_TRIAL(error_at, SERIES, "m", "root mean square distance at every frame"),
         OF_TRIAL(error_max_at, SERIES, "m", "largest distance of any free particle at every frame"),
         HOOKE_COLUMN_AS(struct hk_study_row, trial.drift_at, energy_drift_at, SERIES, "J",
                         "energy less that of the reference at every frame"))},
    {.name = "orders",
     .doc = "the order that each method showed",
     .by = "method",
     .count = count_orders,
     HOOKE_TABLE_AT(struct hk_study, order),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY_AS(order_method, method, TEXT, "", "method"),
         HOOKE_COLUMN(
             struct hk_study_order, order, NUMBER, "",
             "slope of log error over log step by least squares, over the finest rows clear of the floor; "
             "NaN with fewer than three of them, and for an error-controlled method"),
         HOOKE_COLUMN(struct hk_study_order, low, NUMBER, "",
                      "lower end of the 95 % confidence interval of that slope, as if errors scattered "
                      "about a line by chance"),
         HOOKE_COLUMN(struct hk_study_order, high, NUMBER, "", "upper end of that interval"),
         HOOKE_COLUMN(struct hk_study_order, theory, NUMBER, "", "the method's order"),
         HOOKE_COLUMN(struct hk_study_order, note, TEXT, "", "why they may differ"),
         HOOKE_COLUMN(
             struct hk_study_order, order_step, NUMBER, "",
             "the slope likewise of the error of one step, over the finest three rows that have it, which "
             "is one more than the order"))},
    {.name = "recommendation",
     .doc = "which run to make for the wanted error",
     .record = 1,
     .count = count_recommendations,
     HOOKE_TABLE_IN(struct hk_study, recommendation),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(
             struct hk_study_recommendation, want, NUMBER, "m",
             "the wanted error, a distance that no free particle exceeds; of a list 1, and errors are parts of it"),
         HOOKE_COLUMN_BY_AS(unit_of_errors, error_unit, TEXT, "",
                            "unit of errors: m, or \"wants\": they are parts of what a list wants"),
         HOOKE_COLUMN_BY_AS(
             recommended_method, method, TEXT, "",
             "method of the cheapest run that meets the wanted error, else of the closest run"),
         HOOKE_COLUMN_BY_AS(recommended_step, step, NUMBER, "s", "its step"),
         HOOKE_COLUMN_BY_AS(recommended_rtol, rtol, NUMBER, "", "its relative tolerance"),
         HOOKE_COLUMN(struct hk_study_recommendation, error, NUMBER, "m",
                      "its error: the largest distance of any free particle, or what a list is held against"),
         HOOKE_COLUMN(struct hk_study_recommendation, until, NUMBER, "s",
                      "time up to which that holds; before the end where nobody knows the motion that long"),
         HOOKE_COLUMN(struct hk_study_recommendation, wall_seconds, NUMBER, "s",
                      "its wall time, the least of several"),
         HOOKE_COLUMN(struct hk_study_recommendation, wall_median, NUMBER, "s", "their median"),
         HOOKE_COLUMN(struct hk_study_recommendation, met, FLAG, "",
                      "a run was seen to have at most that error"),
         HOOKE_COLUMN(
             struct hk_study_recommendation, note, TEXT, "",
             "what is in the way where nothing meets it; else empty, or that this machine's times would "
             "reverse the choice, which is by counted work"),
         HOOKE_COLUMN(struct hk_study_recommendation, atol, NUMBER, "m",
                      "its absolute tolerance of positions"),
         HOOKE_COLUMN(struct hk_study_recommendation, atol_velocity, NUMBER, "m/s",
                      "its absolute tolerance of velocities"),
         HOOKE_COLUMN(struct hk_study_recommendation, force_evaluations, COUNT, "",
                      "its evaluations of the forces"),
         HOOKE_COLUMN_BY(command, TEXT, "", "its command line, where the caller gave one as a label"))},
    {.name = "margin",
     .doc = "what the recommendation has to spare",
     .group = "recommendation",
     .inside = "recommendation",
     .record = 1,
     .count = count_recommendations,
     HOOKE_TABLE_IN(struct hk_study, recommendation.margin),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(error_low, NUMBER, "m", "error less the agreement of the reference"),
         HOOKE_COLUMN_BY(error_high, NUMBER, "m", "error plus the agreement of the reference"),
         HOOKE_COLUMN(struct hk_study_margin, limit_share, NUMBER, "",
                      "its step over the largest stable one at the start"),
         HOOKE_COLUMN_AS(struct hk_study_margin, holds[HOOKE_STUDY_STIFFNESS], holds_stiffness, FLAG, "",
                         "the wanted error is met with 10 % more stiffness, and with 10 % less"),
         HOOKE_COLUMN_AS(struct hk_study_margin, error[HOOKE_STUDY_STIFFNESS], error_stiffness, NUMBER, "m",
                         "the larger error of those two"),
         HOOKE_COLUMN_AS(struct hk_study_margin, holds[HOOKE_STUDY_START], holds_start, FLAG, "",
                         "the wanted error is met with 10 % of the largest speed added along (1, 1, 1) at "
                         "the start, and against it"),
         HOOKE_COLUMN_AS(struct hk_study_margin, error[HOOKE_STUDY_START], error_start, NUMBER, "m",
                         "the larger error of those two"))},
    {.name = "watched",
     .inside = "reference",
     .doc = "the watched quantities",
     .count = count_watched,
     HOOKE_TABLE_AT(struct hk_study, watched.item),
     .length = trusted,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(struct hk_watched, text, quantity, TEXT, "", "quantity, as it was written"),
         HOOKE_COLUMN_BY_AS(watched_unit, unit, TEXT, "", "its unit"),
         HOOKE_COLUMN_BY(reference_end, NUMBER, "of the quantity",
                         "the reference's value at the last trusted frame; of a period that until then"),
         HOOKE_COLUMN_BY(agreement, NUMBER, "of the quantity",
                         "twice the largest difference in it between the two runs of the "
                         "reference, the floor of its errors"),
         HOOKE_COLUMN_BY_AS(
             watched_value,
             value, SERIES,
             "of the quantity",
             "the reference's values at every frame; of a period those of the quantity that it is of"))},
    {.name = "watched_errors",
     .group = "watched",
     .inside = "rows",
     .key = "watched",
     .doc = "the error of every row in every watched quantity",
     .count = count_errors,
     .inner = count_watched,
     .length = trusted,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_ALONG(OUTER, row_number, row, COUNT, "", "row of the table \"rows\""),
         HOOKE_COLUMN_ALONG(INNER, error_unit, unit, TEXT, "", "unit of the quantity"),
         HOOKE_COLUMN_ALONG(INNER, error_quantity, quantity, TEXT, "", "watched quantity"),
         HOOKE_COLUMN_BY_AS(row_end, at_end, NUMBER, "of the quantity",
                            "its value at the last trusted frame; of a period that until then"),
         HOOKE_COLUMN_BY(error, NUMBER, "of the quantity",
                         "the largest difference from the reference over the frames that are trusted; of "
                         "a period that of the two periods over these, NaN with fewer than two passages "
                         "or four frames a period"),
         HOOKE_COLUMN_BY_AS(error_value, value, SERIES, "of the quantity", "its values at every frame"))},
    {.name = "ensemble",
     .group = "statistics",
     .key = "statistics",
     .doc = "the displaced runs that statistics are of, for motion that cannot be judged to the end",
     .record = 1,
     .count = count_ensembles,
     HOOKE_TABLE_AT(struct hk_study, ensemble),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_ensemble, members, COUNT, "", "displaced runs of each method"),
         HOOKE_COLUMN(struct hk_ensemble, from, NUMBER, "s", "begin of the means over time"),
         HOOKE_COLUMN(struct hk_ensemble, until, NUMBER, "s", "end of the means over time"),
         HOOKE_COLUMN(struct hk_ensemble, noise, NUMBER, "m",
                      "root mean square displacement of a free particle at the start"),
         HOOKE_COLUMN_BY(seed, COUNT, "", "seed of the noise"))},
    {.name = "statistics",
     .inside = "ensemble",
     .key = "quantities",
     .doc = "means and spreads of an ensemble, by quantity and method",
     .count = count_statistics,
     .inner = count_quantities,
     .row = find_source,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_ALONG(OUTER, statistic_method, method, TEXT, "", "method, the reference first"),
         HOOKE_COLUMN_ALONG(INNER, statistic_quantity, quantity, TEXT, "",
                            "kinetic, potential, energy, and what is watched"),
         HOOKE_COLUMN_ALONG(INNER, statistic_unit, unit, TEXT, "", "unit of the quantity"),
         HOOKE_COLUMN_BY_AS(statistic_step, step, NUMBER, "s", "step of the runs"),
         HOOKE_COLUMN_BY_AS(statistic_rtol, rtol, NUMBER, "", "relative tolerance of the runs"),
         HOOKE_COLUMN_BY_AS(statistic_members, members, COUNT, "", "runs that have the quantity"),
         HOOKE_COLUMN(struct hk_ensemble_source, failed, COUNT, "",
                      "runs that did not come to their end; a method that has one has no statistics"),
         HOOKE_COLUMN_BY(mean, NUMBER, "of the quantity", "mean over the runs of each run's mean over time"),
         HOOKE_COLUMN_BY(spread, NUMBER, "of the quantity", "standard deviation of the runs"),
         HOOKE_COLUMN_BY(bias, NUMBER, "",
                         "the mean less the reference's, in standard errors of that difference; below 2 "
                         "in size none is seen"))},
    {HOOKE_WANTS_TABLE, .count = count_found, HOOKE_TABLE_AT(struct hk_study, recommendation.found)},
    {.name = NULL}};
