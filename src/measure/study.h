/* What a study holds. */
#ifndef HOOKE_MEASURE_STUDY_H
#define HOOKE_MEASURE_STUDY_H

#include "hooke/study.h"
#include "measure/reference.h"

enum { HOOKE_STUDY_METHODS = 32 };

/* A method with one step or tolerance. */
struct hooke_study_row {
  int32_t method; /* index into the study's methods */
  double value;   /* step [s] or rtol */
  struct hooke_trial trial;
  double wall_median;
  int32_t repeats;
  int32_t timed_alone; /* 0: other rows ran beside it */
};

struct hooke_study_order {
  double order, low, high, theory;
  char note[256];
};

struct hooke_study_recommendation {
  int32_t made, met;
  int32_t method;
  double want, value, atol, error, wall_seconds, force_evaluations;
  char note[512];
};

struct hooke_study {
  const hooke_system *system;
  hooke_options *run, *options;
  int32_t method_count;
  const char *method[HOOKE_STUDY_METHODS];
  struct hooke_study_order order[HOOKE_STUDY_METHODS];

  double duration, every;
  double unit; /* the largest step of which duration and every are whole multiples [s] */
  struct hooke_reference reference;
  int64_t row_count, row_capacity;
  struct hooke_study_row *row;
  struct hooke_study_recommendation recommendation;

  hooke_progress *progress;
  void *progress_ctx;
  double begun, budget; /* clock at the start, and seconds from there [s] */
  int32_t budget_spent;
  double work_ahead; /* wall seconds of the rows to come, for progress */
  const char *under_way;
};

/* 1 if the method takes its steps from a tolerance. */
int32_t hooke_study_is_adaptive(const hooke_study *study, int32_t method);

/* The k-th value of a method's ladder, the coarsest first: a step, or a tolerance; NaN past the last. */
double hooke_study_ladder(const hooke_study *study, int32_t method, int32_t k);
/* The step nearest to `step` that frames and duration are whole multiples of. */
double hooke_study_fitting_step(const hooke_study *study, double step);
/* Finds `unit` and checks the ladders that the caller gave. */
int32_t hooke_study_check_ladder(hooke_study *study);

/* A listener's word to the caller's progress; the context is the study. */
int32_t hooke_study_tell(double share, void *ctx);

/* One value of a method: run once for its error; then, if that was short, repeated for its time; or both. The row's trial
 * must be released. Only the first may be called from several threads at a time. */
int32_t hooke_study_run_row(const hooke_study *study, int32_t method, double value,
                            const struct hooke_listener *listener, struct hooke_study_row *row);
int32_t hooke_study_time_row(hooke_study *study, struct hooke_study_row *row);
int32_t hooke_study_measure(hooke_study *study, int32_t method, double value, struct hooke_study_row *row);

/* All rows, level by level, within the budget. */
int32_t hooke_study_run_ladders(hooke_study *study);

/* Least squares of log error on log step for a method (order_gsl.c). */
void hooke_study_fit_order(hooke_study *study, int32_t method);

#endif
