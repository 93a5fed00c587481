/* The lowest eigenvalues by the sparse way against the dense one, where they repeat, are 0 or are below 0. */
#include "measure/modes/lowest.h"
#include "measure/modes/modes.h"
#include "measure/modes/stiffness.h"

#include "check.h"
#include "owned.h"
#include "small.h"

#include <math.h>

/* At rest lengths all move across, and rows and columns that no corner holds along themselves. */
/* A net of n x n particles whose springs are pulled, pushed or at rest; held at four corners, or floating. */
static hooke_system *make_net(int n, double rest, int held) {
  hooke_system *system = new_system();
  for (int k = 0; k < n * n; k++)
    check_ok(
        hooke_system_add_particles(system, 1, (double[]){k % n, k / n, 0}, NULL, 1, (double[]){1}, NULL));
  for (int k = 0; k < 4 && held; k++)
    check_ok(hooke_system_pin(system, 1, (int64_t[]){k % 2 * (n - 1) + k / 2 * (n - 1) * n}));
  owned_options *options = options_with("springs", "stiffness=7 law=length");
  check_ok(hooke_options_set_number(options, "rest_length", rest));
  for (int k = 0; k < n * n; k++) {
    if (k % n + 1 < n) check_ok(hooke_system_add_springs(system, NULL, 1, (int64_t[]){k, k + 1}, options));
    if (k + n < n * n) check_ok(hooke_system_add_springs(system, NULL, 1, (int64_t[]){k, k + n}, options));
  }
  return committed(system);
}

/* In a build without one of its libraries. */
static int32_t is_built(const hooke_system *system) {
  owned(hk_modes_release) struct hk_modes modes;
  const int32_t status = hk_modes_find(system, 0.0, system->position, (double[3 * 64]){0.0}, 1, NULL, &modes);
  return status != HOOKE_NOT_BUILT && hk_cholmod;
}

static void compare(const hooke_system *system, int64_t count, int64_t zeros) {
  owned(hk_stiffness_release) struct hk_stiffness s;
  struct hk_lowest dense, sparse;
  const double *q = system->position;
  check_ok(hk_stiffness_create(system, q, &s));
  check_ok(hk_lowest_dense(&s.matrix, s.bound, count, &dense));
  check_ok(hk_lowest_sparse(&s.matrix, s.bound, count, NULL, &sparse));
  int32_t sign = 0;
  check_ok(hk_lowest_sign(&s.matrix, s.bound, NULL, &sign));
  assert_int_equal(sign, dense.value[0] < 0.0 ? -1 : 1);
  assert_int_equal(dense.count, count);
  assert_int_equal(sparse.count, count);
  assert_true(dense.complete && dense.zero_count == zeros);
  /* where all that were asked for are below 0, zeros are not looked for */
  assert_int_equal(sparse.complete, dense.value[count - 1] > 0.0);
  if (sparse.complete) assert_int_equal(sparse.zero_count, zeros);
  for (int64_t k = 0; k < count; k++) {
    assert_true(fabs(sparse.value[k] - dense.value[k]) <= 1e-9 * fabs(dense.value[k]));
    assert_true(k == 0 || sparse.value[k] >= sparse.value[k - 1]);
    /* its vector belongs to it */
    double out[3 * 14 * 14], left = 0.0;
    hk_columns_multiply(&s.matrix, sparse.vector + k * s.count, out);
    for (int64_t i = 0; i < s.count; i++)
      left = fmax(left, fabs(out[i] - sparse.value[k] * sparse.vector[k * s.count + i]));
    assert_true(left <= 1e-6 * s.bound);
  }
  hk_lowest_release(&dense);
  hk_lowest_release(&sparse);
}

TEST(test_sparse_and_dense_agree) {
  static const struct {
    double rest;
    int32_t held;
    int64_t count, zeros;
  } nets[] = {{0.9, 1, 12, 0}, {0.9, 0, 7, 3}, {1.1, 1, 9, 0}, {1.0, 1, 5, 72}};
  for (size_t k = 0; k < sizeof nets / sizeof nets[0]; k++) {
    hooke_system *system = make_net(8, nets[k].rest, nets[k].held);
    if (!is_built(system)) {
      hooke_system_destroy(system);
      skip();
    }
    compare(system, nets[k].count, nets[k].zeros);
    hooke_system_destroy(system);
  }
}

TEST(test_a_budget_ends_the_search) {
  hooke_system *system = make_net(4, 0.9, 1);
  struct hk_budget budget = hk_budget_of(0.0, NULL, NULL);
  struct hk_modes modes;
  const double *q = system->position, v[48] = {0.0};
  if (!is_built(system)) {
    hooke_system_destroy(system);
    skip();
  }
  assert_int_equal(hk_modes_find(system, 0.0, q, v, 3, &budget, &modes), HOOKE_STOPPED);
  hk_modes_release(&modes);
  check_ok(hk_modes_find(system, 0.0, q, v, 3, NULL, &modes));
  assert_true(modes.count == 3 && modes.zero_modes == 0);
  hk_modes_release(&modes);
  hooke_system_destroy(system);
}
