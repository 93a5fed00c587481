/* Every instruction set of this machine gives the same bits, for every shape of run and of tiled batches. */
#include "check.h"
#include "random.h"

#include "core/memory.h"
#include "kernel/spring/spring_body.h"
#include "kernel/spring/tiled_loops.h"
#include "kernel/spring/spring_loops.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 800, PARTICLES = 1000 };

struct trial {
  double q[3][PARTICLES], v[3][PARTICLES], f[3][PARTICLES];
  int32_t head[LONGEST], tail[LONGEST];
  double kappas[LONGEST], gammas[LONGEST], rest_lengths[LONGEST];
  struct hk_run run;
};

static void draw(struct random_source *source, int32_t shape, int64_t count, struct trial *trial) {
  memset(trial, 0, sizeof *trial);
  for (int p = 0; p < PARTICLES; p++) {
    const int copy = p > 0 && random_whole(source, 0, 9) == 0; /* coincident ends, if they are neighbours */
    for (int a = 0; a < 3; a++) {
      trial->q[a][p] = copy ? trial->q[a][p - 1] : random_between(source, -1.0, 1.0);
      trial->v[a][p] = random_between(source, -1.0, 1.0);
      trial->f[a][p] = random_between(source, -1.0, 1.0); /* initial forces */
    }
  }
  for (int64_t k = 0; k < count; k++) {
    trial->head[k] = (int32_t)random_whole(source, 0, PARTICLES - 1);
    trial->tail[k] = (int32_t)((trial->head[k] + random_whole(source, 1, PARTICLES - 1)) % PARTICLES);
    trial->kappas[k] = random_between(source, 0.0, 100.0);
    trial->gammas[k] = random_between(source, 0.0, 10.0);
    trial->rest_lengths[k] = random_whole(source, 0, 4) ? random_between(source, 0.0, 2.0) : 0.0;
  }
  struct hk_run *run = &trial->run;
  run->shape = shape;
  run->count = count;
  const int32_t distance =
      (int32_t)random_whole(source, 1, random_whole(source, 0, 1) ? 3 : PARTICLES - count - 1);
  run->offset = random_whole(source, 0, 1) ? distance : -distance;
  run->start =
      (int32_t)random_whole(source, 0, PARTICLES - count - distance) + (run->offset < 0 ? distance : 0);
  run->head = trial->head;
  run->tail = trial->tail;
  run->kappas = trial->kappas;
  run->gammas = trial->gammas;
  run->rest_lengths = trial->rest_lengths;
  run->kappa = random_between(source, 0.0, 100.0);
  run->gamma = random_between(source, 0.0, 10.0);
  run->rest_length = random_whole(source, 0, 4) ? random_between(source, 0.0, 2.0) : 0.0;
}

/* One spring at a time, as in the definition. */
static int64_t plain(const struct trial *trial, double f[3][PARTICLES]) {
  const struct hk_run *run = &trial->run;
  int64_t lost = 0;
  for (int64_t k = 0; k < run->count; k++) {
    const int indexed = run->shape & HOOKE_RUN_INDEXED, mixed = run->shape & HOOKE_RUN_MIXED;
    const int64_t i = indexed ? run->head[k] : run->start + k, j = indexed ? run->tail[k] : i + run->offset;
    const double kappa = mixed ? run->kappas[k] : run->kappa, gamma = mixed ? run->gammas[k] : run->gamma;
    const double l0 = mixed ? run->rest_lengths[k] : run->rest_length;
    double d[3], u[3];
    for (int a = 0; a < 3; a++)
      d[a] = trial->q[a][i] - trial->q[a][j], u[a] = trial->v[a][i] - trial->v[a][j];
    const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
    const double ir = r > 0.0 ? 1.0 / r : 0.0;
    double tension = kappa * (r - l0);
    if (run->shape & HOOKE_RUN_DAMPED) tension += gamma * (((u[0] * d[0] + u[1] * d[1]) + u[2] * d[2]) * ir);
    if ((run->shape & HOOKE_RUN_PULL_ONLY) && (r <= l0 || tension < 0.0)) tension = 0.0;
    const double s = tension * ir;
    for (int a = 0; a < 3; a++) {
      f[a][i] += -s * d[a];
      f[a][j] -= -s * d[a];
    }
    lost += (r < l0 / 2.0) + (r == 0.0 && l0 != 0.0 ? HOOKE_LOST : 0);
  }
  return lost;
}

