/* Anchors: the force law, limits by formula, and every query on a scene that has anchors only. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* A chain of three along x on weak springs; the last one is tied to a point two above it. */
static hooke_system *chain(double stiffness, double damping, double rest_length) {
  const double place[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, mass = 0.5, point[3] = {2, 2, 0};
  const int64_t ends[4] = {0, 1, 1, 2}, pinned = 0, tied = 2;
  hooke_system *system = small_system(3, place, NULL, mass, 0);
  check_ok(hooke_system_pin(system, 1, &pinned));
  hooke_options *options = options_with("springs", "stiffness=2");
  check_ok(hooke_system_add_springs(system, "line", 2, ends, options));
  hooke_options_destroy(options);
  options = options_with("anchors", "stiffness=%.17g damping=%.17g rest_length=%.17g", stiffness, damping,
                         rest_length);
  check_ok(hooke_options_set_numbers(options, "points", 3, point));
  check_ok(hooke_system_add_anchors(system, "wall", 1, &tied, options));
  hooke_options_destroy(options);
  return committed(system);
}

TEST(the_force_is_that_of_a_spring_to_the_point) {
  owned_system *system = chain(30.0, 0.7, 0.5);
  const double q[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, v[9] = {0, 0, 0, 0, 0, 0, 3, -1, 2};
  double force[9];
  check_ok(hooke_system_force(system, 0.0, q, v, force));
  /* 2 m below its point, moving away at 1 m/s */
  check_close(force[7], 30.0 * 1.5 + 0.7 * 1.0, 1e-13);
  check_close(force[6], 0.0, 1e-13);
  check_close(hooke_system_energy(system, "potential", q, NULL), 0.5 * 30.0 * 1.5 * 1.5, 1e-12);
  check_close(hooke_system_dissipated_power(system, q, v), 0.7, 1e-14);
  assert_string_equal(hooke_system_force_name(system, 1), "anchors");
  int64_t particle;
  double point[3], stiffness, damping, rest_length;
  assert_int_equal(hooke_system_count(system, "anchors"), 1);
  check_ok(hooke_system_members(system, "anchors", &particle, &stiffness, &damping, &rest_length));
  check_ok(hooke_system_anchor_points(system, point));
  assert_true(particle == 2 && point[1] == 2.0 && stiffness == 30.0 && damping == 0.7 && rest_length == 0.5);
}

/* A single particle at its point is an oscillator of frequency sqrt(k/m) in all directions. */
static hooke_system *oscillator(double stiffness) {
  const double place[6] = {1, 2, 3, 4, 5, 6}, mass = 0.25;
  const int64_t both[2] = {0, 1};
  hooke_system *system = small_system(2, place, NULL, mass, 0);
  owned_options *options = new_options("anchors");
  const double stiffnesses[2] = {stiffness, 1.0};
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, stiffnesses));
  check_ok(hooke_system_add_anchors(system, NULL, 2, both, options));
  return committed(system);
}

TEST(without_points_they_hold_particles_where_they_are) {
  owned_system *system = oscillator(100.0);
  owned_state *state = start_state(system);
  double *q = hooke_state_position(state), force[6];
  check_ok(hooke_system_force(system, 0.0, q, hooke_state_velocity(state), force));
  for (int k = 0; k < 6; k++)
    check_between(force[k], 0.0, 0.0);
  /* a quarter of a period later it is at its point: omega = 20/s */
  q[1] += 0.1;
  const double quarter = acos(-1.0) / 40.0;
  owned_integrator *run = start_with(system, .method = "rk4", .step = quarter / 1000.0);
  check_ok(hooke_integrator_step(run, state, 1000));
  check_close(q[1], 2.0, 1e-9);
  check_close(hooke_state_velocity(state)[1], -0.1 * 20.0, 1e-9);
}

#if HOOKE_HAVE_LAPACK
TEST(limits_are_those_of_the_oscillator) {
  const struct {
    const char *method;
    double limit;
  } rows[] = {{"symplectic-euler", 2.0 / 20.0}, {"verlet", 2.0 / 20.0}, {"rk4", 2.0 * sqrt(2.0) / 20.0}};
  owned_system *system = oscillator(100.0);
  owned_state *state = start_state(system);
  owned_measurement *limit;
  check_ok(hooke_measurement_create("limit", system, NULL, NULL, &limit));
  check_ok(hooke_measurement_run(limit, state));
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    double bound;
    check_ok(hooke_step_bound(system, rows[k].method, hooke_state_position(state), &bound));
    check_between(bound, 0.9 * rows[k].limit, rows[k].limit * (1.0 + 1e-12));
    const int64_t row = hooke_measurement_find(limit, "rows", "method", rows[k].method);
    check_close(hooke_measurement_number(limit, "rows", row, "predicted"), rows[k].limit, 1e-9);
    check_close(hooke_measurement_number(limit, "rows", row, "measured"), rows[k].limit,
                2e-3 * rows[k].limit);
  }
}

/* A particle at the place of its anchor, which has no direction there: it is damped in all. */
static hooke_system *damped_at_its_place(double damping) {
  const double place[3] = {1, 2, 3}, velocity[3] = {0, 1, 0}, mass = 1.0;
  const int64_t tied = 0;
  hooke_system *system = small_system(1, place, velocity, mass, 0);
  owned_options *options = options_with("anchors", "stiffness=1 damping=%.17g", damping);
  check_ok(hooke_system_add_anchors(system, "wall", 1, &tied, options));
  return committed(system);
}

