/* hooke/why.h - a warning before a run blows up; and why it did, where, and what to do.
 *
 * A diagnosis is made from an integrator whose run ended with HOOKE_DIVERGED, HOOKE_SOLVER_FAILED or
 * HOOKE_STEP_LIMIT, or from states that were kept. It belongs to one thread at a time. */
#ifndef HOOKE_WHY_H
#define HOOKE_WHY_H

#include "limit.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- before ----
 * Told that the step is no longer safe at the time t [s]. `kind` is "near-limit" (within 5 % of
 * hooke_step_bound() there), "above-limit" or "never-stable" (the bound is 0); each is told once a run.
 * `sentence` has everything in words: step, `limit` [s] (the bound), and what it hangs on, `particle` and the
 * spring that weighs most there, `spring` (-1: none, or bending or an altitude spring weighs more). Return 0
 * to go on, anything else to stop the run. */
typedef int32_t hooke_warning(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                              int64_t particle, void *ctx);

/* Has the runs of `integrator` watched: at the start, then at as many of the checks for divergence as cost
 * less than a hundredth of the stepping. Results do not depend on it. NULL takes it back. A method without a
 * bound is never warned of. HOOKE_UNSUITED for a first-order problem; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_integrator_on_warning(hooke_integrator *integrator, hooke_warning *warning,
                                              void *ctx);

/* ---- afterwards ---- */

typedef struct hooke_why hooke_why;

/* Why the last run (or steps) of `integrator` ended early. It takes the last steps again and tries what it
 * advises, so callbacks are called again. Within `seconds` (not above 0, or NaN: as long as the run took, or
 * 2 s if that is more) and half again the memory of the run; what there was no time or memory for is left out
 * and said ("left_out"). `progress` (NULL: none) is called throughout, in trial runs and solves as well.
 * HOOKE_BAD_CALL if the run did not end early; HOOKE_UNSUITED for a first-order problem; HOOKE_STOPPED if
 * `progress` or a callback asked for it; HOOKE_NOT_BUILT without LAPACK; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_why_create(const hooke_integrator *integrator, double seconds,
                                   hooke_progress *progress, void *ctx, hooke_why **why);

/* The same from states that were kept of a run with the options `run`: the one it began with and the last
 * good one, from which it is taken on until it ends early. HOOKE_BAD_CALL if it does not. */
HOOKE_API int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run,
                                        const hooke_state *first, const hooke_state *last, double seconds,
                                        hooke_progress *progress, void *ctx, hooke_why **why);
HOOKE_API void hooke_why_destroy(hooke_why *why);

/* "cause": "step-above-limit", "never-stable", "collapsed-spring", "force-not-finite", "solver-failed",
 * "overflow", "model-gains-energy" or "unknown" (there was no time or memory to tell);
 * "sentence": what happened, where and when, in one or two sentences; "method"; "left_out": what was not
 * looked into for want of time or memory, "" if nothing was. NULL for another word. */
HOOKE_API const char *hooke_why_text(const hooke_why *why, const char *what);
/* "time" [s] of the last step within all bounds, "noticed" [s] by the run, "step" [s], "limit" [s] (the
 * largest stable step, where the step was first seen above it), "particle" (the one concerned). NaN where it
 * does not apply. */
HOOKE_API double hooke_why_number(const hooke_why *why, const char *what);

/* Springs to blame, the largest share first: "spring", "first", "second", "share" (NaN if it cannot be told);
 * and "group". */
HOOKE_API int64_t hooke_why_blame_count(const hooke_why *why);
HOOKE_API double hooke_why_blame_number(const hooke_why *why, int64_t place, const char *what);
HOOKE_API const char *hooke_why_blame_text(const hooke_why *why, int64_t place, const char *what);

/* What to do, the best first. "change": in words; "option": the run option that is the point of it ("step",
 * "method", ...), "" where the change is one of the scene; "value": its new value as text. */
HOOKE_API int64_t hooke_why_advice_count(const hooke_why *why);
HOOKE_API const char *hooke_why_advice_text(const hooke_why *why, int64_t place, const char *what);
/* Sets every option of advice `place` in `run`, options of a run. HOOKE_BAD_VALUE if there is none. */
HOOKE_API int32_t hooke_why_advice_apply(const hooke_why *why, int64_t place, hooke_options *run);

#ifdef __cplusplus
}
#endif
#endif
