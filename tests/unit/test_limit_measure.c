/* Measured limits compared with formulas; and their limiting elements. */
#include "measure/trial/bracket.h"
#include "measure/spectrum/linear_twin.h"
#include "measure/limit/limit_participation.h"
#include "measure/limit/limit_measure.h"

#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* ---- small scenes ---- */

/* Unit masses on springs of 1 m to pins, apart from each other: mode k is the motion of mass k along its
 * spring. */
static hooke_system *oscillators(int64_t count, const double *stiffness, const double *damping, double far) {
  const double mass = 1.0;
  hooke_system *system = new_system();
  owned_options *options = new_options("springs");
  for (int64_t k = 0; k < count; k++) {
    const double origin[6] = {far, (double)k, 0.0, far + 1.0, (double)k, 0.0};
    const int64_t pinned = 2 * k;
    check_ok(hooke_system_add_particles(system, 2, origin, NULL, 1, &mass, NULL));
    check_ok(hooke_system_pin(system, 1, &pinned));
  }
  for (int64_t k = 0; k < count; k++) {
    const int64_t ends[2] = {2 * k, 2 * k + 1};
    check_ok(hooke_options_set_text(options, "law", "length"));
    check_ok(hooke_options_set_number(options, "stiffness", stiffness[k]));
    check_ok(hooke_options_set_number(options, "damping", damping[k]));
    check_ok(hooke_system_add_springs(system, k == 0 ? "first" : "other", 1, ends, options));
  }
  return committed(system);
}

static int32_t measure_within(const hooke_system *system, const char *method, double predicted, double *mode,
                              double accuracy, struct hk_budget *budget, struct hk_measured_limit *out) {
  const struct hk_limit limit = {.system = system};
  const struct hk_limit_row row = {.method = method, .has_mode = mode != NULL, .mode = mode};
  return hk_limit_measure(&limit, &row, system->position, NULL, predicted, accuracy, budget, out);
}

static struct hk_measured_limit measure(const hooke_system *system, const char *method, double predicted,
                                        double *mode, double accuracy) {
  struct hk_measured_limit out;
  struct hk_budget budget = hk_budget_of(100.0, NULL, NULL);
  check_ok(measure_within(system, method, predicted, mode, accuracy, &budget, &out));
  return out;
}

/* ---- one oscillator ---- */

static double forward_euler(double zeta) {
  return zeta <= 1.0 ? 2.0 * zeta : 2.0 / (zeta + sqrt(zeta * zeta - 1.0));
}

static double symplectic_euler(double zeta) {
  return 2.0 * (sqrt(1.0 + zeta * zeta) - zeta);
}

TEST(one_oscillator) {
  const double zeta[] = {0.1, 0.5, 1.0, 5.0}, omega = 30.0;
  const double rk4[] = {2.95085, 2.62254, 2.78529, 0.28137}; /* |R(h lambda)| = 1 */
  for (int k = 0; k < 4; k++) {
    const double stiffness = omega * omega, damping = 2.0 * zeta[k] * omega;
    owned_system *system = oscillators(1, &stiffness, &damping, 0.0);
    const struct {
      const char *method;
      double limit;
    } rows[] = {{"forward-euler", forward_euler(zeta[k])},
                {"symplectic-euler", symplectic_euler(zeta[k])},
                {"verlet", 2.0},
                {"rk4", rk4[k]}};
    for (int m = 0; m < 4; m++) {
      /* from no prediction, and from very wrong ones */
      const double guess[] = {NAN, 1.3 * rows[m].limit / omega, rows[m].limit / omega / 1.3};
      for (int g = 0; g < 3; g++) {
        const struct hk_measured_limit out = measure(system, rows[m].method, guess[g], NULL, 2e-3);
        check_close(out.step * omega, rows[m].limit, 2e-3 * rows[m].limit);
        check_between((double)out.steps_run, 100.0, 1e7);
        assert_int_equal(out.never_stable, 0);
      }
    }
  }
}

