/* Particles with prescribed motion: harmonic, table and callback, checked at frames of every method. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double TWO_PI = 6.28318530717958647693;

/* A driven particle 0 with a mass on a spring that follows it. */
static hooke_system *driven_pair(void) {
  const double q[] = {0.25, -0.5, 1.0, 1.25, -0.5, 1.0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, q, NULL, 1.0, 0);
  springs_with(system, 1, ends, .stiffness = 40, .damping = 0.5, .rest_length = 1);
  return system;
}

/* ---- position of a driven particle at time t ---- */

typedef void expected_motion(double t, double *q, double *v);

struct watch {
  expected_motion *motion;
  int64_t frames;
};

static int32_t compare_motion(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  double q[3], v[3];
  (void)step;
  watch->motion(hooke_state_time(state), q, v);
  for (int a = 0; a < 3; a++) {
    check_close(hooke_state_position(seen)[a], q[a], 1e-14);
    check_close(hooke_state_velocity(seen)[a], v[a], 2e-13);
  }
  watch->frames++;
  return 0;
}

static void follow(hooke_system *system, expected_motion *motion) {
  check_ok(hooke_system_commit(system));
  for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
    struct watch watch = {motion, 0};
    double before[6];
    owned_run(integrator, state, system, .method = method, .step = 1e-3, .duration = 2.0, .every = 0.01);
    memcpy(before, hooke_state_position(state), sizeof before);
    check_ok(hooke_integrator_on_frame(integrator, compare_motion, &watch));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(watch.frames, 201);
    assert_true(largest_difference(3, before + 3, hooke_state_position(state) + 3) >
                1e-2); /* the mass follows */
  }
  hooke_system_destroy(system);
}

/* ---- harmonic ---- */

static void harmonic_motion(double t, double *q, double *v) {
  const double origin[] = {0.25, -0.5, 1.0}, amplitude[] = {0.3, 0.0, -0.1};
  const double angle = TWO_PI * 1.7 * t + 0.6;
  for (int a = 0; a < 3; a++) {
    q[a] = origin[a] + amplitude[a] * sin(angle);
    v[a] = amplitude[a] * (TWO_PI * 1.7) * cos(angle);
  }
}

TEST(test_harmonic) {
  const double amplitude[] = {0.3, 0.0, -0.1};
  const int64_t driven = 0;
  hooke_system *system = driven_pair();
  check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 1.7, 0.6));
  follow(system, harmonic_motion);
}

/* ---- callback ---- */

static void callback_motion(double t, double *q, double *v) {
  q[0] = 0.25 + 0.1 * t, v[0] = 0.1;
  q[1] = -0.5 + t * t * 0.05, v[1] = 0.1 * t;
  q[2] = 1.0, v[2] = 0.0;
}

static int32_t callback_drive(int64_t count, double t, double *q, double *v, void *ctx) {
  assert_int_equal(count, 1);
  ++*(int64_t *)ctx;
  callback_motion(t, q, v);
  return 0;
}

TEST(test_callback) {
  int64_t calls = 0;
  const int64_t driven = 0;
  hooke_system *system = driven_pair();
  check_ok(hooke_system_drive_callback(system, 1, &driven, callback_drive, &calls));
  follow(system, callback_motion);
  assert_true(calls > 2000);
}

/* ---- table ---- */

enum { SAMPLES = 5 };
static const double table_time[SAMPLES] = {0.25, 0.5, 1.0, 1.125, 1.5};
static const double table_place[SAMPLES][3] = {
    {0, 0, 0}, {0.1, 0.2, 0}, {0.3, -0.1, 0.0625}, {0.25, 0.0, 0.1}, {0.5, 0.4, -0.3}};

/* Slope at sample k: the parabola through it and its neighbours, written as Lagrange wrote it. */
static double table_slope(int k, int a) {
  const int i = k == 0 ? 0 : k == SAMPLES - 1 ? SAMPLES - 3 : k - 1;
  const double *t = table_time + i, x = table_time[k];
  const double p0 = table_place[i][a], p1 = table_place[i + 1][a], p2 = table_place[i + 2][a];
  return p0 * (2 * x - t[1] - t[2]) / ((t[0] - t[1]) * (t[0] - t[2])) +
         p1 * (2 * x - t[0] - t[2]) / ((t[1] - t[0]) * (t[1] - t[2])) +
         p2 * (2 * x - t[0] - t[1]) / ((t[2] - t[0]) * (t[2] - t[1]));
}