static void compare_sets(struct random_source *source, int32_t shape, int64_t count, struct trial *trial) {
  double expected[3][PARTICLES], found[3][PARTICLES];
  draw(source, shape, count, trial);
  memcpy(expected, trial->f, sizeof expected);
  const int64_t lost = plain(trial, expected);
  const struct hk_spring_set *set;
  for (int32_t k = 0; (set = hk_spring_set(k)) != NULL; k++) {
    memcpy(found, trial->f, sizeof found);
    const struct hk_fields fields = {{trial->q[0], trial->q[1], trial->q[2]},
                                     {trial->v[0], trial->v[1], trial->v[2]},
                                     {found[0], found[1], found[2]}};
    assert_non_null(set->loop[shape]);
    assert_int_equal(set->loop[shape](&trial->run, &fields), lost);
    for (int a = 0; a < 3; a++)
      check_same_bits(PARTICLES, found[a], expected[a]);
  }
}

/* ---- strided batches ---- */

enum {
  UNITS = 40,
  STRIDED_PARTICLES = UNITS * HOOKE_STRIDED_UNIT,
  FARTHEST = 100,
  ROOM = STRIDED_PARTICLES + FARTHEST + 32
};

/* Springs of some random strided batches, and their rings. */
struct lane_trial {
  struct hk_strided_pass pass;
  double q[3][ROOM], v[3][ROOM], w[ROOM], f[3][ROOM], half[3][ROOM], start[6][ROOM], sum[6][ROOM];
  double material[HOOKE_MOST_STRIDED][HOOKE_STRIDED_NUMBERS * STRIDED_PARTICLES];
  uint32_t unit[HOOKE_MOST_STRIDED][HOOKE_STRIDED_NUMBERS * UNITS];
  uint8_t present[HOOKE_MOST_STRIDED][UNITS];
  _Alignas(64) double ring[HOOKE_MOST_STRIDED][3 * (256 + 3 * HOOKE_STRIDED_UNIT)];
};

/* Each unit has values of its own, in any order, or those of another one. */
static void draw_lane_material(struct random_source *source, int32_t k, struct lane_trial *trial) {
  struct hk_strided_view *batch = &trial->pass.batch[k];
  const int mixed = batch->shape & HOOKE_RUN_MIXED;
  for (int i = 0; i < HOOKE_STRIDED_NUMBERS * STRIDED_PARTICLES; i++)
    trial->material[k][i] = random_between(source, 0.1, 2.0);
  for (int i = 0; i < HOOKE_STRIDED_NUMBERS * UNITS; i++)
    trial->unit[k][i] =
        (uint32_t)(HOOKE_STRIDED_UNIT * random_whole(source, 0, HOOKE_STRIDED_NUMBERS * UNITS - 1));
  batch->material = (struct hk_strided_material){trial->material[k], trial->unit[k], mixed ? -1 : 0,
                                                 random_whole(source, 0, 1) ? HOOKE_STRIDED_UNIT : 0};
  for (int j = 0; j < HOOKE_STRIDED_NUMBERS && !mixed; j++) {
    double *value = trial->material[k] + trial->unit[k][j];
    const int zero = j == HOOKE_STRIDED_REST && random_whole(source, 0, 3) == 0;
    for (int i = HOOKE_STRIDED_UNIT - 1; i >= 0; i--)
      value[i] = zero ? 0.0 : value[0];
    batch->shared[j] = value[0];
  }
  for (int j = 0; j < HOOKE_STRIDED_NUMBERS && !mixed; j++)
    batch->shared[j] = *hk_strided_number(&batch->material, 0, j); /* two may coincide */
}

static void draw_lane(struct random_source *source, int32_t k, int32_t shape, struct lane_trial *trial) {
  struct hk_strided_view *batch = &trial->pass.batch[k];
  *batch =
      (struct hk_strided_view){.shape = shape,
                               .present = trial->present[k],
                               .offset = random_whole(source, 1, random_whole(source, 0, 1) ? 9 : FARTHEST),
                               .mask = 63,
                               .ring = trial->ring[k]};
  while (batch->mask + 1 < batch->offset + HOOKE_RING_SLACK)
    batch->mask = 2 * batch->mask + 1;
  draw_lane_material(source, k, trial);
  memset(trial->ring[k], 0, sizeof trial->ring[k]);
  memset(trial->present[k], 0, sizeof trial->present[k]);
  for (int64_t l = 0; l + batch->offset < STRIDED_PARTICLES; l++) {
    if (random_whole(source, 0, 9)) trial->present[k][l / 8] |= (uint8_t)(1 << l % 8);
  }
}

