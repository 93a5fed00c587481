/* Limit of a measurement, on its time or on its counted work (counted_work), which is the same on any machine,
 * however busy; or until the caller asks to stop. */
#ifndef HOOKE_MEASURE_TRIAL_PATIENCE_H
#define HOOKE_MEASURE_TRIAL_PATIENCE_H

#include "hooke/measurement.h"

/* Batches of springs between two clock readings: some milliseconds. */
enum { HOOKE_BATCHES_PER_LOOK = 2048 };

struct hk_patience {
  int32_t counted; /* 1: by counted work, which hk_patience_spend() adds up */
  double work;     /* spent so far [s] */
  /* by hk_clock_seconds(), or in counted work: start, and end of the current part and of the whole [s] */
  double begun, until, end;
  hooke_progress *progress;
  void *ctx;
  int32_t spent, stopped; /* it ended: time was up, or the caller asked to stop */
};

/* `seconds` from now on; infinity for no limit. */
struct hk_patience hk_patience_of(double seconds, hooke_progress *progress, void *ctx);

/* `work`: counted [s]. */
struct hk_patience hk_patience_of_work(double work, hooke_progress *progress, void *ctx);
/* Adds counted work [s]. */
void hk_patience_spend(struct hk_patience *patience, double work);
/* What the current part has left [s]; infinity without patience. */
double hk_patience_left(const struct hk_patience *patience);

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
