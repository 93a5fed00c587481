/* hooke/measurement.h - measurements of a scene: one object with options, progress, a run, and tables of
 * results; and bounds on stable steps.
 *
 *   hooke_measurement_create("study", system, run, NULL, &study);
 *   hooke_measurement_run(study, NULL);
 *   hooke_measurement_number(study, "rows", 0, "error");
 *   hooke_measurement_destroy(study);
 *
 * A measurement is of one kind: "study", "limit", "rest", "needs", "cost", "check", "why", "verify",
 * "estimate" (estimate.h) or "view" (trajectory.h). Its options are made by hooke_options_create() with the
 * name of the kind. Its results are tables, with columns that have a name, a unit and a line of
 * documentation. A table is "rows", or a "record" of one row with the numbers of the whole. The record that
 * is named like the kind describes the measurement itself. hooke_measurement_table() lists kinds and tables,
 * hooke_measurement_column() the columns.
 *
 * A measurement belongs to one thread at a time. */
#ifndef HOOKE_MEASUREMENT_H
#define HOOKE_MEASUREMENT_H

#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_measurement hooke_measurement;

/* Creates a measurement of a committed system, which must outlive it. `run` (options of a run) and `options`
 * (of this kind; NULL: defaults) are copied; a study needs `run`. HOOKE_BAD_VALUE, HOOKE_BAD_CALL,
 * HOOKE_NOT_BUILT without a library that the kind needs, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_create(const char *kind, const hooke_system *system,
                                           const hooke_options *run, const hooke_options *options,
                                           hooke_measurement **measurement);
/* NULL is allowed. */
HOOKE_API void hooke_measurement_destroy(hooke_measurement *measurement);
/* Name of its kind; lives as long as the process. */
HOOKE_API const char *hooke_measurement_kind(const hooke_measurement *measurement);

/* Sets the progress callback; NULL removes it. A non-zero return value stops the measurement. */
HOOKE_API void hooke_measurement_on_progress(hooke_measurement *measurement, hooke_progress *progress,
                                             void *ctx);

/* Measures. A limit, a cost, a check and a rest are taken at `state` (NULL: the initial one) and may be taken
 * again; an estimate needs the last state of the run; the other kinds begin at the initial state, run once,
 * and require NULL. HOOKE_STOPPED, if the progress callback or a callback of the system asked to stop, keeps
 * the results so far. HOOKE_BAD_VALUE for a state of another system or one that the kind does not accept,
 * and for a run without a duration; HOOKE_BAD_CALL for a second call; HOOKE_NO_MEMORY; and the failures of
 * an integrator. */
HOOKE_API int32_t hooke_measurement_run(hooke_measurement *measurement, hooke_state *state);

/* ---- tables ---- */

/* Property of table `table` of a kind: "name", "doc" or "shape" ("record" or "rows"); NULL past the last
 * table, and for another word. With `kind` NULL, table k is kind k: its "name" is that of the kind. */
HOOKE_API const char *hooke_measurement_table(const char *kind, int64_t table, const char *what);
/* Property of column `column` of a table: "name", "unit" ("" if it has none), "doc" or "type": "number",
 * "count" (a whole number), "flag" (0, 1, or NaN: unknown), "text" or "series". NULL past the last column,
 * and for another word. */
HOOKE_API const char *hooke_measurement_column(const char *kind, const char *table, int64_t column,
                                               const char *what);

/* Unit of a column of this measurement: that of its kind, but "" in place of "m" where the measurement is of
 * a problem of coordinates (hooke_system_create_second_order()), whose numbers have units of their own. NULL
 * if there is no such column. */
HOOKE_API const char *hooke_measurement_unit(const hooke_measurement *measurement, const char *table,
                                             const char *column);

/* Number of rows that a table has so far; -1 if the kind has no such table. A record has one row, or none if
 * it is empty. */
HOOKE_API int64_t hooke_measurement_row_count(const hooke_measurement *measurement, const char *table);
/* Number of the first row whose `column` is `text`; -1 if there is none. In a matrix such as "statistics"
 * rows are ordered by the first index, then the second: the row of a method and a quantity is the sum of the
 * first rows of both. */
HOOKE_API int64_t hooke_measurement_find(const hooke_measurement *measurement, const char *table,
                                         const char *column, const char *text);
/* A value. NaN where a number does not apply or is not known, and for a row, table or column that does not
 * exist; NULL likewise. `count`, unless NULL, receives the length of a series, 0 if there is none. Texts and
 * series stay valid until the measurement is run again or destroyed. */
HOOKE_API double hooke_measurement_number(const hooke_measurement *measurement, const char *table,
                                          int64_t row, const char *column);
HOOKE_API const char *hooke_measurement_text(const hooke_measurement *measurement, const char *table,
                                             int64_t row, const char *column);
