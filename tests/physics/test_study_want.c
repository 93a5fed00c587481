/* Studies for a wanted error on scenes whose errors follow no slope: the recommendation is as accurate as
 * stated, a looser want is never refused where a tighter one is met, and statements on growth, rounding and
 * margins are true. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double gravity[3] = {0.0, -9.81, 0.0};

/* A chain along x from the origin, released from horizontal. */
static hooke_system *chain(int64_t springs, double spacing, double mass, struct springs material,
                           int32_t pin_first) {
  owned_doubles *q = new_doubles(3 * (springs + 1));
  int64_t *ends = new_block(2 * springs, sizeof *ends);
  for (int64_t k = 0; k <= springs; k++)
    q[3 * k] = spacing * (double)k;
  for (int64_t k = 0; k < 2 * springs; k++)
    ends[k] = (k + 1) / 2;
  hooke_system *system = small_system(springs + 1, q, NULL, mass, pin_first);
  small_springs(system, springs, ends, material);
  check_ok(hooke_system_set_gravity(system, gravity));
  free(ends);
  return system;
}

static hooke_system *pendulum_of_two(void) {
  return chain(2, 1.0, 1.0, (struct springs){.law = "length", .stiffness = 1000.0, .rest_length = -1.0}, 1);
}

static hooke_system *pendulum_of_three(void) {
  return chain(3, 0.5, 1.0, (struct springs){.law = "length", .stiffness = 1000.0, .rest_length = -1.0}, 1);
}

static hooke_system *cables(void) {
  return chain(6, 0.2, 0.05,
               (struct springs){.law = "length", .stiffness = 2000.0, .rest_length = -1.0, .pull_only = 1},
               1);
}

static hooke_system *driven_rope(void) {
  const double amplitude[3] = {0.0, 0.1, 0.0};
  const int64_t end = 0;
  hooke_system *system =
      chain(12, 0.08, 0.02,
            (struct springs){.law = "length", .stiffness = 1000.0, .damping = 0.05, .rest_length = -1.0}, 0);
  check_ok(hooke_system_drive_harmonic(system, 1, &end, amplitude, 2.0, 0.0));
  return system;
}

static const struct scene {
  hooke_system *(*make)(void);
  double duration;
} scenes[] = {{pendulum_of_two, 10.0}, {pendulum_of_three, 5.0}, {cables, 0.8}, {driven_rope, 1.0}};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static const char METHODS[] = "verlet,rk4,cvode-adams";

static hooke_measurement *made_study(const hooke_system *system, const char *methods, double duration,
                                     double every, double want) {
  hooke_measurement *study = NULL;
  owned_options *run = run_options((struct run){.duration = duration, .every = every}), *options;
  options = options_with("study", "methods=%s points=6", methods);
  if (want > 0.0) check_ok(hooke_options_set_number(options, "want", want));
  const int32_t status = hooke_measurement_create("study", system, run, options, &study);
  if (status == HOOKE_NOT_BUILT) skip();
  check_status(status, HOOKE_OK);
  check_ok(hooke_measurement_run(study, NULL));
  return study;
}

static double recommended(const hooke_measurement *study, const char *what) {
  const double number = hooke_measurement_number(study, "recommendation", 0, what);
  return isnan(number) ? hooke_measurement_number(study, "margin", 0, what) : number;
}

/* Largest distance of a free particle; their root mean square too. */
static double apart(const hooke_system *system, const double *a, const double *b, double *rms) {
  double most = 0.0, sum = 0.0, count = 0.0;
  for (int64_t i = 0; i < 3 * hooke_system_particle_count(system); i += 3) {
    double square = 0.0;
    if (hooke_system_inverse_mass(system)[i / 3] == 0.0) continue;
    for (int c = 0; c < 3; c++)
      square += (a[i + c] - b[i + c]) * (a[i + c] - b[i + c]);
    most = fmax(most, square);
    sum += square;
    count += 1.0;
  }
  *rms = sqrt(sum / count);
  return sqrt(most);
}

/* The end of the judged time by a method that is not part of the reference, at a step so small that only
 * rounding is left. */
static void find_end(const hooke_system *system, double until, double *exact) {
  const struct run run = {.method = "rk4", .duration = until, .every = until, .step = until / 1e6};
  run_to_end(system, run, exact, NULL);
}

