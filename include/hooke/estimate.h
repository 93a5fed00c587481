/* hooke/estimate.h - error of a run: estimates it after the run, and picks a method with its step or
 * tolerance for a wanted error. An estimate is a measurement.
 *
 *   hooke_options_create("estimate", &options);
 *   hooke_options_set_number(options, "want", 1e-3);     without it the error is only estimated
 *   hooke_measurement_create("estimate", system, NULL, options, &estimate);
 *   hooke_estimate_pick(estimate, NULL, run);            wanted error: sets method and step or tolerance
 *   hooke_estimate_begin(estimate, integrator, state);   hooke_estimate_see() is its frame and step observer
 *   hooke_integrator_run(integrator, state);
 *   hooke_measurement_run(estimate, state);
 *   hooke_estimate_refine(estimate, run);                if "met" is not 1: sets a finer step or tolerance
 *
 * hooke_measurement_run() estimates the error of the whole run that ended with `state`: the distance [m] of
 * the farthest free particle from where it should be, at any frame. With a wanted error the run is compared
 * with the reference where that covers the run. Otherwise it is run again, from the state at which it began,
 * at half and at twice the step (a tenth and ten times the tolerance), and the error is Roache's grid
 * convergence index (J. Fluids Eng. 116, 1994) of the three; a run of more counted work than that of 10 s at
 * twice and at four times the step. Another method judges, too, and all of that takes at most four times the
 * work of the run. NaN, with the "reason", where the runs do not tell, where a callback takes part and the
 * option "callbacks" is not set, and for a run that hooke_integrator_resume() continued. It may be called
 * again after the next hooke_estimate_begin(). HOOKE_BAD_CALL without one, HOOKE_BAD_VALUE without a state,
 * HOOKE_STOPPED, HOOKE_NO_MEMORY. The results are one row, the table "estimate".
 *
 * With the option `watch`, quantities as of a study (hooke/measurement.h), the table "watched" has a row for
 * each: its value at `state`, and its smallest and largest over all steps, if hooke_estimate_follow() shows
 * them, with the time from and until which they are known. The option `error` set to 0 leaves all else out:
 * then hooke_measurement_run() computes nothing again. */
#ifndef HOOKE_ESTIMATE_H
#define HOOKE_ESTIMATE_H

#include "measurement.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Picks a method (`method`, or any that is built if NULL) and its step or tolerance for the wanted error by
 * trial runs that it compares with a reference no tighter than needed, and sets them in `run`. The cheapest
 * in counted work is picked, of methods within 1.2 the first of the table, so that the pick is the same on a
 * busy machine. All of it takes the work of ten times the picked run or that of 2 s, whichever is more; where
 * that is too little for a reference of the whole run, only its beginning is used. No step exceeds 0.9 of the
 * stable step: of the bound at any frame, or of the prediction at the start and where the bound is least. No
 * picked method gains energy by itself, and the pick has met the want from a displaced start, too. If nothing
 * is known to meet the wanted error, the closest choice is set; the column "met" says so. HOOKE_BAD_CALL
 * without a wanted error, HOOKE_BAD_VALUE, HOOKE_UNSUITED if no method has a stable step, HOOKE_STOPPED,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_pick(hooke_measurement *estimate, const char *method, hooke_options *run);

/* Call before a run of `integrator` from `state`. The integrator has to stay until the run is over. The
 * estimate keeps some states of the run. HOOKE_BAD_VALUE for another system, for a state that does not fit it
 * and without a duration; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_begin(hooke_measurement *estimate, const hooke_integrator *integrator,
                                       const hooke_state *state);
/* A hooke_observer with the estimate as its `ctx`: receives the frames of the run, and optionally states
 * between them. HOOKE_BAD_VALUE for a state of another size, HOOKE_BAD_CALL for none, which stop the run. */
HOOKE_API int32_t hooke_estimate_see(int64_t step, const hooke_state *state, void *estimate);

/* Shows the estimate every step of the runs of an integrator of its system, for the extremes of its option
 * `watch`, and seven states within each step of cvode-bdf and cvode-adams; does nothing if nothing is
 * watched. The estimate has to stay as long as the integrator runs; NULL ends it. HOOKE_BAD_VALUE for another
 * system, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_estimate_follow(hooke_measurement *estimate, hooke_integrator *integrator);

/* Sets a finer step or tolerance in `run`, chosen from the measured error. HOOKE_UNSUITED if that cannot
 * succeed or takes too long. */
HOOKE_API int32_t hooke_estimate_refine(hooke_measurement *estimate, hooke_options *run);

/* Adds the estimated error of a run to the trajectory file that it wrote, which is closed already:
 * /hooke/error and its texts, see docs/trajectory.md. The file is valid before, and stays so if the call is
 * interrupted. HOOKE_BAD_VALUE for a file without space reserved for it, that is damaged, or whose run is not
 * over; HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. */
HOOKE_API int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path);

#ifdef __cplusplus
}
#endif
#endif
