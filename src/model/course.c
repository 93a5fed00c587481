#include "model/course.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/sine.h"
#include "core/status.h"
#include "model/check_value.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* ---- cubics ---- */

/* The two intervals about sample k, at an end the first or last two: widths and secants; the distance of the
 * sample from the middle one; -1, 1: an end. */
struct neighbours {
  double h0, h1, s0, s1, off;
  int end;
};

typedef double slope_from(const struct neighbours *n);

static double slope_at(int64_t m, int32_t width, const double *x, const double *p, int64_t k,
                       slope_from *from) {
  if (m == 2) return (p[width] - p[0]) / (x[1] - x[0]);
  const int64_t i = k == 0 ? 1 : k == m - 1 ? m - 2 : k;
  struct neighbours n = {x[i] - x[i - 1], x[i + 1] - x[i], .off = x[k] - x[i], .end = (k > i) - (k < i)};
  n.s0 = (p[width * i] - p[width * (i - 1)]) / n.h0;
  n.s1 = (p[width * (i + 1)] - p[width * i]) / n.h1;
  return from(&n);
}

static double parabolic(const struct neighbours *n) {
  const double curve = (n->s1 - n->s0) / (n->h0 + n->h1); /* half the second derivative */
  return n->s0 + curve * (n->h0 + 2.0 * n->off);
}

void hk_parabolic_slopes(int64_t samples, int32_t width, const double *x, const double *value,
                         double *slope) {
  for (int64_t k = 0; k < width * samples; k++)
    slope[k] = slope_at(samples, width, x, value + k % width, k / width, parabolic);
}

/* By three points, limited so that the cubic of the first interval is monotone. */
static double slope_at_end(double h0, double h1, double s0, double s1) {
  const double slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
  if (slope * s0 <= 0.0) return 0.0;
  return s0 * s1 < 0.0 && fabs(slope) > 3.0 * fabs(s0) ? 3.0 * s0 : slope;
}

static double monotone(const struct neighbours *n) {
  if (n->end < 0) return slope_at_end(n->h0, n->h1, n->s0, n->s1);
  if (n->end > 0) return slope_at_end(n->h1, n->h0, n->s1, n->s0);
  if (n->s0 * n->s1 <= 0.0) return 0.0;
  const double w0 = 2.0 * n->h1 + n->h0, w1 = n->h1 + 2.0 * n->h0;
  return (w0 + w1) / (w0 / n->s0 + w1 / n->s1);
}

void hk_monotone_slopes(int64_t samples, int32_t width, const double *x, const double *value, double *slope) {
  for (int64_t k = 0; k < width * samples; k++)
    slope[k] = slope_at(samples, width, x, value + k % width, k / width, monotone);
}

int64_t hk_interval(int64_t samples, const double *x, double at) {
  int64_t low = 0, high = samples - 1;
  while (high - low > 1) {
    const int64_t middle = low + (high - low) / 2;
    if (x[middle] <= at)
      low = middle;
    else
      high = middle;
  }
  return low;
}

void hk_cubic(double width, const double value[2], const double slope[2], double s, double *at,
              double *rate) {
  const double m0 = width * slope[0], m1 = width * slope[1], rise = value[1] - value[0];
  const double c2 = 3.0 * rise - 2.0 * m0 - m1, c3 = 2.0 * (value[0] - value[1]) + m0 + m1;
  *at = value[0] + s * (m0 + s * (c2 + s * c3));
  *rate = (m0 + s * (2.0 * c2 + s * (3.0 * c3))) / width;
}

/* ---- building ---- */

static int32_t check_table(const char *name, int64_t samples, int32_t width, const double *time,
                           const double *value) {
  if (samples < 2)
    return hk_fail(HOOKE_BAD_VALUE, "time", "%lld samples; a table needs 2 or more", (long long)samples);
  for (int64_t k = 0; k < samples; k++) {
    if (isfinite(time[k]) && (k == 0 || time[k] > time[k - 1])) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; times are finite and ascend", time[k]);
    return hk_fail_within(HOOKE_BAD_VALUE, "time[%lld]", (long long)k);
  }
  return hk_require_finite(name, samples, width, value);
}

