/* Implicit steps of overdamped scenes, at any size: energy falls, and what moves comes to rest. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const METHODS[] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};

static void add_springs(hooke_system *system, int64_t count, const int64_t *ends, double stiffness,
                        double rest) {
  owned_options *springs = options_with("springs", "stiffness=%.17g rest_length=%.17g", stiffness, rest);
  check_ok(hooke_system_add_springs(system, NULL, count, ends, springs));
}

/* An open system of particles of this mass, with drag 1. */
static hooke_system *open_scene(int64_t n, const double *q, double mass, double gravity) {
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, 1.0));
  check_ok(hooke_system_add_particles(system, n, q, NULL, 1, &mass, NULL));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -gravity, 0.0}));
  return system;
}

/* ---- scenes ---- */

enum { ROPE = 11 };

/* A straight rope of 1 m, held at both ends, whose springs of 1e6 N rest at `rest` of their lengths. */
static hooke_system *open_rope(double rest) {
  double q[3 * ROPE] = {0};
  int64_t ends[2 * (ROPE - 1)];
  for (int p = 0; p < ROPE; p++)
    q[3 * p] = 0.1 * p;
  for (int k = 0; k < 2 * (ROPE - 1); k++)
    ends[k] = (k + 1) / 2;
  hooke_system *system = open_scene(ROPE, q, 0.01, 9.81);
  add_springs(system, ROPE - 1, ends, 1e6, 0.1 * rest);
  return system;
}

static hooke_system *sagging_rope(void) {
  hooke_system *system = open_rope(1.0);
  check_ok(hooke_system_pin(system, 2, (int64_t[]){0, ROPE - 1}));
  return committed(system);
}

enum { SIDE = 5, CELLS = SIDE * SIDE, MOST_SPRINGS = 4 * CELLS };

/* Cells at random places of a sheet, joined to their neighbours by springs that press, pull or hang loose,
 * with up to three of them pinned. */
static hooke_system *random_sheet(uint64_t seed) {
  struct random_source random = {seed};
  double q[3 * CELLS];
  int64_t ends[2 * MOST_SPRINGS], count = 0;
  for (int p = 0; p < CELLS; p++) {
    q[3 * p] = p % SIDE + random_between(&random, -0.3, 0.3);
    q[3 * p + 1] = p / SIDE + random_between(&random, -0.3, 0.3);
    q[3 * p + 2] = seed % 2 ? random_between(&random, -0.1, 0.1) : 0.0;
  }
  for (int p = 0; p < CELLS; p++) {
    const int next[] = {p % SIDE + 1 < SIDE ? p + 1 : -1, p + SIDE, p % SIDE + 1 < SIDE ? p + SIDE + 1 : -1};
    for (int k = 0; k < 3; k++) {
      if (next[k] < 0 || next[k] >= CELLS) continue;
      ends[2 * count] = p;
      ends[2 * count++ + 1] = next[k];
    }
  }
  hooke_system *system = open_scene(CELLS, q, 0.1, seed % 3 ? 0.0 : 9.81);
  add_springs(system, count, ends, pow(10.0, random_between(&random, 0.0, 6.0)),
              random_between(&random, 0.5, 1.6));
  check_ok(hooke_system_pin(system, 1 + (int64_t)(seed % 3), (int64_t[]){0, SIDE - 1, CELLS - 1}));
  return committed(system);
}

/* ---- energy ---- */

static double energy_of(const hooke_system *system, const hooke_state *state) {
  return hooke_system_energy(system, "potential", hooke_state_position(state), NULL);
}

/* The largest rise of energy in a step, over the largest energy; NAN where a step found no solution. */
static double largest_rise(const hooke_system *system, struct run run, int steps, hooke_state *state) {
  owned_integrator *it = start_run(system, run);
  double energy = energy_of(system, state), scale = fabs(energy), rise = 0.0;
  for (int k = 0; k < steps && rise == rise; k++) {
    const int32_t status = hooke_integrator_step(it, state, 1);
    const double now = energy_of(system, state);
    rise = status == HOOKE_OK ? fmax(rise, now - energy) : NAN;
    if (status != HOOKE_OK) check_message("found no solution for the step");
    scale = fmax(scale, fabs(now));
    energy = now;
  }
  return rise / scale;
}

/* Of the implicit midpoint rule, which swings on about where it would rest, large steps may have no solution
 * that does not raise the energy; it says so. */
TEST(test_energy_falls) {
  int midpoint = 0;
  for (uint64_t seed = 1; seed <= 8; seed++) {
    owned_system *system = random_sheet(seed);
    const double bound = bound_at_start(system, "forward-euler");
    for (int m = 0; m < 3; m++) {
      for (int k = 0; k < 4; k++) {
        const struct run run = {
            .method = METHODS[m], .step = bound * pow(100.0, k), .newton_tolerance = BY_DEFAULT};
        owned_state *state = start_state(system);
        const double rise = largest_rise(system, run, 12, state);
        if (m == 2 && isnan(rise)) {
          assert_true(k > 0);
        } else {
          check_between(rise, 0.0, 1e-13);
          midpoint += m == 2;
        }
      }
    }
  }
  assert_true(midpoint >= 12);
}

/* ---- rest ---- */

/* No force is left that a step of 1e6 times the explicit bound would not have used up. */
TEST(test_rest) {
  for (uint64_t seed = 1; seed <= 4; seed++) {
    owned_system *system = random_sheet(seed);
    const double bound = bound_at_start(system, "forward-euler");
    for (int m = 0; m < 2; m++) {
      owned_state *state = start_state(system);
      const double begun = energy_of(system, state);
      largest_rise(system, (struct run){.method = METHODS[m], .step = 1e6 * bound}, 60, state);
      check_between(largest(3 * CELLS, hooke_state_velocity(state)) * bound, 0.0, 1e-9);
      assert_true(energy_of(system, state) < begun);
    }
  }
}

