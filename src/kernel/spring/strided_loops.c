/* Compiled once per instruction set, with HOOKE_ISA naming it. Springs of one or two strided batches are
 * computed together, and sums are some vectors behind, so that the processor always finds operations with
 * available operands. */
#include "kernel/spring/strided_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/move_body.h"

typedef hk_vector vec;

/* Shapes of a pass: that of its batches, if the items of each batch are consecutive in the order of batches;
 * or any. */
enum { BEHIND = 2 * HOOKE_WIDTH, PAIRED = HOOKE_RUN_SHAPES, ANY = 2 * HOOKE_RUN_SHAPES | HOOKE_RUN_DAMPED };

struct place {
  const double *q, *v;         /* index of the current vector of particles */
  ptrdiff_t stride, p, behind; /* behind: the vector of the sums */
  vec x[3], u[3];              /* number of items */
};

HOOKE_INLINE uint32_t present_at(const uint8_t *present, ptrdiff_t p) {
  const uint32_t bits = present[(size_t)p / HOOKE_STRIDED_UNIT];
  return HOOKE_WIDTH == HOOKE_STRIDED_UNIT
             ? bits
             : bits >> ((size_t)p % HOOKE_STRIDED_UNIT) & ((1u << HOOKE_WIDTH) - 1);
}

HOOKE_INLINE void store_forces(double *ring, ptrdiff_t mask, ptrdiff_t p, const vec b[3]) {
  const ptrdiff_t at = p & mask, stride = hk_ring_stride(mask);
  double *to = ring + at;
  for (int a = 0; a < 3; a++)
    hk_store(to + a * stride, b[a]);
  if (__builtin_expect(at < HOOKE_STRIDED_UNIT, 0)) {
    for (int a = 0; a < 3; a++)
      hk_store(to + mask + 1 + a * stride, b[a]);
  }
}

#define EACH for (int i = 0; i < strided; i++)

/* sum + sign x, rounded once: sign is 1 or -1. */
HOOKE_INLINE vec add_signed(double sign, vec x, vec sum) {
#if HOOKE_WIDTH == 8
  return (vec)_mm512_fmadd_pd((__m512d)hk_all(sign), (__m512d)x, (__m512d)sum);
#else
  return sum + sign * x;
#endif
}

/* Computes springs at the vector at p, by two items a batch. */
HOOKE_INLINE void add(const struct hk_strided_item *item, const int strided, ptrdiff_t p, vec sum[3]) {
  for (int i = 0; i < 2 * strided; i++) {
    const ptrdiff_t mask = item[i].mask, stride = hk_ring_stride(mask);
    const double *at = item[i].ring + ((p - item[i].offset) & mask);
    for (int a = 0; a < 3; a++)
      sum[a] = add_signed(item[i].sign, hk_load(at + a * stride), sum[a]);
  }
}

/* The same if these are the ends and then the beginnings of each batch. */
HOOKE_INLINE void add_pairs(const struct hk_strided_view *batch, const int strided, ptrdiff_t p, vec sum[3]) {
  EACH {
    const ptrdiff_t mask = batch[i].mask, stride = hk_ring_stride(mask);
    const double *ring = batch[i].ring, *ending = ring + ((p - batch[i].offset) & mask),
                 *beginning = ring + (p & mask);
    for (int a = 0; a < 3; a++)
      sum[a] = (sum[a] + hk_load(ending + a * stride)) - hk_load(beginning + a * stride);
  }
}

/* Location of the material of the springs of the vector at p, prefetched if it is stored in a row. */
HOOKE_INLINE void locate(const struct hk_strided_material *material, ptrdiff_t p, const double **number) {
  const uint32_t *unit =
      material->unit + (HOOKE_STRIDED_NUMBERS * ((size_t)p / HOOKE_STRIDED_UNIT) & (size_t)material->mask);
  for (int j = 0; j < HOOKE_STRIDED_NUMBERS; j++)
    number[j] =
        material->value + unit[j] + (HOOKE_WIDTH == HOOKE_STRIDED_UNIT ? 0 : (size_t)p % HOOKE_STRIDED_UNIT);
  if (material->ahead == 0) return;
  for (int j = 0; j < HOOKE_STRIDED_NUMBERS; j++)
    __builtin_prefetch(number[j] + material->ahead);
}