HOOKE_API const double *hooke_measurement_series(const hooke_measurement *measurement, const char *table,
                                                 int64_t row, const char *column, int64_t *count);

/* ---- files ---- */

/* Sets a text that files show, copied: "title" is the heading of a page, "command" the command line of the
 * recommendation or of the first advice, "command 1" to "command 3" those of the next, "scene" the text of
 * the scene in HDF5, "output" the file of a lean scene. `text` NULL removes it. HOOKE_BAD_VALUE for another
 * word, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_label(hooke_measurement *measurement, const char *what, const char *text);

/* JSON on one line, with every digit: the document of all tables, as in a .json file (`table` NULL), a table
 * (row -1) or a row of it. Valid until the next call for this measurement, and until it is destroyed. NULL
 * for a row or table that does not exist, and without memory. */
HOOKE_API const char *hooke_measurement_json(hooke_measurement *measurement, const char *table, int64_t row);

/* Writes the results so far in the format given by the ending of `path`: .csv (the table "rows"), .json and
 * .h5 (all tables), .html (a page to read offline). An older file is replaced when the new one is complete.
 * HOOKE_BAD_VALUE for another ending, HOOKE_BAD_CALL before hooke_measurement_run(), HOOKE_NOT_BUILT,
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_measurement_write(const hooke_measurement *measurement, const char *path);

/* ---- a study: accuracy and cost of each method, and a recommendation ----
 * It computes a reference by two integrators that check each other and share only the force, or without
 * SUNDIALS by rk4 in steps and half steps, runs every method over a ladder of steps or tolerances, measures
 * error and cost of each run over the frames where the reference is trusted, and fits orders. With the option
 * `want` it recommends a run whose "error_max", the largest distance of any free particle at any frame, is at
 * most that; with `ensemble` it adds statistics for motion that is not predictable to its end. Runs that
 * diverge stay as rows.
 *
 * With the option `once` each method runs once, with the step or the tolerances of `run`: a first look. Its
 * HDF5 file then has the motions, too, unless it was stopped: the reference under /particles/all, each method
 * under /particles/<method>. hooke_measurement_write() makes these runs again, so the system has to be there
 * still, callbacks are called again, and the progress callback may stop it (HOOKE_STOPPED, with no file).
 *
 * The reference gets two fifths of a `budget`, and at least half a second; an ensemble gets three tenths.
 * When the budget is spent, rows not begun or not finished are left out, and "budget_spent" of the table
 * "study" is 1.
 *
 * Each start of an ensemble has every free particle displaced by Gaussian noise of root mean square "noise":
 * a tenth of the wanted error, or without one a millionth of the extent. Statistics are of each run's means
 * (of a period: of its period) over the frames from "from" to "until", which follow the trusted ones.
 *
 * A watched quantity is 57.x, 57.y or 57.z (a coordinate of a particle [m]), part:0.y (of a part's particle),
 * 57.reaction, .reaction_x, .reaction_y or .reaction_z (the force of the support of a pinned or driven
 * particle [N], m a - f with its weight in f), group:3.length [m], group:3.strain or group:3.tension [N] (of
 * a spring of a group: the force along it, of damping, too, positive where it pulls), group:max.tension or
 * group:min.tension (the largest or smallest of a group), energy, kinetic or potential [J], or period:Q [s],
 * the mean time between passages of one of these upwards through its mean. Indices begin at 0. */

/* Recommends the run that hooke_estimate_pick() picks for another wanted error [m], or of a list by what all
 * of its bounds are multiplied, among the methods of the study, and updates the tables "recommendation" and
 * "margin". HOOKE_OK also when nothing meets it; "note" then says why. */
HOOKE_API int32_t hooke_study_recommend(hooke_measurement *study, double want);

/* ---- a rest: where forces are in equilibrium ----
 * From the positions of the state, at its time, to f(t, q, 0) = 0. What the scene prescribes in time is held;
 * friction and damping do not matter. "position" of the table "rest" has where particles are then (3n), or
 * where the search ended if "status" is "none". A search that `budget` ended is a result, too. "minimum" and
 * "zero_modes" are known of up to 200 free particles without rigid bodies, wind and callbacks, with LAPACK.
 */

/* ---- a limit: the largest stable step of each method, and what determines it ----
 * The system is linearised at the positions of the state, at rest (drag that is not linear, at its
 * velocities): M x'' + C x' + K x = 0 over the free particles. K has the tension of stretched springs,
 * bending, and altitude springs without their tension; C is that of springs, altitude springs and drag. The
 * transverse stiffness of a compressed spring is negative and counts as zero: buckling is growth by physics
 * and no limit of a step. Callbacks are left out; springs that only pull count as taut. Needs LAPACK.
 *
 * All eigenvalues are known up to 133 free particles, and up to 500 where damping is in proportion to
 * stiffness or there is none; with C = beta K one decides at any size. Beyond that the limits of symplectic
 * Euler and Verlet are still sharp, and those of Runge-Kutta and forward Euler lie between "bound" and
 * "predicted".
 *
 * With the option "along" hooke_measurement_run() runs the scene as the options of the run say, from the
 * state on, which is the final state on return, and finds the predicted limit of every method at every frame.
 * The columns "smallest" and "smallest_time" hold the smallest of these; the others describe the last frame.
 * The statuses are then those of hooke_integrator_run(). */

