/* The integrator, for the run loop and the methods. */
#pragma once

#include "core/table/option.h"
#include "integrate/method.h"
#include "integrate/loop/recent.h"
#include "model/sum/motion.h"
#include "model/state.h"

struct hk_counts {
  int64_t steps, force_evaluations, derivative_products, nonlinear_iterations, nonlinear_failures,
      linear_iterations, error_test_failures;
  int64_t zero_passages; /* not in checkpoints; -1: not known */
  /* matrices of linear equations, multiplications to factorise them, numbers of factors in solutions, and
   * vectors that GMRES has made others orthogonal to: for measure/counted_work alone, and not in checkpoints
   */
  int64_t matrices, factor_products, factor_numbers, space;
};

/* Upper bound on the steps of a run: doubles count them exactly. */
#define HOOKE_MOST_STEPS INT64_C(9000000000000000)

/* The schedule of a run: whole numbers of steps for a fixed-step method, times for an adaptive one. */
struct hk_schedule {
  double step, duration, every, checkpoint; /* NaN if not given */
  int64_t steps, frame_steps;               /* fixed step: in total, and between frames */
  int64_t checkpoint_steps;                 /* fixed step: between checkpoints; 0: none */
  int64_t frames;                           /* with those of start and end; 0 without a duration */
  int32_t every_given;                      /* 0: `every` was chosen here */
};

/* The standing of a run beside its state: everything that continuing it needs, and its counts. */
#define HOOKE_STANDING                                                                                       \
  double t0, t;                                    /* start and current time of the run */                   \
  double energy0, scale0, gravity0, gravity_swing; /* see divergence.c */                                    \
  double wall_seconds;                                                                                       \
  int64_t k, frames; /* steps since t0, frames reported */                                                   \
  struct hk_counts count;
struct hk_standing {
  HOOKE_STANDING
};

/* State of the last restart of an error-controlled run. */
struct hk_restart {
  hooke_state *state; /* NULL: none is kept */
  struct hk_standing standing;
};

struct hk_watch {
  hooke_observer *observer;
  void *ctx;
  int64_t stride;
};

/* Progress callback between two steps, every so many seconds. `left` steps to the next clock reading, of
 * `stride`, which follows the time of steps. */
struct hk_teller {
  hooke_progress *progress;
  void *ctx;
  double every, told, looked;
  int64_t stride, left;
};

/* Checks every state that passed the divergence check; a non-zero result stops the run. */
struct hk_checker {
  int32_t (*look)(const hooke_integrator *integrator, const hooke_state *state, void *own);
  void (*release)(void *own);
  void *own;
  int64_t memory; /* memory [bytes] */
};

/* Springs that pass through length zero (passages.c), and the longest sentence about them. */
enum { HOOKE_PASSAGES_TOLD = 640 };
struct hk_passages {
  hooke_state *before, *now;                 /* NULL until a spring is short */
  int32_t follows;                           /* 1: `before` has the positions where the last step ended */
  double until;                              /* time up to which they are counted [s] */
  int64_t seen;                              /* here; the count of the run may not be known */
  char first[96], told[HOOKE_PASSAGES_TOLD]; /* the first of them; all in a sentence */
};

/* The last state that passed the check, if only the motion holds it (`unkept` 1, and recent has only earlier
 * ones): see divergence.c. */
struct hk_last_good {
  double t;
  int64_t step;
  int32_t unkept;
};

/* Of a run: at a checkpoint that was read, from which it has not gone on yet. */
enum { HOOKE_NOT_BEGUN, HOOKE_BEGUN, HOOKE_AT_CHECKPOINT };

/* What explicit steps move beside the particles in rows: x of a first-order problem, or the own coordinates
 * of movers (model/coordinates). These are taken from the rows where a step begins and written back by each
 * of its moves, so that a step remains a map of (t, q, v). */
struct hk_numbers {
  int64_t count;
  double *x, *start, *rate, *sum; /* x begins the block of all */
  double *push;                   /* on every mover */
};

struct hooke_integrator {
  const struct hk_method *method;
  hooke_options *options;
  struct hk_schedule schedule;

  /* second-order problem */
  const hooke_system *system;
  hooke_system *problem; /* the system, if it is the integrator's own: a problem of coordinates */
  struct hk_pool *pool;  /* NULL: one thread */
  struct hk_motion *motion;
  /* first-order problem */
  hooke_rate *rate;
  void *rate_ctx;
  double *rows; /* x and its rate, for the callback */

  double *start; /* q and v at the start of a step that may fail midway, for the loop; or NULL */
  struct hk_numbers numbers;
  int64_t size; /* numbers in q */
  void *own;    /* the method's own data */
  void *around; /* scratch of a method whose step contains that of another, which has `own` */
  int64_t own_memory;
  int32_t may_factor;       /* 1: it factorises its equations where that pays */
  int32_t by_tiles;         /* HOOKE_MOTION_*: the motion is moved by the two functions of moves alone */
  int32_t goes_on;          /* 1: the next step follows at once, and nobody sees the state before */
  int32_t exactly;          /* 1: verlet solves nearly to rounding, for a limit that is that of its formula */
  int32_t explicit_damping; /* 1: of verlet, which does not solve for the damping that there is */

