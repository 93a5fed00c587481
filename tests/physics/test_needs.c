/* Needs: changes and costs equal those of separate runs, refinement predicts the result of a much finer rope,
 * motion that no step can follow is judged as far as possible, and an interruption keeps the results so far.
 */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- creating ---- */

static hooke_measurement *make(const hooke_system *system, struct run run, double want, const char *watch,
                               int refine) {
  owned_options *of_run = run_options(run), *options;
  hooke_measurement *needs = NULL;
  options = options_with("needs", "want=%.17g", want);
  if (watch) check_ok(hooke_options_set_text(options, "watch", watch));
  check_ok(hooke_options_set_number(options, "refine", refine));
  check_ok(hooke_measurement_create("needs", system, of_run, options, &needs));
  return needs;
}

static hooke_measurement *start(const hooke_system *system, struct run run, double want, const char *watch) {
  return make(system, run, want, watch, 0);
}

/* A rope that hangs from its start, released unstretched; with weak springs two apart. */
static hooke_system *hanging_rope(int segments, double bend) {
  const double gravity[3] = {0, -9.81, 0};
  const int64_t first = 0;
  hooke_system *system = new_system();
  owned_options *rope = options_with("rope",
                                     "from=0,0,0 to=0,-1,0 segments=%d density=0.1 "
                                     "stretch.stiffness=20 stretch.damping=0.05",
                                     segments);
  if (bend > 0.0) check_ok(hooke_options_set_number(rope, "bend.stiffness", bend));
  check_ok(hooke_system_add_part(system, "rope", "rope", rope, NULL, NULL));
  check_ok(hooke_system_pin(system, 1, &first));
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_commit(system));
  return system;
}

static int64_t row_of(const hooke_measurement *needs, const char *without) {
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    if (strcmp(hooke_measurement_text(needs, "rows", row, "without"), without) == 0) return row;
  }
  check_failed("there is no row \"%s\"", without);
  return -1;
}

/* ---- changes ---- */

struct frames {
  int64_t count, size, every; /* numbers of a frame; particles a watched one */
  double q[64 * 3 * 64];
};

static int32_t keep_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct frames *frames = ctx;
  const double *q = hooke_state_position(state);
  (void)step;
  for (int64_t p = 1; p * frames->every < hooke_state_size(state) / 3; p++) {
    for (int a = 0; a < 3; a++)
      frames->q[frames->count * frames->size + 3 * (p - 1) + a] = q[3 * p * frames->every + a];
  }
  frames->count++;
  return 0;
}

/* All particles but the first at every frame; of a finer rope those that the coarse one has, too. */
static struct frames *run_frames(const hooke_system *system, const hooke_options *options, int64_t every) {
  struct frames *frames = new_block(1, sizeof *frames);
  owned_integrator *integrator;
  owned_state *state = start_state(system);
  frames->every = every;
  frames->size = 3 * ((hooke_system_particle_count(system) - 1) / every);
  check_ok(hooke_integrator_create(system, options, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, keep_frame, frames));
  check_ok(hooke_integrator_run(integrator, state));
  return frames;
}

static struct frames *run_fine(const hooke_system *system, double step, int64_t every) {
  owned_options *options =
      run_options((struct run){.method = "rk4", .step = step, .duration = 0.5, .every = 0.02});
  struct frames *frames = run_frames(system, options, every);
  return frames;
}

/* Largest distance of any particle at any frame. */
static double distance(const struct frames *a, const struct frames *b) {
  double most = 0.0;
  assert_int_equal(a->count, b->count);
  assert_int_equal(a->size, b->size);
  for (int64_t f = 0; f < a->count; f++) {
    for (int64_t k = f * a->size; k < (f + 1) * a->size; k += 3) {
      double square = 0.0;
      for (int c = 0; c < 3; c++)
        square += (a->q[k + c] - b->q[k + c]) * (a->q[k + c] - b->q[k + c]);
      most = fmax(most, sqrt(square));
    }
  }
  return most;
}

static const struct run half_a_second = {.method = "rk4", .duration = 0.5, .every = 0.02};

