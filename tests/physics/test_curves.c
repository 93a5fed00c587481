/* Springs with curves: motions against closed forms and published energies, limits and bounds where tension
 * over length exceeds the slope, and negative stiffness. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- motions ---- */

/* A mass of 2 kg on a spring of 10 m along x, stretched by `e`. */
static hooke_system *oscillator(double e, const char *words) {
  const double place[6] = {0, 0, 0, 10.0 + e, 0, 0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = small_system(2, place, NULL, 2.0, 1);
  small_group(system, "springs", "curved", 1, ends, "rest_length=10 %s", words);
  return committed(system);
}

/* The arithmetic-geometric mean of 1 and x. */
static double mean_of(double x) {
  double a = 1.0;
  for (int k = 0; k < 8; k++) {
    const double sum = 0.5 * (a + x);
    x = sqrt(a * x);
    a = sum;
  }
  return a;
}

/* Duffing's period 4 K(k)/sqrt(w), w = (k1 + k3 A^2)/m, k^2 = k3 A^2/(2 m w), with K = pi/(2 agm(1, k')). */
TEST(a_hardening_spring_has_the_period_of_an_elliptic_integral) {
  const double pi = acos(-1.0), w = (3.0 + 5.0) / 2.0, k2 = 5.0 / (2.0 * 2.0 * w);
  const double period = 2.0 * pi / mean_of(sqrt(1.0 - k2)) / sqrt(w);
  owned_system *system = oscillator(1.0, "law=length curve.coefficients=3,0,5");
  double q[6], v[6];
  end_of_run(q, v, system, .method = "rk4", .step = period / 2000.0, .duration = period);
  check_close(q[3], 11.0, 1e-11);
  check_close(v[3], 0.0, 1e-9);
  end_of_run(q, v, system, .method = "rk4", .step = period / 2000.0, .duration = period / 4.0);
  check_close(q[3], 10.0, 1e-10);
}

/* Energies of modes 1 to 3 at t = 1000 of the alpha chain of Fermi, Pasta, Ulam and Tsingou: 32 masses, alpha
 * 0.25, mode 1 with amplitude 1 at the start, by an integration to 1e-11. */
TEST(the_chain_of_fermi_pasta_ulam_and_tsingou) {
  enum { N = 32, ALL = N + 2 };
  const double known[3] = {0.05404491, 0.01026979, 0.00432385}, pi = acos(-1.0), apart = 10.0;
  double place[3 * ALL] = {0}, q[3 * ALL], v[3 * ALL];
  int64_t ends[2 * (N + 1)];
  for (int64_t j = 0; j < ALL; j++)
    place[3 * j] = apart * (double)j + (j % (N + 1) ? sin(pi * (double)j / (N + 1)) : 0.0);
  for (int64_t j = 0; j < 2 * (N + 1); j++)
    ends[j] = (j + 1) / 2;
  owned_system *system = small_system(ALL, place, NULL, 1.0, 1);
  check_ok(hooke_system_pin(system, 1, (int64_t[]){N + 1}));
  small_group(system, "springs", "chain", N + 1, ends,
              "law=length rest_length=%.17g curve.coefficients=1,0.25,0", apart);
  check_ok(hooke_system_commit(system));
  end_of_run(q, v, system, .method = "rk4", .step = 0.05, .duration = 1000.0);
  for (int mode = 1; mode <= 3; mode++) {
    const double omega = 2.0 * sin(pi * mode / 2.0 / (N + 1));
    double a = 0.0, b = 0.0;
    for (int j = 1; j <= N; j++) {
      const double s = sqrt(2.0 / (N + 1)) * sin(pi * mode * j / (N + 1));
      a += s * (q[3 * j] - apart * j);
      b += s * v[3 * j];
    }
    check_close(0.5 * (b * b + omega * omega * a * a), known[mode - 1], 2e-8);
  }
}

/* Eight particles in space, some springs long and some short, on the same curve. */
static hooke_system *net(uint64_t seed, double damping, const char *words) {
  enum { N = 8, SPRINGS = 14 };
  struct random_source source = {seed};
  double place[3 * N];
  int64_t ends[2 * SPRINGS];
  for (int k = 0; k < 3 * N; k++)
    place[k] = random_between(&source, -1.0, 1.0);
  for (int64_t k = 0; k < SPRINGS; k++) {
    ends[2 * k] = k % N;
    ends[2 * k + 1] = (k % N + 1 + k / N * 2) % N;
  }
  hooke_system *system = small_system(N, place, NULL, 0.5, 1);
  small_group(system, "springs", "net", SPRINGS, ends, "rest_scale=0.8 damping=%.17g %s", damping, words);
  return committed(system);
}

/* In every method, in all of its ways: explicit, solved, by dampers one after the other, with error control.
 */
TEST(a_straight_curve_is_the_linear_law) {
  static const char *const pairs[][2] = {
      {"stiffness=40", "curve.strain=-0.3,0,0.1,0.6 curve.force=-12,0,4,24"},
      {"stiffness=40 compression=false", "curve.strain=0,0.1,0.6 curve.force=0,4,24 compression=false"},
      {"law=length stiffness=40", "law=length curve.coefficients=40,0,0"}};
  double q[24], v[24], other[24], ignored[24];
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    struct run run = {.method = hooke_method_name(k), .step = 1e-3, .duration = 0.1};
    if (hooke_method_is_built(run.method) != 1) continue;
    /* at a corner their steps fall apart by rounding, and the solutions by what the tolerance allows */
    if (hooke_method_is_adaptive(run.method)) run.step = 0.0, run.rtol = 1e-10;
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; p++) {
      owned_system *linear = net(p + 1, 0.1, pairs[p][0]), *curved = net(p + 1, 0.1, pairs[p][1]);
      run_to_end(linear, run, q, v);
      run_to_end(curved, run, other, ignored);
      for (int c = 0; c < 24; c++)
        check_close(other[c], q[c], is_implicit(run.method) || run.step == 0.0 ? 1e-8 : 1e-12);
    }
  }
}

