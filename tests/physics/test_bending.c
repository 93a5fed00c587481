/* Bending: its effects, and what it must not change. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

enum { N = 30, TRIPLES = N - 2 };

/* A line of particles 0.1 m apart with bending alone, or with springs as well; of unequal masses. */
static hooke_system *new_line(double coefficient, double stiffness, double damping, int64_t pinned) {
  double q[3 * N] = {0}, mass[N];
  int64_t triples[3 * TRIPLES], ends[2 * (N - 1)], still[] = {0, 1};
  for (int p = 0; p < N; p++) {
    q[3 * p] = 0.1 * p;
    mass[p] = 0.01 + 0.001 * (p % 4);
  }
  for (int64_t k = 0; k < TRIPLES; k++) {
    for (int64_t e = 0; e < 3; e++)
      triples[3 * k + e] = k + e;
  }
  for (int64_t k = 0; k < N - 1; k++)
    ends[2 * k] = k, ends[2 * k + 1] = k + 1;
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, N, q, NULL, N, mass, NULL));
  if (coefficient > 0.0)
    check_ok(hooke_system_add_bending(system, "line", TRIPLES, triples, 1, &coefficient));
  if (stiffness > 0.0) {
    owned_options *options = options_with("springs", "stiffness=%.17g damping=%.17g", stiffness, damping);
    check_ok(hooke_system_add_springs(system, "springs", N - 1, ends, options));
  }
  check_ok(hooke_system_pin(system, pinned, still));
  return system;
}

static hooke_system *commit(hooke_system *system) {
  return committed(system);
}

/* A straight line with equal distances has no bending force under any affine map; a bend has. */
TEST(straight_lines_have_no_force) {
  struct random_source source = {5};
  const double still[3 * N] = {0};
  owned_system *system = commit(new_line(3.0, 0.0, 0.0, 0));
  for (int trial = 0; trial < 50; trial++) {
    double from[3], along[3], q[3 * N], force[3 * N];
    for (int a = 0; a < 3; a++) {
      from[a] = random_between(&source, -5.0, 5.0);
      along[a] = random_between(&source, -1.0, 1.0);
    }
    for (int k = 0; k < 3 * N; k++)
      q[k] = from[k % 3] + (k / 3) * along[k % 3];
    check_ok(hooke_system_force(system, 0.0, q, still, force));
    check_between(largest(3 * N, force), 0.0, 3.0 * 40.0 * 8.0 * 2.3e-16);
    check_between(hooke_system_energy(system, "bending", q, NULL), 0.0, 1e-25);
    q[31] += 0.01;
    check_ok(hooke_system_force(system, 0.0, q, still, force));
    check_close(force[31], -6.0 * 3.0 * 0.01, 1e-12);
    check_close(hooke_system_energy(system, "bending", q, NULL), 0.5 * 3.0 * 6.0 * 1e-4, 1e-13);
  }
}

/* Energies add up, and each counts its own force only. */
TEST(energies_are_apart) {
  double q[3 * N];
  owned_system *both = commit(new_line(3.0, 20.0, 0.0, 0)), *bends = commit(new_line(3.0, 0.0, 0.0, 0)),
               *springs = commit(new_line(0.0, 20.0, 0.0, 0));
  for (int k = 0; k < 3 * N; k++)
    q[k] = 0.1 * sin(0.7 * k) + (k % 3 == 0 ? 0.1 * (k / 3) : 0.0);
  const double u = hooke_system_energy(springs, "springs", q, NULL),
               b = hooke_system_energy(bends, "bending", q, NULL);
  assert_true(u > 1e-3 && b > 1e-3);
  check_close(hooke_system_energy(both, "springs", q, NULL), u, 0.0);
  check_close(hooke_system_energy(both, "bending", q, NULL), b, 0.0);
  check_close(hooke_system_energy(both, "potential", q, NULL), u + b, 1e-15 * (u + b));
  check_close(hooke_system_energy(bends, "springs", q, NULL), 0.0, 0.0);
  check_close(hooke_system_energy(springs, "bending", q, NULL), 0.0, 0.0);
  assert_int_equal(hooke_system_count(both, "forces"), 2);
  assert_string_equal(hooke_system_force_name(both, 0), "springs");
  assert_string_equal(hooke_system_force_name(both, 1), "bending");
}

/* ---- motion ---- */

static void kick(double *q, double *v) {
  struct random_source source = {8};
  for (int k = 0; k < 3 * N; k++) {
    q[k] = (k % 3 == 0 ? 0.1 * (k / 3) : 0.0) + random_between(&source, -0.01, 0.01);
    v[k] = random_between(&source, -0.1, 0.1);
  }
}

