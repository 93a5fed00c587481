/* The object of a measurement of kind "estimate". */
#ifndef HOOKE_MEASURE_ESTIMATE_ESTIMATE_H
#define HOOKE_MEASURE_ESTIMATE_ESTIMATE_H

#include "hooke/estimate.h"
#include "measure/estimate/pick.h"
#include "measure/estimate/soundness.h"
#include "measure/measurement.h"

struct hk_estimate {
  const hooke_measurement *measurement;
  const hooke_system *system;
  double want;         /* [m], NaN: none */
  struct hk_pick pick; /* with a system, after its run */
  int32_t picked;      /* 1: the next run is the picked one, not a refined one */
  char only[64];       /* the only method allowed; "": any */
  double first;        /* time of the first run [s] */
  double before;       /* error before refinement [m]; infinity at first */
  int32_t refined;     /* number of refinements */

  /* the run */
  hooke_options *options;             /* copy of the integrator's */
  const hooke_integrator *integrator; /* valid while it runs */
  double begin, duration, every, seconds;
  struct hk_frames kept; /* recorded states of the run: the start, and frames `apart` [s], up to the end */
  double apart;
  struct hk_soundness soundness;
  int64_t frames_apart; /* of the states that the soundness records */
  int64_t frames_seen;
  hooke_state *late; /* at about the beginning of its last slice */
  double late_after; /* its earliest time [s]; NaN once recorded */

  /* results */
  double error, known_from, known_until, order; /* the order of the error in the step or tolerance */
  const char *by;
  double rise, heat_excess, spent;
  char note[256];
};

extern const struct hk_measurement_kind hk_estimate_kind;
extern const struct hk_table *const hk_estimate_tables[1];

/* 1 if the run meets the wanted error, 0 if not, NaN if that is unknown or none is wanted. */
double hk_estimate_met(const struct hk_estimate *estimate);

/* Method, and step or tolerance, in options of a run. */
double hk_estimate_value(const hooke_options *options);

/* A rerun: by a step or tolerance, for `duration` with frames `every` apart [s]. */
struct hk_rerun {
  double value, duration, every;
  const hooke_state *from;  /* NULL: the initial state */
  hooke_observer *observer; /* observer of its frames, with `ctx`; or NULL */
  void *ctx;
};

/* `frames` receives its start and as many frames as there is memory for; fewer if it ends early.
 * HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_rerun(struct hk_estimate *estimate, const struct hk_rerun *rerun,
                          struct hk_frames *frames);
/* Estimates from reruns: coarser ones, and finer ones of the last slice or the whole run. They leave the
 * error NaN where it cannot be determined (estimate_runs.c). */
int32_t hk_estimate_by_coarser(struct hk_estimate *estimate);
int32_t hk_estimate_by_slice(struct hk_estimate *estimate);
int32_t hk_estimate_by_finer(struct hk_estimate *estimate);

/* Picks only: sets a method and its step or tolerance for the wanted error [m] in `run`. HOOKE_BAD_VALUE if
 * nothing is known to meet it, and the failures of hooke_estimate_pick(). */
int32_t hk_estimate_pick_alone(const hooke_system *system, hooke_options *run, double want,
                               hooke_progress *progress, void *ctx);

#endif
