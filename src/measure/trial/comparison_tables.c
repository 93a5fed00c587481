/* The tables of a comparison. */
#include "measure/trial/comparison.h"

#include <math.h>
#include <stddef.h>

/* ---- the comparison ---- */

HOOKE_READER(double, duration, struct hk_comparison, hooke_options_number(it->run, "duration"))

static const struct hk_column comparison_columns[] = {
    HOOKE_COLUMN_BY(duration, duration, NUMBER, "s", "duration of the run"),
    HOOKE_COLUMN_AS(struct hk_comparison, frame_count, frames, COUNT, "",
                    "frames of every run; 0 until it is run or written"),
};

/* ---- the reference ---- */

HOOKE_READER(double, agreement, struct hk_comparison, it->reference.method ? it->reference.agreement : NAN)
HOOKE_READER(double, trusted_until, struct hk_comparison,
             hk_reference_time(&it->reference, it->reference.trusted, duration(it, 0)))
HOOKE_COUNTER(count_references, struct hk_comparison, it->frame_count > 0)
HOOKE_COUNTER(frames, struct hk_comparison, it->frame_count)

static const struct hk_column reference_columns[] = {
    HOOKE_COLUMN_AS(struct hk_comparison, reference.method, method, TEXT, "",
                    "integrator that made the reference"),
    HOOKE_COLUMN_AS(struct hk_comparison, reference.check, check, TEXT, "",
                    "integrator that checked it; they share only the forces"),
    HOOKE_COLUMN_BY(
        agreement, agreement, NUMBER, "m",
        "twice the largest distance of a particle between the two over the frames that are trusted; "
        "NaN if none after the start is"),
    HOOKE_COLUMN_BY(trusted_until, trusted_until, NUMBER, "s",
                    "time up to which the two agree to a millionth of the extent of the motion; errors are "
                    "judged up to there"),
    HOOKE_COLUMN_AS(struct hk_comparison, reference.frames.time, time, SERIES, "s", "times of the frames"),
};

/* ---- rows ---- */

HOOKE_READER(const void *, find_row, struct hk_comparison, &it->row[row])
HOOKE_READER(const char *, status, struct hk_comparison,
             it->row[row].trial.status ? it->row[row].trial.status : "not run")

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN(struct hk_comparison_row, method, TEXT, "", "method"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.step, step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.rtol, rtol, NUMBER, "",
                    "relative tolerance of an error-controlled method"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.atol, atol, NUMBER, "m",
                    "absolute tolerance of positions"),
    HOOKE_TRIAL_COLUMNS(struct hk_comparison_row),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.linear_iterations, linear_iterations, COUNT, "",
                    "iterations of linear solvers"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.wall_seconds, wall_seconds, NUMBER, "s", "wall time"),
    HOOKE_COLUMN_BY(status, status, TEXT, "", "finished, diverged, stopped, failed or not run"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.error_at, error_at, SERIES, "m",
                    "root mean square distance at every frame; NaN past the end of the run, and where the "
                    "reference is not trusted"),
    HOOKE_COLUMN_AS(struct hk_comparison_row, trial.drift_at, energy_drift_at, SERIES, "J",
                    "energy less that of the reference at every frame"),
};

/* ---- the tables ---- */

const struct hk_table hk_comparison_tables[] = {{.name = "comparison",
                                                 .doc = "the comparison itself",
                                                 .record = 1,
                                                 HOOKE_TABLE_COLUMNS(comparison_columns)},
                                                {.name = "reference",
                                                 .doc = "the solution that errors are measured against",
                                                 .record = 1,
                                                 HOOKE_TABLE_COLUMNS(reference_columns),
                                                 .count = count_references,
                                                 .length = frames},
                                                {.name = "rows",
                                                 .doc = "the methods, each run once",
                                                 HOOKE_TABLE_COLUMNS(row_columns),
                                                 HOOKE_TABLE_COUNT(struct hk_comparison, row_count),
                                                 .row = find_row,
                                                 .length = frames},
                                                {.name = NULL}};
