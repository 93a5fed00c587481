/* How long an inquiry may go on: until its time is up, or until the caller wants an end. */
#ifndef HOOKE_MEASURE_TRIAL_PATIENCE_H
#define HOOKE_MEASURE_TRIAL_PATIENCE_H

#include "hooke/measurement.h"

/* Batches of springs between two looks at the time: some milliseconds. */
enum { HOOKE_BATCHES_PER_LOOK = 2048 };

struct hk_patience {
  double begun, until, end; /* by hk_clock_seconds(): the end of the part under way, and of the whole */
  hooke_progress *progress;
  void *ctx;
  int32_t spent, stopped; /* there was an end: the time was up, the caller wanted it */
};

/* `seconds` from now on; infinity for no end. */
struct hk_patience hk_patience_of(double seconds, hooke_progress *progress, void *ctx);

/* Tells the caller of `what`; 1 if there is to be an end, as it is at every call after the first that says
 * so. Without patience (NULL) there is none. */
int32_t hk_patience_ends(struct hk_patience *patience, const char *what);

/* 1 if there are that many seconds left; if not, it is as spent as when they were over. For what cannot be
 * ended on the way. */
int32_t hk_patience_has(struct hk_patience *patience, double seconds);

/* Lets the part that begins have no more than that share of what is left, and takes that back when the part
 * is over: 1 if it was spent. */
void hk_patience_lend(struct hk_patience *patience, double share);
int32_t hk_patience_take_back(struct hk_patience *patience);

#endif
