/* What a scene requires for a wanted error: one ingredient after another is left out, and what changes the
 * motion by more is needed. */
#pragma once

#include "measure/measurement.h"
#include "measure/quantity/wants.h"
#include "measure/recommend/soundness.h"
#include "measure/trial/side_by_side.h"
#include "model/variant/variant.h"

enum { HOOKE_NEEDS_NOTE = 320, HOOKE_NEEDS_NAME = 192 };
#define HOOKE_NEEDS_SHORT      0.02 /* [s]: time for repeating runs */
#define HOOKE_NEEDS_STEP_SHARE 0.1  /* of the wanted error: allowed error of the time step */

/* Cost of a run of one variant. NaN where it does not apply. */
struct hk_needs_cost {
  double particles, springs, step_limit;
  double unlimited; /* 1: nothing limits the step */
  int64_t indexed;  /* springs whose ends are looked up individually */
  double step, rtol, atol, steps, force_evaluations, wall_seconds, work; /* counted [s] */
  double step_error;                                                     /* error due to the step [m] */
};

extern const struct hk_needs_cost hk_needs_no_cost; /* all of it unknown */

/* Watched positions at every frame: count numbers a frame; and the quantities of a list of wants. */
struct hk_needs_path {
  int64_t recorded;
  double *position;
  struct hk_watched_series values;
};

struct hk_needs_row {
  char without[HOOKE_NEEDS_NAME];
  const char *kind;
  char note[HOOKE_NEEDS_NOTE];
  struct hk_variant variant;
  double error; /* [m] */
  int32_t measured, left_out;
  int32_t timed_alone; /* 0: timed while others were running */
  double needed;       /* 1 or 0; NaN where nothing moves that could tell, which counts as needed */
  struct hk_needs_cost cost;
};

enum hk_needs_property {
  HOOKE_NEEDS_SINGLE,    /* stiffness of a spring */
  HOOKE_NEEDS_STIFFNESS, /* of a group */
  HOOKE_NEEDS_DAMPING,   /* of a group */
  HOOKE_NEEDS_MASS,      /* of a particle */
  HOOKE_NEEDS_DRAG
};

/* How far one number may be changed. */
struct hk_needs_degree {
  char name[HOOKE_NEEDS_NAME], quantity[HOOKE_NEEDS_NAME + 16]; /* "cloth.shear", "cloth.shear.stiffness" */
  enum hk_needs_property property;
  int64_t number;              /* of the spring, the group or the particle */
  int64_t group;               /* of the spring */
  int32_t up, tried;           /* 1: larger is asked for; 0: not tried, within the work allowed */
  int32_t displaced;           /* 1: by runs from a displaced start */
  double factor, error;        /* the farthest that holds; 1: none that was tried does [m] */
  double beyond, error_beyond; /* the next one, which does not; NaN: none, or its run does not end */
  double step_limit, work;     /* [s]; steps for the same time, of those of the full system */
  double lean_factor;          /* in the lean system */
};

struct hk_needs_part {
  const char *name;
  int64_t cells[3]; /* -1: no such axis */
  double change, change_fine, order, error, factor;
  char note[HOOKE_NEEDS_NOTE];
};

/* A system with something left out, and its recommended run. */
struct hk_needs_lean {
  struct hk_variant variant;
  hooke_system *system; /* NULL: there is none */
  struct hk_variant_map map;
  struct hk_needs_cost cost;
  struct hk_needs_path path;
  double error; /* [m] */
};

struct hk_needs {
  const hooke_measurement *m;     /* a picked method is set in its `run` */
  struct hk_watched_list watched; /* of the list of what is wanted */
  struct hk_wants wants;
  double want, duration, every, unit; /* as in `wants`, as are errors; largest step that frames allow [s] */
  int32_t method_picked;
  int64_t watch_count, *watch; /* particles */
  uint8_t *kept;               /* by group: 1: neither left out nor changed */
  double *path_time;           /* of the frames [s] */
  int64_t frame_count, judged; /* frames; those up to which differences due to the step stay small */

  struct hk_needs_cost full;
  struct hk_needs_path path; /* of the full system */
  struct hk_needs_path
      by_step[2]; /* of the full system by its step, made when needed; [1]: from a displaced start */
  struct hk_want_found found[HOOKE_WANTS]; /* of the lean system */
  double own_error;                        /* error of `path` itself [m] */
  double moved; /* largest distance of a particle from the start along `path` [m] */
  char note[HOOKE_NEEDS_NOTE];
  double *largest_force; /* of each spring over the frames of the full system [N] */

  int64_t row_count;
  struct hk_needs_row *row;

  int64_t degree_count;
  struct hk_needs_degree *degree;
  struct hk_variant unchanged; /* of the lean system before numbers are changed */
  double trial_work;           /* counted, of comparisons by the step of the full system [s] */
  double most_work;            /* counted, after which a run counts as one that does not finish [s]; 0: any */

