/* Limits of the step with bending: bounds, predictions, measurements, and the limiting elements. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* A rope of `segments` pieces of 0.1 m and 0.01 kg a particle, whose springs are soft (or are not there). */
static hooke_system *new_rope(int segments, double bending, double stiffness, double damping, double drag) {
  hooke_system *system = new_system();
  owned_options *rope =
      options_with("rope", "from=0,0,0 to=%.17g,0,0 segments=%d mass=%.17g bending=%.17g pinned=0,1",
                   0.1 * segments, segments, 0.01 * (segments + 1), bending);
  if (stiffness > 0.0)
    set_options(rope, "stretch.stiffness=%.17g stretch.damping=%.17g stretch.rest_scale=0.9", stiffness,
                damping);
  check_ok(hooke_system_add_part(system, "rope", "beam", rope, NULL, NULL));
  check_ok(hooke_system_set_drag(system, drag));
  check_ok(hooke_system_commit(system));
  return system;
}

/* The row sum of a particle far from the ends is 16 c, and a long beam comes arbitrarily close to it. */
TEST(a_beam_is_bounded_by_its_middle) {
  const double c = 0.5 / (0.1 * 0.1 * 0.1), slowest = 2.0 / sqrt(16.0 * c / 0.01);
  owned_system *beam = new_rope(100, 0.5, 0.0, 0.0, 0.0), *short_one = new_rope(2, 0.5, 0.0, 0.0, 0.0);
  check_close(bound_at_start(beam, "verlet"), slowest, 1e-12 * slowest);
  check_close(bound_at_start(beam, "symplectic-euler"), slowest, 1e-9 * slowest);
  check_close(bound_at_start(beam, "rk4"), 2.6156 / 2.0 * slowest, 1e-12 * slowest);
  check_between(bound_at_start(beam, "forward-euler"), 0.0, 0.0);
  /* one free particle, the third of a triple whose others are constrained: k = c */
  check_close(bound_at_start(short_one, "verlet"), 2.0 / sqrt(c / 0.01), 1e-12);
}

/* Damped springs do not damp bending: forward Euler has only the drag. */
TEST(forward_euler_needs_drag) {
  owned_system *without = new_rope(20, 0.5, 5.0, 0.1, 0.0), *with = new_rope(20, 0.5, 5.0, 0.1, 0.3);
  check_between(bound_at_start(without, "forward-euler"), 0.0, 0.0);
  check_between(bound_at_start(with, "forward-euler"), 1e-9, 1.0);
}

/* ---- predicted and measured ---- */

TEST(limits_are_met) {
  check_limits_met(new_rope(3, 0.5, 0.0, 0.0, 0.0), "symplectic-euler,verlet,rk4");
  check_limits_met(new_rope(25, 0.5, 0.0, 0.0, 0.0), "symplectic-euler,verlet,rk4");
  check_limits_met(new_rope(25, 0.5, 40.0, 0.0, 0.0), "symplectic-euler,verlet,rk4");
  check_limits_met(new_rope(25, 0.5, 40.0, 0.02, 0.1), "symplectic-euler,verlet,rk4");
  check_limits_met(new_rope(25, 0.01, 100.0, 0.2, 0.0), "symplectic-euler,verlet,rk4");
  check_limits_met(new_rope(300, 0.5, 10.0, 0.0, 0.0), "symplectic-euler,verlet");
}

