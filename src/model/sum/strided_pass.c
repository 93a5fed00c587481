/* The pass over strided batches, by one thread or by a thread pool. Each worker has the particles of a range.
 * Before anyone moves it computes or copies what others will have changed: the springs that begin below its
 * range and end in it, and the particles above its range where its own springs end. */
#include "core/memory.h"
#include "model/sum/motion.h"
#include "model/sum/strided.h"

#include <math.h>
#include <string.h>

/* In a system larger than the second-level cache data are prefetched: particles reached by springs for the
 * first time, so many ahead of the first spring. */
enum { PARTICLES_IN_CACHE = 20000, FETCH_AHEAD = 256 };

/* Numbers between components beside those of the rings: a power of two apart they would conflict in cache
 * sets. */
enum { FROM_POWERS_OF_TWO = 3 * HOOKE_STRIDED_UNIT };

struct partition {
  struct hk_strided_view view[HOOKE_MOST_STRIDED]; /* every batch, with its ring here */
  struct hk_strided_pass pass;                     /* batches active in the loop */
  uint8_t open[HOOKE_MOST_STRIDED];                /* 0: holds springs of another position, or none yet */
  double *border;   /* q and v, x y z apart, of the last `reach` particles, and of those after them */
  int64_t from, to; /* the range */
  int64_t at, lost; /* first particle that the loop has not reached */
};

struct hk_rings {
  int32_t workers;
  double t;                                     /* of the scaled values, NAN before the first */
  int64_t reach, border_stride, stride, memory; /* stride: between x, y and z of rings */
  double *block;
  double *value[HOOKE_MOST_STRIDED]; /* of batches that follow time, as they are then; else NULL */
  struct partition *partition;
};

struct task {
  const hooke_system *system;
  struct hk_motion *motion;
  const struct hk_move *move;
};

static int64_t larger(int64_t a, int64_t b) {
  return a > b ? a : b;
}

static int64_t lesser(int64_t a, int64_t b) {
  return a < b ? a : b;
}

static int64_t ring_capacity(const struct hk_strided_batch *batch) {
  int64_t capacity = HOOKE_LEAST_RING;
  while (capacity < batch->reach + HOOKE_RING_SLACK)
    capacity *= 2;
  return capacity;
}

static struct hk_strided_view view_of(const struct hk_strided_batches *strided, int32_t k, double *ring) {
  const struct hk_strided_batch *batch = &strided->batch[k];
  struct hk_strided_view view = {.shape = batch->shape,
                                 .present = batch->present,
                                 .offset = batch->offset,
                                 .mask = ring_capacity(batch) - 1,
                                 .ring = ring,
                                 .material = strided->material[k]};
  for (int j = 0; j < HOOKE_STRIDED_NUMBERS && k < strided->count; j++)
    view.shared[j] = *hk_strided_number(&view.material, batch->first, j);
  return view;
}

/* Values that a motion has of its own, whatever number they are. */
static int64_t scaled_values(const struct hk_strided_batch *batch) {
  return batch->scaling ? batch->values : 0;
}

static void take_values(const struct hk_strided_batches *strided, struct hk_rings *rings, double *next) {
  rings->t = NAN;
  for (int32_t k = 0; k < strided->count; next += scaled_values(&strided->batch[k++])) {
    if (strided->batch[k].scaling == NULL) continue;
    rings->value[k] = next;
    for (int32_t m = 0; m < rings->workers; m++)
      rings->partition[m].view[k].material.value = next;
  }
}

static void scale_batch(const struct hk_strided_batches *strided, int32_t k, struct hk_rings *rings) {
  const struct hk_strided_batch *batch = &strided->batch[k];
  const double *given = strided->material[k].value;
  struct hk_scaler scaler = {.t = rings->t};
  hk_scaler_find(&scaler, batch->scaling);
  const double by[HOOKE_STRIDED_NUMBERS] = {[HOOKE_STRIDED_KAPPA] = scaler.by.kappa,
                                            [HOOKE_STRIDED_GAMMA] = scaler.by.gamma,
                                            [HOOKE_STRIDED_REST] = scaler.by.rest_length};
  const int64_t mixed = strided->material[k].lean ? HOOKE_STRIDED_ROW : scaled_values(batch);
  for (int64_t at = 0; at < mixed; at++)
    rings->value[k][at] = given[at] * by[at / HOOKE_STRIDED_UNIT % HOOKE_STRIDED_NUMBERS];
  for (int64_t at = mixed; at < scaled_values(batch); at++)
    rings->value[k][at] = given[at] * by[HOOKE_STRIDED_REST];
  for (int32_t m = 0; m < rings->workers; m++) {
    struct hk_strided_view *view = &rings->partition[m].view[k];
    for (int j = 0; j < HOOKE_STRIDED_NUMBERS; j++)
      view->shared[j] = *hk_strided_number(&view->material, batch->first, j);
  }
}

static void scale(const struct hk_strided_batches *strided, double t, struct hk_rings *rings) {
  if (t == rings->t) return;
  rings->t = t;
  for (int32_t k = 0; k < strided->count; k++)
    if (strided->batch[k].scaling) scale_batch(strided, k, rings);
}

