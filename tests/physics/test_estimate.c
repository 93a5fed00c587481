/* The estimated error of a run is its true error; a run picked for a wanted error meets it; spontaneous gain
 * of energy is detected. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* Two periods: at their end a phase that is off shows a twelfth of what it does between, so that who judges
 * the end alone claims too much. */
static const double OMEGA = 6.283185307179586, DURATION = 2.0, EVERY = 0.02;

static double number_of(const hooke_measurement *estimate, const char *what) {
  return hooke_measurement_number(estimate, "estimate", 0, what);
}

static const char *text_of(const hooke_measurement *estimate, const char *what) {
  return hooke_measurement_text(estimate, "estimate", 0, what);
}

/* Error of the oscillator, whose motion is known. */
static double true_error(const hooke_state *state) {
  const double *q = hooke_state_position(state) + 3, t = hooke_state_time(state);
  const double x = cos(OMEGA * t), y = 0.5 * sin(OMEGA * t) / OMEGA;
  return hypot(q[0] - x, q[1] - y);
}

/* Shows frames to an estimate, and keeps the largest error of the oscillator at them. */
struct watcher {
  hooke_measurement *estimate;
  double worst;
};

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  struct watcher *watcher = ctx;
  watcher->worst = fmax(watcher->worst, true_error(state));
  return hooke_estimate_see(step, state, watcher->estimate);
}

/* Estimates a run; the caller destroys the estimate; returns the largest error of the oscillator. */
static double estimated_run(const hooke_system *system, const hooke_options *options,
                            hooke_measurement *estimate) {
  struct watcher watcher = {estimate, 0.0};
  owned_integrator *integrator;
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_create(system, options, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, see, &watcher));
  check_ok(hooke_estimate_begin(estimate, integrator, state));
  check_ok(hooke_integrator_run(integrator, state));
  check_ok(hooke_measurement_run(estimate, state));
  return watcher.worst;
}

/* The farthest particle at any frame is at most as far off as is said; the excess is at most that of a safety
 * factor of 3 for an order of 1, or of one more where errors do not follow the tolerance. */
static void check_estimate(const hooke_system *system, const char *method, int64_t *known) {
  owned_measurement *estimate;
  owned_options *options =
      run_options((struct run){.method = method, .step = 2.5e-3, .duration = DURATION, .every = EVERY});
  check_ok(estimate_of(system, NAN, &estimate));
  const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
  if (!isnan(found)) {
    ++*known;
    const double most = hooke_method_is_adaptive(method) ? 10.0 : 1.5;
    if (!(found >= truly && found <= most * truly))
      check_failed("%s is said to be off by %.3g m, and is by %.3g m", method, found, truly);
    check_close(number_of(estimate, "known_until"), DURATION, 0.0);
    check_close(number_of(estimate, "rms"), found, 1e-12 * found); /* one particle is free */
  }
  assert_true(isnan(number_of(estimate, "met")));
}

TEST(test_errors_are_at_most_what_is_said_and_not_much_less) {
  owned_system *system = small_oscillator(OMEGA);
  int64_t known = 0, methods = 0;
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (!hooke_method_is_built(method)) continue;
    methods += hooke_method_is_adaptive(method) == 0;
    check_estimate(system, method, &known);
  }
  if (known < methods) check_failed("%d estimates for %d methods", (int)known, (int)methods);
}

/* Estimates a run whose integrator was destroyed before; the caller destroys the estimate; `time` [s] of its
 * end. */
static hooke_measurement *estimated_later(const hooke_system *system, const hooke_options *options,
                                          double time) {
  hooke_integrator *integrator;
  hooke_measurement *estimate;
  owned_state *state = start_state(system);
  check_ok(estimate_of(system, NAN, &estimate));
  check_ok(hooke_integrator_create(system, options, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, hooke_estimate_see, estimate));
  check_ok(hooke_estimate_begin(estimate, integrator, state));
  check_ok(hooke_integrator_run(integrator, state));
  hooke_integrator_destroy(integrator);
  hooke_state_set_time(state, time);
  check_ok(hooke_measurement_run(estimate, state));
  return estimate;
}

