/* A cost and its rows. */
#ifndef HOOKE_MEASURE_COST_COST_H
#define HOOKE_MEASURE_COST_COST_H

#include "hooke/cost.h"
#include "measure/cost/cost_time.h"
#include "measure/trial/patience.h"
#include "model/system.h"

struct hk_cost_row {
  const char *kind;
  int64_t group;  /* -1: not of a group */
  int64_t size;   /* of the group; 1 of what is there without one */
  int32_t chosen; /* 0: one of too many groups, not looked at */
  double nanoseconds, resolution, memory, limit;
};

struct hooke_cost {
  const hooke_system *system;
  hooke_options *run, *options; /* run: of the method that is timed */
  const char *method;           /* within `run` */
  double run_step;              /* [s] as the caller gave it, NaN: not */
  struct hk_patience patience;  /* of limits, within the budget */
  hooke_progress *progress;
  void *progress_ctx;
  double told; /* share done */
  double step, nanoseconds, resolution, memory, limit;
  int64_t row_count, chosen_count;
  struct hk_cost_row *row;
};

/* Lists what is there, and chooses all that is not of a group and as many groups as the options say.
 * HOOKE_NO_MEMORY. */
int32_t hk_cost_list_rows(hooke_cost *cost);
int32_t hk_cost_row_is(const struct hk_cost_row *row, const char *kind);

#endif
