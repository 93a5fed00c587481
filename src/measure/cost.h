/* A cost and its rows. */
#ifndef HOOKE_MEASURE_COST_H
#define HOOKE_MEASURE_COST_H

#include "hooke/cost.h"
#include "measure/cost_time.h"
#include "model/system.h"

struct hooke_cost_row {
  const char *kind;
  int64_t group; /* -1: not of a group */
  double nanoseconds, resolution, memory, limit;
};

struct hooke_cost {
  const hooke_system *system;
  hooke_options *run, *options; /* run: of the method that is timed */
  const char *method;           /* within `run` */
  double run_step;              /* [s] as the caller gave it, NaN: not */
  hooke_progress *progress;
  void *progress_ctx;
  double step, nanoseconds, resolution, memory, limit;
  int64_t row_count;
  struct hooke_cost_row *row;
};

#endif