TEST(undamped_oscillator) {
  const double stiffness = 49.0, damping = 0.0;
  owned_system *system = oscillators(1, &stiffness, &damping, 0.0);
  check_close(measure(system, "symplectic-euler", NAN, NULL, 1e-4).step, 2.0 / 7.0, 1e-4);
  check_close(measure(system, "verlet", 0.3, NULL, 1e-4).step, 2.0 / 7.0, 1e-4);
  check_close(measure(system, "rk4", 0.4, NULL, 1e-4).step, 2.0 * sqrt(2.0) / 7.0, 1e-4);
  const struct hk_measured_limit never = measure(system, "forward-euler", 0.0, NULL, 1e-3);
  assert_true(never.step == 0.0 && never.never_stable);
  const struct hk_measured_limit always = measure(system, "backward-euler", INFINITY, NULL, 1e-3);
  assert_true(isinf(always.step) && !always.never_stable);
  const char *const second[] = {"tr-bdf2", "implicit-midpoint"};
  for (int k = 0; k < 2; k++) {
    const struct hk_measured_limit none = measure(system, second[k], INFINITY, NULL, 1e-3);
    assert_true(isinf(none.step) && !none.never_stable);
  }
  /* predictions of no step and of every step are put to the test */
  check_close(measure(system, "symplectic-euler", 0.0, NULL, 1e-3).step, 2.0 / 7.0, 1e-3);
  check_close(measure(system, "symplectic-euler", INFINITY, NULL, 1e-3).step, 2.0 / 7.0, 1e-3);
}

TEST(far_from_the_origin) {
  const double stiffness = 49.0, damping = 1.0, far = 1048576.0;
  owned_system *system = oscillators(1, &stiffness, &damping, far);
  const double zeta = 1.0 / 14.0;
  check_close(measure(system, "symplectic-euler", NAN, NULL, 1e-3).step, symplectic_euler(zeta) / 7.0,
              1e-3 / 7.0);
}

/* ---- a mode that was not predicted ---- */

TEST(hidden_mode_is_found) {
  const double stiffness[2] = {49.0, 64.0}, damping[2] = {0.0, 0.0};
  owned_system *system = oscillators(2, stiffness, damping, 0.0);
  double mode[12] = {0.0};
  mode[3] = 1.0;
  const char *const methods[] = {"symplectic-euler", "verlet", "rk4"};
  for (int m = 0; m < 3; m++) {
    /* the prediction of the slower mode alone, started in it */
    owned_system *slow = oscillators(1, stiffness, damping, 0.0);
    owned_system *fast = oscillators(1, stiffness + 1, damping, 0.0);
    const double wrong = measure(slow, methods[m], NAN, NULL, 1e-3).step;
    const double right = measure(fast, methods[m], NAN, NULL, 1e-3).step;
    check_between(wrong / right, 1.1, 1.2);
    check_close(measure(system, methods[m], wrong, mode, 1e-3).step, right, 2e-3 * right);
  }
}

/* ---- the linear twin ---- */

/* Springs between the same ends, in any order and among others, are one spring in the twin, of the same
 * force. */
