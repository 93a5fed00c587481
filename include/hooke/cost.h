/* hooke/cost.h - what each ingredient of one scene costs, on this machine.
 *
 * An ingredient is a group of springs, of bending triples or of tetrahedra, all damping of springs, drag, the
 * callback force, or gravity. The scene is made again without it and both are compared: memory, the largest
 * stable step, and the time of a step, taken by turns on both in short blocks from the same state, of which
 * the shortest count. Times differ from one machine and one call to the next. A cost belongs to one thread at
 * a time. Callbacks are called, at states that may not be those of a run.
 *
 * Options of a cost (hooke_cost_options_create): predict (1: leave out the timing), budget [s], after which
 * no further ingredient is looked at (one that was begun is finished), groups (how many are looked at at
 * most, the largest). */
#ifndef HOOKE_COST_H
#define HOOKE_COST_H

#include "measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_cost hooke_cost;

/* Options of a cost, for the caller to set and destroy. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_cost_options_create(hooke_options **options);

/* The cost of a committed system, which must outlive it. `run` (options of a run: method, step, threads and
 * what else methods take) and `options` may be NULL; both are copied. HOOKE_BAD_VALUE, HOOKE_BAD_CALL,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_cost_create(const hooke_system *system, const hooke_options *run,
                                    const hooke_options *options, hooke_cost **cost);
HOOKE_API void hooke_cost_destroy(hooke_cost *cost);

HOOKE_API void hooke_cost_on_progress(hooke_cost *cost, hooke_progress *progress, void *ctx);

/* Finds the costs at `state`, which stays as it is; may be called again. HOOKE_STOPPED keeps the rows done so
 * far. HOOKE_BAD_VALUE for a state of another system, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_cost_find(hooke_cost *cost, const hooke_state *state);

/* The method that was timed and whose steps are limited: that of the run, or symplectic Euler, one evaluation
 * of the forces a step, where that chooses its own steps or is not in this build. */
HOOKE_API const char *hooke_cost_method(const hooke_cost *cost);

/* Of the whole scene: "step" [s] that was timed, "nanoseconds" of one step, "resolution" [ns] that
 * differences of it have, "memory_bytes" of system, state and integrator, "step_limit" [s] as
 * hooke_limit_number() has it as "predicted" (NaN without LAPACK). NaN for another word and for what was not
 * found. */
HOOKE_API double hooke_cost_figure(const hooke_cost *cost, const char *what);

/* ---- rows: one an ingredient that is there, those of size 0 left out ---- */

HOOKE_API int64_t hooke_cost_row_count(const hooke_cost *cost);
/* "kind": "springs", "bending", "altitude", "damping", "drag", "callback" or "gravity"; "name": of the group,
 * else the kind. NULL if there is no such row. */
HOOKE_API const char *hooke_cost_text(const hooke_cost *cost, int64_t row, const char *what);
/* "group" (its number, among those of its kind) and "springs" (how many); "nanoseconds" of a step and
 * "memory_bytes" that it costs, 0 where nothing can be seen; "resolution" [ns] of the first: what two like
 * systems differed by; "step_limit_without" [s]. NaN where it does not apply, and for ingredients that were
 * not looked at: groups beyond the largest, and what the budget left out. */
HOOKE_API double hooke_cost_number(const hooke_cost *cost, int64_t row, const char *what);

#ifdef __cplusplus
}
#endif
#endif
