/* Implicit methods with rigid bodies: stiff springs at steps that do not resolve them, light particles
 * between bodies, and what is conserved. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { METHODS = 3 };
static const char *const NAMES[METHODS] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};

static void add_springs(hooke_system *system, int64_t count, const int64_t *ends, double stiffness,
                        double damping) {
  owned_options *options = options_with("springs", "stiffness=%.17g damping=%.17g", stiffness, damping);
  check_ok(hooke_system_add_springs(system, NULL, count, ends, options));
}

/* ---- a stiff spring that no step resolves ---- */

/* A square plate whose middle a spring holds at a post straight above; it is pulled down by `stretch`. */
static hooke_system *plate(double stiffness, double stretch) {
  const double q[] = {1,
                      -1 - stretch,
                      0,
                      -1,
                      -1 - stretch,
                      0,
                      0,
                      -1 - stretch,
                      1,
                      0,
                      -1 - stretch,
                      -1,
                      0,
                      -1 - stretch,
                      0,
                      0,
                      0,
                      0},
               mass = 0.25;
  const int64_t body[] = {0, 1, 2, 3, 4}, post = 5, ends[] = {4, 5};
  hooke_system *system = small_system(6, q, NULL, mass, 0);
  check_ok(hooke_system_pin(system, 1, &post));
  owned_options *options = options_with("springs", "stiffness=%.17g rest_length=1", stiffness);
  check_ok(hooke_system_add_springs(system, "spring", 1, ends, options));
  check_ok(hooke_system_add_body(system, "plate", 5, body, 0));
  return committed(system);
}

/* Energy after `steps` over that at first, with h omega as given. */
static double energy_left(const char *method, double h_omega, int64_t steps) {
  const double stiffness = 1e6, step = h_omega / sqrt(stiffness / 1.25);
  owned_system *system = plate(stiffness, 1e-3);
  owned_run(integrator, state, system, .method = method, .step = step);
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double before = hooke_system_energy(system, "total", q, v);
  check_ok(hooke_integrator_step(integrator, state, steps));
  assert_int_equal(hooke_integrator_count(integrator, "nonlinear_failures"), 0);
  const double left = hooke_system_energy(system, "total", q, v) / before;
  return left;
}

/* What a step multiplies y'' = -omega^2 y by, squared, for h omega = z. */
static double amplification(int method, double z) {
  const double c = 2.0 - sqrt(2.0), d = 0.5 * (sqrt(2.0) - 1.0);
  const double complex x = 0.5 * c * z * I, middle = (1.0 + x) / (1.0 - x);
  const double complex factor = method == 0   ? 1.0 / (1.0 - z * I)
                                : method == 1 ? (middle + d * (middle - 1.0)) / (1.0 - x)
                                              : (1.0 + 0.5 * z * I) / (1.0 - 0.5 * z * I);
  return creal(factor * conj(factor));
}

/* However stiff the spring: backward Euler and tr-bdf2 let the motion die, and midpoint keeps its energy. */
TEST(unresolved_motion_dies_out) {
  for (double z = 0.1; z < 2e4; z *= 10.0) {
    for (int m = 0; m < METHODS; m++) {
      const double expected = amplification(m, z);
      check_close(energy_left(NAMES[m], z, 1) / expected, 1.0, 1e-6);
      check_close(energy_left(NAMES[m], z, 40), pow(expected, 40.0), 1e-6);
    }
  }
}

/* ---- bodies and light particles, in a chain of springs ---- */

enum { CHAIN = 11 };

/* A post, a light particle, a bar of 3, a light particle, a tetrahedron of 4, a last particle; the bar
 * swings and the tetrahedron turns. `pinned`: its first corner. */
static const double MASS[CHAIN] = {1, 1e-4, 0.2, 0.1, 0.2, 1e-4, 0.3, 0.2, 0.1, 0.2, 0.1};

