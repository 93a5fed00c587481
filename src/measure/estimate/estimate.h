/* How far a run is off at every frame: it is held against itself with half the step or a tighter tolerance,
 * against another method, or against a reference. */
#pragma once

#include "hooke/estimate.h"
#include "measure/recommend/pick.h"
#include "measure/recommend/soundness.h"
#include "measure/measurement.h"

/* Errors and distances: those of all free particles [m], then those of the wants. */
enum { HOOKE_ERRORS = 1 + HOOKE_WANTS };

struct hk_estimate {
  const hooke_measurement *measurement;
  const hooke_system *system;
  struct hk_wants wants;
  double bound[HOOKE_WANTS]; /* of these, by the largest values of the run */
  int32_t callbacks;         /* 1: runs are repeated even if callbacks take part */
  struct hk_pick pick;       /* with a system, after its run */
  int32_t picked;            /* 1: the next run is the picked one, not a refined one */
  const char *only;          /* the only method allowed; NULL: any */
  double first;              /* counted work of the first run [s] */
  double before;             /* largest error over its bound before refinement; infinity at first */
  int32_t refined;           /* number of refinements */

  struct hk_watched_list watched; /* and what is wanted */
  int32_t only_watches;           /* 1: it is not asked for the error */

  /* the run */
  hooke_options *options;             /* copy of the integrator's */
  const hooke_integrator *integrator; /* valid while it runs */
  double begin, duration, every;
  double work, steps;    /* counted work [s] (measure/counted_work), and steps */
  int32_t resumed;       /* 1: it continued another run */
  hooke_state *start;    /* its first state */
  struct hk_frames kept; /* recorded states of the run: frames `apart` [s], and its end */
  double apart;
  struct hk_watched_run course; /* of what is watched */
  struct hk_soundness soundness;
  int64_t frames_apart; /* of the states that the soundness records */
  int64_t frames_seen;
  int64_t frames, compared; /* of the run, and those at which errors were found */
  hooke_state *late;        /* at about the beginning of its last slice */
  double late_after;        /* its earliest time [s]; NaN once recorded */

  /* results */
  double error[HOOKE_ERRORS], order[HOOKE_ERRORS]; /* NaN: not known; orders in the step or tolerance */
  double rms, known_until;
  const char *by;
  double last_error, last_from; /* what the last piece of the run made; NaN: not measured */
  double rise, heat_excess, spent;
  double left; /* counted work that other runs may still take [s] */
  char reason[256], reversal[160];
};

extern const struct hk_measurement_kind hk_estimate_kind;
extern const struct hk_table hk_estimate_tables[];

/* What it says of the error of the run (estimate_claims.c). */
void hk_estimate_claim(const hooke_measurement *measurement, struct hk_claims *claims);

/* 1 if its error is known to the end of the run. */
int32_t hk_estimate_knows_all(const struct hk_estimate *estimate);
/* 1 if the run meets what is wanted, 0 if not, NaN if that is unknown or nothing is wanted; and one want. */
double hk_estimate_met(const struct hk_estimate *estimate);
double hk_estimate_meets(const struct hk_estimate *estimate, int32_t want);
/* Sets an error, to which it adds what is not known of the value itself. */
void hk_estimate_know(struct hk_estimate *estimate, int32_t number, double error);

/* 1 if extremes of what is watched are over the whole run. */
int32_t hk_estimate_saw_all(const struct hk_estimate *estimate);

/* Step or tolerance in options of a run. */
double hk_estimate_value(const hooke_options *options);

/* Another run: by a method with a step or tolerance, for `duration` with frames `every` apart [s]. */
struct hk_rerun {
  const char *method;
  double value, duration, every;
  const char *what;         /* for progress: what this is, and its part of all other runs */
  double done, fraction;    /* before it, and by it */
  const hooke_state *from;  /* NULL: the start of the run */
  hooke_observer *observer; /* observer of its frames, with `ctx`; or NULL */
  void *ctx;
};

/* `frames` receives its start and as many frames as there is memory for; fewer if it ends early.
 * HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_rerun(struct hk_estimate *estimate, const struct hk_rerun *rerun,
                          struct hk_frames *frames);

/* Estimates the error of the whole run from other runs (estimate_runs.c), or says in `reason` why it is not
 * known. HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_by_runs(struct hk_estimate *estimate);
/* What its last slice added to the error, from a finer run of that. */
int32_t hk_estimate_last_slice(struct hk_estimate *estimate);
/* Holds the run against another method (estimate_judge.c): a larger distance becomes the error, and a
 * contradiction makes it unknown. */
int32_t hk_estimate_by_other_method(struct hk_estimate *estimate);

/* Repeats the beginning and the last slice at the run's own step and sums the heat over the steps, in a small
 * fraction of the run's time. With the residual R = E(t) - E(a) - W + D of the balance (trial/balance.h),
 * which has to stay as large from the middle of a slice on, and
 *
 *   U = sum over steps of h min(P(v0), P(v1), P(v2), P(v3), P((v3 - 3 v2 + 3 v1 - v0)/8)),
 *
 * P the dissipated power and v0 to v3 velocities one step apart, the excess is min(R, U) as a fraction of the
 * energy of the scene. U is the whole heat where velocities reverse at each step. It is sin(h omega/2)^6 of
 * the heat of an oscillation, and 0.34 % at most of the energy that a motion loses as it comes to rest
 * without overshooting: so the error that R has with every method is not counted as excess. Sets
 * estimate->heat_excess, that of the slice where it is larger; NaN with callbacks or error control, or where
 * there was no time for a slice. HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_heat(struct hk_estimate *estimate);

/* Distances of a run from this one over frames, and the root mean square over free particles [m]. NaN if it
 * did not finish. */
struct hk_distance {
  double of[HOOKE_ERRORS], rms;
};
/* Runs, within the work that is left, and compares the first `frames` of the kept ones. */
int32_t hk_estimate_compare(struct hk_estimate *estimate, const struct hk_rerun *rerun, int64_t frames,
                            struct hk_distance *distance);
/* The smallest step [s] from `least` on that fits the kept frames; NaN if there is none. */
double hk_estimate_fit_step(const struct hk_estimate *estimate, double least);
