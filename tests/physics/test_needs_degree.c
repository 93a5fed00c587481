/* How soft a stiff spring may be, and the lean scene with it. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* Largest change of a particle of the chain when its stiff spring is so many times softer, by
 * Gragg-Bulirsch-Stoer extrapolation in long double, to 1e-11. */
static const struct {
  double times, change;
} softer[] = {
    {10, 0.000408118}, {100, 0.004478302}, {200, 0.008974782}, {220, 0.009870465}, {300, 0.013440078}};
static const double WANT = 0.01;

/* As examples/scenes/stiff-spring.json. */
static hooke_system *chain_of(double stiffness) {
  double position[24] = {0};
  int64_t soft[] = {0, 1, 1, 2, 2, 3, 4, 5, 5, 6, 6, 7};
  for (int k = 0; k < 8; k++)
    position[3 * k] = k;
  hooke_system *system = small_system(8, position, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, 2, (int64_t[]){0, 7}));
  small_group(system, "springs", "soft", 6, soft, "stiffness=%.17g damping=0.5 rest_scale=0.9", stiffness);
  small_group(system, "springs", "stiff", 1, (int64_t[]){3, 4}, "stiffness=1e6 damping=10");
  return small_falling(system);
}

static hooke_system *chain(void) {
  return chain_of(100.0);
}

