/* Estimates where what they rest on is rare: references that are short or not good enough, runs that are too
 * long for a finer one, and refinement that does not help. */
#include "check.h"
#include "measure/estimate/estimate.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Past the guard, which knows measurements that the library made. */
int32_t hooke_unchecked_estimate_refine(hooke_measurement *estimate, hooke_options *options);

static const double OMEGA = 6.283185307179586, WANT = 1e-3;

/* An estimate of a run of 1 s; agreement 0: without a reference. */
static struct hk_estimate estimate_with(const hooke_system *system, double error, double agreement) {
  return (struct hk_estimate){
      .system = system,
      .wants = {.count = 1, .want = {{.name = "particles", .bound = WANT}}, .most = WANT, .length = 1.0},
      .bound = {WANT},
      .duration = 1.0,
      .every = 0.1,
      .error = {error, error},
      .by = isnan(error) ? NULL : "half-step",
      .last_error = NAN,
      .first = 0.1,
      .pick = {.fraction = agreement > 0.0 ? 1.0 : 0.0,
               .reference = {.agreement = agreement, .wanted_agreement = agreement}},
      .soundness = {.system = system, .least_limit = INFINITY}};
}

/* ---- what is said of a want ---- */

TEST(wants_are_met_by_what_is_known_alone) {
  static const struct {
    double error, known_until, agreement, least_limit, met;
    int32_t unknown_limit;
    const char *told;
  } cases[] = {
      {5e-4, 1.0, 0.0, INFINITY, 1.0, 0, "that is within the wanted"},
      {5e-4, 1.0, 1e-5, INFINITY, 1.0, 0, "that is within the wanted"},
      {2e-3, 1.0, 0.0, INFINITY, 0.0, 0, "are not met"},
      {5e-4, 1.0, 0.0, 0.1, 0.0, 0, "are not met"},
      {5e-4, 1.0, 0.0, INFINITY, NAN, 1, "nobody knows"},
      {5e-4, 0.5, 0.0, INFINITY, NAN, 0, "nobody knows"},
      {NAN, NAN, 0.0, 0.1, NAN, 0, "nobody knows"},
      {3e-3, 1.0, 2e-3, INFINITY, NAN, 0, "nobody knows"}, /* the run may be within it all the same */
      {9e-3, 1.0, 2e-3, INFINITY, 0.0, 0, "are not met"},
  };
  owned_system *system = small_oscillator(OMEGA);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    struct hk_estimate e = estimate_with(system, cases[k].error, cases[k].agreement);
    e.known_until = cases[k].known_until;
    e.soundness.least_limit = cases[k].least_limit;
    e.soundness.unknown_limit = cases[k].unknown_limit;
    snprintf(e.reversal, sizeof e.reversal, "by a clock");
    const hooke_measurement measurement = {.object = &e};
    owned(hk_claims_release) struct hk_claims claims = {0};
    const double met = hk_estimate_met(&e);
    hk_estimate_claim(&measurement, &claims);
    assert_int_equal(claims.count, 3);
    if (!(met == cases[k].met || (isnan(met) && isnan(cases[k].met))) ||
        strstr(claims.claim[1].text, cases[k].told) == NULL)
      check_failed("case %d: met %g, \"%s\"", (int)k, met, claims.claim[1].text);
    assert_string_equal(claims.claim[2].text, "picked by a clock");
  }
}

/* ---- refining ---- */