/* The items of all strided batches in random order, or in the order of batches. */
static void draw_items(struct random_source *source, struct lane_trial *trial) {
  struct hk_strided_item *item = trial->pass.item;
  const int any = random_whole(source, 0, 1) == 0;
  for (int32_t i = 0; i < 2 * trial->pass.count; i++) {
    const struct hk_strided_view *batch = &trial->pass.batch[i / 2];
    const int64_t place = any ? random_whole(source, 0, i) : i;
    item[i] = item[place];
    item[place] = (struct hk_strided_item){batch->ring, i % 2 ? 0 : batch->offset, batch->mask};
  }
}

/* A motion, any move of it, and numbers where a move writes. */
static void draw_motion(struct random_source *source, struct lane_trial *trial) {
  for (int p = 0; p < ROOM; p++) {
    const int copy = p > 0 && random_whole(source, 0, 30) == 0; /* coincides with its neighbour */
    for (int a = 0; a < 3; a++) {
      trial->q[a][p] = copy ? trial->q[a][p - 1] : random_between(source, -1.0, 1.0);
      trial->v[a][p] = random_between(source, -1.0, 1.0);
      trial->half[a][p] = random_between(source, -1.0, 1.0);
      trial->f[a][p] = random_between(source, -1.0, 1.0);
    }
    for (int a = 0; a < 6; a++)
      trial->start[a][p] = random_between(source, -1.0, 1.0),
      trial->sum[a][p] = random_between(source, -1.0, 1.0);
    trial->w[p] = random_between(source, 0.5, 2.0);
  }
  trial->pass.move = (struct hk_move){.kind = (int32_t)random_whole(source, 0, HOOKE_MOVES - 1),
                                      .heavy = (int32_t)random_whole(source, 0, 1),
                                      .kick = 0.01,
                                      .drift = 0.02,
                                      .drag = random_whole(source, 0, 1) ? 0.3 : 0.0,
                                      .gravity = {0.0, -9.81, 0.1}};
}

/* The same motion in arrays of its own. */
static void copy_motion(const struct lane_trial *from, struct lane_trial *to) {
  *to = *from;
  to->pass.q = to->q[0], to->pass.v = to->v[0], to->pass.w = to->w;
  to->pass.move.stride = ROOM;
  to->pass.move.f = to->f[0], to->pass.move.half = to->half[0];
  to->pass.move.start = to->start[0], to->pass.move.sum = to->sum[0];
}

static void check_same_motion(const struct lane_trial *found, const struct lane_trial *expected) {
  for (int a = 0; a < 3; a++) {
    check_same_bits(ROOM, found->q[a], expected->q[a]);
    check_same_bits(ROOM, found->v[a], expected->v[a]);
    check_same_bits(ROOM, found->f[a], expected->f[a]);
    check_same_bits(ROOM, found->half[a], expected->half[a]);
  }
  check_same_bits(6 * ROOM, found->start[0], expected->start[0]);
  check_same_bits(6 * ROOM, found->sum[0], expected->sum[0]);
}

static void draw_lanes(struct random_source *source, struct lane_trial *trial) {
  const int32_t shape = HOOKE_RUN_DAMPED * (int32_t)random_whole(source, 0, 1);
  struct hk_strided_pass *pass = &trial->pass;
  *pass = (struct hk_strided_pass){.count = (int32_t)random_whole(source, 1, 12),
                                   .stride = ROOM,
                                   .q = trial->q[0],
                                   .v = trial->v[0],
                                   .w = trial->w};
  draw_motion(source, trial);
  for (int32_t k = 0; k < pass->count; k++) {
    const int32_t other = 2 * (int32_t)random_whole(source, 0, HOOKE_RUN_SHAPES / 2 - 1);
    draw_lane(source, k, random_whole(source, 0, 1) ? shape : other, trial);
  }
  draw_items(source, trial);
}