/* The sag of the rope from statics: the horizontal pull H is the same everywhere, and the vertical one grows
 * by a weight at each particle from the middle on. */
static double exact_sag(void) {
  double low = 0.0, high = 1e6, sag = 0.0;
  for (int k = 0; k < 200; k++) {
    const double pull = 0.5 * (low + high);
    double width = 0.0;
    sag = 0.0;
    for (int j = 0; j < ROPE / 2; j++) {
      const double weight = 0.01 * 9.81 * (j + 0.5), tension = hypot(pull, weight);
      width += 0.1 * (1.0 + tension / 1e6) * pull / tension;
      sag += 0.1 * (1.0 + tension / 1e6) * weight / tension;
    }
    *(width < 0.5 ? &low : &high) = pull;
  }
  return sag;
}

static double sag_after(const hooke_system *system, struct run run, int steps) {
  owned_state *state = start_state(system);
  check_between(largest_rise(system, run, steps, state), 0.0, 1e-9);
  const double sag = -hooke_state_position(state)[3 * (ROPE / 2) + 1];
  return sag;
}

/* Nothing resists its fall at first, and soon the springs do by the third power of it. */
TEST(test_sagging_rope) {
  owned_system *system = sagging_rope();
  const double sag = exact_sag();
  for (int m = 0; m < 2; m++) {
    for (double step = 1e-2; step < 1e5; step *= 10.0) {
      const struct run run = {.method = METHODS[m], .step = step, .newton_tolerance = BY_DEFAULT};
      check_close(sag_after(system, run, step < 1.0 ? 400 : 60), sag, 1e-6 * sag);
    }
  }
  /* what is stiff swings on for long, so that the largest steps have no solution */
  check_close(sag_after(system, (struct run){.method = METHODS[2], .step = 1e-3}, 1500), sag, 1e-4 * sag);
  owned_state *state = start_state(system);
  assert_true(isnan(largest_rise(system, (struct run){.method = METHODS[2], .step = 10.0}, 1, state)));
  assert_true(*hooke_state_position(state) == 0.0 && hooke_state_time(state) == 0.0);
}

/* ---- drives, parts, threads ---- */

/* Where an end moves, the functional of a step falls from the old places of free particles and the new one of
 * the end: here the rope is pushed together by a tenth of its length. */
TEST(test_driven) {
  owned_system *system = open_rope(1.0);
  const int64_t end = ROPE - 1;
  check_ok(hooke_system_pin(system, 1, (int64_t[]){0}));
  check_ok(hooke_system_drive_harmonic(system, 1, &end, (double[]){-0.1, 0.0, 0.0}, 0.25, 0.0));
  check_ok(hooke_system_commit(system));
  for (double step = 1e-3; step < 2.0; step *= 4.0) {
    owned_run(it, state, system, .method = METHODS[0], .step = step);
    double *q = hooke_state_position(state), old[3 * ROPE];
    for (int k = 0; k < 8; k++) {
      double moved = 0.0;
      memcpy(old, q, sizeof old);
      check_ok(hooke_integrator_step(it, state, 1));
      memcpy(old + 3 * end, q + 3 * end, 3 * sizeof(double));
      for (int j = 0; j < 3 * ROPE; j++)
        moved += (q[j] - old[j]) * (q[j] - old[j]) / (2.0 * step);
      const double from = hooke_system_energy(system, "potential", old, NULL);
      check_between(energy_of(system, state) + moved, -1.0, from + 1e-12 * fabs(from));
    }
  }
}

/* A step in parts is the same where another integrator goes on from the state before. */
TEST(test_parts_repeat) {
  owned_system *system = sagging_rope();
  const struct run run = {
      .method = METHODS[2], .step = 1e-2, .duration = 0.08, .newton_tolerance = BY_DEFAULT};
  owned_state *whole = start_state(system), *part = start_state(system);
  hooke_integrator *it = start_run(system, run);
  check_ok(hooke_integrator_step(it, whole, 6));
  assert_true(hooke_integrator_count(it, "nonlinear_failures") > 0);
  hooke_integrator_destroy(it);
  for (int k = 0; k < 6; k++) {
    it = start_run(system, run);
    check_ok(hooke_integrator_step(it, part, 1));
    hooke_integrator_destroy(it);
  }
  check_same_bits(3 * ROPE, hooke_state_position(part), hooke_state_position(whole));
}

/* A cloth that is pressed together: with 98 x 98 particles it would be too small for two threads. */
static hooke_system *pressed_cloth(void) {
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, 1.0));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, 0.0, -9.81}));
  owned_options *part = options_with("cloth", "size=104,104 edges=1,0,0,0,1,0 mass=1 pinned=corners "
                                              "structural.stiffness=1e3 structural.rest_scale=1.02");
  check_ok(hooke_system_add_part(system, "cloth", NULL, part, NULL, NULL));
  return committed(system);
}

TEST(test_threads) {
  owned_system *system = pressed_cloth();
  const int64_t numbers = 3 * hooke_system_particle_count(system);
  double *q[2];
  for (int k = 0; k < 2; k++) {
    owned_run(it, state, system, .method = METHODS[1], .step = 1e-3, .threads = 1 + k,
              .newton_tolerance = BY_DEFAULT);
    check_ok(hooke_integrator_step(it, state, 1));
    q[k] = new_doubles(numbers);
    memcpy(q[k], hooke_state_position(state), (size_t)numbers * sizeof(double));
  }
  check_same_bits(numbers, q[1], q[0]);
  free(q[0]);
  free(q[1]);
}
