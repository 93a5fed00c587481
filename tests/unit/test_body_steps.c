/* Steps of every method that takes rigid bodies are the plain loops of tests/support/canonical_body.c, for
 * bodies of every kind among other particles, which are driven in every way. */
#include "canonical_body.h"
#include "check.h"
#include "small.h"
#include "random.h"
#include "run.h"

#include "model/system.h"

#include <string.h>

/* Bodies: a free one, a bar, a pair, a single particle, one about a pin, a bar about its end, one about an
 * axis. */
static const int sizes[] = {6, 4, 2, 1, 5, 3, 5};
static const int pins[] = {0, 0, 0, 0, 1, 1, 2}, in_line[] = {0, 1, 1, 0, 0, 1, 0};
enum {
  BODIES = sizeof sizes / sizeof sizes[0],
  LOOSE = 9, /* the last three are driven */
  N = 26 + LOOSE,
  SPRINGS = 14, /* leaves particles of bodies that nothing acts on */
  ANCHORS = 3,
  STEPS = 25,
  AT_ONCE = 5
};

struct features {
  int damped, drag, gravity, driven, factors;
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
  owned_options *springs = NULL, *anchors = NULL;
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
}

static int32_t wave(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)ctx;
  for (int64_t k = 0; k < 3 * count; k++) {
    q[k] = 0.1 * (double)k + t * t;
    v[k] = 2.0 * t;
  }
  return 0;
}

static const double LOAD[3] = {3.0, -2.0, 1.0};
enum { LOADED = 3 };

static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)ctx;
  for (int a = 0; a < 3; a++)
    force[3 * LOADED + a] += LOAD[a];
  return 0;
}

static void load(hooke_system *system) {
  owned_options *loads = new_options("loads");
  check_ok(hooke_options_set_numbers(loads, "force", 3, LOAD));
  check_ok(hooke_system_add_loads(system, 1, (int64_t[]){LOADED}, loads));
}

static int32_t pulse(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)q, (void)v, (void)ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += t * (double)(k + 1);
  return 0;
}

static void drive(hooke_system *system) {
  const int64_t driven[] = {N - 3, N - 2, N - 1};
  const double time[] = {0.0, 0.011, 0.03}, places[] = {0, 0, 0, 0.02, -0.01, 0, 0, 0, 0.05};
  check_ok(hooke_system_drive_harmonic(system, 1, driven, (double[]){0.1, 0.0, -0.2}, 7.0, 0.3));
  check_ok(hooke_system_drive_table(system, 1, driven + 1, 3, time, places));
  check_ok(hooke_system_drive_callback(system, 1, driven + 2, wave, NULL));
}

/* No step, which moves driven particles to their places at t: tests/physics/test_drives.c holds these. */
static void place(double t, double *q, double *v, void *ctx) {
  const hooke_system *system = ctx;
  owned_run(driver, state, system, .method = "forward-euler", .step = 1.0);
  hooke_state_set_time(state, t);
  check_ok(hooke_integrator_step(driver, state, 0));
  memcpy(q + 3 * (N - 3), hooke_state_position(state) + 3 * (N - 3), 9 * sizeof *q);
  memcpy(v + 3 * (N - 3), hooke_state_velocity(state) + 3 * (N - 3), 9 * sizeof *v);
}

static hooke_system *mixed_system(uint64_t seed, struct features with, const double gravity[3]) {
  struct random_source random = {seed};
  hooke_system *system = new_system();
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
  for (int k = 0; k < N && with.factors; k++)
    check_ok(hooke_system_set_gravity_factor(system, k, 1, 1, (double[]){0.3 * k - 4.0}));
  if (with.drag) check_ok(hooke_system_set_drag(system, 0.4));
  if (with.driven) drive(system);
  if (with.driven && with.drag)
    check_ok(hooke_system_set_force(system, pulse, NULL, NULL));
  else if (with.factors)
    load(system);
  return committed(system);
}

