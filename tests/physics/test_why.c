/* Runs that callbacks blow up, kept states, and the rules of a diagnosis. The scenes without
 * callbacks are in tests/cli/scenes/exploding. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int32_t has_lapack(void) {
  return hooke_build_fact("lapack")[0] != '\0';
}

#define needs_lapack()                                                                                       \
  if (!has_lapack()) skip()

/* ---- callbacks ---- */

struct fault {
  int64_t particle;
  double from, beyond; /* time at which the fault begins; or the x beyond which it begins */
  double value;
  int64_t calls;
};

static int32_t faulty_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct fault *fault = ctx;
  (void)n, (void)v;
  fault->calls++;
  force[3 * fault->particle + 1] -= 0.5;
  if (t >= fault->from && q[3 * fault->particle] > fault->beyond) force[3 * fault->particle] = fault->value;
  return 0;
}

static int32_t faulty_drive(int64_t count, double t, double *q, double *v, void *ctx) {
  const struct fault *fault = ctx;
  for (int64_t k = 0; k < 3 * count; k++)
    q[k] = v[k] = 0.0;
  if (t >= fault->from) q[1] = fault->value;
  return 0;
}

/* Three masses in a row on springs, the first one pinned or driven; swinging along x. */
static hooke_system *row(int32_t pin_first) {
  const double position[] = {0, 0, 0, 1.1, 0, 0, 2, 0.1, 0};
  const int64_t ends[] = {0, 1, 1, 2};
  hooke_system *system = small_system(3, position, NULL, 1.0, pin_first);
  springs_with(system, 2, ends, .law = "length", .stiffness = 100.0, .rest_length = 1.0);
  return system;
}

static void check_text(const char *found, const char *expected) {
  if (found == NULL || strcmp(found, expected) != 0)
    check_failed("\"%s\" instead of \"%s\"", found ? found : "(null)", expected);
}

static const char *claim(const hooke_measurement *why, int64_t row, const char *column) {
  return hooke_measurement_text(why, "claims", row, column);
}

/* The sentence in two claims, the cause and how it went on, and after them one for what is not known. */
static void check_claims(const hooke_measurement *why, const char *of) {
  const char *left_out = hooke_measurement_text(why, "why", 0, "left_out");
  const int64_t course = hooke_measurement_find(why, "claims", "key", "course"), count = course < 0 ? 1 : 2;
  char both[2048];
  check_text(claim(why, 0, "key"), "cause");
  check_text(claim(why, 0, "of"), of);
  assert_true(course < 0 || course == 1);
  if (course == 1) check_text(claim(why, 1, "of"), "part");
  snprintf(both, sizeof both, course < 0 ? "%s" : "%s; %s", claim(why, 0, "text"), claim(why, 1, "text"));
  check_text(hooke_measurement_text(why, "why", 0, "sentence"), both);
  assert_int_equal(hooke_measurement_row_count(why, "claims"), count + (left_out != NULL));
  if (left_out) check_text(claim(why, count, "text"), left_out);
  if (left_out) check_text(claim(why, count, "of"), "unknown");
}

static hooke_measurement *explain(hooke_integrator *integrator) {
  hooke_measurement *why = NULL;
  check_ok(explain_run(integrator, &why));
  check_claims(why, "part");
  return why;
}

/* Diagnoses with a budget [s] (0: the default) and `progress`; returns the status, and there are no results
 * unless it is HOOKE_OK. */
static int32_t explain_within(const hooke_integrator *integrator, double budget, hooke_progress *progress,
                              void *ctx, hooke_measurement **why) {
  owned_options *options = new_options("why");
  if (budget > 0.0) check_ok(hooke_options_set_number(options, "budget", budget));
  check_ok(hooke_why_create(integrator, options, why));
  hooke_measurement_on_progress(*why, progress, ctx);
  const int32_t status = hooke_measurement_run(*why, NULL);
  if (status == HOOKE_OK) return status;
  assert_int_equal(hooke_measurement_row_count(*why, "why"), 0);
  assert_int_equal(hooke_measurement_row_count(*why, "blame"), 0);
  assert_int_equal(hooke_measurement_row_count(*why, "advice"), 0);
  hooke_measurement_destroy(*why);
  *why = NULL;
  return status;
}

