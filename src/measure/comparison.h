/* What a comparison holds. */
#ifndef HOOKE_MEASURE_COMPARISON_H
#define HOOKE_MEASURE_COMPARISON_H

#include "hooke/measure.h"

struct hooke_comparison_row {
  char *method;
  const char *status; /* NULL: not run yet */
  double step, rtol, atol, error, error_max, error_final, energy_drift, force_evaluations, steps,
      wall_seconds;
  double *error_at, *drift_at; /* one a frame, NaN where there is none */
};

struct hooke_comparison {
  const hooke_system *system;
  hooke_options *options;
  const char *reference; /* method */
  int64_t row_count, row_capacity;
  struct hooke_comparison_row *row;

  int64_t frame_count;
  double *time, *energy, *position; /* of the reference: frame_count, frame_count, 3n frame_count */
  int64_t *free, free_count;

  hooke_progress *progress;
  void *progress_ctx;
  hooke_comparison_frame *on_frame;
  void *on_frame_ctx;

  /* the run under way: row -1 is the reference */
  int64_t current, frame;
  int64_t runs_done;
  double t0, duration;
};

/* Room for frames and rows, and the method that gives the reference; once, before the first run. */
int32_t hooke_comparison_prepare(hooke_comparison *comparison);

#endif
