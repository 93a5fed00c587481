/* Eigenvalues, the steps that blocks of them allow, the fit of an order, and the stability limit of
 * Runge-Kutta 4 along rays, compared with closed forms. */
#include "measure/spectrum/eigen/dense.h"
#include "measure/spectrum/limit_rules.h"
#include "measure/spectrum/node_blocks.h"
#include "measure/study/study.h"

#include "check.h"
#include "owned.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <string.h>

/* R diag(value) R^T with the rotation R about (1, 2, 3) by `angle`. */
static void rotated(const double value[3], double angle, double matrix[6]) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  const double size = sqrt(14.0), u[3] = {1.0 / size, 2.0 / size, 3.0 / size};
  const double c = cos(angle), s = sin(angle);
  const double cross[3][3] = {{0.0, -u[2], u[1]}, {u[2], 0.0, -u[0]}, {-u[1], u[0], 0.0}};
  double r[3][3];
  for (int a = 0; a < 3; a++) {
    for (int b = 0; b < 3; b++)
      r[a][b] = (a == b ? c : 0.0) + s * cross[a][b] + (1.0 - c) * u[a] * u[b];
  }
  memset(matrix, 0, 6 * sizeof(double));
  for (int k = 0; k < 6; k++) {
    for (int m = 0; m < 3; m++)
      matrix[k] += r[row[k]][m] * value[m] * r[column[k]][m];
  }
}

/* One over the largest eigenvalue, of stiffness and of damping; the step of an oscillation; and of 3 K and 4
 * C between two of one mode. */
static void check_reach(const struct hk_node_blocks *blocks, double largest) {
  const double most = 16.0 * DBL_EPSILON;
  const double k = hk_node_blocks_reach(blocks, (struct hk_node_limit){.k = 1.0}, INFINITY, NULL),
               c = hk_node_blocks_reach(blocks, (struct hk_node_limit){.c = 2.0}, INFINITY, NULL),
               kk = hk_node_blocks_reach(blocks, (struct hk_node_limit){.kk = 1.0}, INFINITY, NULL);
  assert_true(fabs(k * largest - 1.0) <= most && fabs(c * 2.0 * largest - 1.0) <= most);
  assert_true(fabs(kk * sqrt(largest) - 1.0) <= most);
  const struct hk_node_limit both = {.kk = 3.0, .c = 4.0};
  int64_t particle = -1;
  const double h = hk_node_blocks_reach(blocks, both, INFINITY, &particle), x = largest * h;
  assert_true(fabs(3.0 * x * h + 4.0 * x - 1.0) <= 2.0 * most && particle == 0);
  particle = -1;
  assert_true(hk_node_blocks_reach(blocks, both, 0.999 * h, &particle) == 0.999 * h && particle == -1);
  assert_true(hk_node_blocks_reach(blocks, both, 1.001 * h, &particle) <= h * (1.0 + most) && particle == 0);
}

TEST(test_three_by_three) {
  static const double values[][3] = {{3, 1, 2},     {5, 5, 1},        {5, 1, 1},         {2, 2, 2},
                                     {1e-9, 1, 1},  {1, 1 + 1e-9, 1}, {1e200, 1, 1e-20}, {1e-200, 3e-200, 0},
                                     {0, 4e150, 0}, {7, 0, 0},        {1e-300, 0, 0},    {1e305, 1e305, 0}};
  owned_system *system = NULL;
  owned(hk_node_blocks_release) struct hk_node_blocks blocks;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_particles(system, 1, (double[]){0, 0, 0}, NULL, 1, (double[]){1}, NULL));
  check_ok(hooke_system_commit(system));
  check_ok(hk_node_blocks_begin(system, &blocks));
  assert_true(isinf(hk_node_blocks_reach(&blocks, (struct hk_node_limit){1, 1, 1}, INFINITY, NULL)));
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) {
    const double *v = values[k];
    for (int turn = 0; turn <= 20; turn++) {
      rotated(v, 0.37 * turn, blocks.stiffness);
      memcpy(blocks.damping, blocks.stiffness, 6 * sizeof(double));
      check_reach(&blocks, fmax(v[0], fmax(v[1], v[2])));
    }
  }
}

/* A chain of n unit masses and springs between walls: 4 sin^2(k pi/(2 (n + 1))). */
enum { CHAIN = 40 };