TEST(test_the_integrator_may_be_gone) {
  owned_system *system = small_oscillator(OMEGA);
  owned_options *options =
      run_options((struct run){.method = "verlet", .step = 2.5e-3, .duration = DURATION, .every = EVERY});
  owned_measurement *one = estimated_later(system, options, DURATION),
                    *other = estimated_later(system, options, DURATION),
                    *short_of = estimated_later(system, options, 0.5 * DURATION);
  check_close(number_of(other, "estimate"), number_of(one, "estimate"), 0.0);
  assert_string_equal(text_of(other, "by"), text_of(one, "by"));
  assert_string_equal(text_of(short_of, "reason"), "the run did not come to its end");
}

/* At a step of 0.2 s, h omega is 1.2, and the phase is lost after some periods, whatever half the step does.
 */
TEST(test_a_run_that_lost_the_motion_is_not_known) {
  owned_system *system = small_oscillator(OMEGA);
  owned_measurement *estimate;
  owned_options *options =
      run_options((struct run){.method = "symplectic-euler", .step = 0.2, .duration = 200.0, .every = 0.2});
  check_ok(estimate_of(system, NAN, &estimate));
  const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
  if (isnan(found)) {
    assert_true(text_of(estimate, "by") == NULL && text_of(estimate, "reason")[0] != '\0');
    assert_true(isnan(number_of(estimate, "known_until")) && isnan(number_of(estimate, "rms")));
    assert_true(number_of(estimate, "last_from") >= 190.0 && number_of(estimate, "last_piece") > 0.0);
  } else if (found < truly) {
    check_failed("said to be off by %.3g m, and is by %.3g m", found, truly);
  }
}

static int32_t no_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)force, (void)ctx;
  return 0;
}

TEST(test_callbacks_are_not_called_again_unless_asked) {
  for (int asked = 0; asked < 2; asked++) {
    owned_options *own,
        *options =
            run_options((struct run){.method = "verlet", .step = 2.5e-3, .duration = 0.5, .every = EVERY});
    owned_measurement *estimate;
    const double mass = 1.0;
    owned_system *system = small_system(1, (double[]){0, 0, 0}, (double[]){1, 0, 0}, mass, 0);
    check_ok(hooke_system_set_force(system, no_force, NULL, NULL));
    check_ok(hooke_system_commit(system));
    own = options_with("estimate", "callbacks=%d", asked);
    check_ok(hooke_measurement_create("estimate", system, NULL, own, &estimate));
    owned_integrator *integrator;
    owned_state *state = start_state(system);
    check_ok(hooke_integrator_create(system, options, &integrator));
    check_ok(hooke_integrator_on_frame(integrator, hooke_estimate_see, estimate));
    check_ok(hooke_estimate_begin(estimate, integrator, state));
    check_ok(hooke_integrator_run(integrator, state));
    check_ok(hooke_measurement_run(estimate, state));
    assert_int_equal(isnan(number_of(estimate, "estimate")) != 0, !asked);
    assert_string_equal(text_of(estimate, "reason"), asked ? "" : "a callback takes part");
  }
}

/* Pushes from a run on, which no force does, and in each later one by a share of that: runs begin where time
 * goes back. */
struct liar {
  const char *reason;
  int64_t from;
  double push, share, time;
  int64_t runs;
};

static int32_t lie(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct liar *liar = ctx;
  (void)n, (void)q, (void)v;
  liar->runs += t < liar->time - 0.03;
  liar->time = t;
  if (liar->runs >= liar->from) force[3] += liar->push * pow(liar->share, (double)(liar->runs - liar->from));
  return 0;
}

/* A run, one at half the step and one at twice agree, and the other method never comes near. One that comes
 * nearer each time, or breaks off, does not contradict, and a finer run that breaks off says nothing. */
