#include "kernel/altitude_loops.h"

#include <math.h>

const int8_t hk_altitude_role[HOOKE_ALTITUDES][4] = HOOKE_ALTITUDE_ROLES;

static inline double dot(const double a[3], const double b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double n[3]) {
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void subtract(const double a[3], const double b[3], double d[3]) {
  for (int k = 0; k < 3; k++)
    d[k] = a[k] - b[k];
}

static inline void span(const double x[4][3], int32_t choice, double e[3], double f[3]) {
  const int8_t *role = hk_altitude_role[choice];
  subtract(x[role[1]], x[role[0]], e);
  if (choice < 4)
    subtract(x[role[2]], x[role[0]], f);
  else
    subtract(x[role[3]], x[role[2]], f);
}

static int32_t choose(const double x[4][3]) {
  double most = 0.0, e[3], f[3], n[3];
  int32_t choice = HOOKE_ALTITUDE_SHORTEST;
  for (int32_t k = 0; k < HOOKE_ALTITUDES; k++) {
    span(x, k, e, f);
    cross(e, f, n);
    const double square = dot(n, n);
    if (!(square > most)) continue;
    most = square;
    choice = k;
  }
  return choice;
}

int32_t hk_altitude_find(const struct hk_tetrahedron *tetrahedron, const double x[4][3],
                         struct hk_altitude *altitude) {
  const int32_t fixed = tetrahedron->choice != HOOKE_ALTITUDE_SHORTEST;
  const int32_t choice = altitude->choice = fixed ? tetrahedron->choice : choose(x);
  if (choice == HOOKE_ALTITUDE_SHORTEST) return 0;
  const int8_t *role = hk_altitude_role[choice];
  double e[3], f[3], r[3], n[3], rf[3], re[3];
  span(x, choice, e, f);
  subtract(x[role[choice < 4 ? 3 : 2]], x[role[0]], r);
  cross(e, f, n);
  const double square = dot(n, n);
  if (!(square > 0.0)) return 0;
  const double c = tetrahedron->side * (1.0 / sqrt(square));
  for (int k = 0; k < 3; k++)
    altitude->u[k] = c * n[k];
  altitude->length = dot(altitude->u, r);
  cross(r, f, rf);
  cross(r, e, re);
  const double a = dot(rf, n) / square, b = dot(re, n) / square;
  altitude->weight[role[0]] = choice < 4 ? (a - b) - 1.0 : a - 1.0;
  altitude->weight[role[1]] = -a;
  altitude->weight[role[2]] = choice < 4 ? b : 1.0 - b;
  altitude->weight[role[3]] = choice < 4 ? 1.0 : b;
  return 1;
}

void hk_altitude_weigh(const struct hk_altitude *altitude, const double v[4][3], double w[3]) {
  const double *g = altitude->weight;
  for (int k = 0; k < 3; k++)
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): the four roles are all of 0 to 3 */
    w[k] = ((g[0] * v[0][k] + g[1] * v[1][k]) + g[2] * v[2][k]) + g[3] * v[3][k];
}

double hk_altitude_tension(const struct hk_tetrahedron *tetrahedron, const struct hk_altitude *altitude,
                           double rate, int32_t *slack) {
  const double rest = tetrahedron->rest[altitude->choice];
  const double tension =
      (tetrahedron->stiffness * (altitude->length - rest) + tetrahedron->damping * rate) / rest;
  const int32_t is_slack = tetrahedron->pull_only && (altitude->length <= rest || tension < 0.0);
  if (slack) *slack = is_slack;
  return is_slack ? 0.0 : tension;
}
