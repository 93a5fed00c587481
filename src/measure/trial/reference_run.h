/* The runs of a reference: tight ones, recorded as frames or judged by frames, each until a deadline. */
#pragma once

#include "measure/trial/reference.h"

/* The current runs of a reference: progress is reported as a fraction of them all, and they stop at their
 * deadline. */
struct hk_reference_watch {
  const struct hk_reference_request *request;
  double begun, run_begun; /* wall-clock time [s] */
  double start, deadline;  /* by hk_reference_now() */
  double work;             /* counted, of all runs so far [s] */
  double unit;             /* of the first run [s]; 0 until it is over */
  double ahead;            /* of the runs to come, in units */
  int32_t levels;          /* begun */
  int32_t expired;         /* the deadline ended a run */
  int32_t cut;             /* the last level was not run to its end */
  double apart;            /* there, twice the largest distance of the two [m] */
  void *displacement;      /* displacement of the start of the next run */
};

/* Time that counts for the budget: counted work so far, or wall-clock time [s]. */
double hk_reference_now(const struct hk_reference_watch *watch);

/* Sets the deadline of the next run, and listens to it. */
struct hk_listener hk_reference_listen(struct hk_reference_watch *watch, double deadline);

/* Runs `method` at `rtol` and records frames, until the deadline; then sets the extent from them. */
int32_t hk_reference_make_frames(struct hk_reference_watch *watch, struct hk_reference *reference,
                                 double deadline, struct hk_run_cost *cost);

/* A run to the last recorded frame, or until the listener's deadline; error_at is NaN past its end. */
int32_t hk_reference_judge(struct hk_reference_watch *watch, const struct hk_reference *reference,
                           const char *method, double rtol, const struct hk_listener *listener,
                           struct hk_trial *trial);

/* The first integrator: Adams instead of BDF if a trial of the beginning shows that it is quicker; fast
 * damping need not be stiff for it. */
int32_t hk_reference_choose_first(struct hk_reference_watch *watch, struct hk_reference *reference,
                                  double rtol);

/* Finds `longest` for a method of fixed steps: a stable one at the start that fits the frames.
 * HOOKE_BAD_VALUE if duration and every have no step in common. */
int32_t hk_reference_find_longest(const struct hk_reference_watch *watch, struct hk_reference *reference,
                                  const char *method);

/* Chooses the second integrator, after the first has run at about `rtol` at this cost. */
int32_t hk_reference_choose_check(struct hk_reference_watch *watch, struct hk_reference *reference,
                                  double rtol, struct hk_run_cost first);

/* Largest growth of a small displacement of the start, over the frames (reference_growth.c). */
int32_t hk_reference_measure_growth(struct hk_reference_watch *watch, struct hk_reference *reference,
                                    struct hk_trial *trial);
