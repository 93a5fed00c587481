/* Common parts of all fixed-step methods: counted forces and rates, loading and storing. */
#include "integrate/integrator.h"
#include "kernel/step_loops.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/coordinates/coordinates.h"
#include "model/force/force.h"
#include "model/generalized.h"
#include "model/sum/strided.h"

#include <stddef.h>
#include <string.h>

static int32_t keep_stop_value(hooke_integrator *it, int32_t status) {
  if (status == HOOKE_STOPPED) it->stop_value = it->motion->stop_value;
  return status;
}

int32_t hk_integrator_forces(hooke_integrator *it, double t) {
  return hk_integrator_forces_without(it, t, 0);
}

int32_t hk_integrator_forces_without(hooke_integrator *it, double t, int32_t left_out) {
  it->count.force_evaluations++;
  return keep_stop_value(it, hk_motion_forces_without(it->system, it->motion, t, left_out));
}

int32_t hk_integrator_keep_start(hooke_integrator *it) {
  it->start = hk_new(2 * it->size, sizeof(double));
  it->own_memory += 2 * it->size * (int64_t)sizeof(double);
  return it->start ? HOOKE_OK : HOOKE_NO_MEMORY;
}

struct sharing {
  hooke_integrator *integrator;
  hk_particle_work *work;
  void *ctx;
};

static void work_on_share(int32_t worker, int32_t workers, void *ctx) {
  const struct sharing *sharing = ctx;
  const hooke_system *system = sharing->integrator->system;
  const int64_t n = system->particle_count, first = hk_pool_share(n, HOOKE_TILE, worker, workers),
                last = hk_pool_share(n, HOOKE_TILE, worker + 1, workers);
  for (int64_t s = 0; s < system->span_count; s++) {
    const struct hk_span span = system->span[s];
    const int64_t from = span.from > first ? span.from : first,
                  end = span.from + span.count < last ? span.from + span.count : last;
    if (from < end) sharing->work(sharing->integrator, from, end - from, sharing->ctx);
  }
}

void hk_integrator_each(hooke_integrator *it, hk_particle_work *work, void *ctx) {
  hk_pool_run(it->motion->pool, work_on_share, &(struct sharing){it, work, ctx});
}

/* Field by field: a copy of the whole would wait for what was just written in pieces. */
void hk_integrator_move_of(const hooke_integrator *it, int32_t kind, double kick, double drift,
                           struct hk_move *move) {
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  move->kind = kind;
  move->heavy = system->falls;
  move->gravity_factor = system->falls ? system->gravity_factor : NULL;
  move->kick = kick;
  move->drift = drift;
  move->drag = m->zero ? 0.0 : system->brake;
  for (int a = 0; a < 3; a++)
    move->gravity[a] = system->fall[a];
  move->stride = hk_motion_stride(m);
  move->f = m->f[0];
  move->half = move->start = move->sum = NULL;
}

static void move_share(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const struct hk_motion *m = it->motion;
  const struct hk_moved moved = hk_motion_moved(m);
  const double *const f[3] = {m->f[0] + from, m->f[1] + from, m->f[2] + from};
  hk_spring_set(0)->move(ctx, &moved, (ptrdiff_t)from, (ptrdiff_t)count, f);
}

/* As in move_loops.h, with `start` for u. */
static void move_own(const struct hk_mover *m, const struct hk_move *move, const double *push,
                     const struct hk_numbers *own) {
  const size_t bytes = (size_t)m->row->numbers * sizeof(double);
  double *x = own->x + m->at, *start = own->start + m->at;
  if (move->kind == HOOKE_CORRECT) {
    memcpy(x, start, bytes);
    m->row->kick(m->thing, move->kick, push, x);
  } else if (move->kind == HOOKE_KICK_THEN_DRIFT || move->kind == HOOKE_PREDICT) {
    m->row->kick(m->thing, move->kick, push, x);
    m->row->drift(m->thing, move->drift, x);
    if (move->kind == HOOKE_KICK_THEN_DRIFT) return;
    memcpy(start, x, bytes);
    m->row->kick(m->thing, move->kick, push, x);
  } else {
    m->row->slope(m->thing, x, push, own->rate + m->at);
    hk_move_numbers(move->kind, move->kick, m->row->numbers, own->rate + m->at, start, own->sum + m->at, x);
  }
}

int32_t hk_integrator_skips_unacted(const hooke_integrator *it) {
  return it->system && it->numbers.x && it->start == NULL && it->system->force == NULL;
}

