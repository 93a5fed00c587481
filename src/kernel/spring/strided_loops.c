/* Compiled once per instruction set, with HOOKE_ISA naming it. Two vectors of springs are computed together,
 * and sums are some vectors behind, so that the processor always finds operations with available operands. It
 * looks ahead by a limited number of operations and loads, so those of addresses are kept few. */
#include "kernel/spring/strided_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/move_body.h"

#include <string.h>

typedef hk_vector vec;

/* Shapes of a pass: that of its batches, if the items of each batch are consecutive in the order of batches;
 * or any. */
enum { PAIRED = HOOKE_RUN_SHAPES, ANY = 2 * HOOKE_RUN_SHAPES | HOOKE_RUN_DAMPED };

/* The two vectors belong to TOGETHER batches and to VECTORS successive vectors of particles, which make a
 * step of the loop. Sums are BEHIND particles behind. */
enum {
  VECTORS = HOOKE_WIDTH == HOOKE_STRIDED_UNIT ? 1 : 2,
  TOGETHER = 2 / VECTORS,
  STEP = VECTORS * HOOKE_WIDTH,
  BEHIND = HOOKE_WIDTH == HOOKE_STRIDED_UNIT ? 2 * STEP : STEP,
  BYTES = sizeof(double)
};

/* Copies of views and items with addresses in bytes, which need no scaling. */
struct batch {
  ptrdiff_t offset, mask, stride;
  char *ring;
  const uint8_t *present;
  double shared[HOOKE_STRIDED_NUMBERS];
  const struct hk_strided_material *material;
  int32_t shape;
};

struct item {
  ptrdiff_t offset, mask, stride;
  const char *ring;
};

struct slot {
  const char *q, *v;   /* index of the current vectors of particles */
  ptrdiff_t stride, p; /* in bytes; number of particles */
};

#define EACH_VECTOR for (int j = 0; j < VECTORS; j++)

HOOKE_INLINE vec load_at(const char *at, int j) {
  return hk_load((const double *)(const void *)at + j * HOOKE_WIDTH);
}

HOOKE_INLINE void store_three(char *x, ptrdiff_t stride, vec b[VECTORS][3]) {
  for (int a = 0; a < 3; a++)
    EACH_VECTOR hk_store((double *)(void *)(x + a * stride) + j * HOOKE_WIDTH, b[j][a]);
}

HOOKE_INLINE void store_forces(const struct batch *batch, ptrdiff_t p, vec b[VECTORS][3]) {
  const ptrdiff_t mask = batch->mask, stride = batch->stride, at = BYTES * p & mask;
  char *x = batch->ring + at;
  store_three(x, stride, b);
  if (__builtin_expect(at < BYTES * HOOKE_STRIDED_UNIT, 0)) store_three(x + mask + BYTES, stride, b);
}

/* Adds the springs at `x` of a ring, or subtracts those that begin at the particles. */
HOOKE_INLINE void add_ring(const char *x, ptrdiff_t stride, const int begins, vec sum[VECTORS][3]) {
  for (int a = 0; a < 3; a++) {
    EACH_VECTOR {
      const vec b = load_at(x + a * stride, j);
      sum[j][a] = begins ? sum[j][a] - b : sum[j][a] + b;
    }
  }
}

HOOKE_INLINE void add(const struct item *item, ptrdiff_t p, vec sum[VECTORS][3]) {
  const char *x = item->ring + ((BYTES * p - item->offset) & item->mask);
  if (item->offset == 0)
    add_ring(x, item->stride, 1, sum);
  else
    add_ring(x, item->stride, 0, sum);
}

/* The ends and then the beginnings of a batch. */
HOOKE_INLINE void add_pair(const struct batch *batch, ptrdiff_t p, vec sum[VECTORS][3]) {
  const ptrdiff_t mask = batch->mask, stride = batch->stride;
  add_ring(batch->ring + ((BYTES * p - batch->offset) & mask), stride, 0, sum);
  add_ring(batch->ring + (BYTES * p & mask), stride, 1, sum);
}

/* p modulo a unit, where steps are shorter. */
HOOKE_INLINE size_t within_unit(ptrdiff_t p) {
  return (int)STEP == (int)HOOKE_STRIDED_UNIT ? 0 : (size_t)p % HOOKE_STRIDED_UNIT;
}

