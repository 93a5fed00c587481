/* Picks for a wanted error: long steps of implicit methods of order 2 where springs are stiff and damped, and
 * Verlet at a step with explicit damping. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

/* The options, with method and step; the caller destroys them. */
static hooke_options *picked(const hooke_system *system, const char *method, double duration, double want) {
  hooke_options *options = run_options((struct run){.duration = duration, .every = duration / 5.0});
  hooke_measurement *estimate;
  owned_options *wanted = options_with("estimate", "want=%.17g", want);
  check_ok(hooke_measurement_create("estimate", system, NULL, wanted, &estimate));
  const int32_t status = hooke_estimate_pick(estimate, method, options);
  hooke_measurement_destroy(estimate);
  check_status(status, HOOKE_OK);
  return options;
}

/* Explicit methods take some 1e4 to 1e6 steps, backward Euler 160, these 20. Which one of all is cheapest is
 * timed, so each is asked for. */
TEST(implicit_methods_of_order_2_take_long_steps_on_stiff_damped_cloths) {
  static const char *const methods[] = {"tr-bdf2", "implicit-midpoint"};
  owned_system *system = small_cloth(12, 5e4, 20.0);
  for (int k = 0; k < 2; k++) {
    if (left_out(k, 2)) continue;
    owned_options *options = picked(system, methods[k], 0.2, 1e-3);
    const double step = hooke_options_number(options, "step"),
                 bound = bound_at_start(system, "symplectic-euler");
    assert_string_equal(hooke_options_text(options, "method"), methods[k]);
    if (!(step > 100.0 * bound))
      check_failed("%s: a step of %g s, the bound of explicit Euler is %g s", methods[k], step, bound);
  }
}

/* At its largest step Verlet solves for the damping, in the time of several steps without. */
TEST(verlet_is_picked_at_a_step_that_solves_nothing) {
  owned_system *system = small_cloth(12, 50.0, 0.01);
  owned_options *options = picked(system, "verlet", 0.5, 1e-3);
  owned_integrator *integrator;
  check_ok(hooke_integrator_create(system, options, &integrator));
  const double step = hooke_options_number(options, "step"), bound = bound_at_start(system, "verlet");
  if (hooke_integrator_count(integrator, "explicit_damping") != 1 || !(step > 0.2 * bound))
    check_failed("a step of %g s of %g s is picked", step, bound);
}
