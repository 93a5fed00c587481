/* The classical Runge-Kutta method: its factor, and the times of its stages. */
#include "check.h"
#include "run.h"

#include <complex.h>

static int32_t multiply(int64_t n, double t, const double *x, double *rate, void *ctx) {
  const double *a = ctx;
  (void)n, (void)t;
  rate[0] = a[0] * x[0] - a[1] * x[1];
  rate[1] = a[0] * x[1] + a[1] * x[0];
  return 0;
}

TEST(factor_of_a_step) {
  double a[] = {-0.8, 5.0};
  const double h = 0.1;
  const double complex z = h * (a[0] + I * a[1]);
  const double complex factor = 1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0;
  owned_integrator *integrator = start_first_order(2, multiply, a, (struct run){.method = "rk4", .step = h});
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(2, &state));
  hooke_state_position(state)[0] = 1.0;
  double complex expected = 1.0;
  for (int k = 0; k < 50; k++) {
    expected *= factor;
    check_ok(hooke_integrator_step(integrator, state, 1));
    check_close(hooke_state_position(state)[0], creal(expected), 1e-14);
    check_close(hooke_state_position(state)[1], cimag(expected), 1e-14);
  }
  assert_int_equal(hooke_integrator_count(integrator, "force_evaluations"), 200);
}

/* A rate that depends on time alone is integrated by Simpson's rule, which is exact for t^3. */
static int32_t cubic(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)x, (void)ctx;
  rate[0] = 4.0 * t * t * t;
  return 0;
}

TEST(times_of_the_stages) {
  owned_integrator *integrator =
      start_first_order(1, cubic, NULL, (struct run){.method = "rk4", .step = 0.5});
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(1, &state));
  check_ok(hooke_integrator_step(integrator, state, 6));
  check_close(hooke_state_position(state)[0], 81.0, 1e-13);
}
