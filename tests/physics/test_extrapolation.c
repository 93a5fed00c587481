/* The extrapolation in long double, the reference for wanted errors: solutions to 15 digits, the canonical
 * forces, motions, and its failures. The library's integrators are not used here. */
#include "check.h"
#include "long_force.h"
#include "random_scene.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <stdlib.h>
#include <math.h>

static struct extrapolation problem_of(struct long_force *force, long double tolerance) {
  return (struct extrapolation){.size = 6 * force->canonical->particle_count,
                                .rate = long_force_rate,
                                .scale = long_force_scale,
                                .ctx = force,
                                .tolerance = tolerance,
                                .most_evaluations = 1000000};
}

/* ---- solutions ---- */

static double worst_error(const struct reference *reference, long double tolerance) {
  owned_system *system = build_reference(reference);
  owned_state *state = start_state(system);
  const int64_t size = 3 * reference->particle_count;
  owned_canonical canonical;
  canonical_create(system, &canonical);
  canonical.gravity = reference->gravity;
  const double *q = hooke_state_position(state);
  struct long_force force = {.canonical = &canonical, .origin = q, .extent = long_force_extent(size / 3, q)};
  struct extrapolation problem = problem_of(&force, tolerance);
  long double *y = new_block(2 * size, (int64_t)sizeof *y), step = 1e-3L, t = 0.0L, worst = 0.0L;
  for (int64_t k = 0; k < size; k++)
    y[k] = q[k];
  for (int64_t s = 0; s < reference->state_count; s++) {
    const struct reference_state *true = &reference->state[s];
    assert_int_equal(extrapolate(&problem, t, true->time, &step, y), 0);
    for (int64_t k = 0; k < size; k++)
      worst = fmaxl(worst, fabsl(y[k] - true->position[k]));
    t = true->time;
  }
  free(y);
  return (double)worst;
}

TEST(test_solutions) {
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    check_between(worst_error(&references[k], 1e-15L), 0.0, 1e-13);
    check_between(worst_error(&references[k], 1e-5L), 1e-10, 1e-2);
  }
}

/* ---- forces ---- */

static void compare_forces(uint64_t seed, int32_t features) {
  owned_random_scene scene;
  random_scene_with(&scene, .seed = seed, .particles = 40, .springs = 90, .triples = 12, .tetrahedra = 12,
                    .anchors = 12, .features = features);
  const int64_t size = 3 * scene.canonical.particle_count;
  owned_doubles *q = new_doubles(size), *v = new_doubles(size), *a = new_doubles(size);
  long double *y = new_block(2 * size, (int64_t)sizeof *y), *f = new_block(2 * size, (int64_t)sizeof *f);
  random_scene_shake(&scene, seed, q, v);
  canonical_acceleration(&scene.canonical, 0.0, q, v, a);
  for (int64_t k = 0; k < size; k++) {
    y[k] = q[k];
    y[size + k] = v[k];
  }
  struct long_force force = {.canonical = &scene.canonical, .origin = q, .extent = 1.0};
  long_force_rate(0.0L, y, f, &force);
  const double scale = largest(size, a);
  for (int64_t k = 0; k < size; k++) {
    const int held = scene.canonical.inverse_mass[k / 3] == 0.0;
    check_close((double)f[k], held ? 0.0 : v[k], 0.0);
    check_close((double)f[size + k], a[k], 1e-12 * scale);
  }
  free(y);
  free(f);
}

TEST(test_forces) {
  for (uint64_t seed = 1; seed <= 40; seed++)
    compare_forces(seed,
                   (SCENE_EVERYTHING & ~SCENE_CALLBACK & ~SCENE_DRIVEN) & (int32_t)(seed * 0x9e3779b9u));
  compare_forces(41, SCENE_EVERYTHING & ~SCENE_CALLBACK & ~SCENE_DRIVEN);
}

enum { NET = 7 };

/* A net of seven particles under gravity, committed with a body of four of them that turns, held at particle
 * 0 or free, or overdamped. */
static hooke_system *make_net(const double *q, int64_t pinned, int32_t overdamped) {
  const double mass[NET] = {0.5, 1, 2, 0.7, 1.3, 0.4, 3}, spin[3] = {0.5, -1.0, 2.0};
  const int64_t ends[] = {0, 4, 1, 4, 2, 5, 3, 6, 4, 5, 5, 6}, body[4] = {0, 1, 2, 3};
  double v[3 * NET] = {[12] = 0.3, [16] = -0.2};
  for (int64_t p = 0; p < 4; p++) {
    for (int a = 0; a < 3; a++)
      v[3 * p + a] = spin[(a + 1) % 3] * (q[3 * p + (a + 2) % 3] - q[(a + 2) % 3]) -
                     spin[(a + 2) % 3] * (q[3 * p + (a + 1) % 3] - q[(a + 1) % 3]);
  }
  hooke_system *system = new_system();
  if (overdamped) check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_add_particles(system, NET, q, overdamped ? NULL : v, NET, mass, NULL));
  springs_with(system, 6, ends, .stiffness = 40.0, .damping = !overdamped, .rest_length = 0.5);
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 1.0}));
  check_ok(hooke_system_set_drag(system, 0.8));
  if (pinned >= 0) check_ok(hooke_system_pin(system, 1, &pinned));
  if (!overdamped) check_ok(hooke_system_add_body(system, "body", 4, body, 0));
  return committed(system);
}

