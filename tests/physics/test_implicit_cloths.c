/* Falling cloths, soft to stiff, undamped to heavily damped, in steps from 0.1 ms to 100 ms, three of each,
 * by every implicit method in both forms: the steps are finished, or the failure is told with its reason;
 * what is finished has finite numbers, and at small steps the forms agree. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const methods[] = {"tr-bdf2", "backward-euler", "implicit-midpoint"};
static const char *const forms[] = {"converged", "one-iteration"};
enum { METHODS = 3, FORMS = 2, STEPS = 3 };

/* 1 if all steps were taken; q is where they came to. */
static int try_steps(const hooke_system *system, const char *method, const char *form, double h, double *q) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_run(integrator, state, system, .method = method, .newton = form, .newton_tolerance = BY_DEFAULT,
            .step = h);
  const int32_t status = hooke_integrator_step(integrator, state, STEPS);
  if (status == HOOKE_OK) {
    assert_int_equal(hooke_integrator_count(integrator, "steps"), STEPS);
  } else {
    check_status(status, HOOKE_SOLVER_FAILED);
    check_message("take a smaller step");
    assert_true(hooke_integrator_count(integrator, "nonlinear_failures") > 0);
  }
  memcpy(q, hooke_state_position(state), (size_t)size * sizeof(double));
  for (int64_t k = 0; k < size; k++)
    assert_true(isfinite(q[k]));
  return status == HOOKE_OK;
}

static void check_cloth(int side, double stiffness, double damping, double h, int count) {
  owned_system *system = small_cloth(side, stiffness, damping);
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_doubles *first = new_doubles(size), *q = new_doubles(size);
  for (int m = 0; m < count * FORMS; m++) {
    const char *method = methods[m / FORMS], *form = forms[m % FORMS];
    const int done = try_steps(system, method, form, h, m == 0 ? first : q);
    /* the methods that damp what they do not resolve always come to the end here */
    if (m < 2 * FORMS && !done)
      check_failed("%s, %s: side %d, %g N, %g N s, %g s", method, form, side, stiffness, damping, h);
    if (m == 0 || !done || h > 1e-3) continue;
    const double fallen = 0.5 * 9.81 * (STEPS * h) * (STEPS * h), apart = largest_difference(size, q, first);
    if (!(apart <= 0.5 * fallen))
      check_failed("%s, %s: side %d, %g N, %g N s, %g s: %g m from tr-bdf2", method, form, side, stiffness,
                   damping, h, apart);
  }
}

/* Of 100 ms the softest alone: those of stiffer cloths take a minute. There the midpoint rule turns what it
 * does not resolve against itself, and is not asked. If `some`, with the ends of each range alone, and
 * without 100 ms. */
static void check_side(int side, int some) {
  const double stiffnesses[] = {1e3, 1e4, 2e5}, dampings[] = {0.0, 0.5, 20.0}, steps[] = {1e-4, 1e-3, 1e-2};
  for (int s = 0; s < 3; s += some ? 2 : 1) {
    for (int d = 0; d < 3; d += some ? 2 : 1) {
      for (int k = 0; k < 3; k++)
        check_cloth(side, stiffnesses[s], dampings[d], steps[k], METHODS);
      if (!some && s == 0) check_cloth(side, stiffnesses[s], dampings[d], 0.1, METHODS - 1);
    }
  }
}

static void check_given_side(void **side) {
  check_side(*(const int *)*side, 0);
}

static void cloths_of_20(void **state) {
  (void)state;
  check_side(20, 0);
}

static void cloths_of_41(void **state) {
  (void)state;
  if (HOOKE_SANITIZED) skip(); /* the code is that of the other, which is shorter */
  check_side(41, 1);
}

/* In place of these two, of a side that is given. */
int main(int count, char **arguments) {
  int side = count > 1 ? atoi(arguments[1]) : 0;
  const struct CMUnitTest tests[] = {cmocka_unit_test(cloths_of_20), cmocka_unit_test(cloths_of_41)};
  const struct CMUnitTest given[] = {cmocka_unit_test_prestate(check_given_side, &side)};
  return side > 0 ? cmocka_run_group_tests(given, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
}
