/* Rigid bodies against closed forms: the free body of Euler, the turn of the middle axis, pendulums, pinned
 * axes, and the lattice that a body is the limit of. */
#include "check.h"
#include "order.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static double dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* ---- the free body: six particles on three axes, moments 10, 16 and 20 about x, y and z ---- */

enum { SIX = 6 };
static const double HALF[3] = {3.60555127546398929, 2.64575131106459059, 1.73205080756887729};
static const double MOMENT[3] = {10.0, 16.0, 20.0}; /* of masses 1/2 at +-HALF */

static hooke_system *free_body(const double centre[3], const double velocity[3], const double rotation[3]) {
  double q[3 * SIX], v[3 * SIX];
  const double mass = 0.5;
  const int64_t all[SIX] = {5, 0, 1, 2, 3, 4};
  for (int p = 0; p < SIX; p++) {
    double arm[3] = {0.0, 0.0, 0.0}, swing[3];
    arm[p / 2] = p % 2 ? -HALF[p / 2] : HALF[p / 2];
    cross(rotation, arm, swing);
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = centre[a] + arm[a];
      v[3 * p + a] = velocity[a] + swing[a];
    }
  }
  hooke_system *system = small_system(SIX, q, v, mass, 0);
  check_ok(hooke_system_add_body(system, "top", SIX, all, 0));
  return committed(system);
}

/* Angular velocities about the body's own axes, from the rows alone. */
static void own_rotation(const double *q, const double *v, double rotation[3]) {
  double momentum[3] = {0.0, 0.0, 0.0}, centre[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < 3 * SIX; k++)
    centre[k % 3] += q[k] / SIX;
  for (int p = 0; p < SIX; p++) {
    double arm[3], turning[3];
    for (int a = 0; a < 3; a++)
      arm[a] = q[3 * p + a] - centre[a];
    cross(arm, v + 3 * p, turning);
    for (int a = 0; a < 3; a++)
      momentum[a] += 0.5 * turning[a];
  }
  for (int k = 0; k < 3; k++) {
    double axis[3];
    for (int a = 0; a < 3; a++)
      axis[a] = (q[6 * k + a] - q[6 * k + 3 + a]) / (2.0 * HALF[k]);
    rotation[k] = dot(momentum, axis) / MOMENT[k];
  }
}

/* The solution of Euler's equations from (w1, 0, w3) (Landau and Lifshitz, Mechanics, section 37), for L^2 >
 * 2 E I2 and, with the first and the last axis exchanged, for L^2 < 2 E I2. Returns the quarter period. */
static double euler(const double start[3], double t, double rotation[3]) {
  double i[3] = {MOMENT[0], MOMENT[1], MOMENT[2]};
  const double e = i[0] * start[0] * start[0] + i[2] * start[2] * start[2];
  const double l = i[0] * i[0] * start[0] * start[0] + i[2] * i[2] * start[2] * start[2];
  const int other = l < e * i[1];
  if (other) i[0] = MOMENT[2], i[2] = MOMENT[0];
  const double rate = sqrt((i[2] - i[1]) * (l - e * i[0]) / (i[0] * i[1] * i[2]));
  const double k = sqrt((i[1] - i[0]) * (e * i[2] - l) / ((i[2] - i[1]) * (l - e * i[0])));
  double sn, cn, dn;
  gsl_sf_elljac_e(rate * t, k * k, &sn, &cn, &dn);
  rotation[other ? 2 : 0] = sqrt((e * i[2] - l) / (i[0] * (i[2] - i[0]))) * cn;
  rotation[1] = sqrt((e * i[2] - l) / (i[1] * (i[2] - i[1]))) * sn;
  rotation[other ? 0 : 2] = sqrt((l - e * i[0]) / (i[2] * (i[2] - i[0]))) * dn;
  return gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE) / rate;
}

static const double START[3] = {0.9, 0.0, 0.8}, AT[3] = {0.3, -0.2, 0.1}, GOING[3] = {0.2, 0.1, -0.3};

/* Largest error of the angular velocities about the body's axes at `time`. */
static double error_of(struct run run) {
  double q[3 * SIX], v[3 * SIX], found[3], expected[3];
  owned_system *system = free_body(AT, GOING, START);
  run_to_end(system, run, q, v);
  own_rotation(q, v, found);
  euler(START, run.duration, expected);
  return largest_difference(3, found, expected);
}

