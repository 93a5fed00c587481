/* Costs of ingredients: the list, limits and memory without them; times as far as they are reproducible. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>

static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)v, (void)ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] -= 0.1 * q[k];
  return 0;
}

/* Two unit masses on springs of frequencies 10 and 4 to pins, apart from each other, and a spring that does
 * nothing. */
static hooke_system *open_oscillators(double damping, double drag, int gravity, int callback) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 0, 5, 0, 1, 5, 0}, down[] = {0, 0, -9.81};
  static const int64_t pinned[] = {0, 2}, stiff[] = {0, 1}, soft[] = {2, 3}, zero[] = {1, 3};
  hooke_system *system = small_system(4, q, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, 2, pinned));
  owned_options *options = options_with("springs", "stiffness=100 damping=%.17g", damping);
  check_ok(hooke_system_add_springs(system, "stiff", 1, stiff, options));
  set_options(options, "damping=0 stiffness=0");
  check_ok(hooke_system_add_springs(system, "zero", 1, zero, options));
  check_ok(hooke_options_set_number(options, "stiffness", 16.0));
  check_ok(hooke_system_add_springs(system, NULL, 1, soft, options));
  check_ok(hooke_system_set_drag(system, drag));
  if (gravity) check_ok(hooke_system_set_gravity(system, down));
  if (callback) check_ok(hooke_system_set_force(system, pull, NULL, NULL));
  return system;
}

static hooke_system *two_oscillators(double damping, double drag, int gravity, int callback) {
  hooke_system *system = open_oscillators(damping, drag, gravity, callback);
  return committed(system);
}

static hooke_measurement *cost_within(double budget, const hooke_system *system, struct run run,
                                      int predict) {
  hooke_options *given = run_options(run), *options;
  hooke_measurement *cost;
  options = options_with("cost", "predict=%d budget=%.17g", predict, budget);
  check_ok(hooke_measurement_create("cost", system, given, options, &cost));
  hooke_options_destroy(given);
  hooke_options_destroy(options);
  owned_state *state = start_state(system);
  check_ok(hooke_measurement_run(cost, state));
  return cost;
}

static hooke_measurement *cost_of(const hooke_system *system, struct run run, int predict) {
  return cost_within(0.3, system, run, predict);
}

/* On a busy machine the budget may be spent before the last row. */
static hooke_measurement *cost_of_all_rows(const hooke_system *system, struct run run) {
  for (double budget = 0.3;; budget *= 4.0) {
    hooke_measurement *cost = cost_within(budget, system, run, 0);
    const int64_t last = hooke_measurement_row_count(cost, "rows") - 1;
    if (budget > 10.0 || !isnan(hooke_measurement_number(cost, "rows", last, "nanoseconds"))) return cost;
    hooke_measurement_destroy(cost);
  }
}

TEST(rows_are_what_is_there) {
  static const char *const kinds[] = {"springs", "springs",  "bending", "damping",
                                      "drag",    "callback", "gravity"};
  static const char *const names[] = {"stiff", "", "curl", "damping", "drag", "callback", "gravity"};
  static const int64_t triples[] = {0, 1, 3, 1, 2, 3};
  static const double coefficient[] = {2.0, 0.0};
  hooke_system *system = open_oscillators(1.0, 0.5, 1, 1);
  check_ok(hooke_system_add_bending(system, "none", 1, triples, 1, coefficient + 1));
  check_ok(hooke_system_add_bending(system, "curl", 2, triples, 2, coefficient));
  check_ok(hooke_system_commit(system));
  hooke_measurement *cost = cost_of(system, (struct run){.step = 1e-3}, 1);
  assert_int_equal(hooke_measurement_row_count(cost, "rows"), 7);
  for (int64_t k = 0; k < 7; k++) {
    assert_string_equal(hooke_measurement_text(cost, "rows", k, "kind"), kinds[k]);
    assert_string_equal(hooke_measurement_text(cost, "rows", k, "ingredient"), names[k]);
    assert_true(isnan(hooke_measurement_number(cost, "rows", k, "nanoseconds")));
    check_between(hooke_measurement_number(cost, "rows", k, "memory_bytes"), 0.0, 1e4);
  }
  check_close(hooke_measurement_number(cost, "rows", 1, "group"), 2.0, 0.0);
  check_close(hooke_measurement_number(cost, "rows", 1, "springs"), 1.0, 0.0);
  check_close(hooke_measurement_number(cost, "rows", 2, "group"), 1.0, 0.0);
  assert_true(isnan(hooke_measurement_number(cost, "rows", 2, "springs")));
  assert_true(isnan(hooke_measurement_number(cost, "rows", 3, "group")) &&
              isnan(hooke_measurement_number(cost, "rows", 3, "springs")));
  assert_null(hooke_measurement_text(cost, "rows", 7, "kind"));
  assert_null(hooke_measurement_text(cost, "rows", 0, "colour"));
  if (!isnan(hooke_measurement_number(cost, "cost", 0, "step_limit"))) {
    check_between(hooke_measurement_number(cost, "rows", 2, "step_limit_without") -
                      hooke_measurement_number(cost, "cost", 0, "step_limit"),
                  1e-6, 1.0);
  }
  assert_true(isnan(hooke_measurement_number(cost, "rows", -1, "group")) &&
              isnan(hooke_measurement_number(cost, "rows", 0, "colour")));
  /* a callback has its particles in rows: q, v and force */
  check_close(hooke_measurement_number(cost, "rows", 5, "memory_bytes"), 9.0 * 4.0 * 8.0, 0.0);
  hooke_measurement_destroy(cost);
  hooke_system_destroy(system);

  system = two_oscillators(0.0, 0.0, 0, 0);
  cost = cost_of(system, (struct run){.step = 1e-3}, 1);
  assert_int_equal(hooke_measurement_row_count(cost, "rows"), 2);
  hooke_measurement_destroy(cost);
  hooke_system_destroy(system);
}

