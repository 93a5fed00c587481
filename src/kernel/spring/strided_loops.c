/* Compiled once per instruction set, with HOOKE_ISA naming it. A step of the loop works on three vectors of
 * particles: it finds the lengths of the springs of one, the forces of those before it, and the sums of those
 * before these. Roots and quotients have a whole step to end, so that little waits for them in the queue of
 * floating-point operations, whose length limits the loop. */
#include "kernel/spring/strided_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/move_body.h"

typedef hk_vector vec;

/* Shapes of a pass: that of its batches, or any; PAIRED if the items of each batch are consecutive in the
 * order of batches, SORTED if all ends come before all beginnings; with triples; of lean material. */
enum {
  PAIRED = HOOKE_RUN_SHAPES,
  SORTED = 2 * HOOKE_RUN_SHAPES,
  ANY = 4 * HOOKE_RUN_SHAPES,
  BENT = 8 * HOOKE_RUN_SHAPES,
  LEAN = 16 * HOOKE_RUN_SHAPES
};

enum { STEP = HOOKE_WIDTH, ALL = (1 << STEP) - 1, BYTES = sizeof(double) };

/* Copies of views and items with addresses in bytes, which need no scaling. */
struct batch {
  vec d[3], r, along; /* of the last vector of springs: distances, lengths, velocities times distances */
  vec shared[HOOKE_STRIDED_NUMBERS];
  ptrdiff_t offset, mask, ahead;
  char *ring;
  const uint8_t *present;
  const uint32_t *unit;
  const double *value;
  int32_t shape;
} __attribute__((aligned(64)));

struct item {
  ptrdiff_t offset, mask;
  const char *ring;
};

struct loop {
  const struct hk_strided_pass *pass;
  struct hk_move move;
  ptrdiff_t from, to, ring_stride, ahead; /* ahead: of a batch that has it */
  struct batch batch[HOOKE_MOST_STRIDED];
  struct item item[2 * HOOKE_MOST_STRIDED];
};

HOOKE_INLINE vec load_at(const char *at) {
  return hk_load((const double *)(const void *)at);
}

/* Adds what is at byte `at` of a ring, times `weight`. The empty instruction keeps the compiler from
 * computing an address for each component, and from loading before a branch. */
HOOKE_INLINE void add_ring(const char *ring, ptrdiff_t mask, ptrdiff_t at, ptrdiff_t stride,
                           const double weight, vec sum[3]) {
  const char *x = ring + (at & mask);
  __asm__("" : "+r"(x));
  for (int a = 0; a < 3; a++)
    sum[a] = sum[a] + weight * load_at(x + a * stride);
}

HOOKE_INLINE void add_items(const struct loop *loop, ptrdiff_t p, const int sorted, vec sum[3]) {
  const ptrdiff_t count = loop->pass->count, stride = loop->ring_stride;
  const struct item *item = loop->item, *middle = item + count, *last = middle + count;
  for (; sorted && item < middle; item++)
    add_ring(item->ring, item->mask, BYTES * p - item->offset, stride, 1.0, sum);
  for (; item < last; item++) {
    if (sorted || item->offset == 0)
      add_ring(item->ring, item->mask, BYTES * p, stride, -1.0, sum);
    else
      add_ring(item->ring, item->mask, BYTES * p - item->offset, stride, 1.0, sum);
  }
}

/* The ends and then the beginnings of a batch. */
HOOKE_INLINE void add_pair(const struct batch *batch, ptrdiff_t stride, ptrdiff_t p, vec sum[3]) {
  add_ring(batch->ring, batch->mask, BYTES * p - batch->offset, stride, 1.0, sum);
  add_ring(batch->ring, batch->mask, BYTES * p, stride, -1.0, sum);
}

/* The triples of a batch of which particles are the last, the middle and the first one. */
HOOKE_INLINE void add_bent(const struct batch *batch, ptrdiff_t stride, ptrdiff_t p, vec sum[3]) {
  add_ring(batch->ring, batch->mask, BYTES * p - 2 * batch->offset, stride, -1.0, sum);
  add_ring(batch->ring, batch->mask, BYTES * p - batch->offset, stride, 2.0, sum);
  add_ring(batch->ring, batch->mask, BYTES * p, stride, -1.0, sum);
}

/* The row of the springs at p, from theirs on. */
HOOKE_INLINE const double *row_at(const struct batch *batch, ptrdiff_t p) {
  return batch->value + batch->unit[(size_t)p / HOOKE_STRIDED_UNIT] + (size_t)p % HOOKE_STRIDED_UNIT;
}

