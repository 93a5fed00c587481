/* Compensated sums (Neumaier 1974): the error does not grow with the number of terms. A plain sum of a
 * million equal numbers loses five digits. */
#pragma once

#include <math.h>

struct hk_sum {
  double sum, lost;
};

static inline void hk_sum_add(struct hk_sum *total, double x) {
  const double sum = total->sum + x;
  total->lost += fabs(total->sum) >= fabs(x) ? (total->sum - sum) + x : (x - sum) + total->sum;
  total->sum = sum;
}

/* Beyond the largest number there is no correction. */
static inline double hk_sum_value(const struct hk_sum *total) {
  return isfinite(total->sum) ? total->sum + total->lost : total->sum;
}