  union {
    struct hk_standing standing;
    struct {
      HOOKE_STANDING
    };
  };
  double goal; /* the next time needed by the run loop; a method that does not interpolate stops there */
  int64_t point, samples;    /* with error control: number of the next checkpoint, and of the next sample */
  struct hk_restart restart; /* with error control and the option `checkpoint` */
  int32_t phase;             /* HOOKE_NOT_BEGUN: the numbers above are those of no run */
  struct hk_recent recent;   /* the newest is the last state that passed the check */
  struct hk_last_good good;
  hooke_state *shown; /* shown to observers and checks while the caller's state is stale; NULL before */
  double diverged_at;
  struct hk_energies energies; /* of the state that was last checked; system NULL: not known */

  struct hk_watch on_frame, on_step, on_checkpoint, on_motion, on_sample;
  struct hk_schedule sampling; /* that of the run, with samples for frames */
  struct hk_teller teller;
  struct hk_checker checker;
  int32_t thorough; /* 1: every check includes the energy */
  struct hk_passages passages;
  int32_t stop_value;
  int32_t outcome;   /* of the last run or steps, with its message */
  char message[512]; /* "" after success */
};

extern const struct hk_option_table hk_run_options;
/* HOOKE_BAD_VALUE for the argument `where` unless these are options of a run. */
int32_t hk_run_options_require(const hooke_options *options, const char *where);
/* Sets atol and atol_velocity where they are not given: by the extent of a system (NULL: 1 m), the diagonal
 * of the box of all its particles, and by the duration (none: 1 s). Options without them follow rtol and the
 * duration, to the bit. HOOKE_NO_MEMORY. */
int32_t hk_run_fill_tolerances(const hooke_system *system, hooke_options *options);

/* Reports progress within a long step, if it is due: HOOKE_STOPPED. */
int32_t hk_integrator_tell(hooke_integrator *integrator);

/* Reads `step`, `duration` and `every` of the options into a schedule, filling in `every`. */
int32_t hk_schedule_read(const struct hk_method *method, hooke_options *options,
                         struct hk_schedule *schedule);
/* Sets another `every` > 0 in it (NaN: it stays), and what follows from that. HOOKE_BAD_VALUE, also without a
 * duration.
 */
int32_t hk_schedule_every(int32_t adaptive, double every, struct hk_schedule *schedule);
/* Frames of a run: its start, whole multiples of `every` after it, and its end, if that is none of them.
 * HOOKE_MOST_STEPS + 1 if they are too many. */
int64_t hk_schedule_frames(double duration, double every);
/* The same with a fixed step: 1 if step k has a frame; and the frames before it. */
int32_t hk_schedule_has_frame(const struct hk_schedule *schedule, int64_t k);
int64_t hk_schedule_frames_before(const struct hk_schedule *schedule, int64_t k);

/* Forces at the motion's position and time t, counted; HOOKE_STOPPED with the stop value kept. */
int32_t hk_integrator_forces(hooke_integrator *integrator, double t);
/* The same without forces of these kinds (model/force/force.h). */
int32_t hk_integrator_forces_without(hooke_integrator *integrator, double t, int32_t left_out);
/* For a method whose step may fail after it has moved: the loop puts the motion back. HOOKE_NO_MEMORY. */
int32_t hk_integrator_keep_start(hooke_integrator *integrator);
/* Has the observer called at every step and, by a method that interpolates, at times within it, before the
 * frames there; none of these states was checked for divergence. NULL removes it. HOOKE_NO_MEMORY. */
int32_t hk_integrator_on_motion(hooke_integrator *integrator, hooke_observer *observer, void *ctx);
/* Has the observer of whole runs called at times of its own, which are those of frames with another `every`
 * [s] (NaN: that of the frames): before the frame of the same time, and not checked for divergence. A method
 * that ends steps at frames ends them at samples, too. One observer at most; NULL removes it. HOOKE_BAD_VALUE
 * with the nearest times that are allowed, or without a duration; HOOKE_NO_MEMORY. */
int32_t hk_integrator_on_sample(hooke_integrator *integrator, double every, hooke_observer *observer,
                                void *ctx);
/* A move of this motion (kernel/move_loops.h), without arrays of its method's own. */
void hk_integrator_move_of(const hooke_integrator *integrator, int32_t kind, double kick, double drift,
                           struct hk_move *move);
/* Forces at time t, counted, and every particle moved under them, in one pass over memory where the forces
 * allow it. HOOKE_STOPPED with the stop value kept: nothing has moved. */
