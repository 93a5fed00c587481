/* A state: t, q and v in one block. */
#ifndef HOOKE_MODEL_STATE_H
#define HOOKE_MODEL_STATE_H

#include "hooke/state.h"

struct hooke_state {
  int64_t size; /* numbers in q */
  int32_t has_v;
  double *t, *q, *v; /* one block; v is NULL for a first-order problem */
};

#endif