/* True error there of the recommended run, and its root mean square. */
static double true_error(const hooke_system *system, const hooke_measurement *study, double until,
                         const double *exact, double *rms) {
  const double step = recommended(study, "step");
  struct run run = {.method = hooke_measurement_text(study, "recommendation", 0, "method"),
                    .duration = until,
                    .every = until};
  if (isnan(step)) {
    run.rtol = recommended(study, "rtol");
    run.atol = recommended(study, "atol");
  } else {
    run.step = step;
  }
  owned_doubles *found = new_doubles(3 * hooke_system_particle_count(system));
  run_to_end(system, run, found, NULL);
  const double error = apart(system, found, exact, rms);
  return error;
}

/* A study for the tightest of these wants: looser ones are then met as well, and each recommendation holds.
 */
TEST(every_want_is_met) {
  const double wants[] = {1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  for (int s = 0; s < SCENES; s++) {
    owned_system *system = scenes[s].make();
    check_ok(hooke_system_commit(system));
    owned_measurement *study =
        made_study(system, METHODS, scenes[s].duration, scenes[s].duration / 20.0, wants[0]);
    const double until = hooke_measurement_number(study, "reference", 0, "trusted_until");
    owned_doubles *exact = new_doubles(3 * hooke_system_particle_count(system));
    check_between(until, 0.5 * scenes[s].duration, scenes[s].duration);
    find_end(system, until, exact);
    for (int w = 0; w < 5; w++) {
      if (w > 0) check_ok(hooke_study_recommend(study, wants[w]));
      if (recommended(study, "met") != 1.0)
        check_failed("scene %d: %g m is refused: %s", s, wants[w],
                     hooke_measurement_text(study, "recommendation", 0, "note"));
      check_between(recommended(study, "error"), 0.0, wants[w]);
      double rms;
      check_between(true_error(system, study, until, exact, &rms), 0.0, wants[w]);
    }
  }
}

/* A long rope with one free end, which errs about twice as much as the whole in the mean: the want is met by
 * the end, too, and the mean is so far below it that it cannot have been what was judged. */
TEST(a_want_is_met_by_every_particle) {
  const double wants[] = {1e-4, 1e-3};
  const double until = 0.5;
  owned_system *system =
      chain(60, 0.02, 0.002, (struct springs){.law = "length", .stiffness = 500.0, .rest_length = -1.0}, 1);
  check_ok(hooke_system_commit(system));
  owned_doubles *exact = new_doubles(3 * hooke_system_particle_count(system));
  find_end(system, until, exact);
  for (int w = 0; w < 2; w++) {
    owned_measurement *study = made_study(system, "symplectic-euler", until, until, wants[w]);
    double rms;
    const double error = true_error(system, study, until, exact, &rms);
    assert_true(recommended(study, "met") == 1.0);
    check_close(recommended(study, "error"), error, 1e-3 * wants[w]);
    check_between(error, 0.7 * wants[w], wants[w]);
    check_between(error / rms, 1.8, 4.0);
  }
}

/* So far from the origin that positions cannot hold the motion, no error is known, and none is said to be 0.
 */
TEST(no_error_is_known_far_away) {
  static const char *const errors[] = {"error", "error_max", "error_final", "energy_drift"};
  const struct {
    double away, want, least; /* every error that is told is at least that */
  } places[] = {{1e8, 0.0, INFINITY}, {1e14, 0.0, INFINITY}, {1e14, 1.0, INFINITY}, {1e14, 1e4, 0.7}};
  for (int p = 0; p < 4; p++) {
    const int64_t ends[] = {0, 1, 1, 2};
    double q[9];
    for (int i = 0; i < 9; i++)
      q[i] = places[p].away + (i % 3 == 0 ? (double)(i / 3) : 0.0);
    owned_system *system = small_system(3, q, NULL, 1.0, 1);
    small_springs(system, 2, ends, (struct springs){.law = "length", .stiffness = 100.0, .rest_length = 0.9});
    check_ok(hooke_system_set_gravity(system, gravity));
    check_ok(hooke_system_commit(system));
    owned_measurement *study = made_study(system, METHODS, 1.0, 0.05, places[p].want);
    check_between((double)hooke_measurement_row_count(study, "rows"), 18.0, 20.0);
    for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
      assert_string_equal(hooke_measurement_text(study, "rows", k, "status"), "finished");
      for (int e = 0; e < 4; e++) {
        const double error = hooke_measurement_number(study, "rows", k, errors[e]);
        assert_true(isnan(error) == (places[p].least == INFINITY));
        if (!isnan(error) && e < 2) check_between(error, places[p].least, INFINITY);
      }
    }
    assert_true(isnan(hooke_measurement_number(study, "orders", 0, "order")));
    assert_true(isnan(hooke_measurement_number(study, "reference", 0, "agreement")) ==
                (places[p].least == INFINITY));
  }
}