/* Forces of a strided batch on the upper ends of its springs, one spring at a time. */
static int64_t find_plainly(const struct lane_trial *trial, int32_t k, double (*b)[STRIDED_PARTICLES]) {
  const struct hk_strided_view *batch = &trial->pass.batch[k];
  static struct trial one;
  static double f[3][PARTICLES];
  int64_t lost = 0;
  one.run =
      (struct hk_run){.count = 1, .shape = batch->shape & ~HOOKE_RUN_MIXED, .offset = (int32_t)batch->offset};
  for (int64_t l = 0; l < STRIDED_PARTICLES; l++) {
    if (!(trial->present[k][l / 8] >> l % 8 & 1)) continue;
    one.run.kappa = *hk_strided_number(&batch->material, l, HOOKE_STRIDED_KAPPA);
    one.run.gamma = *hk_strided_number(&batch->material, l, HOOKE_STRIDED_GAMMA);
    one.run.rest_length = *hk_strided_number(&batch->material, l, HOOKE_STRIDED_REST);
    for (int a = 0; a < 3; a++) {
      one.q[a][0] = trial->q[a][l], one.q[a][batch->offset] = trial->q[a][l + batch->offset];
      one.v[a][0] = trial->v[a][l], one.v[a][batch->offset] = trial->v[a][l + batch->offset];
      f[a][0] = f[a][batch->offset] = 0.0;
    }
    lost += plain(&one, f);
    for (int a = 0; a < 3; a++)
      b[a][l] = f[a][batch->offset];
  }
  return lost;
}

/* Item by item. */
static int64_t sum_plainly(const struct lane_trial *trial, double (*sum)[STRIDED_PARTICLES]) {
  static double b[HOOKE_MOST_STRIDED][3][STRIDED_PARTICLES];
  int64_t lost = 0;
  memset(b, 0, sizeof b);
  for (int32_t k = 0; k < trial->pass.count; k++)
    lost += find_plainly(trial, k, b[k]);
  for (int32_t i = 0; i < 2 * trial->pass.count; i++) {
    const struct hk_strided_item *item = &trial->pass.item[i];
    int32_t k = 0;
    while (trial->ring[k] != item->ring)
      k++;
    for (int64_t p = item->offset; p < STRIDED_PARTICLES; p++) {
      for (int a = 0; a < 3; a++)
        sum[a][p] = item->offset ? sum[a][p] + b[k][a][p - item->offset] : sum[a][p] - b[k][a][p];
    }
  }
  return lost;
}

static double rate_of(const struct lane_trial *trial, int a, int p, double f, double drag, double u) {
  const struct hk_move *move = &trial->pass.move;
  if (drag > 0.0) f -= drag * u;
  return move->heavy ? trial->w[p] * f + move->gravity[a] : trial->w[p] * f;
}

static void move_stage_plainly(const struct hk_move *move, double rate, double *x, double *start,
                               double *sum) {
  if (move->kind == HOOKE_FIRST_STAGE) {
    *start = *x;
    *sum = rate;
    *x = *start + move->kick * rate;
  } else if (move->kind == HOOKE_MIDDLE_STAGE) {
    *sum += 2.0 * rate;
    *x = *start + move->kick * rate;
  } else {
    *x = *start + move->kick * (*sum + rate);
  }
}

/* One number at a time. */
static void move_one(struct lane_trial *trial, int a, int p, double f) {
  const struct hk_move *move = &trial->pass.move;
  const int32_t kind = move->kind;
  double *q = &trial->q[a][p], *v = &trial->v[a][p], *half = &trial->half[a][p], u = *v;
  const double rate = rate_of(trial, a, p, f, move->drag, u);
  if (kind == HOOKE_MOVE_KEEP || kind == HOOKE_KICK) trial->f[a][p] = f;
  if (kind == HOOKE_KICK_THEN_DRIFT || kind == HOOKE_DRIFT_THEN_KICK) {
    *v += move->kick * rate;
    *q += move->drift * (kind == HOOKE_KICK_THEN_DRIFT ? *v : u);
  } else if (kind == HOOKE_PREDICT) {
    *half = u + move->kick * rate;
    *q += move->drift * *half;
    *v = *half + move->kick * rate;
  } else if (kind == HOOKE_CORRECT || kind == HOOKE_KICK || kind == HOOKE_KICK_DRIFT_KICK) {
    *v = (kind == HOOKE_CORRECT ? *half : u) + move->kick * rate_of(trial, a, p, f, 0.0, 0.0);
    if (move->drag > 0.0) *v /= 1.0 + move->kick * move->drag * trial->w[p];
  } else if (kind >= HOOKE_FIRST_STAGE) {
    move_stage_plainly(move, u, q, &trial->start[a][p], &trial->sum[a][p]);
    move_stage_plainly(move, rate, v, &trial->start[3 + a][p], &trial->sum[3 + a][p]);
  }
  if (kind != HOOKE_KICK_DRIFT_KICK) return;
  *v += move->kick * rate_of(trial, a, p, f, move->drag, *v);
  *q += move->drift * *v;
}

