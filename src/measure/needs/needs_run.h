/* Internal interface of the files that run variants. */
#ifndef HOOKE_MEASURE_NEEDS_NEEDS_RUN_H
#define HOOKE_MEASURE_NEEDS_NEEDS_RUN_H

#include "measure/needs/needs.h"
#include "measure/recommend/soundness.h"

struct hk_needs_recorder {
  struct hk_needs *needs;
  const struct hk_needs_trial *trial;
  struct hk_needs_path *path; /* NULL: only the time is needed */
  double last_step;
  double share_begun, fraction; /* of the measurement: before this run, and for it */
  int32_t displaced;            /* 1: it starts from a displaced start */
  int32_t judges, sound; /* 1: its step and its energy are judged; they are sound (recommend/soundness.h) */
  struct hk_soundness soundness;
};

/* Runs once. `finished`: 0 if it diverged or its solver failed, which is a result here. Returns HOOKE_STOPPED
 * and other failures. */
int32_t hk_needs_run_once(struct hk_needs_recorder *recorder, const hooke_options *options, int32_t *finished,
                          struct hk_needs_cost *cost);

#endif
