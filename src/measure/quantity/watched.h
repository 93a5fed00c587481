/* Watched quantities: observables of a motion, given as text.
 *
 *     57.x  57.y  57.z  tip.x                    a coordinate of a particle [m], by its number or name
 *     line:0.y                                   the same, of a particle of a part
 *     57.reaction  .reaction_x  _y  _z           the force of the support of a pinned or driven particle [N]
 *     line.stretch:3.length  .strain  .tension   of a spring of a group [m], [1], [N]
 *     line.stretch:max.tension  :min.length      the largest or smallest of a group
 *     energy  kinetic  potential                 of everything that is free [J]
 *     period:57.y                                the mean time between passages upwards of any of these [s]
 *
 * Indices begin at 0. Several are separated by commas. watched.c also reads the selection of `needs`: a part,
 * a group, or particles such as 0,7-9,tip. */
#pragma once

#include "model/course.h"
#include "model/force/spring.h"

/* For the texts of options. */
#define HOOKE_WATCHED_FORMS                                                                                  \
  "57.y or tip.y (a particle), part:0.y, 57.reaction or .reaction_y (the support of a pinned or driven "     \
  "particle), group:3.length, .strain or .tension (a spring), group:max.tension or group:min.tension, "      \
  "energy, kinetic, potential, or period:57.y, separated by commas"

/* What a quantity is of. */
enum hk_watched_holder {
  HOOKE_WATCHED_PARTICLE,
  HOOKE_WATCHED_SUPPORT,
  HOOKE_WATCHED_SPRING,
  HOOKE_WATCHED_SCENE,
  HOOKE_WATCHED_HOLDERS
};
enum hk_watched_kind {
  HOOKE_WATCHED_COORDINATE,
  HOOKE_WATCHED_REACTION,
  HOOKE_WATCHED_LENGTH,
  HOOKE_WATCHED_STRAIN,
  HOOKE_WATCHED_TENSION,
  HOOKE_WATCHED_ENERGY,
  HOOKE_WATCHED_KINETIC,
  HOOKE_WATCHED_POTENTIAL
};

/* A word of the grammar. */
struct hk_watched_word {
  const char *word, *unit;
  enum hk_watched_holder of;
  enum hk_watched_kind kind;
  int32_t axis; /* -1: none, or the magnitude */
};

struct hk_watched {
  char *text; /* as it was written */
  const struct hk_watched_word *what;
  int32_t is_period;              /* of the quantity inside */
  int64_t particle;               /* of a coordinate or a reaction */
  const struct hk_course *course; /* of the drive of a particle with a reaction; NULL: none */
  int64_t spring;                 /* its number: of a length, strain or tension */
  const char *group; /* or its largest or smallest over the groups of that name; NULL: of the spring */
  int32_t smallest;
};

struct hk_watched_list {
  const hooke_system *system;
  int64_t count;
  struct hk_watched *item;
};

/* Adds the quantities in `text` to a list, which starts as zeros with the committed system; repeated ones are
 * not added again. HOOKE_BAD_VALUE, for the option `where`; HOOKE_NO_MEMORY. In either case the list
 * keeps its contents. */
int32_t hk_watched_read(struct hk_watched_list *list, const char *where, const char *text);
/* The same for quantities that have a value at every time: none is a period. */
int32_t hk_watched_read_over_time(struct hk_watched_list *list, const char *where, const char *text);
void hk_watched_release(struct hk_watched_list *list);
/* 1 if the text is a quantity of the whole scene. */
int32_t hk_watched_is_of_scene(const char *text);
/* Number of the quantity with that text; -1 if there is none. */
int64_t hk_watched_find(const struct hk_watched_list *list, const char *text);

/* Sets mark[p] to 1 for the particles of a part, of a group or of a list of numbers and names.
 * HOOKE_BAD_VALUE. */
int32_t hk_watched_mark_particles(const hooke_system *system, const char *where, const char *text,
                                  uint8_t *mark);

/* "m", "N", "J", "s", "" */
const char *hk_watched_unit(const struct hk_watched *watched);

/* Values of a list at positions q and velocities v (rows); for a period that of its quantity. Tension is the
 * force along the spring, including damping: positive where it pulls its ends together, 0 where a spring that
 * only pulls is slack. A reaction is m a - f: m the mass as given, a the acceleration of the drive, 0 where
 * pinned and in overdamped systems, f all forces on the particle and its own weight. Reactions take one
 * evaluation of the forces, callbacks included; NaN if one stops it, and without memory. */
