/* The run loop: frames, times, observers, energies and counts. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* ---- frames ---- */

struct frames {
  double start, step;
  int64_t stride; /* steps between frames */
  int64_t last;   /* step at the end */
  int64_t seen;
};

static int32_t check_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct frames *frames = ctx;
  const double t = hooke_state_time(state), expected = frames->start + (double)step * frames->step;
  const int64_t k = frames->seen * frames->stride;
  assert_int_equal(step, k < frames->last ? k : frames->last);
  check_same_bits(1, &t, &expected);
  frames->seen++;
  return 0;
}

struct times {
  double before, now; /* of the last two frames */
  int64_t seen;
};

static int32_t note_time(int64_t step, const hooke_state *state, void *ctx) {
  struct times *times = ctx;
  (void)step;
  assert_true(hooke_state_time(state) > times->now);
  times->before = times->now;
  times->now = hooke_state_time(state);
  times->seen++;
  return 0;
}

TEST(test_frames) {
  const struct {
    double step, duration, every, start;
    int64_t stride, count;
  } cases[] = {
      {0.01, 1.0, 0.05, 0.0, 5, 21},     {0.01, 1.0, 0.0, 0.0, 1, 101}, /* about duration/100 */
      {0.3, 3.0, 0.0, 0.7, 1, 11},                                      /* at least one step */
      {0.001, 1.234, 0.0, 0.1, 12, 104}, /* 12.34 steps: the last 10 are a shorter interval */
      {0.1, 1.0, 0.3, 0.0, 3, 5},        {0.1, 0.7, 0.7, -3.3, 7, 2},
      {0.1, 0.7, 0.8, 0.0, 8, 2}, /* longer than the run */
  };
  owned_system *system = small_oscillator(1.0);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const double steps = round(cases[k].duration / cases[k].step);
    struct frames frames = {cases[k].start, cases[k].step, cases[k].stride, (int64_t)steps, 0};
    owned_run(integrator, state, system, .method = "symplectic-euler", .step = cases[k].step,
              .duration = cases[k].duration, .every = cases[k].every);
    hooke_state_set_time(state, cases[k].start);
    assert_int_equal(hooke_integrator_count(integrator, "frames"), cases[k].count);
    check_close(hooke_options_number(hooke_integrator_options(integrator), "every"),
                (double)cases[k].stride * cases[k].step, 1e-15);
    check_ok(hooke_integrator_on_frame(integrator, check_frame, &frames));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(frames.seen, cases[k].count);
    const double end = hooke_state_time(state), expected = cases[k].start + steps * cases[k].step;
    check_same_bits(1, &end, &expected);
    assert_int_equal(hooke_integrator_count(integrator, "steps"), (int64_t)steps);
  }
}

/* With error control frames are at whole multiples of `every`, and at the end, which is no second frame where
 * they come within 1e-9 of it. */
TEST(test_frames_of_adaptive_methods) {
  if (hooke_method_is_built("cvode-adams") != 1) skip();
  const struct {
    double duration, every;
    int64_t count;
    double before; /* time of the frame before the last */
  } cases[] = {
      {0.5, 0.06, 10, 0.48},
      {0.5, 0.0, 101, 0.495},
      {0.5, 0.05, 11, 0.45},
      {0.5, 0.5, 2, 0.0},
      {0.5, 2.0, 2, 0.0},
      {0.5, 0.05 * (1 + 5e-10), 11, 0.45},
      {0.5, 0.05 * (1 - 5e-10), 11, 0.45},
      {0.5, 0.05 * (1 + 1e-8), 11, 0.45},
      {0.5, 0.05 * (1 - 1e-8), 12, 0.5},
  };
  owned_system *system = small_oscillator(3.0);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    struct times times = {.now = -1.0};
    owned_run(integrator, state, system, .method = "cvode-adams", .duration = cases[k].duration,
              .every = cases[k].every);
    assert_int_equal(hooke_integrator_count(integrator, "frames"), cases[k].count);
    check_ok(hooke_integrator_on_frame(integrator, note_time, &times));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(times.seen, cases[k].count);
    check_close(times.before, cases[k].before, 1e-8);
    check_close(times.now, cases[k].duration, 1e-9);
  }
}