/* Prefetches rows that are stored one after the other: apart from the loop, which is slower with a branch
 * between its loads. The empty instruction keeps the compiler from leaving the call out. */
static __attribute__((noinline)) void fetch_rows(const struct loop *loop, ptrdiff_t p) {
  __asm__ volatile("");
  for (const struct batch *batch = loop->batch; batch < loop->batch + loop->pass->count; batch++) {
    const int numbers = batch->shape & LEAN ? 1 : HOOKE_STRIDED_NUMBERS;
    for (int n = 0; n < numbers && batch->ahead > 0; n++)
      __builtin_prefetch(row_at(batch, p) + HOOKE_STRIDED_UNIT * n + batch->ahead);
  }
}

/* Bits of the springs at p. */
HOOKE_INLINE uint32_t present_at(const uint8_t *present, ptrdiff_t p) {
  return (uint32_t)present[(size_t)p / HOOKE_STRIDED_UNIT] >> (size_t)p % HOOKE_STRIDED_UNIT & ALL;
}

/* Forces of the springs or triples at p into the ring of their batch; those that do not exist have none. */
HOOKE_INLINE void store_forces(const struct batch *batch, ptrdiff_t stride, ptrdiff_t p, int whole,
                               vec b[3]) {
  char *x = batch->ring + (BYTES * p & batch->mask);
  for (int a = 0; a < 3 && __builtin_expect(!whole, 0); a++)
    b[a] = hk_keep(present_at(batch->present, p), b[a]);
  __asm__("" : "+r"(x));
  for (int a = 0; a < 3; a++)
    hk_store((double *)(void *)(x + a * stride), b[a]);
}

/* Lengths of the springs of a batch that begin at particles at q and v, whose numbers are `x` and `u`. */
HOOKE_INLINE void find_lengths(struct batch *batch, const char *q, const char *v, ptrdiff_t stride,
                               const vec x[3], const vec u[3], const int shape) {
  vec d[3];
  q += batch->offset;
  v += batch->offset;
  __asm__("" : "+r"(q), "+r"(v));
  for (int a = 0; a < 3; a++)
    d[a] = x[a] - load_at(q + a * stride);
  batch->r = hk_vector_sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
  if (shape & HOOKE_RUN_DAMPED) {
    vec along = (u[0] - load_at(v)) * d[0];
    for (int a = 1; a < 3; a++)
      along = along + (u[a] - load_at(v + a * stride)) * d[a];
    batch->along = along;
  }
  for (int a = 0; a < 3; a++)
    batch->d[a] = d[a];
}

/* Forces of the springs at p, of known length, into the ring of their batch; `shortest` receives the minimum
 * of twice their length less their rest length. */
HOOKE_INLINE void fill(const struct batch *batch, ptrdiff_t stride, ptrdiff_t p, const int shape, int whole,
                       vec *shortest) {
  vec number[HOOKE_STRIDED_NUMBERS], b[3];
  for (int n = 0; n < HOOKE_STRIDED_NUMBERS; n++)
    number[n] = shape & HOOKE_RUN_MIXED && !(shape & LEAN)
                    ? hk_load(row_at(batch, p) + HOOKE_STRIDED_UNIT * n)
                    : batch->shared[n];
  if (shape & LEAN) number[HOOKE_STRIDED_REST] = hk_load(row_at(batch, p));
  const vec r = batch->r, ir = 1.0 / r, stretch = r - number[HOOKE_STRIDED_REST];
  vec tension = number[HOOKE_STRIDED_KAPPA] * stretch;
  *shortest = hk_lesser(r + stretch, *shortest);
  if (shape & HOOKE_RUN_DAMPED) tension = tension + number[HOOKE_STRIDED_GAMMA] * (batch->along * ir);
  if (shape & HOOKE_RUN_PULL_ONLY)
    tension = (vec)((hk_vector_mask)tension & ~((r <= number[HOOKE_STRIDED_REST]) | (tension < 0.0)));
  tension = tension * ir;
  for (int a = 0; a < 3; a++)
    b[a] = tension * batch->d[a];
  store_forces(batch, stride, p, whole, b);
}

/* Forces of the triples that begin at p, where q has the numbers x, into the ring of their batch. */
HOOKE_INLINE void fill_bent(const struct batch *batch, const char *q, ptrdiff_t stride, ptrdiff_t ring,
                            ptrdiff_t p, const vec x[3], int whole) {
  const vec c = hk_load(batch->value + p);
  vec b[3];
  const char *middle = q + batch->offset, *last = middle + batch->offset;
  __asm__("" : "+r"(middle), "+r"(last));
  for (int a = 0; a < 3; a++)
    b[a] = c * ((x[a] - 2.0 * load_at(middle + a * stride)) + load_at(last + a * stride));
  store_forces(batch, ring, p, whole, b);
}

