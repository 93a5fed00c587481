/* What each ingredient of a scene costs a step: it is timed with the ingredient and without. */
#ifndef HOOKE_MEASURE_COST_COST_H
#define HOOKE_MEASURE_COST_COST_H

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
  const hooke_measurement *measurement;
  const hooke_system *system;
  hooke_options *run; /* of the measurement, with the method that is timed */
  const hooke_options *options;
  const char *method;      /* within `run` */
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

/* ---- cost_time.c ---- */

/* An integrator with a state, and the time of a step in its shortest blocks [ns]. */
struct hk_timed {
  hooke_integrator *integrator;
  hooke_state *state;
  double best[2]; /* of two series; infinite before the first block */
};

/* HOOKE_NO_MEMORY and the failures of hooke_integrator_create(); hk_timed_release() is allowed after a
 * failure. */
int32_t hk_timed_create(const hooke_system *system, const hooke_options *run, struct hk_timed *timed);
void hk_timed_release(struct hk_timed *timed);

/* Runs blocks of `full`, `lean` and `full` again in turn, each from `start`, for about `seconds`, two rounds
 * at least. Both series of `full` are kept, whose difference measures the noise, and the first of `lean`.
 * Times stay infinite if the method can take no step. HOOKE_STOPPED by a callback; failures of the method are
 * not failures here. */
int32_t hk_timed_compare(struct hk_timed *full, struct hk_timed *lean, const hooke_state *start,
                         double seconds);

extern const struct hk_table hk_cost_tables[];
extern const struct hk_measurement_kind hk_cost_kind;

#endif
