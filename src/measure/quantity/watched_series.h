/* Watched quantities over the frames of a run, and their differences between two runs. */
#ifndef HOOKE_MEASURE_QUANTITY_WATCHED_SERIES_H
#define HOOKE_MEASURE_QUANTITY_WATCHED_SERIES_H

#include "measure/quantity/watched.h"

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
void hk_watched_series_keep(struct hk_watched_series *series, int64_t frame, const double *q,
                            const double *v);

/* Sets the differences to `factor` times the largest one over the first `frames` frames at `time`; for a
 * period to the difference of the periods over these frames; NaN if that is unknown, or without a frame after
 * the first. Does nothing if the other series watches nothing. */
void hk_watched_series_compare(struct hk_watched_series *series, const struct hk_watched_series *other,
                               int64_t frames, const double *time, double factor);

#endif
