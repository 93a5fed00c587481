/* Factors of gravity: free fall, the righting moment of a float, overdamped particles, energies, and what is
 * refused. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double G = 9.81;

static void set_factors(hooke_system *system, int64_t count, const double *factor) {
  check_ok(hooke_system_set_gravity_factor(system, 0, count, count, factor));
}

/* Every method takes phi g, whether it is solved, goes by stages or has bodies beside. */
TEST(particles_fall_at_their_own_rate) {
  const double factor[4] = {1.0, -0.25, 0.0, 3.0};
  const double place[18] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0};
  for (int bodies = 0; bodies < 2; bodies++) {
    owned_system *system = small_system(6, place, NULL, 0.7, 0);
    set_factors(system, 4, factor);
    if (bodies) check_ok(hooke_system_add_body(system, NULL, 2, (int64_t[]){4, 5}, 0));
    small_falling(system);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      double q[18], v[18];
      if (!hooke_method_is_built(method)) continue;
      if (bodies && !hooke_method_is_suited(method, "bodies")) continue;
      struct run run = {.method = method, .duration = 0.1};
      if (!hooke_method_is_adaptive(method)) run.step = 0.01;
      run_to_end(system, run, q, v);
      for (int p = 0; p < 6; p++)
        check_close(v[3 * p + 1], -0.1 * G * (p < 4 ? factor[p] : 1.0), 1e-6);
    }
  }
}

/* A factor of 1 is none, to the bit. */
TEST(a_factor_of_one_changes_nothing) {
  const double one = 1.0;
  double q[2][3 * 64];
  for (int k = 0; k < 2; k++) {
    owned_system *system = small_part(NULL, "cloth", "cloth",
                                      "origin=0,0,0 edges=1,0,0,0,0,1 size=8,8 mass=1 pinned=top-corners "
                                      "structural.stiffness=50 structural.damping=0.1 shear.stiffness=20");
    if (k) check_ok(hooke_system_set_gravity_factor(system, 0, 64, 1, &one));
    small_falling(system);
    end_of_run(q[k], NULL, system, .method = "verlet", .step = 1e-3, .duration = 0.2);
  }
  check_same_bits(3 * 64, q[0], q[1]);
}

/* A rod of 2 l with a mass m at either end and factors a above and b below is a pendulum about its centre,
 * which falls at (a + b)/2 g: 2 m l^2 w' = -m (b - a) g l sin(angle). */
static hooke_system *buoy(double above, double below, double angle) {
  const double l = 0.5, factor[2] = {above, below};
  const double place[6] = {l * sin(angle), l * cos(angle), 0, -l * sin(angle), -l * cos(angle), 0};
  hooke_system *system = small_system(2, place, NULL, 1.5, 0);
  set_factors(system, 2, factor);
  check_ok(hooke_system_add_body(system, "buoy", 2, (int64_t[]){0, 1}, 0));
  return small_falling(system);
}

/* The period of a pendulum from rest, by the arithmetic-geometric mean. */
static double period(double omega, double angle) {
  double a = 1.0, b = cos(0.5 * angle);
  for (int k = 0; k < 8; k++) {
    const double mean = 0.5 * (a + b);
    b = sqrt(a * b);
    a = mean;
  }
  return 2.0 * acos(-1.0) / (omega * a);
}

/* After a quarter of its period it is upright, with the speed that its energy gives; by how much energy
 * drifts follows the order. */
static void check_righting(const char *method, double within) {
  const double angle = 0.8, omega = sqrt(2.6 * G), whole = period(omega, angle);
  owned_system *system = buoy(-1.3, 1.3, angle);
  owned_state *state = start_state(system);
  double q[6], v[6], drift[2];
  const double before = hooke_system_energy(system, "potential", hooke_state_position(state), NULL);
  for (int fine = 0; fine < 2; fine++) {
    const double step = whole / (fine ? 800 : 400);
    end_of_run(q, v, system, .method = method, .step = step, .duration = whole / 4);
    drift[fine] = fabs(hooke_system_energy(system, "total", q, v) - before);
  }
  check_close(q[0], 0.0, within);
  check_close(hypot(v[0], v[1]), sqrt(1.3 * G * (1.0 - cos(angle))), 3.0 * within);
  if (drift[0] > 1e-8) check_between(drift[0] / drift[1], 3.5, 4.6);
}