/* The run with advice `place` finishes. */
static void check_advice(const hooke_system *system, const hooke_integrator *integrator,
                         const hooke_measurement *why, int64_t place) {
  owned_options *options = NULL;
  owned_integrator *again = NULL;
  owned_state *state = start_state(system);
  check_ok(hooke_options_copy(hooke_integrator_options(integrator), &options));
  check_ok(hooke_why_advice_apply(why, place, options));
  check_ok(hooke_integrator_create(system, options, &again));
  check_ok(hooke_integrator_run(again, state));
  check_close(hooke_state_time(state), hooke_options_number(options, "duration"), 1e-12);
}

static void check_callback(hooke_system *system, struct run run, const char *word, double time, double slack,
                           int64_t particle) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  const int32_t outcome = hooke_integrator_run(integrator, state);
  if (outcome != HOOKE_DIVERGED && outcome != HOOKE_SOLVER_FAILED) check_failed("outcome %d", (int)outcome);
  owned_measurement *why = explain(integrator);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "force-not-finite");
  check_text(hooke_measurement_text(why, "why", 0, "method"), run.method);
  check_close(hooke_measurement_number(why, "why", 0, "particle"), (double)particle, 0.0);
  check_between(hooke_measurement_number(why, "why", 0, "time"), time - slack, time + 1e-9);
  if (strstr(hooke_measurement_text(why, "why", 0, "sentence"), word) == NULL)
    check_failed("%s", hooke_measurement_text(why, "why", 0, "sentence"));
  assert_true(hooke_measurement_row_count(why, "advice") >= 2);
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "duration");
  check_advice(system, integrator, why, 0);
  check_text(hooke_measurement_text(why, "advice", 1, "option"), "");
  if (strstr(hooke_measurement_text(why, "advice", 1, "change"), word) == NULL)
    check_failed("%s", hooke_measurement_text(why, "advice", 1, "change"));
  hooke_system_destroy(system);
}

/* NaN from a time on; infinite beyond a position; from fixed steps, from stages within steps, from a solver.
 */
TEST(test_force_callbacks) {
  needs_lapack();
  const struct run runs[] = {
      {.method = "symplectic-euler", .step = 0.01, .duration = 3.0, .every = 0.5},
      {.method = "verlet", .step = 0.01, .duration = 30.0, .every = 30.0},
      {.method = "rk4", .step = 0.01, .duration = 3.0},
      {.method = "backward-euler", .step = 0.01, .duration = 3.0},
      {.method = "cvode-adams", .duration = 3.0},
  };
  for (size_t k = 0; k < sizeof runs / sizeof runs[0]; k++) {
    if (!hooke_method_is_built(runs[k].method)) continue;
    const double slack = runs[k].step > 0.0 ? 0.021 : 0.2;
    struct fault at_time = {.particle = 2, .from = 1.0, .beyond = -1e9, .value = NAN};
    hooke_system *system = row(1);
    check_ok(hooke_system_set_force(system, faulty_force, NULL, &at_time));
    check_ok(hooke_system_commit(system));
    check_callback(system, runs[k], "force callback", 1.0, slack, 2);
    assert_true(at_time.calls > 0);
  }
  /* the second mass swings about 1: beyond 1.02 on its first way up */
  struct fault at_place = {.particle = 1, .from = 0.3, .beyond = 1.02, .value = INFINITY};
  hooke_system *system = row(1);
  check_ok(hooke_system_set_force(system, faulty_force, NULL, &at_place));
  check_ok(hooke_system_commit(system));
  check_callback(system, runs[0], "force callback", 0.6, 0.3, 1);
}

TEST(test_drive_callback) {
  needs_lapack();
  struct fault fault = {.from = 0.995, .value = NAN};
  const int64_t first = 0;
  hooke_system *system = row(0);
  check_ok(hooke_system_drive_callback(system, 1, &first, faulty_drive, &fault));
  check_ok(hooke_system_commit(system));
  check_callback(system, (struct run){.method = "symplectic-euler", .step = 0.01, .duration = 3.0},
                 "drive callback", 1.0, 0.021, 0);
}

