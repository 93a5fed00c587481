/* Krylov iterations find the solutions that right-hand sides were made of. */
#include "check.h"
#include "integrate/solve/krylov.h"
#include "random.h"
#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 60 };

struct dense {
  double a[SIZE][SIZE];
  int64_t calls, stop_at; /* 0: never */
};

static int32_t apply(void *ctx, const double *x, double *out) {
  struct dense *dense = ctx;
  if (++dense->calls == dense->stop_at) return HOOKE_STOPPED;
  for (int i = 0; i < SIZE; i++) {
    out[i] = 0.0;
    for (int j = 0; j < SIZE; j++)
      out[i] += dense->a[i][j] * x[j];
  }
  return HOOKE_OK;
}

/* Diag + share (R + skew-or-symmetric R^T), entries of R up to 1/SIZE in size; every `flip`-th diagonal
 * negative. */
static void fill(struct dense *dense, uint64_t seed, double share, double mirror, int flip) {
  struct random_source source = {seed};
  memset(dense, 0, sizeof *dense);
  for (int i = 0; i < SIZE; i++) {
    for (int j = 0; j < SIZE; j++) {
      const double entry = share * random_between(&source, -1.0, 1.0) / SIZE;
      dense->a[i][j] += entry;
      dense->a[j][i] += mirror * entry;
    }
    dense->a[i][i] += flip && i % flip == 0 ? -0.5 : 1.0 + 9.0 * i / SIZE;
  }
}

typedef int32_t solver(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                       double *scratch, double *x, struct hk_solution *solution);

static int32_t run_solver(solver *solve, struct dense *dense, const double *b, int64_t limit, double *x,
                          struct hk_solution *solution) {
  owned_doubles *scratch = new_doubles(HOOKE_MINIMAL_VECTORS * SIZE);
  const struct hk_operator a = {SIZE, apply, dense};
  return solve(&a, b, 1e-12, limit, scratch, x, solution);
}

static int32_t solve_positive(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                              double *scratch, double *x, struct hk_solution *solution) {
  return hk_solve_positive(a, b, tolerance, 0.0, limit, scratch, x, solution);
}

static solver *const every_solver[] = {hk_solve_symmetric, solve_positive, hk_solve_general,
                                       hk_solve_minimal};
enum { SOLVERS = sizeof every_solver / sizeof every_solver[0] };

static void random_side(uint64_t seed, double *b) {
  struct random_source source = {seed};
  for (int k = 0; k < SIZE; k++)
    b[k] = random_between(&source, -1.0, 1.0);
}

static void compare(solver *solve, struct dense *dense, uint64_t seed, int64_t most) {
  double b[SIZE], x[SIZE], expected[SIZE];
  struct hk_solution solution;
  random_side(seed, expected);
  check_ok(apply(dense, expected, b));
  check_ok(run_solver(solve, dense, b, 1000, x, &solution));
  assert_true(solution.converged);
  check_between(solution.residual, 0.0, 1e-12);
  check_between((double)solution.iterations, 3.0, (double)most);
  check_between(largest_difference(SIZE, x, expected), 0.0, 1e-9 * largest(SIZE, expected));
}

TEST(symmetric_and_positive) {
  struct dense dense;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    fill(&dense, seed, 1.0, 1.0, 0);
    compare(hk_solve_symmetric, &dense, seed, SIZE);
    compare(hk_solve_general, &dense, seed, SIZE);
  }
}

TEST(without_symmetry) {
  struct dense dense;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    fill(&dense, seed, 8.0, -0.5, 0);
    compare(hk_solve_general, &dense, seed, 2 * SIZE);
    fill(&dense, seed, 2.0, -0.5, 7); /* and eigenvalues of either sign */
    compare(hk_solve_general, &dense, seed, 4 * SIZE);
  }
}

/* Zero right-hand side, and convergence in one step. */
TEST(trivial_sides) {
  solver *const solvers[] = {hk_solve_symmetric, hk_solve_general};
  struct dense dense;
  memset(&dense, 0, sizeof dense);
  for (int i = 0; i < SIZE; i++)
    dense.a[i][i] = 4.0;
  for (int s = 0; s < 2; s++) {
    double b[SIZE] = {0.0}, x[SIZE];
    struct hk_solution solution;
    memset(x, 0x55, sizeof x);
    check_ok(run_solver(solvers[s], &dense, b, 100, x, &solution));
    assert_true(solution.converged && solution.iterations == 0);
    check_close(largest(SIZE, x), 0.0, 0.0);
    b[3] = 2.0;
    check_ok(run_solver(solvers[s], &dense, b, 100, x, &solution));
    assert_true(solution.converged);
    assert_int_equal(solution.iterations, 1);
    check_close(x[3], 0.5, 1e-15);
    for (int k = 0; k < 2; k++) {
      b[3] = k ? NAN : INFINITY;
      check_ok(run_solver(solvers[s], &dense, b, 100, x, &solution));
      check_same_bits(SIZE, x, b);
    }
  }
}

/* Conjugate gradients end at the first direction of negative curvature, pointing along b. */
TEST(descends) {
  for (int flip = 1; flip <= 9; flip += 4) {
    struct dense dense;
    double b[SIZE], x[SIZE], along = 0.0;
    struct hk_solution solution;
    fill(&dense, 5, 0.0, 1.0, flip);
    random_side(6, b);
    check_ok(run_solver(hk_solve_symmetric, &dense, b, 1000, x, &solution));
    assert_false(solution.converged);
    for (int k = 0; k < SIZE; k++)
      along += b[k] * x[k];
    assert_true(along > 0.0);
    check_ok(run_solver(solve_positive, &dense, b, 1000, x, &solution));
    assert_false(solution.converged);
    assert_true(solution.iterations < SIZE);
  }
}

/* Each product may stop. */
static void check_stops(solver *solve, struct dense *dense, const double *b) {
  double x[SIZE];
  struct hk_solution solution;
  for (dense->stop_at = 1;; dense->stop_at++) {
    dense->calls = 0;
    const int32_t status = run_solver(solve, dense, b, 100, x, &solution);
    if (status == HOOKE_OK) break;
    check_status(status, HOOKE_STOPPED);
    assert_int_equal(dense->calls, dense->stop_at);
  }
  assert_true(solution.converged && dense->calls == dense->stop_at - 1 && dense->calls > 20);
}

TEST(limits_and_stops) {
  for (int s = 0; s < SOLVERS; s++) {
    struct dense dense;
    double b[SIZE], x[SIZE];
    struct hk_solution solution;
    fill(&dense, 5, 1.0, 1.0, 0);
    random_side(6, b);
    check_ok(run_solver(every_solver[s], &dense, b, 4, x, &solution));
    assert_false(solution.converged);
    assert_int_equal(solution.iterations, 4);
    check_between(solution.residual, 1e-6, 1.0);
    check_stops(every_solver[s], &dense, b);
    /* a zero matrix has no solution */
    memset(&dense, 0, sizeof dense);
    check_ok(run_solver(every_solver[s], &dense, b, 20, x, &solution));
    assert_false(solution.converged);
  }
}
