/* What an integrator holds, for the run loop and the methods. */
#ifndef HOOKE_INTEGRATE_INTEGRATOR_H
#define HOOKE_INTEGRATE_INTEGRATOR_H

#include "core/table/option.h"
#include "integrate/method.h"
#include "integrate/loop/recent.h"
#include "model/sum/motion.h"
#include "model/state.h"

struct hk_counts {
  int64_t steps, force_evaluations, derivative_products, nonlinear_iterations, nonlinear_failures,
      linear_iterations, error_test_failures;
};

/* A run has fewer: doubles count them one by one. */
#define HOOKE_MOST_STEPS INT64_C(9000000000000000)

/* The schedule of a run: whole numbers of steps for a fixed-step method, times for an adaptive one. */
struct hk_schedule {
  double step, duration, every, checkpoint; /* NaN where not given */
  int64_t steps, frame_steps;               /* fixed step: in all, and between frames */
  int64_t checkpoint_steps;                 /* fixed step: between checkpoints; 0: none */
  int64_t frames;                           /* the initial one included; 0 without a duration */
  int32_t every_given;                      /* 0: `every` was chosen here */
};

/* Where a run stands beside its state: all that going on from there takes, and what it counted. */
struct hk_standing {
  double t0, t;
  int64_t k, frames;                               /* steps since t0, frames reported */
  double energy0, scale0, gravity0, gravity_swing; /* see divergence.c */
  struct hk_counts count;
  double wall_seconds;
};

/* Where an error-controlled run last started anew. */
struct hk_restart {
  hooke_state *state; /* NULL: none is kept */
  struct hk_standing standing;
};

struct hk_watch {
  hooke_observer *observer;
  void *ctx;
  int64_t stride;
};

/* Who is told of progress between two steps, after every so many seconds. `left` steps to the next look at
 * the clock, of `stride`, which follows the time that steps take. */
struct hk_teller {
  hooke_progress *progress;
  void *ctx;
  double every, told, looked;
  int64_t stride, left;
};

/* Whoever looks at every state that passed the check; anything but 0 stops the run. */
struct hk_checker {
  int32_t (*look)(const hooke_integrator *integrator, const hooke_state *state, void *own);
  void (*release)(void *own);
  void *own;
  int64_t memory; /* bytes that it has */
};

struct hooke_integrator {
  const struct hk_method *method;
  hooke_options *options;
  struct hk_schedule schedule;

  /* second-order problem */
  const hooke_system *system;
  struct hk_pool *pool; /* NULL: one thread */
  struct hk_motion *motion;
  /* first-order problem */
  hooke_rate *rate;
  void *rate_ctx;
  double *x, *slope; /* size each */

  int64_t size; /* numbers in q */
  void *own;    /* the method's scratch */
  int64_t own_memory;
  int32_t may_factor;       /* 1: it factorises its equations where that pays */
  int32_t by_tiles;         /* 1: the motion is moved by hk_integrator_pass() alone */
  int32_t explicit_damping; /* 1: of verlet, which does not solve for the damping that there is */

  double t0, t;   /* where the run began, and where it is */
  double goal;    /* the time that the run loop wants next; a method that does not interpolate stops there */
  int64_t k;      /* steps since t0 */
  int64_t frames; /* reported since t0 */
  int64_t point;  /* number of the next checkpoint, with error control */
  struct hk_restart restart; /* with error control and the option `checkpoint` */
  int32_t begun;             /* 1: the numbers above are those of a run */
  int32_t placed;            /* 1: at the place of a checkpoint that was read */
  struct hk_recent recent;   /* the newest is the last state that passed the check */
  double good_time;          /* of it, where the motion alone has it: see divergence.c */
  int64_t good_step;
  int32_t unkept;     /* 1: the motion has it, and recent only those before it */
  hooke_state *shown; /* to observers and checks while the caller's state is stale; NULL before */
  double energy0, scale0, gravity0, gravity_swing; /* see divergence.c */
  double diverged_at;

  struct hk_watch on_frame, on_step, on_checkpoint;
  struct hk_teller teller;
  struct hk_checker checker;
  int32_t thorough; /* 1: every check looks at the energy, too */
  struct hk_counts count;
  double wall_seconds;
  int32_t stop_value;
  int32_t outcome;   /* of the last run or steps, with its message */
  char message[512]; /* "" after success */
};

extern const struct hk_option_table hk_run_options;
/* HOOKE_BAD_VALUE, as the argument `place`, for options that are not those of a run. */
int32_t hk_run_options_require(const hooke_options *options, const char *place);

/* Tells of progress within a step that takes long, if it is time to: HOOKE_STOPPED. */
int32_t hk_integrator_tell(hooke_integrator *integrator);

/* Reads `step`, `duration` and `every` of the options into a schedule, filling in `every`. */
int32_t hk_schedule_read(const struct hk_method *method, hooke_options *options,
                         struct hk_schedule *schedule);

