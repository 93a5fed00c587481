/* Every method compared with solutions to 15 digits. */
#include "check.h"
#include "order.h"
#include "reference.h"
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- error-controlled methods: every reference state, at frames of one run ---- */

struct visit {
  const struct reference *reference;
  const char *method;
  int64_t seen;
};

static void compare_state(const struct visit *visit, const struct reference_state *expected,
                          const hooke_state *state) {
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  const int64_t size = 3 * visit->reference->particle_count;
  const double error = largest_difference(size, hooke_state_position(seen), expected->position);
  const double size_of_x = largest(size, expected->position);
  if (error <= 1e-7 * size_of_x) return;
  check_failed("%s by %s at t = %g s: the error %.3g m is above 1e-7 of %.3g m", visit->reference->name,
               visit->method, expected->time, error, size_of_x);
}

static int32_t at_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct visit *visit = ctx;
  (void)step;
  for (int64_t k = 0; k < visit->reference->state_count; k++) {
    const struct reference_state *expected = &visit->reference->state[k];
    if (fabs(hooke_state_time(state) - expected->time) > 1e-9) continue;
    compare_state(visit, expected, state);
    visit->seen++;
  }
  return 0;
}

static void reach_references(const char *method) {
  if (hooke_method_is_built(method) != 1) skip();
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    struct visit visit = {&references[k], method, 0};
    owned_system *system = build_reference(&references[k]);
    const double end = references[k].state[references[k].state_count - 1].time;
    owned_run(integrator, state, system, .method = method, .rtol = 1e-10, .atol = 1e-12, .duration = end,
              .every = 0.05);
    check_ok(hooke_integrator_on_frame(integrator, at_frame, &visit));
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(visit.seen, references[k].state_count);
    compare_state(&visit, &references[k].state[references[k].state_count - 1], state);
  }
}

TEST(test_adams) {
  reach_references("cvode-adams");
}

TEST(test_bdf) {
  reach_references("cvode-bdf");
}

/* ---- the energies of the states themselves ---- */

TEST(test_energies) {
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    owned_system *system = build_reference(&references[k]);
    for (int64_t s = 0; s < references[k].state_count; s++) {
      const struct reference_state *state = &references[k].state[s];
      const double scale = state->kinetic_energy + state->spring_energy + fabs(state->gravity_energy);
      check_close(hooke_system_energy(system, "kinetic", NULL, state->velocity), state->kinetic_energy,
                  1e-13 * scale);
      check_close(hooke_system_energy(system, "gravity", state->position, NULL), state->gravity_energy,
                  1e-13 * scale);
      check_close(hooke_system_energy(system, "springs", state->position, NULL), state->spring_energy,
                  1e-11 * scale);
    }
  }
}

/* ---- orders, from a step on at which the error is proportional to a power of it ---- */

/* `points` steps, each half of the previous one, from one for each reference scene on, to its reference state
 * of that number. Verlet and Shardlow's splitting include spring damping: with the velocity half-way in the
 * second kick the order would be 1.1. */
static const struct ladder {
  const char *method;
  double order;
  int points;
  double coarsest[REFERENCE_COUNT];
  int64_t state[REFERENCE_COUNT];
} ladders[] = {{"forward-euler", 1.0, 5, {1e-3, 2.5e-3, 2e-5, 2e-5}, {1, 1, 0, 0}},
               {"symplectic-euler", 1.0, 5, {1e-3, 2.5e-3, 5e-4, 1e-4}, {1, 1, 0, 0}},
               {"verlet", 2.0, 5, {5e-3, 2e-2, 2e-3, 2e-3}, {1, 1, 1, 1}},
               {"shardlow", 2.0, 5, {5e-3, 2e-2, 2e-3, 2e-3}, {1, 1, 1, 1}},
               {"rk4", 4.0, 4, {5e-3, 1e-2, 4e-3, 1e-3}, {1, 1, 0, 0}},
               {"backward-euler", 1.0, 5, {1e-3, 2.5e-3, 5e-4, 5e-4}, {1, 1, 0, 0}},
               {"tr-bdf2", 2.0, 5, {5e-3, 2e-2, 2e-3, 2e-3}, {1, 1, 1, 1}},
               {"implicit-midpoint", 2.0, 5, {5e-3, 2e-2, 2e-3, 2e-3}, {1, 1, 1, 1}}};

/* Every halving shows the order, within -0.15 and +0.25. */
TEST(test_orders) {
  for (size_t k = 0; k < sizeof ladders / sizeof ladders[0] * REFERENCE_COUNT; k++) {
    const struct ladder *ladder = &ladders[k / REFERENCE_COUNT];
    const struct reference *reference = &references[k % REFERENCE_COUNT];
    const struct reference_state *expected = &reference->state[ladder->state[k % REFERENCE_COUNT]];
    const int64_t size = 3 * reference->particle_count;
    owned_system *system = build_reference(reference);
    owned_doubles *q = new_doubles(size);
    double error[5], step = ladder->coarsest[k % REFERENCE_COUNT];
    for (int point = 0; point < ladder->points; point++, step /= 2.0) {
      end_of_run(q, NULL, system, .method = ladder->method, .step = step, .duration = expected->time);
      error[point] = largest_difference(size, q, expected->position);
    }
    char what[128];
    snprintf(what, sizeof what, "%s by %s", reference->name, ladder->method);
    check_order(what, ladder->points, error, ladder->order - 0.15, ladder->order + 0.25);
  }
}

/* ---- the errors that fixed-step methods must have, to 6 digits where nothing is solved for, or the rounding
 * of positions in a few hundred steps ---- */

TEST(test_known_errors) {
  const struct reference *reference = find_reference("six-particles");
  const struct reference_state *expected = &reference->state[1];
  check_close(expected->time, 1.0, 0.0);
  owned_system *system = build_reference(reference);
  double q[18];
  for (int m = 0; m < REFERENCE_ERROR_COUNT; m++) {
    for (int k = 0; k < 5; k++) {
      const struct run run = {.method = reference_errors[m].method,
                              .newton = reference_errors[m].newton,
                              .verlet_damping = reference_errors[m].verlet_damping,
                              .step = 1.0 / (50 << k),
                              .duration = 1.0};
      run_to_end(system, run, q, NULL);
      const double error = largest_difference(18, q, expected->position),
                   known = reference_errors[m].error[k];
      /* where that is below the rounding of positions of 4 m, to that */
      check_close(error, known, reference_errors[m].allowed * known + 2e-15);
    }
  }
}
