/* The largest stable step by the spectrum, one rule a method. */
#ifndef HOOKE_MEASURE_SPECTRUM_LIMIT_RULES_H
#define HOOKE_MEASURE_SPECTRUM_LIMIT_RULES_H

#include "measure/spectrum/spectrum.h"

struct hk_prediction {
  /* [s]: 0 where no step is stable, infinity where nothing limits it, NaN where no rule is known */
  double limit;
  /* [s]: stable for certain up to here, by the extreme eigenvalues; not above `limit`, NaN where they do
   * not tell */
  double sure;
  int32_t exact, never_stable;
  const char *note;
  int32_t has_mode; /* `mode` was written */
  double *mode;     /* 3n from the caller: the mode that limits, x.Mx = 1 */
};

/* 1 if the rule asks for eigenvalues other than the extreme ones of K and of h^2 K + 2 h C. */
int32_t hk_limit_rule_needs_all(const char *method);

/* HOOKE_BAD_VALUE for an unknown method. */
int32_t hk_limit_rule(struct hk_spectrum *spectrum, const char *method, struct hk_prediction *out);

/* How far from 0 Runge-Kutta 4 and Heun's method are stable on the ray to (real, imaginary), real <= 0
 * (stable_ray.c). */
double hk_rk4_reach(double real, double imaginary);
double hk_heun_reach(double real, double imaginary);

#endif
