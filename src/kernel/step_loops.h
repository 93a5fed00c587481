/* The updates of explicit steps on one component of all particles. h [s], w inverse mass, g acceleration; a =
 * w f + g. */
#ifndef HOOKE_KERNEL_STEP_LOOPS_H
#define HOOKE_KERNEL_STEP_LOOPS_H

#include <stdint.h>

/* x += h rate. */
void hk_advance(int64_t n, double h, const double *rate, double *x);

/* Halves of a Verlet step, a = w f + *g, or w f where g is NULL: v += kick a, q += drift v(new); v += kick a;
 * and v = (v + kick a)/(1 + kick drag w), which is the same with the drag at the new velocity. */
void hk_kick_and_drift(int64_t n, double kick, double drift, const double *w, const double *f,
                       const double *g, double *q, double *v);
void hk_kick(int64_t n, double kick, const double *w, const double *f, const double *g, double *v);
void hk_kick_with_drag(int64_t n, double kick, double drag, const double *w, const double *f, const double *g,
                       double *v);

/* f = w f + *g, or w f where g is NULL. */
void hk_acceleration(int64_t n, const double *w, const double *g, double *f);

/* Stages of the classical Runge-Kutta method, from the rate at one stage to the position of the next:
 *   first   sum = rate, x += h rate        middle  sum += 2 rate, x = start + h rate
 *   last    x = start + sixth (sum + rate) */
void hk_first_stage(int64_t n, double h, const double *rate, double *sum, double *x);
void hk_middle_stage(int64_t n, double h, const double *rate, const double *start, double *sum, double *x);
void hk_last_stage(int64_t n, double part, const double *rate, const double *start, const double *sum,
                   double *x);

#endif