/* 6 times 0.7 is rounded to less than 4.2: methods that stop at frames go on to the end from there. */
TEST(test_a_last_frame_just_before_the_end) {
  const char *const methods[] = {"rk8pd", "arkode-esdirk"};
  owned_system *system = small_oscillator(3.0);
  for (int m = 0; m < 2; m++) {
    if (!hooke_method_is_built(methods[m])) continue;
    struct times times = {.now = -1.0};
    owned_run(integrator, state, system, .method = methods[m], .duration = 4.2, .every = 0.7);
    check_ok(hooke_integrator_on_frame(integrator, note_time, &times));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(times.seen, 7);
    assert_true(times.now == 6 * 0.7 && hooke_state_time(state) == 4.2);
  }
}

/* A million steps of 0.1: a running sum would have an error of 1e-6 s. */
TEST(test_time_does_not_drift) {
  struct frames frames = {0.3, 0.1, 1000, 1000000, 0};
  owned_system *system = small_oscillator(1.0);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.1, .duration = 100000.0,
            .every = 100.0);
  hooke_state_set_time(state, 0.3);
  check_ok(hooke_integrator_on_frame(integrator, check_frame, &frames));
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(frames.seen, 1001);
  assert_true(hooke_state_time(state) == 0.3 + 1e6 * 0.1);
}

static void refuse_run(struct run run, const char *culprit, const char *below, const char *above) {
  owned_system *system = small_oscillator(1.0);
  owned_options *options = run_options(run);
  hooke_integrator *integrator = NULL;
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_BAD_VALUE);
  assert_null(integrator);
  check_message(culprit);
  check_message(below);
  check_message(above);
}

TEST(test_steps_that_do_not_fit) {
  const char *method = "symplectic-euler";
  refuse_run((struct run){.method = method, .step = 0.3, .duration = 1.0}, "duration", "0.25",
             "0.3333333333333333");
  refuse_run((struct run){.method = method, .step = 0.1, .duration = 1.0, .every = 0.25}, "every",
             "0.083333333333333", "0.125");
  /* one of two directions has a step that fits, or none has */
  refuse_run((struct run){.method = method, .step = 0.7, .duration = 1.0, .every = 0.4}, "duration",
             "the nearest step that fits is 0.2", "s");
  refuse_run((struct run){.method = method, .step = 1.0 / 200103.5, .duration = 1.0, .every = 1.0 / 200003.0},
             "duration", "the nearest step that fits is 4.99992500112", "s");
  refuse_run((struct run){.method = method, .step = 0.3, .duration = 1.0, .every = 1e-6 / 3.0}, "duration",
             "no step near it fits", "s");
  refuse_run((struct run){.method = method, .duration = 1.0}, "step", "missing", "step");
  refuse_run((struct run){.method = "no-such-method", .step = 0.1}, "method", "no-such-method",
             "symplectic-euler");
  /* a multiple to 1e-9 relative is one */
  owned_system *system = small_oscillator(1.0);
  owned_integrator *integrator =
      start_with(system, .method = method, .step = 0.1, .duration = 1.0 + 5e-10, .every = 0.2);
  assert_int_equal(hooke_integrator_count(integrator, "frames"), 6);
  refuse_run((struct run){.method = method, .step = 0.1, .duration = 1.0 + 3e-9}, "duration", "0.1", "step");
}

TEST(test_run_needs_duration) {
  owned_system *system = small_oscillator(1.0);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.1);
  check_status(hooke_integrator_run(integrator, state), HOOKE_BAD_VALUE);
  check_message("duration");
  check_close(hooke_state_time(state), 0.0, 0.0);
}

/* ---- observers ---- */

struct watch {
  int64_t calls, last_step, stop_at;
  double last_time;
};

static int32_t count_steps(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  assert_true(step > watch->last_step);
  watch->calls++;
  watch->last_step = step;
  watch->last_time = hooke_state_time(state);
  return watch->stop_at > 0 && step >= watch->stop_at ? 7 : 0;
}

TEST(test_step_observer) {
  owned_system *system = small_oscillator(1.0);
  const int64_t strides[] = {1, 3, 10, 11};
  for (int k = 0; k < 4; k++) {
    struct watch watch = {0, 0, 0, 0.0};
    owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.1, .duration = 3.2,
              .every = 0.4);
    check_ok(hooke_integrator_on_step(integrator, strides[k], count_steps, &watch));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(watch.calls, 32 / strides[k]);
    assert_int_equal(watch.last_step, 32 / strides[k] * strides[k]);
    check_ok(hooke_integrator_on_step(integrator, 1, NULL, NULL)); /* removed */
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(watch.calls, 32 / strides[k]);
    check_status(hooke_integrator_on_step(integrator, 0, count_steps, &watch), HOOKE_BAD_VALUE);
    check_message("0");
  }
}

