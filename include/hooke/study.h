/* hooke/study.h - how accurate each method is for what it costs, on one scene, and which one to take.
 *
 * A study makes a reference that checks itself, runs every method over a ladder of steps or tolerances,
 * measures error and cost of each run, fits orders, and recommends. It belongs to one thread at a time. Needs
 * SUNDIALS.
 *
 * Options of a study (hooke_study_options_create): methods (names separated by commas; all that the build has
 * if not given), points (rows a method, >= 6), steps [s] and tolerances (ladders of one's own), want [m],
 * budget [s], watch (quantities, separated by commas), ensemble (displaced starts), seed.
 *
 * A watched quantity Q is 57.x, 57.y or 57.z (a coordinate of a particle [m]), part:0.y (of a part's
 * particle), group:3.length [m], group:3.strain or group:3.tension [N] (of a spring of a group: the force
 * along it, of damping, too, positive where it pulls), energy, kinetic or potential [J], or period:Q [s], the
 * mean time between passages of one of these upwards through its mean. Indices begin at 0. */
#ifndef HOOKE_STUDY_H
#define HOOKE_STUDY_H

#include "measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_study hooke_study;

/* Options of a study, for the caller to set and destroy. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_study_options_create(hooke_options **options);

/* A study of a committed system, which must outlive it. `run` (options of a run) gives duration, every, and
 * what methods take besides steps and tolerances; `options` may be NULL. Both are copied.
 * HOOKE_BAD_VALUE, HOOKE_BAD_CALL, HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_study_create(const hooke_system *system, const hooke_options *run,
                                     const hooke_options *options, hooke_study **study);
HOOKE_API void hooke_study_destroy(hooke_study *study);

HOOKE_API void hooke_study_on_progress(hooke_study *study, hooke_progress *progress, void *ctx);

/* Makes the reference, runs the ladders, fits the orders and, if `want` is set, recommends. Runs that diverge
 * stay as rows. Two fifths of a budget, and at least half a second, are for the reference: what they leave no
 * time to check is not trusted. When the budget is spent, rows not begun or not finished are left out and
 * hooke_study_figure("budget_spent") is 1. HOOKE_STOPPED keeps what is done so far. HOOKE_BAD_VALUE without a
 * duration, or if the reference ran out of budget before it had a frame to check. */
HOOKE_API int32_t hooke_study_run(hooke_study *study);

/* ---- the reference ---- */

/* "method" and "check": the two integrators that made it, which share only the force. "ended": why they were
 * tightened no further: "agreed", "time" (the budget was short), or "rounding" (it keeps them apart at the
 * tightest tolerances). "watched:0", "watched:1", ...: the quantities that are watched, as they were written;
 * "quantity:0", ...: those that statistics are of; "unit:Q": the unit of one. NULL for another word. */
HOOKE_API const char *hooke_study_reference(const hooke_study *study, const char *what);

/* "agreement": twice the largest root mean square distance between the two over the frames that are trusted
 * [m]: they may be off in the same direction. No error below it means anything, and none within ten times of
 * it much. "trusted_until": time up to which they agree to the wanted digits [s]; errors are judged up to
 * there. "checked_until": time up to which they were compared [s]; before the end where the budget was spent.
 * "energy_agreement": twice the largest difference of their energies there [J]. "growth": the factor by which
 * a small displacement of the start grows, at most, true with "growth_probability" (both NaN where that is
 * not known); "growth_seen": the largest one of so many "displacements". "duration" [s], "frames" (those that
 * are judged), "budget_spent" (0 or 1). "watched": how many quantities are watched; "agreement:Q": twice the
 * largest difference between the two in one of them, the floor of its errors. "members" (of an ensemble, 0:
 * none was made), "quantities" (that statistics are of), "noise" [m], "seed", "statistics_from" and
 * "statistics_until" [s]: see hooke_study_statistic(). NaN for another word. */
HOOKE_API double hooke_study_figure(const hooke_study *study, const char *what);

/* ---- rows: a method with one step or tolerance each, the coarsest first ---- */

