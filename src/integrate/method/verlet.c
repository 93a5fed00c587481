/* Velocity Verlet (Swope and others 1982), order 2, as kick, drift, kick:
 *   v_half = v + h/2 a(t, q, v),  q' = q + h v_half,  v' = v_half + h/2 a(t + h, q', v')
 * The second kick takes the damping at the new velocity, which keeps the order and the limit h w = 2. With
 * spring damping it is implicit, with D = df/dv at (q', v_half):
 *   (M - h/2 D) (v' - v_half) = h/2 (f(t + h, q', v_half) + M g)
 * which is M v' = M v_half + h/2 (f(q', 0) + D v' + M g) written for the change. D is that of the springs,
 * altitude springs and drag: a callback sees v_half. A spring that only pulls counts only if it pulls at (q',
 * v_half). Drag alone is a division. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/reduced.h"
#include "kernel/step_loops.h"
#include "model/force/force.h"

#include <stddef.h>

static const double RESIDUAL = 1e-13;

struct verlet {
  int32_t damped, callback;
  int32_t kept;              /* motion->f is the force of the springs at q, without drag */
  struct hk_reduced reduced; /* damped */
  double *start;             /* damped or callback: q and v at the start of the step */
  double *right, *change;    /* damped: 3n each */
};

static int32_t create(hooke_integrator *it) {
  struct verlet *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->damped = hk_elements_are_damped(it->system);
  own->callback = it->system->force != NULL;
  if (!own->damped && !own->callback) return HOOKE_OK;
  const int64_t numbers = (own->damped ? 4 : 2) * it->size;
  own->start = hk_new(numbers, sizeof(double));
  if (own->start == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += numbers * (int64_t)sizeof(double);
  if (!own->damped) return HOOKE_OK;
  own->right = own->start + 2 * it->size;
  own->change = own->right + it->size;
  return hk_reduced_create(it, HOOKE_REDUCED_SYMMETRIC, &own->reduced);
}

static void destroy(hooke_integrator *it) {
  struct verlet *own = it->own;
  hk_reduced_release(&own->reduced);
  hk_free(own->start);
  hk_free(own);
  it->own = NULL;
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  struct verlet *own = it->own;
  own->kept = 0;
  return hk_fixed_begin(it, state);
}

static void forget(hooke_integrator *it) {
  struct verlet *own = it->own;
  it->count.force_evaluations += own->kept; /* counts to be added by first_forces() again */
  own->kept = 0;
}

static const double *gravity(const hooke_system *system, int axis) {
  return system->has_gravity ? &system->gravity[axis] : NULL;
}

/* The force at the start of a step. Without spring damping and callback it is that of the springs, kept from
 * the previous step, plus drag: the same sum to the bit. */
static int32_t first_forces(hooke_integrator *it) {
  struct verlet *own = it->own;
  if (own->damped || own->callback) return hk_integrator_forces(it, it->t);
  const int32_t status = own->kept ? HOOKE_OK : hk_integrator_forces_without(it, it->t, &hk_force_drag);
  if (!own->kept && it->k > 0) it->count.force_evaluations--; /* as counted by the run that came here */
  own->kept = 0;
  if (status != HOOKE_OK || it->system->drag == 0.0) return status;
  return hk_force_drag.add(it->system, it->motion, it->t);
}

/* The second kick of damped springs. */
static int32_t solve(hooke_integrator *it) {
  struct verlet *own = it->own;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double half = it->schedule.step / 2.0;
  for (int a = 0; a < 3; a++) {
    double *right = own->right + a * m->n;
    for (int64_t p = 0; p < m->n; p++)
      right[p] =
          half * (system->has_gravity ? m->f[a][p] + system->mass[p] * system->gravity[a] : m->f[a][p]);
  }
  hk_reduced_set(&own->reduced, hk_integrator_next_time(it), 0.0, half);
  struct hk_solution solution;
  int32_t status = hk_reduced_solve(&own->reduced, own->right, RESIDUAL, own->change, &solution);
  if (status == HOOKE_OK && !solution.converged) status = hk_reduced_fail(&own->reduced, &solution);
  for (int a = 0; a < 3 && status == HOOKE_OK; a++) {
    for (int64_t p = 0; p < m->n; p++)
      m->v[a][p] += own->change[a * m->n + p];
  }
  return status;
}

static void kick(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  (void)ctx;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double half = it->schedule.step / 2.0, *w = system->inverse_mass + from;
  for (int a = 0; a < 3; a++) {
    if (system->drag > 0.0)
      hk_kick_with_drag(count, half, system->drag, w, m->f[a] + from, gravity(system, a), m->v[a] + from);
    else
      hk_kick(count, half, w, m->f[a] + from, gravity(system, a), m->v[a] + from);
  }
}

static int32_t second_kick(hooke_integrator *it) {
  struct verlet *own = it->own;
  const double t = hk_integrator_next_time(it);
  if (own->damped) {
    const int32_t status = hk_integrator_forces(it, t);
    return status == HOOKE_OK ? solve(it) : status;
  }
  const int32_t status = hk_integrator_forces_without(it, t, &hk_force_drag);
  if (status == HOOKE_OK) hk_integrator_each(it, kick, NULL);
  own->kept = status == HOOKE_OK && !own->callback;
  return status;
}

static void kick_and_drift(hooke_integrator *it, int64_t from, int64_t count, void *ctx) {
  (void)ctx;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  for (int a = 0; a < 3; a++) {
    hk_kick_and_drift(count, h / 2.0, h, system->inverse_mass + from, m->f[a] + from, gravity(system, a),
                      m->q[a] + from, m->v[a] + from);
  }
}

static int32_t step(hooke_integrator *it) {
  const struct verlet *own = it->own;
  struct hk_motion *m = it->motion;
  if (own->start) hk_motion_save(m, own->start);
  int32_t status = first_forces(it);
  if (status != HOOKE_OK) return status;
  hk_integrator_each(it, kick_and_drift, NULL);
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, m);
  status = second_kick(it);
  if (status != HOOKE_OK && own->start) hk_motion_restore(m, own->start);
  return status;
}

const struct hk_method hk_verlet = {
    .name = "verlet",
    .summary = "fixed step, order 2; keeps undamped motion bounded, damping implicit",
    .built = 1,
    .order = 2,
    .second_order = 1,
    .stability = {.kind = HOOKE_STABLE_BY_K, .damps_implicitly = 1},
    .create = create,
    .destroy = destroy,
    .forget = forget,
    .begin = begin,
    .step = step,
    .store = hk_fixed_store};
