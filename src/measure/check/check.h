/* What a scene is and takes, and what is seldom meant in it, without running it. */
#pragma once

#include "measure/measurement.h"
#include "model/group.h"
#include "model/system.h"

struct hk_check {
  const hooke_measurement *m;
  double *bound;                 /* on the step of each method [s]; NaN if unknown */
  int64_t most, written, factor; /* memory of a run [bytes], of one with output, and with a factor; or -1 */
  int64_t counted;               /* of them for system, state and method */
  struct hk_claims warnings;
};

/* Tells the warnings first, then what is there to know of memory and work. */
void hk_check_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_table hk_check_tables[];
extern const struct hk_measurement_kind hk_check_kind;
