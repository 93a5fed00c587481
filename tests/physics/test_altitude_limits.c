/* Limits of the step where altitude springs act: bounds, predictions, measurements, and the limiting
 * elements. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static void add_altitude(hooke_system *system, int64_t count, const int64_t *tetrahedra, double stiffness,
                         double damping, double scale) {
  owned_options *options =
      options_with("altitude", "stiffness=%.17g damping=%.17g rest_scale=%.17g", stiffness, damping, scale);
  check_ok(hooke_system_add_altitude(system, "heights", count, tetrahedra, options));
}

/* A particle over a fixed face: one spring of ks/h, whose whole weight is on it. */
TEST(a_top_over_a_held_face) {
  const double q[12] = {0, 0, 0, 1, 0, 0, 0.4, 1, 0, 0.5, 0.4, 0.3}, mass = 0.2;
  const int64_t corners[4] = {0, 1, 2, 3}, held[3] = {0, 1, 2};
  owned_system *system = small_system(4, q, NULL, mass, 0);
  add_altitude(system, 1, corners, 6.0, 0.01, 1.0);
  check_ok(hooke_system_pin(system, 3, held));
  check_ok(hooke_system_commit(system));
  const double omega = sqrt(6.0 / 0.3 / 0.2), rate = 0.01 / 0.3 / 0.2, z = rate / (2.0 * omega);
  check_close(bound_at_start(system, "verlet"), 2.0 / omega, 1e-12);
  check_close(bound_at_start(system, "symplectic-euler"), 2.0 * (sqrt(1.0 + z * z) - z) / omega, 1e-9);
  check_close(bound_at_start(system, "forward-euler"), 0.01 / 6.0, 1e-12);
  owned_measurement *limit = limits_of(system, "forward-euler,symplectic-euler,verlet", 1);
  check_close(hooke_measurement_number(limit, "rows", 0, "predicted"), 0.01 / 6.0, 1e-9);
  check_close(hooke_measurement_number(limit, "rows", 1, "predicted"), 2.0 * (sqrt(1.0 + z * z) - z) / omega,
              1e-9);
  check_close(hooke_measurement_number(limit, "rows", 2, "predicted"), 2.0 / omega, 1e-9);
}

/* Random tetrahedra, some with tension, with springs, drag, and particles of all masses, some of them
 * constrained. */
TEST(random_tetrahedra_run_up_to_the_prediction) {
  for (uint64_t seed = 1; seed <= 12; seed++) {
    enum { N = 9, TETRAHEDRA = 6, SPRINGS = 8 };
    struct random_source source = {seed};
    double q[3 * N], mass[N];
    int64_t tetrahedra[4 * TETRAHEDRA], ends[2 * SPRINGS], pinned = 2;
    for (int k = 0; k < 3 * N; k++)
      q[k] = random_between(&source, -1.0, 1.0);
    for (int p = 0; p < N; p++)
      mass[p] = random_between(&source, 0.3, 3.0);
    for (int k = 0; k < TETRAHEDRA;) {
      int64_t *p = tetrahedra + 4 * k;
      for (int e = 0; e < 4; e++)
        p[e] = random_whole(&source, 0, N - 1);
      k += fabs(volume_of(q, p)) > 0.3;
    }
    for (int k = 0; k < SPRINGS; k++)
      ends[2 * k] = k, ends[2 * k + 1] = k + 1;
    hooke_system *system = new_system();
    check_ok(hooke_system_add_particles(system, N, q, NULL, N, mass, NULL));
    owned_options *springs = options_with("springs", "stiffness=10");
    check_ok(hooke_system_add_springs(system, "springs", SPRINGS, ends, springs));
    add_altitude(system, TETRAHEDRA, tetrahedra, 20.0, seed % 2 ? 0.3 : 0.0, seed % 3 ? 1.0 : 0.8);
    if (seed % 4 == 0) check_ok(hooke_system_pin(system, 1, &pinned));
    if (seed % 3 == 1) check_ok(hooke_system_set_drag(system, 0.3));
    check_ok(hooke_system_commit(system));
    check_limits_met(system, "symplectic-euler,verlet,rk4");
  }
}

/* ---- limiting elements ---- */

/* A straight strand whose altitude springs are its stiffest. */
static hooke_system *new_strand(double altitude) {
  hooke_system *system = new_system();
  owned_options *options = options_with(
      "strand",
      "from=0,0,0 to=1,0,0 segments=12 mass=0.1 pinned=0,1,2 stretch.stiffness=1 altitude.stiffness=%.17g",
      altitude);
  check_ok(hooke_system_add_part(system, "strand", "hair", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(a_limit_by_altitude_names_it) {
  owned_system *system = new_strand(40.0);
  owned_measurement *limit = limits_of(system, "verlet", 1);
  const char *sentence = hooke_measurement_text(limit, "changes", 0, "sentence");
  if (sentence == NULL || strstr(sentence, "group `hair.altitude` has ") == NULL)
    check_failed("%s", sentence);
  assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), "altitude");
  check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.98, 1.0);
  assert_true(isnan(hooke_measurement_number(limit, "blame", 0, "number")));
  for (int64_t k = 1; k < hooke_measurement_row_count(limit, "blame"); k++)
    check_between(hooke_measurement_number(limit, "blame", k, "share"), 0.0, 0.02);
}

TEST(a_run_above_the_limit_is_explained) {
  owned_system *system = new_strand(40.0);
  hooke_measurement *limit = limits_of(system, "verlet", 1);
  const double step = 1.05 * hooke_measurement_number(limit, "rows", 0, "predicted");
  hooke_measurement_destroy(limit);
  owned_integrator *integrator = start_run(
      system, (struct run){.method = "verlet", .step = step, .duration = 5000 * step, .every = 100 * step});
  owned_state *state = start_state(system);
  hooke_state_position(state)[3 * 13 + 1] += 1e-5;
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  owned_measurement *why = NULL;
  check_ok(explain_run(integrator, &why));
  assert_string_equal(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
  const char *sentence = hooke_measurement_text(why, "why", 0, "sentence");
  if (strstr(sentence, "most of all in the altitude springs of particles ") == NULL ||
      strstr(sentence, "(group hair.altitude)") == NULL)
    check_failed("%s", sentence);
}

/* ---- their cost, and variants without them ---- */

TEST(they_are_an_ingredient) {
  owned_system *system = new_strand(0.5);
  owned_options *options = NULL, *run = NULL;
  owned_measurement *cost = NULL;
  options = options_with("cost", "predict=1");
  run = options_with("run", "step=1e-4");
  check_ok(hooke_measurement_create("cost", system, run, options, &cost));
  owned_state *state = start_state(system);
  check_ok(hooke_measurement_run(cost, state));
  int found = 0;
  for (int64_t row = 0; row < hooke_measurement_row_count(cost, "rows"); row++) {
    if (strcmp(hooke_measurement_text(cost, "rows", row, "kind"), "altitude") != 0) continue;
    found++;
    assert_string_equal(hooke_measurement_text(cost, "rows", row, "ingredient"), "hair.altitude");
    assert_true(hooke_measurement_number(cost, "rows", row, "memory_bytes") > 20.0 * 50.0);
    assert_true(isnan(hooke_measurement_number(cost, "rows", row, "springs")));
  }
  assert_int_equal(found, 1);
}