/* Location of the material of the springs at p, prefetched if it is stored in a row. */
HOOKE_INLINE void locate(const struct hk_strided_material *material, ptrdiff_t p, const double **number) {
  const uint32_t *unit =
      material->unit + (HOOKE_STRIDED_NUMBERS * ((size_t)p / HOOKE_STRIDED_UNIT) & (size_t)material->mask);
  for (int n = 0; n < HOOKE_STRIDED_NUMBERS; n++)
    number[n] = material->value + unit[n] + within_unit(p);
  if (material->ahead == 0) return;
  for (int n = 0; n < HOOKE_STRIDED_NUMBERS; n++)
    __builtin_prefetch(number[n] + material->ahead);
}

HOOKE_INLINE vec number_of(const struct batch *batch, const double *const *own, int n, int j,
                           const int mixed) {
  return mixed ? hk_load(own[n] + j * HOOKE_WIDTH) : hk_all(batch->shared[n]);
}

/* Clears the forces of springs that do not exist. */
HOOKE_INLINE void clear_absent(const struct batch *batch, ptrdiff_t p, vec b[VECTORS][3]) {
  const uint32_t all = (1u << STEP) - 1, vector = (1u << HOOKE_WIDTH) - 1;
  const uint32_t bits = (uint32_t)batch->present[(size_t)p / HOOKE_STRIDED_UNIT] >> within_unit(p) & all;
  if (__builtin_expect(bits == all, 1)) return;
  for (int a = 0; a < 3; a++)
    EACH_VECTOR b[j][a] = hk_keep(bits >> j * HOOKE_WIDTH & vector, b[j][a]);
}

#define EACH   for (int i = 0; i < together * VECTORS; i++)
#define BATCH  (batch + i / VECTORS)
#define VECTOR (i % VECTORS)

/* The velocity of the ends against each other times their distance vector `d`. */
HOOKE_INLINE void find_along(const struct batch *batch, const int together, const char *v, ptrdiff_t stride,
                             vec d[2][3], vec along[2]) {
  EACH along[i] = (load_at(v, VECTOR) - load_at(v + BATCH->offset, VECTOR)) * d[i][0];
  for (int a = 1; a < 3; a++) {
    const char *u = v + a * stride;
    EACH along[i] = along[i] + (load_at(u, VECTOR) - load_at(u + BATCH->offset, VECTOR)) * d[i][a];
  }
}

/* Tension over length of springs of length r. */
HOOKE_INLINE vec tension_of(const struct batch *batch, const double *const *own, int j, const int shape,
                            vec r, vec ir, vec along, vec *shortest) {
  const int mixed = (shape & HOOKE_RUN_MIXED) != 0;
  const vec rest = number_of(batch, own, HOOKE_STRIDED_REST, j, mixed);
  vec tension = number_of(batch, own, HOOKE_STRIDED_KAPPA, j, mixed) * (r - rest);
  *shortest = hk_lesser(r + (r - rest), *shortest);
  if (shape & HOOKE_RUN_DAMPED)
    tension = tension + number_of(batch, own, HOOKE_STRIDED_GAMMA, j, mixed) * (along * ir);
  if (shape & HOOKE_RUN_PULL_ONLY)
    tension = (vec)((hk_vector_mask)tension & ~((r <= rest) | (tension < 0.0)));
  return tension * ir;
}

/* Forces of the springs of 1 or TOGETHER batches of one shape into their rings, and sums behind;
 * `shortest` receives the minimum of twice their length less their rest length. Stores may alias anything
 * for the compiler, so they come last. The empty instruction keeps it from storing sums of addresses
 * outside the loop, whose loads cost more than adding. */
