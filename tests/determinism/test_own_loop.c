/* Time loops of the caller's own: single steps, and steps of the integrator's own motion, end in the bits of
 * a run; single particles of that motion are those of the state. */
#include "check.h"
#include "moving_scene.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

enum { STEPS = 24, SHEET = 120, SCENES = MOVING_SCENES + 2 };

static const char *const counts[] = {"steps", "force_evaluations", "nonlinear_iterations",
                                     "linear_iterations"};

/* A damped sheet whose particles and springs are numbered in random order. */
static hooke_system *unordered_sheet(void) {
  const int64_t n = SHEET * SHEET;
  struct random_source source = {11};
  owned_doubles *position = new_doubles(3 * n);
  int64_t *number = new_block(n, sizeof *number), *ends = new_block(4 * n, sizeof *ends), springs = 0;
  for (int64_t p = 0; p < n; p++) {
    const int64_t other = random_whole(&source, 0, p);
    number[p] = number[other];
    number[other] = p;
  }
  for (int64_t p = 0; p < n; p++) {
    position[3 * number[p]] = 0.1 * (double)(p % SHEET) + random_between(&source, 0.0, 0.01);
    position[3 * number[p] + 1] = 0.1 * (double)(p / SHEET) + random_between(&source, 0.0, 0.01);
  }
  for (int64_t k = 0; k < 2 * n; k++) {
    const int64_t p = k / 2 * 7919 % n, other = k % 2 ? p + SHEET : p + 1;
    if (k % 2 ? other >= n : other % SHEET == 0) continue;
    ends[2 * springs] = number[p];
    ends[2 * springs + 1] = number[other];
    springs++;
  }
  hooke_system *system = small_system(n, position, NULL, 0.01, 1);
  springs_with(system, springs, ends, .stiffness = 5.0, .damping = 1e-3, .rest_length = 0.1);
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, 0.0, -9.81}));
  check_ok(hooke_system_commit(system));
  free(ends);
  free(number);
  return system;
}

static hooke_system *make_system(int scene) {
  return scene <= MOVING_SCENES ? moving_system(&moving_scenes[scene]) : unordered_sheet();
}

/* A power of two, so that times have no rounding from any start. */
static struct run run_of(const char *method, int32_t threads) {
  return (struct run){.method = method,
                      .step = 1.0 / 4096,
                      .duration = STEPS / 4096.0,
                      .every = STEPS / 4096.0,
                      .threads = threads,
                      .newton = is_implicit(method) ? "one-iteration" : NULL};
}

/* A running method, and its current state. */
struct loop {
  hooke_integrator *integrator;
  hooke_state *state;
};

static struct loop loop_start(const hooke_system *system, struct run run) {
  return (struct loop){start_run(system, run), start_state(system)};
}

static void loop_end(struct loop *loop) {
  hooke_integrator_destroy(loop->integrator);
  hooke_state_destroy(loop->state);
}

static void check_same_state(const hooke_state *found, const hooke_state *expected) {
  hooke_state *const a = (hooke_state *)(uintptr_t)found, *const b = (hooke_state *)(uintptr_t)expected;
  const double times[] = {hooke_state_time(found), hooke_state_time(expected)};
  check_same_bits(1, &times[0], &times[1]);
  check_same_bits(hooke_state_size(found), hooke_state_position(a), hooke_state_position(b));
  if (hooke_state_velocity(a))
    check_same_bits(hooke_state_size(found), hooke_state_velocity(a), hooke_state_velocity(b));
}

static void check_same_loop(const struct loop *found, const struct loop *expected) {
  check_same_state(found->state, expected->state);
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    assert_int_equal(hooke_integrator_count(found->integrator, counts[k]),
                     hooke_integrator_count(expected->integrator, counts[k]));
}

/* ---- the same bits ---- */

static void advance_one_by_one(struct loop *loop) {
  check_ok(hooke_integrator_step(loop->integrator, loop->state, 0));
  for (int64_t k = 0; k < STEPS; k++)
    check_ok(hooke_integrator_advance(loop->integrator, 1));
  check_ok(hooke_integrator_sync(loop->integrator, loop->state));
}

