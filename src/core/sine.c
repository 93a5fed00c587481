#include "core/sine.h"

#include <math.h>

/* Taylor series for |x| <= pi/4; the first omitted term is below 1e-17. */
static double short_sine(double x) {
  double y = x * x, sum = 0.0;
  static const double term[] = {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0,
                                -1.0 / 5040.0,          1.0 / 120.0,        -1.0 / 6.0};
  for (int k = 0; k < 7; k++)
    sum = (sum + term[k]) * y;
  return x + x * sum;
}

static double short_cosine(double x) {
  double y = x * x, sum = 0.0;
  static const double term[] = {
      1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0,
      1.0 / 40320.0,          -1.0 / 720.0,         1.0 / 24.0,        -1.0 / 2.0};
  for (int k = 0; k < 8; k++)
    sum = (sum + term[k]) * y;
  return 1.0 + sum;
}

void hk_sine_of_turns(double turns, double *sine, double *cosine) {
  const double quarter = 1.57079632679489661923;
  double part = turns - floor(turns); /* exact, and so is the reduction to a quadrant */
  double nearest = floor(4.0 * part + 0.5);
  double x = (4.0 * part - nearest) * quarter;
  double s = short_sine(x), c = short_cosine(x);
  switch ((int)nearest & 3) {
  case 0:
    *sine = s, *cosine = c;
    break;
  case 1:
    *sine = c, *cosine = -s;
    break;
  case 2:
    *sine = -s, *cosine = -c;
    break;
  default:
    *sine = -c, *cosine = s;
    break;
  }
}
