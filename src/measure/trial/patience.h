/* Time limit of a measurement: until its time is up, or until the caller asks to stop. */
#ifndef HOOKE_MEASURE_TRIAL_PATIENCE_H
#define HOOKE_MEASURE_TRIAL_PATIENCE_H

#include "hooke/measurement.h"

/* Batches of springs between two clock readings: some milliseconds. */
enum { HOOKE_BATCHES_PER_LOOK = 2048 };

struct hk_patience {
  double begun, until, end; /* by hk_clock_seconds(): deadline of the current part, and of the whole */
  hooke_progress *progress;
  void *ctx;
  int32_t spent, stopped; /* it ended: time was up, or the caller asked to stop */
};

/* `seconds` from now on; infinity for no limit. */
struct hk_patience hk_patience_of(double seconds, hooke_progress *progress, void *ctx);

/* Reports `what` to the caller; 1 if the work is to end, and from then on at every call. Without patience
 * (NULL) it never ends. */
int32_t hk_patience_ends(struct hk_patience *patience, const char *what);

/* 1 if that many seconds are left; if not, it counts as spent. For work that cannot be interrupted. */
int32_t hk_patience_has(struct hk_patience *patience, double seconds);

/* Limits the beginning part to a fraction of the remaining time, and lifts that when the part is over: 1 if
 * it was spent. */
void hk_patience_lend(struct hk_patience *patience, double share);
int32_t hk_patience_take_back(struct hk_patience *patience);

#endif