/* The largest step of a measured order, and its bounds. */
static const struct order {
  const char *name;
  double step, low, high;
} orders[] = {{"forward-euler", 1.0 / 256, 0.9, 1.1},
              {"symplectic-euler", 1.0 / 64, 1.8, 2.2},
              {"verlet", 1.0 / 32, 1.9, 2.1},
              {"heun", 1.0 / 64, 1.9, 2.15},
              {"rk4", 1.0 / 16, 3.8, 4.3},
              {"backward-euler", 1.0 / 256, 0.9, 1.1},
              {"tr-bdf2", 1.0 / 64, 1.9, 2.1},
              {"implicit-midpoint", 1.0 / 64, 1.9, 2.1}};

static const struct order *order_of(const char *method) {
  for (size_t k = 0; k < sizeof orders / sizeof orders[0]; k++)
    if (strcmp(orders[k].name, method) == 0) return &orders[k];
  check_failed("%s takes bodies, and this test has no order of it", method);
  return NULL;
}

static void check_refuses_a_body(const char *method) {
  owned_system *system = free_body(AT, GOING, START);
  owned_options *options = run_options((struct run){.method = method, .step = 0.01, .duration = 1.0});
  hooke_integrator *integrator = NULL;
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_UNSUITED);
}

TEST(damping_of_bodies_is_not_solved_for) {
  owned_system *system = free_body(AT, GOING, START);
  owned_options *options =
      run_options((struct run){.method = "verlet", .step = 0.01, .verlet_damping = "implicit"});
  hooke_integrator *integrator = NULL;
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_UNSUITED);
  check_message("verlet_damping: implicit does not know rigid bodies yet");
}

/* Every method refuses a body, or has its order with one. */
TEST(free_body_has_the_order_of_its_method) {
  for (const char *name = NULL; (name = next_method(name, hooke_method_is_built));) {
    if (hooke_method_is_suited(name, "bodies") != 1) {
      check_refuses_a_body(name);
      continue;
    }
    double error[4];
    const struct order *order = is_fixed_step(name) ? order_of(name) : NULL;
    for (int k = 0; k < 4 && order; k++)
      error[k] = error_of(
          (struct run){.method = name, .step = ldexp(order->step, -k), .duration = 8.0, .every = 8.0});
    if (order) check_order(name, 4, error, order->low, order->high);
    for (int k = 0; k < 2 && !order; k++) /* tolerances a thousandth, errors less than a tenth */
      error[k] = error_of((struct run){
          .method = name, .duration = 8.0, .every = 8.0, .rtol = k ? 1e-9 : 1e-6, .atol = k ? 1e-9 : 1e-6});
    if (!order) check_between(error[1], 0.0, fmin(1e-6, 0.1 * error[0]));
  }
}

/* 100 turns about the axis of largest moment. */
TEST(reference_follows_jacobi) {
  const char *const names[] = {"rk8pd", "cvode-adams", "cvode-bdf", "arkode-esdirk"};
  const double bound[] = {1e-8, 1e-6, 1e-6, 1e-5};
  for (int k = 0; k < 4; k++) {
    if (!hooke_method_is_built(names[k])) continue;
    const double time = k < 2 ? 200.0 * PI / START[2] : 20.0;
    check_between(error_of((struct run){.method = names[k],
                                        .duration = time,
                                        .every = time,
                                        .rtol = k == 3 ? 1e-9 : 1e-12,
                                        .atol = k == 3 ? 1e-9 : 1e-12}),
                  0.0, bound[k]);
  }
}

/* ---- the turn of the middle axis (Dzhanibekov) ---- */

/* Time at which the rotation about the middle axis, at first `start`, changes sign, between two steps. */
static double turning_time(const char *method, double step) {
  const double rotation[3] = {0.0, 1.0, 1e-3}, still[3] = {0.0, 0.0, 0.0};
  owned_system *system = free_body(AT, still, rotation);
  owned_run(integrator, state, system, .method = method, .step = step);
  double now[3], before = 1.0, t = 0.0;
  for (now[1] = 1.0; now[1] > 0.0; t = hooke_state_time(state)) {
    before = now[1];
    check_ok(hooke_integrator_step(integrator, state, 1));
    own_rotation(hooke_state_position(state), hooke_state_velocity(state), now);
  }
  return t - step * now[1] / (now[1] - before);
}

/* From (0, w2, w3) the motion is that from (w1, 0, w3') a quarter period earlier, with the same energy and
 * momentum. */
