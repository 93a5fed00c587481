#include "measure/trial/step_unit.h"

#include "core/status.h"

#include <math.h>

int32_t hk_step_is_whole(double quotient) {
  return fabs(quotient - round(quotient)) <= 1e-9 * quotient && round(quotient) >= 1.0;
}

int32_t hk_step_unit(double duration, double every, double *unit) {
  for (int32_t parts = 1; parts <= 10000; parts++) {
    *unit = every / (double)parts;
    if (hk_step_is_whole(duration / *unit)) return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, "every",
                 "%.6g s and duration %.6g s have no step in common; take a part of the duration", every,
                 duration);
}

int32_t hk_step_times(hooke_options *run, double *duration, double *every) {
  *duration = hooke_options_number(run, "duration");
  *every = hooke_options_number(run, "every");
  if (isnan(*duration)) {
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  if (isnan(*every)) *every = *duration / 100.0;
  return hooke_options_set_number(run, "every", *every);
}