static double chain_value(int k) {
  const double s = sin(k * acos(-1.0) / (2.0 * (CHAIN + 1)));
  return 4.0 * s * s;
}

static void fill_chain(double *matrix) {
  memset(matrix, 0, CHAIN * CHAIN * sizeof(double));
  for (int k = 0; k < CHAIN; k++) {
    matrix[k * CHAIN + k] = 2.0;
    if (k > 0) matrix[k * CHAIN + k - 1] = matrix[(k - 1) * CHAIN + k] = -1.0;
  }
}

TEST(test_chain) {
  static double matrix[CHAIN * CHAIN], vector[CHAIN * CHAIN], value[CHAIN], diagonal[CHAIN], beside[CHAIN];
  fill_chain(matrix);
  const int32_t status = hk_dense_symmetric(CHAIN, matrix, value, NULL);
  if (status == HOOKE_NOT_BUILT) skip();
  check_ok(status);
  for (int k = 0; k < CHAIN; k++)
    assert_true(fabs(value[k] - chain_value(CHAIN - k)) < 1e-14);
  fill_chain(matrix);
  check_ok(hk_dense_symmetric(CHAIN, matrix, value, vector));
  fill_chain(matrix);
  for (int k = 0; k < CHAIN; k++) {
    double square = 0.0;
    for (int i = 0; i < CHAIN; i++) {
      double image = 0.0;
      for (int j = 0; j < CHAIN; j++)
        image += matrix[i * CHAIN + j] * vector[k * CHAIN + j];
      assert_true(fabs(image - chain_value(CHAIN - k) * vector[k * CHAIN + i]) < 1e-13);
      square += vector[k * CHAIN + i] * vector[k * CHAIN + i];
    }
    assert_true(fabs(square - 1.0) < 1e-14);
  }
  double top[2], last[CHAIN];
  for (int k = 0; k < CHAIN; k++) {
    diagonal[k] = 2.0;
    beside[k] = -1.0;
  }
  check_ok(hk_dense_tridiagonal(CHAIN, diagonal, beside, &top[0], NULL));
  check_ok(hk_dense_tridiagonal(CHAIN, diagonal, beside, &top[1], last));
  assert_true(fabs(top[0] - chain_value(CHAIN)) < 1e-14 && fabs(top[1] - top[0]) < 1e-14);
  for (int k = 0; k < CHAIN; k++)
    assert_true(fabs(fabs(last[k]) - fabs(vector[k])) < 1e-13);
}

/* With C = b K a mode of the chain has lambda^2 + b w lambda + w = 0. */
TEST(test_damped_chain) {
  static double stiffness[CHAIN * CHAIN], damping[CHAIN * CHAIN];
  const double b = 1.1; /* some modes oscillate, some are overdamped */
  owned(hk_damped_modes_release) struct hk_damped_modes modes;
  fill_chain(stiffness);
  for (int k = 0; k < CHAIN * CHAIN; k++)
    damping[k] = b * stiffness[k];
  const int32_t status = hk_dense_damped(CHAIN, stiffness, damping, &modes);
  if (status == HOOKE_NOT_BUILT) skip();
  check_ok(status);
  int expected = 0;
  for (int k = 1; k <= CHAIN; k++) {
    const double w = chain_value(k), under = b * b * w * w / 4.0 - w;
    for (int sign = -1; sign <= (under > 0.0 ? 1 : -1); sign += 2, expected++) {
      const double real = -b * w / 2.0 + (under > 0.0 ? sign * sqrt(under) : 0.0);
      const double imaginary = under > 0.0 ? 0.0 : sqrt(-under);
      double nearest = INFINITY;
      for (int64_t m = 0; m < modes.count; m++)
        nearest = fmin(nearest, hypot(modes.real[m] - real, modes.imaginary[m] - imaginary));
      assert_true(nearest < 1e-12);
    }
  }
  assert_true(modes.count == expected && expected > CHAIN);
  for (int64_t m = 0; m < modes.count; m++) {
    const double *re = modes.vector_real + m * CHAIN, *im = modes.vector_imaginary + m * CHAIN;
    const double x = modes.real[m], y = modes.imaginary[m];
    /* lambda^2 v + (1 + b lambda) K v */
    for (int i = 0; i < CHAIN; i++) {
      double kr = 0.0, ki = 0.0;
      for (int j = 0; j < CHAIN; j++) {
        kr += stiffness[i * CHAIN + j] * re[j];
        ki += stiffness[i * CHAIN + j] * im[j];
      }
      const double ar = (x * x - y * y) * re[i] - 2.0 * x * y * im[i] + (1.0 + b * x) * kr - b * y * ki;
      const double ai = (x * x - y * y) * im[i] + 2.0 * x * y * re[i] + (1.0 + b * x) * ki + b * y * kr;
      assert_true(hypot(ar, ai) < 1e-12);
    }
  }
}