struct hk_rings *hk_rings_create(const struct hk_strided_batches *strided, int32_t workers) {
  struct hk_rings *rings = hk_new(1, sizeof *rings);
  if (rings == NULL) return NULL;
  int64_t values = 0;
  rings->stride = FROM_POWERS_OF_TWO;
  for (int32_t k = 0; k < strided->count + strided->bent; k++) {
    rings->stride += ring_capacity(&strided->batch[k]) + HOOKE_STRIDED_UNIT;
    values += scaled_values(&strided->batch[k]);
  }
  rings->workers = workers;
  rings->reach = strided->reach;
  rings->border_stride = 2 * strided->reach + HOOKE_STRIDED_UNIT;
  const int64_t numbers = 3 * rings->stride + (workers > 1 ? 6 * rings->border_stride : 0);
  rings->partition = hk_new(workers, sizeof *rings->partition);
  rings->block = hk_new(workers * numbers + values, sizeof(double));
  rings->memory = (int64_t)sizeof *rings + workers * (int64_t)sizeof *rings->partition +
                  (workers * numbers + values) * (int64_t)sizeof(double);
  if (rings->partition == NULL || rings->block == NULL) {
    hk_rings_destroy(rings);
    return NULL;
  }
  for (int32_t m = 0; m < workers; m++) {
    double *ring = rings->block + m * numbers;
    rings->partition[m].border = ring + 3 * rings->stride;
    for (int32_t k = 0; k < strided->count + strided->bent; k++) {
      rings->partition[m].view[k] = view_of(strided, k, ring);
      ring += ring_capacity(&strided->batch[k]) + HOOKE_STRIDED_UNIT;
    }
  }
  take_values(strided, rings, rings->block + workers * numbers);
  return rings;
}

void hk_rings_destroy(struct hk_rings *rings) {
  if (rings == NULL) return;
  hk_free(rings->partition);
  hk_free(rings->block);
  hk_free(rings);
}

int64_t hk_rings_memory(const struct hk_rings *rings) {
  return rings ? rings->memory : 0;
}

/* Clears the springs below particle `from`, as far as the ring is read from there on. */
static void clear_below(const struct hk_strided_view *batch, int64_t reach, int64_t stride, int64_t from) {
  const int64_t capacity = batch->mask + 1, first = (from - reach) & batch->mask,
                before_end = lesser(reach, capacity - first), wrapped = reach - before_end;
  for (int a = 0; a < 3; a++) {
    double *x = batch->ring + a * stride;
    memset(x + first, 0, (size_t)before_end * sizeof(double));
    memset(x, 0, (size_t)wrapped * sizeof(double));
    memset(x + capacity, 0, (size_t)lesser(wrapped, HOOKE_STRIDED_UNIT) * sizeof(double));
  }
}

/* Items of the marked batches. */
static void set_items(const struct hk_strided_batches *strided, const uint8_t *there,
                      struct partition *partition) {
  struct hk_strided_item *next = partition->pass.item;
  for (int32_t i = 0; i < 2 * strided->count; i++) {
    const struct hk_strided_view *batch = &partition->view[strided->item[i] / 2];
    if (!there[strided->item[i] / 2]) continue;
    *next++ = (struct hk_strided_item){batch->ring, strided->item[i] % 2 ? 0 : batch->offset, batch->mask};
  }
}

/* Makes a pass of the batches that have springs at particle `from` or whose springs end there, without the
 * part `left_out` of their shapes; returns the particle up to which these are all, `to` at most. */
static int64_t set_strided(const struct hk_strided_batches *strided, int32_t left_out,
                           struct partition *partition, int64_t from, int64_t to) {
  uint8_t there[HOOKE_MOST_STRIDED] = {0};
  partition->pass.count = partition->pass.bent = 0;
  for (int32_t k = 0; k < strided->count + strided->bent; k++) {
    const struct hk_strided_batch *batch = &strided->batch[k];
    const int64_t begin = batch->first / HOOKE_STRIDED_UNIT * HOOKE_STRIDED_UNIT,
                  end = hk_whole_units(batch->last + batch->reach + 1);
    if (from < begin) to = lesser(to, begin);
    if (from < begin || from >= end) continue;
    to = lesser(to, end);
    if (!partition->open[k])
      clear_below(&partition->view[k], batch->reach, partition->pass.ring_stride, from);
    partition->open[k] = there[k] = 1;
    struct hk_strided_view *next = &partition->pass.batch[partition->pass.count + partition->pass.bent];
    *next = partition->view[k];
    next->shape &= ~left_out;
    partition->pass.count += k < strided->count;
    partition->pass.bent += k >= strided->count;
  }
  set_items(strided, there, partition);
  return to;
}

static void advance(const struct task *task, struct partition *partition, int32_t kind, int64_t to) {
  partition->pass.move.kind = kind;
  for (int64_t from = partition->at; from < to; from = partition->at) {
    const int32_t left_out = task->motion->zero ? HOOKE_RUN_DAMPED : 0;
    partition->at = set_strided(task->system->strided, left_out, partition, from, to);
    partition->lost += hk_spring_set(0)->strided(&partition->pass, from, partition->at);
  }
}