static void move_plainly(struct lane_trial *trial, int64_t from, double (*f)[STRIDED_PARTICLES]) {
  for (int a = 0; a < 3; a++) {
    for (int p = (int)from; p < STRIDED_PARTICLES; p++)
      move_one(trial, a, p, f[a][p]);
  }
}

static void use_own_rings(struct lane_trial *found, const struct lane_trial *from) {
  for (int32_t k = 0; k < found->pass.count; k++)
    found->pass.batch[k].ring = found->ring[k];
  for (int32_t i = 0; i < 2 * found->pass.count; i++)
    found->pass.item[i].ring = found->ring[0] + (from->pass.item[i].ring - from->ring[0]);
}

/* Every set, and in consecutive ranges, compared with the plain loop. */
static void compare_lanes(struct random_source *source, struct lane_trial *trial,
                          struct lane_trial *expected) {
  static double sum[3][STRIDED_PARTICLES];
  draw_lanes(source, trial);
  *expected = *trial;
  memset(sum, 0, sizeof sum);
  const int64_t lost = sum_plainly(trial, sum);
  move_plainly(expected, 0, sum);
  const struct hk_spring_set *set;
  struct lane_trial *found = new_block(1, (int64_t)sizeof *found + 64);
  for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
    int64_t at = 0, found_lost = 0;
    copy_motion(trial, found);
    use_own_rings(found, trial);
    while (at < STRIDED_PARTICLES) {
      const int64_t units = random_whole(source, 1, random_whole(source, 0, 1) ? 5 : UNITS), from = at;
      at += units * HOOKE_STRIDED_UNIT;
      if (at > STRIDED_PARTICLES) at = STRIDED_PARTICLES;
      found_lost += set->strided(&found->pass, from, at);
    }
    assert_int_equal(found_lost, lost);
    check_same_motion(found, expected);
  }
  free(found);
}

TEST(test_lanes_agree) {
  struct random_source source = {1234};
  struct lane_trial *trial = new_block(2, (int64_t)sizeof *trial);
  for (int round = 0; round < 600; round++)
    compare_lanes(&source, trial, trial + 1);
  free(trial);
}

/* Moves of whole units from any of them on, under forces that are given. */
TEST(test_moves_agree) {
  static double f[3][STRIDED_PARTICLES];
  struct random_source source = {99};
  struct lane_trial *trial = new_block(3, (int64_t)sizeof *trial), *expected = trial + 1, *found = trial + 2;
  const struct hk_spring_set *set;
  for (int round = 0; round < 20 * HOOKE_MOVES; round++) {
    draw_motion(&source, trial);
    trial->pass.move.kind = round % HOOKE_MOVES;
    for (int k = 0; k < 3 * STRIDED_PARTICLES; k++)
      f[k % 3][k / 3] = random_between(&source, -1.0, 1.0);
    const int64_t from = HOOKE_STRIDED_UNIT * random_whole(&source, 0, UNITS - 1);
    const double *const force[3] = {f[0] + from, f[1] + from, f[2] + from};
    *expected = *trial;
    move_plainly(expected, from, f);
    for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
      copy_motion(trial, found);
      const struct hk_moved moved = {found->w, found->q[0], found->v[0], ROOM};
      set->move(&found->pass.move, &moved, from, STRIDED_PARTICLES - from, force);
      check_same_motion(found, expected);
    }
  }
  free(trial);
}

/* ---- tiled batches ---- */

/* Springs of a trial whose upper ends are looked up as rows and whose lower ends are among the first rows. */
struct net_trial {
  double rows[PARTICLES][HOOKE_TILED_ROW], on_lower[HOOKE_TILED_BATCH][HOOKE_TILED_FORCE],
      on_upper[HOOKE_TILED_BATCH][HOOKE_TILED_FORCE];
  uint8_t lower[HOOKE_TILED_BATCH];
  uint16_t narrow[2 * HOOKE_TILED_BATCH];
  uint32_t wide[2 * HOOKE_TILED_BATCH];
};