/* The library's accelerations, those of a rigid motion in a body, or velocities of an overdamped system. */
static void compare_net(int64_t pinned, int32_t overdamped) {
  const double q[3 * NET] = {0, 0, 0, 1, 0.1, 0, 0.2, 0.9, 0.1, 0, 0.2, 1.1, 2, 0, 0, 1.5, 1.5, 0, 0, 2, 2};
  int64_t body[4] = {0, 1, 2, 3};
  const struct long_body bodies[] = {{4, body, pinned}};
  const double gravity[3] = {0.0, -9.81, 1.0};
  double a[3 * NET];
  long double y[6 * NET], f[6 * NET];
  owned_system *system = make_net(q, pinned, overdamped);
  owned_state *state = start_state(system);
  owned_canonical canonical;
  canonical_create(system, &canonical);
  canonical.gravity = gravity;
  canonical.drag = 0.8;
  struct long_force force = {.canonical = &canonical,
                             .origin = q,
                             .extent = 1.0,
                             .mass = overdamped ? hooke_system_mass(system) : NULL,
                             .body_count = !overdamped,
                             .body = bodies};
  const double *v = hooke_state_velocity(state);
  check_ok(hooke_system_acceleration(system, 0.0, q, v, a));
  for (int k = 0; k < 3 * NET; k++) {
    y[k] = q[k];
    y[3 * NET + k] = v[k];
  }
  long_force_rate(0.0L, y, f, &force);
  check_between(largest(3 * NET, a), 10.0, 1000.0);
  for (int k = 0; k < 3 * NET; k++) {
    check_close((double)f[(overdamped ? 0 : 3 * NET) + k], a[k], 1e-12 * largest(3 * NET, a));
    check_close((double)f[(overdamped ? 3 * NET : 0) + k], overdamped ? 0.0 : v[k], 0.0);
  }
}

TEST(test_bodies) {
  compare_net(-1, 0);
  compare_net(0, 0);
}

TEST(test_overdamped) {
  compare_net(-1, 1);
  compare_net(0, 1);
}

/* ---- motions ---- */

/* Position and velocity of a driven particle in the library. */
static void compare_motion(const struct long_drive *drive, double t) {
  const double origin[3] = {0.3, -0.2, 0.1}, mass = 1.0;
  const int64_t one = 0;
  owned_system *system = small_system(1, origin, NULL, mass, 0);
  if (drive->samples > 0)
    check_ok(hooke_system_drive_table(system, 1, &one, drive->samples, drive->time, drive->displacement));
  else
    check_ok(hooke_system_drive_harmonic(system, 1, &one, drive->amplitude, drive->frequency, drive->phase));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "forward-euler", .step = 1.0);
  hooke_state_set_time(state, t);
  check_ok(hooke_integrator_step(integrator, state, 0));
  long double d[3], u[3];
  long_drive_move(drive, t, d, u);
  for (int a = 0; a < 3; a++) {
    check_close(hooke_state_position(state)[a], origin[a] + (double)d[a], 1e-14);
    check_close(hooke_state_velocity(state)[a], (double)u[a], 1e-12);
  }
}

TEST(test_motions) {
  double time[] = {0.1, 0.25, 0.4, 0.9};
  double displacement[] = {0, 0, 0, 0.01, 0.02, -0.01, 0.015, -0.01, 0.0, 0.03, 0.01, 0.02};
  const struct long_drive wave = {.amplitude = {0.1, -0.2, 0.05}, .frequency = 3.0, .phase = 0.7};
  for (int64_t samples = 2; samples <= 4; samples++) {
    const struct long_drive table = {.samples = samples, .time = time, .displacement = displacement};
    for (int k = 0; k <= 22; k++)
      compare_motion(&table, 0.05 * k);
  }
  for (int k = 0; k <= 10; k++)
    compare_motion(&wave, 0.13 * k);
}

/* ---- jumps, and failures ---- */

/* y'' = -1 where y > 0, else +4: crossing 0 the force jumps. */
static void jumping(long double t, long double *y, long double *f, void *ctx) {
  (void)t;
  (void)ctx;
  f[0] = y[1];
  f[1] = y[0] > 0.0L ? -1.0L : 4.0L;
}

static void equally(const long double *y, const long double *f, long double *scale, void *ctx) {
  (void)y;
  (void)f;
  (void)ctx;
  scale[0] = scale[1] = 1.0L;
}

/* From y = 1/2 at rest: 0 at t = 1 with speed -1, back there at 3/2 with speed 1, at rest at 1/2 at 5/2. */
TEST(test_jumps) {
  struct extrapolation problem = {
      .size = 2, .rate = jumping, .scale = equally, .tolerance = 1e-15L, .most_evaluations = 100000};
  long double y[2] = {0.5L, 0.0L}, step = 0.1L;
  assert_int_equal(extrapolate(&problem, 0.0L, 2.5L, &step, y), 0);
  check_close((double)(y[0] - 0.5L), 0.0, 1e-12);
  check_close((double)y[1], 0.0, 1e-12);
  assert_true(problem.rejected > 5);
}

static void blowing_up(long double t, long double *y, long double *f, void *ctx) {
  (void)t;
  (void)ctx;
  f[0] = y[0] * y[0];
}

static void by_one(const long double *y, const long double *f, long double *scale, void *ctx) {
  (void)y;
  (void)f;
  (void)ctx;
  scale[0] = 1.0L;
}

/* y' = y^2 from 1 has y = 1/(1 - t): it ends before t = 1, and the number of steps shows it. */
TEST(test_giving_up) {
  struct extrapolation problem = {
      .size = 1, .rate = blowing_up, .scale = by_one, .tolerance = 1e-15L, .most_evaluations = 20000};
  long double y = 1.0L, step = 0.1L;
  assert_int_equal(extrapolate(&problem, 0.0L, 0.9L, &step, &y), 0);
  check_close((double)y, 10.0, 1e-11);
  assert_int_equal(extrapolate(&problem, 0.9L, 1.1L, &step, &y), -1);
}