HOOKE_API int64_t hooke_study_row_count(const hooke_study *study);
/* "method", "status" ("finished", "diverged", "stopped", "failed"); NULL if there is no such row. */
HOOKE_API const char *hooke_study_text(const hooke_study *study, int64_t row, const char *what);
/* The numbers of hooke_comparison_number(), over the frames that are trusted, and "wall_median" [s]
 * ("wall_seconds" is the least of "repeats" runs), "linear_iterations", "near_floor" (1: the error is within
 * ten times of the agreement), "near_energy_floor" (likewise of the drift), "timed_alone" (0: other rows ran
 * beside it, so its time may be too long). "watched:Q": the largest difference of a watched quantity from the
 * reference, in its unit, over the frames that are trusted; of a period that of the two periods over these,
 * NaN where there are fewer than two passages or four frames a period. */
HOOKE_API double hooke_study_number(const hooke_study *study, int64_t row, const char *what);
/* "time", "error", "energy_drift" over frames, as hooke_comparison_series(); "watched:Q": the values of a
 * watched quantity (of a period those of what it is of), with row -1 those of the reference. */
HOOKE_API int64_t hooke_study_frame_count(const hooke_study *study);
HOOKE_API const double *hooke_study_series(const hooke_study *study, int64_t row, const char *what);

/* ---- orders of the fixed-step methods ---- */

/* "order" by least squares of log error on log step over the finest rows that stand clear of the floor, the
 * 95 % confidence interval of that slope, "low" and "high", as if the points scattered about a line by
 * chance, and "theory"; NaN where there are fewer than three such rows, or for an error-controlled method. */
HOOKE_API double hooke_study_order(const hooke_study *study, const char *method, const char *what);
/* Why the order may not be that of the theory on this scene; "" where it is. */
HOOKE_API const char *hooke_study_order_note(const hooke_study *study, const char *method);

/* ---- the recommendation ---- */

/* Finds the cheapest step or tolerance whose error is at most `want` [m] by running it; may be called again
 * with another want. HOOKE_OK also when nothing meets it; hooke_study_recommendation_text("note") then says
 * what is in the way. */
HOOKE_API int32_t hooke_study_recommend(hooke_study *study, double want);
/* "method" (that of the closest run if nothing meets the want; NULL if no run finished), "note" ("" if the
 * want is met); NULL before any. */
HOOKE_API const char *hooke_study_recommendation_text(const hooke_study *study, const char *what);
/* "met" (0 or 1), "want", "step", "rtol", "atol", "error", "wall_seconds", "force_evaluations"; and where the
 * want is met what it has to spare: "error_low" and "error_high" (less and plus the agreement), "limit_share"
 * (its step over the largest stable one at the start), "holds_stiffness" (0 or 1: the want is met with 10 %
 * more stiffness, and with less) with the larger error "error_stiffness", "holds_start" (the same with 10 %
 * of the largest speed added along (1, 1, 1) at the start, and against it) and "error_start". NaN where it
 * does not apply or is not known. */
HOOKE_API double hooke_study_recommendation_number(const hooke_study *study, const char *what);

/* ---- statistics, for motion that cannot be judged to the end ---- */

/* With the option "ensemble", and a reference that is trusted for a part of the run only: so many runs by the
 * reference's method, and by each method that has a row that finished, at the recommended value, else that of
 * its cheapest row that meets the want, else of its finest row. Each starts with every free particle
 * displaced by Gaussian noise of root mean square "noise": a tenth of the want, or a millionth of the extent
 * without one. The statistics are of each run's means over the frames from "statistics_from" to
 * "statistics_until", which follow those that are trusted; of a period, of its period over these.
 *   "mean", "spread" (standard deviation of the runs), "members" (runs that have the quantity), "failed"
 *   (runs that did not come to their end; there are no statistics of a method that has one), "step", "rtol"
 *   (at which it ran)
 *   "bias"  the method's mean less the reference's, in standard errors of that difference: below 2 in size none is seen
 * for a quantity and a method, or "reference". NaN where there are none. Keeps within the budget, of which
 * three tenths are left for it; it then has fewer members. */
HOOKE_API double hooke_study_statistic(const hooke_study *study, const char *method, const char *quantity,
                                       const char *what);

/* Picks a method and its step or tolerance for the error `want` [m] of a run, as hooke_estimate_pick() does
 * (estimate.h), and sets them in `run`. `progress` may be NULL. HOOKE_BAD_VALUE if nothing is known to meet
 * the want. */
HOOKE_API int32_t hooke_study_pick(const hooke_system *system, hooke_options *run, double want,
                                   hooke_progress *progress, void *ctx);

#ifdef __cplusplus
}
#endif
#endif
