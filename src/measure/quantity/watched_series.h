/* Watched quantities over the frames of a run, and how far those of two runs are apart. */
#ifndef HOOKE_MEASURE_QUANTITY_WATCHED_SERIES_H
#define HOOKE_MEASURE_QUANTITY_WATCHED_SERIES_H

#include "measure/quantity/watched.h"

struct hk_watched_series {
  const struct hk_watched_list *list; /* NULL: nothing is watched */
  int64_t frames;
  double *value;  /* one quantity after another, `frames` each; NaN where there is none */
  double *figure; /* one a quantity: how far it is from another run's */
};

/* Room for so many frames, all NaN. HOOKE_NO_MEMORY. */
int32_t hk_watched_series_create(const struct hk_watched_list *list, int64_t frames,
                                 struct hk_watched_series *series);
void hk_watched_series_release(struct hk_watched_series *series);
void hk_watched_series_clear(struct hk_watched_series *series);

static inline double *hk_watched_series_of(const struct hk_watched_series *series, int64_t quantity) {
  return series->value + quantity * series->frames;
}

/* Keeps the values at a frame. */
void hk_watched_series_keep(struct hk_watched_series *series, int64_t frame, const double *q,
                            const double *v);

/* Sets the figures to `factor` times the largest difference over the first `frames` frames at `time`, in a
 * period the difference of the periods over those; NaN where that is not known. Does nothing where the other
 * is of nothing. */
void hk_watched_series_compare(struct hk_watched_series *series, const struct hk_watched_series *other,
                               int64_t frames, const double *time, double factor);

#endif
