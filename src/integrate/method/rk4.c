/* The classical Runge-Kutta method (Kutta 1901), order 4: four rates a step, at t, twice at t + h/2, and at t
 * + h. Pinned and driven particles are held in every stage. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "kernel/step_loops.h"

#include <stddef.h>
#include <string.h>

/* Where the step began, and the sum of the rates: of x, or of q and v, each 3 components of n. */
struct rk4 {
  double *start, *sum;
};

static int32_t create(hooke_integrator *it) {
  struct rk4 *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  const int64_t size = (it->rate ? 1 : 2) * it->size;
  own->start = hk_new(2 * size, sizeof(double));
  if (own->start == NULL) return HOOKE_NO_MEMORY;
  own->sum = own->start + size;
  it->own_memory += 2 * size * (int64_t)sizeof(double);
  return HOOKE_OK;
}

static void destroy(hooke_integrator *it) {
  struct rk4 *own = it->own;
  hk_free(own->start);
  hk_free(own);
  it->own = NULL;
}

/* x from the rate at stage 0, 1, 2 or 3, on to the next stage or the end of the step. */
static void move(int stage, int64_t n, double h, const double *rate, const double *start, double *sum,
                 double *x) {
  if (stage == 0)
    hk_first_stage(n, h / 2.0, rate, sum, x);
  else if (stage < 3)
    hk_middle_stage(n, stage == 1 ? h / 2.0 : h, rate, start, sum, x);
  else
    hk_last_stage(n, h / 6.0, rate, start, sum, x);
}

static double stage_time(const hooke_integrator *it, int stage) {
  return stage == 0 ? it->t : stage < 3 ? it->t + it->schedule.step / 2.0 : hk_integrator_next_time(it);
}

static int32_t step_rate(hooke_integrator *it) {
  struct rk4 *own = it->own;
  memcpy(own->start, it->x, (size_t)it->size * sizeof(double));
  for (int stage = 0; stage < 4; stage++) {
    const int32_t status = hk_integrator_rate(it, stage_time(it, stage), it->x, it->slope);
    if (status != HOOKE_OK) {
      memcpy(it->x, own->start, (size_t)it->size * sizeof(double));
      return status;
    }
    move(stage, it->size, it->schedule.step, it->slope, own->start, own->sum, it->x);
  }
  return HOOKE_OK;
}

/* Velocities are the rate of positions, and have to be read before they move on. */
static void move_motion(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const int stage = *(const int *)ctx;
  const struct rk4 *own = it->own;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  for (int a = 0; a < 3; a++) {
    const int64_t q = a * m->n + from, v = (3 + a) * m->n + from;
    double *f = m->f[a] + from;
    hk_acceleration(count, system->inverse_mass + from, system->has_gravity ? &system->gravity[a] : NULL, f);
    move(stage, count, h, m->v[a] + from, own->start + q, own->sum + q, m->q[a] + from);
    move(stage, count, h, f, own->start + v, own->sum + v, m->v[a] + from);
  }
}

/* Held particles at the time of a stage; the second stage in the middle of the step finds the drives where
 * the first one left them. */
static int32_t hold(hooke_integrator *it, int stage) {
  if (it->system->held_count == 0 || stage == 0) return HOOKE_OK;
  if (stage != 2) return hk_integrator_hold(it, stage_time(it, stage));
  hk_motion_hold(it->system, it->motion);
  return HOOKE_OK;
}

static int32_t step(hooke_integrator *it) {
  if (it->rate) return step_rate(it);
  struct rk4 *own = it->own;
  hk_motion_save(it->motion, own->start);
  for (int stage = 0; stage < 4; stage++) {
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

const struct hk_method hk_rk4 = {
    .name = "rk4",
    .summary = "fixed step, order 4, four force evaluations a step",
    .built = 1,
    .order = 4,
    .first_order = 1,
    .second_order = 1,
    .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 4, .axis = 8.0, .half_disc = 2.6156},
    .create = create,
    .destroy = destroy,
    .begin = hk_fixed_begin,
    .step = step,
    .store = hk_fixed_store};
