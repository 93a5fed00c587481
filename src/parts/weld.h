/* Merges points that coincide or are close together. */
#pragma once

#include "hooke/base.h"

/* Each of `count` points (rows of 3), in order, is merged into the first kept point up to `distance` away, or
 * else is kept. `became` (count) receives the number of the kept one; `position` is compacted to the kept
 * points, and `first` (count) receives their original numbers. HOOKE_NO_MEMORY. */
int32_t hk_weld(int64_t count, double distance, double *position, int32_t *became, int32_t *first,
                int64_t *kept);