TEST(test_what_another_method_contradicts_is_not_known) {
  struct liar liars[] = {{"another method, tr-bdf2, says otherwise", 3, 100.0, 1.0, 0.0, 0},
                         {"", 3, 100.0, 0.7, 0.0, 0},
                         {"", 3, NAN, 1.0, 0.0, 0},
                         {"a finer run did not come to its end", 1, NAN, 1.0, 0.0, 0}};
  owned_system *plain = small_oscillator(OMEGA);
  for (int k = 0; k < 4; k++) {
    owned_system *system = NULL;
    check_ok(hooke_system_with_force(plain, lie, NULL, &liars[k], &system));
    owned_options *own = options_with("estimate", "callbacks=1"),
                  *options = run_options((struct run){
                      .method = "implicit-midpoint", .step = 2.5e-3, .duration = 0.5, .every = EVERY});
    owned_measurement *estimate;
    check_ok(hooke_measurement_create("estimate", system, NULL, own, &estimate));
    const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
    assert_string_equal(text_of(estimate, "reason"), liars[k].reason);
    assert_true(liars[k].runs >= liars[k].from);
    if (liars[k].reason[0] == '\0') {
      assert_true(found >= truly);
      continue;
    }
    assert_true(isnan(found) && isnan(number_of(estimate, "rms")));
    assert_true(text_of(estimate, "by") == NULL && isnan(number_of(estimate, "known_until")));
  }
}

/* Stops what follows a run. */
static int32_t stop_at(double done, const char *what, void *ctx) {
  return done >= 0.0 && strcmp(what, ctx) == 0;
}

TEST(test_what_is_interrupted_is_not_known) {
  owned_system *system = small_oscillator(OMEGA);
  owned_options *options =
      run_options((struct run){.method = "verlet", .step = 2.5e-3, .duration = DURATION, .every = EVERY});
  static char pieces[][24] = {"error, heat", "error, half the step", "error, another method"};
  owned_measurement *estimate;
  owned_state *end = start_state(system);
  hooke_state_set_time(end, DURATION);
  check_ok(estimate_of(system, NAN, &estimate));
  estimated_run(system, options, estimate);
  for (int k = 0; k < 3; k++) {
    hooke_measurement_on_progress(estimate, stop_at, pieces[k]);
    check_status(hooke_measurement_run(estimate, end), HOOKE_STOPPED);
    assert_int_equal(isnan(number_of(estimate, "estimate")) != 0, k > 0); /* known before its heat */
    assert_string_equal(text_of(estimate, "reason"), k > 0 ? "interrupted" : "");
  }
}

/* Another method takes more memory than runs: many particles are left to the method itself. */
TEST(test_many_particles_are_not_judged_by_another_method) {
  enum { MANY = 10001 };
  double *zeros = new_doubles(3 * MANY);
  owned_system *system = small_system(MANY, zeros, zeros, 1.0, 0);
  free(zeros);
  owned_options *options = run_options((struct run){.method = "rk4", .step = 0.01, .duration = 0.1});
  owned_measurement *estimate;
  owned_system *falling = small_falling(system);
  system = NULL;
  check_ok(estimate_of(falling, NAN, &estimate));
  hooke_measurement_on_progress(estimate, stop_at, "error, another method");
  estimated_run(falling, options, estimate);
  check_between(number_of(estimate, "estimate"), 0.0, 1e-12);
}

/* No tighter tolerance is possible, and looser ones tell, unless nothing moves. */
TEST(test_the_tightest_tolerance_is_judged_by_looser_ones) {
  if (!hooke_method_is_built("cvode-adams")) skip();
  owned_system *system = small_oscillator(OMEGA);
  owned_measurement *estimate;
  owned_options *options = run_options((struct run){
      .method = "cvode-adams", .duration = DURATION, .every = EVERY, .rtol = 5e-14, .atol = 5e-14});
  check_ok(estimate_of(system, NAN, &estimate));
  const double truly = estimated_run(system, options, estimate);
  check_between(number_of(estimate, "estimate") / truly, 1.0, 300.0);
  assert_string_equal(text_of(estimate, "by"), "tolerance");
  owned_system *rests = small_system(1, (double[]){0, 0, 0}, (double[]){0, 0, 0}, 1.0, 0);
  check_ok(hooke_system_commit(rests));
  owned_measurement *of_rest;
  check_ok(hooke_options_set_number(options, "rtol", 1e-14));
  check_ok(estimate_of(rests, NAN, &of_rest));
  estimated_run(rests, options, of_rest);
  assert_true(isnan(number_of(of_rest, "estimate")) && isnan(number_of(of_rest, "last_piece")));
  check_between((double)strncmp(text_of(of_rest, "reason"), "the run is too long, or its tolerance", 37), 0.0,
                0.0);
}