TEST(a_float_rights_itself) {
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    const int first_order = strcmp(method, "symplectic-euler") == 0 || strstr(method, "ward-euler") != NULL;
    if (first_order || !is_fixed_step(method) || !hooke_method_is_suited(method, "bodies")) continue;
    check_righting(method, strcmp(method, "rk4") == 0 ? 1e-8 : 1e-4);
  }
  /* the centre of one that is a little lighter rises at the mean */
  owned_system *light = buoy(-1.5, 1.3, 0.8);
  double q[6];
  end_of_run(q, NULL, light, .method = "rk4", .step = 1e-3, .duration = 0.5);
  check_close(0.5 * (q[1] + q[4]), 0.5 * 0.1 * G * 0.25, 1e-9);
}

/* A rod of three particles 1 m apart, pinned at one end, of which the far one is buoyant, swings upwards:
 * 5 m l^2 w' = -m (2 - 0.5) g l sin(angle). */
TEST(a_pinned_rod_rises) {
  const double angle = 0.3, factor[3] = {5.0, 0.5, -1.0}, s = sin(angle), c = cos(angle);
  const double place[9] = {0, 0, 0, s, c, 0, 2 * s, 2 * c, 0};
  const double quarter = period(sqrt(1.5 * G / 5.0), angle) / 4.0;
  static const char *const methods[] = {"rk4", "implicit-midpoint", "cvode-bdf"};
  owned_system *system = small_system(3, place, NULL, 0.4, 1);
  set_factors(system, 3, factor);
  check_ok(hooke_system_add_body(system, NULL, 3, (int64_t[]){0, 1, 2}, 0));
  small_falling(system);
  for (int m = 0; m < 3; m++) {
    struct run run = {.method = methods[m], .duration = quarter};
    double q[9];
    if (!hooke_method_is_built(methods[m])) continue;
    if (m < 2) run.step = quarter / 1000.0;
    if (m == 2) run.rtol = run.atol = 1e-10;
    run_to_end(system, run, q, NULL);
    check_close(q[3], 0.0, 1e-6);
  }
}

#if HOOKE_HAVE_LAPACK
/* The righting moment is a stiffness that limits the step; upside down it is growth by physics, left out. */
TEST(the_righting_moment_limits_the_step) {
  owned_system *upright = buoy(-1.3, 1.3, 0.0), *down = buoy(1.3, -1.3, 0.0);
  owned_measurement *limit = limits_of(upright, "symplectic-euler", 1),
                    *none = limits_of(down, "symplectic-euler", 1);
  check_close(hooke_measurement_number(limit, "rows", 0, "predicted"), 2.0 / sqrt(2.6 * G), 1e-6);
  assert_true(isinf(hooke_measurement_number(none, "rows", 0, "predicted")));
}
#endif

TEST(overdamped_particles_sink_and_rise) {
  const double factor[2] = {0.5, -2.0}, mass[2] = {1, 3};
  owned_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, 4.0));
  check_ok(hooke_system_add_particles(system, 2, (double[6]){0}, NULL, 2, mass, NULL));
  set_factors(system, 2, factor);
  small_falling(system);
  static const char *const methods[] = {"rk4", "backward-euler"};
  for (int m = 0; m < 2; m++) {
    double q[6];
    end_of_run(q, NULL, system, .method = methods[m], .step = 0.1, .duration = 1);
    for (int p = 0; p < 2; p++)
      check_close(q[3 * p + 1], -mass[p] * factor[p] * G / 4.0, 1e-10);
    check_close(hooke_system_energy(system, "gravity", q, NULL), 0.5 * G * q[1] - 6.0 * G * q[4], 1e-10);
  }
}

TEST(wrong_factors_are_refused) {
  const double two[2] = {1, NAN};
  owned_system *system = small_system(3, (double[]){0, 0, 0, 1, 0, 0, 2, 0, 0}, NULL, 1.0, 0);
  check_status(hooke_system_set_gravity_factor(system, 0, 3, 2, two), HOOKE_BAD_VALUE);
  check_message("gravity_factor: 2 factors for 3 particles; allowed: one, or one for each");
  check_status(hooke_system_set_gravity_factor(system, 0, 2, 2, two), HOOKE_BAD_VALUE);
  check_message("gravity_factor[1]: nan is not allowed");
  check_status(hooke_system_set_gravity_factor(system, 2, 2, 1, two), HOOKE_BAD_VALUE);
  check_message("first: there is no particle 2");
  owned_options *rope =
      options_with("rope", "from=0,0,0 to=1,0,0 segments=3 mass=1 stretch.stiffness=1 gravity_factor=1,2,3");
  check_status(hooke_system_add_part(system, "rope", "rope", rope, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("gravity_factor: 3 factors for 4 particles");
  assert_int_equal(hooke_system_particle_count(system), 3);
}
