/* q'' = W f(t, q, v) of generalized coordinates: a pendulum in its angle, a Duffing oscillator, a charge in a
 * magnetic field, a double pendulum. */
#include "check.h"
#include "gsl_motion.h"
#include "order.h"
#include "run.h"

#include <gsl/gsl_sf_ellint.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double G = 9.81;

/* A problem with its start. */
struct problem {
  int64_t size;
  hooke_force *force;
  double inverse_mass, q[4], v[4];
};

static void start_problem(struct problem *p, struct run run, hooke_integrator **it, hooke_state **state) {
  owned_options *options = run_options(run);
  check_ok(
      hooke_integrator_create_second_order(p->size, p->force, NULL, p, 1, &p->inverse_mass, options, it));
  check_ok(hooke_state_create_second_order(p->size, state));
  assert_int_equal(hooke_state_size(*state), p->size);
  memcpy(hooke_state_position(*state), p->q, (size_t)p->size * sizeof(double));
  memcpy(hooke_state_velocity(*state), p->v, (size_t)p->size * sizeof(double));
}

/* q and v at the end of a run. */
static void run_problem(struct problem *p, struct run run, double end[8]) {
  owned_integrator *it;
  owned_state *state;
  start_problem(p, run, &it, &state);
  check_ok(hooke_integrator_run(it, state));
  memcpy(end, hooke_state_position(state), (size_t)p->size * sizeof(double));
  memcpy(end + p->size, hooke_state_velocity(state), (size_t)p->size * sizeof(double));
}

/* ---- forces ---- */

static int32_t swing(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)v, (void)ctx;
  for (int64_t k = 0; k < n; k++)
    force[k] -= G * sin(q[k]);
  return 0;
}

static int32_t duffing(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)ctx;
  force[0] = -0.6 * v[0] + 2.0 * q[0] - 2.0 * q[0] * q[0] * q[0] + 0.8 * cos(1.2 * t);
  return 0;
}

/* df/dv is not symmetric. */
static int32_t magnetic(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)ctx;
  force[0] = 2.0 * v[1];
  force[1] = -2.0 * v[0];
  return 0;
}

/* Two rods of length 1 with masses of 1 kg at their ends; the mass matrix depends on q, so f is M^-1 f. */
static int32_t two_rods(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)ctx;
  const double d = q[0] - q[1], c = cos(d), s = sin(d), det = 2.0 - c * c;
  const double a = -s * v[1] * v[1] - 2.0 * G * sin(q[0]), b = s * v[0] * v[0] - G * sin(q[1]);
  force[0] = (a - c * b) / det;
  force[1] = (2.0 * b - c * a) / det;
  return 0;
}

static double energy_of_rods(const double *end) {
  const double *q = end, *v = end + 2;
  return v[0] * v[0] + 0.5 * v[1] * v[1] + v[0] * v[1] * cos(q[0] - q[1]) - 2.0 * G * cos(q[0]) -
         G * cos(q[1]);
}

static int32_t blow_up(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)v, (void)ctx;
  force[0] = q[0] * q[0] * q[0];
  return 0;
}

static const struct problem pendulum = {1, swing, 1.0, {1.0}, {0.0}},
                            oscillator = {1, duffing, 0.5, {0.5}, {-0.2}},
                            charge = {2, magnetic, 0.7, {0.3, 0.0}, {1.0, 0.5}},
                            rods = {2, two_rods, 1.0, {2.0, 1.0}, {0.0, 0.0}};

/* ---- tests ---- */

static double period(double amplitude) {
  return 4.0 * gsl_sf_ellint_Kcomp(sin(amplitude / 2.0), GSL_PREC_DOUBLE) / sqrt(G);
}

/* q and v at the end, by GSL. */
static void find_truth(struct problem *p, double end, double truth[8]) {
  const struct gsl_motion motion = {p->size, p->force, p->inverse_mass, p};
  memcpy(truth, p->q, (size_t)p->size * sizeof(double));
  memcpy(truth + p->size, p->v, (size_t)p->size * sizeof(double));
  gsl_move(&motion, 0.0, end, truth);
}

