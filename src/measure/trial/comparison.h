/* What a comparison holds. */
#ifndef HOOKE_MEASURE_TRIAL_COMPARISON_H
#define HOOKE_MEASURE_TRIAL_COMPARISON_H

#include "measure/trial/trial.h"

struct hk_comparison_row {
  char *method;
  struct hk_trial trial;
};

struct hooke_comparison {
  const hooke_system *system;
  hooke_options *options;
  const char *reference;   /* method; NULL until prepared */
  struct hk_frames frames; /* of the reference */
  int64_t frame_count;
  int64_t row_count, row_capacity;
  struct hk_comparison_row *row;

  hooke_progress *progress;
  void *progress_ctx;
  hooke_comparison_frame *on_frame;
  void *on_frame_ctx;

  int64_t runs_begun; /* the one under way is the last: 1 the reference, 2 the first row */
};

/* Room for frames and rows, and the method that gives the reference; once, before the first run. */
int32_t hk_comparison_prepare(hooke_comparison *comparison);
/* Undoes that. */
void hk_comparison_release_room(hooke_comparison *comparison);

#endif
