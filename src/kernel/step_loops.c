#include "kernel/step_loops.h"

#include "kernel/move_loops.h"

void hk_move_numbers(int32_t kind, double kick, int64_t count, const double *restrict rate,
                     double *restrict start, double *restrict sum, double *restrict x) {
  if (kind == HOOKE_FIRST_STAGE) {
    for (int64_t p = 0; p < count; p++) {
      start[p] = x[p];
      sum[p] = rate[p];
      x[p] += kick * rate[p];
    }
  } else if (kind == HOOKE_MIDDLE_STAGE) {
    for (int64_t p = 0; p < count; p++) {
      sum[p] += 2.0 * rate[p];
      x[p] = start[p] + kick * rate[p];
    }
  } else if (kind == HOOKE_LAST_STAGE) {
    for (int64_t p = 0; p < count; p++)
      x[p] = start[p] + kick * (sum[p] + rate[p]);
  } else {
    for (int64_t p = 0; p < count; p++)
      x[p] += kick * rate[p];
  }
}
