/* The updates of explicit steps on one component of all particles. h [s], w inverse mass, g acceleration; a =
 * w f + g. */
#ifndef HOOKE_KERNEL_STEP_LOOPS_H
#define HOOKE_KERNEL_STEP_LOOPS_H

#include <stdint.h>

/* Symplectic Euler: v += h a; q += h v(new). */
void hooke_kick_then_drift(int64_t n, double h, const double *w, const double *f, double g, double *q,
                           double *v);

/* Forward Euler: q += h v(old); v += h a. */
void hooke_drift_then_kick(int64_t n, double h, const double *w, const double *f, double g, double *q,
                           double *v);

/* The same without gravity, a = w f. */
void hooke_kick_then_drift_weightless(int64_t n, double h, const double *w, const double *f, double *q,
                                      double *v);
void hooke_drift_then_kick_weightless(int64_t n, double h, const double *w, const double *f, double *q,
                                      double *v);

/* x += h rate. */
void hooke_advance(int64_t n, double h, const double *rate, double *x);

#endif