TEST(test_observers_stop) {
  owned_system *system = small_oscillator(1.0);
  for (int on_frame = 0; on_frame < 2; on_frame++) {
    struct watch watch = {0, -1, 8, 0.0};
    double q[6];
    owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.125, .duration = 10.0,
              .every = 0.5);
    if (on_frame)
      check_ok(hooke_integrator_on_frame(integrator, count_steps, &watch));
    else
      check_ok(hooke_integrator_on_step(integrator, 2, count_steps, &watch));
    check_status(hooke_integrator_run(integrator, state), HOOKE_STOPPED);
    assert_int_equal(hooke_integrator_count(integrator, "stop_value"), 7);
    assert_int_equal(watch.last_step, 8);
    check_close(hooke_state_time(state), 1.0, 0.0);
    end_of_run(q, NULL, system, .method = "symplectic-euler", .step = 0.125, .duration = 1.0);
    check_same_bits(6, hooke_state_position(state), q);
  }
}

/* An error-controlled method also reports its internal steps: every one of them, for any frames in between.
 */
TEST(test_step_observer_of_adaptive_methods) {
  if (hooke_method_is_built("cvode-adams") != 1) skip();
  owned_system *system = small_oscillator(3.0);
  struct watch watch = {0, 0, 0, 0.0};
  owned_run(integrator, state, system, .method = "cvode-adams", .duration = 2.0, .every = 0.1);
  check_ok(hooke_integrator_on_step(integrator, 1, count_steps, &watch));
  check_ok(hooke_integrator_run(integrator, state));
  const int64_t steps = hooke_integrator_count(integrator, "steps");
  check_between((double)steps, 50.0, 5000.0);
  /* the last step may go beyond the end */
  check_between((double)watch.calls, (double)(steps - 1), (double)steps);
}

/* Times and positions of the states at checkpoints. */
struct points {
  int count;
  double number[4][7];
};

static int32_t see_point(int64_t step, const hooke_state *state, void *ctx) {
  struct points *points = ctx;
  (void)step;
  assert_true(points->count < 4);
  double *to = points->number[points->count++];
  to[0] = hooke_state_time(state);
  memcpy(to + 1, hooke_state_position(state), 6 * sizeof *to);
  return 0;
}

/* Steps one by one come by the same checkpoints as a run, and start anew there. */
TEST(test_checkpoints_of_steps_by_hand) {
  owned_system *system = small_oscillator(10.0);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const struct run run = {.method = hooke_method_name(m), .duration = 1.0, .checkpoint = 0.3};
    if (!hooke_method_is_built(run.method) || !hooke_method_is_adaptive(run.method)) continue;
    owned_integrator *whole = start_run(system, run), *steps = start_run(system, run);
    owned_state *end = start_state(system), *state = start_state(system);
    struct points points = {.count = 0}, same = {.count = 0};
    check_ok(hooke_integrator_on_checkpoint(whole, see_point, &points));
    check_ok(hooke_integrator_on_checkpoint(steps, see_point, &same));
    check_ok(hooke_integrator_run(whole, end));
    while (hooke_state_time(state) < 1.0)
      check_ok(hooke_integrator_step(steps, state, 1));
    assert_int_equal(points.count, 3);
    check_same_bits(3 * 7, same.number[0], points.number[0]);
  }
}

TEST(test_step_limit) {
  if (hooke_method_is_built("cvode-adams") != 1) skip();
  owned_system *system = small_oscillator(3.0);
  owned_options *options = run_options((struct run){.method = "cvode-adams", .duration = 1000.0});
  owned_integrator *integrator = NULL;
  check_ok(hooke_options_set_number(options, "max_steps", 40));
  check_ok(hooke_integrator_create(system, options, &integrator));
  owned_state *state = start_state(system);
  check_status(hooke_integrator_run(integrator, state), HOOKE_STEP_LIMIT);
  check_message("40");
  check_between((double)hooke_integrator_count(integrator, "steps"), 40.0, 40.0);
  check_between(hooke_state_time(state), 1e-3, 100.0);
}

static int32_t decay(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)t, (void)ctx;
  rate[0] = -x[0];
  return 0;
}

