/* Steps of systems with rigid bodies have the bits of the plain loops of tests/support/canonical_body.c,
 * for bodies of every kind among other particles. */
#include "canonical_body.h"
#include "check.h"
#include "random.h"
#include "run.h"

#include "model/system.h"

#include <stdlib.h>
#include <string.h>

/* Bodies: a free one, a bar, a pair, a single particle, one about a pin, a bar about its end, one about an
 * axis. */
static const int sizes[] = {6, 4, 2, 1, 5, 3, 5};
static const int pins[] = {0, 0, 0, 0, 1, 1, 2}, in_line[] = {0, 1, 1, 0, 0, 1, 0};
enum {
  BODIES = sizeof sizes / sizeof sizes[0],
  LOOSE = 9,
  N = 26 + LOOSE,
  SPRINGS = 60,
  ANCHORS = 8,
  STEPS = 25
};

struct features {
  int damped, drag, gravity;
};

static void add_particles(struct random_source *random, hooke_system *system) {
  double q[3 * N], v[3 * N], mass[N];
  int p = 0;
  for (int k = 0; k < 3 * N; k++) {
    q[k] = random_between(random, -1.0, 1.0);
    v[k] = random_between(random, -1.0, 1.0);
    mass[k / 3] = random_between(random, 0.2, 2.0);
  }
  for (int b = 0; b < BODIES; p += sizes[b++]) {
    for (int k = 3 * (p + 2); k < 3 * (p + sizes[b]) && in_line[b]; k++)
      q[k] = q[3 * p + k % 3] + (k / 3 - p) * 0.7 * (q[3 * (p + 1) + k % 3] - q[3 * p + k % 3]);
    for (int k = 3 * p; k < 3 * (p + pins[b]); k++)
      v[k] = 0.0;
  }
  assert_int_equal(p + LOOSE, N);
  check_ok(hooke_system_add_particles(system, N, q, v, N, mass, NULL));
}

static void add_forces(struct random_source *random, struct features with, hooke_system *system) {
  hooke_options *springs = NULL, *anchors = NULL;
  int64_t ends[2 * SPRINGS], anchored[ANCHORS];
  double point[3 * ANCHORS];
  for (int k = 0; k < SPRINGS; k++) {
    ends[2 * k] = random_whole(random, 0, N - 1);
    ends[2 * k + 1] = (ends[2 * k] + random_whole(random, 1, N - 1)) % N;
  }
  for (int k = 0; k < ANCHORS; k++) {
    anchored[k] = random_whole(random, 0, N - 1);
    for (int a = 0; a < 3; a++)
      point[3 * k + a] = random_between(random, -2.0, 2.0);
  }
  check_ok(hooke_options_create("springs", &springs));
  check_ok(hooke_options_set_number(springs, "stiffness", 50.0));
  check_ok(hooke_options_create("anchors", &anchors));
  check_ok(hooke_options_set_numbers(anchors, "points", 3 * ANCHORS, point));
  check_ok(hooke_options_set_number(anchors, "stiffness", 20.0));
  if (with.damped) check_ok(hooke_options_set_number(springs, "damping", 0.3));
  if (with.damped) check_ok(hooke_options_set_number(anchors, "damping", 0.2));
  check_ok(hooke_system_add_springs(system, "springs", SPRINGS, ends, springs));
  check_ok(hooke_system_add_anchors(system, "anchors", ANCHORS, anchored, anchors));
  hooke_options_destroy(springs);
  hooke_options_destroy(anchors);
}

static hooke_system *mixed_system(uint64_t seed, struct features with, const double gravity[3]) {
  struct random_source random = {seed};
  hooke_system *system = NULL;
  check_ok(hooke_system_create(&system));
  add_particles(&random, system);
  add_forces(&random, with, system);
  int64_t p = 0, members[8];
  for (int b = 0; b < BODIES; p += sizes[b++]) {
    for (int k = 0; k < sizes[b]; k++)
      members[k] = p + k;
    check_ok(hooke_system_pin(system, pins[b], members));
    check_ok(hooke_system_add_body(system, NULL, sizes[b], members, 1));
  }
  if (with.gravity) check_ok(hooke_system_set_gravity(system, gravity));
  if (with.drag) check_ok(hooke_system_set_drag(system, 0.4));
  check_ok(hooke_system_commit(system));
  return system;
}

static void fill_bodies(const hooke_system *system, struct canonical_body *body) {
  assert_int_equal(system->moving_bodies, BODIES);
  for (int b = 0; b < BODIES; b++) {
    const struct hk_body *from = system->bodies->mover[b];
    body[b] = (struct canonical_body){.count = from->count,
                                      .particle = from->particle,
                                      .mass = from->mass,
                                      .inverse_mass = from->inverse_mass,
                                      .inertia = from->inertia,
                                      .inverse_inertia = from->inverse_inertia,
                                      .centre = from->centre,
                                      .place = from->place,
                                      .rank = from->rank,
                                      .base = from->base,
                                      .triad = from->triad};
  }
}

static void compare(uint64_t seed, struct features with, const char *method) {
  const double gravity[3] = {0.3, -9.81, 0.7}, h = 0.0009765; /* no binary fraction */
  hooke_system *system = mixed_system(seed, with, gravity);
  struct canonical canonical;
  struct canonical_body body[BODIES];
  canonical_create(system, &canonical);
  canonical.gravity = with.gravity ? gravity : NULL;
  canonical.drag = with.drag ? 0.4 : 0.0;
  fill_bodies(system, body);
  hooke_integrator *integrator = start_run(system, (struct run){.method = method, .step = h});
  hooke_state *state = start_state(system);
  double q[3 * N], v[3 * N];
  memcpy(q, hooke_state_position(state), sizeof q);
  memcpy(v, hooke_state_velocity(state), sizeof v);
  for (int k = 0; k < STEPS; k++) {
    check_ok(hooke_integrator_step(integrator, state, 1));
    canonical_body_step(&canonical, BODIES, body, method, k * h, (k + 1) * h, h, q, v);
    check_same_bits(3 * N, hooke_state_position(state), q);
    check_same_bits(3 * N, hooke_state_velocity(state), v);
  }
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  canonical_destroy(&canonical);
  hooke_system_destroy(system);
}

static void steps_are_the_plain_loops(void **unused) {
  (void)unused;
  for (int features = 0; features < 8; features++) {
    for (uint64_t seed = 1; seed <= 5; seed++) {
      const struct features with = {features & 1, features >> 1 & 1, features >> 2 & 1};
      compare(10 * (uint64_t)features + seed, with, "symplectic-euler");
      compare(10 * (uint64_t)features + seed, with, "verlet");
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(steps_are_the_plain_loops)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
