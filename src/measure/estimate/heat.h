/* Spurious heat of a run: a damped motion too fast for the step overshoots rest, its velocity reverses from
 * one step to the next, and damping and drag then dissipate more energy than is available. */
#ifndef HOOKE_MEASURE_ESTIMATE_HEAT_H
#define HOOKE_MEASURE_ESTIMATE_HEAT_H

#include "measure/estimate/estimate.h"

/* Repeats the beginning and the last slice at the run's own step and sums the heat over the steps, in a small
 * fraction of the run's time. With the residual R = E(t) - E(a) - W + D of the balance (trial/balance.h),
 * which has to stay as large from the middle of a slice on, and
 *
 *   U = sum over steps of h min(P(v0), P(v1), P(v2), P(v3), P((v3 - 3 v2 + 3 v1 - v0)/8)),
 *
 * P the dissipated power and v0 to v3 velocities one step apart, the excess is min(R, U) as a fraction of the
 * energy of the scene. U is the whole heat where velocities reverse at each step. It is sin(h omega/2)^6 of
 * the heat of an oscillation, and 0.34 % at most of the energy that a motion loses as it comes to rest
 * without overshooting: so the error that R has with every method is not counted as excess. Sets
 * estimate->heat_excess, that of the slice where it is larger; NaN with callbacks or error control, or where
 * there was no time for a slice. HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_estimate_heat(struct hk_estimate *estimate);

#endif