static double number_of_run(const hooke_system *system, const char *method, double step, const char *what) {
  owned_options *options =
      run_options((struct run){.method = method, .step = step, .duration = DURATION, .every = EVERY});
  owned_measurement *estimate;
  check_ok(estimate_of(system, NAN, &estimate));
  estimated_run(system, options, estimate);
  const double number = number_of(estimate, what);
  return number;
}

/* With forward Euler the energy grows by the factor 1 + (h omega)^2 a step. */
TEST(test_energy_that_grows_by_itself_is_seen) {
  owned_system *system = small_oscillator(OMEGA);
  const double step = 1e-3, rate = OMEGA * OMEGA * step;
  const double expected = exp(rate * DURATION) - exp(0.5 * rate * DURATION);
  const double found = number_of_run(system, "forward-euler", step, "energy_rise");
  if (!(found > 0.9 * expected && found < 1.1 * expected))
    check_failed("a rise of %.4g of the energy, not of %.4g", found, expected);
  check_close(number_of_run(system, "symplectic-euler", 1e-2, "energy_rise"), 0.0, 0.0);
  check_close(number_of_run(system, "backward-euler", 1e-2, "energy_rise"), 0.0, 0.0);
}

/* One particle slowed by drag alone, by h lambda a step. */
static hooke_system *slowed_particle(double rate) {
  const double mass = 2.0;
  hooke_system *system = small_system(1, (double[]){0, 0, 0}, (double[]){0, 3, 0}, mass, 0);
  check_ok(hooke_system_set_drag(system, rate * mass));
  check_ok(hooke_system_commit(system));
  return system;
}

/* With forward Euler the velocity is multiplied by r = 1 - h lambda a step. For r < -1/2 all heat from the
 * third step on is that of a reversing velocity: 2 h lambda r^6/(1 - r^2) of the energy. The sum may be cut
 * short on a busy machine. */
TEST(test_heat_that_was_not_there_is_seen) {
  const double step = 1e-3, r = -0.9;
  owned_system *system = slowed_particle((1.0 - r) / step);
  const double expected = 2.0 * (1.0 - r) * pow(r, 6.0) / (1.0 - r * r);
  const double found = number_of_run(system, "forward-euler", step, "heat_excess");
  if (!(found > 0.5 * expected && found < (1.0 + 1e-9) * expected))
    check_failed("an excess of %.6g of the energy, not of %.6g", found, expected);
  check_close(number_of_run(system, "forward-euler", 0.25 * step, "heat_excess"), 0.0, 0.0);
}

/* The same in a wind: from the same velocity beside it, or slower than the wind by `behind` m/s. */
static hooke_system *slowed_in_wind(double rate, double behind) {
  const double mass = 2.0, wind[3] = {40, 0, 10}, velocity[3] = {40 - behind, 3, 10};
  hooke_system *system = small_system(1, (double[]){0, 0, 0}, velocity, mass, 0);
  owned_options *options = options_with("scene", "drag=%g", rate * mass);
  check_ok(hooke_options_set_numbers(options, "wind", 3, wind));
  check_ok(hooke_scene_options_apply(options, system));
  check_ok(hooke_system_commit(system));
  return system;
}

/* Velocities that reverse beside the wind are seen, and what the wind heats is none of theirs. */
TEST(test_heat_of_a_wind_is_no_excess) {
  owned_system *fast = slowed_in_wind(180.0, 0.0), *slow = slowed_in_wind(20.0, 3.0);
  check_between(number_of_run(fast, "forward-euler", 1e-2, "heat_excess"), 1e-4, 1.0);
  check_between(number_of_run(slow, "forward-euler", 1e-2, "heat_excess"), 0.0, 1e-3);
}