static double turning_time_of_euler(void) {
  const double e = MOMENT[1] + MOMENT[2] * 1e-6, l = MOMENT[1] * MOMENT[1] + MOMENT[2] * MOMENT[2] * 1e-6;
  double start[3] = {0.0, 0.0, 0.0}, rotation[3];
  start[0] = sqrt((e * MOMENT[2] - l) / (MOMENT[0] * (MOMENT[2] - MOMENT[0])));
  start[2] = sqrt((l - e * MOMENT[0]) / (MOMENT[2] * (MOMENT[2] - MOMENT[0])));
  return euler(start, 0.0, rotation);
}

TEST(middle_axis_turns_in_time) {
  const double exact = turning_time_of_euler();
  double error[4];
  for (int k = 0; k < 4; k++)
    error[k] = turning_time("verlet", ldexp(1.0 / 16, -k)) - exact;
  check_order("verlet", 4, error, 1.8, 2.2);
  check_close(turning_time("rk4", 1.0 / 64), exact, 1e-5);
}

/* ---- conservation ---- */

struct drift {
  double energy, momentum[2]; /* largest in the first tenth of the run and in all of it */
};

static struct drift drift_of(const char *method, double step, int64_t blocks) {
  const double still[3] = {0.0, 0.0, 0.0}, rotation[3] = {0.9123, 0.0777, 0.7654};
  owned_system *system = free_body(still, still, rotation);
  owned_run(integrator, state, system, .method = method, .step = step);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state), first[3], now[3];
  const double energy = hooke_system_energy(system, "total", q, v);
  struct drift drift = {0.0, {0.0, 0.0}};
  hooke_system_angular_momentum(system, q, v, first);
  for (int64_t k = 0; k < blocks; k++) {
    check_ok(hooke_integrator_step(integrator, state, 100));
    hooke_system_angular_momentum(system, q, v, now);
    drift.energy = fmax(drift.energy, fabs(hooke_system_energy(system, "total", q, v) / energy - 1.0));
    drift.momentum[1] = fmax(drift.momentum[1], largest_difference(3, first, now));
    if (10 * k < blocks) drift.momentum[0] = drift.momentum[1];
  }
  return drift;
}

/* 1e6 steps: the error of energy is bounded and of order 2, that of angular momentum is rounding. */
TEST(verlet_conserves) {
  if (left_out(1, 2)) skip(); /* the code is that of the next one */
  const struct drift coarse = drift_of("verlet", 0.2, 5000), fine = drift_of("verlet", 0.1, 10000),
                     euler_drift = drift_of("symplectic-euler", 0.1, 10000);
  check_between(coarse.energy / fine.energy, 3.5, 4.6);
  check_between(fine.energy, 1e-5, 1e-2);
  check_between(fine.momentum[1], 1e-14, 3e-11);
  check_between(fine.momentum[1] / fine.momentum[0], 1.0, 8.0); /* by chance sqrt(10) */
  check_between(euler_drift.momentum[1], 1e-14, 3e-11);
}

/* Implicit methods keep the angular momentum of a free body to rounding at any tolerance. That of its energy
 * is of the order of the method: implicit midpoint does not lose or gain it steadily, the others lose it. */
TEST(implicit_methods_conserve) {
  const char *const names[] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};
  for (int m = 0; m < 3; m++) {
    const struct drift coarse = drift_of(names[m], 0.2, 25), fine = drift_of(names[m], 0.1, 50);
    check_between(coarse.momentum[1], 1e-15, 1e-11);
    check_between(fine.momentum[1], 1e-15, 1e-11);
    if (m > 0) check_between(coarse.energy / fine.energy, m == 1 ? 6.0 : 3.0, m == 1 ? 10.0 : 5.0);
  }
}

/* ---- pinned bodies ---- */

/* A bar of `count` particles from the origin, the first pinned, at rest at an angle from the vertical. */
static hooke_system *bar(int count, int pins, double angle, double *length) {
  double q[3 * 16];
  const double mass = 0.25;
  const int64_t all[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  double first = 0.0, second = 0.0;
  for (int p = 0; p < count; p++) {
    const double arm = 0.2 * (p >= pins ? p : 0);
    q[3 * p] = arm * sin(angle);
    q[3 * p + 1] = -arm * cos(angle);
    q[3 * p + 2] = p == 1 && pins == 2 ? 0.7 : 0.0;
    first += mass * arm;
    second += mass * arm * arm;
  }
  *length = second / first; /* of the simple pendulum of the same period */
  hooke_system *system = small_system(count, q, NULL, mass, 0);
  check_ok(hooke_system_pin(system, pins, all));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 0.0}));
  check_ok(hooke_system_add_body(system, "bar", count, all, 0));
  return committed(system);
}

