/* The integrators for checking references: rk8pd of GSL and the ESDIRK formulas of ARKODE. */
#include "check.h"
#include "random_scene.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

struct checker {
  const char *method, *library;
  double worst; /* allowed |dx| in units of max |x|, at rtol 1e-10 and atol 1e-12 */
};

static const struct checker checkers[] = {{"rk8pd", "GSL", 2e-11}, {"arkode-esdirk", "SUNDIALS", 3e-10}};
enum { CHECKERS = sizeof checkers / sizeof checkers[0] };

static const struct checker *next_built(int64_t *k) {
  while (*k < CHECKERS && hooke_method_is_built(checkers[*k].method) != 1)
    ++*k;
  return *k < CHECKERS ? &checkers[(*k)++] : NULL;
}

/* ---- found by name, not listed ---- */

TEST(test_names) {
  owned_system *system = small_oscillator(2.0);
  for (int c = 0; c < CHECKERS; c++) {
    const char *name = checkers[c].method;
    for (int64_t m = 0; m < hooke_method_count(); m++)
      assert_string_not_equal(hooke_method_name(m), name);
    assert_int_equal(hooke_method_is_adaptive(name), 1);
    assert_non_null(strstr(hooke_method_summary(name), checkers[c].library));
    owned_options *options = run_options((struct run){.method = name});
    hooke_integrator *integrator = NULL;
    if (hooke_method_is_built(name)) {
      check_ok(hooke_integrator_create(system, options, &integrator));
    } else {
      check_status(hooke_integrator_create(system, options, &integrator), HOOKE_NOT_BUILT);
      check_message(checkers[c].library);
    }
    hooke_integrator_destroy(integrator);
  }
  assert_null(hooke_method_name(hooke_method_count()));
  assert_null(hooke_method_name(-1));
}

/* ---- forces that are no numbers ---- */

static int32_t pull_by_nothing(int64_t n, double t, const double *q, const double *v, double *force,
                               void *ctx) {
  (void)t, (void)q, (void)v, (void)ctx;
  force[3 * n - 1] = NAN;
  return 0;
}

TEST(test_no_start_without_a_force) {
  int64_t k = 0;
  for (const struct checker *c; (c = next_built(&k)) != NULL;) {
    const double q[] = {0, 0, 0};
    owned_system *system = small_system(1, q, NULL, 1.0, 0);
    check_ok(hooke_system_set_force(system, pull_by_nothing, NULL, NULL));
    check_ok(hooke_system_commit(system));
    owned_integrator *integrator = start_run(system, (struct run){.method = c->method, .duration = 1.0});
    owned_state *state = start_state(system);
    check_status(hooke_integrator_run(integrator, state), HOOKE_SOLVER_FAILED);
    check_message(c == checkers ? "cannot start at t = 0 s: a force is not finite" : "gave up at t = 0 s");
    check_same_bits(3, hooke_state_position(state), q);
  }
}

/* ---- solutions to 15 digits, with frames at every state, at awkward times, and without ---- */

struct visit {
  const struct reference *reference;
  double every, duration, error;
  int64_t frame, seen;
};

static int32_t at_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct visit *visit = ctx;
  const struct reference *reference = visit->reference;
  hooke_state *readable = (hooke_state *)(uintptr_t)state;
  (void)step;
  check_close(hooke_state_time(state), fmin((double)visit->frame++ * visit->every, visit->duration), 0.0);
  for (int64_t k = 0; k < reference->state_count; k++) {
    const struct reference_state *expected = &reference->state[k];
    if (fabs(hooke_state_time(state) - expected->time) > 1e-9) continue;
    const int64_t size = 3 * reference->particle_count;
    const double error = largest_difference(size, hooke_state_position(readable), expected->position);
    visit->error = fmax(visit->error, error / largest(size, expected->position));
    visit->seen++;
  }
  return 0;
}