TEST(runs_are_refined_where_that_is_known_to_help) {
  static const struct {
    double error, before, order, work, agreement, step; /* step NaN: refused */
    int32_t refined, status;
    double duration;
    const char *refusal;
  } cases[] = {
      {2e-3, INFINITY, NAN, 0.1, 0.0, 0.1 / 34.0, 0, HOOKE_OK, 1.0, NULL}, /* 0.6 of the want, by order 1 */
      {6e-3, INFINITY, 2.0, 0.1, 0.0, 0.1 / 32.0, 0, HOOKE_OK, 1.0, NULL},
      {0.4, INFINITY, 2.0, 0.1, 0.0, 0.1 / 160.0, 0, HOOKE_OK, 1.0,
       NULL}, /* at most to a sixteenth at once */
      {2e-3, 2.5e-3, 2.0, 0.1, 0.0, NAN, 1, HOOKE_UNSUITED, 1.0, "nothing finer is known to help"},
      {2e-3, 1.0, 2.0, 0.1, 0.0, NAN, 4, HOOKE_UNSUITED, 1.0, "nothing finer is known to help"},
      {9e-3, INFINITY, 2.0, 0.1, 2e-3, NAN, 0, HOOKE_UNSUITED, 1.0, "nothing finer is known to help"},
      {NAN, INFINITY, 2.0, 0.1, 0.0, NAN, 0, HOOKE_UNSUITED, 1.0, "nothing finer is known to help"},
      {0.4, INFINITY, 2.0, 1.0, 0.0, NAN, 0, HOOKE_UNSUITED, 1.0, "would take about 16 s"},
      {0.4, INFINITY, 2.0, 0.1, 0.0, NAN, 0, HOOKE_BAD_VALUE, 1.000005, "have no step in common"},
  };
  owned_system *system = small_oscillator(OMEGA);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    owned_options *run = run_options((struct run){.method = "verlet", .step = 0.01, .duration = 1.0}),
                  *next = run_options((struct run){.duration = 1.0, .every = 0.1});
    struct hk_estimate e = estimate_with(system, cases[k].error, cases[k].agreement);
    e.options = run;
    e.duration = cases[k].duration;
    e.before = cases[k].before / WANT;
    e.order[0] = e.order[1] = cases[k].order;
    e.work = cases[k].work;
    e.refined = cases[k].refined;
    hooke_measurement measurement = {.kind = &hk_estimate_kind, .object = &e};
    check_status(hooke_unchecked_estimate_refine(&measurement, next), cases[k].status);
    if (cases[k].refusal)
      check_message(cases[k].refusal);
    else
      check_close(hooke_options_number(next, "step"), cases[k].step, 1e-12);
  }
}

/* ---- measuring ---- */

/* A run of 1 s with frames 0.1 s apart, and its estimate, which may pick it. */
static struct hk_estimate *estimate_run(hooke_measurement *estimate, hooke_options *options, int32_t picks,
                                        hooke_state *state) {
  owned_integrator *integrator;
  struct hk_estimate *e = estimate->object;
  if (picks) check_ok(hooke_estimate_pick(estimate, "verlet", options));
  check_ok(hooke_integrator_create(e->system, options, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, hooke_estimate_see, estimate));
  check_ok(hooke_estimate_begin(estimate, integrator, state));
  check_ok(hooke_integrator_run(integrator, state));
  return e;
}

static void measure_anew(hooke_measurement *estimate, hooke_state *state) {
  struct hk_estimate *e = estimate->object;
  e->error[0] = e->error[1] = e->rms = e->known_until = e->last_error = NAN;
  e->by = NULL;
  e->reason[0] = '\0';
  check_ok(hooke_measurement_run(estimate, state));
}

