#include "measure/limit_rules.h"

#include <math.h>

#if HOOKE_HAVE_GSL

#include <gsl/gsl_roots.h>

enum { MOST_ITERATIONS = 100 };

/* |1 + z + z^2/2 + z^3/6 + z^4/24|^2 - 1 at z = t (x + i y) */
static double growth(double t, void *ctx) {
  const double *ray = ctx, x = t * ray[0], y = t * ray[1];
  double re = 1.0, im = 0.0;
  for (int k = 4; k > 0; k--) {
    const double a = (re * x - im * y) / k, b = (re * y + im * x) / k;
    re = 1.0 + a;
    im = b;
  }
  return re * re + im * im - 1.0;
}

/* In the left half plane all of |z| <= 2.6 is stable, and nothing at |z| = 3.2. */
double hooke_rk4_reach(double real, double imaginary) {
  const double size = hypot(real, imaginary);
  double ray[2] = {real / size, imaginary / size};
  gsl_function f = {growth, ray};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  if (solver == NULL) return NAN;
  gsl_root_fsolver_set(solver, &f, 2.6, 3.2);
  for (int k = 0; k < MOST_ITERATIONS; k++) {
    gsl_root_fsolver_iterate(solver);
    if (gsl_root_fsolver_x_upper(solver) - gsl_root_fsolver_x_lower(solver) < 1e-14) break;
  }
  const double reach = gsl_root_fsolver_root(solver);
  gsl_root_fsolver_free(solver);
  return reach;
}

#else

double hooke_rk4_reach(double real, double imaginary) {
  (void)real, (void)imaginary;
  return NAN;
}

#endif