/* The largest error relative to max |x|, at the states that are frames and at the end. */
static double largest_error(const struct reference *reference, const char *method, double every) {
  const struct reference_state *last = &reference->state[reference->state_count - 1];
  struct visit visit = {.reference = reference, .every = every, .duration = last->time};
  const int64_t size = 3 * reference->particle_count;
  owned_system *system = build_reference(reference);
  owned_integrator *integrator = start_run(
      system,
      (struct run){.method = method, .rtol = 1e-10, .atol = 1e-12, .duration = last->time, .every = every});
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_on_frame(integrator, at_frame, &visit));
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(visit.frame, hooke_integrator_count(integrator, "frames"));
  assert_int_equal(visit.frame, 1 + (int64_t)ceil(last->time / every - 1e-6));
  if (every == 0.05) assert_int_equal(visit.seen, reference->state_count);
  assert_true(visit.seen >= 1); /* the end is one */
  check_close(hooke_state_time(state), last->time, 0.0);
  const double error = largest_difference(size, hooke_state_position(state), last->position);
  return fmax(visit.error, error / largest(size, last->position));
}

TEST(test_solutions) {
  const double every[] = {0.05, 0.37, 1e3};
  const struct checker *checker;
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    for (int k = 0; k < REFERENCE_COUNT; k++) {
      for (int e = 0; e < 3; e++) {
        const double error = largest_error(&references[k], checker->method, every[e]);
        if (error <= checker->worst) continue;
        check_failed("%s by %s with frames every %g s: the error %.3g is above %.3g of max |x|",
                     references[k].name, checker->method, every[e], error, checker->worst);
      }
    }
  }
}

/* ---- every force, driven particles and springs that only pull: with Adams ---- */

TEST(test_everything) {
  const struct checker *checker;
  if (hooke_method_is_built("cvode-adams") != 1) skip();
  for (uint64_t seed = 1; seed <= 6; seed++) {
    owned_random_scene scene;
    random_scene_create((struct random_scene_request){.seed = seed,
                                                      .particles = 30,
                                                      .springs = 70,
                                                      .rope = seed % 2 ? 5 : 0,
                                                      .with_product = seed % 3 == 0,
                                                      .features = SCENE_EVERYTHING & ~SCENE_COINCIDENT},
                        &scene);
    const int64_t size = 3 * scene.canonical.particle_count;
    owned_doubles *expected = new_doubles(2 * size), *found = new_doubles(2 * size);
    struct run run = {.method = "cvode-adams", .rtol = 1e-11, .atol = 1e-13, .duration = 0.75};
    run_to_end(scene.system, run, expected, expected + size);
    run.rtol = 1e-10, run.atol = 1e-12;
    for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
      run.method = checker->method;
      run_to_end(scene.system, run, found, found + size);
      check_between(largest_difference(size, found, expected) / largest(size, expected), 0.0, 1e-6);
      check_between(largest_difference(size, found + size, expected + size) / largest(size, expected + size),
                    0.0, 1e-6);
    }
  }
}

/* ---- first-order problems ---- */

struct spiral {
  int64_t refused; /* calls that returned NaN */
  double stop_after, nan_after;
};

/* x' = (-0.5 + 3 i) x, in two numbers. */
static int32_t spiral_rate(int64_t n, double t, const double *x, double *rate, void *ctx) {
  struct spiral *spiral = ctx;
  assert_int_equal(n, 2);
  if (spiral->stop_after > 0.0 && t > spiral->stop_after) return 7;
  rate[0] = -0.5 * x[0] - 3.0 * x[1];
  rate[1] = 3.0 * x[0] - 0.5 * x[1];
  if (spiral->nan_after > 0.0 && t > spiral->nan_after) {
    rate[1] = NAN;
    spiral->refused++;
  }
  return 0;
}

static void start_spiral(struct spiral *spiral, struct run run, hooke_integrator **integrator,
                         hooke_state **state) {
  *integrator = start_first_order(2, spiral_rate, spiral, run);
  check_ok(hooke_state_create_first_order(2, state));
  hooke_state_position(*state)[0] = 1.0;
}

static double spiral_error(const char *method, double rtol) {
  struct spiral spiral = {0};
  owned_integrator *integrator;
  owned_state *state;
  start_spiral(
      &spiral,
      (struct run){.method = method, .rtol = rtol, .atol = 1e-3 * rtol, .duration = 2.0, .every = 2.0},
      &integrator, &state);
  check_ok(hooke_integrator_run(integrator, state));
  const double expected[] = {exp(-1.0) * cos(6.0), exp(-1.0) * sin(6.0)};
  const double error = largest_difference(2, hooke_state_position(state), expected);
  return error;
}

