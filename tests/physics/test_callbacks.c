/* Force callbacks: their derivative, their stop value, and their place in the sum. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* ---- a linear force, whose derivative is known: difference quotients must match it ---- */

struct linear {
  int64_t force_calls, product_calls;
  int32_t coordinates; /* 1: numbers come one by one, not as particles */
};

static int32_t linear_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct linear *linear = ctx;
  (void)t;
  const int64_t numbers = linear->coordinates ? n : 3 * n;
  linear->force_calls++;
  for (int64_t k = 0; k < numbers; k++)
    force[k] += -7.0 * q[(k + 1) % numbers] - 0.3 * v[k];
  return 0;
}

static int32_t linear_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                              const double *dv, double *out, void *ctx) {
  struct linear *linear = ctx;
  (void)q;
  (void)v;
  linear->product_calls++;
  return linear_force(n, t, dq, dv, out, ctx);
}

TEST(test_difference_quotients) {
  const double q[] = {1, -2, 3, 100, 0.5, -40}, v[] = {0, 1, 0, -3, 0, 5}, dq[] = {1, 2, -1, 0.5, 0, 3},
               dv[] = {0.25, 0, -4, 1, 1, 1};
  for (int with = 0; with < 2; with++) {
    struct linear linear = {0, 0, 0};
    double out[6], expected[6] = {0};
    owned_system *system = small_system(2, q, v, 1.0, 0);
    check_ok(hooke_system_set_force(system, linear_force, with ? linear_product : NULL, &linear));
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_derivative_product(system, 0.0, q, v, dq, dv, out));
    assert_int_equal(linear.product_calls, with);
    assert_true(linear.force_calls >= 1);
    linear_force(2, 0.0, dq, dv, expected, &linear);
    check_between(largest_difference(6, out, expected) / largest(6, expected), 0.0, with ? 1e-15 : 1e-7);
  }
}

/* ---- the derivative in steps, of every kind of unknowns, with unequal masses ---- */

enum { LINEAR = 6, STATE = 6 * LINEAR };

static hooke_system *linear_system(const char *kind, hooke_force_product *product, struct linear *linear) {
  const double q[3 * LINEAR] = {1, -2, 3, 1, 0.5, -4, 0, 0, 2, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                     mass[] = {0.5, 2.0, 1.0, 0.7, 1.3, 0.4};
  const int64_t pinned = 0, body[] = {3, 4, 5};
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, LINEAR, q, NULL, LINEAR, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &pinned));
  if (strcmp(kind, "overdamped") == 0) check_ok(hooke_system_set_dynamics(system, kind));
  if (strcmp(kind, "overdamped") == 0) check_ok(hooke_system_set_drag(system, 5.0));
  if (strcmp(kind, "bodies") == 0) check_ok(hooke_system_add_body(system, NULL, 3, body, 0));
  check_ok(hooke_system_set_force(system, linear_force, product, linear));
  return committed(system);
}

/* The state after a few steps; the number of products is returned. */
static int64_t solve(const char *kind, int with, struct run run, double end[STATE]) {
  const double place[] = {1, -2, 0.5, 3, 2, -1, 0}, weight[] = {0.3, 2.0, 0.7, 1.1, 0.2, 5.0, 1.0};
  struct linear linear = {.coordinates = strcmp(kind, "coordinates") == 0};
  hooke_force_product *product = with ? linear_product : NULL;
  owned_system *system = linear.coordinates ? NULL : linear_system(kind, product, &linear);
  owned_integrator *it = NULL;
  owned_state *state = NULL;
  owned_options *options = run_options(run);
  if (system) {
    check_ok(hooke_integrator_create(system, options, &it));
    state = start_state(system);
  } else {
    check_ok(
        hooke_integrator_create_second_order(7, linear_force, product, &linear, 7, weight, options, &it));
    check_ok(hooke_state_create_second_order(7, &state));
    memcpy(hooke_state_position(state), place, sizeof place);
  }
  const size_t size = (size_t)hooke_state_size(state);
  check_ok(hooke_integrator_run(it, state));
  memset(end, 0, STATE * sizeof *end);
  memcpy(end, hooke_state_position(state), size * sizeof *end);
  memcpy(end + size, hooke_state_velocity(state), size * sizeof *end);
  return linear.product_calls;
}