static void fill_bodies(const hooke_system *system, struct canonical_body *body) {
  assert_int_equal(system->mover_count, BODIES);
  for (int b = 0; b < BODIES; b++) {
    const struct hk_body *from = system->mover[b].thing;
    body[b] = (struct canonical_body){.count = from->count,
                                      .particle = from->particle,
                                      .mass = from->mass,
                                      .inverse_mass = from->inverse_mass,
                                      .inertia = from->inertia,
                                      .inverse_inertia = from->inverse_inertia,
                                      .centre = from->heavy,
                                      .lift = from->lift,
                                      .place = from->place,
                                      .rank = from->rank,
                                      .base = from->base,
                                      .triad = from->triad};
  }
}

/* By sums over the particles, in any order. */
static void check_weights(const hooke_system *system) {
  for (int b = 0; b < BODIES; b++) {
    const struct hk_body *body = system->mover[b].thing;
    double lift = 0.0, heavy[3] = {0.0};
    for (int64_t k = 0; k < body->count; k++) {
      const int32_t p = body->particle[k];
      const double share = system->constrained[p] ? 0.0 : system->mass[p] / body->mass;
      lift += share * system->gravity_factor[p];
      for (int a = 0; a < 3; a++)
        heavy[a] += share * system->gravity_factor[p] * body->place[3 * k + a];
    }
    check_close(body->lift, lift, 1e-13);
    check_close(largest_difference(3, body->heavy, heavy), 0.0, 1e-13);
  }
}

/* Kicks to the bit; what goes through stages, to what its equations are solved to. */
static void compare(uint64_t seed, struct features with, const char *method) {
  const int exactly = strcmp(method, "symplectic-euler") == 0 || strcmp(method, "verlet") == 0;
  const double gravity[3] = {0.3, -9.81, 0.7}, h = 0.0009765; /* no binary fraction */
  owned_system *system = mixed_system(seed, with, gravity);
  struct canonical canonical;
  struct canonical_body body[BODIES];
  canonical_create(system, &canonical);
  canonical.load_count = 0; /* which `pull` adds */
  canonical.gravity = with.gravity ? gravity : NULL;
  canonical.factor = system->gravity_factor;
  canonical.drag = with.drag ? 0.4 : 0.0;
  canonical.place = with.driven ? place : NULL;
  canonical.place_ctx = system;
  canonical.force = with.driven && with.drag ? pulse : with.factors ? pull : NULL;
  fill_bodies(system, body);
  if (with.factors) check_weights(system);
  hooke_integrator *integrator = start_with(system, .method = method, .step = h);
  hooke_state *state = start_state(system);
  double q[3 * N], v[3 * N];
  memcpy(q, hooke_state_position(state), sizeof q);
  memcpy(v, hooke_state_velocity(state), sizeof v);
  for (int k = 0; k < (exactly ? STEPS : 2); k++) {
    const int last = !exactly || (k + 1) % AT_ONCE == 0;
    if (last) check_ok(hooke_integrator_step(integrator, state, exactly ? AT_ONCE : 1));
    canonical_body_step(&canonical, BODIES, body, method, k * h, (k + 1) * h, h, q, v);
    if (!last) continue;
    if (exactly) check_same_bits(3 * N, hooke_state_position(state), q);
    if (exactly) check_same_bits(3 * N, hooke_state_velocity(state), v);
    const double off = largest_difference(3 * N, hooke_state_velocity(state), v);
    if (!(off <= 1e-11)) check_failed("%s, step %d: a velocity is off by %g m/s", method, k + 1, off);
    check_close(largest_difference(3 * N, hooke_state_position(state), q), 0.0, 1e-13);
  }
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  canonical_destroy(&canonical);
}

TEST(steps_are_the_plain_loops) {
  for (int features = 0; features < 16; features++) {
    const struct features with = {features & 1, features >> 1 & 1, features >> 2 & 1, features >> 3,
                                  features % 3 == 0};
    for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
      if (!hooke_method_is_suited(method, "bodies")) continue;
      for (uint64_t seed = 1; seed <= 2; seed++)
        compare(10 * (uint64_t)features + seed, with, method);
    }
  }
}
