/* Springs that pass through length zero: as many as a loop of the test's own counts, by every method. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Counts turns by more than a right angle from step to step. */
struct counter {
  const hooke_system *system;
  int64_t springs, *ends, passages, first[2];
  double *rest_length, *before, at;
};

static void begin_counting(const hooke_system *system, struct counter *c) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_state *state = start_state(system);
  *c = (struct counter){.system = system, .springs = hooke_system_count(system, "springs")};
  c->ends = new_block(2 * c->springs, sizeof *c->ends);
  c->rest_length = new_doubles(c->springs);
  c->before = new_doubles(size);
  check_ok(hooke_system_members(system, "springs", c->ends, NULL, NULL, c->rest_length));
  memcpy(c->before, hooke_state_position(state), (size_t)size * sizeof(double));
}

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  struct counter *c = ctx;
  const double *q = hooke_state_position(state);
  (void)step;
  for (int64_t s = 0; s < c->springs; s++) {
    const int64_t i = 3 * c->ends[2 * s], j = 3 * c->ends[2 * s + 1];
    double along = 0.0;
    for (int a = 0; a < 3; a++)
      along += (c->before[i + a] - c->before[j + a]) * (q[i + a] - q[j + a]);
    if (!(along < 0.0) || c->rest_length[s] == 0.0) continue;
    if (c->passages++ == 0) {
      memcpy(c->first, c->ends + 2 * s, sizeof c->first);
      c->at = hooke_state_time(state);
    }
  }
  memcpy(c->before, q, 3 * (size_t)hooke_system_particle_count(c->system) * sizeof(double));
  return 0;
}

static void end_counting(struct counter *c) {
  free(c->ends);
  free(c->rest_length);
  free(c->before);
}

static int64_t passages_of(const hooke_integrator *integrator) {
  return hooke_integrator_count(integrator, "zero_passages");
}

/* Compares a watched run, and one that nobody watches between its two frames; returns the count. */
static int64_t check_run(const hooke_system *system, struct run run, int32_t threads) {
  struct counter counter;
  char words[64];
  begin_counting(system, &counter);
  run.every = run.duration;
  hooke_integrator *integrator = start_run(system, run);
  hooke_state *state = start_state(system);
  check_ok(hooke_integrator_on_step(integrator, 1, see, &counter));
  check_ok(hooke_integrator_run(integrator, state));
  if (passages_of(integrator) != counter.passages)
    check_failed("%s by %g s: %d of %d", run.method, run.step, (int)passages_of(integrator),
                 (int)counter.passages);
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  run.threads = threads;
  integrator = start_run(system, run);
  state = start_state(system);
  assert_string_equal(hooke_integrator_text(integrator, "zero_passages"), "");
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(passages_of(integrator), counter.passages);
  const char *told = hooke_integrator_text(integrator, "zero_passages");
  snprintf(words, sizeof words, "%lld time", (long long)counter.passages);
  assert_true(counter.passages > 0 ? strstr(told, words) != NULL : told[0] == '\0');
  snprintf(words, sizeof words, "of particles %d and %d at", (int)counter.first[0], (int)counter.first[1]);
  if (counter.passages > 0 && counter.springs < 3) assert_non_null(strstr(told, words));
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  end_counting(&counter);
  return counter.passages;
}

struct scene {
  const char *name;
  double q[9], v[9], rest_length;
  int64_t particles;
  int32_t passes;
};

static const struct scene scenes[] = {
    {"along x", {0, 0, 0, 1.5, 0, 0}, {0}, 0.5, 2, 1},
    {"oblique", {0, 0, 0, 0.9, 0.7, -0.4}, {0}, 0.5, 2, 1},
    {"two springs", {0, 0, 0, 0.6, 0, 0, 2.1, 0, 0}, {0, 0, 0, 3, 0, 0, -2, 0, 0}, 0.5, 3, 1},
    {"a start near zero", {0, 0, 0, 0.001, 0, 0}, {0, 0, 0, 3, 0, 0}, 0.5, 2, 1},
    {"a start through zero", {0, 0, 0, 0.001, 0, 0}, {0, 0, 0, -3, 0, 0}, 0.5, 2, 1},
    {"rest length 0", {0, 0, 0, 1.5, 0, 0}, {0}, 0.0, 2, 0},
    {"a spring that turns", {0, 0, 0, 1.5, 0, 0}, {0, 0, 0, 0, 0.3, 0}, 0.5, 2, 0},
    {"a short one that turns", {0, 0, 0, 1.5, 0, 0}, {0, 0, 0, 0, 0.1, 0.1}, 0.2, 2, 0},
};

