/* The runs of a reference: tight ones, kept as frames or judged by frames, each until a deadline. */
#ifndef HOOKE_MEASURE_TRIAL_REFERENCE_RUN_H
#define HOOKE_MEASURE_TRIAL_REFERENCE_RUN_H

#include "measure/trial/reference.h"

/* The runs of a reference under way: told of as a share of them all, stopped when their time is over. */
struct hk_reference_watch {
  const struct hk_reference_request *request;
  double begun, run_begun, deadline; /* on the clock [s] */
  double unit;                       /* of the first run [s]; 0 until it is over */
  double ahead;                      /* the runs to come, in units */
  int32_t levels;                    /* begun */
  int32_t expired;                   /* the deadline ended a run */
  int32_t cut;                       /* the last level was not run to its end */
  double apart;                      /* there, twice the largest rms distance of the two [m] */
  void *displacement;                /* what the next run starts displaced by */
};

/* What a run took. */
struct hk_reference_cost {
  double evaluations, seconds;
};

/* The next run ends at the deadline; begins to listen to it. */
struct hk_listener hk_reference_listen(struct hk_reference_watch *watch, double deadline);

/* The frames of `method` at `rtol`, as far as the deadline allows; then the extent is theirs. */
int32_t hk_reference_make_frames(struct hk_reference_watch *watch, struct hk_reference *reference,
                                 double deadline, struct hk_reference_cost *cost);

/* Of the box that holds `rows` points [m]; 0 for none. */
double hk_reference_diagonal(int64_t rows, const double *position);

/* A run as far as there are frames, or until the listener's deadline; error_at is NaN past its end. */
int32_t hk_reference_judge(struct hk_reference_watch *watch, const struct hk_reference *reference,
                           const char *method, double rtol, const struct hk_listener *listener,
                           struct hk_trial *trial);

/* Of the first integrators, Adams instead of BDF where a trial of the beginning says that it is quicker:
 * damping that is fast need not be stiff for it. */
int32_t hk_reference_choose_first(struct hk_reference_watch *watch, struct hk_reference *reference,
                                  double rtol);

/* Chooses the second integrator, after the first has run at about `rtol` and taken so much. */
int32_t hk_reference_choose_check(struct hk_reference_watch *watch, struct hk_reference *reference,
                                  double rtol, struct hk_reference_cost first);

/* Largest growth of a small displacement at the start, over the frames (reference_growth.c). */
int32_t hk_reference_measure_growth(struct hk_reference_watch *watch, struct hk_reference *reference,
                                    struct hk_trial *trial);

#endif
