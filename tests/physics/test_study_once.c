/* Studies of one row a method: the numbers of a row are correct and methods have the expected
 * ranking. */
#include "check.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hooke_measurement *compare(const hooke_system *system, struct run run, const char *methods) {
  owned_options *of_run = run_options(run), *options = options_with("study", "once=1");
  hooke_measurement *study = NULL;
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  const int32_t status = hooke_measurement_create("study", system, of_run, options, &study);
  if (status == HOOKE_NOT_BUILT) {
    hooke_system_destroy((hooke_system *)(uintptr_t)system);
    skip();
  }
  check_status(status, HOOKE_OK);
  return study;
}

static int64_t row_of(const hooke_measurement *study, const char *method) {
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    if (strcmp(hooke_measurement_text(study, "rows", k, "method"), method) == 0) return k;
  }
  check_failed("no row of %s", method);
  return -1;
}

static double figure(const hooke_measurement *study, const char *method, const char *what) {
  return hooke_measurement_number(study, "rows", row_of(study, method), what);
}

/* The 15-digit solution at a time. */
static const struct reference_state *solution_at(const struct reference *reference, double time) {
  const struct reference_state *expected = NULL;
  for (int64_t k = 0; k < reference->state_count; k++) {
    if (fabs(reference->state[k].time - time) < 1e-12) expected = &reference->state[k];
  }
  assert_non_null(expected);
  return expected;
}

TEST(errors_are_true_errors) {
  const struct reference *reference = find_reference("six-particles");
  hooke_system *system = build_reference(reference);
  const struct run run = {.step = 1e-3, .duration = 1.0, .every = 0.1};
  hooke_measurement *study = compare(system, run, NULL);
  check_ok(hooke_measurement_run(study, NULL));
  int64_t judged = 0, built = 0;
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    struct run alone = run;
    alone.method = hooke_method_name(k);
    if (!hooke_method_is_built(alone.method)) continue;
    const double expected = true_error(solution_at(reference, alone.duration), system, alone);
    const double found = figure(study, alone.method, "error_final");
    assert_string_equal(hooke_measurement_text(study, "rows", row_of(study, alone.method), "status"),
                        "finished");
    built++;
    /* the reference itself has an error of about its tolerance, 1e-10 */
    if (expected < 1e-8) continue;
    judged++;
    check_between(found, 0.95 * expected, 1.05 * expected);
  }
  assert_int_equal(hooke_measurement_row_count(study, "rows"), built);
  check_between((double)judged, 4.0, (double)built);
  /* every maximum bounds its values */
  const int64_t row = row_of(study, "forward-euler");
  const double *series = hooke_measurement_series(study, "rows", row, "error_at", NULL);
  double most = 0.0;
  assert_int_equal((int)hooke_measurement_number(study, "study", 0, "frames"), 11);
  for (int f = 0; f < 11; f++)
    most = fmax(most, series[f]);
  check_close(hooke_measurement_number(study, "rows", row, "error"), most, 0.0);
  check_close(hooke_measurement_number(study, "rows", row, "error_final"), series[10], 0.0);
  assert_true(hooke_measurement_number(study, "rows", row, "error_max") >= most);
  check_close(series[0], 0.0, 0.0);
  check_close(hooke_measurement_series(study, "reference", 0, "time", NULL)[10], 1.0, 1e-15);
  /* error control, or rk4, is closer than a first-order method at this step, and forward Euler adds energy */
  const char *controlled = hooke_method_is_built("cvode-adams") ? "cvode-adams" : "rk4";
  assert_true(figure(study, controlled, "error") < 0.1 * figure(study, "symplectic-euler", "error"));
  assert_true(hooke_measurement_series(study, "rows", row, "energy_drift_at", NULL)[10] > 0.0);
  assert_int_equal((int)figure(study, "symplectic-euler", "force_evaluations"), 1000);
  hooke_measurement_destroy(study);
  hooke_system_destroy(system);
}

struct seen {
  double done;
  const char *method; /* the first with a row */
};

static int32_t stop_at_second(double done, const char *what, void *ctx) {
  struct seen *seen = ctx;
  assert_true(done >= seen->done);
  seen->done = done;
  if (strcmp(what, "reference") == 0) return 0;
  if (seen->method == NULL) seen->method = what;
  return strcmp(what, seen->method) != 0 ? 7 : 0;
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

TEST(errors_scale_with_the_scene) {
  const double length[] = {1.0, 1e-6, 1e-9};
  double share[3];
  for (int k = 0; k < 3; k++) {
    hooke_system *system = oscillator_of_length(length[k]);
    hooke_measurement *study =
        compare(system, (struct run){.step = 0.01, .duration = 2.0, .every = 0.1}, "rk4");
    check_ok(hooke_measurement_run(study, NULL));
    share[k] = figure(study, "rk4", "error_max") / length[k];
    check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-16 * length[k],
                  1e-2 * share[k] * length[k]);
    check_close(hooke_measurement_number(study, "reference", 0, "trusted_until"), 2.0, 1e-12);
    hooke_measurement_destroy(study);
    hooke_system_destroy(system);
  }
  /* rk4 is behind by (omega step)^4 / 120 of a turn of omega t: 1.7e-5 */
  check_between(share[0], 1e-5, 3e-5);
  check_between(share[1] / share[0], 0.99, 1.01);
  check_between(share[2] / share[0], 0.99, 1.01);
}

/* Chaotic motion is compared as long as the reference is known, and no further. */
TEST(chaos_is_compared_for_a_while) {
  hooke_system *system = small_crumpling_cloth(4);
  hooke_measurement *study =
      compare(system, (struct run){.step = 1e-3, .duration = 6.0, .every = 0.1}, "rk4");
  check_ok(hooke_measurement_run(study, NULL));
  const double until = hooke_measurement_number(study, "reference", 0, "trusted_until");
  int64_t judged;
  const double *error = hooke_measurement_series(study, "rows", 0, "error_at", &judged);
  const int64_t last = llround(until / 0.1);
  check_between(until, 0.3, 5.9);
  assert_string_equal(hooke_measurement_text(study, "reference", 0, "ended"), "parted");
  assert_true(isnan(hooke_measurement_number(study, "reference", 0, "growth_seen")));
  assert_string_equal(hooke_measurement_text(study, "rows", 0, "status"), "finished");
  check_between(error[last], 0.0, 1.0);
  assert_int_equal(judged, last + 1);
  check_close(figure(study, "rk4", "error_final"), error[last], 0.0);
  hooke_measurement_destroy(study);
  hooke_system_destroy(system);
}

/* A row has all threads, and no other runs beside it. */
TEST(threads_are_those_of_the_run) {
  hooke_system *system = small_oscillator(10.0);
  hooke_measurement *study = compare(
      system, (struct run){.step = 1e-3, .duration = 1.0, .every = 0.1, .threads = 2}, "verlet,rk4,heun");
  struct seen seen = {.done = 0.0};
  hooke_measurement_on_progress(study, stop_at_second, &seen);
  check_status(hooke_measurement_run(study, NULL), HOOKE_STOPPED);
  assert_int_equal(hooke_measurement_row_count(study, "rows"), 2);
  for (int64_t k = 0; k < 2; k++)
    check_close(hooke_measurement_number(study, "rows", k, "timed_alone"), 1.0, 0.0);
  hooke_measurement_destroy(study);
  hooke_system_destroy(system);
}
