#include "order.h"

#include "check.h"

#include <math.h>

double observed_order(double coarse, double fine) {
  return log2(coarse / fine);
}

void check_order(const char *what, int64_t count, const double *error, double low, double high) {
  for (int64_t k = 0; k + 1 < count; k++) {
    const double order = observed_order(error[k], error[k + 1]);
    if (order >= low && order <= high) continue;
    check_failed("%s: errors %.6g, %.6g at halving %lld show order %.4f, expected %g to %g", what, error[k],
                 error[k + 1], (long long)k + 1, order, low, high);
  }
}
