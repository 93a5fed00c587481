/* Runs at the extremes: their results, judges that find faults in them, and the rows of
 * docs/notes/extremes.md. */
#pragma once

#include "hooke.h"

/* Numbers that are 0 keep their defaults. */
struct extreme_run {
  const char *method;
  double step; /* of a fixed-step method; an error-controlled one has the same duration and frames */
  int64_t steps, frame_steps; /* frame_steps 0: a frame each step */
  double start;               /* time of the initial state */
  double rtol, atol, atol_velocity;
  int64_t max_steps; /* of an error-controlled method; 0: 1000000 */
};

struct extreme_outcome {
  int32_t status;
  char message[1024];
  int32_t refused; /* the integrator could not be created */
  double start, end, t;
  int64_t size;
  double *q, *v; /* the state on return, and the initial one; `size` each */
  double *q0, *v0;
  double energy0, energy;
  int64_t frames, wrong_frames; /* those with a non-finite number, or a NaN energy */
  int64_t coincident;
  int32_t explicit_damping; /* 1: verlet took its damping at the predicted velocity */
};

/* Never fails the test: refusals are outcomes. */
void extreme_run(const hooke_system *system, struct extreme_run run, struct extreme_outcome *outcome);
void extreme_release(struct extreme_outcome *outcome);
/* Released where its block ends. */
#define owned_outcome __attribute__((cleanup(extreme_release))) struct extreme_outcome

/* ---- judges: NULL, or the fault ---- */

/* Requirements on every outcome: a documented status; finite numbers in the state and in every frame; the end
 * of the run reached to the bit, or else a message with a suggestion and a state within the run. */
const char *extreme_unsound(const struct extreme_outcome *outcome);
/* Sound, the end reached, and low <= error <= high. */
const char *extreme_not_right(const struct extreme_outcome *outcome, double error, double low, double high);
/* Sound, with this status and a message that contains this text. */
const char *extreme_not_ended(const struct extreme_outcome *outcome, int32_t status, const char *text);
/* Sound, and ended by any of diverged, step limit, solver failed or bad value. */
const char *extreme_not_refused(const struct extreme_outcome *outcome);

/* The largest error of a coordinate, over `scale` (INFINITY for a NaN). */
double extreme_error(const struct extreme_outcome *outcome, const double *expected, double scale);

/* Fails the running test with the message of a judge, if there is one. */
void extreme_demand(const char *family, const char *name, const char *method, const char *complaint,
                    const struct extreme_outcome *outcome);

/* ---- rows ---- */

/* Records one cell of the table of `family`: the outcome of `name` by `method`. `error` is that of a finished
 * run; NaN: none is stated. */
void extreme_record(const char *family, const char *name, const char *method,
                    const struct extreme_outcome *outcome, double error);
/* The same with the caller's words. */
void extreme_note(const char *family, const char *name, const char *method, const char *words);

/* The end of every main(): with --rows, prints the recorded cells, in lines of "row", family, case, method
 * and words, separated by tabs. Returns the exit code. */
int extreme_finish(int argc, char **argv, int failed);

/* ---- the oscillator ---- */

struct extreme_oscillator {
  const char *family, *name;
  const char *law;        /* "length" about the first end, or "strain" about rest length 1 */
  double stiffness, mass; /* [N/m] or [N], [kg] */
  double partner;         /* mass of the first end [kg]; 0: it is pinned */
  double damping;         /* over critical */
  int32_t drag;           /* damping is drag, not that of the spring; with a pinned first end only */
  double amplitude;       /* [m]; 0: 1 (length law), 0.1 (strain law) */
  double distance;        /* of the whole scene from the origin of coordinates, along x [m] */
  double rest_length;     /* of the length law [m] */
  double start;           /* time at the beginning [s] */
  double step;            /* times omega */
  int64_t steps, frame_steps, max_steps;
  double tolerance;    /* rtol of error-controlled methods; 0: 1e-8 */
  double absolute;     /* their atol, in amplitudes; 0: a hundredth of tolerance */
  double rounding;     /* allowed difference from the known result of the method, in amplitudes; 0: 1e-9 */
  int32_t may_run_out; /* error-controlled methods may reach max_steps */
  int32_t adaptive_status; /* expected for error-controlled methods, if not a right answer */
  int32_t implicit_status; /* likewise of fixed-step methods that do not diverge */
};

/* Runs it by every method; each has to give, to rounding, the result of its known matrix, or to diverge where
 * that does. Error-controlled methods need an error between 1e-5 and 1e4 times their tolerance; far from the
 * origin the tolerance is relative to the distance. */
void extreme_oscillate(const struct extreme_oscillator *oscillator);