/* An error is said by a reference as far as that is trusted, and else by runs of the method. */
TEST(references_say_what_they_know) {
  if (!hooke_method_is_built("cvode-adams")) skip();
  static const struct {
    double agreement, fraction, picked_error;
    int64_t untrusted; /* frames of 31 */
    int32_t hurried, picked, met;
    double known_until;
    const char *reason; /* NULL: by runs of the method */
  } cases[] = {
      {1e-5, 1.0, 0.0, 0, 0, 1, 1, 1.0, ""},
      {1.0, 1.0, 0.0, 0, 0, 1, 1, 1.0, "the reference itself is known to 1 m alone"},
      {1e-5, 1.0, 0.0, 9, 1, 1, 1, 0.7, "after 0.7 s two references part"},
      {1e-5, 1.0, 0.0, 9, 1, 1, 1, 0.7, "wanted error, for want of time"},
      {1e-5, 1.0, 0.0, 9, 0, 1, 1, 0.7, "tolerance: the motion is chaotic, or rounding parts them"},
      {1e-5, 1.0, 0.0, 30, 0, 1, 1, NAN, "after 0 s two references part"},
      {1e-5, 1.0, 0.0, 0, 0, 0, 1, 1.0, ""},
      {1e-5, 1.0, 0.0, 9, 0, 0, 1, 1.0, NULL}, /* few frames of another run than the picked one */
      {1e-5, 0.5, 0.0, 0, 0, 1, 1, 1.0, NULL},
      {1e-5, 0.5, 0.5, 0, 0, 1, 1, 1.0, NULL},
      {1e-5, 0.5, 0.5, 0, 0, 1, 0, 1.0, NULL},
  };
  owned_system *system = small_oscillator(OMEGA);
  owned_options *options = run_options((struct run){.duration = 1.0, .every = 0.1});
  owned_state *state = start_state(system);
  owned_measurement *estimate;
  check_ok(estimate_of(system, 1e-2, &estimate));
  struct hk_estimate *e = estimate_run(estimate, options, 1, state);
  assert_int_equal(e->pick.reference.frames.count, 31);
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    e->pick.reference.agreement = e->pick.reference.wanted_agreement = cases[k].agreement;
    e->pick.reference.trusted = 31 - cases[k].untrusted;
    e->pick.reference.hurried = cases[k].hurried;
    e->pick.fraction = cases[k].fraction;
    e->pick.best.error = cases[k].picked_error;
    e->picked = cases[k].picked;
    e->pick.met = cases[k].met;
    measure_anew(estimate, state);
    const char *by = isnan(cases[k].known_until) ? "nothing" : cases[k].reason ? "reference" : "half-step";
    assert_string_equal(e->by ? e->by : "nothing", by);
    assert_true(cases[k].reason == NULL ? e->reason[0] == '\0' : strstr(e->reason, cases[k].reason) != NULL);
    if (e->by == NULL) continue;
    check_close(e->known_until, cases[k].known_until, 1e-12);
    check_between(e->error[0], cases[k].agreement, cases[k].agreement + 0.02 + cases[k].picked_error);
    assert_int_equal(e->error[0] == 0.5, cases[k].picked_error > 0.0 && cases[k].met);
  }
  e->soundness.unknown_limit = 1;
  measure_anew(estimate, state);
  assert_string_equal(e->reason, "the stable step of its rigid bodies is not known at all times");
  e->pick.fraction = 1.0;
  e->pick.reference.trusted = 20;
  measure_anew(estimate, state);
  assert_non_null(strstr(e->reason, "two references part")); /* which matters more */
  /* limits are looked for where the pick saw the beginning alone */
  owned_integrator *integrator = start_with(system, .method = "rk4", .step = 0.1, .duration = 1.0);
  for (int half = 0; half < 2; half++) {
    e->pick.fraction = half ? 0.5 : 1.0;
    check_ok(hooke_estimate_begin(estimate, integrator, state));
    assert_int_equal(isnan(e->soundness.step) != 0, !half);
  }
}

/* The largest error of a particle that moves from (1, 0, 0) at (0, 0.5, 0), at frames 0.1 s apart. */
static double true_error(const struct hk_estimate *e, double omega) {
  double most = 0.0;
  for (int64_t f = 0; f < e->kept.recorded; f++) {
    const double *q = e->kept.position + f * e->kept.size + 3, t = e->kept.time[f];
    most = fmax(most, hypot(q[0] - cos(omega * t), q[1] - 0.5 * sin(omega * t) / omega));
  }
  return most;
}

