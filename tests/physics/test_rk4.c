/* The classical Runge-Kutta method: its limits, its factor, and drives in the middle of a step. */
#include "check.h"
#include "order.h"
#include "run.h"
#include "small.h"

#include <complex.h>
#include <math.h>
#include <string.h>

/* x'' + 2 zeta omega x' + omega^2 x = 0 as a first-order problem in x and v/omega. */
struct mode {
  double omega, zeta;
};

static int32_t turn(int64_t n, double t, const double *x, double *rate, void *ctx) {
  const struct mode *mode = ctx;
  (void)n, (void)t;
  rate[0] = mode->omega * x[1];
  rate[1] = -mode->omega * x[0] - 2.0 * mode->zeta * mode->omega * x[1];
  return 0;
}

static double size_after(struct mode mode, double step, int64_t steps) {
  hooke_integrator *integrator =
      start_first_order(2, turn, &mode, (struct run){.method = "rk4", .step = step});
  hooke_state *state = NULL;
  check_ok(hooke_state_create_first_order(2, &state));
  hooke_state_position(state)[0] = 1.0;
  check_ok(hooke_integrator_step(integrator, state, steps));
  const double size = largest(2, hooke_state_position(state));
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  return size;
}

/* Limits of |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1 along the roots of the mode. */
static void limits(void **unused) {
  (void)unused;
  const double zeta[] = {0.0, 0.05, 0.1, 0.5, 1.0, 5.0};
  const double limit[] = {2.82843, 2.90980, 2.95085, 2.62254, 2.78529, 0.28137};
  for (int k = 0; k < 6; k++) {
    const struct mode mode = {7.0, zeta[k]};
    check_between(size_after(mode, 0.98 * limit[k] / mode.omega, 4000), 0.0, 2.0);
    check_between(size_after(mode, 1.02 * limit[k] / mode.omega, 4000), 1e3, INFINITY);
  }
}

/* The same through positions and velocities of a system, where the run ends as diverged. */
static void limit_of_a_system(void **unused) {
  (void)unused;
  hooke_system *system = small_oscillator(7.0);
  for (int above = 0; above < 2; above++) {
    const double step = (above ? 1.02 : 0.98) * 2.0 * sqrt(2.0) / 7.0;
    hooke_integrator *integrator = start_run(system, (struct run){.method = "rk4", .step = step});
    hooke_state *state = start_state(system);
    check_status(hooke_integrator_step(integrator, state, 2000), above ? HOOKE_DIVERGED : HOOKE_OK);
    hooke_state_destroy(state);
    hooke_integrator_destroy(integrator);
  }
  hooke_system_destroy(system);
}

static int32_t multiply(int64_t n, double t, const double *x, double *rate, void *ctx) {
  const double *a = ctx;
  (void)n, (void)t;
  rate[0] = a[0] * x[0] - a[1] * x[1];
  rate[1] = a[0] * x[1] + a[1] * x[0];
  return 0;
}

static void factor_of_a_step(void **unused) {
  (void)unused;
  double a[] = {-0.8, 5.0};
  const double h = 0.1;
  const double complex z = h * (a[0] + I * a[1]);
  const double complex factor = 1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0;
  hooke_integrator *integrator = start_first_order(2, multiply, a, (struct run){.method = "rk4", .step = h});
  hooke_state *state = NULL;
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
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
}

/* A rate that depends on time alone is integrated by Simpson's rule, which is exact for t^3. */
static int32_t cubic(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)x, (void)ctx;
  rate[0] = 4.0 * t * t * t;
  return 0;
}

static void times_of_the_stages(void **unused) {
  (void)unused;
  hooke_integrator *integrator =
      start_first_order(1, cubic, NULL, (struct run){.method = "rk4", .step = 0.5});
  hooke_state *state = NULL;
  check_ok(hooke_state_create_first_order(1, &state));
  check_ok(hooke_integrator_step(integrator, state, 6));
  check_close(hooke_state_position(state)[0], 81.0, 1e-13);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
}

/* A mass on a spring whose other end is driven: with the drive at the wrong time of a stage the order would
 * be 1. */
static void order_with_a_drive(void **unused) {
  (void)unused;
  const double q[] = {0, 0, 0, 1, 0, 0}, amplitude[] = {0.1, 0, 0};
  const int64_t ends[] = {0, 1}, driven = 0;
  hooke_system *system = small_system(2, q, NULL, 1.0, 0);
  small_springs(system, 1, ends,
                (struct springs){.law = "length", .stiffness = 9, .damping = 0.6, .rest_length = 1});
  check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 0.5, 0.3));
  check_ok(hooke_system_commit(system));
  double fine[6], error[4];
  run_to_end(system, (struct run){.method = "rk4", .step = 1.0 / 4096, .duration = 2.0}, fine, NULL);
  for (int k = 0; k < 4; k++) {
    double found[6];
    run_to_end(system, (struct run){.method = "rk4", .step = 1.0 / (64 << k), .duration = 2.0}, found, NULL);
    error[k] = largest_difference(6, found, fine);
  }
  check_order("a driven spring by rk4", 4, error, 3.85, 4.25);
  hooke_system_destroy(system);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(limits),
      cmocka_unit_test(limit_of_a_system),
      cmocka_unit_test(factor_of_a_step),
      cmocka_unit_test(times_of_the_stages),
      cmocka_unit_test(order_with_a_drive),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
