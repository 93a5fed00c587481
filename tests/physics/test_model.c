/* Behaviour of springs, drag, pins and cables. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>

/* ---- coincident ends, and springs without length ---- */

TEST(test_coincident_ends) {
  const double q[] = {0, 0, 0, 1, 2, 3, 1, 2, 3, 4, 2, 3}, v[] = {0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0};
  const int64_t ends[] = {1, 2, 2, 1, 2, 3};
  double a[12];
  owned_system *system = small_system(4, q, v, 1.0, 1);
  springs_with(system, 2, ends, .stiffness = 100, .damping = 5, .rest_length = 0.5);
  springs_with(system, 1, ends + 4, .stiffness = 100, .rest_length = 3.0);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_coincident_springs(system, q), 2);
  check_ok(hooke_system_acceleration(system, 0.0, q, v, a));
  for (int k = 0; k < 12; k++)
    check_close(a[k], 0.0, 0.0); /* the third spring is at rest */

  /* the run counts them too, and there are none once the ends have parted */
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 1e-3);
  check_ok(hooke_integrator_step(integrator, state, 1));
  assert_int_equal(hooke_integrator_count(integrator, "coincident_springs"), 2);
  check_ok(hooke_integrator_step(integrator, state, 1));
  assert_int_equal(hooke_integrator_count(integrator, "coincident_springs"), 0);
  assert_int_equal(hooke_system_coincident_springs(system, hooke_state_position(state)), 0);
  for (int k = 0; k < 12; k++)
    assert_true(isfinite(hooke_state_position(state)[k]));
}

/* With rest length 0 the force is -k x everywhere: smooth at the origin, and not counted as coincident. */
TEST(test_springs_without_length) {
  hooke_system *system = small_oscillator(3.0); /* mass 2: k = 18 */
  const double v[6] = {0}, zero[6] = {0};
  double q[6] = {0, 0, 0, 0.3, -0.4, 1.2}, force[6];
  check_ok(hooke_system_force(system, 0.0, q, v, force));
  for (int k = 0; k < 3; k++) {
    check_close(force[3 + k], -18.0 * q[3 + k], 1e-14);
    check_close(force[k], 18.0 * q[3 + k], 1e-14);
  }
  check_close(hooke_system_energy(system, "springs", q, NULL), 0.5 * 18.0 * 1.69, 1e-14);
  assert_int_equal(hooke_system_coincident_springs(system, zero), 0);
  check_ok(hooke_system_force(system, 0.0, zero, v, force));
  for (int k = 0; k < 6; k++)
    check_close(force[k], 0.0, 0.0);
  hooke_system_destroy(system);
}

/* ---- drag slows free fall, damping along the spring does not ---- */

/* Velocity and height of the centre of two falling masses after n steps of symplectic Euler. */
static void fall(double damping, double drag, double h, int64_t steps, double *velocity, double *height) {
  const double q[] = {0, 0, 0, 1, 0.3, 0}, v[] = {0, 0, 0, 0, 0, 2}, gravity[] = {0, -10, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, v, 0.5, 0);
  springs_with(system, 1, ends, .stiffness = 20, .damping = damping, .rest_length = 0.7);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, drag));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = h);
  check_ok(hooke_integrator_step(integrator, state, steps));
  const double *x = hooke_state_position(state), *u = hooke_state_velocity(state);
  *height = 0.5 * (x[1] + x[4]) - 0.15;
  *velocity = 0.5 * (u[1] + u[4]);
}

TEST(test_drag_or_damping) {
  const double h = 1e-3, n = 1000.0, factor = 1.0 - 1.5 * h / 0.5;
  double velocity, height;
  fall(0.0, 0.0, h, 1000, &velocity, &height);
  check_close(velocity, -10.0 * n * h, 1e-11);
  check_close(height, -10.0 * h * h * n * (n + 1.0) / 2.0, 1e-11);
  fall(3.0, 0.0, h, 1000, &velocity, &height); /* damped, and falls in the same way */
  check_close(velocity, -10.0 * n * h, 1e-11);
  check_close(height, -10.0 * h * h * n * (n + 1.0) / 2.0, 1e-11);
  fall(0.0, 1.5, h, 1000, &velocity, &height); /* v' = (1 - c h/m) v - g h */
  check_close(velocity, -10.0 * h * (1.0 - pow(factor, n)) / (1.0 - factor), 1e-11);
  assert_true(height > -10.0 * 0.5 * 0.6);
}

/* ---- a hanging rubber band ---- */

/* Length at rest of a band of mass 0.4 kg and unit rest length with 0.2 kg at its end, cut into `segments`.
 * Each segment has half its mass at either end, so that the exact stretch is (0.2 + 0.4/2) g / ks for any
 * number of segments. */
static double hanging_length(const char *law, int64_t segments, double step) {
  const double gravity[] = {0, 0, -10}, piece = 1.0 / (double)segments;
  owned_doubles *q = new_doubles(3 * (segments + 1)), *mass = new_doubles(segments + 1);
  int64_t *ends = new_block(2 * segments, (int64_t)sizeof(int64_t)), first = 0;
  for (int64_t k = 0; k <= segments; k++) {
    q[3 * k + 2] = -(double)k * piece;
    mass[k] = 0.4 * piece;
  }
  for (int64_t k = 0; k < 2 * segments; k++)
    ends[k] = (k + 1) / 2;
  mass[segments] = 0.2 * piece + 0.2;
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, segments + 1, q, NULL, segments + 1, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &first));
  springs_with(system, segments, ends, .law = law, .stiffness = 16, .damping = 1.2, .rest_length = piece);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = step);
  check_ok(hooke_integrator_step(integrator, state, 500000));
  const double length = -hooke_state_position(state)[3 * segments + 2];
  check_between(largest(3 * (segments + 1), hooke_state_velocity(state)), 0.0, 1e-6); /* it hangs still */
  free(ends);
  return length;
}

