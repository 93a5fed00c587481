/* Every instruction set of this machine gives the same bits in the loops of vectors and triangles; and these
 * are right. */
#include "check.h"
#include "random.h"
#include "run.h"

#include "kernel/spring/spring_loops.h"
#include "kernel/triangle_loops.h"
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

/* ---- blocks of particles, and loops that combine others ---- */

enum { MOST_PARTICLES = 45 };

/* Symmetric blocks xx, yy, zz, xy, xz, yz that are positive. */
static void draw_blocks(struct random_source *source, int64_t n, double *block) {
  draw(source, 6 * n, block);
  for (int64_t k = 0; k < 3 * n; k++)
    block[k] += 4.0;
}

/* W A W^T is the unit matrix. */
static void check_factor(int64_t n, const double *block, const double *factor) {
  static const int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int64_t p = 0; p < n; p++) {
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        double sum = 0.0;
        for (int k = 0; k <= i; k++) {
          for (int l = 0; l <= j; l++)
            sum += factor[at[i][k] * n + p] * block[at[k][l] * n + p] * factor[at[j][l] * n + p];
        }
        check_between(sum - (i == j), -1e-14, 1e-14);
      }
    }
  }
}

TEST(blocks) {
  struct random_source source = {13};
  enum { LONG = 3 * MOST_PARTICLES };
  double block[2 * LONG] = {0}, factor[2 * LONG], first[2 * LONG], x[LONG], y[LONG], d[MOST_PARTICLES];
  double found[4][LONG], expected[4][LONG];
  for (int64_t n = 0; n <= MOST_PARTICLES; n++) {
    const int64_t size = 3 * n;
    draw_blocks(&source, n, block);
    draw(&source, size, x);
    draw(&source, size, y);
    draw(&source, n, d);
    draw(&source, 2 * LONG, expected[2]);
    memcpy(found[2], expected[2], 2 * sizeof found[2]);
    for (int32_t k = 0; hk_spring_set(k); k++) {
      const struct hk_vector_set *v = hk_spring_set(k)->vector;
      memcpy(factor, block, sizeof factor);
      v->factorise_blocks(n, factor);
      check_factor(n, block, factor);
      if (k == 0) memcpy(first, factor, sizeof first);
      check_same_bits(2 * size, factor, first);
      v->apply_factor_transposed(n, factor, x, expected[0]);
      v->apply_diagonal(n, d, expected[0], expected[1]);
      v->begin_product(n, factor, d, x, found[0], found[1]);
      v->add_multiple(size, 0.7, x, expected[2]);
      v->add_multiple(size, -0.7, y, expected[3]);
      const double square = v->dot(size, expected[3], expected[3]);
      const double other = v->descend(size, 0.7, x, y, found[2], found[3]);
      check_same_bits(1, &other, &square);
      for (int l = 0; l < 4; l++)
        check_same_bits(size, found[l], expected[l]);
    }
  }
}

/* ---- triangles of blocks ---- */

enum { MOST_COLUMNS = 24, MOST_ROWS = 3 * MOST_COLUMNS };

struct example {
  struct hk_triangle triangle;
  int64_t begin[MOST_COLUMNS + 1];
  int32_t row[MOST_COLUMNS * MOST_COLUMNS];
  double block[9 * MOST_COLUMNS * MOST_COLUMNS + HOOKE_TRIANGLE_SPARE], corner[6 * MOST_COLUMNS];
  double dense[MOST_ROWS][MOST_ROWS]; /* rows of the same */
};

/* One column has every block below it, the others some; the spare numbers are NaN. */
static void draw_triangle(struct random_source *source, int columns, struct example *x) {
  int64_t blocks = 0;
  *x = (struct example){.triangle = {columns, x->begin, x->row, x->block, x->corner}};
  for (int k = 0; k < columns; k++) {
    const double d[3] = {random_between(source, 1.0, 2.0), random_between(source, 1.0, 2.0),
                         random_between(source, 1.0, 2.0)};
    double below[3];
    draw(source, 3, below);
    const double corner[6] = {1.0 / d[0], below[0], below[1], 1.0 / d[1], below[2], 1.0 / d[2]};
    memcpy(x->corner + 6 * k, corner, sizeof corner);
    for (int a = 0; a < 3; a++)
      x->dense[3 * k + a][3 * k + a] = d[a];
    x->dense[3 * k + 1][3 * k] = below[0];
    x->dense[3 * k + 2][3 * k] = below[1];
    x->dense[3 * k + 2][3 * k + 1] = below[2];
    for (int i = k + 1; i < columns; i++) {
      if (k != 1 && random_between(source, 0.0, 1.0) < 0.7) continue;
      double *block = x->block + 9 * blocks;
      draw(source, 9, block);
      x->row[blocks++] = 3 * i;
      for (int e = 0; e < 9; e++)
        x->dense[3 * i + e % 3][3 * k + e / 3] = block[e];
    }
    x->begin[k + 1] = blocks;
  }
  x->block[9 * blocks] = NAN;
}

/* Solutions forward and backward, `rows` each plus the spare ones. */
static void run_triangle(const struct hk_triangle_set *set, const struct example *x, const double *right,
                         double *out) {
  const int64_t rows = 3 * x->triangle.count;
  for (int way = 0; way < 2; way++) {
    double *solution = out + way * (MOST_ROWS + HOOKE_TRIANGLE_SPARE);
    memcpy(solution, right, (size_t)rows * sizeof(double));
    solution[rows] = NAN;
    (way ? set->triangle_backward : set->triangle_forward)(&x->triangle, solution);
  }
}

static void check_triangle(const struct example *x, const double *right, const double *found) {
  const int rows = (int)(3 * x->triangle.count);
  const double *back = found + MOST_ROWS + HOOKE_TRIANGLE_SPARE;
  for (int i = 0; i < rows; i++) {
    double forth = 0.0, other = 0.0, size = 1.0, other_size = 1.0;
    for (int j = 0; j < rows; j++) {
      forth += x->dense[i][j] * found[j];
      size += fabs(x->dense[i][j] * found[j]);
      other += x->dense[j][i] * back[j];
      other_size += fabs(x->dense[j][i] * back[j]);
    }
    check_between(fabs(forth - right[i]), 0.0, 1e-14 * size);
    check_between(fabs(other - right[i]), 0.0, 1e-14 * other_size);
  }
}

TEST(triangles) {
  struct random_source source = {12};
  enum { SIZE = 2 * (MOST_ROWS + HOOKE_TRIANGLE_SPARE) };
  struct example *x = calloc(1, sizeof *x);
  double right[MOST_ROWS], first[SIZE], other[SIZE];
  assert_non_null(x);
  for (int columns = 1; columns <= MOST_COLUMNS; columns++) {
    draw_triangle(&source, columns, x);
    draw(&source, 3 * columns, right);
    memset(first, 0, sizeof first);
    memset(other, 0, sizeof other);
    run_triangle(hk_spring_set(0)->triangle, x, right, first);
    check_triangle(x, right, first);
    for (int32_t k = 1; hk_spring_set(k); k++) {
      run_triangle(hk_spring_set(k)->triangle, x, right, other);
      check_same_bits(SIZE, other, first);
    }
  }
  free(x);
}