TEST(parallel_springs_are_one) {
  enum { MANY = 6 };
  const double origin[9] = {0, 0, 0, 1, 0.25, 0, 0.5, 1, 0}, still[9] = {0.0},
               dq[9] = {0, 0, 0, 0.3, -0.2, 0.5, 0.1, 0.4, -0.3};
  const int64_t ends[2 * MANY] = {0, 1, 1, 2, 1, 0, 0, 1, 2, 1, 0, 1}, none = 0;
  const double stiffness[MANY] = {20, 3, 0.5, 7, 11, 0}, damping[MANY] = {0, 0.1, 0.3, 0, 0, 0.2},
               rest[MANY] = {0.7, 0.5, 0.2, 1.5, 0.4, 1};
  owned_system *system = small_system(3, origin, NULL, 0.5, 0);
  owned(hk_twin_release) struct hk_twin twin;
  double product[9], of_twin[9], energy = 0.0, there[9];
  check_ok(hooke_system_pin(system, 1, &none));
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", MANY, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", MANY, damping));
  check_ok(hooke_options_set_numbers(options, "rest_length", MANY, rest));
  check_ok(hooke_system_add_springs(system, NULL, MANY, ends, options));
  check_ok(hooke_system_commit(system));
  check_ok(hk_twin_create(system, origin, NULL, &twin));
  assert_int_equal(hooke_system_count(twin.system, "springs"), 2);
  /* one of them is compressed, so that it has no stiffness across: its share is left out */
  check_ok(hooke_system_derivative_product(twin.system, 0.0, twin.origin, still, dq, dq, of_twin));
  check_ok(hooke_system_derivative_product(system, 0.0, origin, still, dq, dq, product));
  const double r = hypot(1.0, 0.25), u[3] = {1.0 / r, 0.25 / r, 0.0}, across = 7.0 * (1.0 - 1.5 / r);
  const double along = u[0] * dq[3] + u[1] * dq[4];
  for (int a = 0; a < 3; a++) {
    check_close(of_twin[3 + a], product[3 + a] + across * (dq[3 + a] - along * u[a]), 1e-7);
    check_close(of_twin[6 + a], product[6 + a], 1e-7);
  }
  check_ok(hooke_system_derivative_product(twin.system, 0.0, twin.origin, still, dq, still, of_twin));
  for (int k = 0; k < 9; k++) {
    energy -= dq[k] * of_twin[k];
    there[k] = twin.origin[k] + dq[k];
  }
  check_close(hk_twin_energy(&twin, there, still), energy, 1e-6 * energy);
}

TEST(frozen_system_rests) {
  /* a triangle under tension and compression, hung at its first corner, with a driven and a coincident
   * particle */
  const double position[15] = {0, 0, 0, 1, 0, 0, 0.3, 0.8, 0, 2, 0.1, 0.2, 2, 0.1, 0.2};
  const int64_t ends[10] = {0, 1, 1, 2, 2, 0, 1, 3, 3, 4}, pinned = 0, driven = 3;
  const double rest[5] = {0.7, 1.5, 0.6, 0.9, 0.5}, amplitude[3] = {0, 0.1, 0}, mass = 0.5;
  owned_system *system = small_system(5, position, NULL, mass, 0);
  check_ok(hooke_system_pin(system, 1, &pinned));
  check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 1.0, 0.0));
  owned_options *options = options_with("springs", "law=length stiffness=20");
  check_ok(hooke_options_set_numbers(options, "rest_length", 5, rest));
  check_ok(hooke_system_add_springs(system, NULL, 5, ends, options));
  check_ok(hooke_system_commit(system));

  owned(hk_twin_release) struct hk_twin twin;
  check_ok(hk_twin_create(system, position, NULL, &twin));
  assert_int_equal(twin.lin.clamped, 1);
  assert_int_equal(twin.lin.damped, 0);
  assert_int_equal(hooke_system_count(twin.system, "free"), 3);
  const double still[15] = {0.0};
  double force[15], moved[15], product[15], dq[15];
  check_ok(hooke_system_force(twin.system, 0.0, twin.origin, still, force));
  for (int k = 0; k < 15; k++)
    check_between(force[k], 0.0, 0.0);
  /* its derivative is that of the scene, except that the compressed spring has no stiffness across */
  for (int k = 0; k < 15; k++)
    dq[k] = k < 3 || (k >= 9 && k < 12) ? 0.0 : sin(1.0 + k);
  check_ok(hooke_system_derivative_product(twin.system, 0.0, twin.origin, still, dq, still, product));
  check_ok(hooke_system_derivative_product(system, 0.0, position, still, dq, still, moved));
  for (int a = 12; a < 15; a++) { /* the coincident one has no force, and is stiff in all directions */
    check_between(moved[a], 0.0, 0.0);
    check_close(product[a], -20.0 * dq[a], 1e-7);
  }
  const double u[3] = {0.7 / sqrt(1.13), -0.8 / sqrt(1.13), 0.0}, across = 20.0 * (1.0 - 1.5 / sqrt(1.13));
  const double d[3] = {dq[3] - dq[6], dq[4] - dq[7], dq[5] - dq[8]};
  const double along = u[0] * d[0] + u[1] * d[1];
  for (int a = 0; a < 3; a++) {
    const double clamped = -across * (d[a] - along * u[a]); /* share that particle 1 loses */
    check_close(product[3 + a], moved[3 + a] - clamped, 1e-7);
    check_close(product[6 + a], moved[6 + a] + clamped, 1e-7);
  }
  /* the energy of a displacement is its product with the force */
  double there[15], energy = 0.0;
  for (int k = 0; k < 15; k++) {
    there[k] = twin.origin[k] + dq[k];
    energy -= dq[k] * product[k];
  }
  check_close(hk_twin_energy(&twin, there, still), energy, 1e-5 * energy);

  const struct hk_measured_limit out = measure(system, "verlet", NAN, NULL, 1e-3);
  check_between(out.step, 0.1, 1.0);
  assert_string_equal(out.note, "");
}