TEST(test_period) {
  const char *tight[] = {"cvode-adams", "cvode-bdf", "rk8pd", "arkode-esdirk"};
  for (int k = 0; k < 4; k++) {
    struct problem p = pendulum;
    double end[8];
    if (hooke_method_is_built(tight[k]) != 1) continue;
    run_problem(&p, (struct run){.method = tight[k], .duration = period(1.0), .rtol = 1e-11, .atol = 1e-12},
                end);
    check_close(end[0], 1.0, 1e-7);
    check_close(end[1], 0.0, 1e-7);
  }
}

static double error_at(const struct problem *problem, const char *method, double step, const double *truth) {
  struct problem p = *problem;
  double end[8];
  run_problem(&p, (struct run){.method = method, .step = step, .duration = 1.6}, end);
  return largest_difference(2 * p.size, end, truth);
}

/* Every fixed-step method has the order that it has for particles, with and without damping, also where df/dv
 * is not symmetric. */
TEST(test_orders) {
  const struct problem *problems[] = {&pendulum, &oscillator, &charge, &rods};
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (!is_fixed_step(method)) continue;
    const double order = strstr(method, "euler") ? 1.0 : strcmp(method, "rk4") == 0 ? 4.0 : 2.0;
    for (int k = 0; k < 4; k++) {
      struct problem p = *problems[k];
      double truth[8], error[3];
      char what[64];
      find_truth(&p, 1.6, truth);
      for (int j = 0; j < 3; j++)
        error[j] = error_at(&p, method, (order == 1.0 ? 2e-4 : 1e-2) / (1 << j), truth);
      snprintf(what, sizeof what, "%s on problem %d", method, k);
      check_order(what, 3, error, order - 0.2, order + 0.25);
    }
  }
}

TEST(test_double_pendulum) {
  struct problem p = rods;
  double by_rk4[8], by_cvode[8], truth[8], start[4] = {2.0, 1.0, 0.0, 0.0};
  find_truth(&p, 5.0, truth);
  run_problem(&p, (struct run){.method = "rk4", .step = 1e-3, .duration = 5.0}, by_rk4);
  check_close(energy_of_rods(by_rk4), energy_of_rods(start), 1e-8);
  check_close(energy_of_rods(truth), energy_of_rods(start), 1e-11);
  check_close(largest_difference(4, by_rk4, truth), 0.0, 1e-7);
  if (hooke_method_is_built("cvode-adams") != 1) return;
  run_problem(&p, (struct run){.method = "cvode-adams", .duration = 5.0, .rtol = 1e-12, .atol = 1e-12},
              by_cvode);
  check_close(largest_difference(4, by_cvode, truth), 0.0, 1e-7);
}

/* The numbers that fill up the last row of three change nothing: four pendulums are one, four times. */
TEST(test_sizes) {
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (!is_fixed_step(method) || is_implicit(method)) continue;
    struct problem one = pendulum, four = pendulum;
    double end[8], ends[8];
    four.size = 4;
    for (int k = 0; k < 4; k++)
      four.q[k] = 1.0;
    const struct run run = {.method = method, .step = 1e-3, .duration = 0.5};
    run_problem(&one, run, end);
    run_problem(&four, run, ends);
    for (int k = 0; k < 8; k++)
      check_same_bits(1, ends + k, end + k / 4);
  }
}

TEST(test_outcomes) {
  struct problem swings = pendulum, rises = pendulum;
  hooke_integrator *it;
  hooke_state *state;
  double q[3];
  const int64_t particle = 0;
  start_problem(&swings, (struct run){.method = "rk4", .step = 1e-2, .duration = 1.0}, &it, &state);
  check_status(hooke_integrator_get(it, 1, &particle, q, NULL), HOOKE_UNSUITED);
  check_message("second-order problem");
  check_status(hooke_integrator_on_warning(it, NULL, NULL), HOOKE_UNSUITED);
  hooke_state_destroy(state);
  hooke_integrator_destroy(it);

  rises.force = blow_up;
  start_problem(&rises, (struct run){.method = "verlet", .step = 1e-3, .duration = 10.0}, &it, &state);
  check_status(hooke_integrator_run(it, state), HOOKE_DIVERGED);
  check_between(hooke_integrator_number(it, "diverged_at"), 1.8, 2.8);
  assert_true(isfinite(hooke_state_position(state)[0]));
  hooke_measurement *why;
  check_status(explain_run(it, &why), HOOKE_UNSUITED);
  hooke_state_destroy(state);
  hooke_integrator_destroy(it);
}

