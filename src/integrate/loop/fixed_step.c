/* Common parts of all fixed-step methods: counted forces and rates, loading and storing. */
#include "integrate/integrator.h"
#include "kernel/step_loops.h"

#include "core/status.h"
#include "model/force/force.h"

#include <stddef.h>
#include <string.h>

static int32_t keep_stop_value(hooke_integrator *it, int32_t status) {
  if (status == HOOKE_STOPPED) it->stop_value = it->motion->stop_value;
  return status;
}

int32_t hk_integrator_forces(hooke_integrator *it, double t) {
  return hk_integrator_forces_without(it, t, NULL);
}

int32_t hk_integrator_forces_without(hooke_integrator *it, double t, const struct hk_force_row *left_out) {
  it->count.force_evaluations++;
  return keep_stop_value(it, hk_motion_forces_without(it->system, it->motion, t, left_out));
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

struct moving {
  int32_t kind;
  double *const *half;
};

static void move(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  const struct moving *moving = ctx;
  hk_step_loop *loop = hk_step_loop_of(moving->kind);
  hk_verlet_loop *half = hk_verlet_loop_of(moving->kind);
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double h = it->schedule.step, *w = system->inverse_mass + from;
  for (int a = 0; a < 3; a++) {
    const double *f = m->f[a] + from, *g = system->has_gravity ? &system->gravity[a] : NULL;
    double *q = m->q[a] + from, *v = m->v[a] + from;
    if (half)
      half(count, h, m->zero ? 0.0 : system->drag, w, f, g, moving->half[a] + from, q, v);
    else
      loop(count, h, w, f, g, q, v);
  }
}

static int32_t pass_by_tiles(hooke_integrator *it, int32_t kind, double *const half[3]) {
  const hooke_system *system = it->system;
  struct hk_move how = {
      .kind = kind, .heavy = system->has_gravity, .step = it->schedule.step, .drag = system->drag};
  memcpy(how.gravity, system->gravity, sizeof how.gravity);
  if (half) memcpy(how.half, half, sizeof how.half);
  it->count.force_evaluations++;
  hk_motion_pass(system, it->motion, &how);
  return HOOKE_OK;
}

int32_t hk_integrator_pass(hooke_integrator *it, double t, int32_t kind, double *const half[3]) {
  if (it->by_tiles) return pass_by_tiles(it, kind, half);
  const int32_t status = hk_integrator_forces_without(it, t, kind == HOOKE_CORRECT ? &hk_force_drag : NULL);
  if (status == HOOKE_OK) hk_integrator_each(it, move, &(struct moving){kind, half});
  return status;
}

double hk_integrator_next_time(const hooke_integrator *it) {
  return it->t0 + (double)(it->k + 1) * it->schedule.step;
}

static void set_rates(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  (void)ctx;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    hk_acceleration(count, it->system->inverse_mass + from, NULL, m->f[a] + from);
    memcpy(m->v[a] + from, m->f[a] + from, (size_t)count * sizeof(double));
  }
}

int32_t hk_integrator_flow(hooke_integrator *it, double t) {
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
  const int32_t value = it->rate(it->size, t, x, slope, it->rate_ctx);
  if (value == 0) return HOOKE_OK;
  it->stop_value = value;
  return hk_fail(HOOKE_STOPPED, NULL, "the rate callback returned %d at t = %.6g s", (int)value, t);
}

int32_t hk_fixed_begin(hooke_integrator *it, const hooke_state *state) {
  if (it->motion)
    hk_motion_load(it->system, it->motion, state->q, state->v);
  else
    memcpy(it->x, state->q, (size_t)it->size * sizeof(double));
  return HOOKE_OK;
}

int32_t hk_fixed_store(hooke_integrator *it, double t, hooke_state *state) {
  if (it->motion)
    hk_motion_store(it->motion, state->q, state->v);
  else
    memcpy(state->q, it->x, (size_t)it->size * sizeof(double));
  *state->t = t;
  return HOOKE_OK;
}