static hooke_system *system_of(const struct scene *scene) {
  const int64_t ends[] = {0, 1, 1, 2};
  hooke_system *system = small_system(scene->particles, scene->q, scene->v, 1.0, 1);
  const struct springs springs = {"length", 10.0, 0.1, scene->rest_length, 0};
  small_springs(system, scene->particles - 1, ends, springs);
  return committed(system);
}

TEST(test_every_method) {
  for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
    owned_system *system = system_of(&scenes[k]);
    for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
      for (int fine = 0; fine < 2; fine++) {
        const struct run run = {
            .method = method, .step = fine ? 0.004 : 0.02, .duration = 10.0, .rtol = 1e-6};
        const int64_t count = check_run(system, run, 1);
        if ((count > 0) != scenes[k].passes) check_failed("%s, %s: %d", scenes[k].name, method, (int)count);
      }
    }
  }
}

/* ---- many springs, in batches and by threads ---- */

enum { PAIRS = 17000 };

/* Pairs of particles on their own, next to one another or far apart in a random order. */
static hooke_system *pairs(int32_t shuffled) {
  struct random_source source = {7};
  owned_doubles *q = new_doubles(6 * (int64_t)PAIRS), *v = new_doubles(6 * (int64_t)PAIRS);
  owned_wholes *ends = new_block(2 * (int64_t)PAIRS, sizeof *ends);
  for (int64_t k = 0; k < 2 * (int64_t)PAIRS; k++)
    ends[k] = k;
  for (int64_t k = 2 * (int64_t)PAIRS - 1; k > 0 && shuffled; k--) {
    const int64_t other = random_whole(&source, 0, k), kept = ends[k];
    ends[k] = ends[other];
    ends[other] = kept;
  }
  for (int64_t k = 0; k < PAIRS; k++) {
    for (int a = 0; a < 3; a++) {
      q[3 * ends[2 * k] + a] = random_between(&source, -1.0, 1.0);
      q[3 * ends[2 * k + 1] + a] = q[3 * ends[2 * k] + a] + random_between(&source, -0.3, 0.3);
      v[3 * ends[2 * k] + a] = 20.0 * (q[3 * ends[2 * k + 1] + a] - q[3 * ends[2 * k] + a]);
    }
  }
  hooke_system *system = small_system(2 * (int64_t)PAIRS, q, v, 1.0, 0);
  springs_with(system, PAIRS, ends, "length", 10.0, 0.0, 0.5, 0);
  return committed(system);
}

TEST(test_batches_and_threads) {
  for (int shuffled = 0; shuffled < 2; shuffled++) {
    owned_system *system = pairs(shuffled);
    const struct run alone = {.method = "symplectic-euler", .step = 0.004, .duration = 0.08, .threads = 1},
                     together = {.method = "verlet", .step = 0.004, .duration = 0.08, .threads = 2};
    assert_in_range(check_run(system, alone, 2), PAIRS / 2, 2 * PAIRS);
    assert_in_range(check_run(system, together, 1), PAIRS / 2, 2 * PAIRS);
  }
}

/* ---- anchors, loops of the caller's own, and what is not known ---- */

