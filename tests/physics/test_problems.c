/* Problems of coordinates under measurements: a linear x' = A x with a known exponential, a double pendulum,
 * and a chain of Fermi, Pasta, Ulam and Tsingou. */
#include "check.h"
#include "gsl_motion.h"
#include "owned.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double PI = 3.141592653589793;

/* ---- the problems ---- */

/* Four unknowns, two spirals: x = e^-t (cos 3t, sin 3t) and e^-2t (cos t, sin t). */
static int32_t spiral(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)t, (void)ctx;
  rate[0] = -x[0] - 3.0 * x[1];
  rate[1] = 3.0 * x[0] - x[1];
  rate[2] = -2.0 * x[2] - x[3];
  rate[3] = x[2] - 2.0 * x[3];
  return 0;
}

static double off_spiral(const hooke_state *state) {
  const double t = hooke_state_time(state), *x = hooke_state_position(state);
  const double truth[4] = {exp(-t) * cos(3.0 * t), exp(-t) * sin(3.0 * t), exp(-2.0 * t) * cos(t),
                           exp(-2.0 * t) * sin(t)};
  double most = 0.0;
  for (int k = 0; k < 4; k++)
    most = fmax(most, fabs(x[k] - truth[k]));
  return most;
}

/* Two rods of 1 m with 1 kg and 1/2 kg at their ends: M(q)^-1 f, and f is taken twice where W is 1/2. */
static int32_t rods(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)ctx;
  const double d = q[0] - q[1], c = cos(d), s = sin(d), det = 1.5 - 0.5 * c * c;
  const double a = -0.5 * s * v[1] * v[1] - 1.5 * 9.81 * sin(q[0]), b = s * v[0] * v[0] - 9.81 * sin(q[1]);
  force[0] = (a - 0.5 * c * b) / det;
  force[1] = 2.0 * (1.5 * b - c * a) / det;
  return 0;
}

enum { CHAIN = 32 };

static int32_t chain(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)v, (void)ctx;
  double before = 0.0;
  for (int64_t k = 0; k <= n; k++) {
    const double d = (k < n ? q[k] : 0.0) - (k > 0 ? q[k - 1] : 0.0), tension = d + 0.25 * d * d;
    if (k > 0) force[k - 1] += tension - before;
    before = tension;
  }
  return 0;
}

static double energy_of_mode(const hooke_state *state, int mode) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double omega = 2.0 * sin(0.5 * PI * mode / (CHAIN + 1));
  double a = 0.0, b = 0.0;
  for (int j = 1; j <= CHAIN; j++) {
    a += sqrt(2.0 / (CHAIN + 1)) * sin(PI * j * mode / (CHAIN + 1)) * q[j - 1];
    b += sqrt(2.0 / (CHAIN + 1)) * sin(PI * j * mode / (CHAIN + 1)) * v[j - 1];
  }
  return 0.5 * (b * b + omega * omega * a * a);
}

static hooke_system *make_spiral(void) {
  owned_state *start;
  hooke_system *system;
  check_ok(hooke_state_create_first_order(4, &start));
  hooke_state_position(start)[0] = hooke_state_position(start)[2] = 1.0;
  check_ok(hooke_system_create_first_order(spiral, NULL, start, &system));
  return system;
}

static hooke_system *make_second(int64_t size, hooke_force *force, const double *weight, const double *q) {
  owned_state *start;
  hooke_system *system;
  check_ok(hooke_state_create_second_order(size, &start));
  memcpy(hooke_state_position(start), q, (size_t)size * sizeof *q);
  check_ok(hooke_system_create_second_order(force, NULL, NULL, weight ? size : 1,
                                            weight ? weight : (double[]){1.0}, start, &system));
  return system;
}

/* ---- studies ---- */