HOOKE_INLINE vec number_of(const struct hk_strided_view *batch, const double *const *own, int j,
                           const int mixed) {
  return mixed ? hk_load(own[j]) : hk_all(batch->shared[j]);
}

/* Forces of the springs of 1 or 2 batches of one shape into their rings; `shortest` receives the minimum
 * length. Stores may alias anything for the compiler, so views are read before. */
HOOKE_INLINE void fill(const struct hk_strided_view *batch, const struct hk_strided_item *item,
                       const int strided, const struct place *at, const int shape, vec *shortest,
                       vec sum[3]) {
  const int damped = (shape & HOOKE_RUN_DAMPED) != 0, pull = (shape & HOOKE_RUN_PULL_ONLY) != 0;
  const int mixed = (shape & HOOKE_RUN_MIXED) != 0;
  vec d[2][3], r[2], ir[2], along[2], tension[2];
  struct hk_strided_view l[2];
  const double *q[2], *v[2], *own[2][HOOKE_STRIDED_NUMBERS];
  EACH {
    l[i] = batch[i];
    q[i] = at->q + l[i].offset;
    v[i] = at->v + l[i].offset;
    for (int a = 0; a < 3; a++)
      d[i][a] = at->x[a] - hk_load(q[i] + a * at->stride);
  }
  if (mixed) EACH locate(&l[i].material, at->p, own[i]);
  EACH r[i] = d[i][0] * d[i][0] + d[i][1] * d[i][1];
  EACH r[i] = hk_vector_sqrt(r[i] + d[i][2] * d[i][2]);
  if (damped) {
    EACH along[i] = (at->u[0] - hk_load(v[i])) * d[i][0];
    EACH along[i] = along[i] + (at->u[1] - hk_load(v[i] + at->stride)) * d[i][1];
    EACH along[i] = along[i] + (at->u[2] - hk_load(v[i] + 2 * at->stride)) * d[i][2];
  }
  if (shape & PAIRED)
    add_pairs(batch, strided, at->behind, sum);
  else
    add(item, strided, at->behind, sum);
  EACH ir[i] = 1.0 / r[i];
  EACH *shortest = hk_lesser(r[i], *shortest);
  EACH {
    const vec rest = number_of(&l[i], own[i], HOOKE_STRIDED_REST, mixed);
    const vec kappa = number_of(&l[i], own[i], HOOKE_STRIDED_KAPPA, mixed);
    tension[i] = kappa * (r[i] - rest);
    if (damped) {
      const vec gamma = number_of(&l[i], own[i], HOOKE_STRIDED_GAMMA, mixed);
      tension[i] = tension[i] + gamma * (along[i] * ir[i]);
    }
    if (pull) tension[i] = (vec)((hk_vector_mask)tension[i] & ~((r[i] <= rest) | (tension[i] < 0.0)));
    tension[i] = tension[i] * ir[i];
    const uint32_t bits = present_at(l[i].present, at->p);
    for (int a = 0; a < 3; a++)
      d[i][a] = hk_keep(bits, tension[i] * d[i][a]);
  }
  EACH store_forces(l[i].ring, l[i].mask, at->p, d[i]);
}

/* Repeats the springs of the vector at p one by one, since some ends coincide. Counts those with a rest
 * length. */