/* A callback called at overflowed positions is not to blame for its results. */
static int32_t cubic_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)v, (void)ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] -= 1e-3 * q[k] * q[k] * q[k];
  return 0;
}

TEST(test_innocent_callback) {
  needs_lapack();
  owned_system *system = row(1);
  check_ok(hooke_system_set_force(system, cubic_force, NULL, NULL));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.2, .duration = 400.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = explain(integrator);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  check_between(hooke_measurement_number(why, "why", 0, "limit"), 0.1, 0.2);
  check_advice(system, integrator, why, 0);
}

/* ---- a diagnosis ---- */

/* sqrt(k/m) = 10: the limit is 0.2; the growth of symplectic Euler is known, and so is the step that
 * overflows. */
TEST(test_numbers_of_an_oscillator) {
  needs_lapack();
  owned_system *system = small_oscillator(10.0);
  owned_integrator *every_step =
      start_with(system, .method = "symplectic-euler", .step = 0.21, .duration = 21.0, .every = 0.21);
  owned_run(rarely, state, system, .method = "symplectic-euler", .step = 0.21, .duration = 21.0,
            .every = 21.0);
  check_status(hooke_integrator_run(every_step, state), HOOKE_DIVERGED);
  const double last_good = hooke_state_time(state), bad = hooke_integrator_number(every_step, "diverged_at");
  owned_state *late = start_state(system);
  check_status(hooke_integrator_run(rarely, late), HOOKE_DIVERGED);
  check_close(hooke_state_time(late), 0.0, 0.0);
  owned_measurement *why = explain(rarely);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  check_close(hooke_measurement_number(why, "why", 0, "limit"), 0.2, 1e-6);
  check_close(hooke_measurement_number(why, "why", 0, "step"), 0.21, 0.0);
  /* the exact step, found by repeating the run */
  check_close(hooke_measurement_number(why, "why", 0, "time"), last_good, 0.0);
  check_close(hooke_measurement_number(why, "why", 0, "noticed"), 21.0, 1e-12);
  char words[64];
  snprintf(words, sizeof words, "at t = %.6g s particle 1", bad);
  if (strstr(hooke_measurement_text(why, "why", 0, "sentence"), words) == NULL)
    check_failed("no \"%s\" in: %s", words, hooke_measurement_text(why, "why", 0, "sentence"));
  assert_int_equal(hooke_measurement_row_count(why, "blame"), 1);
  check_close(hooke_measurement_number(why, "blame", 0, "share"), 1.0, 1e-9);
  check_close(hooke_measurement_number(why, "blame", 0, "second"), 1.0, 0.0);
  check_text(hooke_measurement_text(why, "blame", 0, "group"), "springs");
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "step");
  const double advised = strtod(hooke_measurement_text(why, "advice", 0, "value"), NULL);
  check_between(advised, 0.09, 0.1801);
  check_advice(system, rarely, why, 0);
  assert_true(isnan(hooke_measurement_number(why, "why", 0, "magic")) &&
              hooke_measurement_text(why, "why", 0, "magic") == NULL);
  assert_true(isnan(hooke_measurement_number(why, "blame", 1, "share")) &&
              hooke_measurement_text(why, "advice", 9, "change") == NULL);
  check_status(hooke_why_advice_apply(why, 9, NULL), HOOKE_BAD_VALUE);

  /* the same from states that were kept */
  owned_measurement *kept = NULL;
  owned_state *first = start_state(system);
  check_ok(hooke_why_create_kept(system, hooke_integrator_options(every_step), first, state, NULL, &kept));
  check_ok(hooke_measurement_run(kept, NULL));
  check_status(hooke_measurement_run(kept, NULL), HOOKE_BAD_CALL);
  check_text(hooke_measurement_text(kept, "why", 0, "cause"), "step-above-limit");
  check_close(hooke_measurement_number(kept, "why", 0, "time"), last_good, 0.0);
  check_close(hooke_measurement_number(kept, "why", 0, "noticed"), bad, 0.0);
}

