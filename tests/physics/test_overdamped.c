/* Overdamped systems, gamma x' = f: a pair that relaxes, by every method that takes them. */
#include "check.h"
#include "order.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double GAMMA = 2.0, KAPPA = 30.0, LONG = 1.5, REST = 1.0;

/* Two particles on a spring along x that is stretched from 1 to 1.5 m. */
static hooke_system *open_pair(void) {
  const double q[6] = {0.0, 0.0, 0.0, 1.5, 0.0, 0.0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_add_particles(system, 2, q, NULL, 0, NULL, NULL));
  check_ok(hooke_system_set_drag(system, GAMMA));
  owned_options *springs = options_with("springs", "stiffness=%.17g rest_length=%.17g", KAPPA * REST, REST);
  check_ok(hooke_system_add_springs(system, "pair", 1, ends, springs));
  return system;
}

static hooke_system *make_pair(void) {
  hooke_system *system = open_pair();
  return committed(system);
}

static double length_at(double t) {
  return REST + (LONG - REST) * exp(-2.0 * KAPPA / GAMMA * t);
}

static double error_of(const hooke_system *system, struct run run) {
  double q[6], v[6];
  run_to_end(system, run, q, v);
  const double d = q[3] - q[0];
  check_close(q[0] + q[3], 1.5, 1e-12);
  check_close(v[3] - v[0], -2.0 * KAPPA / GAMMA * (d - REST), 1e-12); /* f/gamma, where it is */
  return fabs(d - length_at(run.duration));
}

static int takes_pair(const hooke_system *system, const char *method) {
  owned_options *options = run_options((struct run){.method = method, .step = 1e-3});
  owned_integrator *it = NULL;
  const int32_t status = hooke_integrator_create(system, options, &it);
  return status == HOOKE_OK;
}

/* The closed form, at the order of the method from both sides. */
TEST(test_orders) {
  owned_system *system = make_pair();
  int taken = 0;
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    if (!takes_pair(system, method)) continue;
    const double order = strstr(method, "euler") ? 1.0 : strcmp(method, "rk4") == 0 ? 4.0 : 2.0;
    double error[4];
    for (int k = 0; k < 4; k++)
      error[k] = error_of(system, (struct run){.method = method,
                                               .step = (order == 1.0 ? 2.5e-4 : 2e-3) / (1 << k),
                                               .duration = 0.04});
    check_order(method, 4, error, order - 0.1, order + 0.15);
    taken++;
  }
  assert_int_equal(taken, 6); /* forward Euler, Heun, Runge-Kutta, three implicit ones */
}

TEST(test_adaptive) {
  owned_system *system = make_pair();
  const char *methods[] = {"cvode-bdf", "cvode-adams", "rk8pd", "arkode-esdirk"},
             *solvers[] = {"auto", "blocks", "direct", "gmres"};
  for (int k = 0; k < 4; k++) {
    for (int s = 0; s < 4; s++) {
      if (hooke_method_is_built(methods[k]) != 1 || !takes_pair(system, methods[k])) continue;
      const double error = error_of(system, (struct run){.method = methods[k],
                                                         .linear_solver = solvers[s],
                                                         .duration = 0.04,
                                                         .rtol = 1e-9,
                                                         .atol = 1e-10});
      check_close(error, 0.0, 1e-7);
    }
  }
}

/* Stable up to the end of the real axis, and beyond not. */
TEST(test_limits) {
  owned_system *system = make_pair();
  const struct {
    const char *method;
    double reach;
  } explicits[] = {{"forward-euler", 2.0}, {"heun", 2.0}, {"rk4", 2.785293563405282}};
  for (int k = 0; k < 3; k++) {
    const double limit = explicits[k].reach * GAMMA / (2.0 * KAPPA);
    double below[6], above[6];
    check_close(bound_at_start(system, explicits[k].method), limit, 1e-9 * limit);
    end_of_run(below, NULL, system, .method = explicits[k].method, .step = 0.99 * limit,
               .duration = 0.99 * limit * 400);
    end_of_run(above, NULL, system, .method = explicits[k].method, .step = 1.01 * limit,
               .duration = 1.01 * limit * 100);
    check_close(below[3] - below[0], REST, 1e-2);
    assert_true(fabs(above[3] - above[0] - REST) > LONG - REST);
  }
}