TEST(changes_are_those_of_runs_made_apart) {
  const double want = 1e-3;
  owned_system *system = hanging_rope(12, 0.05), *without = hanging_rope(12, 0.0);
  owned_measurement *needs = start(system, half_a_second, want, NULL);
  check_ok(hooke_measurement_run(needs, NULL));
  struct frames *full = run_fine(system, 1e-4, 1), *no_bend = run_fine(without, 1e-4, 1);
  const int64_t bend = row_of(needs, "rope.bend");
  const double change = distance(full, no_bend);
  check_between(change, 1e-5, want);
  check_close(hooke_measurement_number(needs, "rows", bend, "error"), change, 0.2 * want);
  assert_true(hooke_measurement_number(needs, "rows", bend, "needed") == 0.0);
  assert_true(hooke_measurement_number(needs, "rows", bend, "springs") == 12.0);
  assert_true(hooke_measurement_number(needs, "full", 0, "springs") == 23.0);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "rope.stretch"), "needed") == 1.0);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "gravity"), "needed") == 1.0);

  /* the lean system, run as recommended; without halving the resolution, which this want does not allow */
  assert_true(hooke_measurement_number(needs, "rows", bend, "left_out") == 1.0);
  const hooke_system *lean = hooke_needs_lean(needs);
  assert_non_null(lean);
  if (hooke_system_particle_count(lean) == 13) {
    struct frames *run = run_frames(lean, hooke_needs_lean_run(needs), 1);
    check_between(distance(full, run), 0.0, want);
    check_close(hooke_measurement_number(needs, "lean", 0, "error"), distance(full, run), 0.2 * want);
    for (int64_t p = 0; p < 13; p++)
      assert_int_equal(hooke_needs_lean_particle(needs, p), p);
    free(run);
  } else {
    assert_int_equal(hooke_system_particle_count(lean), 7);
    assert_int_equal(hooke_needs_lean_particle(needs, 1), -1);
  }
  check_between(hooke_measurement_number(needs, "lean", 0, "error"), 0.0, want);
  check_status(hooke_measurement_run(needs, NULL), HOOKE_BAD_CALL);
  free(full);
  free(no_bend);
}

/* ---- errors and costs of the two runs within the want ---- */

/* The run of a system with the step or tolerances found for it. */
static struct frames *run_found(const hooke_measurement *needs, const hooke_system *system,
                                const char *table) {
  owned_options *options = NULL;
  check_ok(hooke_options_copy(hooke_needs_lean_run(needs), &options));
  static const char *const names[] = {"step", "rtol", "atol"};
  for (int k = 0; k < 3; k++) {
    const double value = hooke_measurement_number(needs, table, 0, names[k]);
    if (!isnan(value)) check_ok(hooke_options_set_number(options, names[k], value));
  }
  struct frames *frames = run_frames(system, options, 1);
  return frames;
}

/* The reported error is an upper estimate: above the true error, by at most twice the possible error of the
 * full run. */
static void check_said(const hooke_measurement *needs, const char *table, const hooke_system *system,
                       const struct frames *truth) {
  struct frames *run = run_found(needs, system, table);
  const double said = hooke_measurement_number(needs, table, 0, "error"), error = distance(truth, run),
               own = hooke_measurement_number(needs, "full", 0, "own_error");
  check_between(error, 0.0, said);
  check_between(said, 0.0, error + 2.0 * own);
  check_between(said, 0.0, hooke_measurement_number(needs, "needs", 0, "want"));
  free(run);
}

TEST(errors_include_that_of_the_full_run) {
  static const char *const methods[] = {"symplectic-euler", "verlet", "rk4", "cvode-adams"};
  owned_system *system = hanging_rope(12, 1e-3);
  struct frames *truth = run_fine(system, 1e-4, 1);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    if (!hooke_method_is_built(methods[k])) continue;
    struct run run = half_a_second;
    run.method = methods[k];
    owned_measurement *needs = start(system, run, 3e-4, NULL);
    check_ok(hooke_measurement_run(needs, NULL));
    const double own = hooke_measurement_number(needs, "full", 0, "own_error");
    check_between(own, 1e-10, 0.0625 * 3e-4);
    assert_int_equal(hooke_system_particle_count(hooke_needs_lean(needs)), 13);
    check_said(needs, "lean", hooke_needs_lean(needs), truth);
    check_said(needs, "cheapest", system, truth);
  }
  free(truth);
}

