/* Measured limits: bisects the step between one at which real runs are stable and one at which they grow. */
#pragma once

#include "measure/limit/limit.h"

struct hk_measured_limit {
  /* the limit [s]: 0 if no step is stable, infinity if nothing limits it, NaN if not found */
  double step;
  int64_t steps_run;    /* number of steps taken */
  int32_t never_stable; /* growth was seen at every step tried, ever smaller ones */
  const char *note;     /* remark, "" if none */
};

/* The limit of a row's method on the linear twin of the system at q (linear_twin.h), to the relative
 * `accuracy`, within the budget. The search starts at `predicted` (NaN: unknown; 0 and infinity are tested),
 * with runs that start in the mode of the row and some random motion. The result is confirmed by a run just
 * below it that starts from random motion alone. Where the eigenvalues tell that growth at that accuracy is
 * too slow for a run to show, the accuracy is 5 %, or nothing is run. The note says so, and if the budget
 * ended too early. HOOKE_BAD_VALUE, HOOKE_NOT_BUILT, HOOKE_STOPPED by the caller, HOOKE_NO_MEMORY. */
int32_t hk_limit_measure(const struct hk_limit *limit, const struct hk_limit_row *row, const double *q,
                         const double *v, double predicted, double accuracy, struct hk_budget *budget,
                         struct hk_measured_limit *out);

/* The largest step at which the scene itself runs from `start` through the `duration` of `run` without
 * divergence. With callbacks and drives only non-finite numbers count. HOOKE_BAD_VALUE without a duration;
 * HOOKE_STOPPED also if a callback of the scene asked for it. */
int32_t hk_limit_measure_nonlinear(const hooke_system *system, const hooke_state *start,
                                   const hooke_options *run, const char *method, double predicted,
                                   double accuracy, struct hk_budget *budget, struct hk_measured_limit *out);
