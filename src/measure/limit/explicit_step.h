/* Steps at which a method that could solve for damping takes it explicitly, for less. */
#pragma once

#include "integrate/integrator.h"

#include "hooke/options.h"

/* `step`, or the largest below it at which the method solves nothing, where that makes a run cheaper.
 * HOOKE_NO_MEMORY. */
int32_t hk_step_cheapest(const hooke_system *system, const char *method, double *step);

/* The method whose limit holds for a run with these options, after hooke_step_settle(): that of symplectic
 * Euler, which takes damping explicitly, too, is within that of such a verlet. */
const char *hk_step_limited_as(const hooke_system *system, const hooke_options *run);