/* Steps that are all too coarse, and tolerances: the search continues to values as fine as the reference. */
TEST(none_is_not_said_before_the_finest) {
  owned_system *system = pendulum_of_three();
  owned_options *run = run_options((struct run){.duration = 4.0, .every = 0.5}), *options;
  hooke_measurement *study = NULL;
  check_ok(hooke_system_commit(system));
  options = options_with("study", "methods=cvode-adams tolerances=0.1,0.01 want=1e-6");
  const int32_t status = hooke_measurement_create("study", system, run, options, &study);
  if (status == HOOKE_OK) {
    check_ok(hooke_measurement_run(study, NULL));
    assert_true(recommended(study, "met") == 1.0);
    check_between(recommended(study, "error"), 1e-9, 1e-6);
    check_between(recommended(study, "rtol"), 1e-14, 1e-6);
    check_between(recommended(study, "error_low"), 0.0, recommended(study, "error"));
    check_between(recommended(study, "error_high"), recommended(study, "error"), 1e-6);
    assert_true(isnan(recommended(study, "limit_share")));
  }
  hooke_measurement_destroy(study);
  if (status == HOOKE_NOT_BUILT) skip();
}

/* ---- margins ---- */

/* An oscillator of 1 rad/s by verlet: the limit is 2 s; the error scales with the third power of the
 * frequency, so that 10 % more stiffness makes it 15 % larger, and with the amplitude. */
TEST(margins_are_those_of_an_oscillator) {
  owned_system *system = small_oscillator(1.0);
  owned_measurement *study = made_study(system, "verlet", 4.0, 0.5, 0.0);
  const int64_t row = hooke_measurement_row_count(study, "rows") - 2;
  const double error = hooke_measurement_number(study, "rows", row, "error"),
               step = hooke_measurement_number(study, "rows", row, "step");
  const double wants[] = {1.01 * error, 2.0 * error};
  for (int k = 0; k < 2; k++) {
    check_ok(hooke_study_recommend(study, wants[k]));
    const double found = recommended(study, "error");
    check_between(recommended(study, "step"), step, 2.0 * step);
    if (hooke_build_fact("lapack")[0])
      check_between(recommended(study, "limit_share"), 0.99 * recommended(study, "step") / 2.0,
                    1.01 * recommended(study, "step") / 2.0);
    else
      assert_true(isnan(recommended(study, "limit_share")));
    check_between(recommended(study, "error_stiffness") / found, 1.05, 1.25);
    check_between(recommended(study, "holds_stiffness"), 0.0, 1.0);
    assert_true((recommended(study, "holds_stiffness") == 1.0) ==
                (recommended(study, "error_stiffness") <= wants[k]));
    check_between(recommended(study, "error_start") / found, 0.9, 1.2);
  }
}

/* ---- growth ---- */

enum { POINTS = 3, BASIS = 12 };

static int32_t keep_positions(int64_t step, const hooke_state *state, void *ctx) {
  double **next = ctx;
  (void)step;
  memcpy(*next, hooke_state_position(state), 3 * POINTS * sizeof(double));
  *next += (ptrdiff_t)3 * POINTS;
  return 0;
}

/* Positions at all frames, from a start whose free component k is displaced: positions first, then
 * velocities. */
static void displaced_frames(const hooke_system *system, struct run run, int k, double length,
                             double *frames) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  double *next = frames;
  if (k >= 0 && k < BASIS / 2) hooke_state_position(state)[3 + k] += length;
  if (k >= BASIS / 2) hooke_state_velocity(state)[3 + k - BASIS / 2] += length / run.duration;
  hooke_integrator_on_frame(integrator, keep_positions, &next);
  check_ok(hooke_integrator_run(integrator, state));
}