static hooke_measurement *study_of(const hooke_system *system, struct run run, const char *words) {
  owned_options *options = run_options(run), *wanted = options_with("study", "%s", words);
  hooke_measurement *study;
  check_ok(hooke_measurement_create("study", system, options, wanted, &study));
  check_ok(hooke_measurement_run(study, NULL));
  return study;
}

static int32_t see_worst(int64_t step, const hooke_state *state, void *worst) {
  (void)step;
  *(double *)worst = fmax(*(double *)worst, off_spiral(state));
  return 0;
}

static double worst_off_spiral(const hooke_system *system, struct run run) {
  double worst = 0.0;
  owned_integrator *it = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_on_frame(it, see_worst, &worst));
  check_ok(hooke_integrator_run(it, state));
  return worst;
}

TEST(errors_and_orders_of_a_study_are_those_of_the_exponential) {
  struct run run = {.method = "rk4", .step = 0.1, .duration = 2.0, .every = 0.2};
  owned_system *system = make_spiral();
  owned_measurement *study = study_of(system, run, "steps=0.1,0.05,0.025,0.0125,0.00625,0.003125");
  const double agreement = hooke_measurement_number(study, "reference", 0, "agreement");
  int64_t seen = 0, rows = hooke_measurement_row_count(study, "orders");
  for (int64_t k = 0; k < rows; k++) {
    const double order = hooke_measurement_number(study, "orders", k, "order"),
                 theory = hooke_measurement_number(study, "orders", k, "theory");
    const char *method = hooke_measurement_text(study, "orders", k, "method");
    assert_int_equal(hooke_method_is_suited(method, "first-order"), 1);
    if (!is_fixed_step(method)) continue;
    check_between(order, theory - 0.1, theory + 0.2);
    seen++;
  }
  assert_int_equal(seen, 3);
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    run.method = hooke_measurement_text(study, "rows", k, "method");
    if (!is_fixed_step(run.method)) continue;
    run.step = hooke_measurement_number(study, "rows", k, "step");
    const double error = hooke_measurement_number(study, "rows", k, "error_max");
    check_close(error, worst_off_spiral(system, run), agreement + 1e-15);
    assert_true(isnan(hooke_measurement_number(study, "rows", k, "energy_drift")));
  }
  assert_string_equal(hooke_measurement_unit(study, "rows", "error"), "");
  assert_string_equal(hooke_measurement_unit(study, "rows", "step"), "s");
}

/* ---- estimates ---- */

static void estimate_run(const hooke_system *system, const hooke_options *options,
                         hooke_measurement *estimate, hooke_state *state, hooke_observer *see, void *ctx) {
  owned_integrator *it;
  check_ok(hooke_integrator_create(system, options, &it));
  check_ok(hooke_integrator_on_frame(it, see, ctx));
  check_ok(hooke_estimate_begin(estimate, it, state));
  check_ok(hooke_integrator_run(it, state));
  check_ok(hooke_measurement_run(estimate, state));
}

static hooke_measurement *make_estimate(const hooke_system *system, const char *words) {
  owned_options *wanted = options_with("estimate", "%s", words);
  hooke_measurement *estimate;
  check_ok(hooke_measurement_create("estimate", system, NULL, wanted, &estimate));
  return estimate;
}

static double number_of(const hooke_measurement *estimate, const char *what) {
  return hooke_measurement_number(estimate, "estimate", 0, what);
}

/* The same accelerations, for a mass of 1. */
static int32_t accelerate(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const int32_t value = rods(n, t, q, v, force, ctx);
  force[1] *= 0.5;
  return value;
}

struct follower {
  hooke_measurement *estimate;
  double t, y[4], worst; /* q and v by GSL, and how far the run was off them at frames */
};

static int32_t follow(int64_t step, const hooke_state *state, void *ctx) {
  const struct gsl_motion motion = {2, accelerate, 1.0, NULL};
  struct follower *f = ctx;
  const double t = hooke_state_time(state);
  if (t > f->t) gsl_move(&motion, f->t, t, f->y);
  f->t = t;
  for (int k = 0; k < 2; k++)
    f->worst = fmax(f->worst, fabs(hooke_state_position(state)[k] - f->y[k]));
  return hooke_estimate_see(step, state, f->estimate);
}

