/* Explicit steps of y' = phi(t, y) on one array (integrate/solve/unknowns.h): of a first-order problem, and
 * of a system with rigid bodies. Those of a system take y from the rows and give it back, so that a step
 * remains a map of (t, q, v). */
#ifndef HOOKE_INTEGRATE_METHOD_ONE_ARRAY_H
#define HOOKE_INTEGRATE_METHOD_ONE_ARRAY_H

#include "integrate/solve/unknowns.h"

struct hk_one_array {
  struct hk_unknowns unknowns;
  double *y, *start, *slope, *sum; /* of its size; y begins the block of all */
};

/* As the integrator's `array`. HOOKE_NO_MEMORY, after which the second has to follow. */
int32_t hk_one_array_create(hooke_integrator *integrator);
void hk_one_array_destroy(struct hk_one_array *array); /* NULL is allowed */

/* Takes y from the rows. */
void hk_one_array_begin(hooke_integrator *integrator);
/* Writes y, which may have quaternions of other lengths, into the rows. */
void hk_one_array_give(hooke_integrator *integrator, double *y);

/* Symplectic Euler's and Verlet's steps of it: accelerations and torques at the rows, whose own coordinates
 * are those of y, by the forces at time t, or by those that the motion has (`kept`); velocities and momenta
 * kicked by them for h; and free motion over h. */
int32_t hk_one_array_push(hooke_integrator *integrator, double t, int32_t kept);
void hk_one_array_kick(hooke_integrator *integrator, double h, double *y);
void hk_one_array_drift(hooke_integrator *integrator, double h);

#endif
