/* The price of a remedy: the error that a change of the scene makes over the whole run, as `needs` has it. */
#pragma once

#include "measure/trial/budget.h"
#include "model/variant/variant.h"

struct hk_price {
  double error; /* the largest distance of a free particle [m]; NaN: not known */
  double want;  /* then one to ask `needs` with [m]; NaN: the run has no duration, and `needs` neither */
};

/* One run of the changed system against one of the system itself, both by a method at the step of the run, or
 * at 0.9 of `limit` [s] where that is below it. Each has half a second of counted work at most, and a third
 * of what is left of the budget, so that the answer is the same on busy machines: what takes more, or more
 * than 64 MB, does not come to its end, does not move, or calls back, has no known price. `run` may be NULL.
 * HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_price_find(const hooke_system *system, const hooke_options *run, const char *method, double limit,
                      const struct hk_variant *change, struct hk_budget *budget, struct hk_price *price);
