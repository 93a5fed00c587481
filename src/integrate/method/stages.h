/* Explicit Runge-Kutta methods in which each stage starts at the beginning of the step. */
#ifndef HOOKE_INTEGRATE_METHOD_STAGES_H
#define HOOKE_INTEGRATE_METHOD_STAGES_H

#include "integrate/integrator.h"

/* Stage k is `ahead` steps after the start, at 0, 0.5 or 1, and leads from there to the next one, or to the end
 * of the step, by the part of its rate that lasts a step over `over`; see the moves of stages in
 * kernel/move_loops.h. */
struct hk_stages {
  int32_t count;
  double ahead[4], over[4];
};

int32_t hk_stages_create(hooke_integrator *it, const struct hk_stages *stages);
void hk_stages_destroy(hooke_integrator *it);
int32_t hk_stages_step(hooke_integrator *it);

#endif
