/* Steps of explicit Runge-Kutta methods. Pinned and driven particles are constrained in every stage. */
#include "core/memory.h"
#include "integrate/integrator.h"
#include "kernel/step_loops.h"
#include "model/coordinates/coordinates.h"

#include <string.h>

/* `own` has the start of the step and the sum of the rates: components of q and v as in the motion. */
static int32_t create(hooke_integrator *it) {
  if (it->rate) return HOOKE_OK;
  const int may_stop = it->system->force || it->system->drive_count > 0; /* and movers have their own */
  const int whole = it->system->overdamped || (it->system->mover_count > 0 && may_stop);
  if (whole && hk_integrator_keep_start(it) != HOOKE_OK) return HOOKE_NO_MEMORY;
  if (it->method->stages.count == 1 && !it->system->overdamped) return HOOKE_OK;
  const int64_t numbers = 12 * hk_motion_stride(it->motion);
  it->own = hk_new(numbers, sizeof(double));
  it->own_memory += numbers * (int64_t)sizeof(double);
  return it->own ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void destroy(hooke_integrator *it) {
  hk_free(it->own);
  it->own = NULL;
}

static double *sum_of(const hooke_integrator *it) {
  return (double *)it->own + 6 * hk_motion_stride(it->motion);
}

/* A stage is a step over this ahead; 0: at the start. The one past the last is the end. */
static int32_t ahead_over(const hooke_integrator *it, int stage) {
  return stage == 0 ? 0 : stage == it->method->stages.count ? 1 : it->method->stages.over[stage - 1];
}

static double stage_time(const hooke_integrator *it, int stage) {
  const int32_t over = ahead_over(it, stage);
  return over == 1 ? hk_integrator_next_time(it) : over == 0 ? it->t : it->t + it->schedule.step / over;
}

/* How long the rate of a stage lasts. */
static double kick_of(const hooke_integrator *it, int stage) {
  return it->schedule.step / it->method->stages.over[stage];
}

static int32_t kind_of(const hooke_integrator *it, int stage) {
  const int last = it->method->stages.count - 1;
  return last == 0      ? HOOKE_DRIFT_THEN_KICK
         : stage == 0   ? HOOKE_FIRST_STAGE
         : stage < last ? HOOKE_MIDDLE_STAGE
                        : HOOKE_LAST_STAGE;
}

/* ---- a first-order problem ---- */

static int32_t step_numbers(hooke_integrator *it) {
  const struct hk_numbers *y = &it->numbers;
  for (int stage = 0; stage < it->method->stages.count; stage++) {
    const int32_t status = hk_integrator_rate(it, stage_time(it, stage), y->x, y->rate);
    if (status != HOOKE_OK) {
      if (stage > 0) memcpy(y->x, y->start, (size_t)y->count * sizeof(double));
      return status;
    }
    hk_move_numbers(kind_of(it, stage), kick_of(it, stage), y->count, y->rate, y->start, y->sum, y->x);
  }
  return HOOKE_OK;
}

/* ---- particles ---- */

/* Constrained particles at the time of a stage; if it is the time of the previous one the drives are not
 * called again. */
static int32_t hold(hooke_integrator *it, int stage) {
  if (it->system->constrained_count == 0 || stage == 0) return HOOKE_OK;
  if (ahead_over(it, stage) != ahead_over(it, stage - 1))
    return hk_integrator_hold(it, stage_time(it, stage));
  hk_motion_hold(it->system, it->motion);
  return HOOKE_OK;
}

static int32_t move(hooke_integrator *it, int stage) {
  const double kick = kick_of(it, stage);
  struct hk_move move;
  hk_integrator_move_of(it, kind_of(it, stage), kick, kick, &move);
  if (it->own) move.start = it->own, move.sum = sum_of(it);
  return hk_integrator_move(it, stage_time(it, stage), &move);
}

/* Where the step began, after a callback stopped it midway. */
static void put_back(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const double *start = ctx;
  for (int64_t a = 0, at = from; a < 6; a++, at += hk_motion_stride(it->motion))
    memcpy(it->motion->q[0] + at, start + at, (size_t)count * sizeof(double));
}

/* ---- an overdamped system: velocities are the rates, and those at the start are there ---- */

static void move_positions(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  double *start = it->own, *sum = sum_of(it);
  struct hk_motion *m = it->motion;
  const int stage = *(const int *)ctx;
  for (int a = 0; a < 3; a++) {
    const int64_t at = a * hk_motion_stride(m) + from;
    hk_move_numbers(kind_of(it, stage), kick_of(it, stage), count, m->v[0] + at, start + at, sum + at,
                    m->q[0] + at);
  }
}

static int32_t step_overdamped(hooke_integrator *it) {
  int32_t status = HOOKE_OK;
  for (int stage = 0; stage < it->method->stages.count && status == HOOKE_OK; stage++) {
    const double t = stage_time(it, stage + 1);
    hk_integrator_each(it, move_positions, &stage);
    status = hk_integrator_hold(it, t);
    if (status == HOOKE_OK) status = hk_integrator_flow(it, t);
    it->count.force_evaluations++;
  }
  return status;
}

static int32_t step(hooke_integrator *it) {
  int32_t status = HOOKE_OK;
  if (it->rate) return step_numbers(it);
  if (it->system->overdamped) return step_overdamped(it);
  if (it->numbers.x) { /* forces are those there */
    hk_movers_read(it->system, it->motion, it->numbers.x);
    hk_movers_write(it->system, it->motion, it->numbers.x, hk_integrator_skips_unacted(it));
  }
  for (int stage = 0; stage < it->method->stages.count && status == HOOKE_OK; stage++) {
    status = hold(it, stage);
    if (status == HOOKE_OK) status = move(it, stage);
    if (status != HOOKE_OK && stage > 0) hk_integrator_each(it, put_back, it->own);
  }
  return status;
}

const struct hk_steps hk_explicit_steps = {create, destroy, NULL, hk_fixed_begin, step, hk_fixed_store};
