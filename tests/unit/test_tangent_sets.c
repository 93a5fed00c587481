/* Every instruction set of this machine gives the bits of plain loops in the derivatives of springs. */
#include "check.h"
#include "random.h"

#include "kernel/spring/spring_loops.h"
#include "kernel/spring/tangent_loops.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 700, PARTICLES = 1500, BLOCKS = 6 };
static const double ALPHA = 0.3, BETA = 0.7;

/* Output of the loops: u, e and b by springs, then the part of them that the diagonal has, then a product,
 * damping and blocks by particles. */
struct found {
  double numbers[7][LONGEST], projected[7][LONGEST], product[3][PARTICLES], damping[3][PARTICLES],
      block[BLOCKS][PARTICLES];
};

struct trial {
  double q[3][PARTICLES], v[3][PARTICLES], kappas[LONGEST], gammas[LONGEST], rest_lengths[LONGEST];
  int32_t head[LONGEST], tail[LONGEST], slot[LONGEST];
  struct hk_run run;
  int axial;
  struct found begin; /* sums start from these */
};

static void draw_numbers(struct random_source *source, int64_t count, double *x) {
  for (int64_t k = 0; k < count; k++)
    x[k] = random_between(source, -1.0, 1.0);
}

static void draw_run(struct random_source *source, int32_t shape, int64_t count, struct trial *trial) {
  struct hk_run *run = &trial->run;
  const int32_t far =
      (int32_t)random_whole(source, 1, random_whole(source, 0, 1) ? 3 : PARTICLES - count - 1);
  const int32_t down = (int32_t)random_whole(source, 0, 1);
  *run =
      (struct hk_run){.count = count,
                      .shape = shape,
                      .offset = down ? -far : far,
                      .start = (int32_t)random_whole(source, 0, PARTICLES - count - far) + (down ? far : 0),
                      .head = trial->head,
                      .tail = trial->tail,
                      .kappas = trial->kappas,
                      .gammas = trial->gammas,
                      .rest_lengths = trial->rest_lengths,
                      .kappa = random_between(source, 0.0, 100.0),
                      .gamma = random_between(source, 0.0, 10.0),
                      .rest_length = random_whole(source, 0, 4) ? random_between(source, 0.0, 2.0) : 0.0};
  const int32_t kind = (int32_t)random_whole(source, 0, 3);
  if (!(shape & HOOKE_RUN_MIXED)) return;
  if (kind == 1) run->slot = trial->slot;
  if (kind > 1) run->kappas = run->gammas = NULL;
  run->strain = kind == 3;
  for (int64_t k = 0; k < count && run->strain; k++)
    trial->rest_lengths[k] += 0.1;
}

static void draw(struct random_source *source, int32_t shape, int64_t count, struct trial *trial) {
  for (int a = 0; a < 3; a++) {
    draw_numbers(source, PARTICLES, trial->q[a]);
    draw_numbers(source, PARTICLES, trial->v[a]);
  }
  for (int p = 1; p < PARTICLES; p++) {
    for (int a = 0; a < 3 && p % 17 == 0; a++)
      trial->q[a][p] = trial->q[a][p - 1]; /* coincident ends, if they are neighbours */
  }
  for (int64_t k = 0; k < count; k++) {
    trial->head[k] = (int32_t)random_whole(source, 0, PARTICLES - 1);
    trial->tail[k] = (int32_t)((trial->head[k] + random_whole(source, 1, PARTICLES - 1)) % PARTICLES);
    trial->slot[k] = (int32_t)(count - 1 - k);
    trial->kappas[k] = random_between(source, 0.0, 100.0);
    trial->gammas[k] = random_between(source, 0.0, 10.0);
    trial->rest_lengths[k] = random_whole(source, 0, 4) ? random_between(source, 0.0, 2.0) : 0.0;
  }
  draw_run(source, shape, count, trial);
  trial->axial = random_whole(source, 0, 1) != 0;
  memset(&trial->begin, 0, sizeof trial->begin);
  draw_numbers(source, 12 * PARTICLES, trial->begin.product[0]);
}

/* ---- plain loops ---- */

static void ends_of(const struct hk_run *run, int64_t k, int64_t *i, int64_t *j) {
  const int indexed = run->shape & HOOKE_RUN_INDEXED;
  *i = indexed ? run->head[k] : run->start + k;
  *j = indexed ? run->tail[k] : *i + run->offset;
}