  struct hk_needs_lean lean;
  hooke_options *lean_run;
  char lean_note[HOOKE_NEEDS_NOTE];
  struct hk_needs_cost cheapest; /* of the full system within the wanted error, as of the lean one */
  double cheapest_error;
  const char
      *other_method; /* a method by which the full system is cheaper than by its own; NULL: none found */
  double other_seconds;

  int64_t part_count;
  struct hk_needs_part *part;

  struct hk_stage stage;
  int64_t runs;         /* number of runs */
  double spread;        /* of the times of equal runs: the largest quotient of two */
  struct hk_turn *turn; /* of a piece beside others, which has a copy of these for itself; NULL: none */
  const char **shown;   /* what progress says is under way, by the caller's thread; NULL: by another */
};

/* ---- needs_ingredients.c ---- */

/* Adds a row for every ingredient of the system that need not be kept. */
int32_t hk_needs_list(struct hk_needs *needs);
/* 1 if a variant leaves out the group, or makes a body of its part. */
int32_t hk_needs_drops(const struct hk_needs *needs, const struct hk_variant *variant, int64_t group);
void hk_needs_drop_row(struct hk_needs *needs, int64_t row);

/* ---- needs_run.c, needs_step.c ---- */

int32_t hk_needs_path_create(const struct hk_needs *needs, struct hk_needs_path *path);
void hk_needs_path_release(struct hk_needs_path *path);
/* Largest distance of any watched particle over the frames [m], or what a list is held against. */
double hk_needs_distance(const struct hk_needs *needs, const struct hk_needs_path *a,
                         const struct hk_needs_path *b);
/* Largest distance of a particle from its position at the first frame [m]. */
double hk_needs_moved(const struct hk_needs *needs, const struct hk_needs_path *path);
/* The errors of the lean system, one by one. */
void hk_needs_find_each(struct hk_needs *needs);
/* Time of a frame since the start [s]. */
double hk_needs_time(const struct hk_needs *needs, int64_t frame);
/* Number of frames up to which this distance stays within `bound`. */
int64_t hk_needs_agreed(const struct hk_needs *needs, const struct hk_needs_path *a,
                        const struct hk_needs_path *b, double bound);

/* A variant to run: its system, and the map into it (NULL: the full system, whose forces are recorded as
 * well). */
struct hk_needs_trial {
  const hooke_system *system;
  const struct hk_variant_map *map;
};
/* Of one run. */
struct hk_needs_recorder {
  struct hk_needs *needs;
  const struct hk_needs_trial *trial;
  struct hk_needs_path *path;   /* NULL: only the time is needed */
  struct hk_watched_list moved; /* what is watched, in its system */
  double last_step;
  double share_begun, fraction; /* of the measurement: before this run, and for it */
  int32_t displaced;            /* 1: it starts from a displaced start */
  int32_t judges, sound; /* 1: its step and its energy are judged; they are sound (recommend/soundness.h) */
  struct hk_soundness soundness;
};

/* Runs once. `finished`: 0 if it diverged or its solver failed, which is a result here. Returns HOOKE_STOPPED
 * and other failures. */
int32_t hk_needs_run_once(struct hk_needs_recorder *recorder, const hooke_options *options, int32_t *finished,
                          struct hk_needs_cost *cost);

/* Finds the largest step, or tolerance, whose error is at most a tenth of `want`, and the cost of that run;
 * `fine` is the path of the run with half the step, which for the full system may have an error of
 * `own_error`. If differences grow so fast that no step is small enough, step_error is that of the best; the
 * full system then determines how many frames are judged. It is NaN, and there is no path, if no run
 * finished. Returns HOOKE_STOPPED, HOOKE_NO_MEMORY and the like. */
int32_t hk_needs_measure(struct hk_needs *needs, const struct hk_needs_trial *trial,
                         struct hk_needs_cost *cost, struct hk_needs_path *fine);
/* Finds the largest step, or tolerance, with which a variant is within `want` of the full system, all errors
 * together, including that of the path of the full system: the recommended run. `error` is NaN, and there is
 * no path, if every such step is much smaller than that of the full system. */
int32_t hk_needs_fit(struct hk_needs *needs, const struct hk_needs_trial *trial, struct hk_needs_cost *cost,
                     struct hk_needs_path *path, double *error);
/* Distance of a variant from the full system at the steps of their costs; both may start displaced at random
 * by a hundredth of the wanted error. Infinity if it does not finish. */
int32_t hk_needs_compare(struct hk_needs *needs, const struct hk_needs_trial *trial,
                         const struct hk_needs_cost *cost, int32_t displaced, double *error);
/* Makes `by_step`, unless it is there: pieces beside others only read it. */
int32_t hk_needs_prepare(struct hk_needs *needs, int32_t displaced);
/* The least wall times of one or two runs, with the steps of their costs, repeated in turns so that both see
 * the same machine, for `most` seconds. */