TEST(test_divergence) {
  owned_system *system = make_pair();
  owned_run(it, state, system, .method = "forward-euler", .step = 0.11, .duration = 11.0, .every = 0.11);
  check_status(hooke_integrator_run(it, state), HOOKE_DIVERGED);
  check_message("energy has risen");
  check_between(
      hooke_system_energy(system, "total", hooke_state_position(state), hooke_state_velocity(state)), 1.0,
      101.0 * 0.5 * KAPPA * 0.25);
  assert_true(hooke_system_energy(system, "kinetic", NULL, hooke_state_velocity(state)) == 0.0);
}

/* What falls has the speed m g/gamma at once; a callback is given v = 0; dissipation is the work of gravity.
 */
static int32_t push(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  double *largest_v = ctx;
  (void)t, (void)q;
  for (int64_t k = 0; k < 3 * n; k++)
    *largest_v = fmax(*largest_v, fabs(v[k]));
  force[0] += 3.0;
  return 0;
}

TEST(test_forces) {
  const double start[6] = {0}, mass[2] = {2.0, 0.5}, g[3] = {0.0, -9.81, 0.0};
  const char *methods[] = {"forward-euler",     "heun",     "rk4", "backward-euler", "tr-bdf2",
                           "implicit-midpoint", "cvode-bdf"};
  double largest_v = 0.0, q[6], v[6];
  owned_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_add_particles(system, 2, start, NULL, 2, mass, NULL));
  check_ok(hooke_system_set_drag(system, 4.0));
  check_ok(hooke_system_set_gravity(system, g));
  check_ok(hooke_system_set_force(system, push, NULL, &largest_v));
  check_ok(hooke_system_commit(system));
  for (int k = 0; k < 7; k++) {
    if (hooke_method_is_built(methods[k]) != 1) continue;
    end_of_run(q, v, system, .method = methods[k], .step = 0.01, .duration = 0.5);
    const double expected[6] = {0.75, -9.81 * 0.5, 0.0, 0.0, -9.81 * 0.125, 0.0};
    for (int a = 0; a < 6; a++) {
      check_close(v[a], expected[a], 1e-14);
      check_close(q[a], 0.5 * expected[a], 1e-12);
    }
  }
  assert_true(largest_v == 0.0);
  check_close(hooke_system_dissipated_power(system, q, v), 4.0 * (0.75 * 0.75 + 1.0625 * 9.81 * 9.81 * 0.25),
              1e-9);
  check_close(hooke_system_energy(system, "gravity", q, NULL), 9.81 * (2.0 * q[1] + 0.5 * q[4]), 1e-9);
}

/* One end is moved as x = 0.1 sin(t): the other follows by exp(-kappa t/gamma), at the order of each method.
 */
TEST(test_driven) {
  const double amplitude[3] = {0.1, 0.0, 0.0}, a = KAPPA / GAMMA, t = 0.2;
  const int64_t first = 0;
  const char *methods[] = {"forward-euler", "heun", "rk4", "backward-euler", "tr-bdf2", "implicit-midpoint"};
  owned_system *system = open_pair();
  check_ok(hooke_system_drive_harmonic(system, 1, &first, amplitude, 1.0 / (2.0 * M_PI), 0.0));
  check_ok(hooke_system_commit(system));
  const double from = LONG - REST, forced = 0.1 * a / (a * a + 1.0);
  const double exact = REST + (from + forced) * exp(-a * t) + forced * (a * sin(t) - cos(t));
  for (int k = 0; k < 6; k++) {
    const double order = strstr(methods[k], "euler") ? 1.0 : strcmp(methods[k], "rk4") == 0 ? 4.0 : 2.0;
    double error[3], q[6], v[6];
    for (int j = 0; j < 3; j++) {
      end_of_run(q, v, system, .method = methods[k], .step = 4e-3 / (order == 1.0 ? 8 << j : 1 << j),
                 .duration = t);
      check_close(q[0], 0.1 * sin(t), 1e-14);
      check_close(v[0], 0.1 * cos(t), 1e-14);
      error[j] = fabs(q[3] - exact);
    }
    check_order(methods[k], 3, error, order - 0.15, order + 0.2);
  }
}

/* ---- refusals ---- */