TEST(test_first_order) {
  const struct checker *checker;
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    const double loose = spiral_error(checker->method, 1e-4), tight = spiral_error(checker->method, 1e-10);
    check_between(loose, 1e-9, 1e-3);
    check_between(tight, 0.0, 1e-9);
    check_between(tight / loose, 0.0, 1e-2);
  }
}

/* ---- ends: stops, limits, non-finite numbers ---- */

TEST(test_stop) {
  const struct checker *checker;
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    struct spiral spiral = {.stop_after = 1.0};
    owned_integrator *integrator;
    owned_state *state;
    start_spiral(&spiral,
                 (struct run){.method = checker->method, .rtol = 1e-8, .duration = 2.0, .every = 2.0},
                 &integrator, &state);
    check_status(hooke_integrator_run(integrator, state), HOOKE_STOPPED);
    assert_int_equal(hooke_integrator_count(integrator, "stop_value"), 7);
    const double t = hooke_state_time(state), *x = hooke_state_position(state);
    check_between(t, 0.5, 1.0);
    check_close(x[0], exp(-0.5 * t) * cos(3.0 * t), 1e-6);
    check_close(x[1], exp(-0.5 * t) * sin(3.0 * t), 1e-6);
    /* at the first evaluation: the state is unchanged */
    spiral.stop_after = 1e-300;
    hooke_state_set_time(state, 3.0);
    const double before[] = {x[0], x[1]};
    check_status(hooke_integrator_run(integrator, state), HOOKE_STOPPED);
    check_same_bits(2, hooke_state_position(state), before);
    check_close(hooke_state_time(state), 3.0, 0.0);
  }
}

TEST(test_not_finite) {
  const struct checker *checker;
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    struct spiral spiral = {.nan_after = 1.0};
    owned_integrator *integrator;
    owned_state *state;
    start_spiral(&spiral,
                 (struct run){.method = checker->method, .rtol = 1e-8, .duration = 2.0, .every = 2.0},
                 &integrator, &state);
    check_status(hooke_integrator_run(integrator, state), HOOKE_SOLVER_FAILED);
    check_message("gave up at t = ");
    assert_true(spiral.refused > 5);
    const double t = hooke_state_time(state), *x = hooke_state_position(state);
    check_between(t, 0.9, 1.0);
    check_close(x[0], exp(-0.5 * t) * cos(3.0 * t), 1e-6);
  }
}

/* x' = -40 x, undefined below -0.1: steps that overshoot have to be repeated. */
static int32_t guarded_rate(int64_t n, double t, const double *x, double *rate, void *ctx) {
  int64_t *refused = ctx;
  (void)n;
  (void)t;
  rate[0] = x[0] < -0.1 ? NAN : -40.0 * x[0];
  *refused += x[0] < -0.1;
  return 0;
}

TEST(test_recovers) {
  if (hooke_method_is_built("rk8pd") != 1) skip();
  int64_t refused = 0;
  owned_integrator *integrator = start_first_order(
      1, guarded_rate, &refused,
      (struct run){.method = "rk8pd", .rtol = 0.1, .atol = 0.5, .duration = 50.0, .every = 50.0});
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(1, &state));
  hooke_state_position(state)[0] = 1.0;
  check_ok(hooke_integrator_run(integrator, state));
  check_between((double)refused, 1.0, 1e5);
  check_between(hooke_state_position(state)[0], -0.5, 0.5);
}

TEST(test_step_limit) {
  const struct checker *checker;
  owned_system *system = small_oscillator(3.0);
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    owned_options *options = run_options((struct run){.method = checker->method, .duration = 1000.0});
    owned_integrator *integrator = NULL;
    check_ok(hooke_options_set_number(options, "max_steps", 12));
    check_ok(hooke_integrator_create(system, options, &integrator));
    owned_state *state = start_state(system);
    check_status(hooke_integrator_run(integrator, state), HOOKE_STEP_LIMIT);
    assert_int_equal(hooke_integrator_count(integrator, "steps"), 12);
    check_between(hooke_state_time(state), 1e-3, 100.0);
    check_close(hooke_state_position(state)[3], cos(3.0 * hooke_state_time(state)), 1e-4);
  }
}