static void run_from(const hooke_system *system, struct run run, double *q, double *v) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  memcpy(hooke_state_position(state), q, 3 * N * sizeof(double));
  memcpy(hooke_state_velocity(state), v, 3 * N * sizeof(double));
  check_ok(hooke_integrator_run(integrator, state));
  memcpy(q, hooke_state_position(state), 3 * N * sizeof(double));
  memcpy(v, hooke_state_velocity(state), 3 * N * sizeof(double));
}

/* Relative error of the energy after a second. */
static double energy_error(const hooke_system *system, double step) {
  double q[3 * N], v[3 * N];
  kick(q, v);
  const double before = hooke_system_energy(system, "total", q, v);
  run_from(system, (struct run){.method = "verlet", .step = step, .duration = 1.0, .every = 1.0}, q, v);
  return fabs(hooke_system_energy(system, "total", q, v) - before) / before;
}

TEST(verlet_keeps_the_energy) {
  owned_system *system = commit(new_line(3.0, 20.0, 0.0, 0));
  const double coarse = energy_error(system, 1e-3), fine = energy_error(system, 1e-4);
  check_between(coarse, 1e-6, 1e-2);
  check_between(fine / coarse, 0.001, 0.05);
}

TEST(momenta_stay) {
  double q[3 * N], v[3 * N], before[6], after[6];
  owned_system *system = commit(new_line(3.0, 20.0, 0.05, 0));
  kick(q, v);
  hooke_system_momentum(system, v, before);
  hooke_system_angular_momentum(system, q, v, before + 3);
  run_from(system, (struct run){.method = "symplectic-euler", .step = 1e-4, .duration = 1.0, .every = 1.0}, q,
           v);
  hooke_system_momentum(system, v, after);
  hooke_system_angular_momentum(system, q, v, after + 3);
  assert_true(largest(6, before) > 1e-3);
  check_between(largest_difference(6, before, after), 0.0, 1e-14);
}

/* Every method agrees with Runge-Kutta with a fine step. */
TEST(methods_agree) {
  owned_system *system = commit(new_line(3.0, 20.0, 0.02, 2));
  double expected[3 * N], expected_v[3 * N];
  kick(expected, expected_v);
  for (int k = 0; k < 6; k++) {
    expected[k] = k == 3 ? 0.1 : 0.0;
    expected_v[k] = 0.0;
  }
  double q0[3 * N], v0[3 * N];
  memcpy(q0, expected, sizeof q0);
  memcpy(v0, expected_v, sizeof v0);
  run_from(system, (struct run){.method = "rk4", .step = 5e-5, .duration = 0.1, .every = 0.1}, expected,
           expected_v);
  assert_true(largest_difference(3 * N, q0, expected) > 5e-3);
  for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
    struct run run = {.method = method, .duration = 0.1, .every = 0.1};
    const int first_order = strstr(method, "euler") != NULL;
    if (hooke_method_is_adaptive(method))
      run.rtol = 1e-9, run.atol = 1e-11;
    else
      run.step = 1e-5;
    double q[3 * N], v[3 * N];
    memcpy(q, q0, sizeof q);
    memcpy(v, v0, sizeof v);
    run_from(system, run, q, v);
    const double error = largest_difference(3 * N, q, expected);
    if (error > (first_order ? 2e-4 : 1e-6)) check_failed("%s is off by %g", method, error);
  }
}

/* ---- numbers ---- */

