#include "integrate/solve/body_stage.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/stage.h"
#include "model/coordinates/body.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* Of J(w) w = p: the error that may be left, in which rounding ends, and the most iterations. */
static const double ROTATION_ROUNDING = 1e-12;
enum { MOST_ROTATIONS = 50 };

/* ---- creating ---- */

static int32_t allocate(hooke_integrator *it, struct hk_body_stage *body) {
  int64_t count = body->count, arms = 0;
  const int64_t numbers = (HOOKE_BODY_NUMBERS + 6 + 36) * count + 3 * it->size;
  double *block = hk_new(numbers, sizeof(double));
  body->own = block;
  body->rotation = hk_new(count, sizeof *body->rotation);
  if (block == NULL || body->rotation == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++)
    arms += 3 * ((const struct hk_body *)it->system->mover[k].thing)->count;
  it->own_memory += (numbers + arms) * (int64_t)sizeof(double) + count * (int64_t)sizeof *body->rotation;
  block += HOOKE_BODY_NUMBERS * count;
  body->push = hk_part(&block, 6 * count);
  body->factor = hk_part(&block, 36 * count);
  body->dq = hk_part(&block, it->size);
  body->dv = hk_part(&block, it->size);
  body->df = block;
  return HOOKE_OK;
}

int32_t hk_body_stage_create(hooke_integrator *it, struct hk_body_stage *body) {
  const hooke_system *system = it->system;
  if (system->mover_count == 0) return HOOKE_OK;
  if (strcmp(hooke_options_text(it->options, "linear_solver"), "direct") == 0)
    return hk_fail(HOOKE_UNSUITED, "linear_solver",
                   "direct does not know rigid bodies yet; allowed with %s: auto, blocks", it->method->name);
  body->count = system->mover_count;
  const int32_t status = hk_body_tangents_create(system, system->position, &body->tangents);
  return status == HOOKE_OK ? allocate(it, body) : status;
}

void hk_body_stage_release(struct hk_body_stage *body) {
  if (body->count > 0) hk_body_tangents_release(&body->tangents);
  hk_free(body->rotation);
  hk_free(body->own);
}

/* ---- own coordinates ---- */

static const hooke_system *system_of(const struct hk_stage *stage) {
  return stage->reduced.integrator->system;
}

static const struct hk_body *body_of(const struct hk_stage *stage, int64_t k) {
  return system_of(stage)->mover[k].thing;
}

static double *own_of(const struct hk_stage *stage, int64_t k) {
  return stage->body.own + HOOKE_BODY_NUMBERS * k;
}

/* What the equations start from. */
static const double *origin_of(const struct hk_stage *stage, int64_t k) {
  return stage->at.speed + stage->reduced.integrator->size + HOOKE_BODY_NUMBERS * k;
}

static int64_t at_velocity(const struct hk_stage *stage, int64_t k) {
  return stage->reduced.integrator->size + HOOKE_BODY_VELOCITIES * k;
}

/* ---- from momentum to rotation ---- */

/* With d (J w) = d x J w - J (d x w) + J dw for the turn d, where the axes are those of w. */
static void find_slope(const struct hk_stage *stage, int64_t k, const double axes[3][3],
                       const double spin[3]) {
  struct hk_body_rotation *r = &stage->body.rotation[k];
  double moment[3], column[3][3];
  hk_body_moments(body_of(stage, k), moment);
  for (int j = 0; j < 3; j++) {
    double change[3] = {j == 0, j == 1, j == 2}, turn[3], other[3];
    hk_body_turn_by(r->w, stage->at.a, change, turn);
    hk_cross3(turn, r->w, other);
    hk_add3(-1.0, other, change);
    hk_body_weigh(axes, moment, change, column[j]);
    hk_cross3(turn, spin, other);
    hk_add3(1.0, other, column[j]);
  }
  hk_cross3(column[1], column[2], r->inverse[0]);
  hk_cross3(column[2], column[0], r->inverse[1]);
  hk_cross3(column[0], column[1], r->inverse[2]);
  const double volume = hk_dot3(column[0], r->inverse[0]);
  for (int j = 0; j < 3; j++)
    hk_scale3(1.0 / volume, r->inverse[j], r->inverse[j]);
}