TEST(test_order_of_arkode) {
  if (hooke_method_is_built("arkode-esdirk") != 1) skip();
  owned_system *system = small_oscillator(3.0);
  double steps[6];
  for (int order = 2; order <= 6; order++) {
    owned_options *options = run_options(
        (struct run){.method = "arkode-esdirk", .rtol = 1e-8, .atol = 1e-8, .duration = 5.0, .every = 5.0});
    hooke_integrator *integrator = NULL;
    check_ok(hooke_options_set_number(options, "max_order", order));
    if (order < 3 || order > 5) {
      check_status(hooke_integrator_create(system, options, &integrator), HOOKE_BAD_VALUE);
      check_message("3 to 5");
    } else {
      check_ok(hooke_integrator_create(system, options, &integrator));
      owned_state *state = start_state(system);
      check_ok(hooke_integrator_run(integrator, state));
      check_close(hooke_state_position(state)[3], cos(15.0), 1e-5);
      steps[order] = (double)hooke_integrator_count(integrator, "steps");
    }
    hooke_integrator_destroy(integrator);
  }
  check_between(steps[3] / steps[4], 3.0, 50.0);
  check_between(steps[3] / steps[5], 3.0, 50.0);
  assert_true(steps[4] != steps[5]);
}

/* ---- restarting, continuing, zero steps ---- */

TEST(test_again) {
  const char *counts[] = {"steps", "force_evaluations", "nonlinear_iterations", "linear_iterations",
                          "error_test_failures"};
  const struct checker *checker;
  owned_system *system = build_reference(find_reference("six-particles"));
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    owned_integrator *integrator =
        start_run(system, (struct run){.method = checker->method, .rtol = 1e-7, .duration = 0.5});
    owned_state *first = start_state(system), *second = start_state(system);
    int64_t once[5];
    check_ok(hooke_integrator_run(integrator, first));
    for (int k = 0; k < 5; k++)
      once[k] = hooke_integrator_count(integrator, counts[k]);
    assert_true(once[0] >= 100); /* one a frame at least */
    check_ok(hooke_integrator_run(integrator, second));
    for (int k = 0; k < 5; k++)
      assert_int_equal(hooke_integrator_count(integrator, counts[k]), 2 * once[k]);
    check_same_bits(18, hooke_state_position(second), hooke_state_position(first));
    check_same_bits(18, hooke_state_velocity(second), hooke_state_velocity(first));
  }
}

TEST(test_steps_by_hand) {
  const struct checker *checker;
  owned_system *system = build_reference(find_reference("six-particles"));
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    hooke_state *state[2];
    for (int parts = 0; parts < 2; parts++) {
      owned_integrator *integrator = start_run(system, (struct run){.method = checker->method, .rtol = 1e-7});
      state[parts] = start_state(system);
      check_ok(hooke_integrator_step(integrator, state[parts], parts ? 3 : 20));
      if (parts) check_ok(hooke_integrator_step(integrator, state[parts], 17));
      assert_int_equal(hooke_integrator_count(integrator, "steps"), 20);
    }
    check_between(hooke_state_time(state[0]), 1e-3, 10.0);
    check_close(hooke_state_time(state[1]), hooke_state_time(state[0]), 0.0);
    check_same_bits(18, hooke_state_position(state[1]), hooke_state_position(state[0]));
    hooke_state_destroy(state[0]);
    hooke_state_destroy(state[1]);
  }
}

TEST(test_nothing_free) {
  const struct checker *checker;
  const double position[] = {1.0, 2.0, 3.0};
  owned_system *system = small_system(1, position, NULL, 1.0, 1);
  check_ok(hooke_system_commit(system));
  for (int64_t c = 0; (checker = next_built(&c)) != NULL;) {
    double q[3], v[3];
    run_to_end(system, (struct run){.method = checker->method, .duration = 2.0}, q, v);
    check_same_bits(3, q, position);
    check_close(largest(3, v), 0.0, 0.0);
  }
}
