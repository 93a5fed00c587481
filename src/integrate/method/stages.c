/* Pinned and driven particles are constrained in every stage. */
#include "integrate/method/stages.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/step_loops.h"

#include <stddef.h>
#include <string.h>

/* The start of the step, and the sum of the rates: of x, or of q and v, each 3 components of n. */
struct own {
  const struct hk_stages *stages;
  double *start, *sum;
};

int32_t hk_stages_create(hooke_integrator *it, const struct hk_stages *stages) {
  struct own *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->stages = stages;
  const int64_t size = (it->rate ? 1 : 2) * it->size;
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

static double ahead_of(const hooke_integrator *it, int stage) {
  const struct own *own = it->own;
  return own->stages->ahead[stage];
}

static double stage_time(const hooke_integrator *it, int stage) {
  const double ahead = ahead_of(it, stage);
  return ahead == 1.0 ? hk_integrator_next_time(it) : it->t + ahead * it->schedule.step;
}

static int32_t step_rate(hooke_integrator *it) {
  struct own *own = it->own;
  memcpy(own->start, it->x, (size_t)it->size * sizeof(double));
  for (int stage = 0; stage < own->stages->count; stage++) {
    const int32_t status = hk_integrator_rate(it, stage_time(it, stage), it->x, it->slope);
    if (status != HOOKE_OK) {
      memcpy(it->x, own->start, (size_t)it->size * sizeof(double));
      return status;
    }
    own->stages->move(stage, it->size, it->schedule.step, it->slope, own->start, own->sum, it->x);
  }
  return HOOKE_OK;
}

/* Velocities are the rate of positions, and have to be read before they change. */
static void move_motion(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const int stage = *(const int *)ctx;
  const struct own *own = it->own;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  for (int a = 0; a < 3; a++) {
    const int64_t q = a * m->n + from, v = (3 + a) * m->n + from;
    double *f = m->f[a] + from;
    hk_acceleration(count, system->inverse_mass + from, system->has_gravity ? &system->gravity[a] : NULL, f);
    own->stages->move(stage, count, h, m->v[a] + from, own->start + q, own->sum + q, m->q[a] + from);
    own->stages->move(stage, count, h, f, own->start + v, own->sum + v, m->v[a] + from);
  }
}

/* Constrained particles at the time of a stage; if it is the time of the previous one the drives are not
 * called again. */
static int32_t hold(hooke_integrator *it, int stage) {
  if (it->system->constrained_count == 0 || stage == 0) return HOOKE_OK;
  if (ahead_of(it, stage) != ahead_of(it, stage - 1)) return hk_integrator_hold(it, stage_time(it, stage));
  hk_motion_hold(it->system, it->motion);
  return HOOKE_OK;
}

/* ---- an overdamped system: velocities are the rates, and those at the start are there ---- */

static void move_positions(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const int stage = *(const int *)ctx;
  const struct own *own = it->own;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    const int64_t q = a * m->n + from;
    own->stages->move(stage, count, it->schedule.step, m->v[a] + from, own->start + q, own->sum + q,
                      m->q[a] + from);
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
  hk_motion_save(it->motion, own->start);
  for (int stage = 0; stage < own->stages->count; stage++) {
    int32_t status = hold(it, stage);
    if (status == HOOKE_OK) status = hk_integrator_forces(it, stage_time(it, stage));
    if (status != HOOKE_OK) {
      hk_motion_restore(it->motion, own->start);
      return status;
    }
    hk_integrator_each(it, move_motion, &stage);
  }
  return HOOKE_OK;
}
