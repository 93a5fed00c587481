/* Limit of a measurement, on its time or on its counted work (counted_work), which is the same on any
 * machine, however busy; or until the caller asks to stop. */
#pragma once

#include "hooke/measurement.h"

/* Batches of springs between two clock readings: some milliseconds. */
enum { HOOKE_BATCHES_PER_LOOK = 2048 };

struct hk_budget {
  int32_t counted; /* 1: by counted work, which hk_budget_spend() adds up */
  double work;     /* spent so far [s] */
  /* by hk_clock_seconds(), or in counted work: start, and end of the current part and of the whole [s] */
  double begun, until, end;
  hooke_progress *progress;
  void *ctx;
  int32_t spent, stopped; /* it ended: time was up, or the caller asked to stop */
};

/* `seconds` from now on; infinity for no limit. */
struct hk_budget hk_budget_of(double seconds, hooke_progress *progress, void *ctx);

/* `work`: counted [s]. */
struct hk_budget hk_budget_of_work(double work, hooke_progress *progress, void *ctx);
/* Adds counted work [s]. */
void hk_budget_spend(struct hk_budget *budget, double work);

/* Reports `what` to the caller; 1 if the work is to end, and from then on at every call. Without budget
 * (NULL) it never ends. */
int32_t hk_budget_ends(struct hk_budget *budget, const char *what);

/* The same as the progress of a run, whose context is the budget: `what` is its method. */
int32_t hk_budget_watch(double done, const char *what, void *budget);

/* 1 if that many seconds are left; if not, it counts as spent. For work that cannot be interrupted. */
int32_t hk_budget_has(struct hk_budget *budget, double seconds);

/* Seconds that are left of the current part. */
double hk_budget_left(const struct hk_budget *budget);

/* Limits the beginning part to a fraction of the remaining time, and lifts that when the part is over: 1 if
 * it was spent. */
void hk_budget_lend(struct hk_budget *budget, double fraction);
int32_t hk_budget_take_back(struct hk_budget *budget);