void hk_watched_values(const struct hk_watched_list *list, double t, const double *q, const double *v,
                       double *value);

/* Lagrange's polynomial through `points` of a series at time t. */
double hk_interpolate(int points, const double *time, const double *value, double t);

/* Mean time between upward passages of a series through its mean, each found by cubic interpolation. A
 * passage counts if the series was below the mean by a tenth of its largest deviation since the last one. NaN
 * if there are fewer than two, or fewer than four frames from one to the next, or a non-finite number. */
double hk_watched_period(int64_t count, const double *time, const double *value);

/* Watched quantities over the frames of a run, and their differences between two runs. */
struct hk_watched_series {
  const struct hk_watched_list *list; /* NULL: nothing is watched */
  int64_t frames;
  const double *time; /* of the frames, where it is given */
  double *value;      /* one quantity after another, `frames` each; NaN where missing */
  double *figure;     /* by quantity: difference from another run */
  double *now;        /* by quantity: of one frame */
};

/* Allocates space for so many frames, all NaN. HOOKE_NO_MEMORY. */
int32_t hk_watched_series_create(const struct hk_watched_list *list, int64_t frames,
                                 struct hk_watched_series *series);
void hk_watched_series_release(struct hk_watched_series *series);
void hk_watched_series_clear(struct hk_watched_series *series);

static inline double *hk_watched_series_of(const struct hk_watched_series *series, int64_t quantity) {
  return series->value + quantity * series->frames;
}

/* Records the values at a frame. */
void hk_watched_series_keep(struct hk_watched_series *series, int64_t frame, double t, const double *q,
                            const double *v);

/* Of the first `frames` frames at `time`: the value at the last, or the period over them. */
double hk_watched_series_last(const struct hk_watched_series *series, int64_t quantity, int64_t frames,
                              const double *time);

/* Sets the differences to `factor` times the largest one over the first `frames` frames at `time`; for a
 * period to the difference of the periods over these frames; NaN if that is unknown, or without a frame after
 * the first. Does nothing if the other series watches nothing. */
void hk_watched_series_compare(struct hk_watched_series *series, const struct hk_watched_series *other,
                               int64_t frames, const double *time, double factor);

/* ---- over all steps of a run ---- */

/* Smallest and largest of a series, and when: the samples, or between them, where three successive second
 * differences have one sign and no one is twice another, the extremum of the polynomial through five. So no
 * kink, and no stop where a spring is slack, is overshot. */
struct hk_extremes {
  int64_t seen;
  int32_t lost;             /* 1: a number was not finite, and they are not known */
  double time[5], value[5]; /* the last samples */
  double at[2], most[2];    /* of value and of -value */
};
void hk_extremes_see(struct hk_extremes *extremes, double t, double value);

struct hk_watched_result {
  double value, minimum, at_minimum, maximum, at_maximum;
};

struct hk_watched_run {
  const struct hk_watched_list *list;
  double from, until, good_until;   /* times of the first and the last sample, and of that of `good` */
  int32_t follows;                  /* 1: it sees every step, not frames alone */
  struct hk_extremes *now, *good;   /* by quantity; the second at the last frame */
  struct hk_watched_result *result; /* NULL before a run began */
  double *value, *time;             /* of a sample; and of the frames, */
  struct hk_watched_series series;  /* for periods */
  int64_t frames;
};

/* Nothing if nothing is watched. HOOKE_NO_MEMORY. */
int32_t hk_watched_run_begin(const struct hk_watched_list *list, int64_t frames, struct hk_watched_run *run);
void hk_watched_run_release(struct hk_watched_run *run);
/* A state of a step; times that were passed already are left out. And a frame, which passed the check for
 * divergence. */
void hk_watched_run_see(struct hk_watched_run *run, double t, const double *q, const double *v);
void hk_watched_run_keep(struct hk_watched_run *run, double t, const double *q, const double *v);
/* Makes the results: values at this last state, extremes up to it, or up to the last frame where steps after
 * it were seen. NaN where unknown: extremes of a period and of a run of which only frames were seen. */
void hk_watched_run_end(struct hk_watched_run *run, double t, const double *q, const double *v);
