/* hooke/measurement.h - what hooke measures of a scene: how accurate each method is for what it costs, how
 * large its step may be, what the scene needs, what each ingredient costs, and why a run ended early.
 *
 *   hooke_measurement_create("limit", system, run, NULL, &limit);
 *   hooke_measurement_run(limit, NULL);
 *   hooke_measurement_number(limit, "rows", 0, "predicted");
 *   hooke_measurement_destroy(limit);
 *
 * A measurement is of one kind: "study", "limit", "needs", "cost", "comparison", "why" or "verify". Its
 * options are made by hooke_options_create() with the name of the kind. Its results are tables, with columns
 * that have a name, a unit and a line of documentation. A table is "rows", or a "record" of one row with the
 * numbers of the whole. The record that is named like the kind has what concerns the measurement itself. Kinds,
 * tables and columns are listed by hooke_measurement_table() and hooke_measurement_column(), and in the
 * reference.
 *
 * A measurement belongs to one thread at a time. */
#ifndef HOOKE_MEASUREMENT_H
#define HOOKE_MEASUREMENT_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_measurement hooke_measurement;

/* A measurement of a committed system, which must outlive it. `run` (options of a run) and `options` (of this
 * kind; NULL: defaults) are copied. `run` may be NULL where the kind takes no duration from it: "limit" and
 * "cost". A "why" is made by hooke_why_create(), a "verify" by hooke_verify_create(). HOOKE_BAD_VALUE,
 * HOOKE_BAD_CALL, HOOKE_NOT_BUILT without a library that the kind needs, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_create(const char *kind, const hooke_system *system,
                                           const hooke_options *run, const hooke_options *options,
                                           hooke_measurement **measurement);
/* NULL is allowed. */
HOOKE_API void hooke_measurement_destroy(hooke_measurement *measurement);
/* The name of its kind; lives as long as the process. */
HOOKE_API const char *hooke_measurement_kind(const hooke_measurement *measurement);

/* Has `progress` told of the work; NULL takes it back. Anything but 0 from it stops the measurement. */
HOOKE_API void hooke_measurement_on_progress(hooke_measurement *measurement, hooke_progress *progress,
                                             void *ctx);

/* Measures. "limit" and "cost" look at `state` (NULL: the initial state), the others begin at the initial state
 * and want NULL. HOOKE_STOPPED, if the progress callback or a callback of the system asked to stop, keeps what
 * was found so far; so do other outcomes of a run. HOOKE_BAD_VALUE for a state of another system;
 * HOOKE_BAD_CALL for a second call, but for "limit" and "cost"; HOOKE_NO_MEMORY, and what the kind adds. */
HOOKE_API int32_t hooke_measurement_run(hooke_measurement *measurement, hooke_state *state);

/* ---- tables ---- */

/* Of table `table` of a kind "name", "doc" and "shape" ("record" or "rows"); NULL past the last table, and for
 * another word. hooke_measurement_table(NULL, k, "name") is the name of kind `k`. */
HOOKE_API const char *hooke_measurement_table(const char *kind, int64_t table, const char *what);
/* Of column `column` of a table "name", "unit" ("" if it has none), "doc" and "type": "number", "count" (a
 * number that is whole), "flag" (0, 1, or NaN: unknown), "text" or "series". NULL past the last column, and for
 * another word. */
HOOKE_API const char *hooke_measurement_column(const char *kind, const char *table, int64_t column,
                                               const char *what);

/* Rows that a table has by now; -1 if the kind has no such table. A record has one row, or none where there is
 * nothing to say. */
HOOKE_API int64_t hooke_measurement_row_count(const hooke_measurement *measurement, const char *table);
/* A value. NaN where a number does not apply or is not known, and for a row, table or column that is not there;
 * NULL likewise. Texts and series stay valid until the measurement is run again or destroyed. */
HOOKE_API double hooke_measurement_number(const hooke_measurement *measurement, const char *table,
                                          int64_t row, const char *column);
HOOKE_API const char *hooke_measurement_text(const hooke_measurement *measurement, const char *table,
                                             int64_t row, const char *column);
HOOKE_API int64_t hooke_measurement_series_count(const hooke_measurement *measurement, const char *table,
                                                 int64_t row, const char *column);
HOOKE_API const double *hooke_measurement_series(const hooke_measurement *measurement, const char *table,
                                                 int64_t row, const char *column);

/* ---- files ---- */

