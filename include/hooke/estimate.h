/* hooke/estimate.h - how wrong a run is: an estimate of its error after it has run, and a method and a step
 * or tolerance for an error that is wanted.
 *
 *   hooke_estimate_create(system, run, want, &estimate);
 *   hooke_estimate_pick(estimate, NULL, run);            with a wanted error: sets method and step or tolerance
 *   hooke_estimate_begin(estimate, integrator, state);   and hooke_estimate_see() as its frame and step observer
 *   hooke_integrator_run(integrator, state);
 *   hooke_estimate_measure(estimate, integrator, state);
 *   hooke_estimate_refine(estimate, run);                where "met" is not 1: something finer, to begin again with
 *
 * An estimate belongs to one thread at a time. */
#ifndef HOOKE_ESTIMATE_H
#define HOOKE_ESTIMATE_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_estimate hooke_estimate;

/* For runs of a committed system, which must outlive it. `want` [m] is the root mean square error over free
 * particles that no frame is to exceed; NaN: none is wanted, and the error is estimated alone.
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_create(const hooke_system *system, double want, hooke_estimate **estimate);
HOOKE_API void hooke_estimate_destroy(hooke_estimate *estimate);
/* What picking and measuring tell their progress; it may end them. */
HOOKE_API void hooke_estimate_on_progress(hooke_estimate *estimate, hooke_progress *progress, void *ctx);

/* Picks a method (`method`, or any that is built if NULL) and its step or tolerance for the wanted error by
 * runs that are held against a reference no tighter than that takes, and sets them in `run`. It takes about 2
 * s or ten times the run that it picks, whichever is more; where that is too short for a reference of the
 * whole run, it looks at the beginning alone. No step is above 0.9 of the stable one at any frame, and no
 * pick gains energy by itself. What comes closest is set where nothing is known to meet the want;
 * hooke_estimate_number("met") tells. HOOKE_BAD_VALUE, HOOKE_NOT_BUILT without SUNDIALS, HOOKE_UNSUITED if no
 * method has a stable step, HOOKE_STOPPED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_pick(hooke_estimate *estimate, const char *method, hooke_options *run);

/* Before a run of `integrator` from `state`. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_begin(hooke_estimate *estimate, const hooke_integrator *integrator,
                                       const hooke_state *state);
/* A hooke_observer with the estimate as its `ctx`: takes the frames of the run, and states between them if
 * they come. */
HOOKE_API int32_t hooke_estimate_see(int64_t step, const hooke_state *state, void *estimate);

/* After the run, whose last state is `state`. With a want: against the reference where it covers the run,
 * else against the same method at half the step or a hundredth of the tolerance. Without one: a run of under
 * 2 s against the same method at twice the step or a tenfold tolerance, once more coarsened to see how the
 * error goes with it; a longer one, or one that is too coarse for that, in a last piece of it at half the
 * step or a hundredth of the tolerance, which takes a tenth of its time at most. HOOKE_STOPPED,
 * HOOKE_NO_MEMORY.
 * `integrator` NULL: it was destroyed, so that no two hold memory at a time; the run then counts as having
 * taken the time since hooke_estimate_begin(). */
HOOKE_API int32_t hooke_estimate_measure(hooke_estimate *estimate, const hooke_integrator *integrator,
                                         const hooke_state *state);
/* Sets something finer in `run`, by what was measured. HOOKE_UNSUITED if that leads nowhere or takes too
 * long. */
HOOKE_API int32_t hooke_estimate_refine(hooke_estimate *estimate, hooke_options *run);

/* "estimate" [m], NaN if it is not known; "known_from" and "known_until" [s]: the times between which that
 * error was made, the start of the run and its end or, where nobody can know for longer, the time until which
 * the reference can be trusted; "wanted" [m]; "met" (1, 0, NaN if nobody can know); "energy_rise": by how much
 * energy rose by itself over the last half of the run, as a share of what the scene has, NaN if that cannot be
 * told; "heat_excess": by how much more energy damping and drag took, at the beginning or in the last piece,
 * than there was to take, as such a share and as far as it is the heat of velocities that reverse at each
 * step; NaN with callbacks or error control, or where there was no time to sum it; "seconds": what picking and
 * measuring took so far. NaN for another word. */
HOOKE_API double hooke_estimate_number(const hooke_estimate *estimate, const char *what);
/* "by": "half-step", "tolerance", "slice" (of a run at half the step or a hundredth of the tolerance) or
 * "reference"; NULL if there is no estimate. "note": why there is none, or why the want is not met; "" if
 * there is nothing to say. */
HOOKE_API const char *hooke_estimate_text(const hooke_estimate *estimate, const char *what);

#ifdef __cplusplus
}
#endif
#endif