/* Drag alone: x'' = -c/m x'. */
TEST(drag_alone) {
  const double origin[3] = {3.0, 0.0, 0.0};
  owned_system *system = small_system(1, origin, NULL, 2.0, 0);
  check_ok(hooke_system_set_drag(system, 5.0));
  check_ok(hooke_system_commit(system));
  check_close(measure(system, "symplectic-euler", 0.8, NULL, 1e-3).step, 0.8, 1e-3);
  check_close(measure(system, "forward-euler", NAN, NULL, 1e-3).step, 0.8, 1e-3);
  assert_true(isinf(measure(system, "verlet", INFINITY, NULL, 1e-3).step));
  owned_system *nothing = committed(small_system(1, origin, NULL, 2.0, 0));
  assert_true(isinf(measure(nothing, "symplectic-euler", NAN, NULL, 1e-3).step));
}

static int32_t refuse(double done, const char *what, void *ctx) {
  (void)done;
  (void)what;
  (void)ctx;
  return 1;
}

TEST(what_is_refused) {
  const double stiffness = 49.0, damping = 1.0;
  owned_system *system = oscillators(1, &stiffness, &damping, 0.0);
  struct hk_measured_limit out;
  struct hk_budget stops = hk_budget_of(1.0, refuse, NULL), none = hk_budget_of(0.0, NULL, NULL);
  check_status(measure_within(system, "no-such", 1.0, NULL, 1e-3, &none, &out), HOOKE_BAD_VALUE);
  check_status(measure_within(system, "verlet", 1.0, NULL, 1e-3, &stops, &out), HOOKE_STOPPED);
  check_message("asked to stop while a limit was measured");
  check_ok(measure_within(system, "verlet", 1.0, NULL, 1e-3, &none, &out));
  assert_true(isnan(out.step));
  assert_non_null(strstr(out.note, "budget"));
}

/* Damped along a motion that has no direction yet: stiff and damped in all directions, which explicit damping
 * of symplectic Euler shows. */
TEST(damping_of_a_spring_of_no_length) {
  const double origin[6] = {0.0};
  const int64_t ends[2] = {0, 1};
  owned_system *system = small_system(2, origin, NULL, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = 49.0, .damping = 3.0);
  check_ok(hooke_system_commit(system));
  check_close(measure(system, "verlet", NAN, NULL, 1e-3).step, 2.0 / 7.0, 1e-3 * 2.0 / 7.0);
  const double explicit = 4.0 / (3.0 + sqrt(9.0 + 4.0 * 49.0));
  check_close(measure(system, "symplectic-euler", NAN, NULL, 1e-3).step, explicit, 1e-3 * explicit);
}