/* The force is linear, so but for turning bodies one iteration solves a step, with the derivative that is
 * given and with difference quotients. */
TEST(test_derivative_in_steps) {
  static const char *const kinds[] = {"second-order", "bodies", "overdamped", "coordinates"};
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    int64_t products = 0;
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (!hooke_method_is_built(method) || hooke_method_is_suited(method, k == 3 ? kinds[0] : kinds[k]) != 1)
        continue;
      for (int once = 0; once <= is_implicit(method); once++) {
        const struct run run = {.method = method,
                                .step = is_fixed_step(method) ? 0.05 : 0.0,
                                .duration = 0.25,
                                .rtol = is_fixed_step(method) ? 0.0 : 1e-10,
                                .atol = is_fixed_step(method) ? 0.0 : 1e-11,
                                .newton = once ? "one-iteration" : NULL};
        double with[STATE], without[STATE], converged[STATE];
        products += solve(kinds[k], 1, run, with);
        solve(kinds[k], 0, run, without);
        solve(kinds[k], 1,
              (struct run){
                  .method = method, .step = run.step, .duration = 0.25, .rtol = run.rtol, .atol = run.atol},
              converged);
        const double *other[] = {without, strcmp(kinds[k], "bodies") == 0 ? with : converged};
        for (int o = 0; o < 2; o++)
          if (!(largest_difference(STATE, with, other[o]) <= (is_fixed_step(method) ? 1e-7 : 1e-5)))
            check_failed("%s, %s, %s: %g apart %s", kinds[k], method, once ? "one iteration" : "converged",
                         largest_difference(STATE, with, other[o]),
                         o ? "once solved" : "without a derivative");
      }
    }
    assert_true(products > 10);
  }
}

/* ---- order of summation, and arguments of a callback ---- */

struct shown {
  int64_t calls;
  double t, q[6], v[6], force[6];
};

static int32_t look(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct shown *shown = ctx;
  assert_int_equal(n, 2);
  shown->calls++;
  shown->t = t;
  memcpy(shown->q, q, sizeof shown->q);
  memcpy(shown->v, v, sizeof shown->v);
  memcpy(shown->force, force, sizeof shown->force);
  force[4] += 1.0;
  return 0;
}

TEST(test_what_a_callback_sees) {
  const double q[] = {0, 0, 0, 2, 0, 0}, v[] = {0, 1, 0, 0, 0, 3}, gravity[] = {0, 0, -10};
  const int64_t ends[] = {0, 1};
  struct shown shown = {0};
  double a[6];
  owned_system *system = small_system(2, q, v, 2.0, 0);
  springs_with(system, 1, ends, .law = "length", .stiffness = 4, .rest_length = 1);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 0.5));
  check_ok(hooke_system_set_force(system, look, NULL, &shown));
  check_ok(hooke_system_commit(system));
  check_ok(hooke_system_acceleration(system, 0.75, q, v, a));
  assert_int_equal(shown.calls, 1);
  check_close(shown.t, 0.75, 0.0);
  check_same_bits(6, shown.q, q);
  check_same_bits(6, shown.v, v);
  /* springs and drag are in, gravity is not */
  const double before[] = {4, -0.5, 0, -4, 0, -1.5}, after[] = {2, -0.25, -10, -2, 0.5, -10.75};
  check_same_bits(6, shown.force, before);
  check_same_bits(6, a, after);
}

/* ---- a force for some runs, and what it holds ---- */

enum { FAR = 600, HELD = 3 };

struct holder {
  int64_t calls;
  const double *q[HELD];
  double copy[HELD][9 * FAR];
};

/* Pulls at the last particle; holds its first arrays, and keeps a copy of them. */
static int32_t pull_and_hold(int64_t n, double t, const double *q, const double *v, double *force,
                             void *ctx) {
  struct holder *holder = ctx;
  force[3 * n - 1] -= 0.5 + t + q[0] + 0.1 * v[3 * n - 1];
  if (holder->calls < HELD) {
    assert_int_equal(hooke_rows_hold(q, 1), 2);
    holder->q[holder->calls] = q;
    memcpy(holder->copy[holder->calls], q, (size_t)(9 * n) * sizeof *q);
  }
  holder->calls++;
  return 0;
}

