/* x' = a x: the effect of each method on one number, real or complex. */
#include "check.h"
#include "order.h"
#include "run.h"

#include <complex.h>
#include <math.h>
#include <string.h>

/* a = real + i imaginary; x holds the real and the imaginary part. */
struct rate {
  double real, imaginary;
  int64_t calls;
};

static int32_t multiply(int64_t n, double t, const double *x, double *rate, void *ctx) {
  struct rate *a = ctx;
  (void)t;
  a->calls++;
  rate[0] = a->real * x[0] - (n > 1 ? a->imaginary * x[1] : 0.0);
  if (n > 1) rate[1] = a->real * x[1] + a->imaginary * x[0];
  return 0;
}

static hooke_state *start_at_one(int64_t size) {
  hooke_state *state = NULL;
  check_ok(hooke_state_create_first_order(size, &state));
  assert_int_equal(hooke_state_size(state), size);
  assert_null(hooke_state_velocity(state));
  assert_true(hooke_state_position(state)[0] == 0.0);
  hooke_state_position(state)[0] = 1.0;
  return state;
}

/* Explicit Runge-Kutta methods multiply x by as many terms of exp(z), z = a h, as their order has. */
TEST(test_factors) {
  static const struct {
    const char *method;
    int order;
  } methods[] = {{"forward-euler", 1}, {"heun", 2}, {"rk4", 4}};
  const double rates[][2] = {{-1, 0}, {-19, 0}, {2, 0}, {0, 0}, {-0.8, 5}}, h = 0.1;
  for (int k = 0; k < 15; k++) {
    struct rate a = {rates[k % 5][0], rates[k % 5][1], 0};
    const double complex z = h * (a.real + I * a.imaginary);
    const int order = methods[k / 5].order;
    double complex factor = 1.0, expected = 1.0;
    for (int term = order; term > 0; term--)
      factor = 1.0 + z / term * factor;
    owned_integrator *integrator =
        start_first_order(2, multiply, &a, (struct run){.method = methods[k / 5].method, .step = h});
    owned_state *state = start_at_one(2);
    for (int step = 0; step < 20; step++) {
      expected *= factor;
      check_ok(hooke_integrator_step(integrator, state, 1));
      check_close(hooke_state_position(state)[0], creal(expected), 1e-13 * cabs(expected));
      check_close(hooke_state_position(state)[1], cimag(expected), 1e-13 * cabs(expected));
    }
    assert_int_equal(a.calls, 20 * order);
    assert_int_equal(hooke_integrator_count(integrator, "force_evaluations"), 20 * order);
  }
}

/* A rate that depends on time alone is integrated by Simpson's rule, which is exact for t^3. */
static int32_t cubic(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)x, (void)ctx;
  rate[0] = 4.0 * t * t * t;
  return 0;
}

TEST(test_times_of_stages) {
  owned_integrator *integrator =
      start_first_order(1, cubic, NULL, (struct run){.method = "rk4", .step = 0.5});
  owned_state *state = start_at_one(1);
  check_ok(hooke_integrator_step(integrator, state, 6));
  check_close(hooke_state_position(state)[0], 82.0, 1e-13);
}

/* ---- every method that takes first-order problems ---- */

static double error_of(const char *method, double step, double rtol) {
  struct rate a = {-0.5, 3.0, 0};
  const int adaptive = hooke_method_is_adaptive(method) == 1;
  const struct run run =
      adaptive ? (struct run){.method = method, .rtol = rtol, .atol = rtol * 1e-2, .duration = 2.0}
               : (struct run){.method = method, .step = step, .duration = 2.0};
  owned_integrator *integrator = start_first_order(2, multiply, &a, run);
  owned_state *state = start_at_one(2);
  check_ok(hooke_integrator_run(integrator, state));
  check_close(hooke_state_time(state), 2.0, 0.0);
  const double *x = hooke_state_position(state), decay = exp(-1.0);
  const double error = hypot(x[0] - decay * cos(6.0), x[1] - decay * sin(6.0));
  return error;
}

static int32_t takes_first_order(const char *method) {
  struct rate a = {-1.0, 0.0, 0};
  hooke_integrator *integrator = NULL;
  owned_options *options = run_options((struct run){.method = method, .step = 0.1});
  const int32_t status = hooke_integrator_create_first_order(1, multiply, &a, options, &integrator);
  if (status == HOOKE_OK)
    hooke_integrator_destroy(integrator);
  else
    assert_null(integrator);
  return status;
}

TEST(test_every_method) {
  int64_t taken = 0;
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    const int32_t status = takes_first_order(method);
    if (hooke_method_is_built(method) != 1) {
      assert_int_equal(status, HOOKE_NOT_BUILT);
      check_message(method);
      continue;
    }
    if (status == HOOKE_UNSUITED) {
      check_message(method);
      continue;
    }
    assert_int_equal(status, HOOKE_OK);
    taken++;
    if (hooke_method_is_adaptive(method) == 1) {
      check_between(error_of(method, 0.0, 1e-4), 1e-9, 1e-2);
      check_between(error_of(method, 0.0, 1e-10), 0.0, 1e-8);
    } else {
      double error[5];
      for (int k = 0; k < 5; k++)
        error[k] = error_of(method, 0.01 / (1 << k), 0.0);
      for (int k = 0; k < 4; k++)
        assert_true(error[k + 1] < 0.6 * error[k]); /* order 1 or better */
      if (strcmp(method, "forward-euler") == 0) check_order(method, 5, error, 0.9, 1.15);
    }
  }
  assert_true(taken >= 1);
}

TEST(test_symplectic_euler_refuses) {
  assert_int_equal(takes_first_order("symplectic-euler"), HOOKE_UNSUITED);
  check_message("symplectic-euler");
  check_message("positions and velocities");
}