/* Alternates between all ways of stepping, and takes none of the states in between. */
static void mix(struct loop *loop) {
  check_ok(hooke_integrator_step(loop->integrator, loop->state, 3));
  check_ok(hooke_integrator_advance(loop->integrator, 5));
  check_ok(hooke_integrator_advance(loop->integrator, 0));
  check_ok(hooke_integrator_sync(loop->integrator, loop->state));
  check_ok(hooke_integrator_step(loop->integrator, loop->state, 1));
  check_ok(hooke_integrator_step(loop->integrator, loop->state, 1));
  check_ok(hooke_integrator_sync(loop->integrator, loop->state));
  check_ok(hooke_integrator_advance(loop->integrator, STEPS - 11));
  check_ok(hooke_integrator_sync(loop->integrator, loop->state));
  check_ok(hooke_integrator_sync(loop->integrator, loop->state));
  check_ok(hooke_integrator_step(loop->integrator, loop->state, 1));
}

static void check_ways(const hooke_system *system, struct run run) {
  owned(loop_end) struct loop whole = loop_start(system, run);
  struct loop loop = loop_start(system, run);
  if (is_fixed_step(run.method))
    check_ok(hooke_integrator_run(whole.integrator, whole.state));
  else
    check_ok(hooke_integrator_step(whole.integrator, whole.state, STEPS));
  for (int64_t k = 0; k < STEPS; k++)
    check_ok(hooke_integrator_step(loop.integrator, loop.state, 1));
  check_same_loop(&loop, &whole);
  loop_end(&loop);

  loop = loop_start(system, run);
  advance_one_by_one(&loop);
  check_same_loop(&loop, &whole);
  loop_end(&loop);

  loop = loop_start(system, run);
  mix(&loop);
  check_same_loop(&loop, &whole);
  loop_end(&loop);
}

/* The references come last. */
static const char *method_of(int64_t number) {
  static const char *const references[] = {"rk8pd", "arkode-esdirk"};
  const int64_t more = number - hooke_method_count();
  return more < 0 ? hooke_method_name(number) : more < 2 ? references[more] : NULL;
}

static void for_every_method(void (*check)(const hooke_system *, struct run)) {
  for (int scene = 0; scene < SCENES; scene++) {
    owned_system *system = make_system(scene);
    const int32_t threads = scene >= MOVING_LARGE ? 2 : 1;
    const char *method;
    for (int64_t m = 0; (method = method_of(m)) != NULL; m++) {
      if (hooke_method_is_built(method) != 1 || (scene >= MOVING_LARGE && !is_fixed_step(method))) continue;
      for (int32_t k = 1; k <= threads; k++)
        check(system, run_of(method, k));
    }
  }
}

TEST(test_ways) {
  for_every_method(check_ways);
}

/* ---- single particles ---- */

enum { SOME = 5 };

/* The last one is driven where there is a drive; one comes twice. */
static void choose(const hooke_system *system, int64_t particle[SOME]) {
  const int64_t n = hooke_system_particle_count(system);
  const int64_t chosen[SOME] = {n - 1, 0, n / 2, 1, n / 2};
  memcpy(particle, chosen, sizeof chosen);
}

static void check_get(const struct loop *loop, const int64_t particle[SOME]) {
  double q[3 * SOME], v[3 * SOME], alone[3 * SOME];
  check_ok(hooke_integrator_get(loop->integrator, SOME, particle, q, v));
  for (int k = 0; k < SOME; k++) {
    check_same_bits(3, q + 3 * k, hooke_state_position(loop->state) + 3 * particle[k]);
    check_same_bits(3, v + 3 * k, hooke_state_velocity(loop->state) + 3 * particle[k]);
  }
  check_ok(hooke_integrator_get(loop->integrator, SOME, particle, NULL, alone));
  check_same_bits(3 * SOME, alone, v);
  check_ok(hooke_integrator_get(loop->integrator, SOME, particle, alone, NULL));
  check_same_bits(3 * SOME, alone, q);
  check_ok(hooke_integrator_get(loop->integrator, 0, NULL, NULL, NULL));
}

