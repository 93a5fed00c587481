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
    HOOKE_COLUMN(struct comparison_line, frames, COUNT, "", "frames compared; 0 until it is run or written"),
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
  const char *method;
  struct hk_series time;
};

static int64_t count_references(const void *object) {
  return ((const struct hk_comparison *)object)->reference != NULL;
}

static void read_reference(const void *object, int64_t row, void *line) {
  const struct hk_comparison *c = object;
  (void)row;
  *(struct reference_line *)line =
      (struct reference_line){.method = c->reference, .time = {c->frames.time, c->frame_count}};
}

static const struct hk_column reference_columns[] = {
    HOOKE_COLUMN(struct reference_line, method, TEXT, "", "integrator that made the reference"),
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

struct row_line {
  const char *method, *status;
  double step, rtol, atol, error, error_max, error_final, energy_drift;
  double force_evaluations, steps, linear_iterations, wall_seconds;
  struct hk_series error_at, energy_drift_at;
};

static int64_t count_rows(const void *object) {
  return ((const struct hk_comparison *)object)->row_count;
}

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_comparison *c = object;
  const struct hk_comparison_row *r = &c->row[row];
  static const struct hk_trial none = {.status = "not run",
                                       .step = NAN,
                                       .rtol = NAN,
                                       .atol = NAN,
                                       .error = NAN,
                                       .error_max = NAN,
                                       .error_final = NAN,
                                       .energy_drift = NAN,
                                       .force_evaluations = NAN,
                                       .steps = NAN,
                                       .linear_iterations = NAN,
                                       .wall_seconds = NAN};
  const struct hk_trial *t = r->trial.status ? &r->trial : &none;
  *(struct row_line *)line = (struct row_line){
      .method = r->method,
      .status = t->status,
      .step = t->step,
      .rtol = t->rtol,
      .atol = t->atol,
      .error = t->error,
      .error_max = t->error_max,
      .error_final = t->error_final,
      .energy_drift = t->energy_drift,
      .force_evaluations = t->force_evaluations,
      .steps = t->steps,
      .linear_iterations = t->linear_iterations,
      .wall_seconds = t->wall_seconds,
      .error_at = {t->error_at, c->frame_count},
      .energy_drift_at = {t->drift_at, c->frame_count},
  };
}

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN(struct row_line, method, TEXT, "", "method"),
    HOOKE_COLUMN(struct row_line, step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_COLUMN(struct row_line, rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
    HOOKE_COLUMN(struct row_line, atol, NUMBER, "m", "absolute tolerance of positions"),
    HOOKE_COLUMN(struct row_line, error, NUMBER, "m",
                 "largest root mean square over the free particles of the distance to the reference"),
    HOOKE_COLUMN(struct row_line, error_max, NUMBER, "m", "largest distance of any free particle"),
    HOOKE_COLUMN(struct row_line, error_final, NUMBER, "m", "root mean square distance at the last frame"),
    HOOKE_COLUMN(struct row_line, energy_drift, NUMBER, "J",
                 "largest difference of energy from the reference"),
    HOOKE_COLUMN(struct row_line, force_evaluations, COUNT, "", "evaluations of the forces"),
    HOOKE_COLUMN(struct row_line, steps, COUNT, "", "steps taken"),
    HOOKE_COLUMN(struct row_line, linear_iterations, COUNT, "", "iterations of linear solvers"),
    HOOKE_COLUMN(struct row_line, wall_seconds, NUMBER, "s", "wall time"),
    HOOKE_COLUMN(struct row_line, status, TEXT, "", "finished, diverged, stopped, failed or not run"),
    HOOKE_COLUMN(struct row_line, error_at, SERIES, "m",
                 "root mean square distance at every frame; NaN past the end of the run"),
    HOOKE_COLUMN(struct row_line, energy_drift_at, SERIES, "J",
                 "energy less that of the reference at every frame"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "the methods, each run once",
    HOOKE_TABLE_COLUMNS(row_columns, struct row_line),
    .count = count_rows,
    .read = read_row,
};

const struct hk_table *const hk_comparison_tables[HOOKE_COMPARISON_TABLES] = {&comparison_table,
                                                                              &reference_table, &row_table};
