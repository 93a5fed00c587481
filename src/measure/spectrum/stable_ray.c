#include "measure/spectrum/limit_rules.h"

#include <math.h>
#include <stdlib.h>

/* The series of exp(z) up to its power `n`, at z = r (x + i y) with x^2 + y^2 = 1: |series|^2 - 1, by powers
 * of r. The first n are those of exp(2 x r), in which nothing cancels near the imaginary axis. */
enum { MOST_DEGREE = 4 };

static void expand(int32_t n, double x, double y, double power[2 * MOST_DEGREE + 1]) {
  static const double factorial[] = {1.0, 1.0, 2.0, 6.0, 24.0};
  double turned[MOST_DEGREE + 1] = {1.0}, sine = 0.0; /* real parts of (x + i y)^k */
  for (int32_t k = 0; k <= n; k++)
    power[k] = pow(2.0 * x, k) / factorial[k];
  for (int32_t k = 0; k < n; k++) {
    turned[k + 1] = turned[k] * x - sine * y;
    sine = sine * x + turned[k] * y;
  }
  for (int32_t m = n + 1; m <= 2 * n; m++)
    for (int32_t j = m - n; j <= n; j++)
      power[m] += turned[abs(2 * j - m)] / (factorial[j] * factorial[m - j]);
}

/* In the left half plane a ray leaves what is stable once, at up to 2 for degrees 1 and 2, where that is 0 on
 * the axis, and at 2.6 to 3.2 for degree 4. */
double hk_ray_reach(int32_t degree, double real, double imaginary) {
  const double size = hypot(real, imaginary);
  double power[2 * MOST_DEGREE + 1] = {0.0}, low = degree == 4 ? 2.6 : 0.0, high = 3.2;
  if (degree < 4 && real >= 0.0) return 0.0;
  expand(degree, real / size, imaginary / size, power);
  while (high - low > 4e-16 * high) {
    const double r = 0.5 * (low + high);
    double rise = 0.0;
    for (int32_t m = 2 * degree; m > 0; m--)
      rise = r * rise + power[m];
    *(rise <= 0.0 ? &low : &high) = r;
  }
  return 0.5 * (low + high);
}
