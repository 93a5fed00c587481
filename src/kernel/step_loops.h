/* The updates of explicit steps of first-order problems, x' = rate; those of particles are in move_loops.h.
 */
#ifndef HOOKE_KERNEL_STEP_LOOPS_H
#define HOOKE_KERNEL_STEP_LOOPS_H

#include <stdint.h>

/* x += h rate. */
void hk_advance(int64_t n, double h, const double *rate, double *x);

/* Stages that begin at the start of the step:
 *   first   start = x, sum = rate, x += h rate        middle  sum += 2 rate, x = start + h rate
 *   last    x = start + h (sum + rate) */
void hk_first_stage(int64_t n, double h, const double *rate, double *start, double *sum, double *x);
void hk_middle_stage(int64_t n, double h, const double *rate, const double *start, double *sum, double *x);
void hk_last_stage(int64_t n, double h, const double *rate, const double *start, const double *sum,
                   double *x);

#endif