TEST(test_not_finite) {
  static const double bad[] = {NAN, INFINITY};
  for (int k = 0; k < 2; k++) {
    double matrix[4] = {1.0, bad[k], bad[k], 1.0}, value[2], unit[4] = {1.0, 0.0, 0.0, 1.0};
    struct hk_damped_modes modes;
    const int32_t status = hk_dense_symmetric(2, matrix, value, NULL);
    if (status == HOOKE_NOT_BUILT) skip();
    check_status(status, HOOKE_SOLVER_FAILED);
    check_status(hk_dense_damped(2, matrix, unit, &modes), HOOKE_SOLVER_FAILED);
    check_status(hk_dense_tridiagonal(2, matrix, matrix + 1, value, NULL), HOOKE_SOLVER_FAILED);
  }
}

/* Errors h^2 times exp(+d), exp(-2 d), exp(+d) at three steps: slope 2, its half width 12.7062 sqrt(6 d^2/(2
 * L^2)). */
TEST(test_line) {
  enum { ROWS = 3 };
  const double d = 0.01;
  struct hk_study_row row[ROWS] = {{.method = 0}};
  struct hk_study study = {.method_count = 1,
                           .method = {"verlet"},
                           .reference = {.agreement = 1e-12, .extent = 1.0},
                           .row_count = ROWS,
                           .row = row};
  for (int k = 0; k < ROWS; k++) {
    row[k].value = 0.01 * exp2(-k);
    row[k].trial.error = row[k].value * row[k].value * exp(k == 1 ? -2.0 * d : d);
  }
  hk_study_fit_order(&study, 0);
  const double half = 12.706204736174698 * sqrt(3.0) * d / log(2.0);
  assert_true(fabs(study.order[0].order - 2.0) < 1e-12);
  assert_true(fabs(study.order[0].high - 2.0 - half) < 1e-11 * half);
  assert_true(fabs(2.0 - study.order[0].low - half) < 1e-11 * half);
}

TEST(test_reach) {
  const double real = 2.785293563405282; /* z^3 + 4 z^2 + 12 z + 24 = 0 */
  assert_true(fabs(hk_ray_reach(4, 0.0, 5.0) - 2.0 * sqrt(2.0)) < 2e-15);
  assert_true(fabs(hk_ray_reach(4, -3.0, 0.0) - real) < 2e-15);
  assert_true(hk_ray_reach(2, 0.0, 5.0) == 0.0 && hk_ray_reach(1, 0.0, 5.0) == 0.0);
  assert_true(fabs(hk_ray_reach(1, -3.0, 4.0) - 1.2) < 2e-15);
  /* 2 cbrt(-x) to the first order near the axis */
  assert_true(fabs(hk_ray_reach(2, -1e-24, 1.0) - 2e-8) < 1e-21);
  assert_true(fabs(hk_ray_reach(2, -3.0, 0.0) - 2.0) < 2e-15);
  for (int k = 1; k < 100; k++) { /* |R| = 1 there */
    const double angle = 0.01 * k, x = -sin(angle), y = cos(angle), r = hk_ray_reach(2, x, y);
    const double re = 1.0 + r * x + 0.5 * r * r * (x * x - y * y), im = r * y + r * r * x * y;
    assert_true(r > 0.0 && fabs(re * re + im * im - 1.0) < 1e-14);
  }
  for (double x = -1.0; x <= 0.0; x += 0.125) {
    const double y = x + 1.0, reach = hk_ray_reach(4, x, y);
    const double complex z = reach / hypot(x, y) * (x + y * I);
    assert_true(fabs(cabs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))) - 1.0) < 1e-13);
  }
}