/* Small changes to position, velocity or both of some particles. */
static void change(int round, double *q, double *v) {
  for (int k = 0; k < 3; k++) {
    if (round != 1) q[k] += 1e-3 * (k + 1);
    if (round != 2) v[k] -= 1e-2 * (k - 1);
  }
}

static void put_changes(struct loop *loop, const int64_t particle[SOME], int round) {
  double q[3 * SOME], v[3 * SOME];
  check_ok(hooke_integrator_get(loop->integrator, SOME, particle, q, v));
  for (int k = 0; k < SOME; k++)
    change(round, q + 3 * k, v + 3 * k);
  check_ok(
      hooke_integrator_put(loop->integrator, SOME, particle, round == 1 ? NULL : q, round == 2 ? NULL : v));
}

static void write_changes(struct loop *loop, const int64_t particle[SOME], int round) {
  for (int k = 0; k + 1 < SOME; k++) /* the last particle was at this position before */
    change(round, hooke_state_position(loop->state) + 3 * particle[k],
           hooke_state_velocity(loop->state) + 3 * particle[k]);
}

/* A change of the motion has the same effect as that change of a state. */
static void check_particles(const hooke_system *system, struct run run) {
  int64_t particle[SOME];
  choose(system, particle);
  owned(loop_end) struct loop loop = loop_start(system, run), written = loop_start(system, run);
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 2));
  check_ok(hooke_integrator_step(written.integrator, written.state, 2));
  for (int round = 0; round < 3; round++) {
    put_changes(&loop, particle, round);
    write_changes(&written, particle, round);
    check_ok(hooke_integrator_advance(loop.integrator, 3));
    check_ok(hooke_integrator_step(written.integrator, written.state, 3));
    check_ok(hooke_integrator_sync(loop.integrator, loop.state));
    check_get(&loop, particle);
    check_same_loop(&loop, &written);
  }
}

TEST(test_particles) {
  for_every_method(check_particles);
}

/* A pinned particle is held where it is put, with zero velocity. */
TEST(test_pinned) {
  owned_system *system = moving_system(&moving_scenes[0]);
  owned(loop_end) struct loop loop = loop_start(system, run_of("symplectic-euler", 1));
  const int64_t pinned = 1;
  const double q[] = {0.25, 0.5, -0.75}, v[] = {1, 2, 3}, rest[3] = {0};
  double found[6];
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 1));
  check_ok(hooke_integrator_put(loop.integrator, 1, &pinned, q, v));
  check_ok(hooke_integrator_advance(loop.integrator, 2));
  check_ok(hooke_integrator_get(loop.integrator, 1, &pinned, found, found + 3));
  check_same_bits(3, found, q);
  check_same_bits(3, found + 3, rest);
}

/* ---- observers ---- */

struct watch {
  int64_t calls, stop_at, size;
  double *last; /* t, q, v */
};

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  const size_t bytes = (size_t)watch->size * sizeof(double);
  assert_int_equal(step, ++watch->calls * 2);
  watch->last[0] = hooke_state_time(state);
  memcpy(watch->last + 1, hooke_state_position(seen), bytes);
  memcpy(watch->last + 1 + watch->size, hooke_state_velocity(seen), bytes);
  return watch->calls == watch->stop_at ? 7 : 0;
}

