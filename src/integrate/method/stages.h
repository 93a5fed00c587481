/* Explicit Runge-Kutta methods in which each stage starts at the beginning of the step. */
#ifndef HOOKE_INTEGRATE_METHOD_STAGES_H
#define HOOKE_INTEGRATE_METHOD_STAGES_H

#include "integrate/integrator.h"

struct hk_stages {
  int32_t count;
  double ahead[4]; /* positions of stages, in steps: 0, 0.5 or 1 */
  /* advances x by the rate at a stage, to the next one or the end of the step, with a sum of rates */
  void (*move)(int stage, int64_t n, double h, const double *rate, const double *start, double *sum,
               double *x);
};

int32_t hk_stages_create(hooke_integrator *it, const struct hk_stages *stages);
void hk_stages_destroy(hooke_integrator *it);
int32_t hk_stages_step(hooke_integrator *it);

#endif
