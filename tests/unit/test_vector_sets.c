/* Every instruction set of this machine gives the same bits in the loops of vectors, and they are right. */
#include "check.h"
#include "random.h"
#include "run.h"

#include "kernel/spring/spring_loops.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <string.h>

enum { LONGEST = 301, LOOPS = 8 };

static void draw(struct random_source *source, int64_t count, double *x) {
  for (int64_t k = 0; k < count; k++)
    x[k] = random_between(source, -1.0, 1.0);
}

/* Results of each loop from x and y, one after the other, and sums at the end. */
static void run_loops(const struct hk_vector_set *v, int64_t n, const double *x, const double *y,
                      double *out) {
  v->linear_sum(n, 0.3, x, -1.7, y, out);
  v->scale(n, 1.1, x, out + n);
  v->multiply(n, x, y, out + 2 * n);
  v->divide(n, x, y, out + 3 * n);
  v->invert(n, y, out + 4 * n);
  v->absolute(n, x, out + 5 * n);
  memcpy(out + 6 * n, y, (size_t)n * sizeof(double));
  v->add_multiple(n, 0.9, x, out + 6 * n);
  memcpy(out + 7 * n, y, (size_t)n * sizeof(double));
  v->scale_and_add(n, 0.9, x, out + 7 * n);
  double *sum = out + LOOPS * n;
  sum[0] = v->dot(n, x, y);
  sum[1] = v->long_dot(n, x, y);
  sum[2] = v->sum_of_squares(n, x, y);
  sum[3] = v->largest(n, x);
}

TEST(vectors) {
  struct random_source source = {11};
  owned_doubles *x = new_doubles(LONGEST), *y = new_doubles(LONGEST);
  owned_doubles *first = new_doubles(LOOPS * LONGEST + 4), *other = new_doubles(LOOPS * LONGEST + 4);
  for (int64_t n = 0; n < LONGEST; n += n < 70 ? 1 : 33) {
    draw(&source, n, x);
    draw(&source, n, y);
    run_loops(hk_spring_set(0)->vector, n, x, y, first);
    for (int32_t k = 1; hk_spring_set(k); k++) {
      run_loops(hk_spring_set(k)->vector, n, x, y, other);
      check_same_bits(LOOPS * n + 4, other, first);
    }
    double dot = 0.0, squares = 0.0, most = 0.0;
    for (int64_t k = 0; k < n; k++) {
      const double expected[LOOPS] = {
          0.3 * x[k] + -1.7 * y[k], 1.1 * x[k],       x[k] * y[k], x[k] / y[k], 1.0 / y[k], fabs(x[k]),
          y[k] + 0.9 * x[k],        x[k] + 0.9 * y[k]};
      for (int l = 0; l < LOOPS; l++)
        check_close(first[l * n + k], expected[l], 0.0);
      dot += x[k] * y[k];
      squares += x[k] * y[k] * x[k] * y[k];
      most = fmax(most, fabs(x[k]));
    }
    const double *sum = first + LOOPS * n;
    check_close(sum[0], dot, 1e-13);
    check_close(sum[1], dot, 1e-13);
    check_close(sum[2], squares, 1e-13);
    check_close(sum[3], most, 0.0);
  }
}

/* Rows are joined unchanged, and every bit of them counts. */
TEST(rows) {
  struct random_source source = {13};
  owned_doubles *x = new_doubles(3 * LONGEST), *joined = new_doubles(3 * LONGEST);
  draw(&source, 3 * LONGEST, x);
  for (int32_t k = 0; hk_spring_set(k); k++) {
    const struct hk_vector_set *v = hk_spring_set(k)->vector;
    for (int64_t n = 0; n < LONGEST; n += n < 70 ? 1 : 33) {
      v->join_rows(n, x, x + n, x + 2 * n, joined);
      for (int64_t e = 0; e < 3 * n; e++)
        check_same_bits(1, joined + e, x + e % 3 * n + e / 3);
      assert_true(v->differing_bits(n, x, x + n, x + 2 * n, joined) == 0);
      if (n == 0) continue;
      const int64_t changed = random_whole(&source, 0, 3 * n - 1);
      joined[changed] = -joined[changed];
      assert_true(v->differing_bits(n, x, x + n, x + 2 * n, joined) == UINT64_C(1) << 63);
    }
  }
}
