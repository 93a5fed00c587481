/* A run stopped by its progress callback between steps has the state of a whole step; continued, it ends in
 * the bits and counts of a run without a callback. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const char *const counts[] = {"steps", "force_evaluations", "derivative_products",
                                     "nonlinear_iterations", "linear_iterations"};
enum { COUNTS = sizeof counts / sizeof counts[0], SIDE = 16, MOST_NUMBERS = 6 * SIDE * SIDE };

struct listener {
  const char *method;
  int64_t calls, stop_at; /* 0: never */
  double done;
};

static int32_t listen(double done, const char *what, void *ctx) {
  struct listener *listener = ctx;
  check_between(done, listener->done, 1.0);
  listener->done = done;
  assert_string_equal(what, listener->method);
  return ++listener->calls == listener->stop_at ? 42 : 0;
}

struct end {
  double t, numbers[MOST_NUMBERS];
  int64_t count[COUNTS];
};

static void keep(const hooke_integrator *integrator, const hooke_state *state, struct end *end) {
  const int64_t size = hooke_state_size(state);
  end->t = hooke_state_time(state);
  memcpy(end->numbers, hooke_state_position(state), (size_t)size * sizeof(double));
  memcpy(end->numbers + size, hooke_state_velocity(state), (size_t)size * sizeof(double));
  for (int k = 0; k < COUNTS; k++)
    end->count[k] = hooke_integrator_count(integrator, counts[k]);
}

/* Stopped repeatedly, each time after more calls. */
static void run_by_pieces(const hooke_system *system, struct run run, struct end *end, int64_t *stops) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  struct listener listener = {.method = run.method, .stop_at = 1};
  check_ok(hooke_integrator_on_progress(integrator, 0.0, listen, &listener));
  int32_t status = hooke_integrator_run(integrator, state);
  for (*stops = 0; status == HOOKE_STOPPED; (*stops)++) {
    assert_int_equal(hooke_integrator_count(integrator, "stop_value"), 42);
    check_close(hooke_state_time(state) / run.step, round(hooke_state_time(state) / run.step), 1e-6);
    listener = (struct listener){.method = run.method, .stop_at = INT64_C(2) << *stops};
    status = hooke_integrator_resume(integrator, state);
  }
  check_status(status, HOOKE_OK);
  keep(integrator, state, end);
}

static void run_alone(const hooke_system *system, struct run run, struct end *end) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  keep(integrator, state, end);
}

/* A solve of the cloth takes many products: stops occur within steps, too. */
TEST(test_a_stopped_run_goes_on) {
  static struct end whole, pieces;
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    const int implicit = is_implicit(method);
    owned_system *system = implicit ? small_crumpling_cloth(SIDE) : small_oscillator(1.0);
    const double step = implicit ? 0.02 : 1e-3;
    const struct run run = {.method = method, .step = step, .duration = 8.0 * step, .every = 4.0 * step};
    int64_t stops;
    run_alone(system, run, &whole);
    run_by_pieces(system, run, &pieces, &stops);
    assert_true(stops > 0);
    check_same_bits(1, &pieces.t, &whole.t);
    check_same_bits(6 * hooke_system_particle_count(system), pieces.numbers, whole.numbers);
    for (int c = 0; c < COUNTS; c++)
      if (c == 0 || implicit) assert_int_equal(pieces.count[c], whole.count[c]);
  }
}

/* Between frames, in steps by hand, and with error control. */
TEST(test_every_method_is_heard) {
  owned_system *system = small_oscillator(1.0);
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    struct listener listener = {.method = hooke_method_name(k), .stop_at = 3};
    if (!hooke_method_is_built(listener.method)) continue;
    const double duration = 1e9;
    owned_run(integrator, state, system, .method = listener.method, .step = 0.01, .duration = duration,
              .every = duration);
    check_ok(hooke_integrator_on_progress(integrator, 0.0, listen, &listener));
    check_status(hooke_integrator_run(integrator, state), HOOKE_STOPPED);
    check_message("the progress callback asked to stop at t = ");
    check_between(hooke_state_time(state), 1e-12, 0.01 * duration);
    listener = (struct listener){.method = listener.method, .stop_at = 3};
    check_status(hooke_integrator_step(integrator, state, INT64_C(1000000000000)), HOOKE_STOPPED);
    assert_int_equal(listener.calls, 3);
    check_ok(hooke_integrator_on_progress(integrator, 0.0, NULL, NULL));
    check_ok(hooke_integrator_step(integrator, state, 3));
    assert_int_equal(listener.calls, 3);
  }
}

TEST(test_seconds) {
  owned_system *system = small_oscillator(1.0);
  struct listener listener = {.method = "verlet"};
  owned_integrator *integrator = start_with(system, .method = "verlet", .step = 1e-3, .duration = 10.0);
  hooke_state *state = start_state(system);
  check_status(hooke_integrator_on_progress(integrator, -1.0, listen, &listener), HOOKE_BAD_VALUE);
  check_message("seconds");
  check_status(hooke_integrator_on_progress(integrator, (double)NAN, listen, &listener), HOOKE_BAD_VALUE);
  check_ok(hooke_integrator_on_progress(integrator, 1e9, listen, &listener));
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(listener.calls, 0);
  check_ok(hooke_integrator_on_progress(integrator, 0.0, listen, &listener));
  hooke_state_destroy(state);
  state = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  check_between((double)listener.calls, 1.0, 10000.0);
  hooke_state_destroy(state);
}
