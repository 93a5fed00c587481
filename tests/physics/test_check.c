/* Checks of scenes: what is counted, the bounds, memory, and warnings, in tables and as the first claims. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* Three particles in a row, the first pinned, a spring between the first two: the third is loose. */
static hooke_system *row_of_three(void) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  static const int64_t pinned[] = {0}, ends[] = {0, 1};
  hooke_system *system = small_system(3, q, NULL, 1.0, 0);
  owned_options *options = options_with("springs", "stiffness=100");
  check_ok(hooke_system_pin(system, 1, pinned));
  check_ok(hooke_system_add_springs(system, "held", 1, ends, options));
  return committed(system);
}

static double count_of(const hooke_measurement *check, const char *what) {
  return hooke_measurement_number(check, "check", 0, what);
}

static void check_warning(const hooke_measurement *check, int64_t row, const char *kind, const char *text) {
  assert_string_equal(hooke_measurement_text(check, "warnings", row, "kind"), kind);
  assert_non_null(strstr(hooke_measurement_text(check, "warnings", row, "text"), text));
  assert_string_equal(hooke_measurement_text(check, "claims", row, "key"), kind);
  assert_string_equal(hooke_measurement_text(check, "claims", row, "text"),
                      hooke_measurement_text(check, "warnings", row, "text"));
}

TEST(a_scene_is_counted) {
  owned_system *system = row_of_three();
  owned_state *state = start_state(system);
  owned_measurement *check;
  check_ok(hooke_measurement_create("check", system, NULL, NULL, &check));
  assert_int_equal(hooke_measurement_row_count(check, "warnings"), 0);
  check_ok(hooke_measurement_run(check, NULL));
  check_close(count_of(check, "particles"), 3.0, 0.0);
  check_close(count_of(check, "free"), 2.0, 0.0);
  check_close(count_of(check, "springs"), 1.0, 0.0);
  assert_string_equal(hooke_measurement_text(check, "groups", 0, "name"), "held");
  check_close(hooke_measurement_number(check, "groups", 0, "springs"), 1.0, 0.0);
  assert_string_equal(hooke_measurement_text(check, "forces", 0, "name"), "springs");
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    double bound;
    check_ok(hooke_step_bound(system, hooke_method_name(k), hooke_state_position(state), &bound));
    const double told = hooke_measurement_number(check, "step_limit", k, "seconds");
    assert_true(told == bound || (isnan(told) && isnan(bound)));
  }
  assert_int_equal(hooke_measurement_row_count(check, "warnings"), 2);
  check_warning(check, 0, "loose", "particle 2 has no spring");
  check_warning(check, 1, "nothing-moves", "nothing moves");
}

/* F(0) = 5 N of springs that only pull; not of those that push, nor of F(0) = 0. */
TEST(a_curve_that_jumps_is_warned_of) {
  static const char *const curves[] = {"curve.elongation=-1,0,1 curve.force=3,5,30 compression=false",
                                       "curve.elongation=-1,0,1 curve.force=3,5,30",
                                       "curve.elongation=0,1 curve.force=0,30 compression=false"};
  static const double q[] = {0, 0, 0, 2, 0, 0};
  static const int64_t ends[] = {0, 1};
  for (int k = 0; k < 3; k++) {
    owned_system *system = small_system(2, q, NULL, 1.0, 1);
    owned_options *options = options_with("springs", curves[k]);
    check_ok(hooke_options_set_number(options, "rest_length", 1.0));
    check_ok(hooke_system_add_springs(system, "rubber", 1, ends, options));
    check_ok(hooke_system_commit(system));
    owned_measurement *check;
    check_ok(hooke_measurement_create("check", system, NULL, NULL, &check));
    check_ok(hooke_measurement_run(check, NULL));
    assert_int_equal(hooke_measurement_row_count(check, "warnings"), k == 0);
    if (k == 0) check_warning(check, 0, "jump", "jumps to 0 N");
  }
}

TEST(a_run_is_warned_of_at_the_state_given) {
  owned_system *system = row_of_three();
  owned_state *state = start_state(system);
  owned_options *run = run_options((struct run){.step = 1.0, .duration = 3.0});
  owned_measurement *check;
  check_ok(hooke_measurement_create("check", system, run, NULL, &check));
  check_ok(hooke_measurement_run(check, NULL));
  check_warning(check, 0, "above-limit", "is above");
  memset(hooke_state_position(state), 0, 9 * sizeof(double));
  check_ok(hooke_measurement_run(check, state));
  check_warning(check, 1, "coincident-springs", "1 spring or contact starts without a direction");
}

TEST(memory_adds_to_that_of_the_process) {
  owned_system *system = row_of_three();
  owned_options *run = run_options((struct run){.step = 0.01, .duration = 0.1}), *told = NULL;
  owned_measurement *alone, *check;
  check_ok(hooke_options_create("check", &told));
  check_ok(hooke_options_set_numbers(told, "process", 2, (const double[]){1e7, 2e9}));
  check_ok(hooke_measurement_create("check", system, run, NULL, &alone));
  check_ok(hooke_measurement_create("check", system, run, told, &check));
  assert_true(isnan(count_of(alone, "memory_bytes")));
  check_ok(hooke_measurement_run(alone, NULL));
  check_ok(hooke_measurement_run(check, NULL));
  check_between(count_of(alone, "memory_bytes"), (double)hooke_system_count(system, "memory"), 1e6);
  check_close(count_of(check, "memory_bytes"), 2e9, 0.0);
  check_close(count_of(check, "bytes_per_particle"), count_of(alone, "bytes_per_particle"), 0.0);
  assert_true(count_of(check, "memory_bytes_output") > 2e9 && isnan(count_of(check, "memory_bytes_factor")));
}
