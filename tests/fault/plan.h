/* Plan of the points at which the system fails: counted while the plan is on, in one count for all threads.
 * It also replaces the library's clock, which advances by a microsecond with each reading, so that budgets
 * have the same result on any machine. */
#pragma once

#include <stdint.h>

enum fault_reach { FAULT_ONCE, FAULT_FROM_THEN_ON };

/* Fails point `k` = 1, 2, ..., alone or with all after it. 0: none fails, and all are counted. */
void fault_begin(int64_t k, enum fault_reach reach);
void fault_end(void);

/* Points between the two do not count, on this thread: calls of the test itself. */
void fault_pause(void);
void fault_resume(void);

/* At a point: 1 if it has to fail. */
int32_t fault_strikes(void);

/* Number of points since the beginning, and of failures among them; kept after the end. */
int64_t fault_points(void);
int64_t fault_failures(void);

/* Replaces them by those of another process. */
void fault_take_counts(int64_t points, int64_t failures);