TEST(damping_at_its_place_limits_the_step) {
  const double c = 1000.0, euler = 4.0 / (c + sqrt(c * c + 4.0)),
               fast = 2.0 / (c / 2.0 + sqrt(c * c / 4.0 - 1.0));
  const struct {
    const char *method;
    double limit;
  } rows[] = {{"symplectic-euler", euler},
              {"forward-euler", fast},
              {"heun", fast},
              {"verlet", 2.0},
              {"shardlow", 2.0}};
  owned_system *system = damped_at_its_place(c);
  owned_state *state = start_state(system);
  owned_measurement *limit;
  check_ok(hooke_measurement_create("limit", system, NULL, NULL, &limit));
  check_ok(hooke_measurement_run(limit, state));
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    const double right = rows[k].limit;
    double bound;
    check_ok(hooke_step_bound(system, rows[k].method, hooke_state_position(state), &bound));
    check_between(bound, 0.99 * right, right * (1.0 + 1e-9));
    const int64_t row = hooke_measurement_find(limit, "rows", "method", rows[k].method);
    check_close(hooke_measurement_number(limit, "rows", row, "predicted"), right, 1e-9 * right);
    check_close(hooke_measurement_number(limit, "rows", row, "measured"), right, 1e-3 * right);
  }
  assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), "damping");
}

/* A run just below that limit ends, and one above it diverges and is blamed on the anchor. */
TEST(damping_at_its_place_is_blamed_on_the_anchor) {
  owned_system *system = damped_at_its_place(1000.0);
  const double limit = 4.0 / (1000.0 + sqrt(1e6 + 4.0));
  for (int above = 0; above <= 1; above++) {
    const double step = (above ? 1.01 : 0.99) * limit;
    owned_run(run, state, system, .method = "symplectic-euler", .step = step, .duration = 2000 * step,
              .every = 20 * step);
    check_status(hooke_integrator_run(run, state), above ? HOOKE_DIVERGED : HOOKE_OK);
    owned_measurement *why = NULL;
    if (above) {
      check_ok(explain_run(run, &why));
      const char *sentence = hooke_measurement_text(why, "why", 0, "sentence");
      if (!strstr(sentence, "most of all in the damping of the anchor of particle 0 (group wall)"))
        check_failed("it says: %s", sentence);
    }
  }
}

/* The stiffest element of the scene is named, whatever its force. */
TEST(a_run_that_diverges_by_one_blames_it) {
  owned_system *system = chain(5e5, 0.0, 0.0);
  owned_run(run, state, system, .method = "symplectic-euler", .step = 0.0021, .duration = 2.1,
            .every = 0.021);
  check_status(hooke_integrator_run(run, state), HOOKE_DIVERGED);
  owned_measurement *why;
  check_ok(hooke_why_create(run, NULL, &why));
  check_ok(hooke_measurement_run(why, NULL));
  const char *sentence = hooke_measurement_text(why, "why", 0, "sentence");
  if (!strstr(sentence, "the anchor of particle 2 (group wall)")) check_failed("it says: %s", sentence);
}
#endif

TEST(what_is_wrong_is_said) {
  const double place[6] = {0, 0, 0, 1, 0, 0}, mass = 1.0, three[3] = {1, 2, 3};
  const int64_t particles[2] = {0, 2}, twice[2] = {1, 1};
  owned_options *options, *spring;
  owned_system *system = small_system(2, place, NULL, mass, 0);
  options = new_options("anchors");
  spring = new_options("springs");
  check_status(hooke_system_add_anchors(system, NULL, 1, particles, options), HOOKE_BAD_VALUE);
  check_message("stiffness");
  check_ok(hooke_options_set_number(options, "stiffness", 1.0));
  check_status(hooke_system_add_anchors(system, NULL, 1, particles, spring), HOOKE_BAD_VALUE);
  check_status(hooke_system_add_anchors(system, NULL, 2, particles, options), HOOKE_BAD_VALUE);
  check_message("particles[1]: there is no particle 2; allowed: 0 to 1, as numbers begin at 0");
  check_status(hooke_system_add_anchors(system, NULL, -1, particles, options), HOOKE_BAD_VALUE);
  check_ok(hooke_options_set_numbers(options, "damping", 3, three));
  check_status(hooke_system_add_anchors(system, NULL, 2, twice, options), HOOKE_BAD_VALUE);
  check_message("damping: 3 values for 2 anchors; allowed: one, or one for each");
  check_ok(hooke_options_unset(options, "damping"));
  check_ok(hooke_options_set_numbers(options, "points", 3, three));
  check_status(hooke_system_add_anchors(system, NULL, 2, twice, options), HOOKE_BAD_VALUE);
  check_message("points: 3 values for 2 anchors; allowed: three for each");
  check_ok(hooke_options_unset(options, "points"));
  check_ok(hooke_system_add_anchors(system, NULL, 2, twice, options));
  check_status(hooke_system_members(system, "anchors", NULL, NULL, NULL, NULL), HOOKE_BAD_CALL);
  check_ok(hooke_options_set_number(options, "stiffness", 0.0));
  check_ok(hooke_system_add_anchors(system, NULL, 2, twice, options)); /* commit drops them */
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "anchors"), 2);
}
