/* The limit of one mode: compared with closed forms and with the limits of an oscillator; and the refusals of
 * a report. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double of(const char *method, double frequency, double decay) {
  return hooke_limit_of_mode(method, frequency, decay);
}

static void check_digits(double value, double expected) {
  check_close(value, expected, 1e-13 * fabs(expected));
}

TEST(test_closed_forms) {
  for (double w = 1e-3; w < 1e5; w *= 7.0) {
    for (double z = 0.0; z < 30.0; z = 2.0 * z + 0.01) {
      const double d = z * w, fastest = z > 1.0 ? d + w * sqrt(z * z - 1.0) : w;
      check_digits(of("symplectic-euler", w, d), 2.0 * (sqrt(1.0 + z * z) - z) / w);
      check_digits(of("verlet", w, d), 2.0 / w);
      check_close(of("forward-euler", w, d) * w, (z > 1.0 ? 2.0 / fastest : 2.0 * z / w) * w, 1e-12);
    }
  }
  assert_true(isinf(of("backward-euler", 1.0, 0.5)) && isinf(of("cvode-bdf", 1.0, 0.5)));
  assert_true(of("forward-euler", 3.0, 0.0) == 0.0);
}

/* Motion without restoring force, and no motion at all. */
TEST(test_without_stiffness) {
  check_digits(of("forward-euler", 0.0, 5.0), 0.2);
  check_digits(of("symplectic-euler", 0.0, 5.0), 0.2);
  assert_true(isinf(of("verlet", 0.0, 5.0)));
  assert_true(isinf(of("symplectic-euler", 0.0, 0.0)) && isinf(of("forward-euler", 0.0, 0.0)));
}

TEST(test_what_has_none) {
  assert_true(isnan(of("verlot", 1.0, 0.0)));
  assert_true(isnan(of("verlet", -1.0, 0.0)) && isnan(of("verlet", 1.0, -1.0)));
  assert_true(isnan(of("verlet", (double)NAN, 0.0)) && isnan(of("verlet", 1.0, (double)NAN)));
}

/* One mass on a spring that is damped along its length; drag brakes it in all directions. */
static hooke_system *build_one(double damping, int as_body) {
  const double q[6] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, mass = 0.5;
  const int64_t ends[2] = {0, 1}, pinned = 0;
  hooke_system *system = small_system(2, q, NULL, mass, 0);
  check_ok(hooke_system_pin(system, 1, &pinned));
  owned_options *options = options_with("springs", "stiffness=20 damping=%.17g rest_length=1", damping);
  check_ok(hooke_system_add_springs(system, "spring", 1, ends, options));
  if (as_body) check_ok(hooke_system_add_body(system, NULL, 1, ends + 1, 0));
  check_ok(hooke_system_commit(system));
  return system;
}

static hooke_system *build(double damping) {
  return build_one(damping, 0);
}

static hooke_measurement *make(hooke_system *system) {
  hooke_options *options = options_with("limit", "predict=1");
  return start_limit(system, NULL, options);
}

/* Over- and underdamped: the prediction for the only mode, and the reported modes. */
TEST(test_an_oscillator) {
  const double dampings[] = {0.4, 3.0, 12.0, 90.0};
  for (int j = 0; j < 4; j++) {
    owned_system *system = build(dampings[j]);
    owned_measurement *limit = make(system);
    check_ok(hooke_measurement_run(limit, NULL)); /* the initial state */
    const double w = sqrt(40.0), d = dampings[j]; /* 20/0.5, and gamma/0.5 = 2 d */
    for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
      const double alone = of(hooke_measurement_text(limit, "rows", k, "method"), w, d);
      const double predicted = hooke_measurement_number(limit, "rows", k, "predicted");
      if (isinf(alone))
        assert_true(isinf(predicted));
      else
        check_close(predicted, alone, 1e-9 * alone);
    }
    assert_int_equal(hooke_measurement_row_count(limit, "modes"), d < w ? 1 : 2);
    for (int64_t k = 0; k < hooke_measurement_row_count(limit, "modes"); k++) {
      check_close(hooke_measurement_number(limit, "modes", k, "frequency"), w, 1e-12 * w);
      check_close(hooke_measurement_number(limit, "modes", k, "decay"), d, 1e-12 * d);
    }
  }
}

/* Of an undamped spring the bound on a step is its limit, but for Runge-Kutta, and of drag alone; `bounds` of
 * all methods are those one by one. */
TEST(test_bounds) {
  const double omega = 7.0, place[3] = {0.0, 0.0, 0.0};
  owned_system *system = small_oscillator(omega), *falling = small_system(1, place, NULL, 1.0, 0),
               *open = new_system();
  owned_state *state = start_state(system);
  double bounds[32], bound;
  check_ok(hooke_step_bound(system, NULL, hooke_state_position(state), bounds));
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const double one = bound_at_start(system, hooke_method_name(k));
    check_same_bits(1, &one, &bounds[k]);
  }
  check_close(bound_at_start(system, "symplectic-euler"), 2.0 / omega, 1e-11);
  check_close(bound_at_start(system, "verlet"), 2.0 / omega, 1e-12);
  check_close(bound_at_start(system, "rk4"), 2.6156 / omega, 1e-11);
  check_between(bound_at_start(system, "forward-euler"), 0.0, 0.0);
  assert_true(isinf(bound_at_start(system, "cvode-bdf")));
  check_ok(hooke_system_set_drag(falling, 0.25));
  check_ok(hooke_system_commit(falling));
  check_close(bound_at_start(falling, "forward-euler"), 8.0, 1e-12);
  check_close(bound_at_start(falling, "rk4"), 4.0 * 2.6156, 1e-10);
  assert_true(isinf(bound_at_start(falling, "verlet")) && isinf(bound_at_start(falling, "backward-euler")));
  check_status(hooke_step_bound(falling, "no-such-method", place, &bound), HOOKE_BAD_VALUE);
  check_message("no-such-method");
  check_status(hooke_step_bound(open, "symplectic-euler", place, &bound), HOOKE_BAD_CALL);
}

