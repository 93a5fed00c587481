/* Studies: the reference knows its accuracy, rows have true errors, orders are those of the theory, a
 * recommendation has been confirmed, and chaos gets no false reference. */
#include "check.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int has_sundials(void) {
  return hooke_method_is_built("cvode-adams");
}

/* A study of `methods` (NULL: all) over `duration`; skips the test in builds without one of them. */
static hooke_measurement *start_study(const hooke_system *system, const char *methods, double duration,
                                      double every, double want) {
  hooke_measurement *study = NULL;
  owned_options *run = run_options((struct run){.duration = duration, .every = every}), *options;
  options = new_options("study");
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  if (want > 0.0) check_ok(hooke_options_set_number(options, "want", want));
  const int32_t status = hooke_measurement_create("study", system, run, options, &study);
  if (status == HOOKE_NOT_BUILT) {
    hooke_system_destroy((hooke_system *)(uintptr_t)system);
    skip();
  }
  check_status(status, HOOKE_OK);
  return study;
}

/* ---- rows compared with 15 digits ---- */

static void check_rows(const struct reference *reference, const struct reference_state *expected,
                       const hooke_system *system, const hooke_measurement *study, double every) {
  const double agreement = hooke_measurement_number(study, "reference", 0, "agreement");
  int64_t judged = 0;
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    const double found = hooke_measurement_number(study, "rows", k, "error_final");
    if (isnan(found) || found <= 10.0 * agreement) continue;
    const double step = hooke_measurement_number(study, "rows", k, "step"),
                 rtol = hooke_measurement_number(study, "rows", k, "rtol");
    const struct run run = {.method = hooke_measurement_text(study, "rows", k, "method"),
                            .step = isnan(step) ? 0.0 : step,
                            .rtol = isnan(rtol) ? 0.0 : rtol,
                            .atol = isnan(rtol) ? 0.0 : hooke_measurement_number(study, "rows", k, "atol"),
                            .duration = expected->time,
                            .every = every};
    const double error = true_error(expected, system, run);
    if (!(found >= 0.95 * error && found <= 1.05 * error)) {
      check_failed("%s at %g s, %s step %g rtol %g: error_final %.4g m, truly %.4g m", reference->name,
                   expected->time, run.method, step, rtol, found, error);
    }
    judged++;
  }
  assert_true(judged >= 8);
}

TEST(errors_are_true) {
  for (int r = 0; r < REFERENCE_COUNT; r++) {
    for (int64_t s = 0; s < references[r].state_count; s++) {
      const struct reference_state *expected = &references[r].state[s];
      owned_system *system = build_reference(&references[r]);
      const double every = expected->time / 20.0;
      owned_measurement *study = start_study(system, NULL, expected->time, every, 0.0);
      check_ok(hooke_measurement_run(study, NULL));
      check_close(hooke_measurement_number(study, "reference", 0, "trusted_until"), expected->time, 1e-12);
      check_rows(&references[r], expected, system, study, every);
    }
  }
}

/* The agreement is the error of the reference, within a factor. */
TEST(agreement_is_honest) {
  for (int r = 0; r < REFERENCE_COUNT; r++) {
    owned_system *system = build_reference(&references[r]);
    owned_measurement *study = start_study(system, "rk4", references[r].state[0].time, 0.0, 0.0);
    check_ok(hooke_measurement_run(study, NULL));
    const char *method = hooke_measurement_text(study, "reference", 0, "method"),
               *check = hooke_measurement_text(study, "reference", 0, "check");
    const int64_t floor = hooke_measurement_find(study, "claims", "key", "floor");
    const int halved = strstr(hooke_measurement_text(study, "claims", floor, "text"),
                              "by rk4, agrees with itself in steps of ") != NULL;
    assert_int_equal(strcmp(method, check) == 0, halved);
    assert_int_equal(halved, !has_sundials());
    check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-16, 1e-8);
    check_between(hooke_measurement_number(study, "reference", 0, "growth_seen"), 0.1, 40.0);
    check_between(hooke_measurement_number(study, "reference", 0, "growth"),
                  hooke_measurement_number(study, "reference", 0, "growth_seen"), 4000.0);
    check_between(hooke_measurement_number(study, "reference", 0, "energy_agreement"), 0.0, 1e-6);
  }
}

/* ---- orders ---- */

