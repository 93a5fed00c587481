/* hooke/measure.h - how accurate a method is for what it costs, and how large its step may be. */
#ifndef HOOKE_MEASURE_H
#define HOOKE_MEASURE_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- stability ---- */

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

/* ---- comparison ----
 * One scene by several methods against CVODE at tight tolerance. A comparison belongs to one thread at a
 * time. */

typedef struct hooke_comparison hooke_comparison;

/* Sees frame `frame` of `run` ("reference" or a method's name). Return 0 to go on. */
typedef int32_t hooke_comparison_frame(const char *run, int64_t frame, int64_t step, const hooke_state *state,
                                       void *ctx);

/* A comparison on a committed system, which must outlive it; `options` (of a run) is copied and gives step,
 * duration, every, rtol and atol. HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NOT_BUILT without SUNDIALS,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_comparison_create(const hooke_system *system, const hooke_options *options,
                                          hooke_comparison **comparison);
HOOKE_API void hooke_comparison_destroy(hooke_comparison *comparison);

/* Adds a method as a row; without any call all methods that this build has are compared. */
HOOKE_API int32_t hooke_comparison_add(hooke_comparison *comparison, const char *method);

HOOKE_API void hooke_comparison_on_progress(hooke_comparison *comparison, hooke_progress *progress,
                                            void *ctx);
HOOKE_API void hooke_comparison_on_frame(hooke_comparison *comparison, hooke_comparison_frame *observer,
                                         void *ctx);

/* Runs the reference, then every row. A row that diverges stays as a row. HOOKE_STOPPED keeps the rows done
 * so far. */
HOOKE_API int32_t hooke_comparison_run(hooke_comparison *comparison);

HOOKE_API int64_t hooke_comparison_row_count(const hooke_comparison *comparison);
/* "method", "status" ("finished", "diverged", "stopped", "failed") of a row; NULL if there is none. */
HOOKE_API const char *hooke_comparison_text(const hooke_comparison *comparison, int64_t row,
                                            const char *what);
/* A number of a row, NaN where it does not apply: "step", "rtol", "atol", "error" (maximum over frames of the
 * root mean square of |dx| over free particles [m]), "error_max" (largest |dx| of a free particle over frames
 * [m]), "error_final" (root mean square at the last frame [m]), "energy_drift" (maximum over frames of |E -
 * E_reference| [J]), "force_evaluations", "steps", "wall_seconds". */
HOOKE_API double hooke_comparison_number(const hooke_comparison *comparison, int64_t row, const char *what);

/* Method that gave the reference. */
HOOKE_API const char *hooke_comparison_reference(const hooke_comparison *comparison);
/* Frames compared, and for each the time [s] ("time"), the root mean square error [m] ("error") and the
 * energy less that of the reference [J] ("energy_drift") of a row; NaN past the end of a run that diverged.
 * NULL for another word. Valid as long as the comparison. */
HOOKE_API int64_t hooke_comparison_frame_count(const hooke_comparison *comparison);
HOOKE_API const double *hooke_comparison_series(const hooke_comparison *comparison, int64_t row,
                                                const char *what);

#ifdef __cplusplus
}
#endif
#endif