/* A spring beside so many pinned particles that steps leave some out, unless a callback reads them. */
static hooke_system *spring_and_pins(hooke_force *force, void *ctx) {
  static double q[3 * FAR];
  const int64_t ends[] = {FAR - 2, FAR - 1};
  for (int64_t p = 0; p < FAR; p++)
    q[3 * p] = (double)p;
  int64_t pinned[FAR - 1];
  for (int64_t p = 0; p < FAR - 1; p++)
    pinned[p] = p;
  hooke_system *system = small_system(FAR, q, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, FAR - 1, pinned));
  springs_with(system, 1, ends, .stiffness = 30, .rest_length = 0.8);
  if (force) check_ok(hooke_system_set_force(system, force, NULL, ctx));
  return committed(system);
}

/* Ends a run of some method, and gives its memory back. */
static void go(const hooke_system *system, const char *method, double end[6]) {
  owned_run(integrator, state, system, .method = method, .step = 0.01, .duration = 0.2);
  check_ok(hooke_integrator_run(integrator, state));
  memcpy(end, hooke_state_position(state) + 3 * (FAR - 1), 3 * sizeof *end);
  memcpy(end + 3, hooke_state_velocity(state) + 3 * (FAR - 1), 3 * sizeof *end);
}

TEST(test_a_force_for_some_runs) {
  static const char *const methods[] = {"rk4", "verlet", "backward-euler", "cvode-adams"};
  static struct holder own, lent;
  hooke_system *plain = spring_and_pins(NULL, NULL), *forced = spring_and_pins(pull_and_hold, &own), *with;
  own.calls = lent.calls = HELD;
  check_ok(hooke_system_with_force(plain, pull_and_hold, NULL, &lent, &with));
  assert_int_equal(hooke_system_count(with, "idle"), 0);
  assert_true(hooke_system_count(plain, "idle") > 256);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    double expected[6], found[6], before[6], after[6];
    if (!hooke_method_is_built(methods[k])) continue;
    go(plain, methods[k], before);
    go(forced, methods[k], expected);
    go(with, methods[k], found);
    go(plain, methods[k], after);
    check_same_bits(6, found, expected);
    check_same_bits(6, after, before);
    assert_true(fabs(found[2]) > 1e-3 && before[2] == 0.0);
  }
  assert_int_equal(own.calls, lent.calls);
  hooke_system_destroy(with);
  hooke_system_destroy(forced);
  check_ok(hooke_system_with_force(plain, NULL, NULL, NULL, &with));
  assert_int_equal(hooke_system_count(with, "idle"), hooke_system_count(plain, "idle"));
  hooke_system_destroy(with);
  hooke_system_destroy(plain);
  plain = new_system();
  check_status(hooke_system_with_force(plain, NULL, NULL, NULL, &with), HOOKE_BAD_CALL);
  hooke_system_destroy(plain);
}

/* The arrays of a call outlast the run, with the numbers of the call; implicit methods take difference
 * quotients. */
TEST(test_what_a_callback_holds) {
  static const char *const methods[] = {"rk4", "backward-euler"};
  for (int k = 0; k < 2; k++) {
    static struct holder holder, other;
    double end[6], expected[6];
    holder.calls = 0;
    other.calls = HELD;
    owned_system *system = spring_and_pins(pull_and_hold, &holder),
                 *same = spring_and_pins(pull_and_hold, &other);
    go(system, methods[k], end);
    go(same, methods[k], expected);
    check_same_bits(6, end, expected);
    for (int c = 0; c < HELD; c++) {
      check_same_bits(9 * FAR, holder.q[c], holder.copy[c]);
      for (int other_call = 0; other_call < c; other_call++)
        assert_true(holder.q[c] != holder.q[other_call]);
    }
    for (int c = 0; c < HELD; c++)
      assert_int_equal(hooke_rows_hold(holder.q[c], -1), 0);
  }
}

/* ---- a callback that stops ---- */

enum { POINTS = 6, WHOLE = 3, MOST_NUMBERS = 6 * POINTS };