/* Observers get the same calls as for steps in one call, and may stop; the motion continues from there. */
static void check_watched(const hooke_system *system, struct run run) {
  owned(loop_end) struct loop loop = loop_start(system, run), alone = loop_start(system, run);
  struct watch watch = {.stop_at = 3, .size = hooke_state_size(loop.state)};
  watch.last = new_doubles(1 + 2 * watch.size);
  check_ok(hooke_integrator_on_step(loop.integrator, 2, see, &watch));
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 0));
  check_status(hooke_integrator_advance(loop.integrator, STEPS), HOOKE_STOPPED);
  assert_int_equal(hooke_integrator_count(loop.integrator, "stop_value"), 7);
  check_ok(hooke_integrator_sync(loop.integrator, loop.state));
  check_ok(hooke_integrator_step(alone.integrator, alone.state, 6));
  check_same_state(loop.state, alone.state);
  check_same_bits(watch.size, watch.last + 1, hooke_state_position(alone.state));
  check_same_bits(watch.size, watch.last + 1 + watch.size, hooke_state_velocity(alone.state));
  check_ok(hooke_integrator_advance(loop.integrator, 7));
  assert_int_equal(watch.calls, 6);
  check_ok(hooke_integrator_sync(loop.integrator, loop.state));
  check_ok(hooke_integrator_step(alone.integrator, alone.state, 7));
  check_same_state(loop.state, alone.state);
  free(watch.last);
}

TEST(test_watched) {
  for_every_method(check_watched);
}

/* ---- divergence ---- */

static struct loop start_wild(const hooke_system *system, double step) {
  return loop_start(system, (struct run){.method = "forward-euler", .step = step});
}

/* Each call of a step checks for non-finite numbers, and leaves the state of the previous call. */
TEST(test_steps_diverge) {
  owned_system *system = small_oscillator(10.0);
  struct loop loop = start_wild(system, 10.0);
  hooke_state *before = start_state(system), *recent = start_state(system);
  int32_t status = HOOKE_OK;
  int64_t k = 0;
  for (; k < 999 && status == HOOKE_OK; k++) {
    check_ok(hooke_state_copy(loop.state, before));
    status = hooke_integrator_step(loop.integrator, loop.state, 1);
    if (status != HOOKE_OK) break;
    check_ok(hooke_integrator_recent(loop.integrator, 0, recent));
    check_same_state(recent, loop.state);
    if (k == 0) continue;
    check_ok(hooke_integrator_recent(loop.integrator, 1, recent));
  }
  check_status(status, HOOKE_DIVERGED);
  check_between((double)k, 70, 100);
  check_close(hooke_integrator_number(loop.integrator, "diverged_at"), 10.0 * (double)(k + 1), 0.0);
  check_same_state(loop.state, before);
  check_ok(hooke_integrator_recent(loop.integrator, 0, recent));
  check_same_state(recent, before);
  check_status(hooke_integrator_advance(loop.integrator, 1), HOOKE_BAD_CALL);
  check_message("ended early");
  hooke_state_destroy(recent);
  hooke_state_destroy(before);
  loop_end(&loop);
}

/* Without a state the check is made every 1000 steps, and when the state is requested. */
TEST(test_motion_diverges) {
  owned_system *system = small_oscillator(10.0);
  struct loop loop = start_wild(system, 0.01);
  owned_state *start = start_state(system);
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 0));
  check_ok(hooke_integrator_advance(loop.integrator, 999));
  check_status(hooke_integrator_advance(loop.integrator, 1), HOOKE_DIVERGED); /* by its energy */
  check_close(hooke_integrator_number(loop.integrator, "diverged_at"), 10.0, 0.0);
  check_ok(hooke_integrator_sync(loop.integrator, loop.state));
  check_same_state(loop.state, start);
  check_status(hooke_integrator_get(loop.integrator, 0, NULL, NULL, NULL), HOOKE_BAD_CALL);
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 1)); /* restarts */
  check_ok(hooke_integrator_advance(loop.integrator, 1));
  loop_end(&loop);

  loop = start_wild(system, 10.0);
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 0));
  check_ok(hooke_integrator_advance(loop.integrator, 500));
  check_status(hooke_integrator_sync(loop.integrator, loop.state), HOOKE_DIVERGED);
  check_same_state(loop.state, start);
  check_status(hooke_integrator_advance(loop.integrator, 1), HOOKE_BAD_CALL);
  loop_end(&loop);
}

