/* How one step of a method multiplies the amplitude of a single mode. */
#pragma once

#include "integrate/method.h"

/* The largest modulus of the factors by which a step h of a method that is stable so multiplies x'' + 2 decay
 * x' + frequency^2 x = 0: above 1 it grows. NaN where no rule is known. Sources: docs/notes/methods.md,
 * "Stability". */
double hk_mode_growth(const struct hk_stability *stability, double h, double frequency, double decay);
/* The same of a motion exp(lambda t), lambda = real + i imaginary [1/s], for methods whose step is a
 * polynomial of h lambda; NaN for others. */
double hk_eigenvalue_growth(const struct hk_stability *stability, double h, double real, double imaginary);