static hooke_measurement *needs_of(const hooke_system *system, const char *keep) {
  owned_options *options = options_with("needs", "want=%.17g", WANT),
                *run = run_options((struct run){.method = "verlet", .duration = 5.0, .every = 0.05});
  hooke_measurement *needs;
  if (keep) check_ok(hooke_options_set_text(options, "keep", keep));
  check_ok(hooke_measurement_create("needs", system, run, options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  return needs;
}

static int64_t degree_of(const hooke_measurement *needs, const char *quantity) {
  int64_t row = 0;
  while (row < hooke_measurement_row_count(needs, "degrees") &&
         strcmp(hooke_measurement_text(needs, "degrees", row, "quantity"), quantity) != 0)
    row++;
  return row;
}

static double change_at(double times) {
  int k = 1;
  while (k < 4 && softer[k].times < times)
    k++;
  const double slope = (softer[k].change - softer[k - 1].change) / (softer[k].times - softer[k - 1].times);
  return softer[k].change + slope * (times - softer[k].times);
}

TEST(a_stiff_spring_may_be_as_soft_as_an_independent_run_says_and_the_lean_scene_is_softened) {
  owned_system *system = chain();
  owned_measurement *needs = needs_of(system, NULL);
  const int64_t row = degree_of(needs, "stiff.stiffness");
  const double times = 1.0 / hooke_measurement_number(needs, "degrees", row, "factor"),
               beyond = 1.0 / hooke_measurement_number(needs, "degrees", row, "beyond"),
               limit = hooke_measurement_number(needs, "degrees", row, "step_limit");
  check_between(times, 180.0, 224.0);
  check_between(beyond, 223.0, 1.2 * times);
  check_close(hooke_measurement_number(needs, "degrees", row, "error"), change_at(times), 0.01 * WANT);
  check_close(hooke_measurement_number(needs, "degrees", row, "error_beyond"), change_at(beyond),
              0.01 * WANT);
  check_close(limit / hooke_measurement_number(needs, "full", 0, "step_limit"), sqrt(times),
              0.02 * sqrt(times));
  check_close(hooke_measurement_number(needs, "degrees", degree_of(needs, "soft.stiffness"), "factor"), 1.0,
              0.0);

  /* the lean scene, softened by the mode that limits it */
#if HOOKE_HAVE_LAPACK
  assert_int_equal(hooke_measurement_row_count(needs, "changed"), 1);
  assert_string_equal(hooke_measurement_text(needs, "changed", 0, "quantity"), "stiff.stiffness");
  check_between(hooke_measurement_number(needs, "changed", 0, "factor"), 1.0 / 224.0, 0.1);
  check_between(hooke_measurement_number(needs, "lean", 0, "error"), 1e-4, WANT);
  check_between(hooke_measurement_number(needs, "lean", 0, "steps"), 100.0,
                0.3 * hooke_measurement_number(needs, "cheapest", 0, "steps"));
#endif
}

/* The same springs in one group. */
TEST(a_stiff_spring_among_soft_ones_of_its_group_has_a_row_of_its_own) {
  double position[24] = {0};
  int64_t ends[14];
  for (int k = 0; k < 14; k++) {
    ends[k] = (k + 1) / 2;
    position[3 * ((k + 1) / 2)] = (k + 1) / 2;
  }
  hooke_system *made = small_system(8, position, NULL, 1.0, 0);
  check_ok(hooke_system_pin(made, 2, (int64_t[]){0, 7}));
  small_group(made, "springs", "all", 7, ends,
              "stiffness=100,100,100,1e6,100,100,100 damping=0.5,0.5,0.5,10,0.5,0.5,0.5 "
              "rest_length=0.9,0.9,0.9,1,0.9,0.9,0.9 law=%s",
              "strain");
  owned_system *system = small_falling(made);
  owned_measurement *needs = needs_of(system, NULL);
  const int64_t row = degree_of(needs, "all:3.stiffness");
  const double times = 1.0 / hooke_measurement_number(needs, "degrees", row, "factor");
  check_between(times, 180.0, 224.0);
  check_close(hooke_measurement_number(needs, "degrees", row, "error"), change_at(times), 0.01 * WANT);
  assert_int_equal(degree_of(needs, "all:2.stiffness"), hooke_measurement_row_count(needs, "degrees"));
#if HOOKE_HAVE_LAPACK
  assert_int_equal(hooke_measurement_row_count(needs, "changed"), 1);
  assert_string_equal(hooke_measurement_text(needs, "changed", 0, "quantity"), "all:3.stiffness");
#endif
}

TEST(what_is_kept_is_neither_left_out_nor_changed) {
  owned_system *system = chain();
  owned_measurement *needs = needs_of(system, "stiff");
  assert_int_equal(hooke_measurement_row_count(needs, "changed"), 0);
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    const char *without = hooke_measurement_text(needs, "rows", row, "without");
    assert_true(strcmp(without, "soft") == 0 || strcmp(without, "gravity") == 0);
  }
  assert_string_equal(hooke_measurement_text(needs, "degrees", 0, "quantity"), "soft.stiffness");
  assert_int_equal(degree_of(needs, "stiff.stiffness"), hooke_measurement_row_count(needs, "degrees"));

  owned_options *options = options_with("needs", "want=%.17g", WANT),
                *run = run_options((struct run){.method = "verlet", .duration = 5.0, .every = 0.05});
  hooke_measurement *other = NULL;
  check_ok(hooke_options_set_text(options, "keep", "soft,stiffer"));
  check_status(hooke_measurement_create("needs", system, run, options, &other), HOOKE_BAD_VALUE);
  assert_non_null(strstr(hooke_last_error(), "\"stiffer\" is no group"));
}

/* The largest distance of a particle between two systems, at frames of 0.05 s until 1 s, by rk4. */
static double largest_distance(const hooke_system *a, const hooke_system *b) {
  const struct run fine = {.method = "rk4", .step = 2.5e-4};
  owned_integrator *of_a = start_run(a, fine), *of_b = start_run(b, fine);
  owned_state *at_a = start_state(a), *at_b = start_state(b);
  double most = 0.0;
  for (int frame = 0; frame < 20; frame++) {
    check_ok(hooke_integrator_step(of_a, at_a, 200));
    check_ok(hooke_integrator_step(of_b, at_b, 200));
    const double *q = hooke_state_position(at_a), *p = hooke_state_position(at_b);
    for (int64_t k = 0; k < 24; k += 3)
      most = fmax(most, hypot(hypot(q[k] - p[k], q[k + 1] - p[k + 1]), q[k + 2] - p[k + 2]));
  }
  return most;
}

/* Symplectic Euler takes steps far below its limit for such a want: what is far beyond it is told by longer
 * ones, to a quarter, and takes no run as fine as the full scene's. */
TEST(a_change_far_beyond_the_want_is_told_by_longer_steps) {
  owned_system *system = chain(), *changed = chain_of(100.0 / 1.1);
  owned_options *options = options_with("needs", "want=%.17g keep=%s", 5e-5, "stiff"),
                *run =
                    run_options((struct run){.method = "symplectic-euler", .duration = 1.0, .every = 0.05});
  owned_measurement *needs;
  check_ok(hooke_measurement_create("needs", system, run, options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  check_between(hooke_measurement_number(needs, "full", 0, "step"), 1e-8,
                hooke_measurement_number(needs, "full", 0, "step_limit") / 64.0);
  const int64_t row = degree_of(needs, "soft.stiffness");
  const double change = largest_distance(system, changed),
               told = hooke_measurement_number(needs, "degrees", row, "error_beyond");
  check_close(hooke_measurement_number(needs, "degrees", row, "beyond"), 1.0 / 1.1, 1e-12);
  check_close(told, change, 0.25 * change);
  check_between(fabs(told - change), 5e-5 / 10.0, INFINITY); /* the finer steps would be closer */
}
