/* Values of watched quantities, the period of one, and all of them over the frames of a run. */
#include "core/memory.h"
#include "measure/quantity/watched.h"
#include "model/force/drive.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

const char *hk_watched_unit(const struct hk_watched *watched) {
  return watched->is_period ? "s" : watched->what->unit;
}

/* ---- of springs ---- */

static double value_of_spring(enum hk_watched_kind kind, const hooke_system *system, int64_t number, double t,
                              const double *q, const double *v) {
  const struct hk_spring spring = hk_springs_find(system->springs, number, t);
  struct hk_stretch s;
  hk_spring_stretch(&spring, q, v, &s);
  if (kind == HOOKE_WATCHED_LENGTH) return s.length;
  const double rest = spring.rest_length;
  return kind == HOOKE_WATCHED_STRAIN ? (s.length - rest) / rest : s.tension;
}

static double value_over_group(const struct hk_watched *watched, const hooke_system *system, double t,
                               const double *q, const double *v) {
  const double sign = watched->smallest ? -1.0 : 1.0;
  double most = -INFINITY;
  for (int64_t g = 0, first = 0; g < hk_system_groups_of(system, &hk_force_springs);
       first += system->group[g++].count) {
    const char *name = system->group[g].name;
    if (name == NULL || strcmp(name, watched->group) != 0) continue;
    for (int64_t k = first; k < first + system->group[g].count; k++) {
      const double value = sign * value_of_spring(watched->what->kind, system, k, t, q, v);
      if (!(value <= most)) most = value;
      if (isnan(value)) return NAN;
    }
  }
  return sign * most;
}

/* ---- of supports ---- */

/* `force`: of all particles, by hooke_system_force(), which is without the weight of this one. */
static double value_of_support(const struct hk_watched *watched, const hooke_system *system, double t,
                               const double *force) {
  const int64_t p = watched->particle;
  const int32_t axis = watched->what->axis;
  double a[3] = {0.0}, reaction[3];
  if (watched->course) hk_course_acceleration(watched->course, t, a);
  hk_support_reaction(system, p, a, force + 3 * p, reaction);
  return axis < 0 ? hk_length3(reaction) : reaction[axis];
}

/* ---- of all ---- */

/* `force`: NULL without memory for them. */
static double value_of(const struct hk_watched *watched, const hooke_system *system, double t,
                       const double *q, const double *v, const double *force) {
  switch (watched->what->kind) {
  case HOOKE_WATCHED_COORDINATE:
    return q[3 * watched->particle + watched->what->axis];
  case HOOKE_WATCHED_REACTION:
    return force ? value_of_support(watched, system, t, force) : NAN;
  case HOOKE_WATCHED_ENERGY:
    return hooke_system_energy_at(system, "total", t, q, v);
  case HOOKE_WATCHED_KINETIC:
    return hooke_system_energy(system, "kinetic", NULL, v);
  case HOOKE_WATCHED_POTENTIAL:
    return hooke_system_energy_at(system, "potential", t, q, NULL);
  default:
    break;
  }
  return watched->group ? value_over_group(watched, system, t, q, v)
                        : value_of_spring(watched->what->kind, system, watched->spring, t, q, v);
}

void hk_watched_values(const struct hk_watched_list *list, double t, const double *q, const double *v,
                       double *value) {
  double *force = NULL;
  int32_t some = 0;
  for (int64_t k = 0; k < list->count; k++)
    some |= list->item[k].what->kind == HOOKE_WATCHED_REACTION;
  if (some) force = hk_new(3 * list->system->particle_count, sizeof(double));
  const int32_t known = force && hooke_system_force(list->system, t, q, v, force) == HOOKE_OK;
  for (int64_t k = 0; k < list->count; k++)
    value[k] = value_of(&list->item[k], list->system, t, q, v, known ? force : NULL);
  hk_free(force);
}

/* ---- periods ---- */

static const double LEAST_DIP = 0.1;    /* of the largest deviation, below the mean between two passages */
static const double ROUNDING = 1e-12;   /* of the largest value: a smaller variation counts as constant */
static const double LEAST_FRAMES = 4.0; /* frames a period; with fewer, passages may be missed */
enum { BISECTIONS = 52 };

static double mean_of(int64_t count, const double *time, const double *value) {
  double sum = 0.0;
  for (int64_t f = 1; f < count; f++)
    sum += 0.5 * (value[f - 1] + value[f]) * (time[f] - time[f - 1]);
  return sum / (time[count - 1] - time[0]);
}