static void fill_one(const struct trial *trial, int64_t k, double *u, double *e, double *b) {
  const int pull = trial->run.shape & HOOKE_RUN_PULL_ONLY;
  const struct hk_material m = hk_run_material(&trial->run, k);
  int64_t i, j;
  double d[3], w[3];
  ends_of(&trial->run, k, &i, &j);
  for (int a = 0; a < 3; a++)
    d[a] = trial->q[a][i] - trial->q[a][j], w[a] = trial->v[a][i] - trial->v[a][j];
  const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]), ir = r > 0.0 ? 1.0 / r : 0.0;
  const double rate = ((w[0] * d[0] + w[1] * d[1]) + w[2] * d[2]) * ir;
  const double tension = m.kappa * (r - m.rest_length) + m.gamma * rate;
  const double taut = pull && (r <= m.rest_length || tension < 0.0) ? 0.0 : 1.0;
  const double isotropic = m.rest_length == 0.0 && !pull ? m.kappa : 0.0;
  *b = r > 0.0 ? ALPHA * taut * tension * ir : ALPHA * isotropic;
  const double along = taut * (ALPHA * m.kappa + BETA * m.gamma) - *b, turning = taut * ALPHA * m.gamma * ir;
  for (int a = 0; a < 3; a++) {
    u[a] = trial->axial ? taut * sqrt(BETA * m.gamma) * ir * d[a] : taut * d[a] * ir;
    e[a] = trial->axial ? u[a] : along * u[a] + turning * (w[a] - rate * u[a]);
  }
  if (trial->axial) *b = 0.0;
}

/* The first ends of a block of springs come before their second ends. */
static void add_products(const struct trial *trial, struct found *found) {
  const int indexed = trial->run.shape & HOOKE_RUN_INDEXED;
  static double b[3][LONGEST];
  for (int64_t k = 0; k < trial->run.count; k++) {
    int64_t i, j;
    double d[3];
    ends_of(&trial->run, k, &i, &j);
    for (int a = 0; a < 3; a++)
      d[a] = trial->v[a][i] - trial->v[a][j];
    const double *const e[3] = {found->numbers[3], found->numbers[4], found->numbers[5]};
    const double along = (e[0][k] * d[0] + e[1][k] * d[1]) + e[2][k] * d[2];
    for (int a = 0; a < 3; a++) {
      b[a][k] = along * found->numbers[a][k];
      if (!trial->axial) b[a][k] += found->numbers[6][k] * d[a];
    }
  }
  const int64_t size = indexed ? 1 : HOOKE_TANGENT_BLOCK;
  for (int64_t from = 0; from < trial->run.count; from += size) {
    for (int second = 0; second < 2; second++) {
      for (int64_t k = from; k < from + size && k < trial->run.count; k++) {
        int64_t end[2];
        ends_of(&trial->run, k, &end[0], &end[1]);
        for (int a = 0; a < 3; a++)
          found->product[a][end[second]] += second ? -b[a][k] : b[a][k];
      }
    }
  }
}

static void add_others(const struct trial *trial, struct found *found) {
  static const int row[BLOCKS] = {0, 1, 2, 0, 0, 1}, column[BLOCKS] = {0, 1, 2, 1, 2, 2};
  for (int64_t k = 0; k < trial->run.count; k++) {
    int64_t i, j;
    ends_of(&trial->run, k, &i, &j);
    double u[3], e[3], d[3];
    for (int a = 0; a < 3; a++) {
      u[a] = found->numbers[a][k], e[a] = found->numbers[3 + a][k];
      d[a] = trial->v[a][i] - trial->v[a][j];
    }
    const double b = found->numbers[6][k], across = b > 0.0 ? b : 0.0;
    const double along = trial->axial ? 1.0 : ((e[0] * u[0] + e[1] * u[1]) + e[2] * u[2]) + b - across;
    const double damped = hk_run_material(&trial->run, k).gamma * ((d[0] * u[0] + d[1] * u[1]) + d[2] * u[2]);
    for (int c = 0; c < BLOCKS; c++) {
      const double value = along * u[row[c]] * u[column[c]] + (c < 3 ? across : 0.0);
      found->block[c][i] += value;
      found->block[c][j] += value;
    }
    for (int a = 0; a < 3; a++) {
      found->damping[a][i] += damped * u[a];
      found->damping[a][j] -= damped * u[a];
    }
  }
}

static void project_numbers(const struct trial *trial, struct found *found) {
  for (int64_t k = 0; k < trial->run.count; k++) {
    double(*n)[LONGEST] = found->numbers, (*to)[LONGEST] = found->projected;
    const double across = n[6][k] > 0.0 ? n[6][k] : 0.0;
    const double along = ((n[3][k] * n[0][k] + n[4][k] * n[1][k]) + n[5][k] * n[2][k]) + n[6][k] - across;
    for (int a = 0; a < 3; a++)
      to[a][k] = n[a][k], to[3 + a][k] = (along > 0.0 ? along : 0.0) * n[a][k];
    to[6][k] = across;
  }
}

/* ---- by an instruction set ---- */