TEST(test_anchors) {
  const double q[] = {2, 0, 0, 2, 1, 0}, points[] = {0.5, 0, 0, 0.5, 1, 0}, rest_length[] = {0.5, 0.0};
  const int64_t particles[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 0);
  owned_options *options = options_with("anchors", "stiffness=10");
  check_ok(hooke_options_set_numbers(options, "points", 6, points));
  check_ok(hooke_options_set_numbers(options, "rest_length", 2, rest_length));
  check_ok(hooke_system_add_anchors(system, NULL, 2, particles, options));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "rk4", .step = 0.01, .duration = 1.0);
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(passages_of(integrator), 1);
  assert_non_null(strstr(hooke_integrator_text(integrator, "zero_passages"),
                         "1 time, first that of particle 0 and its anchor at t = 0.6"));
  assert_null(hooke_integrator_text(integrator, "passages"));
}

TEST(test_own_loops) {
  owned_system *system = system_of(&scenes[1]);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const struct run run = {.method = hooke_method_name(m), .step = 0.01, .duration = 4.0, .rtol = 1e-6};
    if (hooke_method_is_built(run.method) != 1) continue;
    const int64_t whole = check_run(system, run, 1);
    for (int advances = 0; advances < 2; advances++) {
      owned_integrator *integrator = start_run(system, run);
      owned_state *state = start_state(system);
      check_ok(hooke_integrator_step(integrator, state, 0));
      while (hooke_state_time(state) < 4.0 - 1e-9) {
        check_ok(advances ? hooke_integrator_advance(integrator, 5)
                          : hooke_integrator_step(integrator, state, 5));
        check_ok(hooke_integrator_sync(integrator, state));
      }
      check_between((double)passages_of(integrator), (double)whole,
                    (double)whole + !is_fixed_step(run.method));
    }
  }
}

/* A particle that is put on the other side by hand has not passed. */
TEST(test_putting) {
  const double there[] = {-0.2, 0, 0}, slow[] = {0, 0, 0};
  const int64_t particle = 1;
  owned_system *system = system_of(&scenes[0]);
  owned_run(integrator, state, system, .method = "verlet", .step = 0.01);
  check_ok(hooke_integrator_step(integrator, state, 62));
  assert_int_equal(passages_of(integrator), 0);
  check_between(hooke_state_position(state)[3], 0.05, 0.25);
  check_ok(hooke_integrator_put(integrator, 1, &particle, there, slow));
  check_ok(hooke_integrator_advance(integrator, 5));
  assert_int_equal(passages_of(integrator), 0);
}

TEST(test_checkpoint) {
  const char *path = "passages-checkpoint";
  const struct run run = {.method = "rk4", .step = 0.01, .duration = 10.0};
  owned_system *system = system_of(&scenes[0]);
  hooke_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_step(integrator, state, 100));
  assert_int_equal(passages_of(integrator), 1);
  check_ok(hooke_checkpoint_write(path, integrator, state, NULL));
  hooke_integrator_destroy(integrator);
  integrator = start_run(system, run);
  check_ok(hooke_checkpoint_read(path, NULL, integrator, state));
  assert_int_equal(passages_of(integrator), -1);
  check_ok(hooke_integrator_step(integrator, state, 200));
  assert_int_equal(passages_of(integrator), -1);
  assert_non_null(strstr(hooke_integrator_text(integrator, "zero_passages"), "length zero at least "));
  hooke_integrator_destroy(integrator);
  remove(path);
}

/* ---- the signed model ---- */

static double end_of(double wall, double rest_length, int64_t *passages) {
  const double q[] = {wall, 0, 0, 1.5, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, "length", 10.0, 0.1, rest_length, 0);
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "rk4", .step = 0.002, .duration = 10.0);
  check_ok(hooke_integrator_run(integrator, state));
  *passages = passages_of(integrator);
  return hooke_state_position(state)[3];
}

/* A far wall makes the spring a signed one: x = 0.5 + a damped oscillation. */
TEST(test_far_wall) {
  const double w = sqrt(10.0 - 0.05 * 0.05), t = 10.0;
  const double x = 0.5 + exp(-0.05 * t) * (cos(w * t) + 0.05 / w * sin(w * t));
  int64_t passages;
  check_close(end_of(-10.0, 10.5, &passages), x, 1e-9);
  assert_int_equal(passages, 0);
  check_close(fabs(end_of(0.0, 0.5, &passages) - x), 1.79, 0.1);
  assert_int_equal(passages, 7);
}