/* One mode each: h omega = 2 (sqrt(1 + z^2) - z) for symplectic Euler, 2 without damping. */
TEST(limits_are_those_without) {
  const double z = 0.25;
  hooke_system *system = two_oscillators(2.0 * z * 10.0, 0.0, 1, 0);
  hooke_measurement *cost = cost_of(system, (struct run){.step = 1e-3}, 1);
  assert_string_equal(hooke_measurement_text(cost, "cost", 0, "method"), "symplectic-euler");
  if (isnan(hooke_measurement_number(cost, "cost", 0, "step_limit"))) {
    hooke_measurement_destroy(cost);
    hooke_system_destroy(system);
    skip();
  }
  const double damped = 2.0 * (sqrt(1.0 + z * z) - z) / 10.0;
  check_close(hooke_measurement_number(cost, "cost", 0, "step_limit"), damped, 1e-3 * damped);
  check_close(hooke_measurement_number(cost, "rows", 0, "step_limit_without"), 0.5, 1e-3);
  check_close(hooke_measurement_number(cost, "rows", 1, "step_limit_without"), damped, 1e-3 * damped);
  check_close(hooke_measurement_number(cost, "rows", 2, "step_limit_without"), 0.2, 1e-3);
  check_close(hooke_measurement_number(cost, "rows", 3, "step_limit_without"), damped, 1e-3 * damped);
  hooke_measurement_destroy(cost);
  hooke_system_destroy(system);

  /* without the only spring of a scene nothing limits the step */
  static const int64_t ends[] = {0, 1};
  static const double q[] = {0, 0, 0, 1, 0, 0};
  system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, .stiffness = 4.0, .rest_length = -1.0);
  check_ok(hooke_system_commit(system));
  cost = cost_of(system, (struct run){.method = "verlet", .step = 1e-3}, 1);
  check_close(hooke_measurement_number(cost, "cost", 0, "step_limit"), 1.0, 1e-3);
  assert_true(isinf(hooke_measurement_number(cost, "rows", 0, "step_limit_without")));
  hooke_measurement_destroy(cost);
  hooke_system_destroy(system);
}

/* Groups of 1, 3 and 2 springs and of 2 triples: as many as requested, the largest first, of equal size the
 * first; and all ingredients without group. */
