/* One spring, to the parenthesis. Every loop over springs, on every instruction set, computes exactly this;
 * the library promises this order of operations, and no product may be contracted into a fused multiply-add.
 */
#pragma once

#include <math.h>
#include <stdint.h>

#ifndef HOOKE_INLINE
#define HOOKE_INLINE static inline __attribute__((always_inline))
#endif

/* Loops return 1 for each spring shorter than half its rest length, and HOOKE_LOST more if its ends
 * coincide. */
#define HOOKE_LOST (INT64_C(1) << 32)

HOOKE_INLINE int64_t hk_spring_shortness(double r, double rest_length) {
  const int64_t near = r + r < rest_length;
  return near + (near & (r == 0.0)) * HOOKE_LOST;
}

/* 1 if (x, y) has turned by more than a right angle: its ends have passed through each other. */
HOOKE_INLINE int hk_spring_turned(const double *x, const double *y, const double *to_x, const double *to_y) {
  double along = 0.0;
  for (int a = 0; a < 3; a++)
    along += (x[a] - y[a]) * (to_x[a] - to_y[a]);
  return along < 0.0;
}

/* The length of (dx, dy, dz). */
HOOKE_INLINE double hk_spring_length(double dx, double dy, double dz) {
  return sqrt((dx * dx + dy * dy) + dz * dz);
}

/* 1/r, and 0 if r = 0: coincident ends have no direction and no force. */
HOOKE_INLINE double hk_spring_inverse_length(double r) {
  return 1.0 / (r == 0.0 ? INFINITY : r);
}

/* Tension kappa (r - l0) + gamma v.u [N]; a spring that only pulls has none while slack, and never pushes. */
HOOKE_INLINE double hk_spring_tension(double r, double rest_length, double kappa, double damping_force,
                                      int damped, int pull_only) {
  double tension = kappa * (r - rest_length);
  if (damped) tension = tension + damping_force;
  /* no branch: | and not || */
  if (pull_only) tension = ((r <= rest_length) | (tension < 0.0)) ? 0.0 : tension;
  return tension;
}