TEST(test_stretch_does_not_depend_on_resolution) {
  const int64_t segments[] = {1, 2, 8, 64};
  for (int k = 0; k < 4; k++)
    check_close(hanging_length("strain", segments[k], 2e-5), 1.0 + 4.0 / 16.0, 1e-6);
}

/* By the length law n springs in a row give n times the stretch. */
TEST(test_stretch_by_the_length_law) {
  check_close(hanging_length("length", 1, 5e-5), 1.0 + 4.0 / 16.0, 1e-6);
  check_close(hanging_length("length", 2, 5e-5), 1.0 + 2.0 * 4.0 / 16.0, 1e-6);
}

/* ---- pinned particles and cables ---- */

TEST(test_pinned_never_move) {
  const double q[] = {0.1, 0.2, 0.3, 1, 1, 1, -1, 0.5, 2}, gravity[] = {1, 2, 3}, zero[3] = {0};
  const int64_t ends[] = {0, 1, 1, 2, 2, 0};
  for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
    double end[9], speed[9];
    owned_system *system = small_system(3, q, NULL, 1.0, 1);
    springs_with(system, 3, ends, .stiffness = 30, .damping = 0.3, .rest_length = 0.4);
    check_ok(hooke_system_set_gravity(system, gravity));
    check_ok(hooke_system_set_drag(system, 0.1));
    check_ok(hooke_system_commit(system));
    assert_int_equal(hooke_system_count(system, "free"), 2);
    end_of_run(end, speed, system, .method = method, .step = 1e-3, .duration = 1.0);
    check_same_bits(3, end, q);
    check_same_bits(3, speed, zero);
    assert_true(fabs(end[3] - q[3]) > 1e-2);
  }
}

/* A slack cable lets its ends pass, with damping or without; a taut one is a spring. */
TEST(test_cables) {
  const int64_t ends[] = {0, 1};
  const struct {
    double distance, velocity, pull; /* force on the first end, along the second */
  } cases[] = {
      {0.9, 0.0, 0.0}, /* slack */
      {0.9, 5.0, 0.0}, /* slack, ends separating: damping does not pull */
      {1.0, 5.0, 0.0}, /* at its rest length still slack */
      {1.2, 0.0, 20.0},        {1.2, 1.0, 20.0 + 3.0},
      {1.2, -1.0, 20.0 - 3.0}, {1.2, -7.0, 0.0}, /* damping would make it push */
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const double q[] = {0, 0, 0, cases[k].distance, 0, 0}, v[] = {0, 0, 0, cases[k].velocity, 0, 0};
    double force[6];
    owned_system *system = small_system(2, q, v, 1.0, 0);
    springs_with(system, 1, ends, .law = "length", .stiffness = 100, .damping = 3, .rest_length = 1,
                 .pull_only = 1);
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_force(system, 0.0, q, v, force));
    check_close(force[0], cases[k].pull, cases[k].pull == 0.0 ? 0.0 : 1e-13);
    check_close(force[3], -cases[k].pull, cases[k].pull == 0.0 ? 0.0 : 1e-13);
    const double stretch = fmax(0.0, cases[k].distance - 1.0);
    check_close(hooke_system_energy(system, "springs", q, NULL), 50.0 * stretch * stretch, 1e-14);
  }
}

/* A scene pays only for the forces that it names. */
TEST(test_forces_that_are_there) {
  const double q[] = {0, 0, 0, 1, 0, 0}, gravity[] = {0, -1, 0};
  owned_system *empty = small_system(2, q, NULL, 1.0, 0), *full = small_system(2, q, NULL, 1.0, 0);
  const int64_t ends[] = {0, 1};
  springs_with(full, 1, ends, .stiffness = 1, .rest_length = -1);
  check_ok(hooke_system_set_gravity(full, gravity));
  check_ok(hooke_system_set_drag(full, 0.5));
  check_ok(hooke_system_commit(empty));
  check_ok(hooke_system_commit(full));
  assert_int_equal(hooke_system_count(empty, "forces"), 0);
  assert_null(hooke_system_force_name(empty, 0));
  const char *expected[] = {"springs", "drag", "gravity"};
  assert_int_equal(hooke_system_count(full, "forces"), 3);
  for (int64_t k = 0; k < 3; k++)
    assert_string_equal(hooke_system_force_name(full, k), expected[k]);
  assert_null(hooke_system_force_name(full, 3));
}

/* Without damping velocities are not read: not even a NaN there affects the forces. */
TEST(test_velocities_are_not_read) {
  const double q[] = {0, 0, 0, 1, 0.5, 0}, lost[] = {NAN, NAN, NAN, NAN, NAN, NAN};
  const int64_t ends[] = {0, 1};
  double force[6];
  for (int damped = 0; damped < 2; damped++) {
    owned_system *system = small_system(2, q, NULL, 1.0, 0);
    springs_with(system, 1, ends, .stiffness = 10, .damping = damped, .rest_length = 0.5);
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_force(system, 0.0, q, lost, force));
    assert_int_equal(isfinite(force[0]) != 0, !damped);
  }
}