/* ---- limits and the steps themselves ---- */

/* Spectral radius of a step along the spring, from where it takes two unit states. */
static double radius(const hooke_system *system, const char *method, double h) {
  double m[2][2];
  for (int k = 0; k < 2; k++) {
    const double by = 1e-3;
    owned_integrator *it = start_run(system, (struct run){.method = method, .step = h});
    owned_state *state = start_state(system);
    double *x = hooke_state_position(state) + 3, *v = hooke_state_velocity(state) + 3;
    *(k == 0 ? x : v) += by;
    check_ok(hooke_integrator_step(it, state, 1));
    m[0][k] = (*x - 1.0) / by;
    m[1][k] = *v / by;
  }
  const double half = 0.5 * (m[0][0] + m[1][1]), product = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double root = half * half - product;
  return root < 0.0 ? sqrt(product) : fabs(half) + sqrt(root);
}

/* Stable up to the limit, and not a millionth above it. */
static void check_limit(const hooke_system *system, const char *method, double limit, double w) {
  const double rounding = 1e-10, longest = fmin(limit, 100.0 / w);
  for (int k = 1; k < 8 && limit > 0.0; k++) {
    const double found = radius(system, method, k * longest / 8.0);
    if (!(found <= 1.0 + rounding)) check_failed("%s grows by %.9g at %d/8 of its limit", method, found, k);
  }
  if (isinf(limit)) return;
  const double below = limit > 0.0 ? radius(system, method, limit * (1.0 - 1e-6)) : 1.0,
               above = radius(system, method, limit > 0.0 ? limit * (1.0 + 1e-6) : 0.1 / w);
  if (!(below <= 1.0 + rounding && above > 1.0 + 3.0 * rounding))
    check_failed("%s: below its limit %.17g a step grows by %.12g, above it by %.12g", method, limit, below,
                 above);
}

/* Of every method, without damping and with it up to far above the critical one, of a particle and of a
 * body. */
TEST(test_limits_are_those_of_the_steps) {
  const double w = sqrt(40.0), ratios[] = {0.0, 0.02, 0.3, 0.9, 1.7, 6.0};
  for (int k = 0; k < 12; k++) {
    const double decay = ratios[k % 6] * w;
    const int as_body = k >= 6;
    owned_system *system = build_one(decay, as_body);
    owned_measurement *limit = as_body ? make(system) : NULL;
    if (limit) check_ok(hooke_measurement_run(limit, NULL));
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (!is_fixed_step(method) || (as_body && !hooke_method_is_suited(method, "bodies"))) continue;
      const int64_t row = limit ? hooke_measurement_find(limit, "rows", "method", method) : 0;
      check_limit(system, method,
                  limit ? hooke_measurement_number(limit, "rows", row, "predicted") : of(method, w, decay),
                  w);
    }
  }
}

static int32_t stop(double done, const char *what, void *ctx) {
  (void)done, (void)what, (void)ctx;
  return 1;
}

TEST(test_reports_that_are_refused) {
  owned_system *system = build(1.0), *other;
  owned_measurement *limit = make(system);
  owned_state *foreign;
  assert_int_equal(hooke_measurement_write(limit, "page.html"), HOOKE_BAD_CALL);
  hooke_measurement_on_progress(limit, stop, NULL);
  assert_int_equal(hooke_measurement_run(limit, NULL), HOOKE_STOPPED);
  assert_int_equal(hooke_measurement_write(limit, "page.html"),
                   HOOKE_HAVE_CHARTJS ? HOOKE_BAD_CALL : HOOKE_NOT_BUILT);
  hooke_measurement_on_progress(limit, NULL, NULL);
  other = new_system();
  check_ok(hooke_system_commit(other));
  foreign = start_state(other);
  assert_int_equal(hooke_measurement_run(limit, foreign), HOOKE_BAD_VALUE);
  check_ok(hooke_measurement_run(limit, NULL));
  assert_int_equal(hooke_measurement_write(limit, "page.pdf"), HOOKE_BAD_VALUE);
}

/* A row is that of its table, and both stand in the document. */
TEST(test_json) {
  owned_system *system = build(1.0);
  owned_measurement *limit = make(system);
  check_ok(hooke_measurement_run(limit, NULL));
  const int64_t last = hooke_measurement_row_count(limit, "rows") - 1;
  assert_null(hooke_measurement_json(limit, "orders", 0));
  assert_null(hooke_measurement_json(limit, "rows", last + 1));
  assert_null(hooke_measurement_json(limit, "rows", -2));
  char *row = strdup(hooke_measurement_json(limit, "rows", last));
  char *rows = strdup(hooke_measurement_json(limit, "rows", -1));
  const char *whole = hooke_measurement_json(limit, NULL, 0), *end = strstr(rows, row);
  assert_int_equal(strncmp(rows, "[{\"method\": \"", 13), 0);
  assert_string_equal(end ? end + strlen(row) : "no such row", "]");
  assert_non_null(strstr(whole, rows));
  assert_int_equal(strncmp(whole, "{\"time\": 0, \"method\": ", 22), 0);
  free(row);
  free(rows);
}
