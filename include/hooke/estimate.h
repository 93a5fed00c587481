/* hooke/estimate.h - error of a run: estimates it after the run, and picks a method with its step or
 * tolerance for a wanted error.
 *
 *   hooke_estimate_create(system, run, want, &estimate);
 *   hooke_estimate_pick(estimate, NULL, run);            wanted error: sets method and step or tolerance
 *   hooke_estimate_begin(estimate, integrator, state);   hooke_estimate_see() is its frame and step observer
 *   hooke_integrator_run(integrator, state);
 *   hooke_estimate_measure(estimate, integrator, state);
 *   hooke_estimate_refine(estimate, run);                if "met" is not 1: sets a finer step or tolerance
 *
 * An estimate belongs to one thread at a time. */
#ifndef HOOKE_ESTIMATE_H
#define HOOKE_ESTIMATE_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_estimate hooke_estimate;

/* Creates an estimate for runs of a committed system, which must outlive it. `want` [m] is the root mean
 * square error over free particles that no frame may exceed; NaN: no wanted error, the error is only
 * estimated. HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_create(const hooke_system *system, double want, hooke_estimate **estimate);
HOOKE_API void hooke_estimate_destroy(hooke_estimate *estimate);
/* Sets the callback that picking and measuring report their progress to; it may stop them. */
HOOKE_API void hooke_estimate_on_progress(hooke_estimate *estimate, hooke_progress *progress, void *ctx);

/* Picks a method (`method`, or any that is built if NULL) and its step or tolerance for the wanted error by
 * trial runs that it compares with a reference no tighter than needed, and sets them in `run`. This takes
 * about 2 s or ten times the picked run, whichever is more; where that is too short for a reference of the
 * whole run, only its beginning is used. No step exceeds 0.9 of the stable step at any frame, and no picked
 * method gains energy by itself. If nothing is known to meet the wanted error, the closest choice is set;
 * hooke_estimate_number("met") says so. HOOKE_BAD_VALUE, HOOKE_NOT_BUILT without SUNDIALS, HOOKE_UNSUITED if
 * no method has a stable step, HOOKE_STOPPED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_pick(hooke_estimate *estimate, const char *method, hooke_options *run);

/* Call before a run of `integrator` from `state`. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_begin(hooke_estimate *estimate, const hooke_integrator *integrator,
                                       const hooke_state *state);
/* A hooke_observer with the estimate as its `ctx`: receives the frames of the run, and optionally states
 * between them. */
HOOKE_API int32_t hooke_estimate_see(int64_t step, const hooke_state *state, void *estimate);

/* Estimates the error of the run after it, with its last state `state`. With a wanted error the run is
 * compared with the reference where that covers the run, otherwise with the same method at half the step or a
 * hundredth of the tolerance. Without one, a run of under 2 s is compared with the same method at twice the
 * step or a tenfold tolerance, and coarsened once more to see how the error scales. For a longer run, or one
 * that is too coarse for that, only a last slice is repeated, at half the step or a hundredth of the
 * tolerance and in a tenth of its time at most. HOOKE_STOPPED, HOOKE_NO_MEMORY.
 * `integrator` may be NULL if it was destroyed to save memory; the time since hooke_estimate_begin() then
 * counts as the time of the run. */
HOOKE_API int32_t hooke_estimate_measure(hooke_estimate *estimate, const hooke_integrator *integrator,
                                         const hooke_state *state);
/* Sets a finer step or tolerance in `run`, chosen from the measured error. HOOKE_UNSUITED if that cannot
 * succeed or takes too long. */
HOOKE_API int32_t hooke_estimate_refine(hooke_estimate *estimate, hooke_options *run);

/* "estimate" [m], NaN if it is not known; "known_from" and "known_until" [s]: the interval that the error
 * holds for: the start of the run, and its end or, where the motion is not predictable that long, the time
 * until which the reference can be trusted; "wanted" [m]; "met" (1, 0, NaN if unknown); "energy_rise":
 * spontaneous rise of energy over the last half of the run, as a fraction of the energy of the scene, NaN if
 * unknown; "heat_excess": energy that damping and drag dissipated, at the beginning or in the last slice,
 * beyond the energy that was available, as such a fraction and as far as it is the heat of velocities that
 * reverse at each step; NaN with callbacks or error control, or where there was no time to sum it; "seconds":
 * time that picking and measuring took so far. NaN for another word. */
HOOKE_API double hooke_estimate_number(const hooke_estimate *estimate, const char *what);
/* "by": "half-step", "tolerance", "slice" (of a run at half the step or a hundredth of the tolerance) or
 * "reference"; NULL if there is no estimate. "note": why there is none, or why the wanted error is not met;
 * "" if there is nothing to say. */
HOOKE_API const char *hooke_estimate_text(const hooke_estimate *estimate, const char *what);

#ifdef __cplusplus
}
#endif
#endif