/* By a method of order 1, whose error alone limits the step: omitting weak springs saves no steps, though the
 * full system takes ten times as many for an error of a tenth of the want. */
TEST(savings_are_those_at_equal_error) {
  const double want = 4e-4;
  struct run run = half_a_second;
  run.method = "symplectic-euler";
  owned_system *system = hanging_rope(12, 1e-5);
  struct frames *truth = run_fine(system, 1e-4, 1);
  owned_measurement *needs = start(system, run, want, "0-12");
  check_ok(hooke_measurement_run(needs, NULL));
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "rope.bend"), "left_out") == 1.0);
  const double lean = hooke_measurement_number(needs, "lean", 0, "steps"),
               cheapest = hooke_measurement_number(needs, "cheapest", 0, "steps");
  check_between(lean / cheapest, 0.8, 1.25);
  check_between(hooke_measurement_number(needs, "full", 0, "steps") / cheapest, 5.0, 25.0);
  check_close(hooke_measurement_number(needs, "lean", 0, "times_less"),
              hooke_measurement_number(needs, "cheapest", 0, "wall_seconds") /
                  hooke_measurement_number(needs, "lean", 0, "wall_seconds"),
              0.0);
  /* and it is the cheapest: a third fewer steps exceed the wanted error */
  struct frames *within = run_found(needs, system, "cheapest");
  run.step = half_a_second.every /
             floor(half_a_second.every / hooke_measurement_number(needs, "cheapest", 0, "step") / 1.4);
  owned_options *coarse = run_options(run);
  struct frames *beyond = run_frames(system, coarse, 1);
  check_between(distance(truth, within), 0.6 * want, want);
  check_between(distance(truth, beyond), want, 2.0 * want);
  free(within);
  free(beyond);
  free(truth);
}

/* ---- scenes without motion ---- */

/* A damped spring that holds a mass, stretched by its weight, or by `more` than that [m]. */
static hooke_system *hung_mass(double gravity, double more) {
  const double place[6] = {0, 0, 0, 0, -1.0 - gravity / 100.0 - more, 0}, down[3] = {0, -gravity, 0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = small_system(2, place, NULL, 1.0, 1);
  small_springs(system, 1, ends, (struct springs){.stiffness = 100, .damping = 0.5, .rest_length = 1});
  if (gravity > 0.0) check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  return system;
}

static hooke_measurement *find_hung(const hooke_system *system) {
  hooke_measurement *needs =
      start(system, (struct run){.method = "rk4", .duration = 1, .every = 0.05}, 1e-2, NULL);
  check_ok(hooke_measurement_run(needs, NULL));
  return needs;
}

TEST(a_scene_that_rests_is_told_so) {
  owned_system *rest = hung_mass(0.0, 0.0), *balance = hung_mass(9.81, 0.0), *little = hung_mass(9.81, 4e-3),
               *moving = hung_mass(9.81, 0.1);
  hooke_measurement *needs = find_hung(rest);
  assert_non_null(strstr(hooke_measurement_text(needs, "needs", 0, "note"), "nothing moves"));
  assert_true(hooke_measurement_number(needs, "full", 0, "moved") == 0.0);
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    assert_true(isnan(hooke_measurement_number(needs, "rows", row, "needed")));
    assert_true(hooke_measurement_number(needs, "rows", row, "error") == 0.0);
    assert_true(hooke_measurement_number(needs, "rows", row, "left_out") == 0.0);
  }
  assert_int_equal(hooke_system_count(hooke_needs_lean(needs), "springs"), 1);
  hooke_measurement_destroy(needs);

  /* ingredients that hold the balance are needed all the same */
  needs = find_hung(balance);
  assert_non_null(strstr(hooke_measurement_text(needs, "needs", 0, "note"), "nothing moves"));
  check_between(hooke_measurement_number(needs, "full", 0, "moved"), 0.0, 1e-12);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "gravity"), "needed") == 1.0);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "springs"), "needed") == 1.0);
  assert_true(isnan(hooke_measurement_number(needs, "rows", row_of(needs, "damping"), "needed")));
  hooke_measurement_destroy(needs);

  needs = find_hung(little);
  assert_non_null(strstr(hooke_measurement_text(needs, "needs", 0, "note"), "less than is wanted"));
  check_between(hooke_measurement_number(needs, "full", 0, "moved"), 7e-3, 8e-3);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "damping"), "needed") == 0.0);
  hooke_measurement_destroy(needs);

  needs = find_hung(moving);
  assert_string_equal(hooke_measurement_text(needs, "needs", 0, "note"), "");
  check_between(hooke_measurement_number(needs, "full", 0, "moved"), 0.19, 0.2);
  hooke_measurement_destroy(needs);
}