/* Repeating the steps and trying advice leaves the integrator unchanged. */
TEST(test_asking_changes_nothing) {
  needs_lapack();
  owned_system *system = small_oscillator(10.0);
  const struct run run = {.method = "symplectic-euler", .step = 0.21, .duration = 21.0, .every = 0.21};
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  const int64_t steps = hooke_integrator_count(integrator, "steps");
  owned_measurement *one = explain(integrator), *two = explain(integrator);
  check_text(hooke_measurement_text(one, "why", 0, "sentence"),
             hooke_measurement_text(two, "why", 0, "sentence"));
  check_text(hooke_measurement_text(one, "advice", 0, "value"),
             hooke_measurement_text(two, "advice", 0, "value"));
  assert_int_equal(hooke_integrator_count(integrator, "steps"), steps);
}

/* Error-controlled methods with tolerances a thousand times the motion: energy creeps up until it is too
 * much. */
TEST(test_tolerances_that_are_too_loose) {
  needs_lapack();
  const char *const methods[] = {"cvode-adams", "rk8pd"};
  for (int k = 0; k < 2; k++) {
    if (!hooke_method_is_built(methods[k])) continue;
    owned_system *system = small_oscillator(10.0);
    owned_run(integrator, state, system, .method = methods[k], .duration = 1000.0, .rtol = 0.1,
              .atol = 1000.0, .atol_velocity = 1000.0);
    check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
    owned_measurement *why = explain(integrator);
    check_text(hooke_measurement_text(why, "why", 0, "cause"), "solver-failed");
    assert_non_null(strstr(hooke_measurement_text(why, "why", 0, "sentence"),
                           "the tolerances (rtol 0.1) let errors grow"));
    assert_true(isnan(hooke_measurement_number(why, "why", 0, "step")));
    check_text(hooke_measurement_text(why, "advice", 0, "option"), "method");
    check_advice(system, integrator, why, 0);
  }
}

/* A force that grows as the cube of the distance blows up in finite time, at about t = 1.77 s: no step and no
 * tolerance gets past that. */
static int32_t escaping_force(int64_t n, double t, const double *q, const double *v, double *force,
                              void *ctx) {
  (void)t, (void)v, (void)ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += q[k] * q[k] * q[k];
  return 0;
}

TEST(test_solvers_that_give_up) {
  needs_lapack();
  const struct run runs[] = {
      {.method = "cvode-adams", .duration = 100.0},
      {.method = "rk8pd", .duration = 100.0},
      {.method = "backward-euler", .step = 0.01, .duration = 100.0, .newton = "converged"},
  };
  for (int k = 0; k < 3; k++) {
    if (!hooke_method_is_built(runs[k].method)) continue;
    const double position[] = {0, 0, 0, 1.1, 0, 0}, velocity[] = {0, 0, 0, 0, 0.5, 0};
    const int64_t ends[] = {0, 1};
    owned_system *system = small_system(2, position, velocity, 1.0, 1);
    springs_with(system, 1, ends, .law = "length", .stiffness = 1.0, .rest_length = 1.0);
    check_ok(hooke_system_set_force(system, escaping_force, NULL, NULL));
    check_ok(hooke_system_commit(system));
    owned_integrator *integrator = start_run(system, runs[k]);
    owned_state *state = start_state(system);
    check_status(hooke_integrator_run(integrator, state), HOOKE_SOLVER_FAILED);
    owned_measurement *why = explain(integrator);
    check_text(hooke_measurement_text(why, "why", 0, "cause"), "solver-failed");
    assert_non_null(
        strstr(hooke_measurement_text(why, "why", 0, "sentence"), "the solver gave up after t = "));
    check_between(hooke_measurement_number(why, "why", 0, "time"), 1.6, 1.8);
    /* only to see how it gets there */
    assert_int_equal(hooke_measurement_row_count(why, "advice"), 1);
    check_text(hooke_measurement_text(why, "advice", 0, "option"), "duration");
    check_between(strtod(hooke_measurement_text(why, "advice", 0, "value"), NULL), 1.4, 1.78);
    check_advice(system, integrator, why, 0);
  }
}

/* A step above the limit of 0.2 s, and the same force, which no step gets past: the step that the limit gives
 * comes last, and its words own up to that. */
