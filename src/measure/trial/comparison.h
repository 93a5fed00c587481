/* The object of a measurement of kind "comparison". */
#ifndef HOOKE_MEASURE_TRIAL_COMPARISON_H
#define HOOKE_MEASURE_TRIAL_COMPARISON_H

#include "measure/measurement.h"
#include "measure/trial/reference.h"

struct hk_comparison_row {
  const char *method;
  struct hk_trial trial;
};

struct hk_comparison {
  const hooke_measurement *measurement;
  const hooke_system *system;
  hooke_options *run;            /* of the measurement */
  struct hk_reference reference; /* its method is NULL until it is there */
  int64_t frame_count;           /* 0 until prepared */
  int64_t row_count;
  struct hk_comparison_row *row;

  hooke_comparison_frame *on_frame;
  void *on_frame_ctx;

  int64_t runs_begun; /* the current one is the last: 1 the reference, 2 the first row */
  double told;        /* largest reported fraction */
};

/* Finds the number of frames; once, before the first run. */
int32_t hk_comparison_prepare(struct hk_comparison *comparison);

extern const struct hk_table hk_comparison_tables[];

extern const struct hk_measurement_kind hk_comparison_kind;

#endif
