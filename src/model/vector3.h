/* Vectors of three numbers. Sums are taken as written: they are part of the canonical definition. */
#pragma once

#include <math.h>

static inline double hk_dot3(const double a[3], const double b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static inline double hk_length3(const double a[3]) {
  return sqrt(hk_dot3(a, a));
}

/* Between two places, also where squares of it overflow. */
static inline double hk_distance3(const double a[3], const double b[3]) {
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  const double part[3] = {0x1p-600 * d[0], 0x1p-600 * d[1], 0x1p-600 * d[2]};
  return hk_length3(d) < INFINITY ? hk_length3(d) : 0x1p600 * hk_length3(part);
}

/* out = a x b; out is neither. */
static inline void hk_cross3(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* out = s a, and out += s a. */
static inline void hk_scale3(double s, const double a[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = s * a[k];
}

static inline void hk_add3(double s, const double a[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] += s * a[k];
}
