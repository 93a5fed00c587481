/* Sums that keep what each addition rounds off (Neumaier 1974): their error does not grow with their length.
 * A million equal numbers added up plainly lose five digits. */
#ifndef HOOKE_CORE_SUM_H
#define HOOKE_CORE_SUM_H

#include <math.h>

struct hk_sum {
  double sum, lost;
};

static inline void hk_sum_add(struct hk_sum *total, double x) {
  const double sum = total->sum + x;
  total->lost += fabs(total->sum) >= fabs(x) ? (total->sum - sum) + x : (x - sum) + total->sum;
  total->sum = sum;
}

/* Beyond the largest number nothing is lost that could be named. */
static inline double hk_sum_value(const struct hk_sum *total) {
  return isfinite(total->sum) ? total->sum + total->lost : total->sum;
}

#endif