/* Motion that decays without overshooting, or oscillates, has no spurious heat at any of these steps. */
TEST(test_heat_that_was_there_is_no_excess) {
  for (double x = 0.1; x < 2.0; x += 0.1) {
    owned_system *system = slowed_particle(x / 1e-3);
    const double found = number_of_run(system, "rk4", 1e-3, "heat_excess");
    if (!(found >= 0.0 && found <= 0.01)) check_failed("rk4 at h lambda = %g: %.3g", x, found);
  }
  owned_system *system = small_oscillator(OMEGA);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (!hooke_method_is_built(method)) continue;
    const double found = number_of_run(system, method, 1e-2, "heat_excess");
    if (hooke_method_is_adaptive(method) ? !isnan(found) : found != 0.0)
      check_failed("%s: %.3g of an oscillator without damping", method, found);
  }
}

/* A chain of 0.1 kg whose particles fly apart; dampers have rates of up to 400 gamma [1/s]. */
static hooke_system *damped_chain(double gamma, int driven) {
  enum { COUNT = 12 };
  double place[3 * COUNT], velocity[3 * COUNT];
  const double mass = 0.1;
  const int64_t first = 0;
  int64_t ends[2 * (COUNT - 1)];
  for (int k = 0; k < 3 * COUNT; k++) {
    place[k] = k % 3 ? 0.0 : 0.1 * (k / 3);
    velocity[k] = k < 3 ? 0.0 : (k * 29 % 17 - 8) / 8.0;
  }
  for (int k = 0; k < 2 * (COUNT - 1); k++)
    ends[k] = (k + 1) / 2;
  hooke_system *system = small_system(COUNT, place, velocity, mass, 0);
  owned_options *options = options_with("springs", "stiffness=1 damping=%.17g", gamma);
  check_ok(hooke_system_add_springs(system, "", COUNT - 1, ends, options));
  if (driven)
    check_ok(hooke_system_drive_harmonic(system, 1, &first, (double[]){0, 0.2, 0}, 1.5, 0.0));
  else
    check_ok(hooke_system_pin(system, 1, &first));
  check_ok(hooke_system_commit(system));
  return system;
}

/* Euler's step is just below the limit of the damping. Verlet has no such limit, since its second half takes
 * the damping at the new velocity; from h lambda = 2 on its velocities reverse. */
TEST(test_a_damper_too_stiff_for_the_step_is_seen) {
  static const struct {
    const char *method;
    double gamma;
  } coarse[] = {{"forward-euler", 0.24}, {"symplectic-euler", 0.22}, {"verlet", 2.0}};
  for (int k = 0; k < 6; k++) {
    owned_system *system = damped_chain(coarse[k / 2].gamma, k % 2);
    const double found = number_of_run(system, coarse[k / 2].method, 2e-2, "heat_excess");
    if (!(found > 0.01)) check_failed("%s: %.3g at a coarse step", coarse[k / 2].method, found);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (hooke_method_is_adaptive(method) || !hooke_method_is_built(method) || left_out(m + k, 3)) continue;
      const double fine = number_of_run(system, method, 5e-4, "heat_excess");
      if (!(fine >= 0.0 && fine < 1e-3)) check_failed("%s: %.3g at a fine step", method, fine);
    }
  }
}

static void check_want(const hooke_system *system, const char *method, double want) {
  hooke_options *options = run_options((struct run){.duration = DURATION, .every = EVERY});
  hooke_measurement *estimate;
  check_ok(estimate_of(system, want, &estimate));
  const int32_t status = hooke_estimate_pick(estimate, method, options);
  if (status == HOOKE_NOT_BUILT) {
    hooke_measurement_destroy(estimate);
    hooke_options_destroy(options);
    hooke_system_destroy((hooke_system *)(uintptr_t)system);
    skip();
  }
  check_status(status, HOOKE_OK);
  if (method) assert_string_equal(hooke_options_text(options, "method"), method);
  const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
  if (number_of(estimate, "met") != 1.0 || !(truly <= want && found <= want && found >= 0.8 * truly))
    check_failed("%s for %g m: met %g, said to be off by %.3g m, and is by %.3g m",
                 hooke_options_text(options, "method"), want, number_of(estimate, "met"), found, truly);
  hooke_measurement_destroy(estimate);
  hooke_options_destroy(options);
}