/* To the parenthesis, and for any number of threads. */
TEST(forces_have_the_bits_of_the_formula) {
  const double q[6] = {0, 0, 0, 10.3, 1.1, -0.7}, v[6] = {0, 0, 0, 0.3, -1.0, 0.6};
  owned_system *system = oscillator(1.0, "law=length curve.coefficients=3,0.25,0.7 damping=0.3");
  const double dx = q[0] - q[3], dy = q[1] - q[4], dz = q[2] - q[5];
  const double r = sqrt((dx * dx + dy * dy) + dz * dz), ir = 1.0 / r, e = r - 10.0;
  const double rate = (((v[0] - v[3]) * dx + (v[1] - v[4]) * dy) + (v[2] - v[5]) * dz) * ir;
  const double s = ((0.0 + e * (3.0 + e * (0.25 + e * 0.7))) + 0.3 * rate) * ir;
  const double expected[6] = {-s * dx, -s * dy, -s * dz, s * dx, s * dy, s * dz};
  double force[6], one[24], two[24], ignored[24];
  check_ok(hooke_system_force(system, 0.0, q, v, force));
  check_same_bits(6, force, expected);
  owned_system *all = net(2, 0.1, "curve.coefficients=40,7,3");
  end_of_run(one, ignored, all, .method = "verlet", .step = 1e-3, .duration = 0.1, .threads = 1);
  end_of_run(two, ignored, all, .method = "verlet", .step = 1e-3, .duration = 0.1, .threads = 2);
  check_same_bits(24, one, two);
  char words[256];
  snprintf(words, sizeof words, "curve.strain=-0.2,-0.1,0.1,0.4 curve.force=%.17g,%.17g,%.17g,%.17g",
           -0.56 * 1.14, 4.92 * 1.14, 5.06 * 1.14, 17.98 * 1.14);
  owned_system *product = net(2, 0.1, words);
  owned_system *scaled =
      net(2, 0.1, "curve.strain=-0.2,-0.1,0.1,0.4 curve.force=-0.56,4.92,5.06,17.98 stiffness_scale=1.14");
  end_of_run(one, ignored, scaled, .method = "verlet", .step = 1e-3, .duration = 0.1);
  end_of_run(two, ignored, product, .method = "verlet", .step = 1e-3, .duration = 0.1);
  check_same_bits(24, one, two);
}