static hooke_system *chain(double stiffness, double damping, int pinned) {
  double q[3 * CHAIN] = {0, 0,   0, 0.5, 0,   0,   1,   0,   0,    1.3, 0,   0,   1.6,  0,   0,   2.1, 0,
                         0, 2.6, 0, 0,   2.9, 0.4, 0.1, 2.8, -0.2, 0.4, 3.0, 0.1, -0.3, 3.6, 0.1, 0},
               v[3 * CHAIN] = {0};
  const int64_t bar[] = {2, 3, 4}, block[] = {6, 7, 8, 9}, post = 0, corner = 6,
                ends[] = {0, 1, 1, 2, 4, 5, 5, 6, 9, 10, 7, 10, 5, 8};
  for (int p = 2; p < 5; p++)
    v[3 * p + 2] = 0.5 * (q[3 * p] - 1.0);
  for (int p = 6; p < 10; p++) {
    v[3 * p + 1] = -0.7 * q[3 * p + 2];
    v[3 * p + 2] = 0.7 * q[3 * p + 1];
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, CHAIN, q, v, CHAIN, MASS, NULL));
  check_ok(hooke_system_pin(system, 1, &post));
  if (pinned) check_ok(hooke_system_pin(system, 1, &corner));
  check_ok(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  add_springs(system, 7, ends, stiffness, damping);
  check_ok(hooke_system_add_body(system, "bar", 3, bar, 0));
  check_ok(hooke_system_add_body(system, "block", 4, block, 0));
  return committed(system);
}

/* Sums of m u and of m r x u of particles from `first` on, r from their centre of mass or from the first. */
static void add_up(const double *q, const double *u, int first, int count, int pinned, double sum[6]) {
  double mass = 0.0, from[3] = {0.0, 0.0, 0.0};
  memset(sum, 0, 6 * sizeof *sum);
  for (int p = first; p < first + count; p++) {
    mass += MASS[p];
    for (int a = 0; a < 3; a++)
      from[a] += MASS[p] * q[3 * p + a];
  }
  for (int a = 0; a < 3; a++)
    from[a] = pinned ? q[3 * first + a] : from[a] / mass;
  for (int p = first; p < first + count; p++) {
    double r[3];
    for (int a = 0; a < 3; a++) {
      r[a] = q[3 * p + a] - from[a];
      sum[a] += MASS[p] * u[3 * p + a];
    }
    for (int a = 0; a < 3; a++) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      sum[3 + a] += MASS[p] * (r[b] * u[3 * p + c] - r[c] * u[3 * p + b]);
    }
  }
}

/* A step of backward Euler solves its equations: momentum and angular momentum of each particle and body
 * have changed by h times the force and the torque at its end, but for the bar's turning about its own axis,
 * which there is not. */
static void check_step(const hooke_system *system, double step, int pinned) {
  static const int first[] = {1, 2, 5, 6, 10}, count[] = {1, 3, 1, 4, 1};
  owned_run(integrator, state, system, .method = "backward-euler", .step = step);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  double start[2][3 * CHAIN], change[3 * CHAIN], before[6], after[6], pushed[6];
  memcpy(start[0], q, sizeof start[0]);
  memcpy(start[1], v, sizeof start[1]);
  check_ok(hooke_integrator_step(integrator, state, 1));
  assert_int_equal(hooke_integrator_count(integrator, "nonlinear_failures"), 0);
  check_ok(hooke_system_acceleration(system, step, q, v, change));
  for (int k = 0; k < 5; k++) {
    const int held = pinned && first[k] == 6;
    add_up(start[0], start[1], first[k], count[k], held, before);
    add_up(q, v, first[k], count[k], held, after);
    add_up(q, change, first[k], count[k], held, pushed);
    double along = 0.0, left[6];
    for (int a = 0; a < 6; a++)
      left[a] = after[a] - before[a] - step * pushed[a];
    for (int a = 0; a < 3 && k == 1; a++)
      along += left[3 + a] * (q[12 + a] - q[6 + a]);
    for (int a = held ? 3 : 0; a < 6; a++) {
      const double axis = k == 1 && a >= 3 ? q[9 + a] - q[3 + a] : 0.0;
      check_close(left[a] - along / 0.36 * axis, 0.0, 1e-8);
    }
  }
}

