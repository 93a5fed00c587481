/* df/dq and df/dv: products and blocks against differences of the forces. */
#include "check.h"
#include "law_scene.h"
#include "random.h"
#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- products ---- */

struct force_curve {
  const struct law_scene *scene;
  const double *dq, *dv;
};

static void force_along(double s, double *value, void *ctx) {
  const struct force_curve *curve = ctx;
  double q[LAW_SIZE], v[LAW_SIZE];
  for (int k = 0; k < LAW_SIZE; k++) {
    q[k] = curve->scene->q[k] + s * curve->dq[k];
    v[k] = curve->scene->v[k] + s * curve->dv[k];
  }
  check_ok(hooke_system_force(curve->scene->system, LAW_TIME, q, v, value));
}

static void draw_direction(struct random_source *source, double size, double *direction) {
  for (int k = 0; k < LAW_SIZE; k++)
    direction[k] = size * random_between(source, -1.0, 1.0);
}

static void compare_product(const struct law_scene *scene, const double *dq, const double *dv, double least) {
  double expected[LAW_SIZE], product[LAW_SIZE];
  struct force_curve curve = {scene, dq, dv};
  differentiate(LAW_SIZE, force_along, 0.01, &curve, expected);
  check_ok(hooke_system_derivative_product(scene->system, LAW_TIME, scene->q, scene->v, dq, dv, product));
  const double size = largest(LAW_SIZE, expected);
  check_between(size, least, 1e4);
  for (int k = 0; k < LAW_SIZE; k++)
    check_close(product[k], expected[k], 1e-8 * size);
}

TEST(test_products) {
  const double zero[LAW_SIZE] = {0};
  for (int k = 0; k < LAW_COUNT; k++) {
    for (uint64_t seed = 1; seed <= 4; seed++) {
      owned_law_scene scene;
      struct random_source source = {seed + 100};
      double dq[LAW_SIZE], dv[LAW_SIZE];
      law_scene_create(&laws[k], seed, &scene);
      draw_direction(&source, 1.0, dq);
      draw_direction(&source, 1.0, dv);
      compare_product(&scene, dq, zero, 0.1);
      compare_product(&scene, zero, dv, laws[k].damped ? 0.1 : 0.0);
      compare_product(&scene, dq, dv, 0.1);
    }
  }
}

/* ---- blocks ---- */

struct blocks {
  int64_t n, count;
  int64_t *row_start, *column;
  double *dfdq, *dfdv;
};

static void take_blocks(const struct law_scene *scene, struct blocks *blocks) {
  blocks->n = LAW_PARTICLES;
  blocks->count = hooke_system_count(scene->system, "blocks");
  assert_true(blocks->count >= blocks->n && blocks->count <= blocks->n + 2 * LAW_SPRINGS + 6 * LAW_TRIPLES);
  blocks->row_start = new_block(blocks->n + 1, (int64_t)sizeof(int64_t));
  blocks->column = new_block(blocks->count, (int64_t)sizeof(int64_t));
  blocks->dfdq = new_doubles(9 * blocks->count);
  blocks->dfdv = new_doubles(9 * blocks->count);
  check_ok(hooke_system_derivative_pattern(scene->system, blocks->row_start, blocks->column));
  check_ok(hooke_system_derivative_blocks_at(scene->system, LAW_TIME, scene->q, scene->v, blocks->dfdq,
                                             blocks->dfdv));
}

static void release_blocks(struct blocks *blocks) {
  free(blocks->row_start);
  free(blocks->column);
  free(blocks->dfdq);
  free(blocks->dfdv);
}

static void dense(const struct blocks *blocks, const double *values, double *matrix) {
  memset(matrix, 0, LAW_SIZE * LAW_SIZE * sizeof(double));
  for (int64_t row = 0; row < blocks->n; row++) {
    for (int64_t b = blocks->row_start[row]; b < blocks->row_start[row + 1]; b++) {
      for (int64_t k = 0; k < 9; k++) {
        matrix[(3 * row + k / 3) * LAW_SIZE + 3 * blocks->column[b] + k % 3] = values[9 * b + k];
      }
    }
  }
}

TEST(test_pattern) {
  owned_law_scene scene;
  owned(release_blocks) struct blocks blocks;
  law_scene_create(&laws[0], 9, &scene);
  take_blocks(&scene, &blocks);
  assert_int_equal(blocks.row_start[0], 0);
  assert_int_equal(blocks.row_start[blocks.n], blocks.count);
  for (int64_t row = 0; row < blocks.n; row++) {
    int diagonal = 0;
    for (int64_t b = blocks.row_start[row]; b < blocks.row_start[row + 1]; b++) {
      assert_true(blocks.column[b] >= 0 && blocks.column[b] < blocks.n);
      if (b > blocks.row_start[row]) assert_true(blocks.column[b] > blocks.column[b - 1]);
      diagonal += blocks.column[b] == row;
    }
    assert_int_equal(diagonal, 1);
  }
}