static void compare_set(const struct hk_tangent_set *set, const struct trial *trial,
                        const struct found *expected) {
  static struct found found;
  found = trial->begin;
  double(*n)[LONGEST] = found.numbers;
  struct hk_tangent tangent = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]};
  if (trial->axial) tangent = (struct hk_tangent){{n[0], n[1], n[2]}, {n[0], n[1], n[2]}, NULL};
  const struct hk_fields fields = {
      {trial->q[0], trial->q[1], trial->q[2]}, {trial->v[0], trial->v[1], trial->v[2]}, {NULL}};
  set->tangent_fill(&trial->run, &fields, ALPHA, BETA, &tangent);
  set->tangent_product(&trial->run, &tangent, fields.v,
                       (double *[3]){found.product[0], found.product[1], found.product[2]});
  set->tangent_damping(&trial->run, &tangent, fields.v,
                       (double *[3]){found.damping[0], found.damping[1], found.damping[2]});
  set->tangent_diagonal(&trial->run, &tangent,
                        (double *[BLOCKS]){found.block[0], found.block[1], found.block[2], found.block[3],
                                           found.block[4], found.block[5]});
  for (int c = 0; c < (trial->axial ? 3 : 7); c++)
    check_same_bits(trial->run.count, found.numbers[c], expected->numbers[c]);
  if (!trial->axial) set->tangent_project(trial->run.count, &tangent);
  for (int c = 0; c < 7 && !trial->axial; c++)
    check_same_bits(trial->run.count, found.numbers[c], expected->projected[c]);
  check_same_bits(12 * PARTICLES, found.product[0], expected->product[0]);
}

TEST(springs) {
  static struct trial trial;
  static struct found expected;
  struct random_source source = {23};
  const struct hk_spring_set *set;
  for (int round = 0; round < 640; round++) {
    const int64_t count = random_whole(&source, 1, round % 3 ? 40 : LONGEST);
    draw(&source, round % HOOKE_RUN_SHAPES, count, &trial);
    expected = trial.begin;
    for (int64_t k = 0; k < count; k++) {
      double u[3], e[3];
      fill_one(&trial, k, u, e, &expected.numbers[6][k]);
      for (int a = 0; a < 3; a++)
        expected.numbers[a][k] = u[a], expected.numbers[3 + a][k] = e[a];
    }
    add_products(&trial, &expected);
    add_others(&trial, &expected);
    project_numbers(&trial, &expected);
    for (int32_t k = 0; (set = hk_spring_set(k)) != NULL; k++)
      compare_set(set->tangent, &trial, &expected);
  }
}

/* ---- the product with the derivative ---- */

static double dot(const double *a, const double *b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* A change of v in positions and of q in velocities. */
static void change_one(const struct trial *trial, int64_t k, double change[3]) {
  const int pull = trial->run.shape & HOOKE_RUN_PULL_ONLY;
  const struct hk_material m = hk_run_material(&trial->run, k);
  int64_t i, j;
  double d[3], w[3], u[3], c[3];
  ends_of(&trial->run, k, &i, &j);
  for (int a = 0; a < 3; a++)
    d[a] = trial->q[a][i] - trial->q[a][j], w[a] = trial->v[a][i] - trial->v[a][j];
  const double r = sqrt(dot(d, d)), rate = r > 0.0 ? dot(w, d) * (1.0 / r) : 0.0;
  const double tension = m.kappa * (r - m.rest_length) + m.gamma * rate;
  for (int a = 0; a < 3; a++)
    change[a] = m.rest_length == 0.0 && !pull ? m.kappa * w[a] : 0.0;
  if (r == 0.0) return;
  for (int a = 0; a < 3; a++) {
    u[a] = d[a] * (1.0 / r);
    c[a] = m.kappa * u[a] + m.gamma * (w[a] - rate * u[a]) / r;
  }
  const double force = dot(c, w) + m.gamma * dot(u, d), along = dot(u, w);
  const int slack = pull && (r <= m.rest_length || tension < 0.0);
  for (int a = 0; a < 3; a++)
    change[a] = slack ? 0.0 : force * u[a] + tension / r * (w[a] - along * u[a]);
}

TEST(derivatives) {
  static struct trial trial;
  static double q[3 * PARTICLES], v[3 * PARTICLES], expected[3 * PARTICLES], found[3 * PARTICLES];
  const struct hk_derivative_rows rows = {q, v, v, q, found};
  struct random_source source = {24};
  const struct hk_spring_set *set;
  for (int round = 0; round < 320; round++) {
    draw(&source, round % HOOKE_RUN_SHAPES, random_whole(&source, 1, round % 3 ? 40 : LONGEST), &trial);
    for (int k = 0; k < 3 * PARTICLES; k++) {
      q[k] = trial.q[k % 3][k / 3], v[k] = trial.v[k % 3][k / 3];
      expected[k] = trial.begin.product[k % 3][k / 3];
    }
    for (int64_t k = 0; k < trial.run.count; k++) {
      int64_t i, j;
      double change[3];
      ends_of(&trial.run, k, &i, &j);
      change_one(&trial, k, change);
      for (int a = 0; a < 3; a++)
        expected[3 * i + a] -= change[a], expected[3 * j + a] += change[a];
    }
    for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
      for (int k = 0; k < 3 * PARTICLES; k++)
        found[k] = trial.begin.product[k % 3][k / 3];
      set->derivative(&trial.run, &rows);
      check_same_bits(3 * PARTICLES, found, expected);
    }
  }
}