static void check_pendulum(const hooke_system *system, const char *method) {
  const struct run run = {.method = method, .step = 5e-3, .duration = 1.5, .every = 0.05};
  owned_options *options = run_options(run);
  owned_measurement *estimate = make_estimate(system, "callbacks=true");
  struct follower follower = {.estimate = estimate, .y = {0.9, 0.4}};
  owned_state *state = start_state(system);
  estimate_run(system, options, estimate, state, follow, &follower);
  const double said = number_of(estimate, "estimate"), most = hooke_method_is_adaptive(method) ? 30.0 : 4.0;
  if (!(said >= follower.worst && said <= most * follower.worst))
    check_failed("%s is said to be off by %.3g, and is by %.3g", method, said, follower.worst);
}

TEST(estimates_bracket_the_error_of_a_double_pendulum) {
  owned_system *system = make_second(2, rods, (double[]){1.0, 0.5}, (double[]){0.9, 0.4});
  for (int64_t m = 0; m < hooke_method_count(); m++)
    if (hooke_method_is_built(hooke_method_name(m))) check_pendulum(system, hooke_method_name(m));
}

TEST(a_wanted_error_of_a_chain_is_met) {
  static const double truth[] = {0.05404491, 0.01026979, 0.00432385};
  double q[CHAIN];
  for (int j = 1; j <= CHAIN; j++)
    q[j - 1] = sin(PI * j / (CHAIN + 1));
  owned_system *system = make_second(CHAIN, chain, NULL, q);
  owned_measurement *estimate = make_estimate(system, "want=1e-5 callbacks=true");
  owned_options *options = run_options((struct run){.method = "verlet", .duration = 1000.0});
  owned_state *state = start_state(system);
  assert_int_equal(hooke_state_size(state), CHAIN);
  check_ok(hooke_estimate_pick(estimate, NULL, options));
  estimate_run(system, options, estimate, state, hooke_estimate_see, estimate);
  assert_true(number_of(estimate, "met") == 1.0);
  check_between(number_of(estimate, "estimate"), 1e-9, 1e-5);
  for (int k = 0; k < 3; k++)
    check_close(energy_of_mode(state, k + 1), truth[k], 1e-6);
}

/* ---- what needs particles ---- */

TEST(what_is_of_particles_is_refused) {
  static const char *const kinds[] = {"limit", "needs", "check", "cost"};
  owned_system *system = make_second(1, chain, NULL, (double[]){0.1});
  owned_options *options = run_options((struct run){.method = "rk4", .duration = 1.0});
  owned_options *watch = options_with("study", "watch=0.x");
  hooke_measurement *made = NULL;
  owned_state *start = NULL;
  hooke_system *other = NULL;
  double bound;
  for (int k = 0; k < 4; k++) {
    check_status(hooke_measurement_create(kinds[k], system, options, NULL, &made), HOOKE_UNSUITED);
    check_message("needs particles, and this is a second-order problem");
  }
  check_status(hooke_measurement_create("study", system, options, watch, &made), HOOKE_UNSUITED);
  check_message("watch");
  check_ok(hooke_step_bound(system, "verlet", (double[]){0.1, 0.0, 0.0}, &bound));
  assert_true(isnan(bound));
  check_ok(hooke_state_create_first_order(1, &start));
  check_status(hooke_system_create_second_order(chain, NULL, NULL, 1, (double[]){1.0}, start, &other),
               HOOKE_BAD_VALUE);
  hooke_state_set_time(start, 1.0);
  check_status(hooke_system_create_first_order(spiral, NULL, start, &other), HOOKE_BAD_VALUE);
  check_message("t = 0 is");
}
