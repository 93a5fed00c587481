#include "model/coordinates/body_tangent.h"

#include "core/memory.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

int32_t hk_body_tangents_create(const hooke_system *system, const double *q,
                                struct hk_body_tangents *tangents) {
  const int64_t count = system->mover_count;
  int64_t particles = 0, some;
  for (int64_t k = 0; k < count; k++) {
    system->mover[k].row->particles(system->mover[k].thing, &some);
    particles += some;
  }
  *tangents = (struct hk_body_tangents){.system = system, .count = count};
  tangents->body = hk_new(count, sizeof *tangents->body);
  tangents->arms = hk_new(3 * particles, sizeof(double));
  if (tangents->body == NULL || tangents->arms == NULL) {
    hk_body_tangents_release(tangents);
    return HOOKE_NO_MEMORY;
  }
  double *arm = tangents->arms;
  for (int64_t k = 0; k < count; k++) {
    const struct hk_mover *mover = &system->mover[k];
    mover->row->particles(mover->thing, &some);
    tangents->body[k] =
        (struct hk_body_tangent){.mover = mover, .body = mover->row->turns ? mover->thing : NULL, .arm = arm};
    arm += 3 * some;
  }
  hk_body_tangents_set(tangents, q);
  return HOOKE_OK;
}

void hk_body_tangents_release(struct hk_body_tangents *tangents) {
  hk_free(tangents->body);
  hk_free(tangents->arms);
  memset(tangents, 0, sizeof *tangents);
}

void hk_body_tangents_set(struct hk_body_tangents *tangents, const double *q) {
  for (int64_t k = 0; k < tangents->count; k++) {
    struct hk_body_tangent *t = &tangents->body[k];
    double own[HOOKE_BODY_NUMBERS];
    if (t->body == NULL) continue;
    hk_body_read_rows(t->body, q, q, own); /* velocities do not matter */
    hk_body_axes(own + HOOKE_BODY_TURN, t->axes);
    for (int64_t i = 0; i < t->body->count; i++) {
      const double *place = t->body->place + 3 * i;
      for (int a = 0; a < 3; a++)
        t->arm[3 * i + a] = hk_dot3(t->axes[a], place);
    }
    memset(t->geometric, 0, sizeof t->geometric);
  }
}

/* (turn x arm) x f = (arm f^T - arm.f I) turn */
void hk_body_tangents_stiffen(struct hk_body_tangents *tangents, const double *const force[3],
                              int64_t stride) {
  for (int64_t k = 0; k < tangents->count; k++) {
    struct hk_body_tangent *t = &tangents->body[k];
    if (t->body == NULL) continue;
    memset(t->geometric, 0, sizeof t->geometric);
    for (int64_t i = 0; i < t->body->count; i++) {
      const int64_t p = t->body->particle[i], at = stride * p;
      if (tangents->system->constrained[p]) continue;
      const double *arm = t->arm + 3 * i, f[3] = {force[0][at], force[1][at], force[2][at]};
      const double along = hk_dot3(arm, f);
      for (int a = 0; a < 3; a++) {
        t->geometric[a][a] += along;
        for (int b = 0; b < 3; b++)
          t->geometric[a][b] -= arm[a] * f[b];
      }
    }
  }
}

void hk_body_spread(const hooke_system *system, const struct hk_body_tangent *t, const double move[3],
                    const double turn[3], double *const to[3], int64_t stride) {
  for (int64_t i = 0; i < t->body->count; i++) {
    const int64_t p = t->body->particle[i];
    double swing[3];
    if (system->constrained[p]) continue;
    hk_cross3(turn, t->arm + 3 * i, swing);
    for (int a = 0; a < 3; a++)
      to[a][stride * p] = move[a] + swing[a];
  }
}

void hk_body_gather(const hooke_system *system, const struct hk_body_tangent *t, const double *weight,
                    const double *const from[3], int64_t stride, double sum[3], double moment[3]) {
  memset(sum, 0, 3 * sizeof(double));
  memset(moment, 0, 3 * sizeof(double));
  for (int64_t i = 0; i < t->body->count; i++) {
    const int64_t p = t->body->particle[i], at = stride * p;
    if (system->constrained[p]) continue;
    const double value[3] = {from[0][at], from[1][at], from[2][at]}, w = weight ? weight[p] : 1.0;
    double turning[3];
    hk_cross3(t->arm + 3 * i, value, turning);
    hk_add3(w, value, sum);
    hk_add3(w, turning, moment);
  }
}

void hk_body_turn_forces(const struct hk_body_tangent *t, double scale, const double turn[3],
                         double torque[3]) {
  for (int a = 0; a < 3; a++)
    torque[a] -= scale * hk_dot3(t->geometric[a], turn);
}

/* ---- unknowns of its row ---- */

void hk_body_unit_axes(const struct hk_body_tangent *t, double axis[3][3]) {
  for (int k = 0; k < 3; k++) {
    for (int a = 0; a < 3; a++)
      axis[k][a] = sqrt(t->body->inverse_inertia[k]) * t->axes[a][k];
  }
}

void hk_body_spread_unit(const hooke_system *system, const struct hk_body_tangent *t, const double *y,
                         double *const x[3], int64_t stride) {
  double move[3], turn[3] = {0.0}, axis[3][3];
  hk_scale3(sqrt(t->body->inverse_mass), y, move);
  hk_body_unit_axes(t, axis);
  for (int k = 0; k < 3; k++)
    hk_add3(y[3 + k], axis[k], turn);
  hk_body_spread(system, t, move, turn, x, stride);
}

void hk_body_gather_unit(const hooke_system *system, const struct hk_body_tangent *t, const double *weight,
                         const double *const x[3], int64_t stride, double *y) {
  double moment[3], axis[3][3];
  hk_body_gather(system, t, weight, x, stride, y, moment);
  hk_scale3(sqrt(t->body->inverse_mass), y, y);
  hk_body_unit_axes(t, axis);
  for (int k = 0; k < 3; k++)
    y[3 + k] = hk_dot3(axis[k], moment);
}

int32_t hk_body_has(const void *thing, int k) {
  const struct hk_body *body = thing;
  return (k < 3 ? body->inverse_mass : body->inverse_inertia[k - 3]) > 0.0;
}

double hk_body_reach(const struct hk_body_tangent *t, int64_t k) {
  const double *inverse = t->body->inverse_inertia, turning = fmax(inverse[0], fmax(inverse[1], inverse[2]));
  return t->body->inverse_mass + hk_dot3(t->arm + 3 * k, t->arm + 3 * k) * turning;
}