TEST(test_a_step_that_is_not_enough) {
  needs_lapack();
  const double position[] = {0, 0, 0, 1, 0, 0}, velocity[] = {0, 0, 0, 0, 60, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, position, velocity, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = 100.0, .rest_length = 1.0);
  check_ok(hooke_system_set_force(system, escaping_force, NULL, NULL));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.21, .duration = 21.0,
            .every = 0.21);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = explain(integrator);
  check_close(hooke_measurement_number(why, "why", 0, "limit"), 0.2, 1e-6);
  int64_t found = -1;
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice"); k++) {
    if (strcmp(hooke_measurement_text(why, "advice", k, "option"), "step") == 0) found = k;
  }
  assert_int_equal(found, 1);
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "duration");
  check_advice(system, integrator, why, 0);
  check_text(
      hooke_measurement_text(why, "advice", 1, "change"),
      "a step of 0.01 s, below the limit, which is not enough (tried: the run ends early with it, too)");
}

TEST(test_kept_state_that_is_not_finite) {
  owned_system *system = small_oscillator(10.0);
  owned_options *options = run_options((struct run){.method = "verlet", .step = 0.01, .duration = 1.0});
  owned_state *first = start_state(system), *last = start_state(system);
  owned_measurement *why = NULL;
  hooke_state_position(last)[4] = NAN;
  check_status(hooke_why_create_kept(system, options, first, last, NULL, &why),
               has_lapack() ? HOOKE_OK : HOOKE_NOT_BUILT);
  for (int k = 0; why && k < 2; k++) { /* again, with the same result */
    check_status(hooke_measurement_run(why, NULL), HOOKE_BAD_VALUE);
    check_message("position[1][1]: nan is not allowed");
    assert_int_equal(hooke_measurement_row_count(why, "why"), 0);
  }
}

/* A loop of the caller's own has no duration. */
TEST(test_own_loop) {
  needs_lapack();
  owned_system *system = small_oscillator(10.0);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.3);
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 100 && status == HOOKE_OK; k++)
    status = hooke_integrator_step(integrator, state, 100);
  check_status(status, HOOKE_DIVERGED);
  owned_measurement *why = explain(integrator);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "step");
}

/* A mass between four springs, two of which are drawn apart after millions of steps: stretched, they are also
 * stiff across. Advice is then tried from a state shortly before the failure. */
TEST(test_trouble_that_comes_late) {
  if (left_out(1, 2)) skip(); /* the code is that of the others, after far fewer steps */
  needs_lapack();
  const double position[] = {-1, 0, 0, 1, 0, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0};
  const double velocity[] = {0, 0, 0, 0, 0, 0, 1e-3, 1e-3, 0, 0, 0, 0, 0, 0, 0};
  const int64_t ends[] = {0, 2, 1, 2, 2, 3, 2, 4}, pinned[] = {3, 4}, left = 0, right = 1;
  const double time[] = {0, 2.5e5, 2.6e5, 2.7e5, 2.8e5}, out[15] = {[12] = -6.0};
  double other[15];
  for (int k = 0; k < 15; k++)
    other[k] = -out[k];
  owned_system *system = small_system(5, position, velocity, 1.0, 0);
  check_ok(hooke_system_pin(system, 2, pinned));
  springs_with(system, 4, ends, .law = "length", .stiffness = 100.0, .rest_length = 1.0);
  check_ok(hooke_system_drive_table(system, 1, &left, 5, time, out));
  check_ok(hooke_system_drive_table(system, 1, &right, 5, time, other));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.13, .duration = 0.13 * 3e6,
            .every = 130.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = explain(integrator);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  check_between(hooke_measurement_number(why, "why", 0, "limit"), 0.1, 0.13);
  check_between(hooke_measurement_number(why, "why", 0, "time"), 2.6e5, 2.81e5);
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "step");
  assert_non_null(strstr(hooke_measurement_text(why, "advice", 0, "change"), "tried from t = 2"));
  check_advice(system, integrator, why, 0);
}

static int32_t explode(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)ctx;
  for (int64_t k = 0; k < n; k++)
    rate[k] = x[k] * x[k];
  return 0;
}

/* ---- limits on time and memory ---- */

static int32_t count_down(double done, const char *what, void *ctx) {
  check_between(done, 0.0, 1.0);
  assert_true(what != NULL && what[0] != '\0');
  return --*(int *)ctx < 0;
}

