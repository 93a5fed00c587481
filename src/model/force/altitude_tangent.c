/* Altitude springs as parts of a matrix. */
#include "model/system.h"

#include <math.h>
#include <string.h>

static void gather(const int32_t particle[4], const double *const from[3], double to[4][3]) {
  for (int j = 0; j < 4; j++) {
    for (int a = 0; a < 3; a++)
      to[j][a] = from[a][particle[j]];
  }
}

static double dot(const double a[3], const double b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

void hk_altitude_tangents(const struct hk_altitudes *altitudes, const double *const q[3],
                          const double *const v[3], double alpha, double beta,
                          struct hk_altitude_tangent *tangent) {
  for (int64_t k = 0; k < altitudes->count; k++) {
    const struct hk_tetrahedron *t = &altitudes->tetrahedron[k];
    struct hk_altitude_tangent *out = &tangent[k];
    struct hk_altitude altitude;
    double x[4][3], w[3];
    int32_t slack;
    memset(out, 0, sizeof *out);
    memcpy(out->particle, t->particle, sizeof out->particle);
    gather(t->particle, q, x);
    if (!hk_altitude_find(t, (const double(*)[3])x, &altitude)) continue;
    gather(t->particle, v, x);
    hk_altitude_weigh(&altitude, (const double(*)[3])x, w);
    hk_altitude_tension(t, &altitude, dot(altitude.u, w), &slack);
    if (slack) continue;
    out->size = (alpha * t->stiffness + beta * t->damping) / t->rest[altitude.choice];
    memcpy(out->u, altitude.u, sizeof out->u);
    memcpy(out->weight, altitude.weight, sizeof out->weight);
  }
}

double hk_altitude_tangent_along(const struct hk_altitude_tangent *t, const double *const x[3]) {
  double along = 0.0;
  for (int j = 0; j < 4; j++) {
    const int32_t p = t->particle[j];
    along += t->weight[j] * ((t->u[0] * x[0][p] + t->u[1] * x[1][p]) + t->u[2] * x[2][p]);
  }
  return along;
}

void hk_altitude_tangent_add(int64_t count, const struct hk_altitude_tangent *tangent,
                             const double *const x[3], double *const out[3]) {
  for (const struct hk_altitude_tangent *t = tangent; t < tangent + count; t++) {
    const double along = hk_altitude_tangent_along(t, x);
    for (int j = 0; j < 4; j++) {
      const double s = t->size * along * t->weight[j];
      for (int a = 0; a < 3; a++)
        out[a][t->particle[j]] += s * t->u[a];
    }
  }
}

void hk_altitude_tangent_diagonal(int64_t count, const struct hk_altitude_tangent *tangent,
                                  double *const block[6]) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (const struct hk_altitude_tangent *t = tangent; t < tangent + count; t++) {
    for (int j = 0; j < 4; j++) {
      const double s = t->size * (t->weight[j] * t->weight[j]);
      for (int c = 0; c < 6; c++)
        block[c][t->particle[j]] += s * t->u[row[c]] * t->u[column[c]];
    }
  }
}

int32_t hk_altitude_see(const struct hk_tetrahedron *t, const double *q, struct hk_altitude_view *view) {
  struct hk_tetrahedron taut = *t;
  struct hk_tautness s;
  taut.pull_only = 0;
  memset(view, 0, sizeof *view);
  memcpy(view->tangent.particle, t->particle, sizeof t->particle);
  if (!hk_tautness_find(&taut, q, NULL, &s)) return 0;
  memcpy(view->tangent.u, s.altitude.u, sizeof s.altitude.u);
  memcpy(view->tangent.weight, s.altitude.weight, sizeof s.altitude.weight);
  view->choice = s.altitude.choice;
  view->kappa = t->stiffness / t->rest[view->choice];
  view->gamma = t->damping / t->rest[view->choice];
  view->length = s.altitude.length;
  view->tension = s.tension;
  return 1;
}

int32_t hk_tetrahedron_moves(const hooke_system *system, const struct hk_tetrahedron *t) {
  int32_t moves = 0;
  for (int j = 0; j < 4; j++)
    moves |= !system->held[t->particle[j]];
  return moves;
}

static double shortest(const struct hk_tetrahedron *t) {
  double least = t->rest[0];
  for (int k = 1; k < HOOKE_ALTITUDES; k++)
    least = fmin(least, t->rest[k]);
  return least;
}

double hk_tetrahedron_kappa(const struct hk_tetrahedron *t) {
  return t->stiffness / shortest(t);
}

double hk_tetrahedron_gamma(const struct hk_tetrahedron *t) {
  return t->damping / shortest(t);
}
