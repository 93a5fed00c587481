/* What each ingredient of a scene costs a step: it is timed with the ingredient and without. */
#pragma once

#include "measure/measurement.h"
#include "measure/trial/budget.h"
#include "model/particles.h"

struct hk_cost_row {
  const char *kind;
  int64_t group;  /* -1: not of a group */
  int64_t size;   /* members of the group; 1 for an ingredient without group */
  int32_t chosen; /* 0: one of too many groups, skipped */
  double nanoseconds, resolution, memory, limit;
};

struct hk_cost {
  const hooke_measurement *m; /* its `run` has the method that is timed */
  const char *method;
  double run_step;         /* [s] as given by the caller, NaN: not */
  struct hk_budget budget; /* of limits, within the budget */
  double told;             /* fraction done */
  double step, nanoseconds, resolution, memory, limit;
  int64_t row_count, chosen_count;
  struct hk_cost_row *row;
};

/* Name of its group, otherwise its kind. */
const char *hk_cost_row_name(const struct hk_cost *cost, const struct hk_cost_row *row);

/* Says what a step takes, and what limits it. */
void hk_cost_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_table hk_cost_tables[];
extern const struct hk_measurement_kind hk_cost_kind;
