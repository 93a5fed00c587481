/* The trade of error against cost: each method over a ladder of steps or tolerances, against a reference that
 * checks itself. */
#pragma once

#include "measure/measurement.h"
#include "measure/trial/method_list.h"
#include "measure/trial/reference.h"

/* Approximate ends of the reference, of the rows and of the search in the time of all. */
#define HOOKE_STUDY_REFERENCE 0.4
#define HOOKE_STUDY_ROWS      0.9
#define HOOKE_STUDY_SEARCH    0.95

enum { HOOKE_STUDY_METHODS = HOOKE_LISTED_METHODS };

/* A method with one step or tolerance. */
struct hk_study_row {
  int32_t method; /* index into the study's methods */
  double value;   /* step [s] or rtol */
  struct hk_trial trial;
  double error_step; /* of one step from a state within the reference [m]; NaN: not known */
  double wall_median;
  int32_t repeats;
  int32_t timed_alone; /* 0: timed while other rows were running */
};

struct hk_study_order {
  double order, low, high, theory, order_step;
  char note[512];
};

/* The margin of a recommendation. */
enum hk_study_change { HOOKE_STUDY_STIFFNESS, HOOKE_STUDY_START, HOOKE_STUDY_CHANGES };
struct hk_study_margin {
  /* step over the largest stable one, predicted at the start; NaN: error-controlled, or unknown */
  double limit_share;
  /* largest error with the change; NaN: unknown, or a run did not finish */
  double error[HOOKE_STUDY_CHANGES];
  double holds[HOOKE_STUDY_CHANGES]; /* 1: the wanted error is met with the change; 0: not; NaN: unknown */
};

struct hk_study_recommendation {
  int32_t made, met;
  int32_t method;
  double want, value, atol, atol_velocity, wall_seconds, wall_median, force_evaluations;
  double error; /* that the want is held against, */
  double until; /* up to this time after the start [s] */
  struct hk_study_margin margin;
  struct hk_want_found found[HOOKE_WANTS];
  char note[512];
};

/* Over the members that have a quantity: their number, mean, and sum of squares about it. */
struct hk_statistic {
  int64_t members;
  double mean, squares;
};

/* A source of motion for all members: the method of the reference, or a method of the study with one step or
 * tolerance. */
struct hk_ensemble_source {
  int32_t method; /* of the study; -1: the reference */
  double value;   /* step or rtol */
  int64_t failed;
  uint64_t seed;
  struct hk_statistic *statistic; /* of each quantity */
};

struct hk_ensemble {
  struct hk_watched_list quantities; /* kinetic, potential, energy, and the watched quantities */
  int64_t members;                   /* of each source */
  double noise;                      /* root mean square displacement of a free particle at the start [m] */
  double from, until;                /* of the means over time [s] */
  int64_t source_count;
  struct hk_ensemble_source *source; /* the reference first */
};

struct hk_study {
  const hooke_measurement *m;
  int32_t method_count;
  const char *method[HOOKE_STUDY_METHODS];
  struct hk_study_order order[HOOKE_STUDY_METHODS];

  double duration, every;
  int32_t once; /* 1: each method with the run's own step or tolerances, and no ladders */
  double unit;  /* largest step of which duration and every are whole multiples [s] */
  struct hk_reference reference;
  int64_t row_count;
  struct hk_study_row *row;
  struct hk_study_recommendation recommendation;
  struct hk_watched_list watched; /* and what is wanted */
  struct hk_wants wants;
  struct hk_ensemble *ensemble; /* NULL: none was computed */

  double
      safe_step[HOOKE_STUDY_METHODS]; /* start of a method's ladder; error-controlled methods have none [s] */

  struct hk_stage stage;
  double begun;                          /* clock at the start [s] */
  double budget;                         /* from the start [s]; infinity for none */
  double deadline;                       /* clock at which rows end [s] */
  int32_t given_up[HOOKE_STUDY_METHODS]; /* 1: its next row takes too long for the budget */
  int32_t cut[HOOKE_STUDY_METHODS];      /* 1: its next row cannot be what the study recommends */
  int32_t late;                          /* a row met its deadline */
  int32_t budget_spent;
};

/* 1 if the method takes its steps from a tolerance. */
int32_t hk_study_is_adaptive(const struct hk_study *study, int32_t method);

/* The k-th value of a method's ladder, the coarsest first: a step, or a tolerance; NaN past the last. */
double hk_study_ladder(const struct hk_study *study, int32_t method, int32_t k);
/* Finds the safe step of each method. */
int32_t hk_study_find_safe_steps(struct hk_study *study);
/* The option by which the caller has chosen the values of ladders; NULL: none. */
const char *hk_study_chosen_ladder(const struct hk_study *study);
/* Finds `unit` and checks the caller's ladders. */
int32_t hk_study_check_ladder(struct hk_study *study);

/* Progress of the current part, which ends a run at the deadline and marks the study, its context, as late.
 */
int32_t hk_study_tell_row(double fraction, void *ctx);

/* ---- rows ---- */

/* Options of the run of a row; the caller destroys them in either case. */
int32_t hk_study_row_options(const struct hk_study *study, int32_t method, double value, hooke_options **out);
/* The same by number, or those of the reference (-1). */
int32_t hk_study_run_options(const struct hk_study *study, int64_t row, hooke_options **out);
/* One value of a method: run for its error and repeated for its time; the row's trial must be released. A row
 * that the deadline ended has no status, and the study is marked as late. */
int32_t hk_study_measure(struct hk_study *study, int32_t method, double value, struct hk_study_row *row);

/* Runs all rows, level by level, until the deadline. */
int32_t hk_study_run_ladders(struct hk_study *study);

/* Finds the recommendation, until the deadline. */
int32_t hk_study_find_cheapest(struct hk_study *study, double want);

/* Time up to which errors are known [s]; NaN without a reference. */
double hk_study_trusted_until(const struct hk_study *study);
/* The error of the recommendation less what the reference is known to, 0 at least; NaN if not known. */
double hk_study_least_error(const struct hk_study *study);
/* 1 if there is a recommendation: a run that meets the want or, in a complete study, the closest one. */
int32_t hk_study_recommends(const struct hk_study *study);
/* 1 unless the want is met as far as errors are known, and they are not known to the end. */
int32_t hk_study_knows_met(const struct hk_study *study);
/* 1 if the error of a row is within ten times of what the reference is known to, or of its rounding. */
int32_t hk_study_is_near_floor(const struct hk_study *study, const struct hk_study_row *row);

/* Least-squares fit of log error against log step for a method (order.c). */
void hk_study_fit_order(struct hk_study *study, int32_t method);

/* ---- the ensemble (ensemble.c) ---- */

/* Runs the members of a study whose rows are complete, of all sources in turn, until all are done or the
 * deadline is reached. Does nothing if no ensemble is requested, or if the reference is trusted to the end.
 */
int32_t hk_ensemble_run(struct hk_study *study);
void hk_ensemble_release(struct hk_ensemble *ensemble);

/* ---- tables ---- */

extern const struct hk_table hk_study_tables[];

/* What it says of its results (study_claims.c). */
void hk_study_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_measurement_kind hk_study_kind;