/* ---- resolutions ---- */

/* The remaining error at 8 pieces, predicted from 8, 16 and 32, compared with 128. */
TEST(refinement_predicts_a_much_finer_rope) {
  owned_system *coarse = hanging_rope(8, 0.0), *fine = hanging_rope(128, 0.0);
  owned_measurement *needs = make(coarse, half_a_second, 1e-4, NULL, 1);
  check_ok(hooke_measurement_run(needs, NULL));
  assert_int_equal(hooke_measurement_row_count(needs, "parts"), 1);
  assert_string_equal(hooke_measurement_text(needs, "parts", 0, "part"), "rope");
  struct frames *at_coarse = run_fine(coarse, 1e-4, 1), *at_fine = run_fine(fine, 2.5e-5, 16);
  const double left = distance(at_coarse, at_fine);
  check_between(hooke_measurement_number(needs, "parts", 0, "error"), 0.9 * left, 1.15 * left);
  check_between(hooke_measurement_number(needs, "parts", 0, "order"), 0.8, 2.3);
  assert_true(hooke_measurement_number(needs, "parts", 0, "cells") == 8.0);
  /* the want is set to that remaining error */
  const double order = hooke_measurement_number(needs, "parts", 0, "order"),
               wanted = hooke_measurement_number(needs, "parts", 0, "wanted");
  check_between(hooke_measurement_number(needs, "parts", 0, "error") * pow(8.0 / wanted, order), 0.5e-4,
                1e-4);
  assert_true(isnan(hooke_measurement_number(needs, "parts", 0, "wanted_second")));
  check_status(hooke_measurement_run(needs, NULL), HOOKE_BAD_CALL);
  free(at_coarse);
  free(at_fine);
}

/* ---- callbacks, methods, chaos ---- */

static int32_t push(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)v;
  force[3] += *(const double *)ctx;
  return 0;
}

static hooke_system *pushed_pair(double *strength) {
  const double position[6] = {0, 0, 0, 1.1, 0, 0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = small_system(2, position, NULL, 1.0, 1);
  small_springs(system, 1, ends, (struct springs){.stiffness = 100, .rest_length = 1});
  check_ok(hooke_system_set_force(system, push, NULL, strength));
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(a_callback_is_an_ingredient) {
  double strengths[2] = {1e-6, 1.0};
  for (int k = 0; k < 2; k++) {
    owned_system *system = pushed_pair(&strengths[k]);
    owned_measurement *needs =
        start(system, (struct run){.method = "verlet", .duration = 1, .every = 0.05}, 1e-3, NULL);
    check_ok(hooke_measurement_run(needs, NULL));
    assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "callback"), "needed") == (double)k);
  }
}

TEST(every_method_finds_the_same) {
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const char *method = hooke_method_name(k);
    if (!hooke_method_is_built(method)) continue;
    owned_system *system = hanging_rope(4, 0.01);
    owned_measurement *needs =
        start(system, (struct run){.method = method, .duration = 0.2, .every = 0.02}, 2e-3, NULL);
    check_ok(hooke_measurement_run(needs, NULL));
    assert_string_equal(hooke_measurement_text(needs, "needs", 0, "method"), method);
    assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "rope.bend"), "needed") == 0.0);
    assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "gravity"), "needed") == 1.0);
    check_between(hooke_measurement_number(needs, "full", 0, "step_error"), 0.0, 2e-4);
    const double error = hooke_measurement_number(needs, "lean", 0, "error");
    if (hooke_limit_of_mode(method, 1.0, 0.0) > 0.0)
      check_between(error, 0.0, 2e-3);
    else /* no step is stable across the rope: none is recommended */
      assert_true(isnan(error) &&
                  strstr(hooke_measurement_text(needs, "lean", 0, "note"), "clear of") != NULL);
    assert_true(isnan(hooke_measurement_number(needs, "full", 0, "step")) ==
                hooke_method_is_adaptive(method));
  }
}