/* Forces at the motion's place and time t, counted; HOOKE_STOPPED with the stop value kept. */
int32_t hk_integrator_forces(hooke_integrator *integrator, double t);
/* The same without one force of the table. */
int32_t hk_integrator_forces_without(hooke_integrator *integrator, double t,
                                     const struct hk_force_row *left_out);
/* Forces at time t, and every particle moved under them, in one pass over memory where the forces allow it:
 * in one of Euler's ways, HOOKE_KICK_THEN_DRIFT or HOOKE_DRIFT_THEN_KICK, or by a half of a Verlet step, with
 * the velocities half-way in `half`. */
int32_t hk_integrator_pass(hooke_integrator *integrator, double t, int32_t kind, double *const half[3]);
/* What is done with particles `from` .. from + count - 1, by several threads for particles of their own. */
typedef void hk_particle_work(hooke_integrator *integrator, int64_t from, int64_t count, void *ctx);
/* For all particles that are stepped. */
void hk_integrator_each(hooke_integrator *integrator, hk_particle_work *work, void *ctx);
/* Asks the drives where their particles are at time t; the second also puts driven and pinned particles
 * there. */
int32_t hk_integrator_drive(hooke_integrator *integrator, double t);
int32_t hk_integrator_hold(hooke_integrator *integrator, double t);
/* Time at the end of the step that a fixed-step method is about to take. */
double hk_integrator_next_time(const hooke_integrator *integrator);
/* slope = phi(t, x), counted. */
int32_t hk_integrator_rate(hooke_integrator *integrator, double t, const double *x, double *slope);

/* `begin` and `store` of every fixed-step method. */
int32_t hk_fixed_begin(hooke_integrator *integrator, const hooke_state *state);
int32_t hk_fixed_store(hooke_integrator *integrator, double t, hooke_state *state);

/* Where the integrator stands now, and putting it there, at `state`, as if it had come by itself; what it
 * knows of its first state stays. The failures of a run's beginning. */
struct hk_standing hk_integrator_standing(const hooke_integrator *integrator);
int32_t hk_integrator_stand(hooke_integrator *integrator, const struct hk_standing *standing,
                            hooke_state *state);

/* The same at a frame of a run that began at `first`: for hk_run_begin() and hk_divergence_follow() to come
 * before, at the first frame and at each one since. What it counted but steps is not known. An
 * error-controlled method stands at frame 0 alone. HOOKE_BAD_VALUE for a time that is not the frame's. */
int32_t hk_integrator_stand_at_frame(hooke_integrator *integrator, int64_t frame, const hooke_state *first,
                                     hooke_state *state);

/* Goes on from `state` to the end of the schedule of a run that began at `first`: with fixed steps what that
 * run did from there, to the bit. An error-controlled method starts anew. */
int32_t hk_integrator_run_on(hooke_integrator *integrator, const hooke_state *first, hooke_state *state);
/* Makes `to` stand at `state`, the one after `step` steps of the run of `from`; both of one method and
 * step. */
int32_t hk_integrator_place(hooke_integrator *to, const hooke_integrator *from, int64_t step,
                            hooke_state *state);
/* Hands the integrator a checker, which it releases; an older one is released first. */
void hk_integrator_set_checker(hooke_integrator *integrator, struct hk_checker checker);

/* The last good state, where the motion alone has it. */
void hk_store_good(const hooke_integrator *integrator, hooke_state *state);
/* 1 if every number is finite. */
int32_t hk_all_finite(int64_t count, const double *value);
int32_t hk_motion_is_finite(const hooke_integrator *integrator);

/* Writes the motion, which is at time t, into `state`, in a way that the check below can take back. */
int32_t hk_divergence_store(hooke_integrator *integrator, double t, hooke_state *state);
/* Has the last state that passed in `recent`, which so far the motion alone may have. HOOKE_NO_MEMORY. */
int32_t hk_divergence_keep(hooke_integrator *integrator);
/* At the end of some steps with a fixed step: writes the motion into `state`, which has the last good state,
 * unless a number is not finite: HOOKE_DIVERGED, and the state stays. Keeps no copy. */
int32_t hk_divergence_glance(hooke_integrator *integrator, hooke_state *state);
/* Divergence: remembers the energy at the start; then HOOKE_DIVERGED, with the last good state put back into
 * `state`, if the state has left every physical bound. Without `energy` only numbers that are not finite are
 * looked for. */
int32_t hk_divergence_begin(hooke_integrator *integrator, const hooke_state *state);
int32_t hk_divergence_check(hooke_integrator *integrator, hooke_state *state, int32_t energy);
/* A check that another run passed at this state. */
void hk_divergence_follow(hooke_integrator *integrator, const hooke_state *state);

#endif
