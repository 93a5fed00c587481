/* Limits of steps with rigid bodies: modes against closed forms, predictions against measurements, what
 * determines a limit, and spins with which it is not known. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double G = 9.81;

/* With the run's velocities, `methods` (NULL: all), measured or predicted alone. A build without LAPACK
 * skips. */
static hooke_measurement *limit_of(hooke_system *system, const char *methods, int measured) {
  hooke_options *options = new_options("limit");
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  check_ok(hooke_options_set_number(options, "predict", measured ? 0.0 : 1.0));
  return limit_at_start(system, NULL, options);
}

static double of_row(const hooke_measurement *limit, int64_t row, const char *what) {
  return hooke_measurement_number(limit, "rows", row, what);
}

/* The frequencies, ascending, of all modes that swing; returns their number. */
static int64_t frequencies_of(const hooke_measurement *limit, double frequency[8]) {
  const int64_t count = hooke_measurement_row_count(limit, "modes");
  for (int64_t k = 0; k < count; k++)
    frequency[count - 1 - k] = hooke_measurement_number(limit, "modes", k, "frequency");
  return count;
}

static void check_frequencies(hooke_system *system, int64_t count, const double *expected) {
  owned_measurement *limit = limit_of(system, "verlet", 0);
  double found[8];
  assert_int_equal(frequencies_of(limit, found), count);
  for (int64_t k = 0; k < count; k++)
    check_close(found[k] / expected[k], 1.0, 1e-9);
  check_close(of_row(limit, 0, "predicted") * expected[count - 1], 2.0, 1e-9);
  hooke_system_destroy(system);
}

/* ---- a bar of unequal masses along x on four springs along y, all at their rest lengths ---- */

enum { BAR = 5, BAR_ALL = 2 * BAR - 1 };

static const double PLACE[BAR] = {-1.0, -0.4, 0.1, 0.5, 1.2}, BAR_MASS[BAR] = {1.0, 0.3, 2.0, 0.5, 0.7},
                    BAR_K[BAR] = {300.0, 100.0, 0.0, 250.0, 80.0};

/* Damped by `beta` times the stiffness, one spring by more of it if `uneven`. */
static hooke_system *bar_on_springs(double beta, double uneven) {
  double q[3 * BAR_ALL], mass[BAR_ALL], stiffness[BAR - 1], damping[BAR - 1];
  int64_t ends[2 * BAR - 2], body[BAR], posts[BAR - 1], count = 0;
  memset(q, 0, sizeof q);
  for (int p = 0; p < BAR; p++) {
    q[3 * p] = PLACE[p];
    mass[p] = BAR_MASS[p];
    body[p] = p;
    if (BAR_K[p] == 0.0) continue;
    q[3 * (BAR + count)] = PLACE[p];
    q[3 * (BAR + count) + 1] = -0.5;
    mass[BAR + count] = 1.0;
    posts[count] = BAR + count;
    ends[2 * count] = p;
    ends[2 * count + 1] = BAR + count;
    stiffness[count] = BAR_K[p];
    damping[count] = beta * BAR_K[p] * (count == 0 ? 1.0 + uneven : 1.0);
    count++;
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, BAR_ALL, q, NULL, BAR_ALL, mass, NULL));
  check_ok(hooke_system_pin(system, count, posts));
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", count, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", count, damping));
  check_ok(hooke_system_add_springs(system, "feet", count, ends, options));
  check_ok(hooke_system_add_body(system, "bar", BAR, body, 0));
  return committed(system);
}

/* Heave and pitch about the centre of mass: M y'' + k0 y + k1 a = 0, I a'' + k1 y + k2 a = 0. */
static void find_bar_frequencies(double frequency[2]) {
  double m = 0.0, centre = 0.0, inertia = 0.0, k[3] = {0.0, 0.0, 0.0};
  for (int p = 0; p < BAR; p++) {
    m += BAR_MASS[p];
    centre += BAR_MASS[p] * PLACE[p];
  }
  centre /= m;
  for (int p = 0; p < BAR; p++) {
    const double x = PLACE[p] - centre;
    inertia += BAR_MASS[p] * x * x;
    for (int j = 0; j < 3; j++)
      k[j] += BAR_K[p] * pow(x, j);
  }
  const double half = 0.5 * (k[0] / m + k[2] / inertia),
               root = sqrt(half * half - (k[0] * k[2] - k[1] * k[1]) / (m * inertia));
  frequency[0] = sqrt(half - root);
  frequency[1] = sqrt(half + root);
}

TEST(a_bar_has_its_two_modes) {
  double expected[2];
  find_bar_frequencies(expected);
  check_frequencies(bar_on_springs(0.0, 0.0), 2, expected);
}