static void draw_net(struct random_source *source, int32_t shape, ptrdiff_t count, struct trial *trial,
                     struct net_trial *tiled) {
  draw(source, HOOKE_RUN_INDEXED, 1, trial);
  const int32_t material = shape & HOOKE_TILED_MIXED;
  struct hk_run *run = &trial->run;
  run->count = count;
  run->shape = HOOKE_RUN_INDEXED | (shape & HOOKE_TILED_DAMPED ? HOOKE_RUN_DAMPED : 0) |
               (shape & HOOKE_TILED_PULL_ONLY ? HOOKE_RUN_PULL_ONLY : 0) | (material ? HOOKE_RUN_MIXED : 0);
  for (ptrdiff_t k = 0; k < count; k++) {
    tiled->lower[k] = (uint8_t)random_whole(source, 0, 255);
    trial->head[k] = tiled->lower[k];
    trial->tail[k] = (int32_t)(tiled->lower[k] + random_whole(source, 1, PARTICLES - 256));
    tiled->narrow[k] = (uint16_t)trial->tail[k];
    tiled->wide[k] = (uint32_t)trial->tail[k];
    trial->rest_lengths[k] = random_between(source, 0.1, 2.0);
    const double share = material == HOOKE_TILED_STRAIN ? trial->rest_lengths[k] : 1.0;
    trial->kappas[k] = material == HOOKE_TILED_MIXED ? random_between(source, 1.0, 9.0) : run->kappa / share;
    trial->gammas[k] = material == HOOKE_TILED_MIXED ? random_between(source, 1.0, 9.0) : run->gamma / share;
  }
  for (int p = 0; p < PARTICLES; p++) {
    const double row[HOOKE_TILED_ROW] = {trial->q[0][p],
                                         trial->q[1][p],
                                         trial->q[2][p],
                                         trial->v[2][p],
                                         trial->v[0][p],
                                         trial->v[1][p],
                                         NAN,
                                         NAN};
    memcpy(tiled->rows[p], row, sizeof row);
  }
}

/* Each spring alone, in the plain loop: its forces on its ends. */
static void check_forces(const struct trial *trial, const struct net_trial *tiled, ptrdiff_t count,
                         int64_t lost) {
  double f[3][PARTICLES];
  struct trial one = *trial;
  one.run.head = one.head;
  one.run.tail = one.tail;
  for (ptrdiff_t k = 0; k < count; k++) {
    one.run.count = 1;
    one.run.shape &= ~HOOKE_RUN_MIXED;
    one.head[0] = trial->head[k];
    one.tail[0] = trial->tail[k];
    if (trial->run.shape & HOOKE_RUN_MIXED) {
      one.run.kappa = trial->kappas[k];
      one.run.gamma = trial->gammas[k];
      one.run.rest_length = trial->rest_lengths[k];
    }
    for (int a = 0; a < 3; a++)
      f[a][one.head[0]] = f[a][one.tail[0]] = 0.0;
    lost -= plain(&one, f);
    for (int a = 0; a < 3; a++) {
      assert_true(tiled->on_upper[k][a] == f[a][one.tail[0]]);
      assert_true(tiled->on_lower[k][a] == f[a][one.head[0]]);
    }
  }
  assert_int_equal(lost, 0);
}

static void check_sums(const struct hk_tiled_loops *loops, struct random_source *source,
                       struct net_trial *tiled) {
  enum { MOST_PARTICLES = 2 * HOOKE_TILED_BATCH };
  uint16_t degree[MOST_PARTICLES];
  double x[MOST_PARTICLES], y[MOST_PARTICLES], z[MOST_PARTICLES], *const f[3] = {x, y, z};
  ptrdiff_t particles = 0, used = 0;
  while (used < 2 * HOOKE_TILED_BATCH) {
    const ptrdiff_t left = 2 * HOOKE_TILED_BATCH - used, own = random_whole(source, 0, 9);
    degree[particles] = (uint16_t)(own < left ? own : left);
    used += degree[particles++];
    if (particles == MOST_PARTICLES) break;
  }
  for (ptrdiff_t k = 0; k < used; k++)
    tiled->wide[k] = tiled->narrow[k] = (uint16_t)random_whole(source, 0, 2 * HOOKE_TILED_BATCH - 1);
  for (int wide = 0; wide <= 1; wide++) {
    const void *place = wide ? (const void *)tiled->wide : (const void *)tiled->narrow;
    const void *end = wide ? (const void *)(tiled->wide + used) : (const void *)(tiled->narrow + used);
    assert_ptr_equal(loops->sum[wide](particles, degree, place, tiled->on_lower[0], f), end);
    for (ptrdiff_t p = 0, at = 0; p < particles; p++) {
      double sum[3] = {0.0, 0.0, 0.0};
      for (int k = 0; k < degree[p]; k++, at++) {
        for (int a = 0; a < 3; a++)
          sum[a] += (&tiled->on_lower[0][0])[HOOKE_TILED_FORCE * tiled->wide[at] + (uint32_t)a];
      }
      assert_true(x[p] == sum[0] && y[p] == sum[1] && z[p] == sum[2]);
    }
  }
}

