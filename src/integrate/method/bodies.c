/* Steps of systems with rigid bodies. Free particles and bodies' own coordinates (model/body.h) are one array y
 * of unknowns, which a step takes from the rows and writes back, so it remains a map of (t, q, v).
 *
 * Explicit Runge-Kutta methods step y' = phi(t, y), quaternions being made unit ones at the end. Symplectic
 * Euler and verlet kick velocities and angular momenta, and in between let particles and bodies move freely;
 * verlet takes the forces of its second kick at velocities and momenta predicted by twice the first kick, of
 * which forces that depend on positions alone see nothing. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/method/stages.h"
#include "integrate/solve/unknowns.h"
#include "kernel/step_loops.h"
#include "model/body.h"
#include "model/force/force.h"

#include <string.h>

struct own {
  struct hk_unknowns unknowns;
  int32_t keeps, kept; /* of verlet: forces at the end are those at the next start; the motion has them */
  double *numbers;     /* all arrays below */
  double *y, *start, *slope, *sum;
  double *rows; /* q and v at the start of the step */
};

static int32_t create(hooke_integrator *it) {
  struct own *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  const int32_t status = hk_unknowns_create(it, 0, &own->unknowns);
  if (status != HOOKE_OK) return status;
  const int64_t size = own->unknowns.size, numbers = 4 * size + 2 * it->size;
  own->numbers = hk_new(numbers, sizeof(double));
  if (own->numbers == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += numbers * (int64_t)sizeof(double);
  own->y = own->numbers;
  own->start = own->y + size;
  own->slope = own->start + size;
  own->sum = own->slope + size;
  own->rows = own->sum + size;
  own->keeps = !hk_system_is_damped(it->system, 0) && it->system->force == NULL;
  return HOOKE_OK;
}

static void destroy(hooke_integrator *it) {
  struct own *own = it->own;
  hk_unknowns_release(&own->unknowns);
  hk_free(own->numbers);
  hk_free(own);
  it->own = NULL;
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  struct own *own = it->own;
  own->kept = 0;
  return hk_fixed_begin(it, state);
}

static void forget(hooke_integrator *it) {
  struct own *own = it->own;
  it->count.force_evaluations += own->kept;
  own->kept = 0;
}

static double *own_coordinates(const struct own *own, double *y, int64_t body) {
  return y + 6 * own->unknowns.free_count + HOOKE_BODY_NUMBERS * body;
}

/* Writes y, which may have quaternions of other lengths, into the working copy. */
static void give(hooke_integrator *it, double *y) {
  const struct own *own = it->own;
  const struct hk_unknowns *u = &own->unknowns;
  for (int64_t k = 0; k < u->body_count; k++)
    hk_body_normalise(own_coordinates(own, y, k));
  hk_unknowns_spread(u, y, it->motion->q);
  hk_unknowns_spread(u, y + 3 * u->free_count, it->motion->v);
  hk_bodies_write(it->system, it->motion, y + 6 * u->free_count);
}

static void begin_step(hooke_integrator *it) {
  const struct own *own = it->own;
  hk_motion_save(it->motion, own->rows);
  hk_unknowns_take(it, &own->unknowns, own->y);
}

/* A step that a callback stops leaves the motion as it was. */
static int32_t undo_step(hooke_integrator *it, int32_t status) {
  const struct own *own = it->own;
  hk_motion_restore(it->motion, own->rows);
  return status;
}

/* ---- explicit Runge-Kutta methods ---- */

static int32_t step_stages(hooke_integrator *it) {
  static const struct hk_stages *const of_order[] = {NULL, &hk_forward_euler_stages, &hk_heun_stages, NULL,
                                                     &hk_rk4_stages};
  const struct hk_stages *stages = of_order[it->method->order];
  struct own *own = it->own;
  begin_step(it);
  for (int stage = 0; stage < stages->count; stage++) {
    const double t = hk_stage_time(it, stages, stage);
    if (hk_unknowns_slope(it, &own->unknowns, t, own->y, own->slope) == HOOKE_SLOPE_STOPPED)
      return undo_step(it, HOOKE_STOPPED);
    hk_stage_move(stages, stage, it->schedule.step, own->unknowns.size, own->slope, own->start, own->sum,
                  own->y);
  }
  const int32_t status =
      hk_integrator_drive(it, hk_integrator_next_time(it)); /* the last stage may be earlier */
  if (status != HOOKE_OK) return undo_step(it, status);
  give(it, own->y);
  return HOOKE_OK;
}

/* ---- kicks and free motion ---- */

/* Accelerations and torques at the working copy, whose own coordinates are those of y: into the velocities of
 * `slope`, and `push` of the unknowns. */
static int32_t find_push(hooke_integrator *it, double t, const double *y) {
  struct own *own = it->own;
  const struct hk_unknowns *u = &own->unknowns;
  const int32_t status = own->kept ? HOOKE_OK : hk_integrator_forces(it, t);
  own->kept = 0;
  if (status != HOOKE_OK) return status;
  hk_bodies_push(it->system, it->motion, y + 6 * u->free_count, u->push);
  hk_unknowns_accelerations(it, u, own->slope + 3 * u->free_count);
  return HOOKE_OK;
}

static void kick(const hooke_integrator *it, double h, double *y) {
  const struct own *own = it->own;
  const struct hk_unknowns *u = &own->unknowns;
  hk_advance(3 * u->free_count, h, own->slope + 3 * u->free_count, y + 3 * u->free_count);
  for (int64_t k = 0; k < u->body_count; k++)
    hk_body_kick(it->system->bodies->mover[k], h, u->push + 6 * k, u->push + 6 * k + 3,
                 own_coordinates(own, y, k));
}

static void drift(const hooke_integrator *it, double h, double *y) {
  const struct own *own = it->own;
  const struct hk_unknowns *u = &own->unknowns;
  hk_advance(3 * u->free_count, h, y + 3 * u->free_count, y);
  for (int64_t k = 0; k < u->body_count; k++)
    hk_body_drift(it->system->bodies->mover[k], h, own_coordinates(own, y, k));
}

static int32_t step_symplectic_euler(hooke_integrator *it) {
  const struct own *own = it->own;
  begin_step(it);
  const int32_t status = find_push(it, it->t, own->y);
  if (status != HOOKE_OK) return undo_step(it, status);
  kick(it, it->schedule.step, own->y);
  drift(it, it->schedule.step, own->y);
  give(it, own->y);
  return HOOKE_OK;
}

/* The second kick begins at the half-way velocities and momenta, in `start`. */
static int32_t step_verlet(hooke_integrator *it) {
  struct own *own = it->own;
  const double h = it->schedule.step;
  begin_step(it);
  if (it->k > 0 && own->keeps && !own->kept) it->count.force_evaluations--; /* as counted by the run before */
  int32_t status = find_push(it, it->t, own->y);
  if (status != HOOKE_OK) return undo_step(it, status);
  kick(it, 0.5 * h, own->y);
  drift(it, h, own->y);
  memcpy(own->start, own->y, (size_t)own->unknowns.size * sizeof(double));
  kick(it, 0.5 * h, own->y);
  give(it, own->y);
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
  status = find_push(it, hk_integrator_next_time(it), own->y);
  if (status != HOOKE_OK) return undo_step(it, status);
  kick(it, 0.5 * h, own->start);
  give(it, own->start);
  own->kept = own->keeps;
  return HOOKE_OK;
}

/* Damping is taken at the predicted velocity. */
static int32_t choose_verlet(hooke_integrator *it) {
  if (strcmp(hooke_options_text(it->options, "verlet_damping"), "implicit") == 0)
    return hk_fail(HOOKE_UNSUITED, "verlet_damping",
                   "implicit does not know rigid bodies yet; allowed: auto, explicit");
  it->explicit_damping = hk_system_is_damped(it->system, ~HOOKE_UNIFORM);
  return HOOKE_OK;
}

/* ---- rows ---- */

#define HOOKE_BODY_METHOD                                                                                    \
  .built = 1, .second_order = 1, .create = create, .destroy = destroy, .begin = begin, .store = hk_fixed_store

const struct hk_method hk_forward_euler_bodies = {
    .name = "forward-euler", .order = 1, .step = step_stages, HOOKE_BODY_METHOD};
const struct hk_method hk_symplectic_euler_bodies = {
    .name = "symplectic-euler", .order = 1, .step = step_symplectic_euler, HOOKE_BODY_METHOD};
const struct hk_method hk_verlet_bodies = {.name = "verlet",
                                           .order = 2,
                                           .stability = {.kind = HOOKE_STABLE_BY_PREDICTION},
                                           .choose = choose_verlet,
                                           .forget = forget,
                                           .step = step_verlet,
                                           HOOKE_BODY_METHOD};
const struct hk_method hk_heun_bodies = {.name = "heun", .order = 2, .step = step_stages, HOOKE_BODY_METHOD};
const struct hk_method hk_rk4_bodies = {.name = "rk4", .order = 4, .step = step_stages, HOOKE_BODY_METHOD};