HOOKE_INLINE void fill(const struct batch *batch, const struct item *item, const int together,
                       const struct slot *at, const int shape, vec *shortest, vec sum[VECTORS][3]) {
  const char *q = at->q, *v = at->v;
  ptrdiff_t stride = at->stride, p = at->p;
  const double *own[TOGETHER][HOOKE_STRIDED_NUMBERS];
  vec d[2][3], r[2], ir[2], along[2] = {{0}, {0}};
  __asm__("" : "+r"(q), "+r"(v), "+r"(stride), "+r"(p));
  for (int k = 0; k < together && shape & HOOKE_RUN_MIXED; k++)
    locate(batch[k].material, p, own[k]);
  for (int a = 0; a < 3; a++) {
    const char *x = q + a * stride;
    EACH d[i][a] = load_at(x, VECTOR) - load_at(x + BATCH->offset, VECTOR);
  }
  EACH r[i] = d[i][0] * d[i][0] + d[i][1] * d[i][1];
  EACH r[i] = hk_vector_sqrt(r[i] + d[i][2] * d[i][2]);
  if (shape & HOOKE_RUN_DAMPED) find_along(batch, together, v, stride, d, along);
  for (int k = 0; k < together; k++) {
    if (shape & PAIRED) {
      add_pair(batch + k, p - BEHIND, sum);
    } else {
      add(item + 2 * k, p - BEHIND, sum);
      add(item + 2 * k + 1, p - BEHIND, sum);
    }
  }
  EACH ir[i] = 1.0 / r[i];
  EACH {
    const vec s = tension_of(BATCH, own[i / VECTORS], VECTOR, shape, r[i], ir[i], along[i], shortest);
    for (int a = 0; a < 3; a++)
      d[i][a] = s * d[i][a];
  }
  for (int k = 0; k < together; k++)
    clear_absent(batch + k, p, d + k * VECTORS);
  for (int k = 0; k < together; k++)
    store_forces(batch + k, p, d + k * VECTORS);
}

HOOKE_INLINE int present_at(const struct hk_strided_view *batch, ptrdiff_t p) {
  return batch->present[p / HOOKE_STRIDED_UNIT] >> p % HOOKE_STRIDED_UNIT & 1;
}

/* The force of the spring of a batch at p into its ring. Returns how short it is. */
static int64_t fill_one(const struct hk_strided_pass *pass, const struct hk_strided_view *batch,
                        ptrdiff_t p) {
  const struct hk_strided_material *material = &batch->material;
  const double *q = pass->q + p, *v = pass->v + p, *qj = q + batch->offset, *vj = v + batch->offset;
  const ptrdiff_t y = pass->stride, z = 2 * y, at = p & batch->mask;
  const int damped = (batch->shape & HOOKE_RUN_DAMPED) != 0;
  const double d[3] = {q[0] - qj[0], q[y] - qj[y], q[z] - qj[z]};
  const double r = hk_spring_length(d[0], d[1], d[2]), ir = hk_spring_inverse_length(r);
  const double rest = *hk_strided_number(material, p, HOOKE_STRIDED_REST);
  double brake = 0.0;
  if (damped) {
    brake = *hk_strided_number(material, p, HOOKE_STRIDED_GAMMA) *
            ((((v[0] - vj[0]) * d[0] + (v[y] - vj[y]) * d[1]) + (v[z] - vj[z]) * d[2]) * ir);
  }
  const double s = hk_spring_tension(r, rest, *hk_strided_number(material, p, HOOKE_STRIDED_KAPPA), brake,
                                     damped, (batch->shape & HOOKE_RUN_PULL_ONLY) != 0) *
                   ir;
  for (int a = 0; a < 3; a++) {
    double *to = batch->ring + a * hk_ring_stride(batch->mask) + at;
    *to = s * d[a];
    if (at < HOOKE_STRIDED_UNIT) to[batch->mask + 1] = *to;
  }
  return hk_spring_shortness(r, rest);
}

/* Repeats the springs of a step at p one by one, since some are short or have no direction. */
static __attribute__((noinline)) int64_t fill_with_care(const struct hk_strided_pass *pass, ptrdiff_t p) {
  int64_t lost = 0;
  for (int32_t k = 0; k < pass->count; k++) {
    for (ptrdiff_t l = p; l < p + STEP; l++) {
      if (present_at(&pass->batch[k], l)) lost += fill_one(pass, &pass->batch[k], l);
    }
  }
  return lost;
}

#define MOVE(kind)                                                                                           \
  hk_move_vector(move, kind, p, pass->w + p, NULL, pass->q + p, pass->v + p, pass->stride, sum)
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
  default:
    MOVE(HOOKE_LAST_STAGE);
  }
}

HOOKE_INLINE void move_on(const struct hk_strided_pass *pass, const struct hk_move *move, ptrdiff_t first,
                          vec sums[VECTORS][3]) {
  EACH_VECTOR {
    const ptrdiff_t p = first + j * HOOKE_WIDTH;
    const vec *sum = sums[j];
    if (__builtin_expect(move->kind == HOOKE_KICK_THEN_DRIFT, 1))
      MOVE(HOOKE_KICK_THEN_DRIFT);
    else if (move->kind != HOOKE_MOVE_NOTHING)
      move_otherwise(pass, p, sum[0], sum[1], sum[2]);
  }
}