/* Moving particles may add any energy. */
TEST(test_put_brings_energy) {
  owned_system *system = small_oscillator(10.0);
  const int64_t particle = 1;
  for (int put = 0; put < 2; put++) {
    owned(loop_end) struct loop loop =
        loop_start(system, (struct run){.method = "symplectic-euler", .step = 0.01});
    const double v[] = {put ? 1e3 : 0.0, 0.5, 0.0};
    check_ok(hooke_integrator_step(loop.integrator, loop.state, 0));
    check_ok(hooke_integrator_put(loop.integrator, 1, &particle, NULL, v));
    check_ok(hooke_integrator_advance(loop.integrator, 2000));
    check_ok(hooke_integrator_sync(loop.integrator, loop.state));
  }
}

/* ---- misuse ---- */

static void check_no_motion(struct loop *loop) {
  double q[3];
  const int64_t particle = 0;
  check_status(hooke_integrator_advance(loop->integrator, 1), HOOKE_BAD_CALL);
  check_message("0 steps");
  check_status(hooke_integrator_sync(loop->integrator, loop->state), HOOKE_BAD_CALL);
  check_status(hooke_integrator_get(loop->integrator, 1, &particle, q, NULL), HOOKE_BAD_CALL);
  check_status(hooke_integrator_put(loop->integrator, 1, &particle, q, NULL), HOOKE_BAD_CALL);
}

TEST(test_misuse) {
  owned_system *system = moving_system(&moving_scenes[0]), *other = small_oscillator(1.0);
  owned(loop_end) struct loop loop = loop_start(system, run_of("verlet", 1));
  hooke_state *before = start_state(system), *small = start_state(other);
  const int64_t n = hooke_system_particle_count(system), particle[] = {2, n}, below[] = {-1};
  double q[] = {1, 2, 3, 4, 5, 6}, bad[] = {1, 2, 3, 4, NAN, 6};
  check_no_motion(&loop);
  check_ok(hooke_integrator_step(loop.integrator, loop.state, 2));
  check_ok(hooke_state_copy(loop.state, before));
  check_status(hooke_integrator_advance(loop.integrator, -1), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_advance(loop.integrator, INT64_MAX), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_sync(loop.integrator, small), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_put(loop.integrator, 2, particle, q, NULL), HOOKE_BAD_VALUE);
  check_message("particles[1]");
  check_status(hooke_integrator_get(loop.integrator, 1, below, q, NULL), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_get(loop.integrator, -1, particle, q, NULL), HOOKE_BAD_VALUE);
  check_status(hooke_integrator_put(loop.integrator, 2, (int64_t[]){2, 3}, q, bad), HOOKE_BAD_VALUE);
  check_message("velocity[1][1]");
  check_status(hooke_integrator_put(loop.integrator, 2, (int64_t[]){2, 3}, bad, q), HOOKE_BAD_VALUE);
  check_message("position[1][1]");
  check_ok(hooke_integrator_sync(loop.integrator, loop.state)); /* nothing was written */
  check_same_state(loop.state, before);
  hooke_state_destroy(small);
  hooke_state_destroy(before);
}

/* ---- first-order problems ---- */

static int32_t turn(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)t, (void)ctx;
  rate[0] = -x[1];
  rate[1] = x[0];
  return 0;
}

TEST(test_first_order) {
  const char *const methods[] = {"forward-euler", "rk4", "cvode-adams"};
  for (int m = 0; m < 3; m++) {
    if (hooke_method_is_built(methods[m]) != 1) continue;
    struct loop loop[2];
    double q[3];
    for (int k = 0; k < 2; k++) {
      loop[k].integrator = start_first_order(2, turn, NULL, (struct run){.method = methods[m], .step = 0.1});
      check_ok(hooke_state_create_first_order(2, &loop[k].state));
      hooke_state_position(loop[k].state)[0] = 1.0;
    }
    for (int k = 0; k < STEPS; k++)
      check_ok(hooke_integrator_step(loop[0].integrator, loop[0].state, 1));
    advance_one_by_one(&loop[1]);
    check_same_loop(&loop[1], &loop[0]);
    check_status(hooke_integrator_get(loop[0].integrator, 1, (int64_t[]){0}, q, NULL), HOOKE_UNSUITED);
    loop_end(&loop[0]);
    loop_end(&loop[1]);
  }
}