TEST(orders_are_those_of_the_theory) {
  const char *smooth[] = {"six-particles", "oscillator"};
  for (int r = 0; r < 2; r++) {
    owned_system *system = build_reference(find_reference(smooth[r]));
    owned_measurement *study = start_study(system, NULL, 1.0, 0.05, 0.0);
    check_ok(hooke_measurement_run(study, NULL));
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (!hooke_method_is_built(method)) continue;
      const int64_t at = hooke_measurement_find(study, "orders", "method", method);
      assert_true(at >= 0);
      if (!is_fixed_step(method)) {
        assert_true(isnan(hooke_measurement_number(study, "orders", at, "order")));
        continue;
      }
      const double order = hooke_measurement_number(study, "orders", at, "order");
      const double theory = hooke_measurement_number(study, "orders", at, "theory");
      check_between(theory, 1.0, 4.0);
      check_between(order, theory - 0.15, theory + 0.25);
      check_between(hooke_measurement_number(study, "orders", at, "order_step"), theory + 0.85,
                    theory + 1.25);
      check_between(order, hooke_measurement_number(study, "orders", at, "low"),
                    hooke_measurement_number(study, "orders", at, "high"));
      assert_string_equal(hooke_measurement_text(study, "orders", at, "note"), "");
    }
  }
}

/* ---- ladders ---- */

TEST(ladders_go_from_coarse_to_fine) {
  owned_system *system = build_reference(find_reference("oscillator"));
  owned_measurement *study = start_study(system, NULL, 1.0, 0.1, 0.0);
  check_ok(hooke_measurement_run(study, NULL));
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    int64_t rows = 0;
    double last = INFINITY;
    if (!hooke_method_is_built(hooke_method_name(m))) continue;
    for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
      if (strcmp(hooke_measurement_text(study, "rows", k, "method"), hooke_method_name(m)) != 0) continue;
      const double step = hooke_measurement_number(study, "rows", k, "step"),
                   rtol = hooke_measurement_number(study, "rows", k, "rtol");
      const double value = isnan(step) ? rtol : step;
      assert_true(value < last);
      last = value;
      rows++;
      /* frames are whole numbers of steps */
      if (!isnan(step)) check_close(0.1 / step, round(0.1 / step), 1e-6);
      check_between(hooke_measurement_number(study, "rows", k, "repeats"), 1.0, 9.0);
      check_between(hooke_measurement_number(study, "rows", k, "wall_median"),
                    hooke_measurement_number(study, "rows", k, "wall_seconds"), 10.0);
    }
    check_between((double)rows, 6.0, 7.0);
  }
}

TEST(bad_requests) {
  hooke_system *system = build_reference(find_reference("oscillator"));
  hooke_options *run = run_options((struct run){.step = 0.01}), *options;
  hooke_measurement *study = NULL;
  options = new_options("study");
  check_status(hooke_measurement_create("study", system, run, options, &study), HOOKE_BAD_VALUE);
  check_message("duration");
  check_ok(hooke_options_set_number(run, "duration", 1.0));
  check_ok(hooke_options_set_text(options, "methods", "forward-euler,nothing"));
  check_status(hooke_measurement_create("study", system, run, options, &study), HOOKE_BAD_VALUE);
  check_message("nothing");
  check_ok(hooke_options_unset(options, "methods"));
  check_ok(hooke_options_set_text(options, "steps", "0.01,0.02"));
  check_status(hooke_measurement_create("study", system, run, options, &study), HOOKE_BAD_VALUE);
  check_message("steps[1]");
  check_status(hooke_options_set_number(options, "points", 5.0), HOOKE_BAD_VALUE);
  hooke_options_destroy(run);
  hooke_options_destroy(options);
  hooke_system_destroy(system);
}

/* ---- the recommendation ---- */