/* The state that was reached is the last of those kept. */
TEST(test_step_limit_of_first_order) {
  if (hooke_method_is_built("cvode-adams") != 1) skip();
  owned_options *options = run_options((struct run){.method = "cvode-adams", .duration = 1000.0});
  owned_integrator *integrator = NULL;
  owned_state *state = NULL, *kept = NULL;
  check_ok(hooke_options_set_number(options, "max_steps", 20));
  check_ok(hooke_integrator_create_first_order(1, decay, NULL, options, &integrator));
  check_ok(hooke_state_create_first_order(1, &state));
  check_ok(hooke_state_create_first_order(1, &kept));
  hooke_state_position(state)[0] = 1.0;
  check_status(hooke_integrator_run(integrator, state), HOOKE_STEP_LIMIT);
  check_ok(hooke_integrator_recent(integrator, 0, kept));
  assert_true(hooke_state_time(kept) == hooke_state_time(state));
  check_close(hooke_state_position(kept)[0], exp(-hooke_state_time(kept)), 1e-5);
}

/* ---- stepping by hand ---- */

TEST(test_steps_by_hand) {
  owned_system *system = small_oscillator(2.0);
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    double q[6], v[6];
    owned_run(integrator, state, system, .method = method, .step = 0.0625);
    check_ok(hooke_integrator_step(integrator, state, 3));
    check_ok(hooke_integrator_step(integrator, state, 0));
    for (int k = 0; k < 13; k++)
      check_ok(hooke_integrator_step(integrator, state, 1));
    end_of_run(q, v, system, .method = method, .step = 0.0625, .duration = 1.0);
    check_close(hooke_state_time(state), 1.0, 0.0);
    check_same_bits(6, hooke_state_position(state), q);
    check_same_bits(6, hooke_state_velocity(state), v);
    /* a state that was changed in between is used as it is */
    hooke_state_position(state)[3] = 5.0;
    hooke_state_velocity(state)[3] = 0.0;
    check_ok(hooke_integrator_step(integrator, state, 1));
    check_close(hooke_state_position(state)[3], 5.0, 0.1);
    check_status(hooke_integrator_step(integrator, state, -1), HOOKE_BAD_VALUE);
  }
}

/* Such numbers are refused, and no sum of them overflows. */
TEST(test_too_many_steps) {
  owned_system *system = small_oscillator(1.0);
  const struct {
    double step, duration, every;
  } cases[] = {{1e-17, 10.0, 1.0}, {1e-300, 1.0, 1.0}, {1e-3, 1e14, 1e-3}, {1e-3, 1e300, 1e300}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    hooke_integrator *refused = NULL;
    owned_options *options = run_options((struct run){
        .method = "verlet", .step = cases[k].step, .duration = cases[k].duration, .every = cases[k].every});
    check_status(hooke_integrator_create(system, options, &refused), HOOKE_BAD_VALUE);
    check_message("takes too many steps");
    check_message("allowed: fewer than 9000000000000000");
  }
  if (hooke_method_is_built("cvode-adams"))
    refuse_run((struct run){.method = "cvode-adams", .duration = 1e17, .every = 1.0}, "every",
               "1 s gives 1e+17 frames", "up to 9e15");
  owned_run(integrator, state, system, .method = "verlet", .step = 1e-3, .duration = 1.0);
  check_ok(hooke_integrator_step(integrator, state, 3));
  const double t = hooke_state_time(state);
  check_status(hooke_integrator_step(integrator, state, INT64_MAX), HOOKE_BAD_VALUE);
  check_message("steps: 9223372036854775807 after 3 are too many");
  check_status(hooke_integrator_step(integrator, state, INT64_MAX - 2), HOOKE_BAD_VALUE);
  const double now = hooke_state_time(state);
  check_same_bits(1, &now, &t);
  check_ok(hooke_integrator_step(integrator, state, 3));
}

TEST(test_state_of_another_size) {
  owned_system *system = small_oscillator(2.0);
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(5, &state));
  owned_integrator *integrator =
      start_with(system, .method = "symplectic-euler", .step = 0.1, .duration = 1.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_step(integrator, state, 1), HOOKE_BAD_VALUE);
}

/* ---- energies ---- */

struct energies {
  const hooke_system *system;
  double start, low, high, last;
};