static void check_refused(int64_t size, hooke_force *force, int64_t count, double mass, const char *message) {
  const double masses[3] = {mass, mass, mass};
  owned_options *options = run_options((struct run){.method = "rk4", .step = 1.0});
  hooke_integrator *it = NULL;
  check_status(hooke_integrator_create_second_order(size, force, NULL, NULL, count, masses, options, &it),
               HOOKE_BAD_VALUE);
  check_message(message);
}

TEST(test_refusals) {
  struct problem p = pendulum;
  owned_integrator *it;
  hooke_state *state, *other;
  check_refused(0, swing, 1, 1.0, "size");
  check_refused(3, NULL, 1, 1.0, "force");
  check_refused(3, swing, 2, 1.0, "2 for 3 coordinates");
  check_refused(3, swing, 3, 0.0, "inverse_mass[0]");
  check_refused(3, swing, 1, NAN, "inverse_mass[0]");
  check_refused(3, swing, 1, INFINITY, "inverse_mass[0]");
  check_status(hooke_state_create_second_order(0, &state), HOOKE_BAD_VALUE);
  start_problem(&p, (struct run){.method = "verlet", .step = 1e-2, .duration = 1.0}, &it, &state);
  check_ok(hooke_state_create_second_order(2, &other));
  check_status(hooke_integrator_run(it, other), HOOKE_BAD_VALUE);
  check_message("a state of 2 numbers does not fit a problem of 1");
  hooke_state_position(state)[0] = NAN;
  check_status(hooke_integrator_run(it, state), HOOKE_BAD_VALUE);
  check_message("position[0]");
  hooke_state_position(state)[0] = 0.0;
  hooke_state_velocity(state)[0] = NAN;
  check_status(hooke_integrator_run(it, state), HOOKE_BAD_VALUE);
  check_message("velocity[0]");
  hooke_state_destroy(other);
  hooke_state_destroy(state);
}

static int32_t save_and_stop(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  check_ok(hooke_checkpoint_write("second_order.checkpoint", ctx, state, NULL));
  return 1;
}

/* A run goes on from a checkpoint with the bits of one that was not interrupted. */
TEST(test_checkpoints) {
  const char *methods[] = {"symplectic-euler", "verlet", "rk4", "implicit-midpoint"};
  for (int k = 0; k < 4; k++) {
    struct problem p = rods, heavier = rods;
    double end[8];
    hooke_integrator *it, *again;
    hooke_state *state, *other;
    struct run run = {.method = methods[k], .step = 1e-2, .duration = 1.0, .checkpoint = 0.3};
    run_problem(&p, run, end);
    start_problem(&p, run, &it, &state);
    check_ok(hooke_integrator_on_checkpoint(it, save_and_stop, it));
    check_status(hooke_integrator_run(it, state), HOOKE_STOPPED);
    start_problem(&p, run, &again, &other);
    check_ok(hooke_checkpoint_read("second_order.checkpoint", NULL, again, other));
    check_ok(hooke_integrator_resume(again, other));
    check_same_bits(2, hooke_state_position(other), end);
    check_same_bits(2, hooke_state_velocity(other), end + 2);
    hooke_state_destroy(other);
    hooke_integrator_destroy(again);
    heavier.inverse_mass = 0.9;
    start_problem(&heavier, run, &again, &other);
    check_status(hooke_checkpoint_read("second_order.checkpoint", NULL, again, other), HOOKE_BAD_VALUE);
    hooke_state_destroy(other);
    hooke_integrator_destroy(again);
    hooke_state_destroy(state);
    hooke_integrator_destroy(it);
    unlink("second_order.checkpoint");
  }
}