/* Largest step [s] at which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0 alone, by the rules
 * of the predictions: 0 where no step is stable, infinity where nothing limits it, NaN where no rule is
 * known, for an unknown method and for a negative number. */
HOOKE_API double hooke_limit_of_mode(const char *method, double frequency, double decay);

/* ---- needs: the ingredients of a scene that a wanted error requires, and its resolution ----
 * One ingredient after another is left out of the system, and each variant is run. Its change is the largest
 * distance [m] of any watched particle, over all frames, from its position in the full system. Each run takes
 * the largest step (or tolerance) with an error of at most a tenth of the wanted one, judged by a run with
 * half the step (a tenth of the tolerance). An ingredient whose change is below the wanted error is not
 * needed, unless it is above it from a start displaced by a hundredth of that. Ingredients are each group of
 * springs and each family of a part; bending; altitude springs; damping; drag; gravity; a force callback;
 * springs whose force stays small; particles that touch nothing; parts without watched particles; resistance
 * to compression; the deformation of each part, which becomes one rigid body; half the resolution of each
 * part, compared at equal material coordinates by linear interpolation.
 *
 * Then all ingredients that are not needed and whose omission saves work are left out together, whole parts
 * first, then deformations, then the rest, each in order of increasing change, as long as a run with the
 * largest possible step stays within the wanted error, all errors together. Single springs of a part are left
 * out only where that halves the work. Where the watched particles move by less than a thousandth of the
 * wanted error, needs are unknown and nothing is left out.
 *
 * The option `refine` does the reverse: it runs each part at once, twice and four times its resolution, for
 * the table "parts". `run` gives duration, every and the method; without a method, one is picked.
 * HOOKE_BAD_VALUE if no step tried keeps the full system within a tenth of the wanted error. */

/* The lean system, owned by `needs`: a copy of the full one if all is needed, NULL before it was found. */
HOOKE_API const hooke_system *hooke_needs_lean(const hooke_measurement *needs);
/* Options of the run for it: method, step or tolerances, duration, every. */
HOOKE_API const hooke_options *hooke_needs_lean_run(const hooke_measurement *needs);
/* The particle of the lean system that is particle `particle` of the full one; -1 if it was left out, and in
 * parts of another resolution. */
HOOKE_API int64_t hooke_needs_lean_particle(const hooke_measurement *needs, int64_t particle);
/* Positions of all particles of the full system, 3 each, at a state of the lean one: those of the same
 * material points, NaN where they were left out. HOOKE_BAD_CALL before it was found, and for another kind. */
HOOKE_API int32_t hooke_needs_lean_position(const hooke_measurement *needs, const double *q,
                                            double *position);

/* ---- a cost: the cost of each ingredient of a scene on this machine ----
 * An ingredient is a group of springs, of bending
 * triples or of tetrahedra, all damping of springs, drag, the callback force, or gravity. The scene is
 * rebuilt without it and both are compared: memory, the largest stable step, and the time of a step. Steps
 * are timed on both in alternating short blocks from the same state, and the shortest block counts. Times
 * differ between machines and calls. Callbacks are called, possibly at states that do not occur in a run. The
 * state is unchanged. */

/* ---- a why: why a run ended early, where, and what to do ---- Its page (.html) shows the steps around the
 * trouble, which are taken again while it is written: the system has to be there still, and callbacks are
 * called again. */

/* Explains the last run (or steps) of `integrator`, which ended with HOOKE_DIVERGED, HOOKE_SOLVER_FAILED or
 * HOOKE_STEP_LIMIT. The integrator must not change until hooke_measurement_run() has returned. That repeats
 * the last steps and tries its suggestions, so callbacks are called again. It stays within the option
 * "budget" and half again the memory of the run; the column "left_out" lists the work that did not fit. The
 * progress callback is called throughout, in trial runs and solves as well; if it stops the work, there are
 * no results. `options` may be NULL. HOOKE_BAD_CALL if the run did not end early; HOOKE_UNSUITED for a
 * first-order problem; HOOKE_NOT_BUILT without LAPACK; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_why_create(const hooke_integrator *integrator, const hooke_options *options,
                                   hooke_measurement **measurement);
/* The same from states that were kept of a run with the options `run`, and are copied: the initial one and
 * the last good one. hooke_measurement_run() continues from the latter until the run ends early;
 * HOOKE_BAD_CALL if it does not. */
