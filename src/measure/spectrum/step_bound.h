/* Safety of a step, for frequent checks: one pass over the springs and no eigenvalues. */
#pragma once

#include "measure/spectrum/node_blocks.h"

/* 1 if this method has a bound on its step. */
int32_t hk_step_is_bounded(const char *method);

/* hooke_step_bound() from existing blocks, for a method of any known kind, or `most` where that is smaller: a
 * step is safe unless this is below it. Then `particle` (or NULL) is the one that determines it. */
double hk_step_bound_of(const struct hk_node_blocks *blocks, const char *method, double most,
                        int64_t *particle);

/* hooke_step_bound() where velocities are known. */
int32_t hk_step_bound_at(const hooke_system *system, const char *method, const double *q, const double *v,
                         double *bound);
