/* Runs that are stopped anywhere and continued elsewhere end in the same bits, with the same frames and
 * counts, as an uninterrupted run; for every method, including those for references. */
#include "check.h"
#include "hash.h"
#include "memory_folder.h"
#include "moving_scene.h"
#include "random.h"
#include "run.h"
#include "sanitized.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { STEPS = 60, FRAME_STEPS = 7, MOST_STOPS = 3, MOST_FRAMES = 64 };

static const char *const counts[] = {"steps",
                                     "force_evaluations",
                                     "derivative_products",
                                     "nonlinear_iterations",
                                     "nonlinear_failures",
                                     "linear_iterations",
                                     "error_test_failures"};
enum { COUNTS = sizeof counts / sizeof counts[0] };

/* Output of a run: each frame, the last being the end, is t, step, q, v. */
struct trace {
  int64_t size, frames;
  double *row;
  int64_t count[COUNTS];
};

/* A running run. */
struct course {
  struct trace *trace;
  hooke_integrator *integrator;
  char path[64];
  int64_t calls, stop_at; /* step observers so far, and the one that stops; 0: none */
  int64_t kept;           /* number of frames when the checkpoint was written */
  int32_t at_points;      /* 1: checkpoints are written where they fall due, otherwise where the run stops */
};

static struct trace trace_create(const hooke_system *system) {
  struct trace trace = {.size = 2 + 6 * hooke_system_particle_count(system)};
  trace.row = new_doubles(MOST_FRAMES * trace.size);
  return trace;
}

static void keep(struct trace *trace, int64_t step, const hooke_state *state) {
  assert_true(trace->frames < MOST_FRAMES);
  double *row = trace->row + trace->frames++ * trace->size;
  const size_t bytes = (size_t)hooke_state_size(state) * sizeof(double);
  row[0] = hooke_state_time(state);
  row[1] = (double)step;
  memcpy(row + 2, hooke_state_position(state), bytes);
  memcpy(row + 2 + hooke_state_size(state), hooke_state_velocity(state), bytes);
}

static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  keep(((struct course *)ctx)->trace, step, state);
  return 0;
}

static int32_t see_step(int64_t step, const hooke_state *state, void *ctx) {
  struct course *course = ctx;
  (void)step, (void)state;
  return ++course->calls == course->stop_at;
}

static void write_checkpoint(struct course *course, const hooke_state *state) {
  check_ok(hooke_checkpoint_write(course->path, course->integrator, state, "a run"));
  course->kept = course->trace->frames;
}

static int32_t see_checkpoint(int64_t step, const hooke_state *state, void *ctx) {
  struct course *course = ctx;
  (void)step;
  if (course->at_points) write_checkpoint(course, state);
  return 0;
}

static void start(const hooke_system *system, struct run run, struct course *course) {
  course->integrator = start_run(system, run);
  check_ok(hooke_integrator_on_frame(course->integrator, see_frame, course));
  check_ok(hooke_integrator_on_step(course->integrator, 1, see_step, course));
  check_ok(hooke_integrator_on_checkpoint(course->integrator, see_checkpoint, course));
}

static void finish(struct course *course, const hooke_state *state) {
  keep(course->trace, hooke_integrator_count(course->integrator, "steps"), state);
  for (int k = 0; k < COUNTS; k++)
    course->trace->count[k] = hooke_integrator_count(course->integrator, counts[k]);
}

static int64_t run_whole(const hooke_system *system, struct run run, struct trace *trace) {
  struct course course = {.trace = trace};
  owned_state *state = start_state(system);
  start(system, run, &course);
  check_ok(hooke_integrator_run(course.integrator, state));
  finish(&course, state);
  hooke_integrator_destroy(course.integrator);
  return course.calls;
}

/* Frames after the checkpoint are reported again; an error-controlled run may have passed it before it was
 * written. */
static void forget_after(struct trace *trace, int64_t kept, double t) {
  trace->frames = kept;
  while (trace->frames > 0 && trace->row[(trace->frames - 1) * trace->size] > t)
    trace->frames--;
}