/* Calls of force, derivative, drive and rate alike; the one numbered `stop` stops. */
struct stopper {
  int64_t calls, stop, steps;
  hooke_force_product *product;          /* NULL: difference quotients */
  double whole[WHOLE + 1][MOST_NUMBERS]; /* states by step */
};

static int32_t count_call(void *ctx) {
  struct stopper *stopper = ctx;
  return ++stopper->calls == stopper->stop ? 77 : 0;
}

static int32_t pull_back(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)v;
  for (int64_t k = 0; k < (n == 1 ? 1 : 3 * n); k++) /* one coordinate, or particles */
    force[k] -= 10.0 * q[k] + t;
  return count_call(ctx);
}

static int32_t pull_back_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                                 const double *dv, double *out, void *ctx) {
  (void)t, (void)q, (void)v, (void)dv;
  for (int64_t k = 0; k < (n == 1 ? 1 : 3 * n); k++)
    out[k] -= 10.0 * dq[k];
  return count_call(ctx);
}

static int32_t wander(int64_t count, double t, double *q, double *v, void *ctx) {
  assert_int_equal(count, 1);
  for (int a = 0; a < 3; a++) {
    q[a] = a + t * t;
    v[a] = 2.0 * t;
  }
  return count_call(ctx);
}

static int32_t decay(int64_t n, double t, const double *x, double *rate, void *ctx) {
  for (int64_t k = 0; k < n; k++)
    rate[k] = t - 3.0 * x[k];
  return count_call(ctx);
}

/* A driven particle, two on springs, and three that may be one body. */
static hooke_system *pulled_system(const char *problem, struct stopper *stopper) {
  const double q[3 * POINTS] = {0, 1, 2, 1, 0, 0, 2, 0.5, 0, 3, 0, 0, 3, 1, 0, 4, 0, 1},
                     gravity[] = {0, -1, 0};
  const int64_t ends[] = {0, 1, 1, 2, 2, 3}, driven = 0, body[] = {3, 4, 5};
  const int overdamped = strcmp(problem, "overdamped") == 0;
  hooke_system *system = small_system(POINTS, q, NULL, 1.0, 0);
  springs_with(system, 3, ends, .stiffness = 4, .damping = overdamped ? 0.0 : 0.3, .rest_length = 1);
  if (overdamped) check_ok(hooke_system_set_dynamics(system, problem));
  if (overdamped) check_ok(hooke_system_set_drag(system, 5.0));
  if (strcmp(problem, "bodies") == 0) check_ok(hooke_system_add_body(system, "plate", 3, body, 0));
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_drive_callback(system, 1, &driven, wander, stopper));
  check_ok(hooke_system_set_force(system, pull_back, stopper->product, stopper));
  return committed(system);
}

/* At the start of a problem; the system is NULL for coordinates and x' = phi(t, x). */
static void start_pulled(const char *problem, const char *method, hooke_system **system,
                         hooke_integrator **it, hooke_state **state, struct stopper *stopper) {
  const struct run run = {.method = method, .step = 0.0625, .duration = 20.0};
  owned_options *options = run_options(run);
  const double one = 1.0, weight = 0.5;
  *system = NULL;
  stopper->calls = -1000; /* beginning calls, too */
  if (strcmp(problem, "coordinates") == 0) {
    check_ok(hooke_integrator_create_second_order(1, pull_back, stopper->product, stopper, 1, &weight,
                                                  options, it));
    check_ok(hooke_state_create_second_order(1, state));
  } else if (strcmp(problem, "first-order") == 0) {
    *it = start_first_order(1, decay, stopper, run);
    check_ok(hooke_state_create_first_order(1, state));
  } else {
    *system = pulled_system(problem, stopper);
    *it = start_run(*system, run);
    *state = start_state(*system);
  }
  if (*system == NULL) hooke_state_position(*state)[0] = one;
  if (is_fixed_step(method)) check_ok(hooke_integrator_step(*it, *state, 0));
  stopper->calls = stopper->steps = 0;
}

