/* The largest stable step by the spectrum, one rule a method. */
#pragma once

#include "measure/spectrum/spectrum.h"

struct hk_prediction {
  /* [s]: 0 if no step is stable, infinity if nothing limits it, NaN if no rule is known or bodies spin too
   * fast for it */
  double limit;
  /* [s]: certainly stable up to here, by the extreme eigenvalues; at most `limit`, NaN if they do not suffice
   */
  double sure;
  int32_t exact, never_stable;
  int32_t spins; /* 1: not known for that reason */
  const char *note;
  int32_t has_mode; /* `mode` was written */
  double *mode;     /* 3n from the caller: the limiting mode, x.Mx = 1 */
};

/* 1 if the rule needs eigenvalues other than the extreme ones of K and of h^2 K + 2 h C. */
int32_t hk_limit_rule_needs_all(const char *method);

/* A system linearised at rest tells the limit to 1e-3 where every body turns by less than 1e-3 rad while the
 * limiting mode swings or decays by 1 rad: gyroscopic and centrifugal forces, which are left out, change an
 * eigenvalue by no more than that. Otherwise the limit is NaN. HOOKE_BAD_VALUE for an unknown method. */
int32_t hk_limit_rule(struct hk_spectrum *spectrum, const char *method, struct hk_prediction *out);

/* hooke_limit_of_mode() for steps of this system, in which bodies may move. */
double hk_limit_of_mode_in(const hooke_system *system, const char *method, double frequency, double decay);

/* Distance from 0 up to which the Runge-Kutta method of degree 1, 2 or 4 is stable on the ray to (real,
 * imaginary), real <= 0 (stable_ray.c). */
double hk_ray_reach(int32_t degree, double real, double imaginary);
