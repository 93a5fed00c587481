/* A trial: one method with one step or tolerance, run once and judged against the frames of a reference.
 * Error and cost come from the same run. */
#pragma once

#include "hooke/measurement.h"
#include "integrate/integrator.h"
#include "measure/quantity/wants.h"

/* The frames of a run, kept for judging other runs: memory is bounded by the number of frames, not of steps.
 */
struct hk_frames {
  const hooke_system *system;
  int64_t count, size; /* frames, and numbers in a position (3n) */
  int32_t width;       /* numbers of a place whose distance is judged: 3, or 1 of a problem of coordinates */
  int64_t recorded;    /* frames recorded so far */
  double *time;        /* count [s] */
  double *energy;      /* count [J]; NaN of a problem of coordinates */
  double *position;    /* count x size [m] */
  double *rounding;    /* count: by how much rounding may have displaced a particle until then [m] */
  int64_t *free_place, free_count;  /* particles, or coordinates: errors are measured over these */
  struct hk_watched_series watched; /* empty unless created */
  const struct hk_wants *wants;     /* of its `watched`; NULL: the largest distance is the error */
  hooke_state *within;              /* the state at frame hk_frames_within(), once recorded, where kept */
  char zero_passages[HOOKE_PASSAGES_TOLD]; /* of their run: see hooke_integrator_text() */
};

/* Allocates `count` frames of a committed system. HOOKE_NO_MEMORY. */
int32_t hk_frames_create(const hooke_system *system, int64_t count, struct hk_frames *frames);
/* Lets them record what is watched and wanted (each NULL: nothing). HOOKE_NO_MEMORY. */
int32_t hk_frames_watch(struct hk_frames *frames, const struct hk_watched_list *list,
                        const struct hk_wants *wants);
void hk_frames_release(struct hk_frames *frames);

/* Records the next frame; those beyond `count` are ignored. */
void hk_frames_record(struct hk_frames *frames, const hooke_state *state);

/* A frame at two fifths, where what is periodic in the run has no turning point. */
static inline int64_t hk_frames_within(const struct hk_frames *frames) {
  return 2 * frames->count / 5;
}

/* Root mean square over the free particles of the distance between q and frame f [m]; the largest distance
 * too. */
double hk_frames_distance(const struct hk_frames *frames, int64_t f, const double *q, double *largest);
/* The same between p and q. */
double hk_frames_apart(const struct hk_frames *frames, const double *p, const double *q, double *largest);

/* How large the motion is in the first `count` frames: the diagonal of the box that holds all positions [m],
 * or the largest range of a coordinate; 0 without a motion. */
double hk_frames_extent(const struct hk_frames *frames, int64_t count);

/* What the positions q can hold [m]: half a unit in the last place of the largest coordinate of a free
 * particle. */
double hk_frames_resolution(const struct hk_frames *frames, const double *q);

/* Callbacks during a run; any may be NULL. A non-zero result of the first two stops the run; the third may
 * change the initial state. */
struct hk_listener {
  int32_t (*on_progress)(double fraction, void *ctx);
  int32_t (*on_frame)(int64_t frame, int64_t step, const hooke_state *state, void *ctx);
  void (*on_start)(hooke_state *state, void *ctx);
  double most_work; /* counted work [s] after which a trial is stopped, as a result; 0: any */
  int32_t serial;   /* 1: the run keeps to its thread */
  void *ctx;
};

struct hk_trial {
  const char *status;                     /* "finished", "diverged", "stopped", "failed"; NULL: not run yet */
  double step, rtol, atol, atol_velocity; /* NaN if the method does not take it */
  /* NaN unless finished, with a judged frame after the start; no distance is below what rounding may do */
  double error, error_max, error_final, energy_drift;
  double wanted;   /* the error that a want is held against (quantity/wants.h), or error_max */
  double rounding; /* by how much it may have displaced a particle [m] */
  double force_evaluations, steps, linear_iterations, wall_seconds;
  double work;    /* counted (measure/counted_work) [s] */
  int64_t frames; /* that it came to */
  double *error_at, *error_max_at, *drift_at,
      *wanted_at;                   /* one a frame of the reference, NaN where missing */
  struct hk_watched_series watched; /* quantities watched by the reference, with their errors */
};

void hk_trial_release(struct hk_trial *trial);

/* Runs with the options of a run; a trial begins as zeros, and may be run again. Divergence, a failed solver
 * and a step limit are results, and return HOOKE_OK; HOOKE_STOPPED if the listener asked for it; other
 * failures are returned. `frames` is the number of judged frames: later frames of the reference are ignored.
 */
int32_t hk_trial_run(struct hk_trial *trial, const struct hk_frames *reference, int64_t frames,
                     const hooke_options *options, const struct hk_listener *listener);

/* 1 if an integrator gave up: a result of a trial, not its failure. */
int32_t hk_trial_gave_up(int32_t status);

/* What a run took. */
struct hk_run_cost {
  double wall_seconds, force_evaluations;
  double work;      /* counted [s] */
  int32_t too_long; /* 1: the most work of its listener ended it */
  double atol;      /* that its options name, or that follows [m] */
};

/* Runs and records every frame, as a reference for trials; any outcome but success is returned. `cost` may be
 * NULL. Frames that have nothing but a system record none, and need no release. */
int32_t hk_frames_run(struct hk_frames *frames, const hooke_options *options,
                      const struct hk_listener *listener, struct hk_run_cost *cost);

/* Sets a method and its step or rtol in options of a run; atol and atol_velocity, if given, keep their ratios
 * to rtol. */
int32_t hk_trial_set_value(hooke_options *run, const char *method, double value);

/* A displaced start: adds to every coordinate of a free particle a normal number times `length` [m]; a rigid
 * body goes where the three particles go that say where it is. */
void hk_displace(hooke_state *state, const hooke_system *system, double length, uint64_t *random);

/* ---- the steps that fit a run ---- */

/* The largest step [s] of which `duration` and `every` are whole multiples: it and its integer fractions fit
 * both. HOOKE_BAD_VALUE if the times have none that is not very small. */
int32_t hk_step_unit(double duration, double every, double *unit);

/* Duration and time between frames [s] of a run; without `every` it is set to a hundredth of the duration.
 * HOOKE_BAD_VALUE without a duration. */
int32_t hk_step_times(hooke_options *run, double *duration, double *every);

/* 1 if a quotient is a whole number >= 1, to 1e-9 relative. */
int32_t hk_step_is_whole(double quotient);
