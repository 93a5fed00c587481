/* Trials side by side: independent runs of a measurement, each with a result of its own, on several threads.
 * What a trial finds does not depend on the others, so no number depends on the threads. */
#pragma once

#include "measure/measurement.h"

/* The trial that a thread is at. */
struct hk_turn {
  struct hk_turns *turns;
  int64_t number;
  int32_t worker; /* 0: the caller's thread */
  int32_t serial; /* 1: others may be running, so that it keeps to its thread, and its times tell little */
};

/* Runs a trial, and writes nothing that another one reads or writes; returns a status. */
typedef int32_t hk_trial_work(struct hk_turn *turn, void *ctx);

/* Runs trials 0 to count - 1 of the system of a measurement, or of variants of it, by as many threads as the
 * options of its run allow; `alone` 1, or where callbacks of forces or drives take part: by one. `tell` is
 * called by the caller's thread alone, with the fraction that is done: a non-zero result stops all trials.
 * Returns the first failure in the order of trials, of which later ones may then not have been run. */
int32_t hk_run_side_by_side(const hooke_measurement *measurement, int32_t alone, int64_t count,
                            hk_trial_work *work, void *ctx, int32_t (*tell)(double done, void *ctx),
                            void *tell_ctx);

/* Progress of a trial, whose context is the turn: non-zero if it is to end. */
int32_t hk_turn_tell(double fraction, void *turn);
