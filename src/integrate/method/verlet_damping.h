/* Whether a step of Verlet takes the damping explicitly, at the predicted velocity, or solves for it. */
#ifndef HOOKE_INTEGRATE_METHOD_VERLET_DAMPING_H
#define HOOKE_INTEGRATE_METHOD_VERLET_DAMPING_H

#include "integrate/integrator.h"

/* Of the row of Verlet. HOOKE_NO_MEMORY. */
int32_t hk_verlet_explicit_step(const hooke_system *system, double *step);

/* The `choose` of Verlet: decides by the system, the step and the option `verlet_damping`, whose value it
 * sets to what it decided. HOOKE_UNSUITED or HOOKE_BAD_VALUE where explicit damping is asked for and cannot
 * be. */
int32_t hk_verlet_choose(hooke_integrator *integrator);

/* Of the motion, for the step that contains one of Verlet. */
int32_t hk_verlet_begin(hooke_integrator *integrator, const hooke_state *state);
void hk_verlet_forget(hooke_integrator *integrator);

#endif
