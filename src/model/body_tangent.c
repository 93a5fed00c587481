#include "model/body_tangent.h"

#include "core/memory.h"
#include "model/body.h"
#include "model/vector3.h"

#include <string.h>

int32_t hk_body_tangents_create(const hooke_system *system, const double *q,
                                struct hk_body_tangents *tangents) {
  const int64_t count = system->moving_bodies;
  int64_t particles = 0;
  for (int64_t k = 0; k < count; k++)
    particles += system->bodies->mover[k]->count;
  *tangents = (struct hk_body_tangents){.system = system, .count = count};
  tangents->body = hk_new(count, sizeof *tangents->body);
  tangents->arms = hk_new(3 * particles, sizeof(double));
  if (tangents->body == NULL || tangents->arms == NULL) {
    hk_body_tangents_release(tangents);
    return HOOKE_NO_MEMORY;
  }
  double *arm = tangents->arms;
  for (int64_t k = 0; k < count; k++) {
    tangents->body[k] = (struct hk_body_tangent){.body = system->bodies->mover[k], .arm = arm};
    arm += 3 * tangents->body[k].body->count;
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