TEST(test_what_is_picked_keeps_to_the_wanted_error) {
  owned_system *system = small_oscillator(OMEGA);
  static const double wants[] = {0.1, 1e-3, 1e-6};
  for (int k = 0; k < 3; k++)
    check_want(system, NULL, wants[k]);
  check_want(system, "verlet", 1e-4);
  check_want(system, "cvode-adams", 1e-4);
}

/* However large the error that is wanted, a run that is not sound does not meet it; tolerances are sound. */
TEST(test_runs_that_are_not_sound_meet_no_want) {
  static const struct {
    const char *method, *reason;
    double step;
  } cases[] = {{"forward-euler", "its step is above 0.9 of the stable one", 2.5e-3},
               {"verlet", "its step is above 0.9 of the stable one", 0.96 * 2.0 / OMEGA},
               {"cvode-adams", "", 0.0}};
  owned_system *system = small_oscillator(OMEGA);
  for (int k = 0; k < 3; k++) {
    if (!hooke_method_is_built(cases[k].method)) continue;
    owned_measurement *estimate;
    owned_options *options = run_options((struct run){.method = cases[k].method,
                                                      .step = cases[k].step,
                                                      .rtol = 0.05,
                                                      .atol = 1e-9,
                                                      .atol_velocity = 1e-9,
                                                      .duration = k < 2 ? 40 * cases[k].step : DURATION,
                                                      .every = k < 2 ? cases[k].step : EVERY});
    check_ok(estimate_of(system, 1e6, &estimate));
    const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
    assert_true(found >= truly);
    check_close(number_of(estimate, "met"), k == 2, 0.0);
    assert_string_equal(text_of(estimate, "reason"), cases[k].reason);
  }
}

/* A run coarser than the picked one misses what is wanted, and finer ones come to it: each is as far off at
 * some frame as is said, but for what the reference is not known to. */
static void check_refinement(const char *method, const char *number, double coarser, double want) {
  owned_system *system = small_oscillator(OMEGA);
  owned_options *options = run_options((struct run){.duration = DURATION, .every = EVERY});
  owned_measurement *estimate;
  double met = 0.0;
  check_ok(estimate_of(system, want, &estimate));
  check_ok(hooke_estimate_pick(estimate, method, options));
  check_ok(hooke_options_set_number(options, number, coarser));
  for (int run = 0; run < 5 && met == 0.0; run++) {
    if (run > 0) check_ok(hooke_estimate_refine(estimate, options));
    const double truly = estimated_run(system, options, estimate), found = number_of(estimate, "estimate");
    met = number_of(estimate, "met");
    check_between(found, truly, truly + 0.02 * want);
    check_close(met, found <= want, 0.0);
    assert_string_equal(text_of(estimate, "by"), "reference");
  }
  check_close(met, 1.0, 0.0);
}

TEST(test_finer_runs_come_to_the_wanted_error) {
  if (!hooke_method_is_built("cvode-adams")) skip();
  check_refinement("verlet", "step", EVERY, 1e-5);
  check_refinement("rk4", "step", EVERY, 1e-7);
  check_refinement("cvode-adams", "rtol", 1e-2, 1e-5);
}

