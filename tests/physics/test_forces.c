/* Forces against energies, and the conservation laws that follow from them. */
#include "check.h"
#include "law_scene.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static double norm(const double *x) {
  double square = 0.0;
  for (int k = 0; k < LAW_SIZE; k++)
    square += x[k] * x[k];
  return sqrt(square);
}

/* ---- f = -dU/dq ---- */

struct energy_curve {
  const hooke_system *system;
  const double *q;
  int32_t coordinate;
};

static void energy_along(double s, double *value, void *ctx) {
  const struct energy_curve *curve = ctx;
  double q[LAW_SIZE];
  memcpy(q, curve->q, sizeof q);
  q[curve->coordinate] += s;
  *value = hooke_system_energy_at(curve->system, "potential", LAW_TIME, q, NULL);
}

TEST(test_force_is_gradient) {
  const double rest[LAW_SIZE] = {0};
  for (int k = 0; k < LAW_COUNT; k++) {
    if (laws[k].callback) continue; /* has no energy */
    for (uint64_t seed = 1; seed <= 5; seed++) {
      owned_law_scene scene;
      double force[LAW_SIZE], slope;
      law_scene_create(&laws[k], seed, &scene);
      check_ok(hooke_system_force(scene.system, LAW_TIME, scene.q, rest, force));
      const double size = largest(LAW_SIZE, force);
      check_between(size, 1.0, 1000.0);
      for (int32_t c = 0; c < LAW_SIZE; c++) {
        struct energy_curve curve = {scene.system, scene.q, c};
        differentiate(1, energy_along, 0.01, &curve, &slope);
        check_close(force[c], -slope, 1e-8 * size);
      }
    }
  }
}

/* The scenes of springs that only pull contain both taut and slack ones, so that the test above covers the
 * switch. */
TEST(test_pull_only_scenes_have_both_sides) {
  int64_t slack = 0, unloaded = 0, taut = 0;
  for (int k = 0; k < LAW_COUNT; k++) {
    if (!laws[k].pull_only) continue;
    for (uint64_t seed = 1; seed <= 5; seed++) {
      owned_law_scene scene;
      law_scene_create(&laws[k], seed, &scene);
      slack += scene.slack;
      unloaded += scene.unloaded;
      taut += scene.taut;
    }
  }
  assert_true(slack >= 10);
  assert_true(unloaded >= 10);
  assert_true(taut >= 10);
}

/* M g and m a: the force is the mass times the acceleration, on free particles. */
TEST(test_force_is_mass_times_acceleration) {
  for (int k = 0; k < LAW_COUNT; k++) {
    owned_law_scene scene;
    double force[LAW_SIZE], acceleration[LAW_SIZE];
    law_scene_create(&laws[k], 77, &scene);
    check_ok(hooke_system_force(scene.system, 0.7, scene.q, scene.v, force));
    check_ok(hooke_system_acceleration(scene.system, 0.7, scene.q, scene.v, acceleration));
    const double *mass = hooke_system_mass(scene.system), size = largest(LAW_SIZE, force);
    for (int c = 0; c < LAW_SIZE - 3; c++)
      check_close(force[c], mass[c / 3] * acceleration[c], 1e-14 * size);
    for (int c = LAW_SIZE - 3; c < LAW_SIZE; c++)
      check_close(acceleration[c], 0.0, 0.0);
  }
}

/* ---- the heat of damping and drag is the loss of energy ---- */

struct motion_curve {
  const hooke_system *system;
  const double *q, *v;
  double acceleration[LAW_SIZE];
};

static void energy_in_time(double s, double *value, void *ctx) {
  const struct motion_curve *curve = ctx;
  double q[LAW_SIZE], v[LAW_SIZE];
  for (int k = 0; k < LAW_SIZE; k++) {
    q[k] = curve->q[k] + s * curve->v[k];
    v[k] = curve->v[k] + s * curve->acceleration[k];
  }
  *value = hooke_system_energy_at(curve->system, "total", LAW_TIME, q, v);
}

TEST(test_dissipated_power) {
  for (int k = 0; k < LAW_COUNT; k++) {
    if (laws[k].callback) continue; /* does work of its own */
    for (uint64_t seed = 1; seed <= 5; seed++) {
      owned_law_scene scene;
      struct motion_curve curve;
      double rate;
      law_scene_create(&laws[k], seed, &scene);
      curve.system = scene.system;
      curve.q = scene.q;
      curve.v = scene.v;
      check_ok(hooke_system_acceleration(scene.system, LAW_TIME, scene.q, scene.v, curve.acceleration));
      differentiate(1, energy_in_time, 0.01, &curve, &rate);
      const double power = hooke_system_dissipated_power_at(scene.system, LAW_TIME, scene.q, scene.v);
      const double size = norm(scene.v) * norm(curve.acceleration);
      check_close(power, -rate, 1e-8 * size);
      if (laws[k].damped || laws[k].drag)
        check_between(power, 1e-3 * size, size * 10.0);
      else
        check_between(power, 0.0, 0.0);
    }
  }
}