/* A text that files show, copied: "title" over a page, "command" (the line to type for what is recommended) on
 * it, "scene" (the text of the scene) in HDF5. NULL takes it back. HOOKE_BAD_VALUE for another word,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_label(hooke_measurement *measurement, const char *what, const char *text);

/* Writes what was found so far, by the ending of `path`: .csv (the table "rows"), .json and .h5 (all tables),
 * .html (a page to read offline, of "study", "limit" and "needs"). An older file is replaced when the new one
 * is complete. HOOKE_BAD_VALUE for another ending, HOOKE_BAD_CALL before hooke_measurement_run(),
 * HOOKE_NOT_BUILT, HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_write(const hooke_measurement *measurement, const char *path);

/* ---- limit ----
 * The largest stable step of each method on one scene, predicted and measured, and what determines it.
 *
 * The system is linearised at the positions of the state, at rest: M x'' + C x' + K x = 0 over the free
 * particles. K has the tension of stretched springs, bending, and altitude springs without their tension; C is
 * that of springs, altitude springs and drag. The transverse stiffness of a compressed spring is negative and
 * counts as zero: buckling is growth by physics and no limit of a step. Callbacks are left out; springs that
 * only pull count as taut. Needs LAPACK. ARPACK is used where it is built in (scenes of 34 to 3333 free
 * particles); it is not made for threads, so searches by it wait for each other.
 *
 * All eigenvalues are known up to 133 free particles, and up to 500 where damping is in proportion to
 * stiffness or there is none; with C = beta K one decides at any size. Beyond that the limits of symplectic
 * Euler and Verlet are still sharp, and those of Runge-Kutta and forward Euler lie between "bound" and
 * "predicted".
 *
 * With the option "along" hooke_measurement_run() runs the scene as the options of the run say, from the state
 * on, which is its final state on return, and finds the predicted limit of every method at every frame: the
 * columns "smallest" and "smallest_time" have the smallest that was met, the rest is that of the last frame.
 * The statuses are then those of hooke_integrator_run(). */

/* The step [s] up to which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0 alone, by the rules of
 * the predictions: 0 where no step is stable, infinity where nothing limits it, NaN where no rule is known, for
 * an unknown method and for a number below 0. */
HOOKE_API double hooke_limit_of_mode(const char *method, double frequency, double decay);

/* ---- cost ----
 * What each ingredient of one scene costs, on this machine. An ingredient is a group of springs, of bending
 * triples or of tetrahedra, all damping of springs, drag, the callback force, or gravity. The scene is made
 * again without it and both are compared: memory, the largest stable step, and the time of a step, taken by
 * turns on both in short blocks from the same state, of which the shortest count. Times differ from one machine
 * and one call to the next. Callbacks are called, at states that may not be those of a run. The state stays as
 * it is. */

/* ---- why ----
 * Why a run ended early, where, and what to do. */

/* Explains the last run (or steps) of `integrator`, which ended with HOOKE_DIVERGED, HOOKE_SOLVER_FAILED or
 * HOOKE_STEP_LIMIT. The integrator must stay as it is until hooke_measurement_run() has returned. That takes
 * the last steps again and tries what it advises, so callbacks are called again. It keeps to the option
 * "budget" and to half again the memory of the run; the column "left_out" says what there was no time or memory
 * for. The progress callback is called throughout, in trial runs and solves as well; if it stops the work,
 * nothing is known. `options` may be NULL. HOOKE_BAD_CALL if the run did not end early; HOOKE_UNSUITED for a
 * first-order problem; HOOKE_NOT_BUILT without LAPACK; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_why_create(const hooke_integrator *integrator, const hooke_options *options,
                                   hooke_measurement **measurement);
/* The same from states that were kept of a run with the options `run`, and are copied: the one it began with
 * and the last good one. From that hooke_measurement_run() takes it on until it ends early; HOOKE_BAD_CALL if
 * it does not. */
HOOKE_API int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run,
                                        const hooke_state *first, const hooke_state *last,
                                        const hooke_options *options, hooke_measurement **measurement);
/* Sets every option of that row of the table "advice" in `run`, options of a run. HOOKE_BAD_VALUE if there is no
 * such row. */
HOOKE_API int32_t hooke_why_advice_apply(const hooke_measurement *measurement, int64_t row,
                                         hooke_options *run);

#ifdef __cplusplus
}
#endif
#endif
