/* The linear equations (1 - gamma J) (dq, dv) = (b_q, b_v) of an implicit method of SUNDIALS, solved through
 * the 3n equations of integrate/solve/reduced.h with exact products, by GMRES in the norm of the method's
 * error weights. */
#ifndef HOOKE_INTEGRATE_SOLVE_SUNDIALS_LINEAR_H
#define HOOKE_INTEGRATE_SOLVE_SUNDIALS_LINEAR_H

#include "integrate/solve/sundials_problem.h"

/* Creates own->linear as the option linear_solver says: GMRES of SUNDIALS on all unknowns for `gmres`, for
 * first-order problems and if nothing is free. HOOKE_NO_MEMORY. */
int32_t hk_sundials_linear_create(hooke_integrator *integrator);

/* Forgets adaptations of earlier solves: a run restarts. */
void hk_sundials_linear_begin(hooke_integrator *integrator);

/* 1 if own->linear brings its own products. */
int32_t hk_sundials_linear_is_own(const hooke_integrator *integrator);

#endif
