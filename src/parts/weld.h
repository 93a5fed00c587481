/* Points at one place, or close together, made one. */
#ifndef HOOKE_PARTS_WELD_H
#define HOOKE_PARTS_WELD_H

#include "hooke/base.h"

/* Each of `count` points (rows of 3), in their order, becomes the first kept point that is up to `distance`
 * away, or else is kept itself. `became` (count) receives the number of the kept one; `position` is packed to
 * the kept points, and `first` (count) receives which point each of them was. HOOKE_NO_MEMORY. */
int32_t hk_weld(int64_t count, double distance, double *position, int32_t *became, int32_t *first,
                int64_t *kept);

#endif