/* Random triples, with springs and particles of all masses, some of them constrained. */
TEST(random_triples_run_up_to_the_prediction) {
  for (uint64_t seed = 1; seed <= 20; seed++) {
    enum { N = 9, TRIPLES = 10, SPRINGS = 8 };
    struct random_source source = {seed};
    double q[3 * N], mass[N], c[TRIPLES];
    int64_t triples[3 * TRIPLES], ends[2 * SPRINGS], pinned = 2;
    for (int k = 0; k < 3 * N; k++)
      q[k] = random_between(&source, -1.0, 1.0);
    for (int p = 0; p < N; p++)
      mass[p] = random_between(&source, 0.3, 3.0);
    for (int k = 0; k < TRIPLES; k++) {
      triples[3 * k] = random_whole(&source, 0, N - 1);
      for (int e = 1; e < 3; e++)
        triples[3 * k + e] = (triples[3 * k + e - 1] + random_whole(&source, 1, 4)) % N;
      c[k] = random_between(&source, 1.0, 20.0);
    }
    for (int k = 0; k < SPRINGS; k++)
      ends[2 * k] = k, ends[2 * k + 1] = k + 1;
    hooke_system *system = new_system();
    check_ok(hooke_system_add_particles(system, N, q, NULL, N, mass, NULL));
    owned_options *springs = options_with("springs", "stiffness=20 rest_scale=%.17g", seed % 3 ? 0.9 : 1.1);
    check_ok(hooke_system_add_springs(system, "springs", SPRINGS, ends, springs));
    check_ok(hooke_system_add_bending(system, "bends", TRIPLES, triples, TRIPLES, c));
    if (seed % 4 == 0) check_ok(hooke_system_pin(system, 1, &pinned));
    if (seed % 2) check_ok(hooke_system_set_drag(system, 0.3));
    check_ok(hooke_system_commit(system));
    check_limits_met(system, "symplectic-euler,verlet,rk4");
  }
}

/* ---- limiting elements ---- */

TEST(a_limit_by_bending_names_it) {
  owned_system *system = new_rope(40, 0.5, 1.0, 0.0, 0.0);
  owned_measurement *limit = limits_of(system, "verlet", 1);
  const char *sentence = hooke_measurement_text(limit, "changes", 0, "sentence");
  assert_null(hooke_measurement_text(limit, "changes", 0, "kind"));
  if (sentence == NULL || strstr(sentence, "group `beam.bending` has ") == NULL) check_failed("%s", sentence);
  assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), "bending");
  check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.98, 1.0);
  assert_true(isnan(hooke_measurement_number(limit, "blame", 0, "number")));
  for (int64_t k = 1; k < hooke_measurement_row_count(limit, "blame"); k++)
    check_between(hooke_measurement_number(limit, "blame", k, "share"), 0.0, 0.01);
}

/* A step of 1.01 times the limit diverges, one of 0.99 does not; the diagnosis and the warning name the
 * bending. */
static int32_t hear(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  (void)kind, (void)t, (void)limit, (void)particle;
  if (strstr(sentence, "the bending of particles ") == NULL || spring != -1) check_failed("%s", sentence);
  ++*(int *)ctx;
  return 0;
}

TEST(a_run_above_the_limit_is_explained) {
  owned_system *system = new_rope(25, 0.5, 1.0, 0.0, 0.0);
  hooke_measurement *limit = limits_of(system, "verlet", 1);
  const double most = hooke_measurement_number(limit, "rows", 0, "predicted");
  hooke_measurement_destroy(limit);
  for (int above = 0; above <= 1; above++) {
    const double step = (above ? 1.01 : 0.99) * most;
    owned_integrator *integrator = start_run(
        system, (struct run){.method = "verlet", .step = step, .duration = 5000 * step, .every = 100 * step});
    owned_state *state = start_state(system);
    hooke_state_position(state)[3 * 13 + 1] = 1e-3;
    int heard = 0;
    check_ok(hooke_integrator_on_warning(integrator, hear, &heard));
    check_status(hooke_integrator_run(integrator, state), above ? HOOKE_DIVERGED : HOOKE_OK);
    assert_true(heard >= above);
    if (above) {
      owned_measurement *why = NULL;
      check_ok(explain_run(integrator, &why));
      assert_string_equal(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
      const char *sentence = hooke_measurement_text(why, "why", 0, "sentence");
      if (strstr(sentence, "most of all in the bending of particles ") == NULL ||
          strstr(sentence, "(group beam.bending)") == NULL)
        check_failed("%s", sentence);
      check_close(hooke_measurement_number(why, "why", 0, "limit"), most, 0.02 * most);
    }
  }
}
