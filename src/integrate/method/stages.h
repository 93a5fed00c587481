/* Steps of explicit Runge-Kutta methods, by the `stages` of their rows. */
#ifndef HOOKE_INTEGRATE_METHOD_STAGES_H
#define HOOKE_INTEGRATE_METHOD_STAGES_H

#include "integrate/integrator.h"

int32_t hk_stages_create(hooke_integrator *it);
void hk_stages_destroy(hooke_integrator *it);
int32_t hk_stages_step(hooke_integrator *it);

#endif
