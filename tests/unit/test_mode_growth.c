/* How a step multiplies a mode: as the method itself does on a single oscillator. */
#include "check.h"
#include "measure/spectrum/mode_growth.h"
#include "run.h"
#include "small.h"

#include <math.h>

/* Of x'' + 2 d x' + w^2 x = 0, of a particle or of a body of one: the spectral radius of a step, from where
 * it takes two unit states. */
static double measure(const char *method, double h, double w, double d, int rigid, double *expected) {
  const double q[] = {0.7, 0, 0}, point[] = {0, 0, 0};
  const int64_t particle = 0;
  owned_system *system = small_system(1, q, NULL, 1.0, 0);
  hooke_options *anchor = options_with("anchors", "stiffness=%.17g rest_length=0", w * w);
  check_ok(hooke_options_set_numbers(anchor, "points", 3, point));
  check_ok(hooke_system_add_anchors(system, "anchor", 1, &particle, anchor));
  hooke_options_destroy(anchor);
  check_ok(hooke_system_set_drag(system, 2.0 * d));
  if (rigid) check_ok(hooke_system_add_body(system, "point", 1, &particle, 0));
  check_ok(hooke_system_commit(system));
  *expected = hk_mode_growth(hk_method_stability_in(method, system), h, w, d);
  double m[2][2];
  for (int k = 0; k < 2; k++) {
    owned_run(integrator, state, system, .method = method, .step = h);
    double *x = hooke_state_position(state), *v = hooke_state_velocity(state);
    *x = k == 0 ? 0.7 : 0.0; /* an anchor of no length, in its point, pulls nowhere */
    *v = k == 1 ? 0.7 : 0.0;
    check_ok(hooke_integrator_step(integrator, state, 1));
    m[0][k] = *x / 0.7;
    m[1][k] = *v / 0.7;
  }
  const double half = 0.5 * (m[0][0] + m[1][1]), product = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return half * half < product ? sqrt(product) : fabs(half) + sqrt(half * half - product);
}

/* Of every method whose steps may grow. */
TEST(it_is_that_of_the_method) {
  static const double modes[][3] = {{0.1, 10, 0}, {0.05, 10, 2}, {0.21, 10, 0.1}, {0.3, 10, 1},
                                    {0.1, 3, 25}, {0.01, 7, 3},  {0.5, 10, 30}};
  int64_t seen = 0;
  for (int64_t m = 0; m < 2 * hooke_method_count(); m++) {
    const char *method = hooke_method_name(m / 2);
    if (!is_fixed_step(method) || is_implicit(method)) continue;
    if (m % 2 && hooke_method_is_suited(method, "bodies") != 1) continue;
    for (int k = 0; k < 7; k++) {
      double growth = 0.0;
      const double measured = measure(method, modes[k][0], modes[k][1], modes[k][2], m % 2 == 1, &growth);
      if (!(fabs(growth / measured - 1.0) < 1e-9))
        check_failed("%s, mode %d: growth %.12g, of the steps %.12g", method, k, growth, measured);
      seen++;
    }
  }
  assert_true(seen >= 11 * 7);
}

/* 1 just at the limit that hooke_limit_of_mode() has. */
TEST(it_is_1_at_the_limit) {
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    const double limit = hooke_limit_of_mode(method, 10.0, 3.0);
    const struct hk_stability *stability = hk_method_stability(method);
    assert_true(isinf(limit) == isnan(hk_mode_growth(stability, 0.1, 10.0, 3.0)));
    if (isinf(limit)) continue;
    assert_true(hk_mode_growth(stability, 0.99 * limit, 10.0, 3.0) < 1.0);
    assert_true(hk_mode_growth(stability, 1.01 * limit, 10.0, 3.0) > 1.0);
    check_close(hk_mode_growth(stability, limit, 10.0, 3.0), 1.0, 1e-6);
  }
  assert_true(isnan(hk_mode_growth(hk_method_stability("no-method"), 0.1, 10.0, 0.0)));
}
