/* The motion q'' = w f(t, q, v) by an integrator that is not hooke's: GSL's of Prince and Dormand, to nearly
 * all digits. */
#pragma once

#include "hooke.h"

enum { GSL_MOTION_MOST = 4 };

struct gsl_motion {
  int64_t count; /* coordinates, GSL_MOTION_MOST at most */
  hooke_force *force;
  double inverse_mass;
  void *ctx; /* of the force */
};

/* Takes q, then v, 2 `count` together, from one time to another. */
void gsl_move(const struct gsl_motion *motion, double from, double to, double *y);