/* Two masses on stiff rods, released from upright: a double pendulum. */
TEST(chaos_is_judged_as_far_as_a_step_can_follow) {
  const double position[9] = {0, 0, 0, 0.1, 1, 0, 0.25, 2, 0}, gravity[3] = {0, -9.81, 0};
  const int64_t ends[4] = {0, 1, 1, 2};
  owned_system *system = small_system(3, position, NULL, 1.0, 1);
  small_springs(system, 2, ends, (struct springs){.stiffness = 2e3, .damping = 5, .rest_length = -1});
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 1e-9));
  check_ok(hooke_system_commit(system));
  owned_measurement *needs =
      start(system, (struct run){.method = "symplectic-euler", .duration = 8, .every = 0.05}, 0.01, NULL);
  check_ok(hooke_measurement_run(needs, NULL));
  check_between(hooke_measurement_number(needs, "needs", 0, "judged_until"), 0.8, 7.0);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "gravity"), "needed") == 1.0);
  assert_true(hooke_measurement_number(needs, "rows", row_of(needs, "drag"), "needed") == 0.0);
}

/* ---- stopping, refusals ---- */

struct listener {
  double last;
  int64_t calls, most;
};

static int32_t listen(double done, const char *what, void *ctx) {
  struct listener *listener = ctx;
  if (done < listener->last || done > 1.0 || what == NULL) check_failed("%g after %g", done, listener->last);
  listener->last = done;
  return ++listener->calls > listener->most;
}

TEST(whoever_stops_it_keeps_what_is_known) {
  owned_system *system = hanging_rope(12, 0.05);
  struct listener all = {.most = INT64_MAX};
  hooke_measurement *needs = start(system, half_a_second, 1e-3, NULL);
  hooke_measurement_on_progress(needs, listen, &all);
  check_ok(hooke_measurement_run(needs, NULL));
  const int64_t rows = hooke_measurement_row_count(needs, "rows");
  hooke_measurement_destroy(needs);
  int64_t stopped = 0;
  for (int64_t part = 0; part < 8; part++) {
    struct listener some = {.most = all.calls * part / 8};
    needs = start(system, half_a_second, 1e-3, NULL);
    hooke_measurement_on_progress(needs, listen, &some);
    const int32_t status = hooke_measurement_run(needs, NULL);
    /* progress is reported by time: on a slower machine there were fewer calls */
    check_status(status, some.calls > some.most ? HOOKE_STOPPED : HOOKE_OK);
    stopped += status == HOOKE_STOPPED;
    check_between((double)hooke_measurement_row_count(needs, "rows"), 0.0, (double)rows);
    assert_null(hooke_measurement_text(needs, "rows", hooke_measurement_row_count(needs, "rows"), "without"));
    for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++)
      check_between(hooke_measurement_number(needs, "rows", row, "error"), 0.0, 10.0);
    assert_true(part > 0 || isnan(hooke_measurement_number(needs, "full", 0, "wall_seconds")));
    hooke_measurement_destroy(needs);
  }
  check_between((double)stopped, 2.0, 8.0);
}

static void check_watch(const hooke_system *system, const char *watch, const char *message) {
  owned_options *run = run_options(half_a_second), *options;
  owned_measurement *needs = NULL;
  options = options_with("needs", "want=1e-3");
  check_ok(hooke_options_set_text(options, "watch", watch));
  check_status(hooke_measurement_create("needs", system, run, options, &needs),
               message ? HOOKE_BAD_VALUE : HOOKE_OK);
  if (message) check_message(message);
}

