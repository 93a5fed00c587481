/* What an estimate holds. */
#ifndef HOOKE_MEASURE_ESTIMATE_ESTIMATE_H
#define HOOKE_MEASURE_ESTIMATE_ESTIMATE_H

#include "hooke/estimate.h"
#include "measure/estimate/pick.h"
#include "measure/estimate/soundness.h"

struct hooke_estimate {
  const hooke_system *system;
  double want; /* [m], NaN: none */
  hooke_progress *progress;
  void *ctx;
  struct hk_pick pick; /* with a system once it was run */
  int32_t picked;      /* 1: the run to come is the one that was picked, and not a finer one */
  char only[64];       /* the only method that may be picked; "": any */
  double first;        /* seconds of the first run */
  double before;       /* the error before something finer was set [m]; infinity at first */
  int32_t refined;     /* times */

  /* the run */
  hooke_options *options; /* the integrator's */
  double begun;           /* by the clock [s] */
  double begin, duration, every, seconds;
  struct hk_frames kept; /* of the run: the start, and frames that are `apart` [s], up to the end */
  double apart;
  struct hk_soundness soundness;
  int64_t frames_apart; /* of those the soundness sees */
  int64_t frames_seen;
  hooke_state *late; /* at about the beginning of its last piece */
  double late_after; /* its earliest time [s]; NaN once it is there */

  /* what came of it */
  double error, known_from, known_until, order; /* the order: of the error in the step or tolerance */
  const char *by;
  double rise, heat_excess, spent;
  char note[256];
};

/* The method and its step or tolerance in options of a run. */
double hk_estimate_value(const hooke_options *options);

/* The run once more: by a step or tolerance, for `duration` with frames `every` apart [s]. */
struct hk_rerun {
  double value, duration, every;
  const hooke_state *from;  /* NULL: from the beginning */
  hooke_observer *observer; /* of its frames, with `ctx`; or NULL */
  void *ctx;
};

/* `frames` receives its start and as many frames as there is memory for. What ends it early leaves fewer.
 * HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_rerun(struct hooke_estimate *estimate, const struct hk_rerun *rerun,
                          struct hk_frames *frames);
/* Estimates from reruns: coarser ones, and finer ones of the last piece or of all. They leave the error NaN
 * where they cannot tell (estimate_runs.c). */
int32_t hk_estimate_by_coarser(struct hooke_estimate *estimate);
int32_t hk_estimate_by_slice(struct hooke_estimate *estimate);
int32_t hk_estimate_by_finer(struct hooke_estimate *estimate);

/* A pick alone: sets a method and its step or tolerance for the wanted error [m] in `run`. HOOKE_BAD_VALUE if
 * nothing is known to meet it, and the failures of hooke_estimate_pick(). */
int32_t hk_estimate_pick_alone(const hooke_system *system, hooke_options *run, double want,
                               hooke_progress *progress, void *ctx);

#endif
