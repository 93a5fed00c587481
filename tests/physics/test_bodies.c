/* Rigid bodies against closed forms: the free body of Euler, the turn of the middle axis, pendulums, pinned
 * axes, and the lattice that a body is the limit of. */
#include "check.h"
#include "elliptic.h"
#include "order.h"
#include "run.h"

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
  hooke_system *system = NULL;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_particles(system, SIX, q, v, 1, &mass, NULL));
  check_ok(hooke_system_add_body(system, "top", SIX, all, 0));
  check_ok(hooke_system_commit(system));
  return system;
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

/* The solution of Euler's equations from (w1, 0, w3) (Landau and Lifshitz, Mechanics, section 37), for L^2 > 2 E I2
 * and, with the first and the last axis exchanged, for L^2 < 2 E I2. Returns the quarter period. */
static double euler(const double start[3], double t, double rotation[3]) {
  double i[3] = {MOMENT[0], MOMENT[1], MOMENT[2]};
  const double e = i[0] * start[0] * start[0] + i[2] * start[2] * start[2];
  const double l = i[0] * i[0] * start[0] * start[0] + i[2] * i[2] * start[2] * start[2];
  const int other = l < e * i[1];
  if (other) i[0] = MOMENT[2], i[2] = MOMENT[0];
  const double rate = sqrt((i[2] - i[1]) * (l - e * i[0]) / (i[0] * i[1] * i[2]));
  const double k = sqrt((i[1] - i[0]) * (e * i[2] - l) / ((i[2] - i[1]) * (l - e * i[0])));
  double sn, cn, dn;
  elliptic_jacobi(rate * t, k, &sn, &cn, &dn);
  rotation[other ? 2 : 0] = sqrt((e * i[2] - l) / (i[0] * (i[2] - i[0]))) * cn;
  rotation[1] = sqrt((e * i[2] - l) / (i[1] * (i[2] - i[1]))) * sn;
  rotation[other ? 0 : 2] = sqrt((l - e * i[0]) / (i[2] * (i[2] - i[0]))) * dn;
  return elliptic_k(k) / rate;
}

static const double START[3] = {0.9, 0.0, 0.8}, AT[3] = {0.3, -0.2, 0.1}, GOING[3] = {0.2, 0.1, -0.3};

/* Largest error of the angular velocities about the body's axes at `time`. */
static double error_of(struct run run) {
  double q[3 * SIX], v[3 * SIX], found[3], expected[3];
  hooke_system *system = free_body(AT, GOING, START);
  run_to_end(system, run, q, v);
  own_rotation(q, v, found);
  euler(START, run.duration, expected);
  hooke_system_destroy(system);
  return largest_difference(3, found, expected);
}

static void free_body_has_the_order_of_its_method(void **unused) {
  (void)unused;
  const struct {
    const char *name;
    double step, low, high;
  } methods[] = {{"forward-euler", 1.0 / 256, 0.9, 1.1},
                 {"symplectic-euler", 1.0 / 64, 1.8, 2.2},
                 {"verlet", 1.0 / 32, 1.9, 2.1},
                 {"heun", 1.0 / 64, 1.9, 2.15},
                 {"rk4", 1.0 / 16, 3.8, 4.3}};
  for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
    double error[4];
    for (int k = 0; k < 4; k++)
      error[k] = error_of((struct run){
          .method = methods[m].name, .step = ldexp(methods[m].step, -k), .duration = 8.0, .every = 8.0});
    check_order(methods[m].name, 4, error, methods[m].low, methods[m].high);
  }
}

/* 100 turns about the axis of largest moment. */
static void reference_follows_jacobi(void **unused) {
  (void)unused;
  const char *const names[] = {"rk8pd", "cvode-adams", "cvode-bdf", "arkode-esdirk"};
  const double bound[] = {1e-8, 1e-7, 1e-6, 1e-5};
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(free_body_has_the_order_of_its_method),
      cmocka_unit_test(reference_follows_jacobi),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
