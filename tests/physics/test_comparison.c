/* Comparisons: the numbers of a row are correct, methods have the expected ranking, a diverged row stays. */
#include "check.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int32_t create(const hooke_system *system, struct run run, const char *methods,
                      hooke_measurement **comparison) {
  owned_options *of_run = run_options(run), *options = NULL;
  options = new_options("comparison");
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  const int32_t status = hooke_measurement_create("comparison", system, of_run, options, comparison);
  return status;
}

static hooke_measurement *compare(const hooke_system *system, struct run run, const char *methods) {
  hooke_measurement *comparison = NULL;
  const int32_t status = create(system, run, methods, &comparison);
  if (status == HOOKE_NOT_BUILT) {
    hooke_system_destroy((hooke_system *)(uintptr_t)system);
    skip();
  }
  check_status(status, HOOKE_OK);
  return comparison;
}

static int64_t row_of(const hooke_measurement *comparison, const char *method) {
  for (int64_t k = 0; k < hooke_measurement_row_count(comparison, "rows"); k++) {
    if (strcmp(hooke_measurement_text(comparison, "rows", k, "method"), method) == 0) return k;
  }
  check_failed("no row of %s", method);
  return -1;
}

static double figure(const hooke_measurement *comparison, const char *method, const char *what) {
  return hooke_measurement_number(comparison, "rows", row_of(comparison, method), what);
}

/* Root mean square distance of the free particles from the 15-digit solution, for a separate run. */
static double true_error(const struct reference *reference, const hooke_system *system, struct run run) {
  const struct reference_state *expected = NULL;
  for (int64_t k = 0; k < reference->state_count; k++) {
    if (fabs(reference->state[k].time - run.duration) < 1e-12) expected = &reference->state[k];
  }
  assert_non_null(expected);
  const int64_t n = reference->particle_count;
  double *q = new_doubles(3 * n), sum = 0.0, count = 0.0;
  run_to_end(system, run, q, NULL);
  for (int64_t p = 0; p < n; p++) {
    if (hooke_system_inverse_mass(system)[p] == 0.0) continue;
    for (int a = 0; a < 3; a++)
      sum += pow(q[3 * p + a] - expected->position[3 * p + a], 2.0);
    count += 1.0;
  }
  free(q);
  return sqrt(sum / count);
}

static void errors_are_true_errors(no_state) {
  const struct reference *reference = find_reference("six-particles");
  owned_system *system = build_reference(reference);
  const struct run run = {.step = 1e-3, .duration = 1.0, .every = 0.1};
  owned_measurement *comparison = compare(system, run, NULL);
  check_ok(hooke_measurement_run(comparison, NULL));
  assert_int_equal(hooke_measurement_row_count(comparison, "rows"), hooke_method_count());
  int64_t judged = 0;
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    struct run alone = run;
    alone.method = hooke_method_name(k);
    const double expected = true_error(reference, system, alone);
    const double found = figure(comparison, alone.method, "error_final");
    assert_string_equal(hooke_measurement_text(comparison, "rows", k, "status"), "finished");
    /* the reference itself has an error of about its tolerance, 1e-10 */
    if (expected < 1e-8) continue;
    judged++;
    check_between(found, 0.95 * expected, 1.05 * expected);
  }
  check_between((double)judged, 4.0, (double)hooke_method_count());
  /* every maximum bounds its values */
  const int64_t row = row_of(comparison, "forward-euler");
  const double *series = hooke_measurement_series(comparison, "rows", row, "error_at", NULL);
  double most = 0.0;
  assert_int_equal((int)hooke_measurement_number(comparison, "comparison", 0, "frames"), 11);
  for (int f = 0; f < 11; f++)
    most = fmax(most, series[f]);
  check_close(hooke_measurement_number(comparison, "rows", row, "error"), most, 0.0);
  check_close(hooke_measurement_number(comparison, "rows", row, "error_final"), series[10], 0.0);
  assert_true(hooke_measurement_number(comparison, "rows", row, "error_max") >= most);
  check_close(series[0], 0.0, 0.0);
  check_close(hooke_measurement_series(comparison, "reference", 0, "time", NULL)[10], 1.0, 1e-15);
  /* error control is closer than a first-order method at this step, and forward Euler adds energy */
  assert_true(figure(comparison, "cvode-adams", "error") <
              0.1 * figure(comparison, "symplectic-euler", "error"));
  assert_true(hooke_measurement_series(comparison, "rows", row, "energy_drift_at", NULL)[10] > 0.0);
  assert_int_equal((int)figure(comparison, "symplectic-euler", "force_evaluations"), 1000);
}

