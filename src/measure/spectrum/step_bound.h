/* Whether one step is safe, for those who ask often: the answer costs a pass over the springs and no
 * eigenvalues. */
#ifndef HOOKE_MEASURE_SPECTRUM_STEP_BOUND_H
#define HOOKE_MEASURE_SPECTRUM_STEP_BOUND_H

#include "measure/spectrum/node_blocks.h"

/* 1 if there is a bound on the step of this method other than none at all. */
int32_t hk_step_is_bounded(const char *method);

/* 1 if `h` is not above hooke_step_bound() for the positions that the blocks are of (to rounding), or if the
 * method has no bound; else 0, and `particle` is one at which it is. */
int32_t hk_step_is_safe(const struct hk_node_blocks *blocks, const char *method, double h, int64_t *particle);

/* hooke_step_bound() by blocks that are there, for a method of any kind that exists. */
double hk_step_bound_of(const struct hk_node_blocks *blocks, const char *method);

#endif