/* After the time K sqrt(l/g) a pendulum let go at an angle is at the bottom. */
static double angle_at_the_bottom(int count, int pins, const char *method, double parts) {
  const double angle = 2.0;
  double length, q[3 * 16];
  owned_system *system = bar(count, pins, angle, &length);
  const double quarter = gsl_sf_ellint_Kcomp(sin(0.5 * angle), GSL_PREC_DOUBLE) * sqrt(length / 9.81);
  end_of_run(q, NULL, system, .method = method, .step = parts > 0.0 ? quarter / parts : 0.0,
             .duration = quarter, .every = quarter, .rtol = 1e-13, .atol = 1e-13);
  return atan2(q[3 * (count - 1)], -q[3 * (count - 1) + 1]);
}

TEST(pendulum_has_its_period) {
  for (int pins = 1; pins <= 2; pins++) {
    double error[4];
    for (int k = 0; k < 4; k++)
      error[k] = angle_at_the_bottom(6, pins, "verlet", ldexp(20.0, k));
    check_order("verlet", 4, error, 1.9, 2.1);
    for (int k = 0; k < 4; k++)
      error[k] = angle_at_the_bottom(6, pins, "rk4", ldexp(20.0, k));
    check_order("rk4", 4, error, 3.8, 4.3);
    for (int k = 0; k < 4; k++)
      error[k] = angle_at_the_bottom(6, pins, "implicit-midpoint", ldexp(20.0, k));
    check_order("implicit-midpoint", 4, error, 1.9, 2.1);
    if (hooke_method_is_built("rk8pd")) check_close(angle_at_the_bottom(6, pins, "rk8pd", 0), 0.0, 1e-10);
  }
}

/* A body held at three points is still, and its free particle weighs on nothing. */
TEST(three_pins_hold) {
  const double place[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 1}, mass = 1.0;
  double q[12];
  owned_system *system = small_system(4, place, NULL, mass, 0);
  check_ok(hooke_system_pin(system, 3, (int64_t[]){0, 1, 2}));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 0.0}));
  check_ok(hooke_system_add_body(system, NULL, 4, (int64_t[]){0, 1, 2, 3}, 0));
  check_ok(hooke_system_commit(system));
  end_of_run(q, NULL, system, .method = "backward-euler", .step = 0.1, .duration = 1.0);
  check_same_bits(12, q, place);
}

/* ---- the heavy symmetric top ---- */

/* Steady precession: a wheel on an axle pinned at its end, horizontal, turns about the vertical at W with
 * m g d = W (I3 s) for a spin s, and the inclination stays. */
TEST(top_precesses_steadily) {
  enum { RIM = 8, ALL = RIM + 1 };
  const double d = 0.5, r = 0.3, g = 9.81, spin = 60.0, i3 = r * r, mass = 1.0 / RIM;
  const double w = g * d / (i3 * spin); /* of a horizontal axle: exact */
  double q[3 * ALL] = {0.0}, v[3 * ALL] = {0.0}, end[3 * ALL];
  int64_t all[ALL];
  for (int p = 0; p < ALL; p++) {
    const double phi = 2.0 * PI * p / RIM, arm[3] = {d, r * cos(phi), r * sin(phi)};
    const double rotation[3] = {spin, 0.0, w};
    double swing[3];
    all[p] = p;
    if (p == RIM) continue; /* the pinned end */
    cross(rotation, arm, swing);
    memcpy(q + 3 * p, arm, sizeof arm);
    memcpy(v + 3 * p, swing, sizeof swing);
  }
  owned_system *system = small_system(ALL, q, v, mass, 0);
  check_ok(hooke_system_pin(system, 1, all + RIM));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, 0.0, -g}));
  check_ok(hooke_system_add_body(system, "top", ALL, all, 0));
  check_ok(hooke_system_commit(system));
  double error[4];
  const double time = 0.5 * PI / w;
  for (int k = 0; k < 4; k++) { /* a quarter turn: the axle points along y */
    end_of_run(end, NULL, system, .method = "verlet", .step = time / ldexp(400.0, k), .duration = time,
               .every = time);
    double centre[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 3 * RIM; i++)
      centre[i % 3] += end[i] / RIM;
    error[k] = sqrt(centre[0] * centre[0] + (centre[1] - d) * (centre[1] - d) + centre[2] * centre[2]);
  }
  check_order("verlet", 4, error, 1.8, 2.2);
  check_between(error[3], 0.0, 1e-3);
}