int32_t hk_integrator_move(hooke_integrator *integrator, double t, struct hk_move *move);
/* The same under the forces in the motion. */
void hk_integrator_move_on(hooke_integrator *integrator, struct hk_move *move);
/* 1 with movers, if steps leave behind what they carry and no force may act on, which is where `numbers` say
 * after a whole step. One that may fail midway moves all. */
int32_t hk_integrator_skips_unacted(const hooke_integrator *integrator);
/* What is done with particles `from` .. from + count - 1, by several threads for particles of their own. */
typedef void hk_particle_work(hooke_integrator *integrator, int64_t from, int64_t count, void *ctx);
/* Applies it to all stepped particles. */
void hk_integrator_each(hooke_integrator *integrator, hk_particle_work *work, void *ctx);
/* Calls the drives for the positions of their particles at time t; the second also moves driven and pinned
 * particles there. */
int32_t hk_integrator_drive(hooke_integrator *integrator, double t);
int32_t hk_integrator_hold(hooke_integrator *integrator, double t);
/* Of an overdamped system, and nothing of another: velocities of free particles from the forces at time t,
 * where the motion is, of held ones from the drives, which were called for t. Not counted. */
int32_t hk_integrator_flow(hooke_integrator *integrator, double t);
/* Time at the end of the next step of a fixed-step method. */
double hk_integrator_next_time(const hooke_integrator *integrator);
/* slope = phi(t, x), counted. */
int32_t hk_integrator_rate(hooke_integrator *integrator, double t, const double *x, double *slope);

/* Numbers in q that the caller knows of. */
int64_t hk_integrator_numbers(const hooke_integrator *integrator);
/* HOOKE_BAD_VALUE unless the state fits the problem. */
int32_t hk_integrator_check_state(const hooke_integrator *integrator, const hooke_state *state);
/* HOOKE_UNSUITED, with what to take instead, unless the problem is a system of particles. */
int32_t hk_integrator_require_particles(const hooke_integrator *integrator, const char *place,
                                        const char *instead);

/* `begin` and `store` of every fixed-step method. */
int32_t hk_fixed_begin(hooke_integrator *integrator, const hooke_state *state);
int32_t hk_fixed_store(hooke_integrator *integrator, double t, hooke_state *state);

/* Restores a standing at `state`, as if the run had reached it itself; knowledge of its first state stays.
 * The failures of starting a run. */
int32_t hk_integrator_stand(hooke_integrator *integrator, const struct hk_standing *standing,
                            hooke_state *state);

/* The same at a frame of a run that began at `first`: to be called after hk_run_begin() at the first frame
 * and hk_divergence_follow() at each later one. Its counts other than steps are unknown. An error-controlled
 * method can only stand at frame 0. HOOKE_BAD_VALUE for a time that is not the frame's. */
int32_t hk_integrator_stand_at_frame(hooke_integrator *integrator, int64_t frame, const hooke_state *first,
                                     hooke_state *state);

/* Continues from `state` to the end of the schedule of a run that began at `first`: with fixed steps like
 * that run, to the bit. An error-controlled method restarts. */
int32_t hk_integrator_run_on(hooke_integrator *integrator, const hooke_state *first, hooke_state *state);
/* Places `to` at `state`, the one after `step` steps of the run of `from`; both have one method and step. */
int32_t hk_integrator_place(hooke_integrator *to, const hooke_integrator *from, int64_t step,
                            hooke_state *state);
/* Sets a checker, which the integrator owns; a previous one is released first. */
void hk_integrator_set_checker(hooke_integrator *integrator, struct hk_checker checker);

/* The last good state, if only the motion holds it. */
void hk_store_good(const hooke_integrator *integrator, hooke_state *state);
/* 1 if every number is finite. */
int32_t hk_all_finite(int64_t count, const double *value);
int32_t hk_motion_is_finite(const hooke_integrator *integrator);

/* Writes the motion, at time t, into `state`, in a way that the check below can undo. */
int32_t hk_divergence_store(hooke_integrator *integrator, double t, hooke_state *state);
/* Stores the last state that passed in `recent`, if only the motion holds it. HOOKE_NO_MEMORY. */
int32_t hk_divergence_keep(hooke_integrator *integrator);
/* After some fixed steps: writes the motion into `state`, which holds the last good state, unless a number is
 * not finite: HOOKE_DIVERGED, and the state stays. Keeps no copy. */
int32_t hk_divergence_glance(hooke_integrator *integrator, hooke_state *state);
/* Divergence: records the energy at the start; then HOOKE_DIVERGED, with the last good state restored into
 * `state`, if the state has left every physical bound. Without `energy` only non-finite numbers count. */
void hk_divergence_begin(hooke_integrator *integrator, const hooke_state *state);
int32_t hk_divergence_check(hooke_integrator *integrator, hooke_state *state, int32_t energy);
/* Repeats a check that another run passed at this state. */
void hk_divergence_follow(hooke_integrator *integrator, const hooke_state *state);