double hk_interpolate(int points, const double *time, const double *value, double t) {
  double sum = 0.0;
  for (int i = 0; i < points; i++) {
    double weight = 1.0;
    for (int j = 0; j < points; j++)
      if (j != i) weight *= (t - time[j]) / (time[i] - time[j]);
    sum += weight * value[i];
  }
  return sum;
}

/* Time at which the series rises to `level` between frames f - 1 and f. */
static double passage(int64_t count, const double *time, const double *value, int64_t f, double level) {
  const int64_t first = f >= 2 ? f - 2 : 0, last = f + 1 < count ? f + 1 : f;
  double low = time[f - 1], high = time[f];
  for (int k = 0; k < BISECTIONS; k++) {
    const double middle = 0.5 * (low + high);
    const int points = (int)(last - first) + 1;
    if (hk_interpolate(points, time + first, value + first, middle) < level)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

double hk_watched_period(int64_t count, const double *time, const double *value) {
  double farthest = 0.0, largest = 0.0, begun = NAN, ended = NAN;
  int64_t passages = 0;
  if (count < 2) return NAN;
  const double mean = mean_of(count, time, value);
  if (!isfinite(mean)) return NAN;
  for (int64_t f = 0; f < count; f++) {
    farthest = fmax(farthest, fabs(value[f] - mean));
    largest = fmax(largest, fabs(value[f]));
  }
  if (farthest <= ROUNDING * largest) return NAN;
  int32_t dipped = 0;
  for (int64_t f = 0; f < count; f++) {
    if (value[f] < mean - LEAST_DIP * farthest) dipped = 1;
    if (!dipped || value[f] < mean) continue;
    dipped = 0;
    ended = passage(count, time, value, f, mean);
    if (passages++ == 0) begun = ended;
  }
  if (passages < 2) return NAN;
  const double period = (ended - begun) / (double)(passages - 1);
  return period >= LEAST_FRAMES * (time[1] - time[0]) ? period : NAN; /* the last two may be closer */
}

/* ---- over a run ---- */

static int64_t count_of(const struct hk_watched_series *series) {
  return series->list ? series->list->count : 0;
}

int32_t hk_watched_series_create(const struct hk_watched_list *list, int64_t frames,
                                 struct hk_watched_series *series) {
  *series = (struct hk_watched_series){.list = NULL};
  if (list == NULL || list->count == 0) return HOOKE_OK;
  double *block = hk_new(list->count, ((size_t)frames + 2) * sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  double *figure = block + list->count * frames;
  *series = (struct hk_watched_series){list, frames, NULL, block, figure, figure + list->count};
  hk_watched_series_clear(series);
  return HOOKE_OK;
}

void hk_watched_series_release(struct hk_watched_series *series) {
  hk_free(series->value);
  memset(series, 0, sizeof *series);
}

void hk_watched_series_clear(struct hk_watched_series *series) {
  for (int64_t k = 0; k < count_of(series) * (series->frames + 1); k++)
    series->value[k] = NAN; /* and the figures behind them */
}

void hk_watched_series_keep(struct hk_watched_series *series, int64_t frame, double t, const double *q,
                            const double *v) {
  if (series->list == NULL) return;
  hk_watched_values(series->list, t, q, v, series->now);
  for (int64_t k = 0; k < count_of(series); k++)
    hk_watched_series_of(series, k)[frame] = series->now[k];
}

double hk_watched_series_last(const struct hk_watched_series *series, int64_t quantity, int64_t frames,
                              const double *time) {
  const double *value = hk_watched_series_of(series, quantity);
  if (series->list->item[quantity].is_period) return hk_watched_period(frames, time, value);
  return frames > 0 ? value[frames - 1] : NAN;
}

/* The start alone says nothing. */
static double largest_difference(int64_t frames, const double *a, const double *b) {
  double largest = 0.0;
  for (int64_t f = 0; f < frames; f++) {
    const double difference = fabs(a[f] - b[f]);
    if (!(difference <= largest)) largest = difference;
    if (isnan(difference)) break;
  }
  return frames > 1 ? largest : NAN;
}

void hk_watched_series_compare(struct hk_watched_series *series, const struct hk_watched_series *other,
                               int64_t frames, const double *time, double factor) {
  if (other->list == NULL) return;
  for (int64_t k = 0; k < count_of(series); k++) {
    const double *a = hk_watched_series_of(series, k), *b = hk_watched_series_of(other, k);
    series->figure[k] =
        factor * (series->list->item[k].is_period
                      ? fabs(hk_watched_period(frames, time, a) - hk_watched_period(frames, time, b))
                      : largest_difference(frames, a, b));
  }
}