/* Runs that are too long for a finer one are held against coarser ones, if these show the order. */
TEST(long_runs_are_judged_by_coarser_ones) {
  static const struct {
    double omega, step, want;
    int32_t is_known;
  } cases[] = {{1.0, 0.01, NAN, 1},   {12.0, 0.025, NAN, 1},
               {24.0, 0.025, NAN, 0}, {1.0, 0.05, NAN, 0}, /* one coarser run fits the frames, */
               {1.0, 0.1, NAN, 0},                         /* and none */
               {1.0, 0.1, WANT, 1}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    owned_system *system = small_oscillator(cases[k].omega);
    owned_state *state = start_state(system);
    owned_measurement *estimate;
    owned_options *options =
        run_options((struct run){.method = "verlet", .step = cases[k].step, .duration = 1.0, .every = 0.1});
    check_ok(estimate_of(system, cases[k].want, &estimate));
    struct hk_estimate *e = estimate_run(estimate, options, 0, state);
    e->work = 100.0;
    measure_anew(estimate, state);
    assert_int_equal(!isnan(e->error[0]), cases[k].is_known);
    const double truly = true_error(e, cases[k].omega);
    if (cases[k].is_known)
      check_between(e->error[0], truly, 10.0 * truly);
    else
      assert_non_null(strstr(e->reason, "the run is too long"));
  }
}

/* Three frames of 200 periods, each far from a whole one: the step loses the motion, and twice the step has
 * none, so that no order is seen. */
TEST(a_lost_motion_has_no_error) {
  owned_system *system = small_oscillator(OMEGA);
  owned_state *state = start_state(system);
  owned_measurement *estimate;
  owned_options *options =
      run_options((struct run){.method = "symplectic-euler", .step = 0.2, .duration = 200.0, .every = 100.0});
  check_ok(estimate_of(system, NAN, &estimate));
  struct hk_estimate *e = estimate_run(estimate, options, 0, state);
  measure_anew(estimate, state);
  check_between(true_error(e, OMEGA), 1.0, 3.0);
  assert_true(isnan(e->error[0]));
  assert_non_null(strstr(e->reason, "twice the step none"));
}

/* ---- what is watched ---- */

static double watched(const hooke_measurement *estimate, int64_t row, const char *column) {
  return hooke_measurement_number(estimate, "watched", row, column);
}

/* x = cos(omega t) over two periods, of which frames see the ends of the first alone. */
TEST(what_is_watched_is_told_over_all_steps) {
  owned_system *system = small_oscillator(OMEGA), *other = small_oscillator(OMEGA);
  owned_options *asked = options_with("estimate", "watch=1.x,kinetic error=0");
  owned_measurement *estimate = NULL;
  check_ok(hooke_measurement_create("estimate", system, NULL, asked, &estimate));
  assert_int_equal(hooke_measurement_row_count(estimate, "watched"), 0);
  for (int follows = 0; follows < 3; follows++) {
    owned_run(integrator, state, system, .method = "rk4", .step = 0.01, .duration = 2.0, .every = 1.0);
    check_ok(hooke_integrator_on_frame(integrator, hooke_estimate_see, estimate));
    check_ok(hooke_estimate_begin(estimate, integrator, state));
    if (follows > 0) check_ok(hooke_estimate_follow(estimate, integrator));
    if (follows > 1) check_ok(hooke_estimate_follow(NULL, integrator));
    check_ok(hooke_integrator_run(integrator, state));
    check_ok(hooke_measurement_run(estimate, state));
    check_close(watched(estimate, 0, "value"), hooke_state_position(state)[3], 0.0);
    const char *claim = hooke_measurement_text(estimate, "claims", 0, "of");
    if (follows != 1) {
      assert_true(isnan(watched(estimate, 0, "minimum")) && isnan(watched(estimate, 1, "maximum")));
      assert_string_equal(claim, "unknown");
      continue;
    }
    assert_null(claim);
    check_between(-watched(estimate, 0, "minimum"), 1.0 - 1e-5, 1.0 + 1e-5);
    check_between(watched(estimate, 1, "maximum"), OMEGA * OMEGA - 1e-3, OMEGA * OMEGA + 1e-3); /* 2 kg */
    check_between(watched(estimate, 0, "until"), 2.0, 2.0);
    assert_true(isnan(hooke_measurement_number(estimate, "estimate", 0, "estimate")));
  }
  owned_integrator *stranger = start_with(other, .method = "rk4", .step = 0.01, .duration = 0.1);
  check_status(hooke_estimate_follow(estimate, stranger), HOOKE_BAD_VALUE);
  check_message("is not one of the system that the estimate is for");
}