TEST(what_cannot_be_is_refused) {
  owned_system *system = hanging_rope(12, 0.05);
  static const char *const good[] = {"rope", "rope.bend", "0", "12", "1-5", "0,3-4,12"};
  static const char *const bad[] = {"robe", "13", "5-1", "1,",   ",1",
                                    "1-",   "-1", "1 2", "0-13", "99999999999999999999"};
  for (size_t k = 0; k < sizeof good / sizeof good[0]; k++)
    check_watch(system, good[k], NULL);
  for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
    check_watch(system, bad[k], "rope, rope.stretch, rope.bend, or particle numbers");
  owned_options *run = run_options((struct run){.method = "rk4"}), *options;
  hooke_measurement *needs = NULL;
  options = new_options("needs");
  check_status(hooke_measurement_create("needs", system, run, options, &needs), HOOKE_BAD_VALUE);
  check_message("want");
  check_ok(hooke_options_set_number(options, "want", 1e-3));
  check_status(hooke_measurement_create("needs", system, run, options, &needs), HOOKE_BAD_VALUE);
  check_message("duration");
  set_options(run, "duration=0.5 method=rk5");
  check_status(hooke_measurement_create("needs", system, run, options, &needs), HOOKE_BAD_VALUE);
  check_message("there is no method \"rk5\"");

  owned_system *alone = small_oscillator(1.0);
  needs = make(alone, half_a_second, 1e-3, NULL, 1);
  check_status(hooke_measurement_run(needs, NULL), HOOKE_BAD_VALUE);
  check_message("no parts");
  hooke_measurement_destroy(needs);
}

/* Functions for needs refuse studies, and the reverse. */
TEST(kinds_keep_to_what_is_theirs) {
  owned_system *system = hanging_rope(4, 0.0);
  owned_options *run = run_options(half_a_second);
  hooke_measurement *needs = start(system, half_a_second, 1e-2, NULL), *study = NULL;
  double q[15] = {0};
  assert_null(hooke_needs_lean(needs));
  check_status(hooke_needs_lean_position(needs, q, q), HOOKE_BAD_CALL);
  check_message("no lean system yet");
  check_status(hooke_study_recommend(needs, 1.0), HOOKE_BAD_CALL);
  check_message("\"study\", this is a \"needs\"");
  if (hooke_method_is_built("cvode-adams")) {
    check_ok(hooke_measurement_create("study", system, run, NULL, &study));
    assert_null(hooke_needs_lean(study));
    assert_null(hooke_needs_lean_run(study));
    assert_int_equal(hooke_needs_lean_particle(study, 0), -1);
    check_status(hooke_needs_lean_position(study, q, q), HOOKE_BAD_CALL);
    check_message("\"needs\", this is a \"study\"");
    check_status(hooke_measurement_write(study, "study.csv"), HOOKE_BAD_CALL);
  }
  check_status(hooke_measurement_create("verify", system, run, NULL, &study), HOOKE_BAD_VALUE);
  check_message("hooke_verify_create()");
  hooke_measurement_destroy(study);
  hooke_measurement_destroy(needs);
}

/* ---- groups of triples and tetrahedra that no part adds ---- */

enum { SPRINGS = 1, TRIPLES = 2, TETRAHEDRA = 4, DAMPING = 8, DRAG = 16, GROUPS = 31 };

/* A tetrahedron on a pinned corner, with two more particles on a line from it; `has` selects its forces. */
static hooke_system *body_and_line(int has) {
  const double place[] = {0, 0, 0, 0.3, 0, 0, 0.1, 0.28, 0, 0.12, 0.1, 0.26, 0.6, 0.02, 0, 0.9, 0, 0.03};
  const double speed[] = {0, 0, 0, 0, 0.1, 0, 0, 0, 0.2, 0.1, 0, 0, 0, -0.2, 0, 0, 0.3, 0.1}, coefficient = 2;
  const int64_t ends[] = {0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3, 1, 4, 4, 5};
  const int64_t triples[] = {0, 1, 4, 1, 4, 5}, corners[] = {0, 1, 2, 3};
  hooke_system *system = small_system(6, place, speed, 0.1, 1);
  hooke_options *options = NULL;
  const double damping = has & DAMPING ? 0.02 : 0.0;
  if (has & SPRINGS) {
    small_springs(system, 8, ends,
                  (struct springs){.stiffness = 5.0, .damping = damping, .rest_length = -1.0});
  }
  if (has & TRIPLES) check_ok(hooke_system_add_bending(system, NULL, 2, triples, 1, &coefficient));
  if (has & TETRAHEDRA) {
    options = options_with("altitude", "stiffness=20 damping=%.17g rest_scale=1.3", damping);
    check_ok(hooke_system_add_altitude(system, "body", 1, corners, options));
    hooke_options_destroy(options);
  }
  if (has & DRAG) check_ok(hooke_system_set_drag(system, 0.05));
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(groups_without_parts_are_ingredients) {
  static const struct {
    const char *without;
    int left;
  } rows[] = {{"body", GROUPS - TETRAHEDRA},
              {"bending[0]", GROUPS - TRIPLES},
              {"damping", GROUPS - DAMPING},
              {"drag", GROUPS - DRAG}};
  const double want = 1.5e-3;
  owned_system *system = body_and_line(GROUPS);
  owned_measurement *needs = start(system, half_a_second, want, NULL);
  check_ok(hooke_measurement_run(needs, NULL));
  struct frames *full = run_fine(system, 1e-4, 1);
  const double judged =
      hooke_measurement_number(needs, "needs", 0, "judged_until"); /* altitude springs jump */
  check_between(judged, 0.1, 0.5);
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    owned_system *without = body_and_line(rows[k].left);
    struct frames *frames = run_fine(without, 1e-4, 1);
    full->count = frames->count = 1 + llround(judged / half_a_second.every);
    const double change = distance(full, frames);
    const int64_t row = row_of(needs, rows[k].without);
    check_between(change, 1e-3, 1.0);
    check_close(hooke_measurement_number(needs, "rows", row, "error"), change, 0.2 * want);
    assert_true(hooke_measurement_number(needs, "rows", row, "needed") == (change > want));
    free(frames);
  }
  free(full);
}

