/* All linear solvers of cvode-bdf and arkode-esdirk give the same motion. */
#include "check.h"
#include "random_scene.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <string.h>

static const char *const solvers[] = {"auto", "direct", "blocks", "gmres"};
enum { SOLVERS = sizeof solvers / sizeof solvers[0] };

static void needs_cvode(void) {
  if (hooke_method_is_built("cvode-bdf") != 1) skip();
}

static int has_factor(void) {
  return hooke_build_fact("cholmod")[0] != '\0';
}

/* `direct` is skipped in a build without its library. */
static int is_built(const char *solver) {
  return has_factor() || strcmp(solver, "direct") != 0;
}

TEST(references_are_met) {
  needs_cvode();
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    const struct reference *reference = &references[k];
    const struct reference_state *last = &reference->state[reference->state_count - 1];
    const int64_t size = 3 * reference->particle_count;
    owned_system *system = build_reference(reference);
    owned_doubles *q = new_doubles(size);
    for (int s = 0; s < SOLVERS; s++) {
      if (!is_built(solvers[s])) continue;
      end_of_run(q, NULL, system, .method = "cvode-bdf", .rtol = 1e-10, .atol = 1e-12, .duration = last->time,
                 .linear_solver = solvers[s]);
      const double error = largest_difference(size, q, last->position) / largest(size, last->position);
      if (!(error <= 1e-7)) check_failed("%s by %s: error %.3g", reference->name, solvers[s], error);
    }
  }
}

/* Every force, driven and pinned particles, springs that only pull, callbacks with and without their
 * derivative. */
TEST(everything) {
  static const char *const methods[] = {"cvode-bdf", "arkode-esdirk"};
  needs_cvode();
  for (uint64_t seed = 1; seed <= 6; seed++) {
    owned_random_scene scene;
    random_scene_with(&scene, .seed = seed, .particles = 30, .springs = 70, .triples = seed % 2 ? 8 : 0,
                      .rope = seed % 2 ? 5 : 0, .with_product = seed % 3 == 0,
                      .features = SCENE_EVERYTHING & ~SCENE_COINCIDENT);
    const int64_t size = 3 * hooke_system_particle_count(scene.system);
    owned_doubles *expected = new_doubles(2 * size), *found = new_doubles(2 * size);
    struct run run = {.method = "cvode-adams", .rtol = 1e-11, .atol = 1e-13, .duration = 0.4};
    run_to_end(scene.system, run, expected, expected + size);
    run.rtol = 1e-9, run.atol = 1e-11;
    for (int m = 0; m < 2; m++) {
      for (int s = 0; s < SOLVERS; s++) {
        if (!is_built(solvers[s])) continue;
        run.method = methods[m];
        run.linear_solver = solvers[s];
        run_to_end(scene.system, run, found, found + size);
        const double q = largest_difference(size, found, expected) / largest(size, expected),
                     v = largest_difference(size, found + size, expected + size) /
                         largest(size, expected + size);
        if (!(q <= 1e-6 && v <= 1e-6))
          check_failed("seed %d, %s by %s: errors %.3g, %.3g", (int)seed, methods[m], solvers[s], q, v);
      }
    }
  }
}

/* ---- a stiff, strongly damped rope ---- */

enum { SEGMENTS = 80, PARTICLES = SEGMENTS + 1, SIZE = 3 * PARTICLES };

static hooke_system *rope(double lightest) {
  const double gravity[3] = {0.0, -9.81, 0.0};
  double position[SIZE] = {0.0}, mass[PARTICLES];
  int64_t ends[2 * SEGMENTS];
  for (int k = 0; k < PARTICLES; k++) {
    position[3 * k] = (double)k / SEGMENTS;
    mass[k] = k == 7 ? lightest : 0.25 / PARTICLES;
  }
  for (int k = 0; k < SEGMENTS; k++) {
    ends[2 * k] = k;
    ends[2 * k + 1] = k + 1;
  }
  const int64_t pinned = 0;
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, PARTICLES, position, NULL, PARTICLES, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &pinned));
  springs_with(system, SEGMENTS, ends, NULL, 1e4, 10.0, -1.0, 0);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 0.2));
  return committed(system);
}

struct counted {
  int64_t steps, linear;
  double q[SIZE];
};

