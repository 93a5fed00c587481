/* The tables of a comparison. */
#include "measure/trial/comparison.h"

#include <math.h>
#include <stddef.h>

/* ---- the comparison ---- */

struct comparison_line {
  double duration, frames;
};

static void read_comparison(const void *object, int64_t row, void *line) {
  const struct hk_comparison *c = object;
  (void)row;
  *(struct comparison_line *)line = (struct comparison_line){
      .duration = hooke_options_number(c->run, "duration"), .frames = (double)c->frame_count};
}

static const struct hk_column comparison_columns[] = {
    HOOKE_COLUMN(struct comparison_line, duration, NUMBER, "s", "duration of the run"),
    HOOKE_COLUMN(struct comparison_line, frames, COUNT, "",
                 "frames of every run; 0 until it is run or written"),
};

static const struct hk_table comparison_table = {
    .name = "comparison",
    .doc = "the comparison itself",
    .record = 1,
    HOOKE_TABLE_COLUMNS(comparison_columns, struct comparison_line),
    .read = read_comparison,
};

/* ---- the reference ---- */

struct reference_line {
  const char *method, *check;
  double agreement, trusted_until;
  struct hk_series time;
};

static int64_t count_references(const void *object) {
  return ((const struct hk_comparison *)object)->frame_count > 0;
}

static void read_reference(const void *object, int64_t row, void *line) {
  const struct hk_comparison *c = object;
  const struct hk_reference *r = &c->reference;
  (void)row;
  *(struct reference_line *)line = (struct reference_line){
      .method = r->method,
      .check = r->check,
      .agreement = r->method ? r->agreement : NAN,
      .trusted_until = hk_reference_time(r, r->trusted, hooke_options_number(c->run, "duration")),
      .time = {r->frames.time, c->frame_count}};
}

static const struct hk_column reference_columns[] = {
    HOOKE_COLUMN(struct reference_line, method, TEXT, "", "integrator that made the reference"),
    HOOKE_COLUMN(struct reference_line, check, TEXT, "",
                 "integrator that checked it; they share only the forces"),
    HOOKE_COLUMN(struct reference_line, agreement, NUMBER, "m",
                 "twice the largest distance of a particle between the two over the frames that are trusted; "
                 "NaN if none after the start is"),
    HOOKE_COLUMN(struct reference_line, trusted_until, NUMBER, "s",
                 "time up to which the two agree to a millionth of the extent of the motion; errors are "
                 "judged up to there"),
    HOOKE_COLUMN(struct reference_line, time, SERIES, "s", "times of the frames"),
};

static const struct hk_table reference_table = {
    .name = "reference",
    .doc = "the solution that errors are measured against",
    .record = 1,
    HOOKE_TABLE_COLUMNS(reference_columns, struct reference_line),
    .count = count_references,
    .read = read_reference,
};

/* ---- rows ---- */

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_comparison *c = object;
  const struct hk_comparison_row *r = &c->row[row];
  *(struct hk_trial_line *)line = hk_trial_line(&r->trial, r->method, c->frame_count);
}

static const struct hk_column row_columns[] = {
    HOOKE_TRIAL_COLUMN(method, TEXT, "", "method"),
    HOOKE_TRIAL_COLUMN(step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_TRIAL_COLUMN(rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
    HOOKE_TRIAL_COLUMN(atol, NUMBER, "m", "absolute tolerance of positions"),
    HOOKE_TRIAL_COLUMNS,
    HOOKE_TRIAL_COLUMN(linear_iterations, COUNT, "", "iterations of linear solvers"),
    HOOKE_TRIAL_COLUMN(wall_seconds, NUMBER, "s", "wall time"),
    HOOKE_TRIAL_COLUMN(status, TEXT, "", "finished, diverged, stopped, failed or not run"),
    HOOKE_TRIAL_COLUMN(error_at, SERIES, "m",
                       "root mean square distance at every frame; NaN past the end of the run, and where the "
                       "reference is not trusted"),
    HOOKE_TRIAL_COLUMN(energy_drift_at, SERIES, "J", "energy less that of the reference at every frame"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "the methods, each run once",
    HOOKE_TABLE_COLUMNS(row_columns, struct hk_trial_line),
    HOOKE_TABLE_COUNT(struct hk_comparison, row_count),
    .read = read_row,
};

const struct hk_table *const hk_comparison_tables[HOOKE_COMPARISON_TABLES] = {&comparison_table,
                                                                              &reference_table, &row_table};
