/* hooke/limit.h - the largest stable step of each method on one scene: predicted, measured, and what it hangs
 * on.
 *
 * A limit is found for the system linearised and frozen at given positions, at rest: M x'' + C x' + K x = 0
 * over the free particles, K with the tension of stretched springs, bending and altitude springs (without
 * their tension), C of springs, altitude springs and drag. The transverse stiffness of a compressed spring,
 * which is negative, counts as zero there: buckling is growth by physics and no limit of a step. Callbacks
 * are left out; springs that only pull count as taut. A limit belongs to one thread at a time. Needs LAPACK.
 * ARPACK is used where it is built in (scenes of 34 to 3333 free particles); it is not made for threads, so
 * searches by it wait for each other.
 *
 * All eigenvalues are known up to 133 free particles, and up to 500 where damping is in proportion to
 * stiffness or there is none; with C = beta K one decides at any size. Beyond that the limits of symplectic
 * Euler and Verlet are still sharp, and those of Runge-Kutta and forward Euler lie between "bound" and
 * "predicted".
 *
 * Options of a limit (hooke_limit_options_create): methods (names separated by commas; every fixed-step one
 * if not given), predict (1: leave out the measuring), nonlinear (1: measure on the scene itself over
 * `duration` of the run instead of on the frozen system), accuracy (relative, of predictions and of
 * measurements), budget [s] of the measuring. */
#ifndef HOOKE_LIMIT_H
#define HOOKE_LIMIT_H

#include "measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_limit hooke_limit;

/* Options of a limit, for the caller to set and destroy. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_limit_options_create(hooke_options **options);

/* A limit of a committed system, which must outlive it. `run` (options of a run, for what methods take
 * besides steps, and for the duration of nonlinear measurements) and `options` may be NULL; both are copied.
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_limit_create(const hooke_system *system, const hooke_options *run,
                                     const hooke_options *options, hooke_limit **limit);
HOOKE_API void hooke_limit_destroy(hooke_limit *limit);

HOOKE_API void hooke_limit_on_progress(hooke_limit *limit, hooke_progress *progress, void *ctx);

/* Finds the limits at the positions of `state`; may be called again with another. HOOKE_STOPPED keeps what is
 * done. HOOKE_BAD_VALUE for a state of another system or with numbers that are not finite. */
HOOKE_API int32_t hooke_limit_find(hooke_limit *limit, const hooke_state *state);

/* Runs the scene as `run` says from `state` on, which is its final state on return, and finds at every frame
 * the predicted limit of every method: hooke_limit_number() then tells the smallest that was met ("smallest")
 * and its time ("smallest_time"), the rest is that of the last frame. The statuses of
 * hooke_integrator_run(). */
HOOKE_API int32_t hooke_limit_along(hooke_limit *limit, hooke_state *state);

/* "frequency_max": largest frequency [rad/s] of the undamped modes; "rate_max": largest eigenvalue of M^-1 C
 * [1/s]; "modes": number of modes known; "products": products with K and C that it took; "clamped": springs
 * under compression whose transverse stiffness was left out. NaN for another word. */
HOOKE_API double hooke_limit_figure(const hooke_limit *limit, const char *what);

/* ---- rows: one a method ---- */

HOOKE_API int64_t hooke_limit_row_count(const hooke_limit *limit);
/* "method"; "note": what to know about the row, such as what limits a method without a limit, or why
 * prediction and measurement differ ("" if nothing). NULL if there is no such row. */
HOOKE_API const char *hooke_limit_text(const hooke_limit *limit, int64_t row, const char *what);
/* "bound": hooke_step_bound(); "predicted": the sharp limit, or where only part of the spectrum is known the
 * limit over the modes found; "exact" (0: the limit lies between "bound" and "predicted"); "measured",
 * "ratio" (measured/predicted), "steps_run" (steps taken to measure), "never_stable" (0 or 1), "smallest",
 * "smallest_time"; "by_eigenvalue" (1: stable where h lambda is within one region for every eigenvalue
 * lambda). Steps in s; infinity where nothing limits the step, NaN where it does not apply. */
HOOKE_API double hooke_limit_number(const hooke_limit *limit, int64_t row, const char *what);

/* ---- blame: what the limiting mode of the row hangs on, the largest share first ---- */

/* Springs named, at most 100, and before them the force that has half of the whole or more, if it is not the
 * stiffness of springs; their shares are those of h^2 K + 2 h C (bending, altitude springs and drag included)
 * in the limiting mode of the method of the run (of the first row with a limit if that has none). */
HOOKE_API int64_t hooke_limit_blame_count(const hooke_limit *limit);
/* "spring" (its number), "first" and "second" (its ends), "share" (0..1; of damping, the part of the shares
 * of springs that is damping). NaN for another word, and for what a force does not have. */
HOOKE_API double hooke_limit_blame_number(const hooke_limit *limit, int64_t place, const char *what);
/* "group": the name of the group or part the spring is of; "force": "drag", "damping", "bending" or
 * "altitude", "" of a spring. */
HOOKE_API const char *hooke_limit_blame_text(const hooke_limit *limit, int64_t place, const char *what);
/* Particles that move in that mode: "particle", "share" of the kinetic energy, "mass" [kg]. */
HOOKE_API int64_t hooke_limit_mover_count(const hooke_limit *limit);
HOOKE_API double hooke_limit_mover_number(const hooke_limit *limit, int64_t place, const char *what);
/* What it would buy to change the springs (or the particles) to blame: "kind" ("soften" or "heavier"),
 * "sentence"; and by "springs" or "particles" (how many to change), "factor" (by how much), "cost" (factor of
 * the step without them), "gain" (factor of the step, re-computed with the change made), "gain_predicted" (by
 * first-order perturbation). NULL and NaN where no small set is to blame. */
HOOKE_API const char *hooke_limit_remedy_text(const hooke_limit *limit, const char *what);
HOOKE_API double hooke_limit_remedy_number(const hooke_limit *limit, const char *what);

/* ---- modes: eigenvalues lambda of lambda^2 M + lambda C + K, the largest first; of conjugates one, of those
 * that are 0 none ---- */

HOOKE_API int64_t hooke_limit_mode_count(const hooke_limit *limit);
/* "real" and "imaginary" part [1/s]; "frequency" [rad/s] and "decay" [1/s] of x'' + 2 decay x' + frequency^2
 * x = 0, which it is a root of (with damping out of proportion: k = u.Ku and c = u.Cu of its mode u). */
HOOKE_API double hooke_limit_mode_number(const hooke_limit *limit, int64_t mode, const char *what);
/* The limiting mode, 3n displacements of largest length 1, valid until the next hooke_limit_find(); NULL
 * before. */
HOOKE_API const double *hooke_limit_shape(const hooke_limit *limit);

/* The step [s] up to which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0 alone, by the rules of
 * the predictions: 0, infinity and NaN as there, NaN for an unknown method or a number below 0. */
HOOKE_API double hooke_limit_of_mode(const char *method, double frequency, double decay);

#ifdef __cplusplus
}
#endif
#endif