/* Stopping at any call, within replays, searches and trials, gives no results; otherwise the callback changes
 * nothing. */
TEST(test_progress_ends_it) {
  needs_lapack();
  owned_system *system = committed(row(1));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.5, .duration = 500.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  int calls = 1000000;
  hooke_measurement *why = NULL;
  check_ok(explain_within(integrator, 1e300, count_down, &calls, &why));
  const int all = 1000000 - calls;
  assert_true(all > 4);
  assert_null(hooke_measurement_text(why, "why", 0, "left_out"));
  hooke_measurement_destroy(why);
  int stopped = 0, tried = 0;
  for (int after = 0; after < all; after += 1 + all / 40) {
    calls = after;
    why = NULL;
    const int32_t status = explain_within(integrator, 1e300, count_down, &calls, &why);
    tried++;
    if (calls >= 0) { /* calls within trials depend on time: there were fewer this time */
      check_status(status, HOOKE_OK);
      hooke_measurement_destroy(why);
      continue;
    }
    check_status(status, HOOKE_STOPPED);
    assert_null(why);
    check_between(calls, -1.0, -1.0); /* never called again */
    stopped++;
  }
  assert_true(2 * stopped >= tried);
}

/* A call of a callback counts as 50 us, as a script may take: 85 % of 2 s are 34,000 of them, in which the
 * trial of a smaller step does not come to its end. */
TEST(test_callbacks_are_not_called_for_ever) {
  needs_lapack();
  struct fault none = {.particle = 2, .from = INFINITY};
  owned_system *system = row(1);
  check_ok(hooke_system_set_force(system, faulty_force, NULL, &none));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.5, .duration = 5e5,
            .every = 5e4);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  none.calls = 0;
  owned_measurement *why = NULL;
  check_ok(explain_within(integrator, 0.0, NULL, NULL, &why));
  check_between((double)none.calls, 3.3e4, 3.6e4);
  check_text(hooke_measurement_text(why, "advice", 0, "option"), "step");
  assert_non_null(strstr(hooke_measurement_text(why, "advice", 0, "change"), "tried up to t = "));
  assert_non_null(
      strstr(hooke_measurement_text(why, "why", 0, "left_out"), "(2 s of counted work): what else"));
}

/* Without time nothing is claimed but certain facts. */
TEST(test_no_time) {
  needs_lapack();
  owned_system *system = committed(row(1));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.5, .duration = 500.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = NULL;
  check_ok(explain_within(integrator, 1e-9, NULL, NULL, &why));
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "unknown");
  check_claims(why, "unknown");
  if (strstr(hooke_measurement_text(why, "why", 0, "left_out"), "time was short") == NULL)
    check_failed("%s", hooke_measurement_text(why, "why", 0, "left_out"));
  assert_true(isnan(hooke_measurement_number(why, "why", 0, "limit")));
}

TEST(test_nothing_to_explain) {
  hooke_measurement *why = NULL;
  owned_system *system = small_oscillator(10.0);
  owned_integrator *integrator =
      start_with(system, .method = "symplectic-euler", .step = 0.01, .duration = 1.0);
  hooke_state *state = start_state(system);
  check_status(explain_run(integrator, &why), HOOKE_BAD_CALL);
  check_ok(hooke_integrator_run(integrator, state));
  check_status(explain_run(integrator, &why), HOOKE_BAD_CALL);
  check_message("did not blow up");
  hooke_state_destroy(state);

  owned_integrator *first_order = start_first_order(
      1, explode, NULL, (struct run){.method = "forward-euler", .step = 0.1, .duration = 10.0});
  check_ok(hooke_state_create_first_order(1, &state));
  hooke_state_position(state)[0] = 1.0;
  check_status(hooke_integrator_run(first_order, state), HOOKE_DIVERGED);
  check_status(explain_run(first_order, &why), HOOKE_UNSUITED);
  check_status(hooke_integrator_on_warning(first_order, NULL, NULL), HOOKE_UNSUITED);
  hooke_state_destroy(state);
}

/* ---- kept states ---- */

