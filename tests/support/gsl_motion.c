#include "gsl_motion.h"

#include "check.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <string.h>

static int rate(double t, const double *y, double *slope, void *ctx) {
  const struct gsl_motion *motion = ctx;
  const int64_t n = motion->count;
  double force[GSL_MOTION_MOST] = {0.0};
  const int32_t stopped = motion->force(n, t, y, y + n, force, motion->ctx);
  memcpy(slope, y + n, (size_t)n * sizeof *slope);
  for (int64_t k = 0; k < n; k++)
    slope[n + k] = motion->inverse_mass * force[k];
  return stopped ? GSL_EBADFUNC : GSL_SUCCESS;
}

void gsl_move(const struct gsl_motion *motion, double from, double to, double *y) {
  struct gsl_motion own = *motion;
  const gsl_odeiv2_system system = {rate, NULL, 2 * (size_t)own.count, &own};
  assert_in_range(own.count, 1, GSL_MOTION_MOST);
  gsl_odeiv2_driver *driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-14, 1e-14);
  const int status = gsl_odeiv2_driver_apply(driver, &from, to, y);
  gsl_odeiv2_driver_free(driver);
  assert_int_equal(status, GSL_SUCCESS);
}