static void a_diverged_row_stays(no_state) {
  owned_system *system = small_oscillator(100.0);
  owned_measurement *comparison = compare(system, (struct run){.step = 0.05, .duration = 5.0, .every = 0.5},
                                          "symplectic-euler, cvode-adams");
  check_ok(hooke_measurement_run(comparison, NULL));
  assert_int_equal(hooke_measurement_row_count(comparison, "rows"), 2);
  assert_string_equal(hooke_measurement_text(comparison, "rows", 0, "status"), "diverged");
  assert_true(isnan(hooke_measurement_number(comparison, "rows", 0, "error")));
  assert_true(isnan(hooke_measurement_series(comparison, "rows", 0, "error_at", NULL)[10]));
  assert_string_equal(hooke_measurement_text(comparison, "rows", 1, "status"), "finished");
  check_between(hooke_measurement_number(comparison, "rows", 1, "error"), 0.0, 0.1);
  check_status(hooke_measurement_run(comparison, NULL), HOOKE_BAD_CALL);
}

static int32_t stop_at_half(double done, const char *what, void *ctx) {
  (void)what;
  *(double *)ctx = done;
  return done >= 0.5 ? 7 : 0;
}

static void progress_goes_on_and_stops(no_state) {
  owned_system *system = small_oscillator(10.0);
  owned_measurement *comparison =
      compare(system, (struct run){.step = 1e-3, .duration = 2.0, .every = 0.1}, NULL);
  double done = -1.0;
  hooke_measurement_on_progress(comparison, stop_at_half, &done);
  check_status(hooke_measurement_run(comparison, NULL), HOOKE_STOPPED);
  check_between(done, 0.5, 1.0);
  const int64_t last = hooke_measurement_row_count(comparison, "rows") - 1;
  assert_string_equal(hooke_measurement_text(comparison, "rows", 0, "status"), "finished");
  assert_string_equal(hooke_measurement_text(comparison, "rows", last, "status"), "not run");
}

static void bad_requests(no_state) {
  owned_system *system = small_oscillator(10.0);
  hooke_measurement *comparison = compare(system, (struct run){.step = 1e-3}, NULL);
  check_status(hooke_measurement_run(comparison, NULL), HOOKE_BAD_VALUE);
  check_message("duration");
  hooke_measurement_destroy(comparison);
  check_status(create(system, (struct run){.step = 1e-3}, "no-such-method", &comparison), HOOKE_BAD_VALUE);
  check_message("no-such-method");
}

/* The oscillator of small.h, of another length [m]. */
static hooke_system *oscillator_of_length(double length) {
  const double position[] = {0, 0, 0, length, 0, 0}, velocity[] = {0, 0, 0, 0, 0.5 * length, 0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, position, velocity, 2.0, 1);
  small_springs(system, 1, ends, (struct springs){.law = "length", .stiffness = 200.0});
  check_ok(hooke_system_commit(system));
  return system;
}

static void errors_scale_with_the_scene(no_state) {
  const double length[] = {1.0, 1e-6, 1e-9};
  double share[3];
  for (int k = 0; k < 3; k++) {
    owned_system *system = oscillator_of_length(length[k]);
    owned_measurement *comparison =
        compare(system, (struct run){.step = 0.01, .duration = 2.0, .every = 0.1}, "rk4");
    check_ok(hooke_measurement_run(comparison, NULL));
    share[k] = figure(comparison, "rk4", "error_max") / length[k];
    check_between(hooke_measurement_number(comparison, "reference", 0, "agreement"), 1e-16 * length[k],
                  1e-2 * share[k] * length[k]);
    check_close(hooke_measurement_number(comparison, "reference", 0, "trusted_until"), 2.0, 1e-12);
  }
  /* rk4 is behind by (omega step)^4 / 120 of a turn of omega t: 1.7e-5 */
  check_between(share[0], 1e-5, 3e-5);
  check_between(share[1] / share[0], 0.99, 1.01);
  check_between(share[2] / share[0], 0.99, 1.01);
}

/* Chaotic motion is compared as long as the reference is known, and no further. */
static void chaos_is_compared_for_a_while(no_state) {
  owned_system *system = small_crumpling_cloth(4);
  owned_measurement *comparison =
      compare(system, (struct run){.step = 1e-3, .duration = 6.0, .every = 0.1}, "rk4");
  check_ok(hooke_measurement_run(comparison, NULL));
  const double until = hooke_measurement_number(comparison, "reference", 0, "trusted_until");
  const double *error = hooke_measurement_series(comparison, "rows", 0, "error_at", NULL);
  const int64_t last = llround(until / 0.1);
  check_between(until, 0.3, 5.9);
  assert_string_equal(hooke_measurement_text(comparison, "rows", 0, "status"), "finished");
  check_between(error[last], 0.0, 1.0);
  assert_true(isnan(error[last + 1]));
  check_close(figure(comparison, "rk4", "error_final"), error[last], 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(errors_are_true_errors),      cmocka_unit_test(a_diverged_row_stays),
      cmocka_unit_test(progress_goes_on_and_stops),  cmocka_unit_test(bad_requests),
      cmocka_unit_test(errors_scale_with_the_scene), cmocka_unit_test(chaos_is_compared_for_a_while),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
