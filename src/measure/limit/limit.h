/* The largest stable step of each method: predicted from the fastest motion of the linearised system,
 * measured by running, with what limits it and what would raise it. */
#pragma once

#include "measure/limit/limit_participation.h"
#include "measure/measurement.h"
#include "measure/spectrum/limit_rules.h"
#include "measure/trial/method_list.h"

enum { HOOKE_LIMIT_NOTE = 640 };

struct hk_limit_row {
  const char *method;
  double bound, predicted, measured; /* [s] */
  double steps_run, smallest, smallest_time;
  int32_t exact, never_stable, spins, has_mode;
  double *mode;    /* 3n, in rows of x y z */
  int64_t unknown; /* frames along a run at which there is no prediction */
  char note[HOOKE_LIMIT_NOTE];
};

struct hk_limit_mode {
  double real, imaginary;  /* of its eigenvalue */
  double frequency, decay; /* x'' + 2 decay x' + frequency^2 x = 0 */
};

struct hk_limit {
  const hooke_measurement *measurement;
  const hooke_system *system; /* the measurement's, as `at` has it at the time of the last state */
  hooke_system at;
  const hooke_options *run, *options; /* of the measurement; `run` may be NULL */
  int32_t row_count;
  struct hk_limit_row row[HOOKE_LISTED_METHODS];

  /* of the last state */
  double *q, *v; /* 3n */
  double time;
  int32_t found;
  double frequency, decay; /* [rad/s], [1/s] */
  int64_t products, clamped, tipping;
  int64_t mode_count;
  struct hk_limit_mode *mode;
  double *shape, *stiffest; /* 3n; the second, a start for the next state, x, y and z apart */
  int32_t has_stiffest;
  struct hk_participation participation;
  struct hk_suggestion suggestion;
  struct hk_limiting_list limiting;

  struct hk_budget endless; /* which only the caller ends */
  struct hk_budget *budget; /* that, or that of a diagnosis, with the bytes that a basis may take */
  double memory;
  double share, width; /* of all work: start and fraction of the current part */
  const char *under_way;
};

/* Predictions at positions q and velocities v (3n; NULL: at rest) of the time t, and the limiting elements
 * there. */
int32_t hk_limit_look(struct hk_limit *limit, const double *q, const double *v, double t);
/* Then the price of what it suggests. */
int32_t hk_limit_price(struct hk_limit *limit);

/* Replaces bounds, predictions and modes by those at positions q and velocities v (3n; NULL: at rest). */
int32_t hk_limit_predict_rows(struct hk_limit *limit, const double *q, const double *v);

/* The row for limiting springs: that of the method of the run, or the first with a limit; NULL if none has
 * one. */
const struct hk_limit_row *hk_limit_limiting_row(const struct hk_limit *limit);

/* The table "blame" of a limit or a diagnosis. */
enum { HOOKE_LIMITING_COLUMNS = 6 };
extern const struct hk_column hk_limiting_columns[HOOKE_LIMITING_COLUMNS];
#define HOOKE_LIMITING_TABLE                                                                                 \
  .doc =                                                                                                     \
      "limiting springs, at most 100, the largest share first; before them the force that has half of the "  \
      "whole or more, if it is not the stiffness of springs",                                                \
  .columns = hk_limiting_columns, .column_count = HOOKE_LIMITING_COLUMNS,                                    \
  .lists = {{"spring", "first", "second"}}

extern const struct hk_table hk_limit_tables[];

/* What it says of its results (limit_claims.c). */
void hk_limit_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_measurement_kind hk_limit_kind;
