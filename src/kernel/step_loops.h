/* The moves of numbers x at a rate, x of a first-order problem among them; those of particles are in
 * move_loops.h.
 */
#pragma once

#include <stdint.h>

/* A stage of a Runge-Kutta method, as for particles; of any other kind x += kick rate, without start and sum.
 */
void hk_move_numbers(int32_t kind, double kick, int64_t count, const double *rate, double *start, double *sum,
                     double *x);