/* ---- the scene itself ---- */

/* A force on all particles that is zero until `from` and NaN from then on, or a stop. */
struct spoiler {
  double from;
  int32_t stops;
};

static int32_t spoil(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const struct spoiler *spoiler = ctx;
  (void)n, (void)q, (void)v;
  if (t < spoiler->from) return 0;
  force[3] = NAN;
  return spoiler->stops;
}

/* About 200 steps at the limit, or enough for clock readings in between. */
static const double OMEGA = 10.0, BRIEF = 40.0, LONG = 12000.0;

static int32_t measure_scene(const hooke_system *system, const char *method, double duration,
                             double predicted, double seconds, hooke_progress *progress,
                             struct hk_measured_limit *out) {
  struct hk_budget budget = hk_budget_of(seconds, progress, NULL);
  owned_options *run = new_options("run");
  if (duration > 0.0) check_ok(hooke_options_set_number(run, "duration", duration));
  check_ok(hooke_options_set_number(run, "every", 1.0)); /* which allows few steps, and is not used here */
  owned_state *start = start_state(system);
  const int32_t status =
      hk_limit_measure_nonlinear(system, start, run, method, predicted, 1e-2, &budget, out);
  check_close(hooke_options_number(run, "every"), 1.0, 0.0);
  return status;
}

TEST(the_scene_itself) {
  owned_system *system = small_oscillator(OMEGA);
  struct hk_measured_limit out;
  /* with a = h omega energy swells by up to (1 + a/2)/(1 - a/2), which is 100 at a = 1.9604 */
  const double guess[] = {NAN, 0.0, INFINITY, 0.1, 0.3};
  for (int k = 0; k < 5; k++) {
    check_ok(measure_scene(system, "symplectic-euler", BRIEF, guess[k], 100.0, NULL, &out));
    check_between(out.step * OMEGA, 0.99 * 1.9604, 1.01 * 2.0);
    assert_string_equal(out.note, "");
    check_between((double)out.steps_run, 200.0, 1e5);
  }
  check_ok(measure_scene(system, "symplectic-euler", 0.01, 0.2, 100.0, NULL, &out));
  assert_true(isinf(out.step));
  assert_non_null(strstr(out.note, "single step"));
}

static hooke_system *spoiled_oscillator(struct spoiler *spoiler) {
  const double origin[6] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = small_system(2, origin, NULL, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = OMEGA * OMEGA);
  check_ok(hooke_system_set_force(system, spoil, NULL, spoiler));
  return committed(system);
}

TEST(scenes_that_no_step_helps) {
  struct hk_measured_limit out;
  struct spoiler not_a_number = {0.5, 0}, stop = {0.5, 1};
  owned_system *diverges = spoiled_oscillator(&not_a_number), *stops = spoiled_oscillator(&stop);
  check_ok(measure_scene(diverges, "verlet", 1.0, 0.2, 100.0, NULL, &out));
  assert_true(out.step == 0.0 && out.never_stable);
  assert_non_null(strstr(out.note, "diverged at every step"));
  check_status(measure_scene(stops, "verlet", 1.0, 0.2, 100.0, NULL, &out), HOOKE_STOPPED);
}

TEST(scenes_that_take_too_long) {
  owned_system *system = small_oscillator(OMEGA);
  struct hk_measured_limit out;
  check_ok(measure_scene(system, "verlet", LONG, 0.19, 0.0, NULL, &out));
  assert_true(isnan(out.step));
  assert_non_null(strstr(out.note, "budget"));
  check_between((double)out.steps_run, 1.0, 0.9 * LONG / 0.19); /* it did not wait for the end */
  check_status(measure_scene(system, "verlet", LONG, 0.19, 100.0, refuse, &out), HOOKE_STOPPED);
  check_message("asked to stop while a limit was measured");
  check_status(measure_scene(system, "verlet", 0.0, 0.19, 100.0, NULL, &out), HOOKE_BAD_VALUE);
  check_message("duration");
  check_status(measure_scene(system, "no-such", 1.0, 0.19, 100.0, NULL, &out), HOOKE_BAD_VALUE);
  owned_state *start = start_state(system);
  struct hk_budget budget = hk_budget_of(100.0, NULL, NULL);
  check_status(hk_limit_measure_nonlinear(system, start, NULL, "verlet", 0.19, 1e-2, &budget, &out),
               HOOKE_BAD_VALUE);
  check_message("give the time to run");
}

