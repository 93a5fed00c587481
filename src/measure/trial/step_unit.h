/* The steps that fit a run. */
#ifndef HOOKE_MEASURE_TRIAL_STEP_UNIT_H
#define HOOKE_MEASURE_TRIAL_STEP_UNIT_H

#include "hooke/options.h"

/* The largest step [s] of which `duration` and `every` are whole multiples: it and its integer fractions fit
 * both. HOOKE_BAD_VALUE if the times have none that is not very small. */
int32_t hk_step_unit(double duration, double every, double *unit);

/* Duration and time between frames [s] of a run; without `every` it is set to a hundredth of the duration.
 * HOOKE_BAD_VALUE without a duration. */
int32_t hk_step_times(hooke_options *run, double *duration, double *every);

/* 1 if a quotient is a whole number >= 1, to 1e-9 relative. */
int32_t hk_step_is_whole(double quotient);

#endif
