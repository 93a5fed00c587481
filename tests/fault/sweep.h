/* One scenario with its faults, point after point. */
#ifndef FAULT_SWEEP_H
#define FAULT_SWEEP_H

#include "scenarios.h"

struct sweep {
  char folder[128]; /* of this test alone */
  int32_t share,
      first; /* if given: one in so many points of every scenario with many, from this one (0, 1, ...) on */
  int32_t times; /* if given: what the scenario says, so many times over, if that is more */
  int64_t wrong;
};

/* Makes and removes the folder and what scenarios read in it; 0 if that went well. */
int sweep_open(struct sweep *sweep);
int sweep_close(struct sweep *sweep);

struct attempt sweep_attempt(const struct sweep *sweep, enum fault_reach reach);

/* Runs the scenario with point `k` failing (0: none) and says in `a` what happened. */
typedef void sweep_point(const struct scenario *scenario, int64_t k, enum fault_reach reach,
                         struct attempt *a);

/* All points of all scenarios of a list, or one in so many of them: each fails alone, and with all after it. A scenario
 * that no fault meets has to end in the same hash, before and after, and so has one that went on after a single fault.
 * Prints counts; fails the test at the end. */
void sweep_all(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point);

#endif
