#include "measure/quantity/watched_series.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

static int64_t count_of(const struct hk_watched_series *series) {
  return series->list ? series->list->count : 0;
}

int32_t hk_watched_series_create(const struct hk_watched_list *list, int64_t frames,
                                 struct hk_watched_series *series) {
  *series = (struct hk_watched_series){.list = NULL};
  if (list == NULL || list->count == 0) return HOOKE_OK;
  double *block = hk_new(list->count, ((size_t)frames + 1) * sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  *series = (struct hk_watched_series){list, frames, block, block + list->count * frames};
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

void hk_watched_series_keep(struct hk_watched_series *series, int64_t frame, const double *q,
                            const double *v) {
  for (int64_t k = 0; k < count_of(series); k++)
    hk_watched_series_of(series, k)[frame] =
        hk_watched_value(&series->list->item[k], series->list->system, q, v);
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
