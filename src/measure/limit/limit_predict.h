/* The largest stable step of one method on a system linearised at rest, as in docs/notes/methods.md.
 *
 * M x'' + C x' + K x = 0 over the free particles: K = sum of kappa u u^T + max(0, T/r) (I - u u^T), C = sum
 * of gamma u u^T, plus drag; a spring that only pulls counts as taut, one of no length as stiff in all
 * directions. */
#pragma once

#include "measure/trial/budget.h"

/* `limit` [s] of `method` at positions q (3n), to the relative `accuracy`: 0 if no step is stable, infinity
 * if nothing limits it, an upper estimate if only part of the spectrum can be computed (rk4 and forward-euler
 * on large scenes), NaN if bodies spin too fast to know it at velocities v (3n, NULL: at rest). `progress`
 * may be NULL. HOOKE_BAD_VALUE for an unknown method, HOOKE_NOT_BUILT, HOOKE_NO_MEMORY, HOOKE_SOLVER_FAILED,
 * HOOKE_STOPPED by the progress. */
int32_t hk_limit_predict(const hooke_system *system, const double *q, const double *v, const char *method,
                         double accuracy, hooke_progress *progress, void *ctx, double *limit);

/* The same for a changed system, within the budget, with `memory` bytes for a basis (0: the default);
 * otherwise HOOKE_STOPPED. `spring_scale` (one factor a spring, on kappa and gamma) and `mass_scale` (n) may
 * be NULL. */
int32_t hk_limit_predict_within(const hooke_system *system, const double *q, const double *v,
                                const char *method, const double *spring_scale, const double *mass_scale,
                                double accuracy, double memory, struct hk_budget *budget, double *limit);

/* Raises `limit`, initially hooke_step_bound() (with bodies 0), to a step [s] at which the linearised system
 * is certainly stable: the limit or close to it, by its extreme eigenvalues or, if these do not suffice, by
 * all of a small scene. Where that is not known, where bodies spin too fast, and after budget has ended, it
 * stays what it was. HOOKE_NO_MEMORY. */
int32_t hk_limit_sure(const hooke_system *system, const double *q, const double *v, const char *method,
                      struct hk_budget *budget, double *limit);