TEST(explicit_triples_come_first) {
  const double q[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, mass = 1.0, c[4] = {2.0, 0.0, 3.0, 0.0};
  const int64_t triples[12] = {2, 0, 1, 0, 1, 2, 1, 2, 0, 0, 1, 2};
  owned_system *system = small_system(3, q, NULL, mass, 0);
  owned_options *rope = options_with("rope", "from=0,0,0 to=4,0,0 segments=4 mass=1 bending=5");
  check_ok(hooke_system_add_part(system, "rope", "r", rope, NULL, NULL));
  check_ok(hooke_system_add_bending(system, "mine", 4, triples, 4, c));
  check_ok(hooke_system_add_bending(system, NULL, 1, triples, 1, c + 1));
  assert_int_equal(hooke_system_count(system, "bending"), 8);
  int64_t found[15];
  double coefficient[5];
  check_status(hooke_system_members(system, "bending", found, NULL, NULL, NULL), HOOKE_BAD_CALL);
  check_status(hooke_system_members(system, "bending", NULL, coefficient, NULL, NULL), HOOKE_BAD_CALL);
  assert_true(isnan(hooke_system_energy(system, "bending", q, NULL)));
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "bending"), 5);
  assert_int_equal(hooke_system_group_count(system, "bending"), 3);
  assert_string_equal(hooke_system_group_name(system, "bending", 0), "mine");
  assert_string_equal(hooke_system_group_name(system, "bending", 1), "");
  assert_string_equal(hooke_system_group_name(system, "bending", 2), "r.bending");
  assert_null(hooke_system_group_name(system, "bending", 3));
  assert_int_equal(hooke_system_group_size(system, "bending", 0), 2);
  assert_int_equal(hooke_system_group_size(system, "bending", 1), 0);
  assert_int_equal(hooke_system_group_size(system, "bending", 2), 3);
  assert_int_equal(hooke_system_group_count(system, "springs"), 0); /* of springs */
  check_ok(hooke_system_members(system, "bending", found, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "bending", NULL, coefficient, NULL, NULL));
  const int64_t expected[15] = {2, 0, 1, 1, 2, 0, 3, 4, 5, 4, 5, 6, 5, 6, 7};
  assert_memory_equal(found, expected, sizeof expected);
  const double kept[5] = {2.0, 3.0, 5.0, 5.0, 5.0};
  check_same_bits(5, coefficient, kept);
}

/* Bending without stiffness adds no force and no memory, and changes no bit. */
TEST(no_stiffness_is_no_bending) {
  const double zero = 0.0;
  int64_t triples[3 * TRIPLES];
  for (int64_t k = 0; k < 3 * TRIPLES; k++)
    triples[k] = k / 3 + k % 3;
  owned_system *with = new_line(0.0, 20.0, 0.1, 0), *without = commit(new_line(0.0, 20.0, 0.1, 0));
  check_ok(hooke_system_add_bending(with, "none", TRIPLES, triples, 1, &zero));
  commit(with);
  assert_int_equal(hooke_system_count(with, "forces"), 1);
  assert_int_equal(hooke_system_count(with, "bending"), 0);
  check_between((double)(hooke_system_count(with, "memory") - hooke_system_count(without, "memory")), 0.0,
                152.0); /* the record of a group */
  double q[3 * N], v[3 * N], other_q[3 * N], other_v[3 * N];
  kick(q, v);
  memcpy(other_q, q, sizeof q);
  memcpy(other_v, v, sizeof v);
  const struct run run = {.method = "symplectic-euler", .step = 1e-4, .duration = 0.1, .every = 0.1};
  run_from(with, run, q, v);
  run_from(without, run, other_q, other_v);
  check_same_bits(3 * N, q, other_q);
  owned_system *bending = commit(new_line(1.0, 20.0, 0.1, 0));
  assert_true(hooke_system_count(bending, "memory") > hooke_system_count(with, "memory"));
}

TEST(bad_triples_are_refused) {
  owned_system *system = new_line(1.0, 0.0, 0.0, 0);
  const double one = 1.0, two[2] = {1.0, -2.0};
  const int64_t fine[6] = {0, 1, 2, 1, 2, 3}, far[3] = {0, 30, 1}, twice[6] = {0, 1, 2, 3, 4, 3};
  check_status(hooke_system_add_bending(system, "b", 1, far, 1, &one), HOOKE_BAD_VALUE);
  check_message("triples[0][1]: there is no particle 30; allowed: 0 to 29, as numbers begin at 0");
  check_status(hooke_system_add_bending(system, "b", 2, twice, 1, &one), HOOKE_BAD_VALUE);
  check_message("triples[1]: particles 3, 4 and 3");
  check_status(hooke_system_add_bending(system, "b", 2, fine, 2, two), HOOKE_BAD_VALUE);
  check_message("coefficient[1]: -2 is not allowed");
  check_status(hooke_system_add_bending(system, "b", 2, fine, 3, two), HOOKE_BAD_VALUE);
  check_message("3 values for 2 triples");
  check_status(hooke_system_add_bending(system, "b", 2, fine, 1, (double[]){NAN}), HOOKE_BAD_VALUE);
  check_status(hooke_system_add_bending(system, "b", -1, fine, 1, &one), HOOKE_BAD_VALUE);
  assert_int_equal(hooke_system_group_count(system, "bending"), 1);
  commit(system);
  check_status(hooke_system_add_bending(system, "b", 2, fine, 1, &one), HOOKE_BAD_CALL);
}