static int32_t take_table(struct hk_course *course, int64_t samples, const double *time,
                          const double *value) {
  const int64_t numbers = course->width * samples;
  course->samples = samples;
  course->time = hk_new(samples, sizeof(double));
  course->value = hk_new(numbers, sizeof(double));
  course->slope = hk_new(numbers, sizeof(double));
  if (course->time == NULL || course->value == NULL || course->slope == NULL) return HOOKE_NO_MEMORY;
  memcpy(course->time, time, (size_t)samples * sizeof(double));
  memcpy(course->value, value, (size_t)numbers * sizeof(double));
  return HOOKE_OK;
}

int32_t hk_course_set_table(struct hk_course *course, const char *name, int64_t samples, const double *time,
                            const double *value, hk_slopes *slopes) {
  int32_t status = check_table(name, samples, course->width, time, value);
  if (status == HOOKE_OK) status = take_table(course, samples, time, value);
  if (status == HOOKE_OK) slopes(samples, course->width, time, value, course->slope);
  return status;
}

int32_t hk_course_copy(const struct hk_course *from, struct hk_course *to) {
  *to = *from;
  to->time = to->value = to->slope = NULL;
  if (from->samples == 0) return HOOKE_OK;
  const int32_t status = take_table(to, from->samples, from->time, from->value);
  if (status == HOOKE_OK)
    memcpy(to->slope, from->slope, (size_t)(from->width * from->samples) * sizeof(double));
  return status;
}

void hk_course_release(struct hk_course *course) {
  hk_free(course->time);
  hk_free(course->value);
  hk_free(course->slope);
  course->time = course->value = course->slope = NULL;
}

/* ---- from options ---- */

struct name {
  char text[64];
};

static const char *within(const char *prefix, const char *name, struct name *whole) {
  hk_print(whole->text, sizeof whole->text, "%s%s", prefix, name);
  return whole->text;
}

static int32_t table_from_options(struct hk_course *course, const hooke_options *options, const char *prefix,
                                  const char *values, hk_slopes *slopes) {
  struct name name;
  const int64_t samples = hooke_options_number_count(options, within(prefix, "time", &name));
  const double *time = hooke_options_numbers(options, name.text);
  const int64_t rows = hooke_options_number_count(options, within(prefix, values, &name)) / course->width;
  if (rows != samples)
    return hk_fail(HOOKE_BAD_VALUE, values, "%lld rows given; allowed: %lld, one for each time",
                   (long long)rows, (long long)samples);
  return hk_course_set_table(course, values, samples, time, hooke_options_numbers(options, name.text),
                             slopes);
}

int32_t hk_course_from_options(struct hk_course *course, const hooke_options *options, const char *prefix,
                               const char *amplitude, const char *values, hk_slopes *slopes) {
  struct name name;
  const char *motion = hooke_options_text(options, within(prefix, "motion", &name));
  if (strcmp(motion, "harmonic") == 0) {
    memcpy(course->amplitude, hooke_options_numbers(options, within(prefix, amplitude, &name)),
           (size_t)course->width * sizeof(double));
    course->frequency = hooke_options_number(options, within(prefix, "frequency", &name));
    course->phase = hooke_options_number(options, within(prefix, "phase", &name));
    return HOOKE_OK;
  }
  const int32_t status = table_from_options(course, options, prefix, values, slopes);
  const int outer = (int)strlen(prefix) - 1;
  return status && outer > 0 ? hk_fail_within(status, "%.*s", outer, prefix) : status;
}

/* ---- values ---- */

static const double two_pi = 6.28318530717958647693;

