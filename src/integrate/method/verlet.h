/* What the step that contains one of Verlet takes from it. */
#pragma once

#include "integrate/integrator.h"

int32_t hk_verlet_begin(hooke_integrator *integrator, const hooke_state *state);
void hk_verlet_forget(hooke_integrator *integrator);