/* Groups with the name of an ingredient, without a name, or without members. */
TEST(every_ingredient_has_a_name_of_its_own) {
  const double place[] = {0, 0, 0, 0.3, 0, 0, 0.1, 0.28, 0, 0.12, 0.1, 0.26, 9, 9, 9}, none = 0.0,
               stiff = 2.0;
  const int64_t ends[] = {0, 1, 1, 2, 2, 3}, triple[] = {0, 1, 2}, corners[] = {0, 1, 2, 3};
  static const char *const names[] = {"drag", "gravity", "damping", "callback", NULL};
  static const char *const expected[] = {"springs drag",
                                         "springs gravity",
                                         "springs damping",
                                         "springs callback",
                                         "springs[4]",
                                         "bending[1]",
                                         "altitude[1]",
                                         "drag",
                                         "resistance to compression",
                                         "a particle that touches nothing"};
  owned_system *system = small_system(5, place, NULL, 0.1, 1);
  owned_options *springs, *altitude;
  springs = options_with("springs", "stiffness=5");
  for (int k = 0; k < 5; k++)
    check_ok(hooke_system_add_springs(system, names[k], 3, ends, springs));
  check_ok(hooke_system_add_bending(system, "none", 1, triple, 1, &none));
  check_ok(hooke_system_add_bending(system, NULL, 1, triple, 1, &stiff));
  altitude = options_with("altitude", "stiffness=0");
  check_ok(hooke_system_add_altitude(system, "none", 1, corners, altitude));
  check_ok(hooke_options_set_number(altitude, "stiffness", 1.0));
  check_ok(hooke_system_add_altitude(system, NULL, 1, corners, altitude));
  check_ok(hooke_system_set_drag(system, 0.01));
  check_ok(hooke_system_commit(system));
  owned_measurement *needs = start(system, half_a_second, 1.0, "0-3");
  check_ok(hooke_measurement_run(needs, NULL));
  for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++)
    row_of(needs, expected[k]);
  assert_int_equal(hooke_measurement_row_count(needs, "rows"), sizeof expected / sizeof expected[0]);
}

/* Springs that only pull have no resistance to compression that could be left out. */
TEST(what_is_not_there_is_no_ingredient) {
  const double place[] = {0, 0, 0, 0.3, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_options *springs = options_with("springs", "stiffness=5");
  for (int32_t pushes = 0; pushes < 2; pushes++) {
    owned_system *system = small_system(2, place, NULL, 0.1, 1);
    check_ok(hooke_options_set_number(springs, "compression", (double)pushes));
    check_ok(hooke_system_add_springs(system, "line", 1, ends, springs));
    check_ok(hooke_system_commit(system));
    owned_measurement *needs = start(system, half_a_second, 1.0, NULL);
    check_ok(hooke_measurement_run(needs, NULL));
    row_of(needs, "line");
    if (pushes) row_of(needs, "resistance to compression");
    assert_int_equal(hooke_measurement_row_count(needs, "rows"), 1 + pushes);
  }
}