/* ---- limits ---- */

/* Tension at the rest length, and flat beyond it: tension over length is above the slope, and negative slopes
 * are left out. */
TEST(limits_are_those_of_the_linearised_curve) {
  static const char methods[] = "symplectic-euler,verlet,rk4";
  check_limits_met(net(3, 0.0, "law=length curve.coefficients=30,2,5"), methods);
  check_limits_met(net(4, 0.0, "curve.strain=-0.5,0,1,3 curve.force=10,30,31,32"), methods);
  check_limits_met(net(5, 0.0, "curve.elongation=0,0.5,1 curve.force=5,30,60 compression=false"), methods);
}

/* A body about which two springs are stiffer across than along, in which growth is scaled back. */
TEST(limits_with_a_body_are_those_of_the_linearised_curve) {
  const double place[15] = {0, 0, 0, 1, 0, 0, 1.5, 0.2, 0, 1.2, 0.6, 0.3, 2.4, 0.1, 0};
  const int64_t ends[4] = {0, 1, 2, 4}, board[3] = {1, 2, 3};
  hooke_system *system = small_system(5, place, NULL, 1.0, 1);
  check_ok(hooke_system_add_body(system, "board", 3, board, 0));
  small_group(system, "springs", "curved", 2, ends,
              "rest_scale=0.9 curve.strain=-0.5,0,0.05,1 curve.force=-200,10,90,120 damping=0.4");
  owned_system *fallen = small_falling(system);
  owned_measurement *limit = limits_of(fallen, "verlet", 0);
  const double predicted = hooke_measurement_number(limit, "rows", 0, "predicted");
  check_close(hooke_measurement_number(limit, "rows", 0, "measured"), predicted, 1e-3 * predicted);
}

/* m omega^2 = F/l along both directions across a spring of 12 m under 36 N, and its slope of 2 N/m along. */
TEST(a_spring_under_tension_swings_across_faster_than_along) {
  owned_system *system = oscillator(2.0, "curve.elongation=0,2,4 curve.force=32,36,40");
  owned_measurement *limit = limits_of(system, "verlet", 1);
  check_close(hooke_measurement_number(limit, "rows", 0, "predicted"), 2.0 / sqrt(3.0 / 2.0), 1e-4);
}

/* It holds at any length, far beyond the states of the start. */
TEST(the_bound_is_that_of_the_steepest_part) {
  owned_system *system = oscillator(0.1, "curve.elongation=-2,-1,0,1,2 curve.force=-101,-1,0,1,101");
  const double bound = bound_at_start(system, "verlet");
  /* the slope at 2 m, by three points, is 1.5 times 100 less half of 1 */
  check_close(bound, 2.0 / sqrt(149.5 / 2.0), 1e-12);
  owned_run(run, state, system, .method = "verlet", .step = 0.5 * bound, .duration = 500.0 * bound);
  hooke_state_velocity(state)[3] = 40.0;
  check_ok(hooke_integrator_run(run, state));
}

static const char *claim_of(const hooke_measurement *of, const char *key) {
  const int64_t row = hooke_measurement_find(of, "claims", "key", key);
  return row < 0 ? "" : hooke_measurement_text(of, "claims", row, "text");
}