/* Twenty steps are taken, and backward Euler adds no energy. */
static void check_run(const hooke_system *system, const char *method, double step, const char *newton) {
  const struct run run = {.method = method, .step = step, .newton = newton, .newton_tolerance = BY_DEFAULT};
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double before = hooke_system_energy(system, "total", q, v);
  check_ok(hooke_integrator_step(integrator, state, 20));
  for (int k = 0; k < 3 * CHAIN; k++)
    assert_true(isfinite(q[k]) && isfinite(v[k]));
  if (strcmp(method, "backward-euler") == 0)
    check_between(hooke_system_energy(system, "total", q, v), -1e3, before + 1e-6 * fabs(before));
}

TEST(stiff_chains_are_solved) {
  for (int how = 0; how < 4; how++) {
    for (double stiffness = 1e2; stiffness < 2e6; stiffness *= 100.0) {
      owned_system *system = chain(stiffness, how & 1 ? 10.0 : 0.0, how & 2);
      for (double step = 1e-5; step < 0.02; step *= 10.0) {
        check_step(system, step, how & 2);
        for (int m = 0; m < METHODS; m++) {
          check_run(system, NAMES[m], step, "converged");
          check_run(system, NAMES[m], step, "one-iteration");
        }
      }
      check_run(system, "backward-euler", 0.1, "converged");
      check_run(system, "tr-bdf2", 0.1, "converged");
    }
  }
}

/* ---- one iteration ---- */

/* It has the order of its method, for it solves the linearised equations. */
TEST(one_iteration_has_the_order) {
  hooke_system *system = chain(200.0, 0.1, 0);
  double exact[3 * CHAIN], q[3 * CHAIN], error[2];
  end_of_run(exact, NULL, system, .method = "rk4", .step = 1.0 / 65536, .duration = 0.125, .every = 0.125);
  for (int m = 0; m < METHODS; m++) {
    for (int k = 0; k < 2; k++) {
      end_of_run(q, NULL, system, .method = NAMES[m], .step = ldexp(1.0 / 4096, -k), .duration = 0.125,
                 .every = 0.125, .newton = "one-iteration");
      error[k] = largest_difference(3 * CHAIN, q, exact);
    }
    check_between(log2(error[0] / error[1]), m == 0 ? 0.85 : 1.8, m == 0 ? 1.15 : 2.2);
  }
}

/* ---- momentum ---- */

/* Two turning bodies that two springs join, with nothing else: both momenta stay, by implicit midpoint the
 * angular one too. */
TEST(momentum_is_kept) {
  const double q[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 3, 0.2, 0, 2.5, 1, 0.5, 2, 0.5, 1},
               v[] = {0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0.2, 0, -0.5, 1, 0, -1, 0.5}, mass = 0.4;
  const int64_t one[] = {0, 1, 2}, other[] = {3, 4, 5, 6}, ends[] = {1, 3, 2, 6};
  owned_system *system = small_system(7, q, v, mass, 0);
  add_springs(system, 2, ends, 50.0, 0.2);
  check_ok(hooke_system_add_body(system, NULL, 3, one, 0));
  check_ok(hooke_system_add_body(system, NULL, 4, other, 0));
  check_ok(hooke_system_commit(system));
  for (int m = 0; m < METHODS; m++) {
    double before[6], after[6];
    owned_run(integrator, state, system, .method = NAMES[m], .step = 0.02);
    const double *x = hooke_state_position(state), *u = hooke_state_velocity(state);
    hooke_system_momentum(system, u, before);
    hooke_system_angular_momentum(system, x, u, before + 3);
    check_ok(hooke_integrator_step(integrator, state, 500));
    hooke_system_momentum(system, u, after);
    hooke_system_angular_momentum(system, x, u, after + 3);
    check_close(largest_difference(3, before, after), 0.0, 1e-11);
    check_between(largest_difference(3, before + 3, after + 3), m == 2 ? 0.0 : 1e-8, m == 2 ? 1e-10 : 1.0);
  }
}