/* ---- action and reaction, momentum, angular momentum ---- */

TEST(test_third_law) {
  for (int k = 0; k < LAW_COUNT; k++) {
    if (laws[k].gravity || laws[k].drag || laws[k].callback || laws[k].anchors || laws[k].obstacles) continue;
    for (uint64_t seed = 1; seed <= 5; seed++) {
      owned_law_scene scene;
      double force[LAW_SIZE], sum[3] = {0}, torque[3] = {0}, size = 0.0;
      law_scene_create(&laws[k], seed, &scene);
      check_ok(hooke_system_force(scene.system, 0.0, scene.q, scene.v, force));
      for (int p = 0; p < LAW_PARTICLES; p++) {
        const double *x = scene.q + 3 * p, *f = force + 3 * p;
        for (int a = 0; a < 3; a++) {
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          sum[a] += f[a];
          torque[a] += x[b] * f[c] - x[c] * f[b];
          size += fabs(f[a]);
        }
      }
      assert_true(size > 1.0);
      for (int a = 0; a < 3; a++) {
        check_close(sum[a], 0.0, 1e-14 * size);
        check_close(torque[a], 0.0, 1e-14 * size);
      }
    }
  }
}

/* Springs alone and no constraints: every fixed-step method conserves momentum; symplectic Euler, whose step
 * is q += h v(new), conserves angular momentum; forward Euler changes it by h^2 v x a. */
static void drift(const char *method, double *momentum, double *angular) {
  double q[LAW_SIZE], v[LAW_SIZE], before[6], after[6], mass[LAW_PARTICLES], size = 0.0;
  owned_law_scene scene;
  law_scene_create(&laws[1], 5, &scene);
  memcpy(q, scene.q, sizeof q);
  memcpy(v, scene.v, sizeof v);
  owned_system *system = new_system();
  for (int p = 0; p < LAW_PARTICLES; p++)
    mass[p] = 0.5 + 0.1 * p;
  check_ok(hooke_system_add_particles(system, LAW_PARTICLES, q, v, LAW_PARTICLES, mass, NULL));
  owned_options *options = options_with("springs", "stiffness=20 damping=0.1 rest_scale=0.8");
  check_ok(hooke_system_add_springs(system, NULL, LAW_SPRINGS, scene.ends, options));
  check_ok(hooke_system_commit(system));
  for (int k = 0; k < LAW_SIZE; k++)
    size += mass[k / 3] * fabs(v[k]);

  hooke_system_momentum(system, v, before);
  hooke_system_angular_momentum(system, q, v, before + 3);
  assert_true(largest(3, before) > 0.1 && largest(3, before + 3) > 0.1);
  end_of_run(q, v, system, .method = method, .step = 1e-3, .duration = 1.0);
  hooke_system_momentum(system, v, after);
  hooke_system_angular_momentum(system, q, v, after + 3);
  *momentum = largest_difference(3, before, after) / size;
  *angular = largest_difference(3, before + 3, after + 3) / size;
  assert_true(largest_difference(LAW_SIZE, q, scene.q) > 0.1); /* it did move */
}

TEST(test_momentum) {
  double momentum, angular;
  drift("symplectic-euler", &momentum, &angular);
  check_between(momentum, 0.0, 1e-14);
  check_between(angular, 0.0, 1e-13);
  drift("forward-euler", &momentum, &angular);
  check_between(momentum, 0.0, 1e-14);
  check_between(angular, 1e-6, 1e-1);
}

/* The sums themselves, by hand. */
TEST(test_momentum_of_two) {
  const double q[] = {1, 0, 0, 0, 2, 0, 5, 5, 5}, v[] = {0, 3, 0, 0, 0, 4, 0, 0, 0}, mass[] = {2, 0.5, 9};
  const int64_t pinned = 2;
  double momentum[3], angular[3];
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, 3, q, v, 3, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &pinned));
  check_ok(hooke_system_commit(system));
  hooke_system_momentum(system, v, momentum);
  hooke_system_angular_momentum(system, q, v, angular);
  const double expected[] = {0, 6, 2}, expected_angular[] = {4, 0, 6};
  check_same_bits(3, momentum, expected);
  check_same_bits(3, angular, expected_angular);
  check_close(hooke_system_energy(system, "kinetic", NULL, v), 0.5 * (2 * 9 + 0.5 * 16), 1e-15);
}
