/* Sweeps the faults of one scenario, point by point. */
#pragma once

#include "scenarios.h"

struct sweep {
  char folder[128];     /* of this test alone */
  int32_t share;        /* one in so many points of every scenario with many; 0: the scenario's own */
  int32_t share_factor; /* the scenario's own share times this, if that is more; 0: once */
  int32_t first_point;  /* offset of the points that are tried: 0, 1, ... */
  int64_t complaints;
};

/* Creates and removes the folder and the input of scenarios; 0 on success. */
int sweep_open(struct sweep *sweep);
int sweep_close(struct sweep *sweep);

struct attempt sweep_attempt(const struct sweep *sweep, enum fault_reach reach);

/* Runs the scenario with point `k` failing (0: none) and records the results in `a`. */
typedef void sweep_point(const struct scenario *scenario, int64_t k, enum fault_reach reach,
                         struct attempt *a);

/* Runs all points of all scenarios of a list, or one in so many of them: each fails alone, and with all after
 * it. A scenario without faults has to end in the same hash, before and after, and so has one that continued
 * after a single fault. Prints counts; fails the test at the end. */
void sweep_all(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point);

/* sweep_all() for every list, one cmocka test each, between `set_up` and `tear_down`, which open and close
 * the sweep; returns the value of main(). */
int sweep_every_list(struct sweep *sweep, sweep_point *try_point, int (*set_up)(void **),
                     int (*tear_down)(void **));
