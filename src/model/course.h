/* A course: numbers that follow time, by a sine or by a table. Displacements of drives, loads, winds and
 * factors of springs are courses. */
#pragma once

#include "hooke/options.h"

enum { HOOKE_COURSE_WIDTH = 3 };

/* mean + amplitude sin(2 pi frequency t + phase), and, with a table, a piecewise cubic through its values,
 * held before the first and after the last: by the slopes of parabolas, or by slopes that keep it monotone.
 * A course of no table and no frequency is its mean. */
struct hk_course {
  int32_t width; /* numbers at each time, up to HOOKE_COURSE_WIDTH */
  double mean[HOOKE_COURSE_WIDTH], amplitude[HOOKE_COURSE_WIDTH], frequency, phase;
  int64_t samples;              /* 0: no table */
  double *time, *value, *slope; /* samples, and `width` numbers for each */
};

/* The slope at every sample of `width` columns of a table: of the parabola through it and its neighbours, at
 * the ends through the first or last three; or, `monotone`, those of Fritsch and Butland (1984), by which the
 * cubic has no extremum between samples. */
typedef void hk_slopes(int64_t samples, int32_t width, const double *x, const double *value, double *slope);
hk_slopes hk_parabolic_slopes;
hk_slopes hk_monotone_slopes;

/* The interval [x[k], x[k + 1]] that holds `at`, the first or last one beyond the ends. */
int64_t hk_interval(int64_t samples, const double *x, double at);
/* The cubic of an interval of that width, with the values and slopes at its ends, at fraction s of it: value
 * and derivative. */
void hk_cubic(double width, const double value[2], const double slope[2], double s, double *at, double *rate);

/* Takes a table over, copied. HOOKE_BAD_VALUE at "time[k]" or "<name>[k]", HOOKE_NO_MEMORY; afterwards, too,
 * hk_course_release() releases it. */
int32_t hk_course_set_table(struct hk_course *course, const char *name, int64_t samples, const double *time,
                            const double *value, hk_slopes *slopes);
/* The same of options "<prefix>motion" (harmonic: the option of that amplitude, frequency, phase; table: time
 * and the option of these values), whose rows are those of drives (io/scene/scene_tables.c). */
int32_t hk_course_from_options(struct hk_course *course, const hooke_options *options, const char *prefix,
                               const char *amplitude, const char *values, hk_slopes *slopes);
/* HOOKE_NO_MEMORY; the copy is to be released then, too. */
int32_t hk_course_copy(const struct hk_course *from, struct hk_course *to);
void hk_course_release(struct hk_course *course);

/* The rows that options of a course have beside its numbers: of the choice `chosen` (NULL: the first row),
 * with examples of a frequency and of times. For files that see core/table/option.h. */
#define HOOKE_COURSE_OPTIONS(chosen, often, when)                                                            \
  HOOKE_OPTION("frequency", HOOKE_OPTION_NOT_NEGATIVE("Hz"), NULL, "oscillations a second", .required = 1,   \
               .by = (chosen), .only = "harmonic", .example = (often)),                                      \
      HOOKE_OPTION("phase", .type = HOOKE_OPTION_NUMBER, "0", "angle at time 0", .unit = "rad",              \
                   .by = (chosen), .only = "harmonic"),                                                      \
      HOOKE_OPTION("time", HOOKE_OPTION_COUNTED(2, 0), NULL, "ascending times", .unit = "s", .required = 1,  \
                   .by = (chosen), .only = "table", .example = (when))

/* The numbers at time t, and their rates, which may be NULL. */
void hk_course_at(const struct hk_course *course, double t, double *value, double *rate);

/* Their second derivatives; of a table those of its cubics, which jump at its times. */
void hk_course_acceleration(const struct hk_course *course, double t, double *acceleration);

/* Bounds of the number of a course of one, at all times, of a table whose slopes are monotone; returns the
 * sample that is the lowest, -1 without a table. */
int64_t hk_course_range(const struct hk_course *course, double *low, double *high);

/* Adds everything to a check value. */
void hk_course_check(const struct hk_course *course, uint32_t *value);
