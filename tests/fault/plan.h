/* Which of the places where the system may fail are to: counted while the plan is on, one number for all
 * threads. And the library's clock, which goes on by a microsecond with each look at it: what fits in a budget
 * is then the same on any machine, however busy. */
#ifndef FAULT_PLAN_H
#define FAULT_PLAN_H

#include <stdint.h>

enum fault_reach { FAULT_ONCE, FAULT_FROM_THEN_ON };

/* Number `k` = 1, 2, ... fails, alone or with all after it. 0: none does, and all are counted. */
void fault_begin(int64_t k, enum fault_reach reach);
void fault_end(void);

/* Points do not count between the two, on this thread: what the test itself does. */
void fault_pause(void);
void fault_resume(void);

/* At a point: 1 if it has to fail. */
int32_t fault_strikes(void);

/* Points since the beginning; failures among them. They stay after the end. */
int64_t fault_points(void);
int64_t fault_failures(void);

/* Those of another process, in place of them. */
void fault_take_counts(int64_t points, int64_t failures);

#endif