/* Solves J(w) w = p by Newton's method, down to rounding; w is not a number where it does not get there. */
static void find_rotation(struct hk_stage *stage, int64_t k, const double z[3]) {
  struct hk_body_rotation *r = &stage->body.rotation[k];
  double *own = own_of(stage, k), moment[3], axes[3][3], p[3], spin[3], left[3], before = INFINITY;
  hk_body_moments(body_of(stage, k), moment);
  hk_body_momentum(stage, k, z, p);
  memcpy(r->w, z, sizeof r->w);
  for (int i = 0; i < MOST_ROTATIONS; i++) {
    hk_body_turn(r->w, stage->at.a, origin_of(stage, k) + HOOKE_BODY_TURN, own + HOOKE_BODY_TURN);
    hk_body_axes(own + HOOKE_BODY_TURN, axes);
    hk_body_weigh(axes, moment, r->w, spin);
    for (int c = 0; c < 3; c++)
      left[c] = p[c] - spin[c];
    find_slope(stage, k, axes, spin);
    const double size = hk_length3(left), rounding = ROTATION_ROUNDING * hk_length3(p);
    if (size == 0.0 || (size <= rounding && size >= 0.5 * before)) return;
    before = size;
    for (int c = 0; c < 3; c++)
      r->w[c] += hk_dot3(r->inverse[c], left);
  }
  for (int c = 0; c < 3; c++)
    r->w[c] = NAN;
  hk_body_turn(r->w, stage->at.a, origin_of(stage, k) + HOOKE_BODY_TURN, own + HOOKE_BODY_TURN);
}

/* A component of L about an axis that the body does not turn about stays as it is. */
static void place_body(struct hk_stage *stage, int64_t k, const double *v) {
  const struct hk_body *body = body_of(stage, k);
  const double *from = origin_of(stage, k), *u = v + at_velocity(stage, k);
  double *own = own_of(stage, k), axes[3][3], other[3], rest[3];
  for (int a = 0; a < 3; a++) {
    own[HOOKE_BODY_POINT + a] = from[HOOKE_BODY_POINT + a] + stage->at.a * u[a];
    own[HOOKE_BODY_VELOCITY + a] = u[a];
    other[a] = body->inertia[a] > 0.0 ? 0.0 : 1.0;
  }
  find_rotation(stage, k, u + 3);
  hk_body_momentum(stage, k, u + 3, own + HOOKE_BODY_SPIN);
  if (body->inertia[0] > 0.0) return;
  hk_body_axes(own + HOOKE_BODY_TURN, axes);
  hk_body_weigh(axes, body->inertia, stage->body.rotation[k].w, own + HOOKE_BODY_SPIN);
  hk_body_weigh(axes, other, from + HOOKE_BODY_SPIN, rest);
  hk_add3(1.0, rest, own + HOOKE_BODY_SPIN);
}

void hk_body_stage_place(struct hk_stage *stage, const double *v) {
  for (int64_t k = 0; k < stage->body.count; k++)
    place_body(stage, k, v);
  hk_movers_write(system_of(stage), stage->reduced.integrator->motion, stage->body.own, 0);
}

void hk_body_stage_end(struct hk_stage *stage) {
  hk_movers_normalise(system_of(stage), stage->body.own);
  hk_movers_write(system_of(stage), stage->reduced.integrator->motion, stage->body.own, 0);
}

void hk_body_stage_begin(struct hk_stage *stage) {
  const int64_t size = stage->reduced.integrator->size;
  if (stage->body.count == 0) return; /* they are in `begin` */
  memcpy(stage->old, stage->begin + size, (size_t)size * sizeof(double));
  hk_body_stage_clear(stage, stage->old);
  for (int64_t k = 0; k < stage->body.count; k++) {
    const double *own = own_of(stage, k);
    double *u = stage->old + at_velocity(stage, k);
    struct hk_body_rotation *r = &stage->body.rotation[k];
    memcpy(u, own + HOOKE_BODY_VELOCITY, 3 * sizeof(double));
    hk_body_axes(own + HOOKE_BODY_TURN, r->begin);
    hk_body_weigh(r->begin, body_of(stage, k)->inverse_inertia, own + HOOKE_BODY_SPIN, u + 3);
  }
}

