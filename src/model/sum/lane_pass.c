/* The pass over lanes, by one thread or by a thread pool. Each worker has the particles of a range. What
 * others will have moved when it comes to it, it computes or copies before anyone moves: the springs that
 * begin below its range and end in it, and the particles above its range where its own springs end. */
#include "core/memory.h"
#include "model/sum/motion.h"

#include <string.h>

/* In a system larger than a cache of the second level the processor is told what it will need: particles that
 * springs reach for the first time, so many before the first spring does. */
enum { PARTICLES_IN_CACHE = 20000, FETCH_AHEAD = 256 };

struct share {
  struct hk_lane_view view[HOOKE_MOST_LANES]; /* every lane, with its ring here */
  struct hk_lane_pass pass;                   /* lanes that the loop is at */
  uint8_t open[HOOKE_MOST_LANES];             /* 0: has springs of another place, or none yet */
  double *border; /* q and v, x y z apart, of `reach` particles at the end of the range, and of those after */
  int64_t from, to; /* the range */
  int64_t at, lost; /* the first particle that the loop has not come to */
};

struct hk_rings {
  int32_t workers;
  int64_t reach, border_stride, memory;
  double *block;
  struct share *share;
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

static int64_t whole_units(int64_t count) {
  return (count + HOOKE_LANE_UNIT - 1) / HOOKE_LANE_UNIT * HOOKE_LANE_UNIT;
}

static int64_t ring_room(const struct hk_lane *lane) {
  int64_t room = HOOKE_LANE_UNIT;
  while (room < lane->offset + HOOKE_RING_SLACK)
    room *= 2;
  return room;
}

static struct hk_lane_view view_of(const struct hk_lanes *lanes, int32_t k, double *ring) {
  const struct hk_lane *lane = &lanes->lane[k];
  struct hk_lane_view view = {.shape = lane->shape,
                              .present = lane->present,
                              .offset = lane->offset,
                              .mask = ring_room(lane) - 1,
                              .ring = ring,
                              .material = lanes->material[k]};
  for (int j = 0; j < HOOKE_LANE_NUMBERS; j++)
    view.shared[j] = *hk_lane_number(&view.material, lane->first, j);
  return view;
}

static int64_t ring_size(const struct hk_lane *lane) {
  return 3 * hk_ring_stride(ring_room(lane) - 1);
}

struct hk_rings *hk_rings_create(const struct hk_lanes *lanes, int32_t workers) {
  struct hk_rings *rings = hk_new(1, sizeof *rings);
  if (rings == NULL) return NULL;
  int64_t numbers = 0;
  for (int32_t k = 0; k < lanes->count; k++)
    numbers += ring_size(&lanes->lane[k]);
  rings->workers = workers;
  rings->reach = lanes->reach;
  rings->border_stride = 2 * lanes->reach + HOOKE_LANE_UNIT;
  numbers += workers > 1 ? 6 * rings->border_stride : 0;
  rings->share = hk_new(workers, sizeof *rings->share);
  rings->block = hk_new(workers * numbers, sizeof(double));
  rings->memory = (int64_t)sizeof *rings + workers * (int64_t)sizeof *rings->share +
                  workers * numbers * (int64_t)sizeof(double);
  if (rings->share == NULL || rings->block == NULL) {
    hk_rings_destroy(rings);
    return NULL;
  }
  double *next = rings->block;
  for (int32_t m = 0; m < workers; m++) {
    for (int32_t k = 0; k < lanes->count; next += ring_size(&lanes->lane[k++]))
      rings->share[m].view[k] = view_of(lanes, k, next);
    rings->share[m].border = next;
    next += workers > 1 ? 6 * rings->border_stride : 0;
  }
  return rings;
}

void hk_rings_destroy(struct hk_rings *rings) {
  if (rings == NULL) return;
  hk_free(rings->share);
  hk_free(rings->block);
  hk_free(rings);
}

int64_t hk_rings_memory(const struct hk_rings *rings) {
  return rings ? rings->memory : 0;
}

/* No springs below particle `from`, as far as the ring is read from there on. */
static void clear_below(const struct hk_lane_view *lane, int64_t from) {
  const int64_t room = lane->mask + 1, first = (from - lane->offset) & lane->mask,
                before_end = lesser(lane->offset, room - first), wrapped = lane->offset - before_end;
  for (int a = 0; a < 3; a++) {
    double *x = lane->ring + a * hk_ring_stride(lane->mask);
    memset(x + first, 0, (size_t)before_end * sizeof(double));
    memset(x, 0, (size_t)wrapped * sizeof(double));
    memset(x + room, 0, (size_t)lesser(wrapped, HOOKE_LANE_UNIT) * sizeof(double));
  }
}

/* Items of the lanes that are marked. */
static void set_items(const struct hk_lanes *lanes, const uint8_t *there, struct share *share) {
  struct hk_lane_item *next = share->pass.item;
  for (int32_t i = 0; i < 2 * lanes->count; i++) {
    const struct hk_lane_view *lane = &share->view[lanes->item[i] / 2];
    const int begins = lanes->item[i] % 2;
    if (!there[lanes->item[i] / 2]) continue;
    *next++ = (struct hk_lane_item){lane->ring, begins ? 0 : lane->offset, lane->mask, begins ? -1.0 : 1.0};
  }
}

/* Makes a pass, without the part `left_out` of their shapes, of the lanes that have springs at particle `from` or whose springs end there; returns the
 * particle up to which these are all, `to` at most. */
static int64_t set_lanes(const struct hk_lanes *lanes, int32_t left_out, struct share *share, int64_t from,
                         int64_t to) {
  uint8_t there[HOOKE_MOST_LANES] = {0};
  share->pass.count = 0;
  for (int32_t k = 0; k < lanes->count; k++) {
    const struct hk_lane *lane = &lanes->lane[k];
    const int64_t begin = lane->first / HOOKE_LANE_UNIT * HOOKE_LANE_UNIT,
                  end = whole_units(lane->last + lane->offset + 1);
    if (from < begin) to = lesser(to, begin);
    if (from < begin || from >= end) continue;
    to = lesser(to, end);
    if (!share->open[k]) clear_below(&share->view[k], from);
    share->open[k] = there[k] = 1;
    share->pass.lane[share->pass.count] = share->view[k];
    share->pass.lane[share->pass.count++].shape &= ~left_out;
  }
  set_items(lanes, there, share);
  return to;
}

static void advance(const struct task *task, struct share *share, int32_t kind, int64_t to) {
  share->pass.move.kind = kind;
  for (int64_t from = share->at; from < to; from = share->at) {
    const int32_t left_out = task->motion->zero ? HOOKE_RUN_DAMPED : 0;
    share->at = set_lanes(&task->system->lanes, left_out, share, from, to);
    share->lost += hk_spring_set(0)->lanes(&share->pass, from, share->at);
  }
}

/* Over particles that are not stepped, where no springs begin; none at all if the springs from below do not
 * reach over them. */
static void skip(const struct task *task, struct share *share, int64_t to) {
  if (to - share->at >= task->motion->rings->reach) {
    memset(share->open, 0, sizeof share->open);
    share->at = to;
  }
  advance(task, share, HOOKE_MOVE_NOTHING, to);
}

/* All that is stepped from where the share is up to `to`. */
static void go_on(const struct task *task, struct share *share, int32_t kind, int64_t to) {
  const hooke_system *system = task->system;
  for (int64_t s = 0; s < system->span_count && share->at < to; s++) {
    const int64_t from = larger(system->span[s].from, share->at),
                  end = lesser(whole_units(system->span[s].from + system->span[s].count), to);
    if (from >= end) continue;
    skip(task, share, from);
    advance(task, share, kind, end);
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

static void begin(const struct task *task, struct share *share, int32_t worker, int32_t workers) {
  const struct hk_motion *m = task->motion;
  share->from = hk_pool_share(m->n, HOOKE_TILE, worker, workers);
  share->to = whole_units(hk_pool_share(m->n, HOOKE_TILE, worker + 1, workers));
  share->pass.stride = m->q[1] - m->q[0];
  share->pass.q = m->q[0];
  share->pass.v = m->v[0];
  share->pass.f = m->f[0];
  share->pass.w = m->w;
  share->pass.move = *task->move;
  share->pass.ahead = m->n > PARTICLES_IN_CACHE ? m->rings->reach + FETCH_AHEAD : 0;
  memset(share->open, 0, sizeof share->open);
  share->at = larger(0, share->from - m->rings->reach);
  share->lost = 0;
}

/* What has to be read before anyone moves. */
static void prepare(const struct task *task, struct share *share) {
  const struct hk_motion *m = task->motion;
  const int64_t stride = m->rings->border_stride, reach = m->rings->reach;
  go_on(task, share, HOOKE_MOVE_NOTHING, share->from);
  share->lost = 0; /* others count these springs */
  if (share->to < m->n) {
    double *q = share->border + reach;
    copy(m->q[0] + share->to, m->v[0] + share->to, share->pass.stride, q, q + 3 * stride, stride,
         reach + HOOKE_LANE_UNIT);
  }
}

/* The last particles of the range, together with those that others move meanwhile. */
static void finish(const struct task *task, struct share *share) {
  const struct hk_motion *m = task->motion;
  const int64_t stride = m->rings->border_stride, from = larger(share->from, share->to - m->rings->reach),
                count = share->to - from;
  double *q = share->border + m->rings->reach - count, *v = q + 3 * stride;
  copy(m->q[0] + from, m->v[0] + from, share->pass.stride, q, v, stride, count);
  share->pass.q = q - from;
  share->pass.v = v - from;
  share->pass.stride = stride;
  go_on(task, share, task->move->kind, share->to);
  copy(q, v, stride, m->q[0] + from, m->v[0] + from, m->q[1] - m->q[0], count);
}

static void go_over(int32_t worker, int32_t workers, void *ctx) {
  const struct task *task = ctx;
  const struct hk_motion *m = task->motion;
  struct share *share = &m->rings->share[worker];
  begin(task, share, worker, workers);
  if (workers > 1) {
    prepare(task, share);
    hk_pool_barrier(m->pool);
  }
  if (share->to >= m->n || task->move->kind == HOOKE_MOVE_KEEP) {
    go_on(task, share, task->move->kind, share->to);
    return;
  }
  go_on(task, share, task->move->kind, share->to - m->rings->reach);
  skip(task, share, share->to - m->rings->reach);
  finish(task, share);
}

int64_t hk_lanes_pass(const hooke_system *system, struct hk_motion *motion, const struct hk_move *move) {
  struct task task = {system, motion, move};
  int64_t lost = 0;
  hk_pool_run(motion->pool, go_over, &task);
  for (int32_t m = 0; m < hk_pool_members(motion->pool); m++)
    lost += motion->rings->share[m].lost;
  return lost;
}
