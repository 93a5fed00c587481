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

/* Each in the file of its method. */
extern const struct hk_stages hk_forward_euler_stages, hk_heun_stages, hk_rk4_stages;

/* Time of a stage of the current step. */
double hk_stage_time(const hooke_integrator *it, const struct hk_stages *stages, int stage);

/* Moves `count` numbers x from a stage on by their `rate` there. */
void hk_stage_move(const struct hk_stages *stages, int stage, double step, int64_t count, const double *rate,
                   double *start, double *sum, double *x);

int32_t hk_stages_create(hooke_integrator *it, const struct hk_stages *stages);
void hk_stages_destroy(hooke_integrator *it);
int32_t hk_stages_step(hooke_integrator *it);

#endif