void hk_body_stage_explicit(struct hk_stage *stage, double a, double *out) {
  struct hk_body_stage *bodies = &stage->body;
  hk_movers_push(system_of(stage), stage->reduced.integrator->motion, bodies->own, bodies->push);
  hk_movers_slope(system_of(stage), bodies->own, bodies->push, out);
  for (int64_t j = 0; j < HOOKE_BODY_NUMBERS * bodies->count; j++)
    out[j] = bodies->own[j] + a * out[j];
}

void hk_body_stage_go_on(struct hk_stage *stage) {
  const double *start = stage->start + 2 * stage->reduced.integrator->size;
  for (int64_t j = 0; j < HOOKE_BODY_NUMBERS * stage->body.count; j++)
    stage->body.own[j] = 2.0 * stage->body.own[j] - start[j];
}

/* ---- equations ---- */

/* By the force and the torque in `push`. */
static void find_right(struct hk_stage *stage, int64_t k, const double *v) {
  const struct hk_body *body = body_of(stage, k);
  const double *from = origin_of(stage, k), *push = stage->body.push + 6 * k, *u = v + at_velocity(stage, k);
  double *right = stage->right + at_velocity(stage, k), axes[3][3], spin[3], p[3];
  for (int c = 0; c < 3; c++) {
    right[c] = body->inverse_mass > 0.0
                   ? stage->at.a * push[c] - body->mass * (u[c] - from[HOOKE_BODY_VELOCITY + c])
                   : 0.0;
    spin[c] = from[HOOKE_BODY_SPIN + c] + stage->at.a * push[3 + c];
  }
  hk_body_axes(own_of(stage, k) + HOOKE_BODY_TURN, axes);
  hk_body_project(body, axes, spin, right + 3);
  hk_body_momentum(stage, k, u + 3, p);
  hk_add3(-1.0, p, right + 3);
}

void hk_body_stage_residual(struct hk_stage *stage, const double *v) {
  struct hk_body_stage *bodies = &stage->body;
  hk_body_stage_clear(stage, stage->right);
  hk_movers_push(system_of(stage), stage->reduced.integrator->motion, bodies->own, bodies->push);
  for (int64_t k = 0; k < bodies->count; k++) {
    hk_scale3(body_of(stage, k)->mass, bodies->push + 6 * k, bodies->push + 6 * k);
    find_right(stage, k, v);
  }
}

static void find_straight(struct hk_stage *stage, int64_t k) {
  const struct hk_body *body = body_of(stage, k);
  const double *push = stage->body.push + 6 * k, *u = stage->old + at_velocity(stage, k);
  double *straight = stage->straight + at_velocity(stage, k), change[3];
  hk_body_weigh(stage->body.rotation[k].begin, body->inverse_inertia, push + 3, change);
  for (int c = 0; c < 3; c++) {
    straight[c] = u[c] + stage->at.length * (body->inverse_mass * push[c]);
    straight[3 + c] = u[3 + c] + stage->at.length * change[c];
  }
}

void hk_body_stage_linearise(struct hk_stage *stage) {
  hk_body_stage_clear(stage, stage->right);
  hk_body_stage_clear(stage, stage->straight);
  for (int64_t k = 0; k < stage->body.count; k++) {
    double *push = stage->body.push + 6 * k, change[6];
    find_straight(stage, k);
    hk_body_stage_gather(stage, k, stage->moved, change);
    for (int j = 0; j < 6; j++)
      push[j] += change[j];
    find_right(stage, k, stage->old);
  }
}

double hk_body_stage_distance(const struct hk_stage *stage, const double *from) {
  double sum = 0.0;
  for (int64_t k = 0; k < stage->body.count; k++) {
    const double *v = stage->v + at_velocity(stage, k), *u = from + at_velocity(stage, k);
    const double move[3] = {v[0] - u[0], v[1] - u[1], v[2] - u[2]},
                 turn[3] = {v[3] - u[3], v[4] - u[4], v[5] - u[5]};
    double spin[3];
    hk_body_momentum(stage, k, turn, spin);
    sum += body_of(stage, k)->mass * hk_dot3(move, move) + hk_dot3(turn, spin);
  }
  return sum;
}