HOOKE_API int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run,
                                        const hooke_state *first, const hooke_state *last,
                                        const hooke_options *options, hooke_measurement **measurement);
/* Sets every option of this row of the table "advice" in `run`, options of a run. HOOKE_BAD_VALUE if there is
 * no such row. */
HOOKE_API int32_t hooke_why_advice_apply(const hooke_measurement *measurement, int64_t row,
                                         hooke_options *run);

/* ---- verify: checks that a trajectory reproduces from its scene ---- It repeats a slice of the run from the
 * numbers in the file and compares the frames to the bit; it compares every frame with its check value, and
 * the first one with the scene. With a fixed step a slice begins at any frame; an error-controlled method is
 * run from the start. Along the slice it computes the energy balance: the work of driven particles = change
 * of energy + heat of damping and drag. It then runs the slice with half the step, or a hundredth of the
 * tolerances: the residual of the balance has to fall as the error of the method does, and the difference
 * between the two runs estimates the error.
 *
 * Where the file was made with other versions of SUNDIALS or CHOLMOD, or on another machine, error-controlled
 * methods and linear_solver direct may differ in bits, and error-controlled methods with another BLAS or
 * number of its threads: frames then have to agree to within four times the estimate.
 *
 * hooke_measurement_run() returns HOOKE_BAD_VALUE if the file does not reproduce, with the first frame,
 * particle and component that differ and both numbers, the damaged frame, or the balance that does not hold;
 * the table "verify" and files are complete all the same. */

/* Opens a trajectory and makes its scene again, with `limits` as in hooke_scene_load(); both kinds of options
 * may be NULL, and are copied or read here. HOOKE_BAD_VALUE for a file that holds no scene or no frames, a
 * scene that is wrong, or a slice without two frames; HOOKE_UNSUITED for a run with callbacks;
 * HOOKE_IO_FAILED, HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_verify_create(const char *path, const hooke_options *options,
                                      const hooke_options *limits, hooke_measurement **verify);

/* The same of a run with callbacks: `system` is the committed one of hooke_scene_load() from that file, to
 * which the caller has given them again; it outlives the measurement. HOOKE_UNSUITED for another force than
 * that of the run, where both are named; HOOKE_BAD_CALL before commit. */
HOOKE_API int32_t hooke_verify_create_with(const char *path, const hooke_system *system,
                                           const hooke_options *options, hooke_measurement **verify);

/* ---- bounds on the step, from one pass over the springs ---- */

/* Step [s] below which `method` is certain to be stable for the system linearised at q (3n): a bound from one
 * pass over the springs, not the sharp limit. `method` NULL: `bound` receives that of every method,
 * hooke_method_count() numbers in the order of hooke_method_name(), from one pass as well. 0: no step is
 * stable. Infinity: nothing limits the step. NaN: no bound is known for this method, with rigid bodies that
 * move, where a spring is so long that its square overflows, or where drag is not linear in velocities.
 * HOOKE_BAD_VALUE for an unknown method; HOOKE_NO_MEMORY. Source: K <= 2 blockdiag(sum B_e) by (a - b)^2
 * <= 2 a^2 + 2 b^2, per-mode limits as in docs/notes/methods.md. */
HOOKE_API int32_t hooke_step_bound(const hooke_system *system, const char *method, const double *q,
                                   double *bound);

/* Sets `verlet_damping` of a run from auto to explicit where steps that solve for damping are not needed:
 * where the step is at most twice the one up to which auto is explicit, and at most 0.8 of the limit that is
 * predicted where the scene begins, also if dampers turn until they act together. It does not with obstacles,
 * curves or springs that follow time. Other options of a run stay as they are. HOOKE_BAD_VALUE for options of
 * another kind; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_step_settle(const hooke_system *system, hooke_options *run);

/* Makes step, `every` and duration of the options `run` fit one another, for a method of fixed step. A
 * missing step becomes the largest that fits, up to half of hooke_step_bound() at q (3n), or a thousandth of
 * the duration where nothing is known to limit it. A given one becomes up to 10 % less, or else `every` and
 * duration its nearest whole multiples. `told` (or NULL) hears each change in a sentence; its `kind` is the
 * name of the option. Options without a duration stay as they are. HOOKE_UNSUITED where no step is certain to
 * be stable, or 1e8 of them are too few; HOOKE_STOPPED if `told` returned anything but 0; and what
 * hooke_step_bound() returns. */
HOOKE_API int32_t hooke_step_fit(const hooke_system *system, const double *q, hooke_options *run,
                                 hooke_warning *told, void *ctx);

#ifdef __cplusplus
}
#endif
#endif