TEST(test_nets_agree) {
  struct random_source source = {31};
  struct trial *trial = new_block(1, (int64_t)sizeof *trial);
  struct net_trial *tiled = hk_new(1, sizeof *tiled);
  assert_non_null(tiled);
  const struct hk_spring_set *set;
  for (int32_t shape = 0; shape < HOOKE_TILED_SHAPES; shape++) {
    for (ptrdiff_t count = 1; count <= HOOKE_TILED_BATCH; count += count < 20 ? 1 : 9) {
      for (int32_t k = 0; (set = hk_spring_set(k)) != NULL; k++) {
        draw_net(&source, shape, count, trial, tiled);
        memset(tiled->on_lower, 0, sizeof tiled->on_lower);
        memset(tiled->on_upper, 0, sizeof tiled->on_upper);
        const struct hk_tiled_springs springs = {
            .lower = tiled->lower,
            .upper = shape & HOOKE_TILED_WIDE ? (const void *)tiled->wide : (const void *)tiled->narrow,
            .kappa = trial->run.kappa,
            .gamma = trial->run.gamma,
            .rest_length = trial->run.rest_length,
            .kappas = trial->kappas,
            .gammas = trial->gammas,
            .rest_lengths = trial->rest_lengths};
        const int64_t lost = set->tiled->fill[shape](&springs, count, tiled->rows[0], tiled->rows[0],
                                                     tiled->on_lower[0], tiled->on_upper[0]);
        check_forces(trial, tiled, count, lost);
        check_sums(set->tiled, &source, tiled);
      }
    }
  }
  free(trial);
  hk_free(tiled);
}

TEST(test_sets_agree) {
  struct random_source source = {4711};
  struct trial *trial = new_block(1, (int64_t)sizeof *trial);
  const int64_t counts[] = {1,  2,  3,  4,  5,   7,   8,   9,   15,  16,  17,
                            31, 63, 64, 65, 255, 256, 257, 511, 512, 513, 777};
  for (int32_t shape = 0; shape < HOOKE_RUN_SHAPES; shape++) {
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
      for (int round = 0; round < 4; round++)
        compare_sets(&source, shape, counts[k], trial);
    }
  }
  free(trial);
}

/* Bending of every shape, with initial forces and a factor, compared with one triple at a time. */
static void compare_bending(struct random_source *source, int32_t shape, int64_t count) {
  static double x[3][PARTICLES], before[3][PARTICLES], expected[3][PARTICLES], found[3][PARTICLES];
  static int32_t particle[3][LONGEST];
  static double coefficient[LONGEST];
  for (int a = 0; a < 3; a++) {
    for (int p = 0; p < PARTICLES; p++) {
      x[a][p] = random_between(source, -1.0, 1.0);
      before[a][p] = expected[a][p] = random_between(source, -1.0, 1.0);
    }
  }
  for (int64_t k = 0; k < count; k++) {
    for (int e = 0; e < 3; e++)
      particle[e][k] = (int32_t)random_whole(source, e * 300, e * 300 + 299);
    coefficient[k] = random_between(source, 0.0, 100.0);
  }
  struct hk_bending_run run = {.count = count,
                               .shape = shape,
                               .particle = {particle[0], particle[1], particle[2]},
                               .coefficient = 7.3,
                               .coefficients = coefficient};
  run.offset = (int32_t)random_whole(source, 1, random_whole(source, 0, 1) ? 3 : (PARTICLES - count) / 2);
  run.start = (int32_t)random_whole(source, 0, PARTICLES - count - 2 * run.offset);
  const double factor = random_whole(source, 0, 1) ? 1.0 : -0.013;
  for (int64_t k = 0; k < count; k++) {
    const double c = factor * (shape & HOOKE_BENDING_MIXED ? coefficient[k] : 7.3);
    int64_t p[3];
    for (int e = 0; e < 3; e++)
      p[e] = shape & HOOKE_BENDING_INDEXED ? particle[e][k] : run.start + k + e * (int64_t)run.offset;
    for (int a = 0; a < 3; a++) {
      const double force = c * ((x[a][p[0]] - 2.0 * x[a][p[1]]) + x[a][p[2]]);
      expected[a][p[0]] -= force;
      expected[a][p[1]] += 2.0 * force;
      expected[a][p[2]] -= force;
    }
  }
  const struct hk_spring_set *set;
  for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
    memcpy(found, before, sizeof found);
    set->bending[shape](&run, factor, (const double *const[]){x[0], x[1], x[2]},
                        (double *const[]){found[0], found[1], found[2]});
    for (int a = 0; a < 3; a++)
      check_same_bits(PARTICLES, found[a], expected[a]);
  }
}