static __attribute__((noinline)) int64_t fill_with_care(const struct hk_strided_pass *pass, ptrdiff_t p) {
  int64_t lost = 0;
  for (int32_t k = 0; k < pass->count; k++) {
    const struct hk_strided_view *batch = &pass->batch[k];
    const struct hk_strided_material *material = &batch->material;
    vec b[3] = {{0}};
    for (ptrdiff_t i = 0; i < HOOKE_WIDTH; i++) {
      const double *q = pass->q + p + i, *v = pass->v + p + i, *qj = q + batch->offset,
                   *vj = v + batch->offset;
      const ptrdiff_t y = pass->stride, z = 2 * y;
      if (!(present_at(batch->present, p) >> i & 1)) continue;
      const double dx = q[0] - qj[0], dy = q[y] - qj[y], dz = q[z] - qj[z];
      const double r = hk_spring_length(dx, dy, dz), ir = hk_spring_inverse_length(r);
      const double rest = *hk_strided_number(material, p + i, HOOKE_STRIDED_REST);
      double brake = 0.0;
      if (batch->shape & HOOKE_RUN_DAMPED) {
        brake = *hk_strided_number(material, p + i, HOOKE_STRIDED_GAMMA) *
                ((((v[0] - vj[0]) * dx + (v[y] - vj[y]) * dy) + (v[z] - vj[z]) * dz) * ir);
      }
      const double s = hk_spring_tension(r, rest, *hk_strided_number(material, p + i, HOOKE_STRIDED_KAPPA),
                                         brake, (batch->shape & HOOKE_RUN_DAMPED) != 0,
                                         (batch->shape & HOOKE_RUN_PULL_ONLY) != 0) *
                       ir;
      b[0][i] = s * dx;
      b[1][i] = s * dy;
      b[2][i] = s * dz;
      lost += (r == 0.0) & (rest != 0.0);
    }
    store_forces(batch->ring, batch->mask, p, b);
  }
  return lost;
}

#define MOVE(kind) hk_move_vector(move, kind, p, pass->w + p, pass->q + p, pass->v + p, pass->stride, sum)
#define CASE(kind)                                                                                           \
  case kind:                                                                                                 \
    MOVE(kind);                                                                                              \
    break;

/* The other moves, apart from the loop, so that it stays small and its sums stay in registers. */
static __attribute__((noinline)) void move_otherwise(const struct hk_strided_pass *pass, ptrdiff_t p, vec x,
                                                     vec y, vec z) {
  const struct hk_move *move = &pass->move;
  const vec sum[3] = {x, y, z};
  switch (move->kind) {
    CASE(HOOKE_MOVE_KEEP)
    CASE(HOOKE_DRIFT_THEN_KICK)
    CASE(HOOKE_PREDICT)
    CASE(HOOKE_CORRECT)
    CASE(HOOKE_KICK)
    CASE(HOOKE_KICK_DRIFT_KICK)
    CASE(HOOKE_FIRST_STAGE)
    CASE(HOOKE_MIDDLE_STAGE)
    CASE(HOOKE_LAST_STAGE)
  default:
    break;
  }
}

HOOKE_INLINE void move_on(const struct hk_strided_pass *pass, const struct hk_move *move, ptrdiff_t p,
                          const vec sum[3]) {
  if (__builtin_expect(move->kind == HOOKE_KICK_THEN_DRIFT, 1))
    MOVE(HOOKE_KICK_THEN_DRIFT);
  else if (move->kind != HOOKE_MOVE_NOTHING)
    move_otherwise(pass, p, sum[0], sum[1], sum[2]);
}

/* Forces of all batches at a vector, and sums behind it: two batches at a time if all have one shape, known
 * at compile time. */
HOOKE_INLINE void fill_all(const struct hk_strided_pass *pass, const int shape, const struct place *at,
                           vec *shortest, vec sum[3]) {
  const struct hk_strided_view *batch = pass->batch, *end = batch + pass->count;
  const struct hk_strided_item *item = pass->item;
  for (; batch + 1 < end; batch += 2, item += 4)
    fill(batch, item, 2, at, shape, shortest, sum);
  if (batch < end) fill(batch, item, 1, at, shape, shortest, sum);
}

#define BODY(shape)                                                                                          \
  case shape:                                                                                                \
    fill(batch, item, 1, at, (shape) | HOOKE_RUN_MIXED, shortest, sum);                                      \
    break;