/* The largest stable step of x'' + beta w^2 x' + w^2 x = 0. */
static double exact_limit(const char *method, double w, double beta) {
  const double k = w * w, c = beta * k;
  if (strcmp(method, "symplectic-euler") == 0) return 4.0 / (c + sqrt(c * c + 4.0 * k));
  /* h^2 k + 2 h c - h^2 c^2 = 4: verlet takes the damping of bodies at a predicted velocity */
  if (strcmp(method, "verlet") == 0) return 4.0 / (c + sqrt(c * c + 4.0 * (k - c * c)));
  return hooke_limit_of_mode(method, w, 0.5 * c);
}

TEST(bar_runs_up_to_its_limits) {
  const char *const methods[2] = {"symplectic-euler,verlet,rk4",
                                  "symplectic-euler,verlet,forward-euler,heun,rk4"};
  double frequency[2];
  find_bar_frequencies(frequency);
  for (int damped = 0; damped < 2; damped++) {
    const double beta = damped ? 0.02 : 0.0;
    owned_system *system = bar_on_springs(beta, 0.0);
    owned_measurement *limit = limit_of(system, methods[damped], 1);
    for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
      const char *method = hooke_measurement_text(limit, "rows", k, "method");
      const double slow = exact_limit(method, frequency[0], beta),
                   fast = exact_limit(method, frequency[1], beta);
      check_close(of_row(limit, k, "predicted") / fmin(slow, fast), 1.0, 1e-6);
      check_close(of_row(limit, k, "ratio"), 1.0, 1e-3);
      check_close(of_row(limit, k, "exact"), 1.0, 0.0);
      assert_true(isnan(of_row(limit, k, "bound")));
    }
  }
}

/* Damping out of proportion. */
TEST(bar_runs_up_to_its_limits_where_one_spring_is_damped_more) {
  owned_system *system = bar_on_springs(0.01, 8.0);
  owned_measurement *limit = limit_of(system, "symplectic-euler,verlet,forward-euler,rk4", 1);
  for (int64_t k = 0; k < 4; k++)
    check_close(of_row(limit, k, "ratio"), 1.0, 1e-3);
}

/* ---- gravity and tensions are the stiffness of what turns ---- */

/* A bar of length 1 from the origin at an angle from the vertical below, its first end pinned, or an axis
 * along z through it. */
static hooke_system *pendulum(int pins, double angle) {
  double q[9] = {0.0};
  q[3] = sin(angle), q[4] = -cos(angle), q[8] = 0.3;
  hooke_system *system = small_system(pins == 2 ? 3 : 2, q, NULL, 0.7, 1);
  if (pins == 2) check_ok(hooke_system_pin(system, 1, (int64_t[]){2}));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -G, 0.0}));
  check_ok(hooke_system_add_body(system, "pendulum", pins == 2 ? 3 : 2, (int64_t[]){0, 1, 2}, 0));
  return system;
}

TEST(a_pendulum_swings_by_gravity) {
  const double w = sqrt(G), both[2] = {w, w}, tilted[2] = {sqrt(G * cos(0.4)), sqrt(G * cos(0.4))};
  for (int pins = 1; pins <= 2; pins++) {
    hooke_system *system = committed(pendulum(pins, 0.0));
    check_frequencies(system, 3 - pins, both);
    system = pendulum(pins, 0.4);
    check_ok(hooke_system_commit(system));
    check_frequencies(system, 3 - pins, tilted);
  }
  owned_system *system = committed(pendulum(1, 0.0));
  owned_measurement *limit = limit_of(system, "symplectic-euler,verlet,rk4", 1);
  for (int64_t k = 0; k < 3; k++)
    check_close(of_row(limit, k, "ratio"), 1.0, 1e-3);
  assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), "geometric");
  check_close(hooke_measurement_number(limit, "blame", 0, "share"), 1.0, 1e-12);
}

/* It falls by itself, at any step, and that is not a limit of the step. */
TEST(a_pendulum_upside_down_is_said_to_tip) {
  owned_system *system = committed(pendulum(1, 3.14159265358979323846));
  owned_measurement *limit = limit_of(system, "verlet", 1);
  assert_int_equal(hooke_measurement_row_count(limit, "modes"), 0);
  check_close(hooke_measurement_number(limit, "limit", 0, "tipping"), 1.0, 0.0);
  assert_true(isinf(of_row(limit, 0, "predicted")) && isinf(of_row(limit, 0, "measured")));
}

/* A bar of length 2a between two springs of length l and tension t, in a line: it moves along by 2 kappa/m,
 * across by 2t/(l m), and turns by 2 t a (1 + a/l) over its inertia m a^2; the second and the third twice. */
