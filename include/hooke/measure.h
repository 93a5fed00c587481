/* hooke/measure.h - how large a step may be: a bound from one pass over the springs. */
#ifndef HOOKE_MEASURE_H
#define HOOKE_MEASURE_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A step [s] below which `method` is certain to be stable for the system linearised at q (3n): a bound from
 * one pass over the springs, not the sharp limit. 0: the method is stable at no step. Infinity: nothing
 * limits it. NaN: no bound is known for this method. HOOKE_BAD_VALUE for an unknown method;
 * HOOKE_NO_MEMORY. Source: K <= 2 blockdiag(sum B_e) by (a - b)^2 <= 2 a^2 + 2 b^2, per-mode limits as in
 * docs/notes/methods.md. */
HOOKE_API int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q,
                                   double *bound);
/* The same of every method at once, hooke_method_count() numbers in the order of hooke_method_name(), for one
 * pass over the springs. HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_step_bounds(const hooke_system *system, const double *q, double *bounds);

#ifdef __cplusplus
}
#endif
#endif
