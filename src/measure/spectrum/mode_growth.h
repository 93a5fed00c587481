/* How one step of a method multiplies the amplitude of a single mode. */
#ifndef HOOKE_MEASURE_SPECTRUM_MODE_GROWTH_H
#define HOOKE_MEASURE_SPECTRUM_MODE_GROWTH_H

#include "integrate/method.h"

/* The largest modulus of the factors by which a step h of a method that is stable so multiplies x'' + 2 decay
 * x' + frequency^2 x = 0: above 1 it grows. NaN where no rule is known. Sources: docs/notes/methods.md,
 * "Stability". */
double hk_mode_growth(const struct hk_stability *stability, double h, double frequency, double decay);
/* The same of a motion of an overdamped system that decays at `rate` [1/s]. */
double hk_relaxation_growth(const struct hk_stability *stability, double h, double rate);

#endif
