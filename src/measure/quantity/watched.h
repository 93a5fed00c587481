/* Watched quantities: observables of a motion, given as text.
 *
 *     57.x  57.y  57.z  tip.x                    a coordinate of a particle [m], by its number or name
 *     line:0.y                                   the same, of a particle of a part
 *     line.stretch:3.length  .strain  .tension   of a spring of a group [m], [1], [N]
 *     energy  kinetic  potential                 of everything that is free [J]
 *     period:57.y                                the mean time between passages upwards of any of these [s]
 *
 * Indices begin at 0. Several are separated by commas. watched.c also reads the selection of `needs`: a part,
 * a group, or particles such as 0,7-9,tip. */
#ifndef HOOKE_MEASURE_QUANTITY_WATCHED_H
#define HOOKE_MEASURE_QUANTITY_WATCHED_H

#include "model/force/spring.h"

enum hk_watched_kind {
  HOOKE_WATCHED_COORDINATE,
  HOOKE_WATCHED_LENGTH,
  HOOKE_WATCHED_STRAIN,
  HOOKE_WATCHED_TENSION,
  HOOKE_WATCHED_ENERGY,
  HOOKE_WATCHED_KINETIC,
  HOOKE_WATCHED_POTENTIAL
};

struct hk_watched {
  char *text; /* as it was written */
  enum hk_watched_kind kind;
  int32_t is_period; /* of the quantity inside */
  int32_t axis;
  int64_t particle; /* of a coordinate */
  int64_t spring;   /* its number: of a length, strain or tension */
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
/* Number of the quantity with that text; -1 if there is none. */
int64_t hk_watched_find(const struct hk_watched_list *list, const char *text);

/* Sets mark[p] to 1 for the particles of a part, of a group or of a list of numbers and names.
 * HOOKE_BAD_VALUE. */
int32_t hk_watched_mark_particles(const hooke_system *system, const char *where, const char *text,
                                  uint8_t *mark);

/* "m", "N", "J", "s", "" */
const char *hk_watched_unit(const struct hk_watched *watched);

/* Value at positions q and velocities v (rows); for a period the value of its quantity. Tension is the force
 * along the spring, including damping: positive where it pulls its ends together, 0 where a spring that only
 * pulls is slack. */
double hk_watched_value(const struct hk_watched *watched, const hooke_system *system, double t,
                        const double *q, const double *v);

/* Mean time between upward passages of a series through its mean, each found by cubic interpolation. A
 * passage counts if the series was below the mean by a tenth of its largest deviation since the last one. NaN
 * if there are fewer than two, or fewer than four frames from one to the next, or a non-finite number. */
double hk_watched_period(int64_t count, const double *time, const double *value);

/* Watched quantities over the frames of a run, and their differences between two runs. */
struct hk_watched_series {
  const struct hk_watched_list *list; /* NULL: nothing is watched */
  int64_t frames;
  double *value;  /* one quantity after another, `frames` each; NaN where missing */
  double *figure; /* by quantity: difference from another run */
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

/* Sets the differences to `factor` times the largest one over the first `frames` frames at `time`; for a
 * period to the difference of the periods over these frames; NaN if that is unknown, or without a frame after
 * the first. Does nothing if the other series watches nothing. */
void hk_watched_series_compare(struct hk_watched_series *series, const struct hk_watched_series *other,
                               int64_t frames, const double *time, double factor);

#endif