/* 1 if it was stopped after a checkpoint. */
static int run_stopped(const hooke_system *system, struct run run, struct course *course, int resume) {
  owned_state *state = start_state(system);
  course->calls = 0;
  start(system, run, course);
  int32_t status;
  if (resume) {
    check_ok(hooke_checkpoint_read(course->path, "a run", course->integrator, state));
    forget_after(course->trace, course->kept, hooke_state_time(state));
    status = hooke_integrator_resume(course->integrator, state);
  } else {
    status = hooke_integrator_run(course->integrator, state);
  }
  const int stopped = status == HOOKE_STOPPED;
  if (!stopped) {
    check_status(status, HOOKE_OK);
    finish(course, state);
  } else if (!course->at_points || access(course->path, F_OK) != 0) {
    write_checkpoint(course, state);
  }
  hooke_integrator_destroy(course->integrator);
  return stopped;
}

static void check_same(const char *what, const struct trace *found, const struct trace *whole) {
  if (found->frames != whole->frames)
    check_failed("%s: %lld frames in place of %lld", what, (long long)found->frames,
                 (long long)whole->frames);
  const int64_t at = first_difference(whole->frames * whole->size, found->row, whole->row);
  if (at >= 0)
    check_failed("%s: number %lld of frame %lld is %.17g in place of %.17g", what,
                 (long long)(at % whole->size), (long long)(at / whole->size), found->row[at],
                 whole->row[at]);
  for (int k = 0; k < COUNTS; k++) {
    if (found->count[k] != whole->count[k])
      check_failed("%s: %s is %lld in place of %lld", what, counts[k], (long long)found->count[k],
                   (long long)whole->count[k]);
  }
}

static void remove_files(const char *path) {
  char previous[96];
  snprintf(previous, sizeof previous, "%s.previous", path);
  remove(path);
  remove(previous);
}

/* Stopped up to MOST_STOPS times at random steps. */
static void check_stops(const hooke_system *system, struct run run, const struct trace *whole, int64_t calls,
                        struct random_source *random, const char *what) {
  struct trace trace = trace_create(system);
  struct course course = {.trace = &trace, .at_points = (int32_t)random_whole(random, 0, 1)};
  snprintf(course.path, sizeof course.path, "%s/hooke-resume-%ld.checkpoint", memory_folder(),
           (long)getpid());
  int stopped = 1;
  for (int stop = 0; stopped; stop++) {
    course.stop_at = stop < MOST_STOPS ? random_whole(random, 1, stop == 0 ? calls : 1 + calls / 3) : 0;
    if (random_whole(random, 0, 1)) run.threads = 3 - run.threads;
    stopped = run_stopped(system, run, &course, stop > 0);
  }
  remove_files(course.path);
  check_same(what, &trace, whole);
  free(trace.row);
}

static struct run run_of(const struct moving_scene *scene, const char *method, int variant) {
  const double step = scene->step, rtol[] = {1e-4, 1e-7};
  struct run run = {.method = method, .every = FRAME_STEPS * step, .threads = 1};
  run.duration = (variant ? STEPS : FRAME_STEPS * 8) * step; /* or a last interval of 4 steps */
  run.checkpoint = (variant ? 3.3 : 14.0) * step;            /* between frames, or at every other one */
  run.step = step;
  run.rtol = rtol[variant];
  run.newton = variant ? "one-iteration" : NULL;
  return run;
}

static void check_method(const struct moving_scene *scene, const hooke_system *system, const char *method,
                         int64_t tries, struct random_source *random) {
  for (int variant = 0; variant < 2; variant++) {
    char what[128];
    snprintf(what, sizeof what, "%s, %s, variant %d", scene->name, method, variant);
    const struct run run = run_of(scene, method, variant);
    struct trace whole = trace_create(system);
    const int64_t calls = run_whole(system, run, &whole);
    for (int64_t k = 0; k < tries; k++)
      check_stops(system, run, &whole, calls, random, what);
    free(whole.row);
  }
}

static const char *const references[] = {"rk8pd", "arkode-esdirk"};

static void check_scene(const struct moving_scene *scene, int64_t tries) {
  struct random_source random = {(uint64_t)(scene - moving_scenes) + 1};
  owned_system *system = moving_system(scene);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    if (hooke_method_is_built(hooke_method_name(m)))
      check_method(scene, system, hooke_method_name(m), tries, &random);
  }
  for (int m = 0; m < 2; m++) {
    if (hooke_method_is_built(references[m])) check_method(scene, system, references[m], tries, &random);
  }
}