static void check_refused(hooke_system *system, const char *message) {
  check_status(hooke_system_commit(system), HOOKE_BAD_VALUE);
  check_message(message);
  hooke_system_destroy(system);
}

/* A lattice and a rope; `mass` 0: not given. */
static hooke_system *open_parts(double mass, double gravity, const char *option) {
  const char *const kinds[] = {"lattice", "rope"}, *const family[] = {"structural", "stretch"};
  const double edges[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, size[3] = {3, 2, 3}, end[3] = {6, 1, 0};
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, GAMMA));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, gravity, 0.0}));
  for (int k = 0; k < 2; k++) {
    char name[64];
    owned_options *part = new_options(kinds[k]);
    if (k == 0) check_ok(hooke_options_set_numbers(part, "edges", 9, edges));
    if (k == 0) check_ok(hooke_options_set_numbers(part, "size", 3, size));
    if (k == 1) check_ok(hooke_options_set_numbers(part, "from", 3, (double[]){4, 0, 0}));
    if (k == 1) check_ok(hooke_options_set_numbers(part, "to", 3, end));
    if (k == 1) check_ok(hooke_options_set_number(part, "segments", 5));
    if (mass > 0.0) check_ok(hooke_options_set_number(part, "mass", mass));
    snprintf(name, sizeof name, "%s.stiffness", family[k]);
    check_ok(hooke_options_set_number(part, name, 7.0));
    snprintf(name, sizeof name, "%s.%s", family[k], option ? option : "rest_scale");
    check_ok(hooke_options_set_number(part, name, 0.8));
    const int32_t status = hooke_system_add_part(system, kinds[k], NULL, part, NULL, NULL);
    assert_int_equal(status, option ? HOOKE_BAD_VALUE : HOOKE_OK);
  }
  return system;
}

/* Masses do nothing without gravity, so parts need none. */
TEST(test_parts_without_mass) {
  enum { N = 18 + 6 };
  double q[2][3 * N];
  for (int k = 0; k < 2; k++) {
    owned_system *system = committed(open_parts(k ? 3.0 : 0.0, 0.0, NULL));
    end_of_run(q[k], NULL, system, .method = "rk4", .step = 0.01, .duration = 1.0);
  }
  check_same_bits(3 * N, q[0], q[1]);
  check_between(fabs(q[0][3 * N - 3] - 6.0), 0.05, 0.5); /* the end of the rope has moved */
  check_refused(open_parts(0.0, -9.81, NULL), "particles.mass[0]: is missing; gravity");
  hooke_system_destroy(open_parts(0.0, 0.0, "damping_ratio"));
  check_message("stretch.damping_ratio: is given to a part that has neither mass nor density");
}

TEST(test_refusals) {
  const double g[3] = {0.0, 0.0, 1.0}, q[3] = {0.0, 0.0, 1.0}, v[3] = {0.0, 1.0, 0.0}, mass = 1.0;
  const int64_t ends[2] = {0, 1};
  owned_system *system = open_pair();
  check_status(hooke_system_set_dynamics(system, "fast"), HOOKE_BAD_VALUE);
  check_ok(hooke_system_set_drag(system, 0.0));
  check_refused(system, "drag: 0 is not allowed");
  system = open_pair();
  check_ok(hooke_system_set_gravity(system, g));
  check_refused(system, "particles.mass[0]: is missing; gravity");
  system = open_pair();
  check_ok(hooke_system_set_dynamics(system, "inertial"));
  check_refused(system, "particles.mass[0]: is missing; a motion with inertia");
  system = open_pair();
  check_ok(hooke_system_add_particles(system, 1, q, v, 1, &mass, NULL));
  check_refused(system, "particles.velocity[2][1]: 1 is not allowed");
  system = open_pair();
  owned_options *springs = options_with("springs", "stiffness=1 damping=0.1");
  check_ok(hooke_system_add_springs(system, "damped", 1, ends, springs));
  check_status(hooke_system_commit(system), HOOKE_BAD_VALUE);
  check_message("damping: the spring of particle 0 is damped");
  check_ok(hooke_system_set_dynamics(system, "overdamped")); /* still open, with its masses and drag */
  check_refused(system, "damping");
  system = make_pair();
  assert_string_equal(hooke_system_dynamics(system), "overdamped");
  assert_false(takes_pair(system, "verlet"));
  check_message("verlet steps positions and velocities apart");
}