TEST(recommendations_hold) {
  const struct reference *reference = find_reference("six-particles");
  const struct reference_state *expected = NULL;
  for (int64_t s = 0; s < reference->state_count; s++) {
    if (reference->state[s].time == 1.0) expected = &reference->state[s];
  }
  assert_non_null(expected);
  owned_system *system = build_reference(reference);
  hooke_measurement *study = start_study(system, NULL, 1.0, 0.05, 1e-2);
  check_status(hooke_study_recommend(study, 1e-3), HOOKE_BAD_CALL);
  check_ok(hooke_measurement_run(study, NULL));
  const double wants[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
  for (int k = 0; k < 5; k++) {
    check_ok(hooke_study_recommend(study, wants[k]));
    assert_true(hooke_measurement_number(study, "recommendation", 0, "met") == 1.0);
    assert_string_equal(hooke_measurement_text(study, "recommendation", 0, "note"), "");
    const double step = hooke_measurement_number(study, "recommendation", 0, "step");
    const double rtol = hooke_measurement_number(study, "recommendation", 0, "rtol");
    assert_true(isnan(step) != isnan(rtol));
    const struct run run = {
        .method = hooke_measurement_text(study, "recommendation", 0, "method"),
        .step = isnan(step) ? 0.0 : step,
        .rtol = isnan(rtol) ? 0.0 : rtol,
        .atol = isnan(rtol) ? 0.0 : hooke_measurement_number(study, "recommendation", 0, "atol"),
        .duration = 1.0,
        .every = 0.05};
    check_between(true_error(expected, system, run), 0.0, wants[k]);
    check_between(hooke_measurement_number(study, "recommendation", 0, "error"), 0.0, wants[k]);
  }
  /* an unreachable want is reported, with the closest run */
  check_ok(hooke_study_recommend(study, 1e-15));
  assert_true(hooke_measurement_number(study, "recommendation", 0, "met") == 0.0);
  assert_true(strlen(hooke_measurement_text(study, "recommendation", 0, "note")) > 20);
  check_between(hooke_measurement_number(study, "recommendation", 0, "error"), 1e-15, 1e-5);
  hooke_measurement_destroy(study);
  /* nor does it reduce the trust in the reference */
  study = start_study(system, "rk4", 1.0, 0.05, 1e-30);
  check_ok(hooke_measurement_run(study, NULL));
  check_close(hooke_measurement_number(study, "reference", 0, "trusted_until"), 1.0, 1e-12);
  assert_true(hooke_measurement_number(study, "recommendation", 0, "met") == 0.0);
  hooke_measurement_destroy(study);
}

/* ---- chaos ---- */

TEST(chaos_is_trusted_for_a_while) {
  owned_system *system = small_crumpling_cloth(6);
  owned_measurement *study = start_study(system, "symplectic-euler", 4.0, 0.1, 0.0);
  check_ok(hooke_measurement_run(study, NULL));
  check_between(hooke_measurement_number(study, "reference", 0, "trusted_until"), 0.3, 3.5);
  check_between(hooke_measurement_number(study, "reference", 0, "growth_seen"), 1e3, 1e8);
  assert_true(isnan(hooke_measurement_number(study, "reference", 0, "growth")));
  assert_string_equal(hooke_measurement_text(study, "reference", 0, "ended"),
                      has_sundials() ? "rounding" : "finest");
  check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-14, 1e-5);
  /* errors are judged up to there and no further */
  const int64_t frames = (int64_t)hooke_measurement_number(study, "study", 0, "frames"),
                last = hooke_measurement_row_count(study, "rows") - 1;
  check_between((double)frames, 3.0, 36.0);
  const double *error = hooke_measurement_series(study, "rows", last, "error_at", NULL);
  assert_true(!isnan(error[frames - 1]));
  assert_true(isnan(error[frames]));
}

/* ---- progress and budgets ---- */

struct told {
  double last, end_of_reference;
  int64_t count, back, of_reference;
};

static int32_t listen(double done, const char *what, void *ctx) {
  struct told *told = ctx;
  const int reference = strcmp(what, "reference") == 0;
  told->back += !(done >= told->last && done <= 1.0);
  told->of_reference += reference;
  if (reference) told->end_of_reference = done;
  told->last = done;
  told->count++;
  return 0;
}

/* The reported fraction is that of the whole study: it never decreases, not where one run ends and the next
 * begins. */
TEST(progress_is_of_the_whole_study) {
  owned_system *system = build_reference(find_reference("rope-12"));
  owned_measurement *study = start_study(system, NULL, 1.0, 0.05, 1e-3);
  struct told told = {.last = 0.0};
  hooke_measurement_on_progress(study, listen, &told);
  check_ok(hooke_measurement_run(study, NULL));
  check_between((double)told.of_reference, 100.0, (double)told.count - 100.0);
  check_between((double)told.back, 0.0, 0.0);
  check_between(told.end_of_reference, 1e-3, 0.95);
  check_between(told.last, told.end_of_reference, 1.0);
  check_between(told.last, 0.7, 1.0);
}

/* Half a second is too short for the first frame of a very long run, and a minute is enough for all of a
 * short one. */
