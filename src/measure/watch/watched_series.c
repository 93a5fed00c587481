#include "measure/watch/watched_series.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

static int64_t count_of(const struct hooke_watched_series *series) {
  return series->list ? series->list->count : 0;
}

int32_t hooke_watched_series_create(const struct hooke_watched_list *list, int64_t frames,
                                    struct hooke_watched_series *series) {
  *series = (struct hooke_watched_series){.list = NULL};
  if (list == NULL || list->count == 0) return HOOKE_OK;
  series->list = list;
  series->frames = frames;
  series->value = hooke_new(frames, (size_t)list->count * sizeof(double));
  series->figure = hooke_new(list->count, sizeof(double));
  if (series->value == NULL || series->figure == NULL) {
    hooke_watched_series_release(series);
    return HOOKE_NO_MEMORY;
  }
  hooke_watched_series_clear(series);
  return HOOKE_OK;
}

void hooke_watched_series_release(struct hooke_watched_series *series) {
  hooke_free(series->value);
  hooke_free(series->figure);
  memset(series, 0, sizeof *series);
}

void hooke_watched_series_clear(struct hooke_watched_series *series) {
  for (int64_t k = 0; k < count_of(series) * series->frames; k++)
    series->value[k] = NAN;
  for (int64_t k = 0; k < count_of(series); k++)
    series->figure[k] = NAN;
}

void hooke_watched_series_keep(struct hooke_watched_series *series, int64_t frame, const double *q,
                               const double *v) {
  for (int64_t k = 0; k < count_of(series); k++)
    hooke_watched_series_of(series, k)[frame] =
        hooke_watched_value(&series->list->item[k], series->list->system, q, v);
}

static double largest_difference(int64_t frames, const double *a, const double *b) {
  double largest = 0.0;
  for (int64_t f = 0; f < frames; f++) {
    const double difference = fabs(a[f] - b[f]);
    if (!(difference <= largest)) largest = difference;
    if (isnan(difference)) break;
  }
  return frames > 0 ? largest : NAN;
}

void hooke_watched_series_compare(struct hooke_watched_series *series,
                                  const struct hooke_watched_series *other, int64_t frames,
                                  const double *time, double factor) {
  if (other->list == NULL) return;
  for (int64_t k = 0; k < count_of(series); k++) {
    const double *a = hooke_watched_series_of(series, k), *b = hooke_watched_series_of(other, k);
    series->figure[k] =
        factor * (series->list->item[k].is_period
                      ? fabs(hooke_watched_period(frames, time, a) - hooke_watched_period(frames, time, b))
                      : largest_difference(frames, a, b));
  }
}

const double *hooke_watched_series_find(const struct hooke_watched_series *series, const char *text) {
  const int64_t k = series->list ? hooke_watched_find(series->list, text) : -1;
  return k < 0 ? NULL : hooke_watched_series_of(series, k);
}

double hooke_watched_series_figure(const struct hooke_watched_series *series, const char *text) {
  const int64_t k = series->list ? hooke_watched_find(series->list, text) : -1;
  return k < 0 ? NAN : series->figure[k];
}