/* A soft block of 3 x 3 x 3 particles, fixed at one side, that sags: its bound lies far below its limit. */
static hooke_system *sagging_block(void) {
  owned_options *options =
      options_with("lattice", "edges=1,0,0,0,1,0,0,0,1 size=3,3,3 mass=1 pinned=bottom "
                              "structural.stiffness=500 shear.stiffness=500 structural.damping=0.2");
  hooke_system *system = new_system();
  check_ok(hooke_system_set_gravity(system, (double[]){0, -1, 0}));
  check_ok(hooke_system_add_part(system, "lattice", "block", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  return system;
}

/* The smallest limit of its method at the frames of a run. */
static double least_limit_along(const hooke_system *system, const hooke_options *run) {
  owned_measurement *limit;
  owned_state *state = start_state(system);
  owned_options *options = options_with("limit", "along=1");
  check_ok(hooke_options_set_text(options, "methods", hooke_options_text(run, "method")));
  check_ok(hooke_measurement_create("limit", system, run, options, &limit));
  check_ok(hooke_measurement_run(limit, state));
  const double least = hooke_measurement_number(limit, "rows", 0, "smallest");
  return least;
}

/* Ratio of the picked step, which is at most 0.9 of the limit at every frame, to the bound at the start. */
static double picked_over_bound(const hooke_system *system, const char *method) {
  owned_options *options = run_options((struct run){.duration = 1.0, .every = 0.1});
  owned_state *state = start_state(system);
  owned_measurement *estimate;
  double bound = NAN;
  check_ok(estimate_of(system, 0.05, &estimate));
  check_ok(hooke_estimate_pick(estimate, method, options));
  check_ok(hooke_step_bound(system, method, hooke_state_position(state), &bound));
  const double step = hooke_options_number(options, "step"), limit = least_limit_along(system, options);
  if (!(step <= 0.9 * limit)) check_failed("%s is picked with %g s, of a limit of %g s", method, step, limit);
  return step / bound;
}

/* Steps as long as frames are apart, and times that no step fits but tiny ones. */
TEST(test_steps_that_hardly_fit) {
  owned_system *system = small_oscillator(OMEGA);
  owned_options *large = run_options(
                    (struct run){.method = "verlet", .step = EVERY, .duration = DURATION, .every = EVERY}),
                *tiny = run_options((struct run){
                    .method = "symplectic-euler", .step = 5e-5, .duration = 1.00005, .every = 1.0});
  owned_measurement *estimate, *other;
  check_ok(estimate_of(system, 1e-9, &estimate));
  double truly = estimated_run(system, large, estimate);
  check_between(number_of(estimate, "estimate"), truly, 3.5 * truly);
  check_ok(estimate_of(system, 1e-9, &other));
  truly = estimated_run(system, tiny, other);
  check_between(number_of(other, "estimate"), truly, 4.0 * truly);
}

TEST(test_a_picked_step_may_pass_the_bound_but_not_the_limit) {
  if (!hooke_method_is_built("cvode-adams") || !hooke_build_fact("lapack")[0]) skip();
  owned_system *system = sagging_block();
  check_between(picked_over_bound(system, "symplectic-euler"), 0.95, 2.0);
  check_between(picked_over_bound(system, "rk4"), 0.95, 2.0);
}

TEST(test_what_cannot_be_asked_for) {
  owned_system *system = small_oscillator(OMEGA);
  hooke_measurement *estimate = NULL;
  owned_options *options = run_options((struct run){.duration = DURATION, .every = EVERY});
  owned_state *state = start_state(system);
  check_status(estimate_of(system, -1.0, &estimate), HOOKE_BAD_VALUE);
  check_status(estimate_of(system, INFINITY, &estimate), HOOKE_BAD_VALUE);
  check_ok(estimate_of(system, NAN, &estimate));
  check_status(hooke_estimate_pick(estimate, NULL, options), HOOKE_BAD_CALL);
  owned_options *of_no_run = options_with("estimate", "want=1");
  check_status(hooke_estimate_pick(estimate, NULL, of_no_run), HOOKE_BAD_VALUE);
  check_status(hooke_estimate_refine(estimate, options), HOOKE_UNSUITED);
  assert_int_equal(hooke_estimate_see(0, state, estimate), 0); /* of no run that has begun */
  check_status(hooke_measurement_run(estimate, state), HOOKE_BAD_CALL);
  check_status(hooke_measurement_run(estimate, NULL), HOOKE_BAD_VALUE);
  assert_true(isnan(number_of(estimate, "estimate")) && isnan(number_of(estimate, "memory_bytes")));
  assert_true(text_of(estimate, "by") == NULL);
  hooke_measurement_destroy(estimate);
  hooke_measurement *cost;
  check_ok(hooke_measurement_create("cost", system, NULL, NULL, &cost));
  check_status(hooke_estimate_pick(cost, NULL, options), HOOKE_BAD_CALL);
  check_message("needs a measurement of the kind \"estimate\", this is a \"cost\"");
  check_status(hooke_estimate_refine(cost, options), HOOKE_BAD_CALL);
  assert_int_equal(hooke_estimate_see(0, state, cost), 0);
  hooke_measurement_destroy(cost);
  /* the run of another system */
  owned_system *other = small_oscillator(2.0 * OMEGA);
  owned_integrator *integrator =
      start_run(other, (struct run){.method = "rk4", .step = 0.01, .duration = 0.1});
  owned_measurement *other_cost;
  check_ok(hooke_measurement_create("cost", other, NULL, NULL, &other_cost));
  check_status(hooke_estimate_begin(other_cost, integrator, state), HOOKE_BAD_CALL);
  check_ok(estimate_of(system, 1e-3, &estimate));
  check_status(hooke_estimate_begin(estimate, integrator, state), HOOKE_BAD_VALUE);
  check_message("integrator: is not one of the system that the estimate is for");
  check_status(hooke_estimate_pick(estimate, "no-such-method", options), HOOKE_BAD_VALUE);
  check_message("no method \"no-such-method\"");
  hooke_measurement_destroy(estimate);
  /* stable at no step without damping */
  check_ok(estimate_of(system, 1e-3, &estimate));
  check_status(hooke_estimate_pick(estimate, "forward-euler", options), HOOKE_UNSUITED);
  check_message("forward-euler has no step that is stable here");
  check_ok(hooke_options_unset(options, "duration"));
  check_status(hooke_estimate_pick(estimate, NULL, options), HOOKE_BAD_VALUE);
  hooke_measurement_destroy(estimate);
}

/* Nothing of a state that does not fit is read, and the run stops where it would be seen. */
TEST(test_states_that_do_not_fit_are_refused) {
  owned_system *system = small_oscillator(OMEGA);
  const struct run run = {.method = "rk4", .step = 0.01, .duration = 0.1};
  owned_integrator *integrator = start_run(system, run),
                   *endless = start_run(system, (struct run){.method = "rk4", .step = 0.01});
  owned_measurement *estimate = NULL;
  hooke_state *state = start_state(system), *wrong[3];
  check_ok(hooke_state_create_first_order(6, &wrong[0]));
  check_ok(hooke_state_create_second_order(5, &wrong[1]));
  check_ok(hooke_state_create_second_order(600, &wrong[2]));
  check_ok(estimate_of(system, NAN, &estimate));
  check_status(hooke_estimate_begin(estimate, endless, state), HOOKE_BAD_VALUE);
  check_message("duration");
  for (int k = 0; k < 3; k++) {
    check_ok(hooke_estimate_begin(estimate, integrator, state));
    check_status(hooke_estimate_begin(estimate, integrator, wrong[k]), HOOKE_BAD_VALUE);
    assert_int_equal(hooke_estimate_see(0, wrong[k], estimate), HOOKE_BAD_VALUE);
    check_message("does not fit a problem of 6");
    check_status(hooke_measurement_run(estimate, wrong[k]), HOOKE_BAD_VALUE);
    assert_int_equal(hooke_estimate_see(0, state, estimate), 0);
    check_status(hooke_integrator_recent(integrator, 0, wrong[k]), HOOKE_BAD_VALUE);
    hooke_state_destroy(wrong[k]);
  }
  /* the end of a run that showed no frames */
  hooke_state_set_time(state, 0.1);
  check_ok(hooke_estimate_begin(estimate, integrator, state));
  hooke_state_set_time(state, 0.2);
  check_ok(hooke_measurement_run(estimate, state));
  assert_string_equal(text_of(estimate, "reason"), "the run did not come to its end");
  hooke_state_destroy(state);
}