TEST(the_largest_groups_are_looked_at) {
  enum { GROUPS = 4, MOST = GROUPS + 1 };
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, down[] = {0, 0, -9.81}, coefficient = 1.0;
  static const int64_t size[] = {1, 3, 2}, place[GROUPS] = {3, 0, 1, 2}; /* of each group among them */
  static const int64_t ends[] = {0, 1, 1, 2, 2, 3}, triples[] = {0, 1, 2, 1, 2, 3};
  owned_system *system = small_system(4, q, NULL, 1.0, 1);
  for (int g = 0; g < 3; g++)
    small_springs(system, size[g], ends, (struct springs){.stiffness = 4.0, .rest_length = 1.0});
  check_ok(hooke_system_add_bending(system, "curl", 2, triples, 1, &coefficient));
  check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  owned_state *state = start_state(system);
  owned_options *options = options_with("cost", "predict=1");
  for (int64_t most = 0; most <= MOST; most++) {
    owned_measurement *cost;
    check_ok(hooke_options_set_number(options, "groups", (double)most));
    check_ok(hooke_measurement_create("cost", system, NULL, options, &cost));
    check_ok(hooke_measurement_run(cost, state));
    assert_int_equal(hooke_measurement_row_count(cost, "rows"), GROUPS + 1);
    for (int64_t row = 0; row < GROUPS; row++)
      assert_int_equal(isnan(hooke_measurement_number(cost, "rows", row, "memory_bytes")),
                       place[row] >= most);
    check_between(hooke_measurement_number(cost, "rows", GROUPS, "memory_bytes"), 0.0, 1e4);
  }
}

/* Every method can be timed, with steps that are far too large, or none given. */
TEST(times_are_numbers) {
  owned_system *system = two_oscillators(1.0, 0.5, 1, 1);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    for (int k = 0; k < 3; k++) {
      const double step[] = {1e-3, 1e3, 0.0};
      owned_measurement *cost = cost_of_all_rows(system, (struct run){.method = method, .step = step[k]});
      assert_string_equal(hooke_measurement_text(cost, "cost", 0, "method"),
                          is_fixed_step(method) ? method : "symplectic-euler");
      check_between(hooke_measurement_number(cost, "cost", 0, "step"), 1e-12, 1e3);
      check_between(hooke_measurement_number(cost, "cost", 0, "nanoseconds"), 1.0, 1e9);
      check_between(hooke_measurement_number(cost, "cost", 0, "resolution"), 0.0, 1e9);
      for (int64_t row = 0; row < hooke_measurement_row_count(cost, "rows"); row++) {
        check_between(hooke_measurement_number(cost, "rows", row, "nanoseconds"), 0.0, 1e9);
        check_between(hooke_measurement_number(cost, "rows", row, "resolution"), 0.0, 1e9);
      }
    }
  }
}

struct watch {
  int calls, stop_at;
  double last;
};

static int32_t see(double done, const char *what, void *ctx) {
  struct watch *watch = ctx;
  assert_non_null(what);
  check_between(done, watch->last, 1.0);
  watch->last = done;
  return ++watch->calls == watch->stop_at;
}

TEST(can_be_stopped) {
  owned_system *system = two_oscillators(1.0, 0.5, 1, 0);
  owned_state *state = start_state(system);
  struct watch watch = {.stop_at = 4};
  owned_measurement *cost;
  check_ok(hooke_measurement_create("cost", system, NULL, NULL, &cost));
  hooke_measurement_on_progress(cost, see, &watch);
  check_status(hooke_measurement_run(cost, state), HOOKE_STOPPED);
  check_between(hooke_measurement_number(cost, "rows", 1, "nanoseconds"), 0.0, 1e9);
  assert_true(isnan(hooke_measurement_number(cost, "rows", 2, "nanoseconds")));
  assert_true(isnan(hooke_measurement_number(cost, "rows", 2, "memory_bytes")));
}

TEST(a_clamped_rope_has_the_cost_of_its_bending) {
  owned_system *system = new_system();
  owned_options *rope =
      options_with("rope", "from=0,0,0 to=1,0,0 segments=4 mass=1 bending=0.2 clamped=start,end");
  check_ok(hooke_system_add_part(system, "rope", "beam", rope, NULL, NULL));
  check_ok(hooke_system_commit(system));
  owned_measurement *cost = cost_of(system, (struct run){.method = "verlet", .step = 1e-4}, 1);
  assert_int_equal(hooke_measurement_row_count(cost, "rows"), 3);
}

TEST(wrong_calls) {
  owned_system *system = two_oscillators(0.0, 0.0, 0, 0), *open, *other = small_oscillator(1.0);
  owned_state *state = start_state(other);
  owned_measurement *cost = NULL;
  open = new_system();
  check_status(hooke_measurement_create("cost", open, NULL, NULL, &cost), HOOKE_BAD_CALL);
  check_ok(hooke_measurement_create("cost", system, NULL, NULL, &cost));
  check_status(hooke_measurement_run(cost, state), HOOKE_BAD_VALUE);
  check_message("does not fit");
  assert_true(isnan(hooke_measurement_number(cost, "cost", 0, "step_limit")));
}
