/* One altitude spring at given positions and velocities, and its derivatives. */
#include "model/force/altitude.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

static void gather(const struct hk_tetrahedron *t, const double *rows, double x[4][3]) {
  for (int j = 0; j < 4; j++)
    memcpy(x[j], rows + 3 * (int64_t)t->particle[j], sizeof x[j]);
}

int32_t hk_tautness_find(const struct hk_tetrahedron *t, const double *q, const double *v,
                         struct hk_tautness *s) {
  double x[4][3], w[3];
  gather(t, q, x);
  memset(s, 0, sizeof *s);
  if (!hk_altitude_find(t, (const double(*)[3])x, &s->altitude)) return 0;
  if (v) {
    gather(t, v, x);
    hk_altitude_weigh(&s->altitude, (const double(*)[3])x, w);
    s->rate = hk_dot3(s->altitude.u, w);
  }
  const double rest = t->rest[s->altitude.choice];
  s->tension = hk_altitude_tension(t, &s->altitude, s->rate, &s->slack);
  s->elastic =
      t->pull_only && s->altitude.length <= rest ? 0.0 : t->stiffness * (s->altitude.length - rest) / rest;
  return 1;
}

/* The vectors that define the altitude: e, f and r. */
static void span(int32_t choice, const double x[4][3], double e[3], double f[3], double r[3]) {
  const int8_t *role = hk_altitude_role[choice];
  const double *x0 = x[role[0]], *x1 = x[role[1]], *x2 = x[role[2]], *x3 = x[role[3]];
  for (int a = 0; a < 3; a++) {
    e[a] = x1[a] - x0[a];
    f[a] = choice < 4 ? x2[a] - x0[a] : x3[a] - x2[a];
    r[a] = choice < 4 ? x3[a] - x0[a] : x2[a] - x0[a];
  }
}

/* d(a x b) */
static void cross_change(const double a[3], const double b[3], const double da[3], const double db[3],
                         double dn[3]) {
  double other[3];
  hk_cross3(da, b, dn);
  hk_cross3(a, db, other);
  for (int k = 0; k < 3; k++)
    dn[k] += other[k];
}

void hk_tautness_differentiate(const struct hk_tetrahedron *t, const struct hk_tautness *s, const double *q,
                               const double *v, const double *dq, const double *dv,
                               struct hk_tautness_change *change) {
  const struct hk_altitude *altitude = &s->altitude;
  const int32_t choice = altitude->choice;
  const int8_t *role = hk_altitude_role[choice];
  double x[4][3], dx[4][3], u[4][3], du[4][3];
  double e[3], f[3], r[3], de[3], df[3], dr[3], n[3], dn[3], rf[3], re[3], drf[3], dre[3];
  gather(t, q, x);
  gather(t, dq, dx);
  gather(t, v, u);
  gather(t, dv, du);
  span(choice, (const double(*)[3])x, e, f, r);
  span(choice, (const double(*)[3])dx, de, df, dr);
  hk_cross3(e, f, n);
  cross_change(e, f, de, df, dn);
  hk_cross3(r, f, rf);
  cross_change(r, f, dr, df, drf);
  hk_cross3(r, e, re);
  cross_change(r, e, dr, de, dre);
  const double square = hk_dot3(n, n), growth = 2.0 * hk_dot3(n, dn) / square, c = t->side / sqrt(square);
  const double a = hk_dot3(rf, n) / square, b = hk_dot3(re, n) / square;
  const double da = (hk_dot3(drf, n) + hk_dot3(rf, dn)) / square - a * growth;
  const double db = (hk_dot3(dre, n) + hk_dot3(re, dn)) / square - b * growth;
  for (int k = 0; k < 3; k++)
    change->u[k] = c * dn[k] - 0.5 * growth * altitude->u[k];
  change->weight[role[0]] = choice < 4 ? da - db : da;
  change->weight[role[1]] = -da;
  change->weight[role[2]] = choice < 4 ? db : -db;
  change->weight[role[3]] = choice < 4 ? 0.0 : db;
  /* dh, and d(u.w) of the weighted velocity w */
  double w[3], moved[3], dw[3];
  hk_altitude_weigh(altitude, (const double(*)[3])dx, moved);
  hk_altitude_weigh(altitude, (const double(*)[3])u, w);
  hk_altitude_weigh(altitude, (const double(*)[3])du, dw);
  for (int j = 0; j < 4; j++) {
    for (int k = 0; k < 3; k++)
      dw[k] += change->weight[j] * u[j][k];
  }
  const double rate = hk_dot3(change->u, w) + hk_dot3(altitude->u, dw);
  change->tension = (t->stiffness * hk_dot3(altitude->u, moved) + t->damping * rate) / t->rest[choice];
}