#define BODY(shape)                                                                                          \
  case shape:                                                                                                \
    fill(batch, item, 1, at, (shape) | HOOKE_RUN_MIXED, shortest, sum);                                      \
    break;

HOOKE_INLINE void fill_any(const struct batch *batch, const struct item *item, const struct slot *at,
                           vec *shortest, vec sum[VECTORS][3]) {
  switch (batch->shape & ~HOOKE_RUN_MIXED) {
    BODY(0)
    BODY(HOOKE_RUN_DAMPED)
    BODY(HOOKE_RUN_PULL_ONLY)
  default:
    fill(batch, item, 1, at, HOOKE_RUN_PULL_ONLY | HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED, shortest, sum);
  }
}

/* Forces of all batches at a step of the loop, and sums behind it: TOGETHER batches at a time if all have one
 * shape, known at compile time. */
HOOKE_INLINE void fill_all(const struct batch *batch, const struct item *item, int32_t count, const int shape,
                           const struct slot *at, vec *shortest, vec sum[VECTORS][3]) {
  const struct batch *end = batch + count;
  if (shape == ANY) {
    for (; batch < end; batch++, item += 2)
      fill_any(batch, item, at, shortest, sum);
    return;
  }
  for (; batch + TOGETHER <= end; batch += TOGETHER, item += 2 * TOGETHER)
    fill(batch, item, TOGETHER, at, shape, shortest, sum);
  if (TOGETHER > 1 && batch < end) fill(batch, item, 1, at, shape, shortest, sum);
}

HOOKE_INLINE void fetch(const struct slot *at, ptrdiff_t ahead) {
  for (int a = 0; a < 3; a++) {
    __builtin_prefetch(at->q + BYTES * ahead + a * at->stride);
    __builtin_prefetch(at->v + BYTES * ahead + a * at->stride);
  }
}

static void copy_batches(const struct hk_strided_pass *pass, struct batch *batch, struct item *item) {
  for (int32_t k = 0; k < pass->count; k++) {
    const struct hk_strided_view *view = &pass->batch[k];
    batch[k] = (struct batch){.offset = BYTES * view->offset,
                              .mask = BYTES * view->mask,
                              .stride = BYTES * hk_ring_stride(view->mask),
                              .ring = (char *)view->ring,
                              .present = view->present,
                              .material = &view->material,
                              .shape = view->shape};
    memcpy(batch[k].shared, view->shared, sizeof view->shared);
  }
  for (int32_t i = 0; i < 2 * pass->count; i++) {
    const struct hk_strided_item *from = &pass->item[i];
    item[i] = (struct item){.offset = BYTES * from->offset,
                            .mask = BYTES * from->mask,
                            .stride = BYTES * hk_ring_stride(from->mask),
                            .ring = (const char *)from->ring};
  }
}

/* `shape` is that of all batches, or ANY. */
HOOKE_INLINE int64_t advance(const struct hk_strided_pass *pass, const int shape, ptrdiff_t from,
                             ptrdiff_t to) {
  const struct hk_move how = pass->move;
  const int32_t count = pass->count;
  struct batch batch[HOOKE_MOST_STRIDED];
  struct item item[2 * HOOKE_MOST_STRIDED];
  int64_t lost = 0;
  copy_batches(pass, batch, item);
  for (ptrdiff_t p = from; p < to; p += STEP) {
    const struct slot at = {.q = (const char *)(pass->q + p),
                            .v = (const char *)(pass->v + p),
                            .stride = BYTES * pass->stride,
                            .p = p};
    vec sum[VECTORS][3] = {{{0}}}, shortest = hk_all(INFINITY);
    if (pass->ahead > 0) fetch(&at, pass->ahead);
    fill_all(batch, item, count, shape, &at, &shortest, sum);
    if (__builtin_expect(hk_has_none_left(shortest), 0)) lost += fill_with_care(pass, p);
    if (p - BEHIND >= from) move_on(pass, &how, p - BEHIND, sum);
  }
  for (ptrdiff_t p = to - BEHIND > from ? to - BEHIND : from; p < to; p += STEP) {
    vec sum[VECTORS][3] = {{{0}}};
    for (int32_t i = 0; i < 2 * count; i++)
      add(&item[i], p, sum);
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