static int32_t follow_energy(int64_t step, const hooke_state *state, void *ctx) {
  struct energies *energies = ctx;
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  const double e =
      hooke_system_energy(energies->system, "total", hooke_state_position(seen), hooke_state_velocity(seen));
  if (step == 0) energies->start = energies->low = energies->high = e;
  energies->low = fmin(energies->low, e);
  energies->high = fmax(energies->high, e);
  energies->last = e;
  return 0;
}

static struct energies energies_of(const char *method, double omega, double h, double duration) {
  owned_system *system = small_oscillator(omega);
  struct energies energies = {.system = system};
  owned_run(integrator, state, system, .method = method, .step = h, .duration = duration, .every = h);
  check_ok(hooke_integrator_on_frame(integrator, follow_energy, &energies));
  check_ok(hooke_integrator_run(integrator, state));
  return energies;
}

/* Forward Euler multiplies the energy of an undamped oscillator by 1 + (omega h)^2 a step. Symplectic Euler
 * conserves E - h omega^2 m q.v / 2, so that E stays within about omega h / 2, relative, of its initial
 * value. */
TEST(test_energy) {
  const double omega = 5.0, h = 0.002, steps = 10000.0, share = omega * h / 2.0;
  const struct energies forward = energies_of("forward-euler", omega, h, h * 1000.0);
  const double growth = pow(1.0 + omega * omega * h * h, 1000.0);
  check_between(forward.last / forward.start / growth, 1.0 - 1e-11, 1.0 + 1e-11);
  assert_true(forward.high == forward.last && forward.low == forward.start);

  const struct energies symplectic = energies_of("symplectic-euler", omega, h, h * steps);
  check_between(symplectic.high / symplectic.start, 1.0 + 0.3 * share, 1.0 + 2.1 * share);
  check_between(symplectic.low / symplectic.start, 1.0 - 2.1 * share, 1.0 - 0.3 * share);
  if (hooke_method_is_built("cvode-adams") != 1) return;
  const struct energies adams = energies_of("cvode-adams", omega, h, h * steps);
  assert_true(adams.high - adams.low < 0.1 * (symplectic.high - symplectic.low));
}

/* ---- counts ---- */

TEST(test_counts) {
  owned_system *system = small_oscillator(2.0);
  const char *names[] = {"steps",
                         "force_evaluations",
                         "derivative_products",
                         "nonlinear_iterations",
                         "nonlinear_failures",
                         "linear_iterations",
                         "error_test_failures",
                         "coincident_springs"};
  for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
    owned_run(integrator, state, system, .method = method, .step = 0.01, .duration = 1.0);
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
      assert_int_equal(hooke_integrator_count(integrator, names[k]), 0);
    }
    assert_true(isnan(hooke_integrator_number(integrator, "diverged_at")));
    check_ok(hooke_integrator_run(integrator, state));
    const int64_t steps = hooke_integrator_count(integrator, "steps");
    const int64_t forces = hooke_integrator_count(integrator, "force_evaluations");
    if (is_fixed_step(method)) {
      assert_int_equal(steps, 100);
      if (strcmp(method, "forward-euler") == 0 || strcmp(method, "symplectic-euler") == 0)
        assert_int_equal(forces, 100);
      else if (strcmp(method, "verlet") == 0)
        assert_int_equal(forces, 101); /* without damping the last force is the first one of the next step */
      else if (strcmp(method, "rk4") == 0)
        assert_int_equal(forces, 400);
      else
        assert_in_range(forces, 101, 1000);
    } else {
      assert_true(steps > 10 && forces >= steps && forces < 100 * steps);
    }
    if (strcmp(method, "cvode-bdf") == 0 || is_implicit(method)) {
      assert_true(hooke_integrator_count(integrator, "derivative_products") > 0);
      assert_true(hooke_integrator_count(integrator, "linear_iterations") > 0);
      assert_true(hooke_integrator_count(integrator, "nonlinear_iterations") > 0);
    }
    check_between((double)hooke_integrator_count(integrator, "memory_bytes"), 8.0 * 6.0 * 3.0, 1e6);
    assert_int_equal(hooke_integrator_count(integrator, "apples"), -1);
    check_between(hooke_integrator_number(integrator, "wall_seconds"), 1e-9, 60.0);
    assert_true(isnan(hooke_integrator_number(integrator, "diverged_at")));
    assert_int_equal(hooke_integrator_count(integrator, "stop_value"), 0);
    /* counts accumulate over the integrator's life */
    check_ok(hooke_integrator_run(integrator, state));
    assert_true(hooke_integrator_count(integrator, "steps") > steps);
  }
}