static struct counted run_counted(hooke_integrator *integrator, const hooke_system *system) {
  struct counted found = {.steps = -hooke_integrator_count(integrator, "steps"),
                          .linear = -hooke_integrator_count(integrator, "linear_iterations")};
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  found.steps += hooke_integrator_count(integrator, "steps");
  found.linear += hooke_integrator_count(integrator, "linear_iterations");
  memcpy(found.q, hooke_state_position(state), sizeof found.q);
  return found;
}

static hooke_integrator *start(const hooke_system *system, const char *solver) {
  return start_with(system, .method = "cvode-bdf", .rtol = 1e-4, .atol = 1e-7, .duration = 0.3,
                    .linear_solver = solver);
}

static struct counted run_alone(const hooke_system *system, const char *solver) {
  owned_integrator *integrator = start(system, solver);
  const struct counted found = run_counted(integrator, system);
  return found;
}

/* A factor needs few iterations, and the automatic choice selects it; also beside a particle of a millionth
 * of the mass. */
TEST(factor_pays) {
  needs_cvode();
  if (!has_factor()) skip();
  for (int k = 0; k < 2; k++) {
    owned_system *system = rope(k == 0 ? 0.25 / PARTICLES : 1e-9);
    double exact[SIZE];
    end_of_run(exact, NULL, system, .method = "cvode-bdf", .rtol = 1e-9, .atol = 1e-12, .duration = 0.3,
               .linear_solver = "direct");
    const struct counted direct = run_alone(system, "direct"), blocks = run_alone(system, "blocks"),
                         chosen = run_alone(system, "auto");
    check_between((double)direct.linear / (double)direct.steps, 0.5, 8.0);
    check_between((double)blocks.linear / (double)direct.linear, 4.0, 1e4);
    check_between((double)chosen.linear / (double)blocks.linear, 0.0, 0.5);
    check_between(largest_difference(SIZE, direct.q, exact), 1e-9, 1e-4);
    check_between(largest_difference(SIZE, blocks.q, exact), 1e-9, 1e-4);
    check_between(largest_difference(SIZE, chosen.q, exact), 1e-9, 1e-4);
  }
}

/* A run keeps nothing of the previous one. */
TEST(runs_repeat) {
  needs_cvode();
  owned_system *system = rope(0.25 / PARTICLES);
  for (int s = 0; s < SOLVERS - 1; s++) {
    if (!is_built(solvers[s])) continue;
    owned_integrator *integrator = start(system, solvers[s]);
    const struct counted first = run_counted(integrator, system), second = run_counted(integrator, system);
    assert_int_equal(second.steps, first.steps);
    assert_int_equal(second.linear, first.linear);
    check_same_bits(SIZE, second.q, first.q);
  }
}

/* Fixed steps solve by the factor of the whole matrix as by blocks, in both forms, and have no plain gmres.
 */
TEST(fixed_steps) {
  static const char *const methods[] = {"backward-euler", "tr-bdf2"}, *const forms[] = {"converged",
                                                                                        "one-iteration"};
  owned_system *system = rope(0.25 / PARTICLES);
  double q[2][SIZE];
  for (int k = 0; k < 4 && has_factor(); k++) {
    for (int s = 0; s < 2; s++)
      end_of_run(q[s], NULL, system, .method = methods[k / 2], .newton = forms[k % 2],
                 .linear_solver = solvers[1 + s], .step = 1e-3, .duration = 0.05);
    check_between(largest_difference(SIZE, q[0], q[1]), 1e-18, 1e-9); /* another way, the same place */
  }
  owned_options *options = options_with("run", "method=backward-euler step=1e-3 linear_solver=gmres");
  hooke_integrator *integrator = NULL;
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_UNSUITED);
  check_message("backward-euler has no plain gmres");
}

/* The message names the missing library. */
TEST(not_built) {
  needs_cvode();
  if (has_factor()) skip();
  owned_system *system = rope(0.25 / PARTICLES);
  hooke_integrator *integrator = NULL;
  owned_options *options = options_with("run", "method=cvode-bdf duration=0.3 linear_solver=direct");
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_NOT_BUILT);
  assert_non_null(strstr(hooke_last_error(), "CHOLMOD"));
  assert_null(integrator);
}

TEST(words) {
  owned_options *options = new_options("run");
  assert_string_equal(hooke_options_text(options, "linear_solver"), "auto");
  check_status(hooke_options_set_text(options, "linear_solver", "cholmod"), HOOKE_BAD_VALUE);
}