/* ---- the bracket ---- */

struct edge {
  double at;
  int tries;
};

static int32_t try_edge(void *ctx, double step, enum hk_trial_end *end) {
  struct edge *edge = ctx;
  edge->tries++;
  *end = step < edge->at ? HOOKE_TRIAL_HOLDS : HOOKE_TRIAL_FAILS;
  return HOOKE_OK;
}

TEST(bracket_closes_from_both_sides) {
  const double edges[] = {1e-5, 0.37, 0.9995, 1.0, 1.0005, 1.4, 2e4};
  for (int k = 0; k < 7; k++) {
    struct edge edge = {edges[k], 0};
    struct hk_bracket bracket = {
        .try_step = try_edge, .ctx = &edge, .accuracy = 1e-3, .least = 1e-9, .most = 1e9, .fails = INFINITY};
    check_ok(hk_bracket_search(&bracket, 1.0));
    check_between(bracket.holds, 0.999 * edge.at, edge.at);
    check_between(bracket.fails, edge.at, 1.001 * edge.at);
    check_between(edge.tries, 3, 40);
  }
  struct edge never = {0.0, 0}, always = {INFINITY, 0};
  struct hk_bracket low = {
      .try_step = try_edge, .ctx = &never, .accuracy = 1e-3, .least = 1e-6, .most = 1e6, .fails = INFINITY};
  check_ok(hk_bracket_search(&low, 1.0));
  assert_true(low.holds == 0.0 && low.fails < 1e-3);
  struct hk_bracket high = low;
  high.ctx = &always, high.fails = INFINITY, high.holds = 0.0;
  check_ok(hk_bracket_search(&high, 1.0));
  assert_true(isinf(high.fails) && high.holds > 1e3);
}

/* ---- limiting springs ---- */

/* Two oscillators and a mode in which both move: shares by hand. */
TEST(shares_are_those_of_the_mode) {
  const double stiffness[2] = {100.0, 400.0}, damping[2] = {3.0, 1.0};
  owned_system *system = oscillators(2, stiffness, damping, 0.0);
  double mode[12] = {0.0};
  mode[3] = 1.0, mode[9] = 0.5, mode[0] = 7.0; /* the last one is pinned */
  struct hk_participation participation;
  const double h = 0.1, parts[2] = {h * h * 100.0 + 2.0 * h * 3.0, 0.25 * (h * h * 400.0 + 2.0 * h)};
  check_ok(hk_participation_find(system, system->position, NULL, mode, h * h, h, &participation));
  assert_int_equal(participation.spring_count, 2);
  assert_int_equal(participation.spring[0].spring, 0);
  assert_int_equal(participation.spring[0].second, 1);
  check_close(participation.spring[0].share, parts[0] / (parts[0] + parts[1]), 1e-14);
  check_close(participation.spring[1].share, parts[1] / (parts[0] + parts[1]), 1e-14);
  check_close(participation.stiffness_share, h * h * 200.0 / (parts[0] + parts[1]), 1e-14);
  check_close(participation.group_share[0] + participation.group_share[1], 1.0, 1e-14);
  assert_int_equal(participation.particle_count, 2);
  assert_int_equal(participation.particle[0].particle, 1);
  check_close(participation.particle[0].share, 0.8, 1e-14);
  hk_participation_release(&participation);
  check_ok(hk_participation_find(system, system->position, NULL, NULL, 1.0, 0.0, &participation));
  assert_int_equal(participation.spring_count + participation.particle_count, 0);
  hk_participation_release(&participation);
}

