#include "measure/spectrum/limit_rules.h"

#include <math.h>

/* |1 + z + z^2/2 + z^3/6 + z^4/24|^2 - 1 at z = x + i y */
static double growth(double x, double y) {
  double re = 1.0, im = 0.0;
  for (int k = 4; k > 0; k--) {
    const double a = (re * x - im * y) / k, b = (re * y + im * x) / k;
    re = 1.0 + a;
    im = b;
  }
  return re * re + im * im - 1.0;
}

/* In the left half plane all of |z| <= 2.6 is stable, and nothing at |z| = 3.2. */
double hk_rk4_reach(double real, double imaginary) {
  const double size = hypot(real, imaginary), x = real / size, y = imaginary / size;
  double low = 2.6, high = 3.2;
  while (high - low > 1e-15) { /* two units in the last place */
    const double middle = 0.5 * (low + high);
    if (growth(middle * x, middle * y) <= 0.0)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* |1 + z + z^2/2| <= 1 at z = r (x + i y) where r^3 + 4 x r^2 + 8 x^2 r + 8 x <= 0. This rises with r, and
 * is 0 from 1 to 1.5 times 2 (-x)^(1/3). */
double hk_heun_reach(double real, double imaginary) {
  const double x = real / hypot(real, imaginary);
  double low = 2.0 * cbrt(fmax(0.0, -x)), high = 1.5 * low;
  while (high - low > 4e-16 * high) {
    const double r = 0.5 * (low + high);
    if (r <= low || r >= high) break;
    if (((r + 4.0 * x) * r + 8.0 * x * x) * r + 8.0 * x <= 0.0)
      low = r;
    else
      high = r;
  }
  return 0.5 * (low + high);
}

double hk_real_reach(int32_t degree) {
  return degree == 4 ? hk_rk4_reach(-1.0, 0.0) : 2.0;
}