/* The cubic between two samples in Hermite's basis. */
static void table_motion(double t, double *q, double *v) {
  const double origin[] = {0.25, -0.5, 1.0};
  int k = 0;
  while (k < SAMPLES - 2 && table_time[k + 1] <= t)
    k++;
  for (int a = 0; a < 3; a++) {
    if (t <= table_time[0] || t >= table_time[SAMPLES - 1]) {
      q[a] = origin[a] + table_place[t <= table_time[0] ? 0 : SAMPLES - 1][a];
      v[a] = 0.0;
      continue;
    }
    const double w = table_time[k + 1] - table_time[k], s = (t - table_time[k]) / w;
    const double p0 = table_place[k][a], p1 = table_place[k + 1][a];
    const double m0 = w * table_slope(k, a), m1 = w * table_slope(k + 1, a);
    q[a] = origin[a] + (1 + 2 * s) * (1 - s) * (1 - s) * p0 + s * (1 - s) * (1 - s) * m0 +
           s * s * (3 - 2 * s) * p1 - s * s * (1 - s) * m1;
    v[a] = (6 * s * (s - 1) * (p0 - p1) + (1 - s) * (1 - 3 * s) * m0 + s * (3 * s - 2) * m1) / w;
  }
}

TEST(test_table) {
  const int64_t driven = 0;
  hooke_system *system = driven_pair();
  check_ok(hooke_system_drive_table(system, 1, &driven, SAMPLES, table_time, &table_place[0][0]));
  follow(system, table_motion);
}

/* Position and velocity of the driven particle at time t, from the state after a step that ends there. */
static void place_at(const hooke_system *system, double t, double *q, double *v) {
  const double h = 0x1p-10;
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = h);
  hooke_state_set_time(state, t - h);
  check_ok(hooke_integrator_step(integrator, state, 1));
  memcpy(q, hooke_state_position(state), 3 * sizeof(double));
  memcpy(v, hooke_state_velocity(state), 3 * sizeof(double));
}

/* At inner samples the position is the sample, and the velocity the same from both sides. */
TEST(test_table_is_smooth) {
  const int64_t driven = 0;
  const double origin[] = {0.25, -0.5, 1.0}, near = 1e-9;
  owned_system *system = driven_pair();
  check_ok(hooke_system_drive_table(system, 1, &driven, SAMPLES, table_time, &table_place[0][0]));
  check_ok(hooke_system_commit(system));
  for (int k = 0; k < SAMPLES; k++) {
    double q[3], v[3], left_q[3], left_v[3], right_q[3], right_v[3];
    place_at(system, table_time[k], q, v);
    place_at(system, table_time[k] - near, left_q, left_v);
    place_at(system, table_time[k] + near, right_q, right_v);
    for (int a = 0; a < 3; a++) {
      check_close(q[a], origin[a] + table_place[k][a], 1e-15);
      check_close(left_q[a], right_q[a], 1e-8);
      if (k == 0 || k == SAMPLES - 1) continue;
      check_close(v[a], table_slope(k, a), 1e-13);
      check_close(left_v[a], right_v[a], 1e-6);
    }
  }
}

/* The velocity of every drive is the derivative of its position. */
TEST(test_velocity_is_derivative) {
  const int64_t driven[] = {0, 1};
  const double amplitude[] = {0.3, 0.2, -0.1};
  hooke_system *systems[2] = {driven_pair(), driven_pair()};
  check_ok(hooke_system_drive_table(systems[0], 1, driven, SAMPLES, table_time, &table_place[0][0]));
  check_ok(hooke_system_drive_harmonic(systems[1], 2, driven, amplitude, 12.5, -2.0));
  for (int k = 0; k < 2; k++) {
    check_ok(hooke_system_commit(systems[k]));
    for (double t = 0.26; t < 1.48; t += 0.0617) {
      double q[3], v[3], later[3], earlier[3], other[3];
      place_at(systems[k], t, q, v);
      place_at(systems[k], t + 1e-5, later, other);
      place_at(systems[k], t - 1e-5, earlier, other);
      for (int a = 0; a < 3; a++)
        check_close((later[a] - earlier[a]) / 2e-5, v[a], 1e-5);
    }
    hooke_system_destroy(systems[k]);
  }
}