int32_t hk_needs_find_times(struct hk_needs *needs, int32_t count, const struct hk_needs_trial *trial,
                            struct hk_needs_cost *const *cost, double most);
/* The largest stable step of a system, or a bound of it; NaN if neither is known [s]. */
double hk_needs_step_limit(struct hk_needs *needs, const hooke_system *system);
/* Sets the step or tolerances of a cost in options of a run. */
int32_t hk_needs_set_step(const struct hk_needs_cost *cost, hooke_options *run);

/* ---- needs_values.c ---- */

/* The watched quantities in the system of a trial, where some may be missing. Must be released. */
int32_t hk_needs_move_watched(const struct hk_needs *needs, const struct hk_needs_trial *trial,
                              struct hk_watched_list *moved);
/* Records them at the last recorded frame. */
void hk_needs_keep_values(const struct hk_needs *needs, const struct hk_needs_trial *trial,
                          const struct hk_watched_list *moved, const hooke_state *state,
                          struct hk_needs_path *path);

/* ---- needs_degree.c ---- */

/* Finds how far every number may be changed. */
int32_t hk_needs_run_degrees(struct hk_needs *needs);
/* Error of a variant by the step of the full system, or one that is stable where `limit` is asked for, which
 * may be NULL and receives its step limit: infinity if it does not finish, NaN where it would take many more
 * steps. */
int32_t hk_needs_try(struct hk_needs *needs, const struct hk_variant *variant, int32_t displaced,
                     double *error, double *limit);
void hk_needs_scale(const struct hk_needs *needs, const struct hk_needs_degree *degree, double factor,
                    struct hk_variant *variant);
double hk_needs_rung(int32_t k); /* 1, 2, 5, 10, 20, ... */

/* Number of the next degree, from this one on, that the lean system has changed; the count if there is none.
 */
int64_t hk_needs_next_changed(const struct hk_needs *needs, int64_t k);

/* ---- needs_lean.c, needs_soften.c ---- */

/* The recommended run of a candidate's variant; its error is NaN if it has none. */
int32_t hk_needs_try_lean(struct hk_needs *needs, struct hk_needs_lean *candidate);
/* Makes it the lean system. */
int32_t hk_needs_take(struct hk_needs *needs, struct hk_needs_lean *candidate);
void hk_needs_release(struct hk_needs_lean *candidate);
/* In evaluations of springs and particles: unlike time, this is reproducible. */
double hk_needs_work(const struct hk_needs_cost *cost);
/* Softens, makes heavier and damps less what limits the step of the lean system, as far as that saves work.
 */
int32_t hk_needs_soften(struct hk_needs *needs);

/* ---- needs.c, needs_rows.c, needs_lean.c, needs_refine.c ---- */

/* Runs the full system unless that was done. */
int32_t hk_needs_run_full(struct hk_needs *needs);
/* 1 if the motion is too small to show anything. */
int32_t hk_needs_rests(const struct hk_needs *needs);
int32_t hk_needs_run_rows(struct hk_needs *needs);
/* Runs a row of a part that is coarser than half with more cells; `finer` is 0 for other rows. */
int32_t hk_needs_run_finer(struct hk_needs *needs, struct hk_needs_row *row, int32_t *finer);
/* Number of finished rows; the others are queued behind them. */
int64_t hk_needs_known_rows(const struct hk_needs *needs);
/* Computes the table of ingredients, then the lean system; or the resolution of every part. A failure leaves
 * no results. */
int32_t hk_needs_find(struct hk_needs *needs);
void hk_needs_forget(struct hk_needs *needs); /* the table and the lean system */
int32_t hk_needs_refine(struct hk_needs *needs);

/* Runs `count` pieces from `first` on side by side: each fills its row, degree or part, and depends on no
 * other one. Those that would begin with `most` counted work of trials [s] behind them do not count; returns
 * in `counted`, unless NULL, how many do. */
typedef int32_t hk_needs_piece(struct hk_needs *own, int64_t number);
int32_t hk_needs_run_pieces(struct hk_needs *needs, int64_t first, int64_t count, hk_needs_piece *piece,
                            double most, int64_t *counted);

/* Calls the piece so in what progress says. */
void hk_needs_name(struct hk_needs *own, const char *what);

/* Reports the progress of one measurement; a non-zero result asks to stop. The second is that of a pick. */
int32_t hk_needs_tell(struct hk_needs *needs, double fraction);
int32_t hk_needs_tell_pick(double done, const char *what, void *needs);

/* ---- needs_tables.c ---- */

/* Time up to which changes are judged [s]. */
double hk_needs_judged_until(const struct hk_needs *needs);
/* Cells of a part along an axis at a factor on them; NaN without the axis, or the factor. */
double hk_needs_cells(const struct hk_needs_part *part, int32_t axis, double factor);

extern const struct hk_table hk_needs_tables[];

/* What they say of their results (needs_claims.c). */
void hk_needs_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_measurement_kind hk_needs_kind;