/* The largest singular value of a matrix of `rows` x BASIS, by iteration. */
static double norm_of(int rows, const double *column[BASIS]) {
  double x[BASIS], square = 1.0;
  for (int j = 0; j < BASIS; j++)
    x[j] = 1.0 / sqrt(BASIS) * (j % 2 ? 1.0 : 0.7);
  for (int turn = 0; turn < 500; turn++) {
    double y[3 * POINTS] = {0.0}, next[BASIS] = {0.0};
    for (int j = 0; j < BASIS; j++)
      for (int i = 0; i < rows; i++)
        y[i] += column[j][i] * x[j];
    square = 0.0;
    for (int j = 0; j < BASIS; j++) {
      for (int i = 0; i < rows; i++)
        next[j] += column[j][i] * y[i];
      square += next[j] * next[j];
    }
    for (int j = 0; j < BASIS; j++)
      x[j] = next[j] / sqrt(square);
  }
  return sqrt(sqrt(square));
}

/* A pendulum of two springs: no more than the bound, which random displacements stay below. */
TEST(growth_is_bounded) {
  enum { FRAMES = 21 };
  const double length = 1e-6;
  const struct run run = {.method = "rk4", .duration = 4.0, .every = 0.2, .step = 2e-4};
  owned_system *system = pendulum_of_two();
  check_ok(hooke_system_commit(system));
  owned_measurement *study = made_study(system, "rk4", run.duration, run.every, 0.0);
  double *frames = new_doubles((int64_t)(BASIS + 1) * FRAMES * 3 * POINTS), largest_norm = 0.0;
  const ptrdiff_t stride = (ptrdiff_t)FRAMES * 3 * POINTS;
  for (int k = -1; k < BASIS; k++)
    displaced_frames(system, run, k, length, frames + (k + 1) * stride);
  for (int k = 0; k < BASIS; k++)
    for (ptrdiff_t i = 0; i < stride; i++)
      frames[(k + 1) * stride + i] = (frames[(k + 1) * stride + i] - frames[i]) / length;
  for (int f = 0; f < FRAMES; f++) {
    const double *column[BASIS];
    for (int k = 0; k < BASIS; k++)
      column[k] = frames + (k + 1) * stride + (ptrdiff_t)f * 3 * POINTS;
    largest_norm = fmax(largest_norm, norm_of(3 * POINTS, column));
  }
  check_between(largest_norm, 1.5, 1e4);
  const double sure = hooke_measurement_number(study, "reference", 0, "growth_probability");
  check_between(hooke_measurement_number(study, "reference", 0, "growth") / largest_norm, 0.99,
                sure == 1.0 ? 1.01 : 8.0 * sqrt(2.0 * BASIS));
  check_between(hooke_measurement_number(study, "reference", 0, "growth_seen") / largest_norm, 0.05, 1.001);
  free(frames);
}

/* ---- reasons for not judging the whole run ---- */

TEST(the_reason_is_the_true_one) {
  owned_system *system = pendulum_of_three();
  check_ok(hooke_system_commit(system));
  /* 6 s are known to a millimetre, and 10 s not to 10 nm: rounding grows beyond that */
  hooke_measurement *study = made_study(system, "rk4", 6.0, 0.1, 1e-3);
  assert_string_equal(hooke_measurement_text(study, "reference", 0, "ended"), "agreed");
  check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-12, 1e-4);
  hooke_measurement_destroy(study);
  study = made_study(system, "rk4", 10.0, 0.1, 1e-8);
  assert_string_equal(hooke_measurement_text(study, "reference", 0, "ended"),
                      hooke_method_is_built("cvode-adams") ? "rounding" : "finest");
  check_between(hooke_measurement_number(study, "reference", 0, "trusted_until"), 1.0, 9.9);
  check_between(hooke_measurement_number(study, "reference", 0, "agreement"), 1e-14, 1e-9);
  assert_true(hooke_measurement_number(study, "study", 0, "budget_spent") == 0.0);
  hooke_measurement_destroy(study);
}