static int32_t record(int64_t step, const hooke_state *state, void *ctx) {
  double *seen = ctx;
  seen[4 * step] = hooke_state_time(state);
  memcpy(seen + 4 * step + 1, hooke_state_position(state) + 3, 3 * sizeof(double));
  return 0;
}

TEST(test_recent_states) {
  enum { STEPS = 20 };
  owned_system *system = small_oscillator(10.0);
  owned_integrator *integrator =
      start_with(system, .method = "verlet", .step = 0.01, .duration = STEPS * 0.01, .every = 0.01);
  owned_state *state = start_state(system), *recent = start_state(system);
  owned_doubles *seen = new_doubles(4 * (STEPS + 1));
  assert_int_equal(hooke_integrator_count(integrator, "recent"), 0);
  check_status(hooke_integrator_recent(integrator, 0, recent), HOOKE_BAD_VALUE);
  check_ok(hooke_integrator_on_frame(integrator, record, seen));
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(hooke_integrator_count(integrator, "recent"), 8);
  for (int64_t k = 0; k < 8; k++) {
    check_ok(hooke_integrator_recent(integrator, k, recent));
    const double *expected = seen + 4 * (STEPS - k);
    check_close(hooke_state_time(recent), expected[0], 0.0);
    check_same_bits(3, hooke_state_position(recent) + 3, expected + 1);
  }
  check_status(hooke_integrator_recent(integrator, 8, recent), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_recent(integrator, -1, recent), HOOKE_BAD_VALUE);
}

/* As many as 16 MB hold, and always the last one: a state of n particles has 48 n bytes. */
TEST(test_recent_states_are_few_at_scale) {
  const struct { int64_t n, count; } sizes[] = {{1000, 8}, {60000, 4}, {400000, 1}};
  for (int s = 0; s < 3; s++) {
    const int64_t n = sizes[s].n;
    owned_doubles *position = new_doubles(3 * n);
    owned_system *system = committed(small_system(n, position, NULL, 1.0, 0));
    owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.1, .duration = 1.0,
              .every = 0.1);
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(hooke_integrator_count(integrator, "recent"), sizes[s].count);
    check_between((double)hooke_integrator_count(integrator, "memory_bytes"), (double)(120 * n),
                  (double)(120 * n) + fmax(16e6, 48.1 * (double)n) + 4096.0);
  }
}

TEST(test_without_lapack) {
  if (has_lapack()) skip();
  hooke_measurement *why = NULL;
  owned_system *system = small_oscillator(10.0);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.3, .duration = 300.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  check_status(explain_run(integrator, &why), HOOKE_NOT_BUILT);
}

/* ---- overflow without springs ---- */

static void check_overflow(hooke_system *system, int64_t particle, const char *words) {
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.1, .duration = 10.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = explain(integrator);
  check_text(hooke_measurement_text(why, "why", 0, "cause"), "overflow");
  if (strstr(hooke_measurement_text(why, "why", 0, "sentence"), words) == NULL)
    check_failed("%s", hooke_measurement_text(why, "why", 0, "sentence"));
  assert_int_equal(hooke_measurement_row_count(why, "blame"), 0);
  assert_true(hooke_measurement_number(why, "why", 0, "particle") == (double)particle);
  hooke_system_destroy(system);
}

/* Bending and altitude springs of 1e300: the first step overflows, and no spring is blamed. */
TEST(test_overflow_without_springs) {
  needs_lapack();
  const double line[] = {0, 0, 0, 1, 0.5, 0, 2, 0, 0}, coefficient = 1e300;
  const int64_t triple[] = {0, 1, 2}, corners[] = {0, 1, 2, 3};
  hooke_system *bent = small_system(3, line, NULL, 1.0, 1);
  check_ok(hooke_system_add_bending(bent, "stiff", 1, triple, 1, &coefficient));
  check_overflow(bent, 1, "on 1 kg, with a step of 0.1 s");

  const double body[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  hooke_system *stiff = small_system(4, body, NULL, 1.0, 1);
  owned_options *options = options_with("altitude", "stiffness=1e300 rest_scale=1.5");
  check_ok(hooke_system_add_altitude(stiff, "stiff", 1, corners, options));
  check_overflow(stiff, 1, "on 1 kg, with a step of 0.1 s");
}