TEST(resumed_runs_end_in_the_same_bits) {
  for (int k = 0; k < MOVING_SCENES; k++) {
    if (!left_out(k, 3)) check_scene(&moving_scenes[k], getenv("HOOKE_LONG") ? 100 : 4);
  }
}

/* Alternately with two threads and with one. */
TEST(threads_change_nothing) {
  static const char *const methods[] = {"symplectic-euler", "verlet", "rk4", "cvode-adams"};
  const struct moving_scene *scene = &moving_scenes[MOVING_LARGE];
  struct random_source random = {17};
  owned_system *system = moving_system(scene);
  for (int m = 0; m < 4; m++) {
    if (!hooke_method_is_built(methods[m]) || left_out(m, 3)) continue;
    struct run run = run_of(scene, methods[m], 0);
    struct trace whole = trace_create(system);
    const int64_t calls = run_whole(system, run, &whole);
    for (int k = 0; k < 2; k++)
      check_stops(system, run, &whole, calls, &random, methods[m]);
    free(whole.row);
  }
}

/* In the same process, from the state where an observer stopped it, repeatedly. */
TEST(fixed_steps_go_on_where_they_stopped) {
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    owned_system *system = moving_system(&moving_scenes[2]);
    const struct run run = run_of(&moving_scenes[2], method, 0);
    struct trace whole = trace_create(system), trace = trace_create(system);
    const int64_t calls = run_whole(system, run, &whole);
    struct course course = {.trace = &trace, .stop_at = calls / 3};
    owned_state *at = start_state(system);
    start(system, run, &course);
    check_status(hooke_integrator_run(course.integrator, at), HOOKE_STOPPED);
    course.stop_at = calls / 2;
    check_status(hooke_integrator_resume(course.integrator, at), HOOKE_STOPPED);
    course.stop_at = 0;
    check_ok(hooke_integrator_resume(course.integrator, at));
    finish(&course, at);
    check_same(method, &trace, &whole);
    check_status(hooke_integrator_resume(course.integrator, at), HOOKE_BAD_CALL); /* at the end of the run */
    hooke_integrator_destroy(course.integrator);
    free(trace.row);
    free(whole.row);
  }
}

/* Before, at and after the last whole multiple of `every`, and at the end, before its frame was shown. */
TEST(the_last_short_interval_goes_on) {
  static const int64_t stops[] = {STEPS - 5, STEPS - 4, STEPS - 3, STEPS - 1, STEPS};
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    owned_system *system = moving_system(&moving_scenes[1]);
    const struct run run = run_of(&moving_scenes[1], method, 1);
    struct trace whole = trace_create(system), trace = trace_create(system);
    run_whole(system, run, &whole);
    assert_int_equal(whole.frames, 1 + 9 + 1); /* the last row is the final state */
    check_same_bits(whole.size, whole.row + 9 * whole.size, whole.row + 10 * whole.size);
    for (int k = 0; k < 5; k++) {
      struct course course = {.trace = &trace, .stop_at = stops[k]};
      snprintf(course.path, sizeof course.path, "%s/hooke-end-%ld", memory_folder(), (long)getpid());
      trace.frames = 0;
      assert_true(run_stopped(system, run, &course, 0));
      course.stop_at = 0;
      assert_false(run_stopped(system, run, &course, 1));
      remove_files(course.path);
      check_same(method, &trace, &whole);
    }
    free(trace.row);
    free(whole.row);
  }
}