TEST(coefficients_have_no_largest_stiffness) {
  owned_system *system = oscillator(0.1, "law=length curve.coefficients=3,0,5 damping=0.1");
  owned_measurement *limit = limits_of(system, "verlet", 1);
  assert_non_null(strstr(claim_of(limit, "curves"), "has no largest stiffness: 1;"));
  owned_options *options =
      run_options((struct run){.method = "verlet", .step = 1e-3, .verlet_damping = "explicit"});
  hooke_integrator *run = NULL;
  check_ok(hooke_integrator_create(system, options, &run));
  hooke_integrator_destroy(run);
  owned_system *table = oscillator(0.1, "curve.elongation=-1,0,1 curve.force=-3,0,8 damping=0.1");
  check_ok(hooke_integrator_create(table, options, &run));
  hooke_integrator_destroy(run);
}

/* ---- negative stiffness ---- */

static const char well[] = "curve.elongation=-1,-0.5,0,0.5,1 curve.force=-9,4,0,-4,9 curve.falling=true",
                  falling[] =
                      "curve.elongation=-1,-0.5,0,0.5,1 curve.force=-9,4,0,-4,9 curve.falling=true damping=2";

/* From the top between two wells it falls into one, in which all methods come to rest: at 0.5 and more by the
 * root of 70 x^2 - 36 x^3 = 4, the cubic there. */
TEST(a_curve_that_falls_is_solved_and_named) {
  owned_system *system = oscillator(0.01, falling);
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    struct run run = {.method = hooke_method_name(k), .step = 0.005, .duration = 30.0};
    double q[6], v[6];
    if (hooke_method_is_built(run.method) != 1) continue;
    if (hooke_method_is_adaptive(run.method)) run.step = 0.0;
    run_to_end(system, run, q, v);
    check_close(fabs(q[3] - 10.0), 0.5 + 0.2565717917, 1e-5);
    check_close(v[3], 0.0, 1e-5);
  }
  owned_measurement *limit = limits_of(system, "verlet", 1);
  assert_non_null(strstr(claim_of(limit, "falling"),
                         "a curve that falls: 1, and there now: 1; that is negative stiffness"));
}

/* Near its bottom, where the energy is below 0 and rounding is all that changes it. */
TEST(a_scene_that_begins_in_a_well_goes_on) {
  owned_system *system = oscillator(0.7565717916655548 + 1e-9, well);
  const double place[6] = {0, 0, 0, 10.7, 0, 0};
  assert_true(hooke_system_energy(system, "potential", place, NULL) < -1.0);
  double q[6], v[6];
  end_of_run(q, v, system, .method = "verlet", .step = 0.1, .duration = 100.0, .every = 0.1);
  check_close(q[3], 10.7565717916655548, 1e-8);
}

#if HOOKE_HAVE_LAPACK
/* Beyond the last sample the line falls for ever, and so does the mass. */
TEST(what_a_falling_line_pushes_away_is_explained) {
  owned_system *system =
      oscillator(0.01, "curve.elongation=0,1,2 curve.force=0,-400,-800 curve.falling=true");
  owned_run(run, state, system, .method = "verlet", .step = 0.5, .duration = 1000.0);
  check_status(hooke_integrator_run(run, state), HOOKE_DIVERGED);
  owned_measurement *why = NULL;
  check_ok(explain_run(run, &why));
  assert_non_null(strstr(claim_of(why, "course"), "negative stiffness"));
}
#endif

/* ---- in overdamped scenes, and what is watched ---- */

/* c x' = -k3 x^3 from 1: x = 1/sqrt(1 + 2 k3 t/c). */
TEST(an_overdamped_cube_decays_by_its_power) {
  const double place[6] = {0, 0, 0, 11, 0, 0};
  const int64_t ends[2] = {0, 1};
  owned_system *system = small_system(2, place, NULL, 2.0, 1);
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, 0.5));
  small_group(system, "springs", "cube", 1, ends, "law=length rest_length=10 curve.coefficients=0,0,3");
  check_ok(hooke_system_commit(system));
  double q[6], v[6];
  end_of_run(q, v, system, .method = "rk4", .step = 1e-3, .duration = 2.0);
  check_close(q[3], 10.0 + 1.0 / sqrt(1.0 + 2.0 * 3.0 * 2.0 / 0.5), 1e-10);
}