static void harmonic_at(const struct hk_course *course, double t, double *value, double *rate) {
  double sine, cosine;
  hk_sine_of_turns(course->frequency * t + course->phase / two_pi, &sine, &cosine);
  for (int32_t a = 0; a < course->width; a++) {
    value[a] = course->mean[a] + course->amplitude[a] * sine;
    rate[a] = course->amplitude[a] * (two_pi * course->frequency) * cosine;
  }
}

static void table_at(const struct hk_course *course, double t, double *value, double *rate) {
  const double *time = course->time;
  const int64_t last = course->samples - 1;
  const int32_t width = course->width;
  if (t <= time[0] || t >= time[last]) {
    memcpy(value, course->value + (t <= time[0] ? 0 : width * last), (size_t)width * sizeof(double));
    memset(rate, 0, (size_t)width * sizeof(double));
    return;
  }
  const int64_t k = hk_interval(course->samples, time, t);
  const double length = time[k + 1] - time[k];
  for (int32_t a = 0; a < width; a++) {
    const double *p = course->value + width * k + a, *m = course->slope + width * k + a;
    hk_cubic(length, (double[]){p[0], p[width]}, (double[]){m[0], m[width]}, (t - time[k]) / length,
             &value[a], &rate[a]);
  }
}

void hk_course_at(const struct hk_course *course, double t, double *value, double *rate) {
  double ignored[HOOKE_COURSE_WIDTH];
  (course->samples > 0 ? table_at : harmonic_at)(course, t, value, rate ? rate : ignored);
}

void hk_course_acceleration(const struct hk_course *course, double t, double *acceleration) {
  const int64_t n = course->samples, k = n > 0 ? hk_interval(n, course->time, t) : 0;
  const int32_t held = n > 0 && (t <= course->time[0] || t >= course->time[n - 1]);
  const double omega = two_pi * course->frequency;
  double value[HOOKE_COURSE_WIDTH];
  if (n == 0) hk_course_at(course, t, value, NULL);
  for (int32_t a = 0; a < course->width; a++) {
    acceleration[a] = n == 0 ? -omega * omega * (value[a] - course->mean[a]) : 0.0;
    if (n == 0 || held) continue;
    const double *p = course->value + course->width * k + a, *m = course->slope + course->width * k + a;
    const double h = course->time[k + 1] - course->time[k], s = (t - course->time[k]) / h;
    const double rise = p[course->width] - p[0], m0 = h * m[0], m1 = h * m[course->width];
    acceleration[a] = (2.0 * (3.0 * rise - 2.0 * m0 - m1) + 6.0 * s * (m0 + m1 - 2.0 * rise)) / (h * h);
  }
}

int64_t hk_course_range(const struct hk_course *course, double *low, double *high) {
  int64_t lowest = 0;
  if (course->samples == 0) {
    const double mean = course->mean[0], amplitude = fabs(course->amplitude[0]);
    hk_course_at(course, 0.0, low, NULL);
    *high = *low;
    if (course->frequency == 0.0) return -1;
    *low = mean - amplitude;
    *high = mean + amplitude;
    return -1;
  }
  *low = *high = course->value[0];
  for (int64_t k = 1; k < course->samples; k++) {
    if (course->value[k] < *low) lowest = k;
    *low = fmin(*low, course->value[k]);
    *high = fmax(*high, course->value[k]);
  }
  return lowest;
}

void hk_course_check(const struct hk_course *course, uint32_t *value) {
  hk_check_add(value, course->mean, HOOKE_COURSE_WIDTH, sizeof(double));
  hk_check_add(value, course->amplitude, HOOKE_COURSE_WIDTH, sizeof(double));
  hk_check_add(value, &course->frequency, 1, sizeof(double));
  hk_check_add(value, &course->phase, 1, sizeof(double));
  hk_check_whole(value, course->samples);
  hk_check_add(value, course->time, course->samples, sizeof(double));
  hk_check_add(value, course->value, course->width * course->samples, sizeof(double));
}