/* Loops of the caller's own: some steps, a checkpoint, the other half in another integrator. */
TEST(single_steps_go_on_from_a_checkpoint) {
  char path[64];
  snprintf(path, sizeof path, "%s/hooke-steps-%ld", memory_folder(), (long)getpid());
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    owned_system *system = moving_system(&moving_scenes[1]);
    const struct run run = {.method = method, .step = 1e-3};
    owned_integrator *whole = start_run(system, run), *half = start_run(system, run);
    owned_integrator *rest = start_run(system, run);
    owned_state *expected = start_state(system), *before = start_state(system);
    owned_state *found = start_state(system);
    check_ok(hooke_integrator_step(whole, expected, 20));
    check_ok(hooke_integrator_step(half, before, 11));
    check_ok(hooke_checkpoint_write(path, half, before, NULL));
    check_ok(hooke_checkpoint_read(path, NULL, rest, found));
    check_ok(hooke_integrator_step(rest, found, 9));
    const double times[] = {hooke_state_time(found), hooke_state_time(expected)};
    check_same_bits(1, &times[0], &times[1]);
    check_same_bits(hooke_state_size(found), hooke_state_position(found), hooke_state_position(expected));
    check_same_bits(hooke_state_size(found), hooke_state_velocity(found), hooke_state_velocity(expected));
    for (int k = 0; k < COUNTS; k++)
      assert_int_equal(hooke_integrator_count(rest, counts[k]), hooke_integrator_count(whole, counts[k]));
  }
  remove_files(path);
}

/* x' = phi(t, x), without velocities. */
static int32_t circle(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)ctx;
  rate[0] = -x[1] + 0.1 * t;
  rate[1] = x[0];
  return 0;
}

static int32_t stop_once(int64_t step, const hooke_state *state, void *ctx) {
  (void)step, (void)state;
  return --*(int64_t *)ctx == 0;
}

TEST(first_order_problems_go_on) {
  static const char *const methods[] = {"forward-euler", "rk4",   "cvode-bdf",
                                        "cvode-adams",   "rk8pd", "arkode-esdirk"};
  char path[64];
  snprintf(path, sizeof path, "%s/hooke-first-%ld", memory_folder(), (long)getpid());
  for (int m = 0; m < 6; m++) {
    if (!hooke_method_is_built(methods[m])) continue;
    const struct run run = {
        .method = methods[m], .step = 0.01, .duration = 2.0, .every = 0.1, .checkpoint = 0.25, .rtol = 1e-7};
    hooke_integrator *part[3];
    hooke_state *at[3];
    int64_t calls = 17;
    for (int k = 0; k < 3; k++) {
      part[k] = start_first_order(2, circle, NULL, run);
      check_ok(hooke_state_create_first_order(2, &at[k]));
      hooke_state_position(at[k])[0] = 1.0;
    }
    check_ok(hooke_integrator_run(part[0], at[0]));
    check_ok(hooke_integrator_on_step(part[1], 1, stop_once, &calls));
    check_status(hooke_integrator_run(part[1], at[1]), HOOKE_STOPPED);
    check_ok(hooke_checkpoint_write(path, part[1], at[1], NULL));
    check_ok(hooke_checkpoint_read(path, NULL, part[2], at[2]));
    check_ok(hooke_integrator_resume(part[2], at[2]));
    check_same_bits(2, hooke_state_position(at[2]), hooke_state_position(at[0]));
    assert_int_equal(hooke_integrator_count(part[2], "steps"), hooke_integrator_count(part[0], "steps"));
    for (int k = 0; k < 3; k++) {
      hooke_integrator_destroy(part[k]);
      hooke_state_destroy(at[k]);
    }
  }
  remove_files(path);
}

/* Restarts are part of the method: without the option there are none, and with it an observer changes
 * nothing. */
TEST(the_option_decides_and_nobody_else) {
  const struct moving_scene *scene = &moving_scenes[0];
  if (!hooke_method_is_built("cvode-adams")) return;
  owned_system *system = moving_system(scene);
  struct run run = run_of(scene, "cvode-adams", 0);
  const int64_t size = 3 * hooke_system_particle_count(system);
  double *watched = new_doubles(size), *alone = new_doubles(size), *without = new_doubles(size);
  struct trace trace = trace_create(system);
  run_whole(system, run, &trace);
  memcpy(watched, trace.row + (trace.frames - 1) * trace.size + 2, (size_t)size * sizeof(double));
  run_to_end(system, run, alone, NULL);
  run.checkpoint = 0.0;
  run_to_end(system, run, without, NULL);
  check_same_bits(size, alone, watched);
  assert_true(first_difference(size, alone, without) >= 0);
  run.checkpoint = 1e-18;
  owned_integrator *integrator = start_run(system, run);
  owned_state *at = start_state(system);
  check_status(hooke_integrator_run(integrator, at), HOOKE_BAD_VALUE);
  check_message("checkpoint");
  free(watched);
  free(alone);
  free(without);
  free(trace.row);
}