static void state_numbers(const hooke_state *state, double numbers[MOST_NUMBERS]) {
  const int64_t size = hooke_state_size(state);
  const double *v = hooke_state_velocity(state);
  memset(numbers, 0, MOST_NUMBERS * sizeof *numbers);
  memcpy(numbers, hooke_state_position(state), (size_t)size * sizeof *numbers);
  if (v != NULL) memcpy(numbers + size, v, (size_t)size * sizeof *numbers);
}

static int32_t note_state(int64_t step, const hooke_state *state, void *ctx) {
  struct stopper *stopper = ctx;
  stopper->steps = step;
  if (stopper->stop < 0) state_numbers(state, stopper->whole[step]);
  return 0;
}

/* A call stops steps on their way: the state is that of the last whole one, to the bit, and so is the end
 * of those that go on from there. */
static void check_stop(const char *problem, const char *method, struct stopper *stopper) {
  double found[MOST_NUMBERS];
  owned_system *system;
  owned_integrator *it;
  owned_state *state;
  start_pulled(problem, method, &system, &it, &state, stopper);
  check_ok(hooke_integrator_on_step(it, 1, note_state, stopper));
  check_status(hooke_integrator_step(it, state, WHOLE), stopper->stop < 0 ? HOOKE_OK : HOOKE_STOPPED);
  if (stopper->stop > 0) {
    check_message("77");
    assert_int_equal(hooke_integrator_count(it, "stop_value"), 77);
    check_close(hooke_state_time(state), 0.0625 * (double)stopper->steps, 0.0);
    state_numbers(state, found);
    check_same_bits(MOST_NUMBERS, found, stopper->whole[stopper->steps]);
    check_ok(hooke_integrator_step(it, state, WHOLE - stopper->steps));
    state_numbers(state, found);
    check_same_bits(MOST_NUMBERS, found, stopper->whole[WHOLE]);
  }
}

/* The same of an error-controlled method: the driven particle is where it is at that time. */
static void check_adaptive_stop(const char *problem, const char *method, struct stopper *stopper) {
  double q[3], v[3];
  owned_system *system;
  owned_integrator *it;
  owned_state *state;
  start_pulled(problem, method, &system, &it, &state, stopper);
  check_status(hooke_integrator_run(it, state), HOOKE_STOPPED);
  check_message("77");
  assert_int_equal(hooke_integrator_count(it, "stop_value"), 77);
  wander(1, hooke_state_time(state), q, v, stopper);
  if (system) check_same_bits(3, hooke_state_position(state), q);
}

static void check_stops(const char *problem, const char *method, hooke_force_product *product) {
  struct stopper stopper = {.stop = -1, .product = product};
  owned_system *system;
  owned_integrator *it = NULL;
  owned_state *state;
  start_pulled(problem, method, &system, &it, &state, &stopper);
  state_numbers(state, stopper.whole[0]);
  if (is_fixed_step(method)) check_stop(problem, method, &stopper);
  const int64_t calls = is_fixed_step(method) ? stopper.calls : 40;
  assert_true(calls >= WHOLE);
  for (stopper.stop = 1; stopper.stop <= calls; stopper.stop++)
    (is_fixed_step(method) ? check_stop : check_adaptive_stop)(problem, method, &stopper);
}

/* In a step, a residual or a derivative, of every method and every kind of unknowns. */
TEST(test_every_call_may_stop) {
  static const char *const problems[] = {"second-order", "bodies", "overdamped", "first-order",
                                         "coordinates"};
  for (size_t k = 0; k < sizeof problems / sizeof problems[0]; k++) {
    const char *kind = strcmp(problems[k], "coordinates") == 0 ? "second-order" : problems[k];
    for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
      if (hooke_method_is_suited(method, kind) != 1) continue;
      check_stops(problems[k], method, NULL);
      if (is_implicit(method)) check_stops(problems[k], method, pull_back_product);
    }
  }
}

TEST(test_a_force_alone_stops) {
  const double q[] = {0, 0, 0};
  struct stopper stopper = {.stop = 1};
  double force[3];
  owned_system *system = small_system(1, q, NULL, 1.0, 0);
  check_ok(hooke_system_set_force(system, pull_back, NULL, &stopper));
  check_ok(hooke_system_commit(system));
  check_status(hooke_system_force(system, 0.0, q, q, force), HOOKE_STOPPED);
  check_message("77");
}
