/* Every registered method on every reference scene: a new method is tested by being registered. */
#include "check.h"
#include "reference.h"
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void test_table(void **unused) {
  (void)unused;
  const char *expected[] = {"forward-euler", "symplectic-euler", "cvode-bdf", "cvode-adams"};
  for (int k = 0; k < 4; k++) {
    int64_t found = 0;
    for (int64_t m = 0; m < hooke_method_count(); m++)
      found += strcmp(hooke_method_name(m), expected[k]) == 0;
    assert_int_equal(found, 1);
  }
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *name = hooke_method_name(m);
    assert_true(strlen(hooke_method_summary(name)) > 10);
    assert_in_range(hooke_method_is_adaptive(name), 0, 1);
    assert_in_range(hooke_method_is_built(name), 0, 1);
  }
  assert_null(hooke_method_name(hooke_method_count()));
  assert_null(hooke_method_name(-1));
  assert_null(hooke_method_summary("no-such-method"));
  assert_int_equal(hooke_method_is_adaptive("no-such-method"), -1);
  const int32_t sundials = hooke_build_fact("sundials")[0] != '\0';
  assert_int_equal(hooke_method_is_built("cvode-bdf"), sundials);
  assert_int_equal(hooke_method_is_built("cvode-adams"), sundials);
  assert_int_equal(hooke_method_is_built("forward-euler"), 1);
  assert_int_equal(hooke_method_is_built("symplectic-euler"), 1);
}

/* The largest position error at the first reference time, over the largest position. */
static double error_of(const struct reference *reference, const hooke_system *system, struct run run) {
  const int64_t size = 3 * reference->particle_count;
  double *q = new_doubles(size), *v = new_doubles(size);
  run.duration = reference->state[0].time;
  run_to_end(system, run, q, v);
  for (int64_t k = 0; k < size; k++)
    assert_true(isfinite(q[k]) && isfinite(v[k]));
  const double error = largest_difference(size, q, reference->state[0].position);
  free(q);
  free(v);
  return error / largest(size, reference->state[0].position);
}

static void refuse_absent(const hooke_system *system, const char *method) {
  hooke_integrator *integrator = NULL;
  hooke_options *options = run_options((struct run){.method = method, .step = 0.1, .duration = 1.0});
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_NOT_BUILT);
  assert_null(integrator);
  check_message(method);
  hooke_options_destroy(options);
}

/* Half the step at most 0.6 of the error (order 1 or better) and a tighter tolerance a smaller error; an error-controlled
 * method at rtol 1e-9 beats every fixed step of order 1 here. */
static void test_every_method_on_every_scene(void **unused) {
  (void)unused;
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    const struct reference *reference = &references[k];
    hooke_system *system = build_reference(reference);
    double best_fixed = INFINITY, worst_adaptive = 0.0;
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (hooke_method_is_built(method) != 1) {
        refuse_absent(system, method);
        continue;
      }
      double coarse, fine;
      if (hooke_method_is_adaptive(method) == 1) {
        coarse = error_of(reference, system, (struct run){.method = method, .rtol = 1e-4, .atol = 1e-6});
        fine = error_of(reference, system, (struct run){.method = method, .rtol = 1e-9, .atol = 1e-11});
        worst_adaptive = fmax(worst_adaptive, fine);
        if (!(fine < 1e-2 * coarse && fine < 1e-5)) {
          check_failed("%s by %s: errors %g at rtol 1e-4, %g at 1e-9", reference->name, method, coarse, fine);
        }
      } else {
        const double step = reference->state[0].time / 4000.0;
        coarse = error_of(reference, system, (struct run){.method = method, .step = step});
        fine = error_of(reference, system, (struct run){.method = method, .step = step / 2.0});
        if (strstr(method, "-euler") != NULL) best_fixed = fmin(best_fixed, fine);
        if (!(fine < 0.6 * coarse && fine < 1e-2)) {
          check_failed("%s by %s: errors %g at %g s, %g at half of it", reference->name, method, coarse, step,
                       fine);
        }
      }
    }
    if (!(worst_adaptive < best_fixed)) {
      check_failed("%s: error %g at rtol 1e-9, %g by a fixed step", reference->name, worst_adaptive,
                   best_fixed);
    }
    hooke_system_destroy(system);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_table),
                                     cmocka_unit_test(test_every_method_on_every_scene)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
