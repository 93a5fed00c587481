/* The object of a measurement of kind "comparison". */
#ifndef HOOKE_MEASURE_TRIAL_COMPARISON_H
#define HOOKE_MEASURE_TRIAL_COMPARISON_H

#include "measure/measurement.h"
#include "measure/trial/trial.h"

struct hk_comparison_row {
  const char *method;
  struct hk_trial trial;
};

struct hk_comparison {
  const hooke_measurement *measurement;
  const hooke_system *system;
  hooke_options *run;      /* of the measurement */
  const char *reference;   /* method; NULL until prepared */
  struct hk_frames frames; /* of the reference */
  int64_t frame_count;
  int64_t row_count, row_capacity;
  struct hk_comparison_row *row;

  hooke_comparison_frame *on_frame;
  void *on_frame_ctx;

  int64_t runs_begun; /* the current one is the last: 1 the reference, 2 the first row */
};

/* Allocates frames and rows, and chooses the method of the reference; once, before the first run. */
int32_t hk_comparison_prepare(struct hk_comparison *comparison);
/* Undoes that. */
void hk_comparison_release_room(struct hk_comparison *comparison);

enum { HOOKE_COMPARISON_TABLES = 3 };
extern const struct hk_table *const hk_comparison_tables[HOOKE_COMPARISON_TABLES];

extern const struct hk_measurement_kind hk_comparison_kind;

#endif