TEST(most_shares_are_kept_in_order) {
  enum { COUNT = 150 };
  double stiffness[COUNT], damping[COUNT], mode[6 * COUNT];
  for (int k = 0; k < COUNT; k++) {
    stiffness[k] = 1.0 + (double)((k * 67) % COUNT);
    damping[k] = 0.0;
    memcpy(mode + 6 * k, (const double[6]){0, 0, 0, 1, 0, 0}, 6 * sizeof(double));
  }
  owned_system *system = oscillators(COUNT, stiffness, damping, 0.0);
  owned(hk_participation_release) struct hk_participation participation;
  check_ok(hk_participation_find(system, system->position, NULL, mode, 1.0, 0.0, &participation));
  assert_int_equal(participation.spring_count, HOOKE_MOST_LIMITING);
  for (int k = 0; k < HOOKE_MOST_LIMITING; k++) {
    check_close(participation.spring[k].share, (double)(COUNT - k) / (0.5 * COUNT * (COUNT + 1)), 1e-14);
    check_close(stiffness[participation.spring[k].spring], (double)(COUNT - k), 0.0);
    assert_int_equal(participation.particle[k].particle, 2 * k + 1); /* equal shares: in their order */
  }
}

TEST(remedy_is_what_it_costs) {
  /* one of twelve is 100 times stiffer: alone it costs a factor 10 */
  enum { COUNT = 12 };
  double stiffness[COUNT], damping[COUNT] = {0.0}, mode[6 * COUNT] = {0.0};
  for (int k = 0; k < COUNT; k++)
    stiffness[k] = k == 5 ? 4900.0 : 49.0;
  mode[6 * 5 + 3] = 1.0;
  owned_system *system = oscillators(COUNT, stiffness, damping, 0.0);
  owned(hk_participation_release) struct hk_participation participation;
  struct hk_suggestion suggestion;
  check_ok(hk_participation_find(system, system->position, NULL, mode, 1.0, 0.0, &participation));
  const int32_t status = hk_suggestion_find(system, system->position, "symplectic-euler", 2.0 / 70.0,
                                            &participation, &suggestion);
  if (status == HOOKE_NOT_BUILT) skip();
  check_status(status, HOOKE_OK);
  assert_string_equal(suggestion.kind, "soften");
  assert_int_equal(suggestion.count, 1);
  check_close(suggestion.cost, 10.0, 0.02);
  check_close(suggestion.factor, 100.0, 1e-9);
  check_close(suggestion.gain, 10.0, 0.02);
  check_close(suggestion.gain_predicted, 10.0, 1e-9);
  assert_string_equal(suggestion.sentence,
                      "1 of 12 springs, number 5, group `other`, costs a factor 10 in step; softening it by "
                      "100 allows a step 10 times larger");
}

TEST(no_remedy_where_all_are_alike) {
  enum { COUNT = 12 };
  double stiffness[COUNT], damping[COUNT] = {0.0}, mode[6 * COUNT] = {0.0};
  for (int k = 0; k < COUNT; k++)
    stiffness[k] = 49.0;
  mode[6 * 5 + 3] = 1.0;
  owned_system *system = oscillators(COUNT, stiffness, damping, 0.0);
  owned(hk_participation_release) struct hk_participation participation;
  struct hk_suggestion suggestion;
  /* one spring has the whole mode, but without it the next one limits the step as much */
  check_ok(hk_participation_find(system, system->position, NULL, mode, 1.0, 0.0, &participation));
  const int32_t status =
      hk_suggestion_find(system, system->position, "verlet", 2.0 / 7.0, &participation, &suggestion);
  if (status == HOOKE_NOT_BUILT) skip();
  check_status(status, HOOKE_OK);
  assert_null(suggestion.kind);
  assert_true(isnan(suggestion.gain) && suggestion.count == 0);
  assert_non_null(strstr(suggestion.sentence, "group `other` has 100 %"));
}