/* Repeats the first vector of springs of the rings that begin anew at p after their ends. */
static __attribute__((noinline)) void repeat_first(const struct hk_strided_pass *pass, ptrdiff_t p) {
  for (int32_t k = 0; k < pass->count + pass->bent; k++) {
    const ptrdiff_t mask = pass->batch[k].mask;
    double *x = pass->batch[k].ring;
    for (int a = 0; a < 3 && (p & mask) == 0; a++, x += pass->ring_stride)
      hk_store(x + mask + 1, hk_load(x));
  }
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
  for (int a = 0; a < 3; a++)
    batch->ring[a * pass->ring_stride + at] = s * d[a];
  return hk_spring_shortness(r, rest);
}

/* Repeats the springs of a step at p one by one, since some are short or have no direction. */
static __attribute__((noinline)) int64_t fill_with_care(const struct hk_strided_pass *pass, ptrdiff_t p) {
  int64_t lost = 0;
  for (int32_t k = 0; k < pass->count; k++) {
    for (ptrdiff_t l = p; l < p + STEP; l++) {
      if (present_at(pass->batch[k].present, l) & 1) lost += fill_one(pass, &pass->batch[k], l);
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

HOOKE_INLINE void move_on(const struct loop *loop, ptrdiff_t p, const vec sum[3]) {
  const struct hk_strided_pass *pass = loop->pass;
  const struct hk_move *move = &loop->move;
  if (__builtin_expect(move->kind == HOOKE_KICK_THEN_DRIFT, 1))
    MOVE(HOOKE_KICK_THEN_DRIFT);
  else if (move->kind != HOOKE_MOVE_NOTHING)
    move_otherwise(pass, p, sum[0], sum[1], sum[2]);
}

HOOKE_INLINE void fetch(const char *q, const char *v, ptrdiff_t stride, ptrdiff_t ahead) {
  for (int a = 0; a < 3; a++) {
    __builtin_prefetch(q + BYTES * ahead + a * stride);
    __builtin_prefetch(v + BYTES * ahead + a * stride);
  }
}

/* Lengths at p, forces one vector behind, sums two behind: all of them if the step is an inner one, and those
 * in the range of the loop otherwise. Returns how short the springs are. */
HOOKE_INLINE int64_t step(struct loop *loop, ptrdiff_t p, const int shape, const int inner) {
  const struct hk_strided_pass *pass = loop->pass;
  const int lengths = inner || p < loop->to,
            forces = inner || (p - STEP >= loop->from && p - STEP < loop->to),
            sums = inner || p - 2 * STEP >= loop->from;
  const ptrdiff_t stride = BYTES * pass->stride, ring = loop->ring_stride;
  const char *q = (const char *)(pass->q + p), *v = (const char *)(pass->v + p);
  struct batch *batch = loop->batch;
  vec x[3] = {{0}}, u[3] = {{0}}, sum[3] = {{0}}, shortest = hk_all(INFINITY);
  const int whole = forces && present_at(pass->present, p - STEP) == ALL;
  int64_t lost = 0;
  if (pass->ahead > 0) fetch(q, v, stride, pass->ahead);
  if (shape & (HOOKE_RUN_MIXED | ANY) && lengths && loop->ahead > 0 && p % HOOKE_STRIDED_UNIT == 0)
    fetch_rows(loop, p);
  for (int a = 0; a < 3 && lengths; a++) {
    x[a] = load_at(q + a * stride);
    if (shape & (HOOKE_RUN_DAMPED | ANY)) u[a] = load_at(v + a * stride);
  }
  for (const struct batch *end = batch + pass->count; batch < end; batch++) {
    const int kind = shape & ANY ? batch->shape : shape;
    if (sums && shape & PAIRED) add_pair(batch, ring, p - 2 * STEP, sum);
    if (forces) fill(batch, ring, p - STEP, kind, whole, &shortest);
    if (lengths) find_lengths(batch, q, v, stride, x, u, kind);
  }
  if (sums && !(shape & PAIRED)) add_items(loop, p - 2 * STEP, shape & SORTED, sum);
  if (shape & BENT) {
    const int all = lengths && present_at(pass->present, p) == ALL;
    for (const struct batch *end = batch + pass->bent; batch < end; batch++) {
      if (sums) add_bent(batch, ring, p - 2 * STEP, sum);
      if (lengths) fill_bent(batch, q, stride, ring, p, x, all);
    }
  }
  if (__builtin_expect(hk_has_none_left(shortest), 0)) lost = fill_with_care(pass, p - STEP);
  if ((p - STEP) % HOOKE_LEAST_RING == 0) repeat_first(pass, p - STEP);
  if (sums) move_on(loop, p - 2 * STEP, sum);
  return lost;
}

static __attribute__((noinline)) int64_t outer_step(struct loop *loop, ptrdiff_t p) {
  return step(loop, p, ANY | BENT, 0);
}

static __attribute__((noinline)) void copy_batches(const struct hk_strided_pass *pass, struct loop *loop) {
  loop->ahead = 0;
  for (int32_t k = 0; k < pass->count + pass->bent; k++) {
    const struct hk_strided_view *view = &pass->batch[k];
    if (view->material.ahead > 0) loop->ahead = view->material.ahead;
    struct batch *batch = &loop->batch[k];
    *batch = (struct batch){.offset = BYTES * view->offset,
                            .mask = BYTES * view->mask,
                            .ring = (char *)view->ring,
                            .present = view->present,
                            .unit = view->material.unit,
                            .value = view->material.value,
                            .ahead = view->material.ahead,
                            .shape = view->shape | (view->material.lean ? LEAN : 0)};
    for (int n = 0; n < HOOKE_STRIDED_NUMBERS; n++)
      batch->shared[n] = hk_all(view->shared[n]);
  }
  for (int32_t i = 0; i < 2 * pass->count; i++) {
    const struct hk_strided_item *from = &pass->item[i];
    loop->item[i] = (struct item){
        .offset = BYTES * from->offset, .mask = BYTES * from->mask, .ring = (const char *)from->ring};
  }
}

/* `shape` is that of all batches, or ANY. */
HOOKE_INLINE int64_t advance(const struct hk_strided_pass *pass, const int shape, ptrdiff_t from,
                             ptrdiff_t to) {
  struct loop loop; /* whose unused batches are not cleared */
  loop.pass = pass;
  loop.move = pass->move;
  loop.from = from;
  loop.to = to;
  loop.ring_stride = BYTES * pass->ring_stride;
  int64_t lost = 0;
  copy_batches(pass, &loop);
  ptrdiff_t p = from;
  for (; p < from + 2 * STEP; p += STEP)
    lost += outer_step(&loop, p);
  for (; p < to; p += STEP)
    lost += step(&loop, p, shape, 1);
  for (; p < to + 2 * STEP; p += STEP)
    lost += outer_step(&loop, p);
  return lost;
}

HOOKE_INLINE int32_t shape_of(const struct hk_strided_pass *pass) {
  const int32_t shape = pass->count > 0 ? pass->batch[0].shape : 0, lean = pass->batch[0].material.lean;
  const int32_t bent = pass->bent > 0 ? BENT : 0;
  int32_t paired = PAIRED, sorted = SORTED;
  for (int32_t k = 0; k < pass->count; k++) {
    const struct hk_strided_view *batch = &pass->batch[k];
    const struct hk_strided_item *item = &pass->item[2 * k];
    if (item[0].ring != batch->ring || item[1].ring != batch->ring || item[1].offset != 0) paired = 0;
    if (pass->item[k].offset == 0 || pass->item[pass->count + k].offset != 0) sorted = 0;
    if (batch->shape != shape || batch->material.lean != lean) return ANY | bent;
  }
  return shape | (paired ? paired : sorted) | bent | (lean ? LEAN : 0);
}

#define ADVANCE(shape)                                                                                       \
  case shape:                                                                                                \
    return advance(pass, shape, from, to);                                                                   \
  case PAIRED | (shape):                                                                                     \
    return advance(pass, PAIRED | (shape), from, to);                                                        \
  case SORTED | (shape):                                                                                     \
    return advance(pass, SORTED | (shape), from, to);
#define ADVANCE_LEAN(shape)                                                                                  \
  case SORTED | LEAN | (shape):                                                                              \
    return advance(pass, SORTED | LEAN | (shape), from, to);
#define ADVANCE_BENT(shape)                                                                                  \
  case PAIRED | BENT | (shape):                                                                              \
    return advance(pass, PAIRED | BENT | (shape), from, to);

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
    ADVANCE_LEAN(HOOKE_RUN_MIXED)
    ADVANCE_LEAN(HOOKE_RUN_MIXED | HOOKE_RUN_DAMPED)
    ADVANCE_BENT(0)
    ADVANCE_BENT(HOOKE_RUN_DAMPED)
  }
  return pass->bent > 0 ? advance(pass, ANY | BENT, from, to) : advance(pass, ANY, from, to);
}
