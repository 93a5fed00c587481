#include "kernel/step_loops.h"

void hk_advance(int64_t n, double h, const double *restrict rate, double *restrict x) {
  for (int64_t p = 0; p < n; p++)
    x[p] += h * rate[p];
}

void hk_first_stage(int64_t n, double h, const double *restrict rate, double *restrict start,
                    double *restrict sum, double *restrict x) {
  for (int64_t p = 0; p < n; p++) {
    start[p] = x[p];
    sum[p] = rate[p];
    x[p] += h * rate[p];
  }
}

void hk_middle_stage(int64_t n, double h, const double *restrict rate, const double *restrict start,
                     double *restrict sum, double *restrict x) {
  for (int64_t p = 0; p < n; p++) {
    sum[p] += 2.0 * rate[p];
    x[p] = start[p] + h * rate[p];
  }
}

void hk_last_stage(int64_t n, double h, const double *restrict rate, const double *restrict start,
                   const double *restrict sum, double *restrict x) {
  for (int64_t p = 0; p < n; p++)
    x[p] = start[p] + h * (sum[p] + rate[p]);
}