HOOKE_INLINE void fill_any(const struct hk_strided_pass *pass, const struct place *at, vec *shortest,
                           vec sum[3]) {
  for (int32_t k = 0; k < pass->count; k++) {
    const struct hk_strided_view *batch = pass->batch + k;
    const struct hk_strided_item *item = pass->item + 2 * k;
    switch (batch->shape & ~HOOKE_RUN_MIXED) {
      BODY(0)
      BODY(HOOKE_RUN_DAMPED)
      BODY(HOOKE_RUN_PULL_ONLY)
      BODY(HOOKE_RUN_PULL_ONLY | HOOKE_RUN_DAMPED)
    }
  }
}

HOOKE_INLINE void fetch(const struct place *at, ptrdiff_t ahead) {
  for (int a = 0; a < 3; a++) {
    __builtin_prefetch(at->q + ahead + a * at->stride);
    __builtin_prefetch(at->v + ahead + a * at->stride);
  }
}

/* `shape` is that of all batches, or ANY. */
HOOKE_INLINE int64_t advance(const struct hk_strided_pass *pass, const int shape, ptrdiff_t from,
                             ptrdiff_t to) {
  const struct hk_move how = pass->move;
  int64_t lost = 0;
  for (ptrdiff_t p = from; p < to; p += HOOKE_WIDTH) {
    struct place at = {
        .q = pass->q + p, .v = pass->v + p, .stride = pass->stride, .p = p, .behind = p - BEHIND};
    vec sum[3] = {{0}}, shortest = hk_all(INFINITY);
    for (int a = 0; a < 3; a++) {
      at.x[a] = hk_load(at.q + a * at.stride);
      if (shape & HOOKE_RUN_DAMPED) at.u[a] = hk_load(at.v + a * at.stride);
    }
    if (pass->ahead > 0) fetch(&at, pass->ahead);
    if (shape == ANY)
      fill_any(pass, &at, &shortest, sum);
    else
      fill_all(pass, shape, &at, &shortest, sum);
    if (__builtin_expect(hk_has_zero(shortest), 0)) lost += fill_with_care(pass, p);
    if (at.behind >= from) move_on(pass, &how, at.behind, sum);
  }
  for (ptrdiff_t p = to - BEHIND > from ? to - BEHIND : from; p < to; p += HOOKE_WIDTH) {
    vec sum[3] = {{0}};
    for (int32_t k = 0; k < pass->count; k++)
      add(&pass->item[2 * k], 1, p, sum);
    move_on(pass, &how, p, sum);
  }
  return lost;
}

HOOKE_INLINE int32_t shape_of(const struct hk_strided_pass *pass) {
  int32_t shape = pass->count > 0 ? pass->batch[0].shape : 0, paired = PAIRED;
  for (int32_t k = 0; k < pass->count; k++) {
    const struct hk_strided_view *batch = &pass->batch[k];
    const struct hk_strided_item *item = &pass->item[2 * k];
    if (item[0].ring != batch->ring || item[1].ring != batch->ring || item[1].offset != 0) paired = 0;
    if ((shape ^ batch->shape) & ~HOOKE_RUN_MIXED) return ANY;
    shape |= batch->shape;
  }
  return shape | paired;
}

#define ADVANCE(shape)                                                                                       \
  case shape:                                                                                                \
    return advance(pass, shape, from, to);                                                                   \
  case PAIRED | (shape):                                                                                     \
    return advance(pass, PAIRED | (shape), from, to);

int64_t HOOKE_STRIDED_LOOP(const struct hk_strided_pass *pass, ptrdiff_t from, ptrdiff_t to) {
  switch (shape_of(pass)) {
    ADVANCE(0)
    ADVANCE(HOOKE_RUN_DAMPED)
    ADVANCE(HOOKE_RUN_MIXED)
    ADVANCE(HOOKE_RUN_MIXED | HOOKE_RUN_DAMPED)
    ADVANCE(HOOKE_RUN_PULL_ONLY)
    ADVANCE(HOOKE_RUN_PULL_ONLY | HOOKE_RUN_DAMPED)
    ADVANCE(HOOKE_RUN_PULL_ONLY | HOOKE_RUN_MIXED)
    ADVANCE(HOOKE_RUN_PULL_ONLY | HOOKE_RUN_MIXED | HOOKE_RUN_DAMPED)
  }
  return advance(pass, ANY, from, to);
}
