/* How a step multiplies a mode: as the method itself does on a single oscillator. */
#include "check.h"
#include "measure/spectrum/mode_growth.h"
#include "run.h"
#include "small.h"

#include <math.h>

enum { STEPS = 160 };

/* Of x'' + 2 d x' + w^2 x = 0, of a particle or of a body of one: the mean factor of a step, late in a
 * run. */
static double measure(const char *method, double h, double w, double d, int rigid, double *expected) {
  const double q[] = {0.7, 0, 0}, point[] = {0, 0, 0};
  const int64_t particle = 0;
  hooke_system *system = small_system(1, q, NULL, 1.0, 0);
  hooke_options *anchor;
  check_ok(hooke_options_create("anchors", &anchor));
  check_ok(hooke_options_set_number(anchor, "stiffness", w * w));
  check_ok(hooke_options_set_number(anchor, "rest_length", 0.0));
  check_ok(hooke_options_set_numbers(anchor, "points", 3, point));
  check_ok(hooke_system_add_anchors(system, "anchor", 1, &particle, anchor));
  hooke_options_destroy(anchor);
  check_ok(hooke_system_set_drag(system, 2.0 * d));
  if (rigid) check_ok(hooke_system_add_body(system, "point", 1, &particle, 0));
  check_ok(hooke_system_commit(system));
  *expected = hk_mode_growth(hk_method_stability_in(method, system), h, w, d);
  hooke_integrator *integrator = start_run(system, (struct run){.method = method, .step = h});
  hooke_state *state = start_state(system);
  double half = 0.0, end = 0.0;
  for (int k = 0; k <= 1; k++) {
    check_ok(hooke_integrator_step(integrator, state, STEPS / 2));
    const double size = hypot(w * hooke_state_position(state)[0], hooke_state_velocity(state)[0]);
    half = k == 0 ? size : half;
    end = size;
  }
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_system_destroy(system);
  return pow(end / half, 2.0 / STEPS);
}

static void it_is_that_of_the_method(void **unused) {
  (void)unused;
  static const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet", "heun", "rk4"};
  static const double modes[][3] = {{0.1, 10, 0}, {0.05, 10, 2}, {0.21, 10, 0.1},
                                    {0.3, 10, 1}, {0.1, 3, 25},  {0.01, 7, 3}};
  for (int m = 0; m < 10; m++) {
    for (int k = 0; k < 6; k++) {
      const double h = modes[k][0], w = modes[k][1], d = modes[k][2];
      if (hk_mode_growth(hk_method_stability(methods[m % 5]), h, w, d) > 5.0)
        continue; /* beyond all numbers in so many steps */
      double growth = 0.0;
      const double measured = measure(methods[m % 5], h, w, d, m >= 5, &growth);
      check_close(growth, measured, 0.02 * growth);
    }
  }
}

/* 1 just at the limit that hooke_limit_of_mode() has. */
static void it_is_1_at_the_limit(void **unused) {
  (void)unused;
  static const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet", "heun", "rk4"};
  for (int m = 0; m < 5; m++) {
    const double limit = hooke_limit_of_mode(methods[m], 10.0, 3.0);
    assert_true(hk_mode_growth(hk_method_stability(methods[m]), 0.99 * limit, 10.0, 3.0) < 1.0);
    assert_true(hk_mode_growth(hk_method_stability(methods[m]), 1.01 * limit, 10.0, 3.0) > 1.0);
    check_close(hk_mode_growth(hk_method_stability(methods[m]), limit, 10.0, 3.0), 1.0, 1e-6);
  }
  assert_true(isnan(hk_mode_growth(hk_method_stability("backward-euler"), 0.1, 10.0, 0.0)));
  assert_true(isnan(hk_mode_growth(hk_method_stability("no-method"), 0.1, 10.0, 0.0)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_that_of_the_method),
      cmocka_unit_test(it_is_1_at_the_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