/* Stages between have quaternions of other lengths. */
static void move_with_movers(hooke_integrator *it, struct hk_move *move) {
  const hooke_system *system = it->system;
  const struct hk_numbers *own = &it->numbers;
  const int32_t kind = move->kind;
  if (kind == HOOKE_KICK_THEN_DRIFT || kind == HOOKE_PREDICT) hk_movers_read(system, it->motion, own->x);
  hk_movers_push(system, it->motion, own->x, own->push);
  hk_integrator_each(it, move_share, move);
  for (int64_t k = 0; k < system->mover_count; k++)
    move_own(&system->mover[k], move, own->push + HOOKE_PUSH * k, own);
  if (kind != HOOKE_FIRST_STAGE && kind != HOOKE_MIDDLE_STAGE) hk_movers_normalise(system, own->x);
  hk_movers_write(system, it->motion, own->x, hk_integrator_skips_unacted(it));
}

void hk_integrator_move_on(hooke_integrator *it, struct hk_move *move) {
  if (it->system->mover_count > 0)
    move_with_movers(it, move);
  else
    hk_integrator_each(it, move_share, move);
}

/* Drag is part of the move, except where a force comes after it in the sum, and with movers, which it pushes.
 */
int32_t hk_integrator_move(hooke_integrator *it, double t, struct hk_move *move) {
  if (it->by_tiles) {
    it->count.force_evaluations++;
    hk_motion_pass(it->system, it->motion, t, move);
    return HOOKE_OK;
  }
  const hooke_system *system = it->system;
  const int summed = system->mover_count > 0 || (system->sums_after_drag && !hk_move_brakes(move->kind));
  const int32_t status = hk_integrator_forces_without(it, t, summed ? 0 : HOOKE_UNIFORM);
  if (summed) move->drag = 0.0;
  if (status == HOOKE_OK) hk_integrator_move_on(it, move);
  return status;
}

double hk_integrator_next_time(const hooke_integrator *it) {
  return it->t0 + (double)(it->k + 1) * it->schedule.step;
}

static void set_rates(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  (void)ctx;
  const double *w = it->system->inverse_mass;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    for (int64_t p = from; p < from + count; p++)
      m->v[a][p] = w[p] * m->f[a][p];
  }
}

int32_t hk_integrator_flow(hooke_integrator *it, double t) {
  if (!it->system->overdamped) return HOOKE_OK;
  const int32_t status = keep_stop_value(it, hk_motion_forces(it->system, it->motion, t));
  if (status != HOOKE_OK) return status;
  hk_integrator_each(it, set_rates, NULL);
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
  return HOOKE_OK;
}

int32_t hk_integrator_drive(hooke_integrator *it, double t) {
  if (it->system == NULL || it->system->drive_count == 0) return HOOKE_OK;
  return keep_stop_value(it, hk_motion_drive(it->system, it->motion, t));
}

int32_t hk_integrator_hold(hooke_integrator *it, double t) {
  const int32_t status = hk_integrator_drive(it, t);
  if (status == HOOKE_OK) hk_motion_hold(it->system, it->motion);
  return status;
}

int32_t hk_integrator_rate(hooke_integrator *it, double t, const double *x, double *slope) {
  it->count.force_evaluations++;
  const size_t bytes = (size_t)it->size * sizeof *x;
  if (hk_rows_renew(2 * it->size, &it->rows) != HOOKE_OK) return HOOKE_NO_MEMORY;
  memcpy(it->rows, x, bytes);
  const int32_t value = it->rate(it->size, t, it->rows, it->rows + it->size, it->rate_ctx);
  memcpy(slope, it->rows + it->size, bytes);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hk_fail(HOOKE_STOPPED, NULL, "the rate callback returned %d at t = %.6g s", (int)value, t);
}

int32_t hk_fixed_begin(hooke_integrator *it, const hooke_state *state) {
  if (it->motion)
    hk_motion_load(it->system, it->motion, state->q, state->v);
  else
    memcpy(it->numbers.x, state->q, (size_t)it->size * sizeof(double));
  return HOOKE_OK;
}

int32_t hk_fixed_store(hooke_integrator *it, double t, hooke_state *state) {
  if (it->motion)
    hk_motion_store(it->motion, state->q, state->v);
  else
    memcpy(state->q, it->numbers.x, (size_t)it->size * sizeof(double));
  *state->t = t;
  return HOOKE_OK;
}

int64_t hk_integrator_numbers(const hooke_integrator *it) {
  return it->system ? hk_system_numbers(it->system) : it->size;
}
