/* Pinned and driven particles are constrained in every stage. */
#include "integrate/method/stages.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/step_loops.h"

#include <stddef.h>
#include <string.h>

/* The start of the step, and the sum of the rates: of x, or of the components of q and v as in the motion. */
struct own {
  const struct hk_stages *stages;
  double *start, *sum;
};

int32_t hk_stages_create(hooke_integrator *it, const struct hk_stages *stages) {
  struct own *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->stages = stages;
  const int64_t size = it->rate ? it->size : 6 * hk_motion_stride(it->motion);
  own->start = hk_new(2 * size, sizeof(double));
  if (own->start == NULL) return HOOKE_NO_MEMORY;
  own->sum = own->start + size;
  it->own_memory += 2 * size * (int64_t)sizeof(double);
  return HOOKE_OK;
}

void hk_stages_destroy(hooke_integrator *it) {
  struct own *own = it->own;
  hk_free(own->start);
  hk_free(own);
  it->own = NULL;
}

double hk_stage_time(const hooke_integrator *it, const struct hk_stages *stages, int stage) {
  const double ahead = stages->ahead[stage];
  return ahead == 1.0 ? hk_integrator_next_time(it) : it->t + ahead * it->schedule.step;
}

void hk_stage_move(const struct hk_stages *stages, int stage, double step, int64_t count, const double *rate,
                   double *start, double *sum, double *x) {
  const double kick = step / stages->over[stage];
  if (stages->count == 1)
    hk_advance(count, kick, rate, x);
  else if (stage == 0)
    hk_first_stage(count, kick, rate, start, sum, x);
  else if (stage < stages->count - 1)
    hk_middle_stage(count, kick, rate, start, sum, x);
  else
    hk_last_stage(count, kick, rate, start, sum, x);
}

static double stage_time(const hooke_integrator *it, int stage) {
  const struct own *own = it->own;
  return hk_stage_time(it, own->stages, stage);
}

static int32_t step_rate(hooke_integrator *it) {
  const struct own *own = it->own;
  for (int stage = 0; stage < own->stages->count; stage++) {
    const int32_t status = hk_integrator_rate(it, stage_time(it, stage), it->x, it->slope);
    if (status != HOOKE_OK) {
      if (stage > 0) memcpy(it->x, own->start, (size_t)it->size * sizeof(double));
      return status;
    }
    hk_stage_move(own->stages, stage, it->schedule.step, it->size, it->slope, own->start, own->sum, it->x);
  }
  return HOOKE_OK;
}

/* Constrained particles at the time of a stage; if it is the time of the previous one the drives are not
 * called again. */
static int32_t hold(hooke_integrator *it, int stage) {
  if (it->system->constrained_count == 0 || stage == 0) return HOOKE_OK;
  const struct own *own = it->own;
  if (own->stages->ahead[stage] != own->stages->ahead[stage - 1])
    return hk_integrator_hold(it, stage_time(it, stage));
  hk_motion_hold(it->system, it->motion);
  return HOOKE_OK;
}

static int32_t move(hooke_integrator *it, int stage) {
  const struct own *own = it->own;
  const int last = own->stages->count - 1;
  const int32_t kind = stage == 0 ? HOOKE_FIRST_STAGE : stage < last ? HOOKE_MIDDLE_STAGE : HOOKE_LAST_STAGE;
  struct hk_move move;
  hk_integrator_move_of(it, kind, it->schedule.step / own->stages->over[stage], 0.0, &move);
  move.start = own->start;
  move.sum = own->sum;
  return hk_integrator_move(it, stage_time(it, stage), &move);
}

static void put_back(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const double *start = ctx;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 6; a++) {
    double *x = a < 3 ? m->q[a] : m->v[a - 3];
    memcpy(x + from, start + a * hk_motion_stride(m) + from, (size_t)count * sizeof(double));
  }
}

/* ---- an overdamped system: velocities are the rates, and those at the start are there ---- */

static void move_positions(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const struct own *own = it->own;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    const int64_t q = a * m->n + from; /* as hk_motion_save() has them */
    hk_stage_move(own->stages, *(const int *)ctx, it->schedule.step, count, m->v[a] + from, own->start + q,
                  own->sum + q, m->q[a] + from);
  }
}

static int32_t step_overdamped(hooke_integrator *it) {
  struct own *own = it->own;
  hk_motion_save(it->motion, own->start);
  for (int stage = 0; stage < own->stages->count; stage++) {
    const int last = stage + 1 == own->stages->count;
    const double t = last ? hk_integrator_next_time(it) : stage_time(it, stage + 1);
    hk_integrator_each(it, move_positions, &stage);
    int32_t status = hk_integrator_hold(it, t);
    if (status == HOOKE_OK) status = hk_integrator_flow(it, t);
    it->count.force_evaluations++;
    if (status != HOOKE_OK) {
      hk_motion_restore(it->motion, own->start);
      return status;
    }
  }
  return HOOKE_OK;
}

int32_t hk_stages_step(hooke_integrator *it) {
  if (it->rate) return step_rate(it);
  if (it->system->friction > 0.0) return step_overdamped(it);
  struct own *own = it->own;
  for (int stage = 0; stage < own->stages->count; stage++) {
    int32_t status = hold(it, stage);
    if (status == HOOKE_OK) status = move(it, stage);
    if (status != HOOKE_OK) {
      if (stage > 0) hk_integrator_each(it, put_back, own->start);
      return status;
    }
  }
  return HOOKE_OK;
}