/* Blocks times unit vectors are the products with unit vectors; contributions of a callback are in the
 * products only. */
TEST(test_blocks_are_products) {
  const double zero[LAW_SIZE] = {0};
  for (int k = 0; k < LAW_COUNT; k++) {
    /* friction by N is not symmetric, and not in blocks */
    if (laws[k].callback || (laws[k].obstacles && laws[k].damped)) continue;
    owned_law_scene scene;
    owned(release_blocks) struct blocks blocks;
    double unit[LAW_SIZE], product[LAW_SIZE], *matrix = new_doubles(LAW_SIZE * LAW_SIZE);
    law_scene_create(&laws[k], 21, &scene);
    take_blocks(&scene, &blocks);
    for (int which = 0; which < 2; which++) {
      dense(&blocks, which ? blocks.dfdv : blocks.dfdq, matrix);
      const double size = largest(LAW_SIZE * LAW_SIZE, matrix);
      if (which == 0 || laws[k].damped || laws[k].drag)
        assert_true(size > 0.1);
      else
        assert_true(size == 0.0);
      for (int c = 0; c < LAW_SIZE; c++) {
        memset(unit, 0, sizeof unit);
        unit[c] = 1.0;
        check_ok(hooke_system_derivative_product(scene.system, LAW_TIME, scene.q, scene.v,
                                                 which ? zero : unit, which ? unit : zero, product));
        for (int row = 0; row < LAW_SIZE; row++) {
          check_close(matrix[row * LAW_SIZE + c], product[row], 1e-13 * size);
        }
      }
    }
    /* either array may be left out */
    owned_doubles *again = new_doubles(9 * blocks.count);
    check_ok(hooke_system_derivative_blocks_at(scene.system, LAW_TIME, scene.q, scene.v, again, NULL));
    check_same_bits(9 * blocks.count, again, blocks.dfdq);
    check_ok(hooke_system_derivative_blocks_at(scene.system, LAW_TIME, scene.q, scene.v, NULL, again));
    check_same_bits(9 * blocks.count, again, blocks.dfdv);
    free(matrix);
  }
}

TEST(test_callback_is_not_in_blocks) {
  struct law with = laws[9], without = laws[9];
  without.callback = 0;
  assert_int_equal(with.callback, 1);
  struct law_scene one, other;
  struct blocks a, b;
  law_scene_create(&with, 4, &one);
  law_scene_create(&without, 4, &other);
  take_blocks(&one, &a);
  take_blocks(&other, &b);
  assert_int_equal(a.count, b.count);
  check_same_bits(9 * a.count, a.dfdq, b.dfdq);
  check_same_bits(9 * a.count, a.dfdv, b.dfdv);
  release_blocks(&a);
  release_blocks(&b);
  law_scene_destroy(&one);
  law_scene_destroy(&other);
}

static double asymmetry(const double *matrix) {
  double most = 0.0;
  for (int r = 0; r < LAW_SIZE; r++) {
    for (int c = 0; c < r; c++) {
      const double difference = fabs(matrix[r * LAW_SIZE + c] - matrix[c * LAW_SIZE + r]);
      if (difference > most) most = difference;
    }
  }
  return most;
}

/* D is symmetric always, K unless a damped spring rotates. */
TEST(test_symmetry) {
  for (int k = 0; k < LAW_COUNT; k++) {
    owned_law_scene scene;
    owned(release_blocks) struct blocks blocks;
    owned_doubles *matrix = new_doubles(LAW_SIZE * LAW_SIZE);
    law_scene_create(&laws[k], 31, &scene);
    take_blocks(&scene, &blocks);
    dense(&blocks, blocks.dfdv, matrix);
    check_between(asymmetry(matrix), 0.0, 1e-14 * largest(LAW_SIZE * LAW_SIZE, matrix));
    dense(&blocks, blocks.dfdq, matrix);
    const double size = largest(LAW_SIZE * LAW_SIZE, matrix);
    if (laws[k].damped)
      check_between(asymmetry(matrix), 1e-3 * size, 10.0 * size);
    else
      check_between(asymmetry(matrix), 0.0, 1e-14 * size);
  }
}
