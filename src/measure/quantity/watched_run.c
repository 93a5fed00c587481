/* Watched quantities over all steps of a run: the value at its end, and the extremes. */
#include "core/memory.h"
#include "measure/quantity/watched.h"

#include <math.h>
#include <string.h>

/* ---- extremes of a series ---- */

enum { POINTS = 5, SEARCHES = 80 };
static const double ALIKE = 0.5; /* least ratio of second differences about an extremum */

/* 1 if the curvatures at the three inner samples have one sign, against that of the extremum, and are alike.
 */
static int32_t is_smooth(const struct hk_extremes *e, double sign) {
  double least = INFINITY, most = 0.0;
  for (int k = 1; k < POINTS - 1; k++) {
    const double *t = e->time + k, *x = e->value + k;
    const double bend = ((x[1] - x[0]) / (t[1] - t[0]) - (x[0] - x[-1]) / (t[0] - t[-1])) / (t[1] - t[-1]);
    least = fmin(least, -sign * bend);
    most = fmax(most, -sign * bend);
  }
  return least > 0.0 && least >= ALIKE * most;
}

/* By parts of one third: the polynomial has one extremum there. */
static void search(const struct hk_extremes *e, double sign, double *at, double *value) {
  double low = e->time[1], high = e->time[3];
  for (int k = 0; k < SEARCHES; k++) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (sign * hk_interpolate(POINTS, e->time, e->value, a) <
        sign * hk_interpolate(POINTS, e->time, e->value, b))
      low = a;
    else
      high = b;
  }
  *at = 0.5 * (low + high);
  *value = hk_interpolate(POINTS, e->time, e->value, *at);
}

/* Whether the middle one of the last samples is an extremum, and beyond the one so far. It has the sign of
 * the sample, as no energy or length is below 0. */
static void look(struct hk_extremes *e, int k, double sign) {
  const double before = sign * e->value[1], middle = sign * e->value[2], after = sign * e->value[3];
  double at, value;
  if (!(middle >= before && middle >= after)) return;
  if (middle + fmax(middle - before, middle - after) <= e->most[k] || !is_smooth(e, sign)) return;
  search(e, sign, &at, &value);
  if (!(sign * value > e->most[k]) || value * e->value[2] < 0.0) return;
  e->most[k] = sign * value;
  e->at[k] = at;
}

void hk_extremes_see(struct hk_extremes *e, double t, double value) {
  if (!isfinite(value)) return;
  memmove(e->time, e->time + 1, (POINTS - 1) * sizeof(double));
  memmove(e->value, e->value + 1, (POINTS - 1) * sizeof(double));
  e->time[POINTS - 1] = t;
  e->value[POINTS - 1] = value;
  for (int k = 0; k < 2; k++) {
    const double sign = k ? -1.0 : 1.0;
    if (e->seen == 0 || sign * value > e->most[k]) {
      e->most[k] = sign * value;
      e->at[k] = t;
    }
    if (e->seen >= POINTS - 1) look(e, k, sign);
  }
  e->seen++;
}

/* ---- a run ---- */

static const struct hk_watched_result unknown = {NAN, NAN, NAN, NAN, NAN};

static int32_t has_periods(const struct hk_watched_list *list) {
  int32_t some = 0;
  for (int64_t k = 0; k < list->count; k++)
    some |= list->item[k].is_period;
  return some;
}

int32_t hk_watched_run_begin(const struct hk_watched_list *list, int64_t frames, struct hk_watched_run *run) {
  const int64_t count = list->count, kept = has_periods(list) ? frames : 0;
  *run = (struct hk_watched_run){.list = list, .from = NAN, .until = NAN, .good_until = NAN};
  if (count == 0) return HOOKE_OK;
  run->now = hk_new(2 * count, sizeof *run->now);
  run->result = hk_new(count, sizeof *run->result);
  run->value = hk_new(count + kept, sizeof(double));
  int32_t status = run->now && run->result && run->value ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && kept > 0) status = hk_watched_series_create(list, kept, &run->series);
  if (status != HOOKE_OK) {
    hk_watched_run_release(run);
    return status;
  }
  run->good = run->now + count;
  run->time = run->value + count;
  for (int64_t k = 0; k < count; k++)
    run->result[k] = unknown;
  return HOOKE_OK;
}

void hk_watched_run_release(struct hk_watched_run *run) {
  hk_free(run->now);
  hk_free(run->result);
  hk_free(run->value);
  hk_watched_series_release(&run->series);
  memset(run, 0, sizeof *run);
}

void hk_watched_run_see(struct hk_watched_run *run, double t, const double *q, const double *v) {
  if (run->result == NULL || t <= run->until) return;
  hk_watched_values(run->list, t, q, v, run->value);
  for (int64_t k = 0; k < run->list->count; k++)
    hk_extremes_see(&run->now[k], t, run->value[k]);
  if (isnan(run->from)) run->from = t;
  run->until = t;
}

void hk_watched_run_keep(struct hk_watched_run *run, double t, const double *q, const double *v) {
  if (run->result == NULL) return;
  hk_watched_run_see(run, t, q, v);
  memcpy(run->good, run->now, (size_t)run->list->count * sizeof *run->now);
  run->good_until = run->until;
  if (run->frames >= run->series.frames) return;
  run->time[run->frames] = t;
  hk_watched_series_keep(&run->series, run->frames++, t, q, v);
}

void hk_watched_run_end(struct hk_watched_run *run, double t, const double *q, const double *v) {
  if (run->result == NULL) return;
  const int32_t beyond = run->until > t;
  if (!beyond) hk_watched_run_see(run, t, q, v);
  const struct hk_extremes *extremes = beyond ? run->good : run->now;
  if (beyond) run->until = run->good_until;
  hk_watched_values(run->list, t, q, v, run->value);
  for (int64_t k = 0; k < run->list->count; k++) {
    const struct hk_extremes *e = &extremes[k];
    struct hk_watched_result *result = &run->result[k];
    *result = unknown;
    result->value = run->value[k];
    if (run->list->item[k].is_period)
      result->value = hk_watched_series_last(&run->series, k, run->frames, run->time);
    else if (run->follows && run->until > run->from)
      *result = (struct hk_watched_result){run->value[k], -e->most[1], e->at[1], e->most[0], e->at[0]};
  }
}