TEST(test_bending_agrees) {
  struct random_source source = {815};
  for (int32_t shape = 0; shape < HOOKE_BENDING_SHAPES; shape++) {
    for (int64_t count = 1; count <= 777; count += count < 20 ? 1 : 59) {
      for (int round = 0; round < 4; round++)
        compare_bending(&source, shape, count);
    }
  }
}

/* ---- tetrahedra ---- */

/* Any four particles, flat ones and coinciding corners among them; a given altitude or the shortest. */
static void draw_tetrahedra(struct random_source *source, int64_t count, struct hk_tetrahedron *t) {
  for (int64_t k = 0; k < count; k++) {
    t[k] = (struct hk_tetrahedron){.choice = (int32_t)random_whole(source, 0, 1) - 1,
                                   .pull_only = (int32_t)random_whole(source, 0, 1),
                                   .side = random_whole(source, 0, 1) ? 1.0 : -1.0,
                                   .stiffness = random_between(source, 0.0, 100.0),
                                   .damping = random_between(source, 0.0, 10.0)};
    if (t[k].choice == 0) t[k].choice = (int32_t)random_whole(source, 0, HOOKE_ALTITUDES - 1);
    const int32_t near = (int32_t)random_whole(source, 0, PARTICLES - 4);
    for (int j = 0; j < 4; j++)
      t[k].particle[j] =
          random_whole(source, 0, 1) ? near + j : (int32_t)random_whole(source, 0, PARTICLES - 1);
    for (int a = 0; a < HOOKE_ALTITUDES; a++)
      t[k].rest[a] = random_between(source, 0.1, 2.0);
  }
}

static void add_tetrahedron(const struct hk_tetrahedron *t, const struct trial *at, double f[3][PARTICLES]) {
  double x[4][3], v[4][3], w[3];
  struct hk_altitude altitude;
  for (int j = 0; j < 4; j++) {
    for (int a = 0; a < 3; a++)
      x[j][a] = at->q[a][t->particle[j]], v[j][a] = at->v[a][t->particle[j]];
  }
  if (!hk_altitude_find(t, (const double(*)[3])x, &altitude)) return;
  hk_altitude_weigh(&altitude, (const double(*)[3])v, w);
  const double *u = altitude.u, rate = (u[0] * w[0] + u[1] * w[1]) + u[2] * w[2],
               tension = hk_altitude_tension(t, &altitude, rate, NULL);
  for (int j = 0; j < 4; j++) {
    for (int a = 0; a < 3; a++)
      f[a][t->particle[j]] -= (tension * altitude.weight[j]) * u[a];
  }
}

/* Compared with one at a time. */
TEST(test_tetrahedra_agree) {
  static double expected[3][PARTICLES], found[3][PARTICLES];
  static struct hk_tetrahedron tetrahedra[LONGEST];
  struct random_source source = {77};
  struct trial *trial = new_block(1, (int64_t)sizeof *trial);
  const struct hk_spring_set *set;
  for (int64_t count = 1; count <= 777; count += count < 20 ? 1 : 59) {
    draw(&source, HOOKE_RUN_INDEXED, 1, trial);
    draw_tetrahedra(&source, count, tetrahedra);
    memcpy(expected, trial->f, sizeof expected);
    for (int64_t k = 0; k < count; k++)
      add_tetrahedron(&tetrahedra[k], trial, expected);
    for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
      memcpy(found, trial->f, sizeof found);
      set->tetrahedra(count, tetrahedra, (const double *const[]){trial->q[0], trial->q[1], trial->q[2]},
                      (const double *const[]){trial->v[0], trial->v[1], trial->v[2]},
                      (double *const[]){found[0], found[1], found[2]});
      check_same_bits(3 * PARTICLES, found[0], expected[0]);
    }
  }
  free(trial);
}

TEST(test_sets_have_names) {
  int32_t count = 0;
  while (hk_spring_set(count) != NULL)
    count++;
  assert_true(count >= 1);
  assert_null(hk_spring_set(-1));
  assert_string_equal(hk_spring_set(count - 1)->name, "baseline");
  assert_string_equal(hk_spring_set(0)->name, hk_kernel_instructions());
  for (int32_t k = 0; k < count; k++)
    print_message("instruction set: %s\n", hk_spring_set(k)->name);
}
