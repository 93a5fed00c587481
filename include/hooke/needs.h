/* hooke/needs.h - what a scene needs for a wanted accuracy: what may be left out, and what resolution it asks
 * for.
 *
 * One ingredient after another is left out of a system, and each variant is run. The change of a variant is
 * the maximum over frames of the root mean square over the watched particles of the distance from where they
 * are in the full system [m]. Each run takes the largest step (or tolerance) with which it is off by at most
 * a tenth of what is wanted, judged by a run with half the step (a tenth of the tolerance). What changes less
 * than is wanted is not needed.
 *
 * Ingredients: each group of springs and each family of a part; bending; altitude springs; damping; drag;
 * gravity; a force callback; springs whose force stays small; particles that touch nothing; parts without
 * watched particles; resistance to compression; half the resolution of each part, compared at equal material
 * coordinates by linear interpolation.
 *
 * Options (hooke_needs_options_create): want [m]; watch (name of a part or of a group, or particle numbers
 * "0,7-9"; all free particles if not given).
 *
 * It belongs to one thread at a time. */
#ifndef HOOKE_NEEDS_H
#define HOOKE_NEEDS_H

#include "measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_needs hooke_needs;

/* Options, for the caller to set and destroy. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_needs_options_create(hooke_options **options);

/* For a committed system, which must outlive it. `run` (options of a run) gives duration, every and the
 * method; without a method one is picked as hooke_estimate_pick() does. Both options are copied.
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_needs_create(const hooke_system *system, const hooke_options *run,
                                     const hooke_options *options, hooke_needs **needs);
HOOKE_API void hooke_needs_destroy(hooke_needs *needs);

HOOKE_API void hooke_needs_on_progress(hooke_needs *needs, hooke_progress *progress, void *ctx);

/* Fills the table, then leaves out together what is not needed and saves work, the smallest change first, as
 * long as a run with the largest step that allows it stays within what is wanted, all errors together; single
 * springs of a part only where that halves the work. Where the watched particles move by less than a
 * thousandth of what is wanted, nothing can be told, and nothing is left out. Once. HOOKE_STOPPED keeps what
 * is known so far; HOOKE_BAD_VALUE if no step that could be tried holds the full system to a tenth of what is
 * wanted; the failures of hooke_integrator_run(). */
HOOKE_API int32_t hooke_needs_find(hooke_needs *needs);

/* The reverse: each part at once, twice and four times its resolution; once. The same statuses. */
HOOKE_API int32_t hooke_needs_refine(hooke_needs *needs);

/* "want" [m]; "method_picked" (1: no method was given); "duration" [s]; "judged_until" [s]: beyond it
 * differences grow so fast that no step would keep its error small, and changes are those up to there;
 * "runs": made so far. Of the full system: "wall_seconds" (stepping alone), "springs", "particles",
 * "step_limit" [s] (predicted with LAPACK, else hooke_step_bound(); infinity: nothing limits it), "step" [s],
 * "rtol", "atol" [m], "steps", "force_evaluations", "step_error" [m] (how far the step may put it off);
 * "own_error" [m] (how far the finer one of its last two runs may be off, against which all variants are
 * held); "moved" [m] (of the watched particles, like a change, from where they begin).
 *
 * The same words after "lean_" for the run of the lean system that is recommended, and after "cheapest_" for
 * a run of the full system by the same method: each with the largest step, or tolerances, within what is
 * wanted, all errors together. "lean_error" and "cheapest_error" [m]: at most that far from the full system,
 * the distance from its finer run and "own_error" together. "times_less": the wall time of the full system's
 * over that of the lean one's, taken in turns. "other_seconds" [s]: of the full system's run within what is
 * wanted by "other_method", which takes clearly less. NaN where it does not apply. */
HOOKE_API double hooke_needs_figure(const hooke_needs *needs, const char *what);
/* "method"; "other_method" (NULL if none was seen to be cheaper for the full system, or nothing is left out);
 * "note": that nothing moves, or less than is wanted; "lean_note": which groups of parts the lean system has
 * spring by spring, since it has some of their springs only; both "" where there is nothing to say. NULL for
 * another word. */
HOOKE_API const char *hooke_needs_word(const hooke_needs *needs, const char *what);

/* ---- rows: what was left out ---- */

HOOKE_API int64_t hooke_needs_row_count(const hooke_needs *needs);
/* "without": the ingredient ("cloth.bend", "damping", "half the resolution of cloth"); "kind": "springs",
 * "bending", "altitude", "damping", "drag", "gravity", "callback", "idle", "loose", "part", "compression",
 * "resolution"; "note": why there is no number, "" otherwise. NULL if there is no such row. */
HOOKE_API const char *hooke_needs_text(const hooke_needs *needs, int64_t row, const char *what);
/* "error" [m] (the change; NaN if the run did not end), "needed" (0 or 1; NaN where nothing moves that it
 * could change), "left_out" (1: also in the lean system), and the words of the full system above. */
HOOKE_API double hooke_needs_number(const hooke_needs *needs, int64_t row, const char *what);

/* ---- the lean system ---- */

/* Owned by `needs`; the full one's twin if all is needed; NULL before it was found. */
HOOKE_API const hooke_system *hooke_needs_lean(const hooke_needs *needs);
/* The run to make of it: method, step or tolerances, duration, every. */
HOOKE_API const hooke_options *hooke_needs_lean_run(const hooke_needs *needs);
/* Where the lean system has a particle of the full one; -1 if it was left out, and in parts of another
 * resolution. */
HOOKE_API int64_t hooke_needs_lean_particle(const hooke_needs *needs, int64_t particle);
/* Positions of all particles of the full system, 3 each, at a state of the lean one: of the same material
 * points, NaN where they were left out. HOOKE_BAD_CALL before it was found. */
HOOKE_API int32_t hooke_needs_lean_position(const hooke_needs *needs, const double *q, double *position);

/* ---- resolution, one row a part ---- */

HOOKE_API int64_t hooke_needs_part_count(const hooke_needs *needs);
/* "part": its name; "note": why there is no order or resolution, "" otherwise. */
HOOKE_API const char *hooke_needs_part_text(const hooke_needs *needs, int64_t part, const char *what);
/* "cells" (along the part's first axis), "cells_second", "cells_third"; "change" and "change_fine" [m]:
 * between once and twice, and twice and four times the resolution; "order"; "error" [m]: estimate of what is
 * left at the resolution it has; "factor": on the cells, that the want asks for; "wanted", "wanted_second",
 * "wanted_third": cells at that. NaN where unknown. */
HOOKE_API double hooke_needs_part_number(const hooke_needs *needs, int64_t part, const char *what);

#ifdef __cplusplus
}
#endif
#endif