TEST(tension_holds_a_bar) {
  const double a = 0.3, l = 0.5, kappa = 40.0, t = kappa * (l - 0.35), m = 2.0;
  const double q[12] = {-a, 0, 0, a, 0, 0, -a - l, 0, 0, a + l, 0, 0};
  const double across = sqrt(2.0 * t / (l * m)), turn = sqrt(2.0 * t * a * (1.0 + a / l) / (m * a * a));
  hooke_system *system = small_system(4, q, NULL, 0.5 * m, 0);
  check_ok(hooke_system_pin(system, 2, (int64_t[]){2, 3}));
  small_springs(system, 2, (int64_t[]){0, 2, 1, 3},
                (struct springs){.law = "length", .stiffness = kappa, .rest_length = 0.35});
  check_ok(hooke_system_add_body(system, "bar", 2, (int64_t[]){0, 1}, 0));
  check_ok(hooke_system_commit(system));
  owned_measurement *limit = limit_of(system, "symplectic-euler,rk4", 1);
  for (int64_t k = 0; k < 2; k++)
    check_close(of_row(limit, k, "ratio"), 1.0, 1e-3);
  check_frequencies(system, 5, (double[]){across, across, turn, turn, sqrt(2.0 * kappa / m)});
}

/* ---- spins ---- */

/* The bar on its springs, which turns about the vertical. */
static hooke_measurement *limit_at_spin(const hooke_system *system, double spin) {
  hooke_measurement *limit = NULL;
  owned_options *options = options_with("limit", "methods=symplectic-euler,verlet,rk4");
  check_ok(hooke_measurement_create("limit", system, NULL, options, &limit));
  owned_state *state = start_state(system);
  for (int p = 0; p < BAR; p++)
    hooke_state_velocity(state)[3 * p + 2] = -spin * PLACE[p];
  check_ok(hooke_measurement_run(limit, state));
  return limit;
}

/* Known up to 1e-3 rad in the time in which the limiting mode swings by 1 rad; else not measured either. */
TEST(spin_makes_a_limit_unknown) {
  owned_system *system = bar_on_springs(0.0, 0.0);
  hooke_measurement_destroy(limit_of(system, "verlet", 0)); /* skips without LAPACK */
  double frequency[2];
  find_bar_frequencies(frequency);
  for (int fast = 0; fast < 2; fast++) {
    owned_measurement *limit = limit_at_spin(system, (fast ? 1.01e-3 : 0.99e-3) * frequency[1]);
    for (int64_t k = 0; k < 3; k++) {
      const double predicted = of_row(limit, k, "predicted");
      const int said = strstr(hooke_measurement_text(limit, "rows", k, "note"), "spins so fast") != NULL;
      assert_int_equal(said, fast);
      assert_int_equal(isnan(predicted), fast);
      assert_int_equal(isnan(of_row(limit, k, "measured")), fast);
      if (!fast) check_close(predicted * frequency[1], k == 2 ? sqrt(8.0) : 2.0, 1e-6);
    }
  }
}

/* ---- a body is what a stiff lattice becomes ---- */

/* Four masses at the corners of a tetrahedron, rigid or joined by springs of a stiffness, hung on a soft
 * spring. */
static double tetrahedron_limit(double stiffness) {
  const double q[15] = {0, 0, 0, 1, 0, 0, 0.5, 0.8, 0, 0.5, 0.3, 0.8, 0, -1.5, 0};
  owned_system *system = small_system(5, q, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, 1, (int64_t[]){4}));
  small_springs(system, 1, (int64_t[]){0, 4},
                (struct springs){.law = "length", .stiffness = 10.0, .rest_length = 1.5});
  if (stiffness > 0.0)
    small_springs(system, 6, (int64_t[]){0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3},
                  (struct springs){.law = "length", .stiffness = stiffness, .rest_length = -1.0});
  else
    check_ok(hooke_system_add_body(system, "body", 4, (int64_t[]){0, 1, 2, 3}, 0));
  check_ok(hooke_system_commit(system));
  owned_measurement *limit = limit_of(system, "verlet", 0);
  const double found = of_row(limit, 0, "predicted");
  return found;
}

TEST(limit_of_a_lattice_falls_and_that_of_its_body_stays) {
  const double body = tetrahedron_limit(0.0);
  double before = tetrahedron_limit(1e4);
  check_between(body, 10.0 * before, 100.0 * before);
  for (int decade = 0; decade < 3; decade++) {
    const double now = tetrahedron_limit(1e5 * pow(10.0, decade));
    check_close(log10(now / before), -0.5, 1e-3);
    before = now;
  }
}

/* ---- why ---- */

TEST(why_names_the_spring_at_a_body) {
  double frequency[2];
  owned_system *system = bar_on_springs(0.0, 0.0);
  find_bar_frequencies(frequency);
  hooke_measurement_destroy(limit_of(system, "verlet", 0)); /* skips without LAPACK */
  const double step = 2.4 / frequency[1];
  owned_run(integrator, state, system, .method = "verlet", .step = step, .duration = 1000.0 * step);
  for (int p = 0; p < BAR; p++)
    hooke_state_velocity(state)[3 * p + 1] = 1e-3;
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = NULL;
  check_ok(explain_run(integrator, &why));
  assert_string_equal(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  check_close(hooke_measurement_number(why, "why", 0, "limit") * frequency[1], 2.0, 1e-3);
  assert_string_equal(hooke_measurement_text(why, "blame", 0, "group"), "feet");
  assert_true(hooke_measurement_row_count(why, "advice") > 0);
}
