/* Every instruction set that this machine has gives the same bits in the loops of vectors, products and factors; and these
 * are right. */
#include "check.h"
#include "random.h"
#include "run.h"

#include "kernel/front_loops.h"
#include "kernel/spring_loops.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 301, LOOPS = 9 };

static void draw(struct random_source *source, int64_t count, double *x) {
  for (int64_t k = 0; k < count; k++)
    x[k] = random_between(source, -1.0, 1.0);
}

/* What each loop makes of x and y, one after the other, and sums at the end. */
static void run_loops(const struct hooke_vector_set *v, int64_t n, const double *x, const double *y,
                      double *out) {
  v->linear_sum(n, 0.3, x, -1.7, y, out);
  v->scale(n, 1.1, x, out + n);
  v->multiply(n, x, y, out + 2 * n);
  v->divide(n, x, y, out + 3 * n);
  v->invert(n, y, out + 4 * n);
  v->absolute(n, x, out + 5 * n);
  v->add_number(n, 0.7, x, out + 6 * n);
  memcpy(out + 7 * n, y, (size_t)n * sizeof(double));
  v->add_multiple(n, 0.9, x, out + 7 * n);
  memcpy(out + 8 * n, y, (size_t)n * sizeof(double));
  v->scale_and_add(n, 0.9, x, out + 8 * n);
  double *sum = out + LOOPS * n;
  sum[0] = v->dot(n, x, y);
  sum[1] = v->long_dot(n, x, y);
  sum[2] = v->sum_of_squares(n, x, y);
  sum[3] = v->largest(n, x);
}

static void vectors(void **unused) {
  (void)unused;
  struct random_source source = {11};
  double *x = new_doubles(LONGEST), *y = new_doubles(LONGEST);
  double *first = new_doubles(LOOPS * LONGEST + 4), *other = new_doubles(LOOPS * LONGEST + 4);
  for (int64_t n = 0; n < LONGEST; n += n < 70 ? 1 : 33) {
    draw(&source, n, x);
    draw(&source, n, y);
    run_loops(hooke_spring_set(0)->vector, n, x, y, first);
    for (int32_t k = 1; hooke_spring_set(k); k++) {
      run_loops(hooke_spring_set(k)->vector, n, x, y, other);
      check_same_bits(LOOPS * n + 4, other, first);
    }
    double dot = 0.0, squares = 0.0, most = 0.0;
    for (int64_t k = 0; k < n; k++) {
      const double expected[LOOPS] = {0.3 * x[k] + -1.7 * y[k],
                                      1.1 * x[k],
                                      x[k] * y[k],
                                      x[k] / y[k],
                                      1.0 / y[k],
                                      fabs(x[k]),
                                      0.7 + x[k],
                                      y[k] + 0.9 * x[k],
                                      x[k] + 0.9 * y[k]};
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
  free(x);
  free(y);
  free(first);
  free(other);
}

/* A panel of `rows` by `columns` of a positive matrix, with the rest below. */
static void run_front(const struct hooke_front_set *set, int rows, int columns, const double *matrix,
                      double *out) {
  const int n = rows - columns;
  double *panel = out, *rest = panel + rows * columns, *x = rest + n * n;
  for (int j = 0; j < columns; j++)
    memcpy(panel + j * rows, matrix + j * rows, (size_t)rows * sizeof(double));
  for (int j = 0; j < n; j++)
    memcpy(rest + j * n, matrix + (columns + j) * rows + columns, (size_t)n * sizeof(double));
  assert_int_equal(set->front_factorise(rows, columns, panel), 1);
  set->front_subtract(rows, columns, panel, rest);
  for (int k = 0; k < rows; k++)
    x[k] = x[rows + k] = 1.0 + 0.01 * k;
  set->front_forward(rows, columns, panel, x);
  set->front_backward(rows, columns, panel, x + rows);
}

/* The same in plain loops. */
static void check_front(int rows, int columns, const double *matrix, const double *found) {
  double *a = new_doubles(rows * rows), *x = new_doubles(2 * rows), *back = x + rows;
  const int n = rows - columns;
  memcpy(a, matrix, (size_t)(rows * rows) * sizeof(double));
  for (int j = 0; j < columns; j++) {
    const double root = sqrt(a[j * rows + j]);
    for (int i = j; i < rows; i++)
      a[j * rows + i] /= root;
    for (int k = j + 1; k < rows; k++) {
      for (int i = k; i < rows; i++)
        a[k * rows + i] -= a[j * rows + i] * a[j * rows + k];
    }
  }
  for (int j = 0; j < columns; j++) {
    for (int i = j + 1; i < rows; i++)
      check_close(found[j * rows + i], a[j * rows + i], 1e-12);
    check_close(found[j * rows + j], 1.0 / a[j * rows + j], 1e-12);
  }
  for (int j = 0; j < n; j++) {
    for (int i = j; i < n; i++)
      check_close(found[rows * columns + j * n + i], a[(columns + j) * rows + columns + i], 1e-12);
  }
  for (int k = 0; k < rows; k++)
    x[k] = back[k] = 1.0 + 0.01 * k;
  for (int j = 0; j < columns; j++) {
    x[j] /= a[j * rows + j];
    for (int i = j + 1; i < rows; i++)
      x[i] -= a[j * rows + i] * x[j];
  }
  for (int j = columns - 1; j >= 0; j--) {
    for (int i = j + 1; i < rows; i++)
      back[j] -= a[j * rows + i] * back[i];
    back[j] /= a[j * rows + j];
  }
  for (int k = 0; k < 2 * rows; k++)
    check_close(found[rows * columns + n * n + k], x[k], 1e-11);
  free(a);
  free(x);
}

static void fronts(void **unused) {
  (void)unused;
  struct random_source source = {12};
  for (int rows = 1; rows < 90; rows += 1 + rows / 7) {
    for (int columns = 1; columns <= rows; columns += 1 + columns / 5) {
      const int n = rows - columns, count = rows * columns + n * n + 2 * rows;
      double *matrix = new_doubles(rows * rows), *first = new_doubles(count), *other = new_doubles(count);
      for (int j = 0; j < rows; j++) {
        for (int i = j; i < rows; i++)
          matrix[j * rows + i] = i == j ? 0.5 * rows + 1.0 : random_between(&source, -0.5, 0.5);
      }
      run_front(hooke_spring_set(0)->front, rows, columns, matrix, first);
      check_front(rows, columns, matrix, first);
      for (int32_t k = 1; hooke_spring_set(k); k++) {
        run_front(hooke_spring_set(k)->front, rows, columns, matrix, other);
        check_same_bits(count, other, first);
      }
      free(matrix);
      free(first);
      free(other);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(vectors), cmocka_unit_test(fronts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