TEST(a_budget_binds_the_reference) {
  const double every[] = {1e5, 0.05};
  for (int k = 0; k < 2; k++) {
    hooke_system *system = small_crumpling_cloth(6);
    owned_measurement *study = NULL;
    owned_options *run = run_options((struct run){.duration = every[k], .every = every[k]}), *options;
    options = options_with("study", "budget=%.17g methods=symplectic-euler", k == 0 ? 0.1 : 60.0);
    const int32_t status = hooke_measurement_create("study", system, run, options, &study);
    check_status(status, HOOKE_OK);
    check_status(hooke_measurement_run(study, NULL), k == 0 ? HOOKE_BAD_VALUE : HOOKE_OK);
    if (k == 0) {
      check_message("budget");
      assert_true(isnan(hooke_measurement_number(study, "reference", 0, "agreement")));
      assert_true(isnan(hooke_measurement_number(study, "reference", 0, "checked_until")));
      assert_int_equal(hooke_measurement_row_count(study, "rows"), 0);
    } else {
      check_close(hooke_measurement_number(study, "reference", 0, "checked_until"), every[k], 1e-12);
      check_close(hooke_measurement_number(study, "reference", 0, "trusted_until"), every[k], 1e-12);
      check_between((double)hooke_measurement_row_count(study, "rows"), 6.0, 7.0);
    }
    hooke_system_destroy(system);
  }
}

/* ---- stopping ---- */

static int32_t stop_after_some(double done, const char *what, void *ctx) {
  int64_t *calls = ctx;
  (void)done;
  return strcmp(what, "tr-bdf2") == 0 && ++*calls > 15 ? 1
                                                       : 0; /* one a frame, and now and then one between */
}

TEST(a_stopped_study_keeps_its_rows) {
  owned_system *system = build_reference(find_reference("oscillator"));
  owned_measurement *study = start_study(system, NULL, 5.0, 0.5, 1e-3);
  int64_t calls = 0;
  hooke_measurement_on_progress(study, stop_after_some, &calls);
  check_status(hooke_measurement_run(study, NULL), HOOKE_STOPPED);
  check_between((double)hooke_measurement_row_count(study, "rows"), 1.0, 20.0);
  int64_t finished = 0;
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    finished += strcmp(hooke_measurement_text(study, "rows", k, "status"), "finished") == 0;
  }
  check_between((double)finished, 1.0, (double)hooke_measurement_row_count(study, "rows") - 1.0);
  check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-15, 1e-6);
  assert_null(hooke_measurement_text(study, "recommendation", 0, "method"));
}

/* Rows that run in parallel give the same numbers as one after the other, and stop when asked to. */
TEST(rows_side_by_side_are_the_same) {
  hooke_system *system = build_reference(find_reference("oscillator"));
  hooke_measurement *study[3] = {NULL};
  for (int k = 0; k < 3; k++) {
    owned_options *run = run_options((struct run){.duration = 1.0, .every = 0.1, .threads = k == 0 ? 1 : 2});
    const int32_t status = hooke_measurement_create("study", system, run, NULL, &study[k]);
    check_status(status, HOOKE_OK);
  }
  check_ok(hooke_measurement_run(study[0], NULL));
  check_ok(hooke_measurement_run(study[1], NULL));
  const int64_t rows = hooke_measurement_row_count(study[0], "rows");
  assert_int_equal(hooke_measurement_row_count(study[1], "rows"), rows);
  int64_t found = 0;
  for (int64_t k = 0; k < rows; k++) {
    for (int64_t other = 0; other < rows; other++) {
      const char *words[] = {"step", "rtol", "error", "error_final", "force_evaluations"};
      int same = strcmp(hooke_measurement_text(study[0], "rows", k, "method"),
                        hooke_measurement_text(study[1], "rows", other, "method")) == 0;
      for (size_t w = 0; w < sizeof words / sizeof words[0]; w++) {
        const double a = hooke_measurement_number(study[0], "rows", k, words[w]),
                     b = hooke_measurement_number(study[1], "rows", other, words[w]);
        same = same && (a == b || (isnan(a) && isnan(b)));
      }
      found += same;
    }
  }
  assert_int_equal(found, rows);
  int64_t calls = 0;
  hooke_measurement_on_progress(study[2], stop_after_some, &calls);
  check_status(hooke_measurement_run(study[2], NULL), HOOKE_STOPPED);
  assert_true(hooke_measurement_row_count(study[2], "rows") < rows);
  for (int k = 0; k < 3; k++)
    hooke_measurement_destroy(study[k]);
  hooke_system_destroy(system);
}
