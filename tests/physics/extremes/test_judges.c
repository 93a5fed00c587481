/* The judges of this suite reject what they must reject. */
#include "check.h"
#include "extreme.h"
#include "oscillator.h"
#include "small.h"

#include <math.h>
#include <string.h>

static void good_run(struct extreme_outcome *outcome) {
  owned_system *system = small_oscillator(10.0);
  extreme_run(system, (struct extreme_run){.method = "symplectic-euler", .step = 0.01, .steps = 100},
              outcome);
  assert_null(extreme_unsound(outcome));
  assert_null(extreme_not_right(outcome, 1e-3, 1e-4, 1e-2));
}

static void bad_run(struct extreme_outcome *outcome) {
  owned_system *system = small_oscillator(10.0);
  extreme_run(system, (struct extreme_run){.method = "forward-euler", .step = 0.1, .steps = 100}, outcome);
  assert_null(extreme_unsound(outcome));
  assert_null(extreme_not_refused(outcome));
  assert_null(extreme_not_ended(outcome, HOOKE_DIVERGED, "diverged"));
}

TEST(test_numbers) {
  const double wrong[] = {NAN, INFINITY, -INFINITY};
  for (int k = 0; k < 3; k++) {
    struct extreme_outcome outcome;
    good_run(&outcome);
    outcome.q[4] = wrong[k];
    assert_non_null(extreme_unsound(&outcome));
    assert_true(extreme_error(&outcome, outcome.q0, 1.0) == INFINITY);
    extreme_release(&outcome);
    good_run(&outcome);
    outcome.v[0] = wrong[k];
    assert_non_null(extreme_not_right(&outcome, 1e-3, 1e-4, 1e-2));
    extreme_release(&outcome);
    bad_run(&outcome);
    outcome.q[0] = wrong[k];
    assert_non_null(extreme_not_ended(&outcome, HOOKE_DIVERGED, "diverged"));
    assert_non_null(extreme_not_refused(&outcome));
    extreme_release(&outcome);
  }
  owned_outcome outcome;
  good_run(&outcome);
  outcome.energy = NAN;
  assert_non_null(extreme_unsound(&outcome));
  outcome.energy = 1.0;
  outcome.wrong_frames = 1;
  assert_non_null(extreme_unsound(&outcome));
}

/* A frame with a NaN is detected during the run. */
static int32_t poison(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)q, (void)v, (void)ctx;
  force[3 * n - 1] = t > 0.5 ? NAN : 0.0;
  return 0;
}

TEST(test_watch) {
  const double q[] = {0, 0, 0};
  owned_outcome outcome;
  owned_system *system = small_system(1, q, NULL, 1.0, 0);
  check_ok(hooke_system_set_force(system, poison, NULL, NULL));
  check_ok(hooke_system_commit(system));
  extreme_run(system, (struct extreme_run){.method = "symplectic-euler", .step = 0.1, .steps = 10}, &outcome);
  assert_null(extreme_not_ended(&outcome, HOOKE_DIVERGED, "not finite"));
  assert_int_equal(outcome.frames, 7); /* 0 to 0.6 s, the last before the NaN */
}

TEST(test_answers) {
  owned_outcome outcome;
  good_run(&outcome);
  assert_non_null(extreme_not_right(&outcome, 1.0, 0.0, 0.5));
  assert_non_null(extreme_not_right(&outcome, 1e-9, 1e-4, 1e-2)); /* too good to be true */
  assert_non_null(extreme_not_right(&outcome, NAN, 0.0, 1.0));
  assert_non_null(extreme_not_refused(&outcome));
  assert_non_null(extreme_not_ended(&outcome, HOOKE_DIVERGED, ""));
  outcome.status = HOOKE_STOPPED;
  assert_non_null(extreme_unsound(&outcome));
}

/* Silent use of another value than the given one: the state kept within bounds, or the run cut short. */
TEST(test_clamps) {
  struct extreme_outcome outcome;
  bad_run(&outcome);
  outcome.status = HOOKE_OK;
  outcome.t = outcome.end;
  memcpy(outcome.q, outcome.q0, (size_t)outcome.size * sizeof(double));
  const double blown[] = {0, 0, 0, 1e30, 0, 0};
  assert_non_null(extreme_not_right(&outcome, extreme_error(&outcome, blown, 1e30), 0.0, 1e-6));
  assert_non_null(extreme_not_refused(&outcome));
  extreme_release(&outcome);
  good_run(&outcome);
  outcome.t = nextafter(outcome.end, 0.0);
  assert_non_null(extreme_unsound(&outcome));
  extreme_release(&outcome);
}

TEST(test_messages) {
  struct extreme_outcome outcome;
  bad_run(&outcome);
  assert_non_null(extreme_not_ended(&outcome, HOOKE_DIVERGED, "overslept"));
  assert_non_null(extreme_not_ended(&outcome, HOOKE_SOLVER_FAILED, ""));
  strcpy(outcome.message, "the run diverged");
  assert_non_null(extreme_unsound(&outcome));
  strcpy(outcome.message, "");
  assert_non_null(extreme_unsound(&outcome));
  extreme_release(&outcome);
  bad_run(&outcome);
  outcome.t = outcome.end + 1.0;
  assert_non_null(extreme_unsound(&outcome));
  outcome.t = outcome.start;
  outcome.refused = 1;
  outcome.q[3] += 1.0;
  assert_non_null(extreme_unsound(&outcome));
  extreme_release(&outcome);
}

/* Checks of the oscillator references: the matrices have the determinants and traces of their methods, the
 * solution satisfies its equation, and a matrix with an error of 1e-6 is noticed. */
TEST(test_oscillator) {
  const long double start[] = {1.0L, 0.5L}, zetas[] = {0.0L, 0.3L, 1.0L, 4.0L};
  for (int k = 0; k < 4; k++) {
    const long double zeta = zetas[k], e = 1e-4L;
    long double x[3][2];
    for (int j = 0; j < 3; j++)
      oscillator_solution(zeta, 0.7L + (j - 1) * e, start, x[j]);
    const long double slope = (x[2][0] - x[0][0]) / (2 * e), bend = (x[2][1] - x[0][1]) / (2 * e);
    check_close((double)(slope - x[1][1]), 0.0, 1e-7);
    check_close((double)(bend + 2.0L * zeta * x[1][1] + x[1][0]), 0.0, 1e-6);
    const long double h = 0.1L;
    long double m[4], there[2], slow[2] = {start[0], start[1]};
    assert_true(oscillator_step("symplectic-euler", zeta, h, m));
    check_close((double)(m[0] * m[3] - m[1] * m[2]), (double)(1.0L - 2.0L * zeta * h), 1e-15);
    check_close((double)(m[0] + m[3]), (double)(2.0L - 2.0L * zeta * h - h * h), 1e-15);
    for (int n = 0; n < 50; n++) {
      const long double v = slow[1] - h * (slow[0] + 2.0L * zeta * slow[1]);
      slow[1] = v;
      slow[0] += h * v;
    }
    oscillator_power(m, 50, start, there);
    check_close((double)(there[0] - slow[0]), 0.0, 1e-14);
    m[0] += 1e-6L;
    oscillator_power(m, 50, start, there);
    assert_true(fabsl(there[0] - slow[0]) > 1e-9L || zeta > 3.0L);
  }
  long double m[4];
  assert_false(oscillator_step("no-such-method", 0.0L, 0.1L, m));
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