/* Passes over particles that are not stepped, where no springs begin; skips them if the springs from below do
 * not extend over them. */
static void skip(const struct task *task, struct partition *partition, int64_t to) {
  if (to - partition->at >= task->motion->rings->reach) {
    memset(partition->open, 0, sizeof partition->open);
    partition->at = to;
  }
  advance(task, partition, HOOKE_MOVE_NOTHING, to);
}

/* Processes all stepped particles from the current one of the partition up to `to`. */
static void go_on(const struct task *task, struct partition *partition, int32_t kind, int64_t to) {
  const hooke_system *system = task->system;
  for (int64_t s = 0; s < system->span_count && partition->at < to; s++) {
    const int64_t from = larger(system->span[s].from, partition->at),
                  end = lesser(hk_whole_units(system->span[s].from + system->span[s].count), to);
    if (from >= end) continue;
    skip(task, partition, from);
    advance(task, partition, kind, end);
  }
}

/* Components of q and v of `count` particles. */
static void copy(double *const q, double *const v, ptrdiff_t stride, double *const to_q, double *const to_v,
                 ptrdiff_t to_stride, int64_t count) {
  for (int a = 0; a < 3; a++) {
    memcpy(to_q + a * to_stride, q + a * stride, (size_t)count * sizeof(double));
    memcpy(to_v + a * to_stride, v + a * stride, (size_t)count * sizeof(double));
  }
}

static void begin(const struct task *task, struct partition *partition, int32_t worker, int32_t workers) {
  const struct hk_motion *m = task->motion;
  partition->from = hk_pool_share(m->n, HOOKE_TILE, worker, workers);
  partition->to = hk_whole_units(hk_pool_share(m->n, HOOKE_TILE, worker + 1, workers));
  partition->pass.present = task->system->strided->present;
  partition->pass.ring_stride = m->rings->stride;
  partition->pass.stride = hk_motion_stride(m);
  partition->pass.q = m->q[0];
  partition->pass.v = m->v[0];
  partition->pass.w = m->w;
  partition->pass.move = *task->move;
  partition->pass.ahead = m->n > PARTICLES_IN_CACHE ? m->rings->reach + FETCH_AHEAD : 0;
  memset(partition->open, 0, sizeof partition->open);
  partition->at = larger(0, partition->from - m->rings->reach);
  partition->lost = 0;
}

/* Reads everything that is needed before anyone moves. */
static void prepare(const struct task *task, struct partition *partition) {
  const struct hk_motion *m = task->motion;
  const int64_t stride = m->rings->border_stride, reach = m->rings->reach;
  go_on(task, partition, HOOKE_MOVE_NOTHING, partition->from);
  partition->lost = 0; /* others count these springs */
  if (partition->to < m->n) {
    double *q = partition->border + reach;
    copy(m->q[0] + partition->to, m->v[0] + partition->to, partition->pass.stride, q, q + 3 * stride, stride,
         reach + HOOKE_STRIDED_UNIT);
  }
}

/* The last particles of the range, together with those that others move meanwhile. */
static void finish(const struct task *task, struct partition *partition) {
  const struct hk_motion *m = task->motion;
  const int64_t stride = m->rings->border_stride,
                from = larger(partition->from, partition->to - m->rings->reach), count = partition->to - from;
  double *q = partition->border + m->rings->reach - count, *v = q + 3 * stride;
  copy(m->q[0] + from, m->v[0] + from, partition->pass.stride, q, v, stride, count);
  partition->pass.q = q - from;
  partition->pass.v = v - from;
  partition->pass.stride = stride;
  go_on(task, partition, task->move->kind, partition->to);
  copy(q, v, stride, m->q[0] + from, m->v[0] + from, hk_motion_stride(m), count);
}

static void go_over(int32_t worker, int32_t workers, void *ctx) {
  const struct task *task = ctx;
  const struct hk_motion *m = task->motion;
  struct partition *partition = &m->rings->partition[worker];
  begin(task, partition, worker, workers);
  if (workers > 1) {
    prepare(task, partition);
    hk_pool_barrier(m->pool);
  }
  if (partition->to >= m->n || task->move->kind == HOOKE_MOVE_KEEP) {
    go_on(task, partition, task->move->kind, partition->to);
    return;
  }
  go_on(task, partition, task->move->kind, partition->to - m->rings->reach);
  skip(task, partition, partition->to - m->rings->reach);
  finish(task, partition);
}

int64_t hk_strided_batches_pass(const hooke_system *system, struct hk_motion *motion, double t,
                                const struct hk_move *move) {
  struct task task = {system, motion, move};
  int64_t lost = 0;
  if (system->springs->scaled) scale(system->strided, t, motion->rings);
  hk_pool_run(motion->pool, go_over, &task);
  for (int32_t m = 0; m < hk_pool_members(motion->pool); m++)
    lost += motion->rings->partition[m].lost;
  return lost;
}
