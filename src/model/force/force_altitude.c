/* Altitude springs (kernel/altitude_loops.h): U = ks/(2 l) (h - l)^2 for the currently shortest altitude h of
 * a tetrahedron, l its rest length. Where another altitude becomes the shortest the energy jumps, since their
 * rest lengths differ. Between such changes f_j = -T g_j u is its exact derivative: dh = u.(sum of g_j
 * dq_j). */

#include "core/memory.h"
#include "core/sum.h"
#include "kernel/spring/spring_loops.h"
#include "model/check_value.h"
#include "model/force/altitude.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* ---- one altitude spring ---- */

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

/* Its derivative along dq and dv: of u, the weights and the tension. */
struct tautness_change {
  double u[3], weight[4], tension;
};

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

static void differentiate(const struct hk_tetrahedron *t, const struct hk_tautness *s, const double *q,
                          const double *v, const double *dq, const double *dv,
                          struct tautness_change *change) {
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

/* ---- the force ---- */

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const double *const q[3] = {motion->q[0], motion->q[1], motion->q[2]};
  const double *const still = motion->zero;
  const double *const v[3] = {still ? still : motion->v[0], still ? still : motion->v[1],
                              still ? still : motion->v[2]};
  hk_spring_set(0)->tetrahedra(system->altitudes->count, system->altitudes->tetrahedron, q, v, motion->f);
  return HOOKE_OK;
}

static double energy(const hooke_system *system, double t, const double *q) {
  (void)t;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *of = &system->altitudes->tetrahedron[k];
    struct hk_tautness s;
    if (!hk_tautness_find(of, q, NULL, &s)) continue;
    hk_sum_add(&sum, 0.5 * s.elastic * (s.altitude.length - of->rest[s.altitude.choice]));
  }
  return hk_sum_value(&sum);
}

static double heat(const hooke_system *system, double t, const double *q, const double *v) {
  (void)t;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *of = &system->altitudes->tetrahedron[k];
    struct hk_tautness s;
    if (of->damping == 0.0 || !hk_tautness_find(of, q, v, &s)) continue;
    if (of->pull_only) /* damping does not exceed the tension */
      hk_sum_add(&sum, (s.tension - s.elastic) * s.rate);
    else
      hk_sum_add(&sum, (of->damping / of->rest[s.altitude.choice] * s.rate) * s.rate);
  }
  return hk_sum_value(&sum);
}

static int32_t change(const hooke_system *system, int64_t number, const struct hk_point *point,
                      struct hk_member_change *out) {
  const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[number];
  struct hk_tautness s;
  struct tautness_change d;
  out->count = 4;
  memcpy(out->particle, t->particle, sizeof t->particle);
  if (!hk_tautness_find(t, point->q, point->v, &s) || s.slack) return 0;
  differentiate(t, &s, point->q, point->v, point->dq, point->dv, &d);
  for (int j = 0; j < 4; j++) {
    const double g = s.altitude.weight[j];
    for (int a = 0; a < 3; a++)
      out->force[j][a] =
          -((d.tension * g + s.tension * d.weight[j]) * s.altitude.u[a] + s.tension * g * d.u[a]);
  }
  return 1;
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)t;
  for (int64_t k = 0; k < wanted; k++) {
    struct hk_tetrahedron of = system->altitudes->tetrahedron[first + k];
    struct hk_tautness s;
    if (v == NULL) of.pull_only = 0;
    out[k] = (struct hk_element){.count = 4, .over = 1.0};
    memcpy(out[k].particle, of.particle, sizeof of.particle);
    if (q == NULL || !hk_tautness_find(&of, q, v, &s) || s.slack) continue;
    const double rest = of.rest[s.altitude.choice];
    memcpy(out[k].u, s.altitude.u, sizeof s.altitude.u);
    memcpy(out[k].weight, s.altitude.weight, sizeof s.altitude.weight);
    out[k].over = v ? rest : 1.0;
    out[k].k_along = v ? of.stiffness : of.stiffness / rest;
    out[k].c_along = v ? of.damping : of.damping / rest;
    out[k].pull_only = system->altitudes->tetrahedron[first + k].pull_only;
    out[k].elastic = s.elastic;
  }
}

static int32_t damped(const hooke_system *system) {
  return system->altitudes->damped;
}

static double shortest_rest(const struct hk_tetrahedron *t) {
  double least = t->rest[0];
  for (int k = 1; k < HOOKE_ALTITUDES; k++)
    least = fmin(least, t->rest[k]);
  return least;
}

static void add_stiffness(const hooke_system *system, double *sum) {
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    *sum += 4.0 * (t->stiffness / shortest_rest(t));
  }
}

/* ---- from groups ---- */

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct hk_altitudes *altitudes = system->altitudes;
  *altitudes = (struct hk_altitudes){
      .tetrahedron = hk_new(hk_force_count(system, &hk_force_altitude), sizeof *altitudes->tetrahedron)};
  if (altitudes->tetrahedron == NULL) return HOOKE_NO_MEMORY;
  for (; count > 0; group++, count--) {
    altitudes->damped |= group->damped;
    for (int64_t k = 0; k < group->count; k++) {
      struct hk_tetrahedron *t = &altitudes->tetrahedron[altitudes->count++];
      const double *rest = group->number[HOOKE_REST_LENGTH] + HOOKE_ALTITUDES * k;
      *t = (struct hk_tetrahedron){.choice = HOOKE_ALTITUDE_SHORTEST,
                                   .pull_only = group->pull_only,
                                   .side = signbit(rest[0]) ? -1.0 : 1.0,
                                   .stiffness = group->number[HOOKE_KAPPA][k],
                                   .damping = group->number[HOOKE_GAMMA][k]};
      for (int e = 0; e < 4; e++)
        t->particle[e] = group->particle[e][k];
      for (int a = 0; a < HOOKE_ALTITUDES; a++)
        t->rest[a] = fabs(rest[a]);
    }
  }
  return HOOKE_OK;
}

static void release(hooke_system *system) {
  hk_free(system->altitudes->tetrahedron);
  *system->altitudes = (struct hk_altitudes){0};
}

static int64_t memory(const hooke_system *system) {
  return system->altitudes->count * (int64_t)sizeof(struct hk_tetrahedron);
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_whole(value, system->altitudes->count);
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    hk_check_add(value, t->particle, 4, sizeof *t->particle);
    hk_check_whole(value, t->choice);
    hk_check_whole(value, t->pull_only);
    hk_check_add(value, &t->side, 1, sizeof(double));
    hk_check_add(value, &t->stiffness, 1, sizeof(double));
    hk_check_add(value, &t->damping, 1, sizeof(double));
    hk_check_add(value, t->rest, HOOKE_ALTITUDES, sizeof(double));
  }
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  for (int64_t k = 0; k < to->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[first + k];
    for (int e = 0; e < 4; e++)
      to->particle[e][k] = t->particle[e];
    to->number[HOOKE_KAPPA][k] = t->stiffness;
    to->number[HOOKE_GAMMA][k] = t->damping;
    for (int a = 0; a < HOOKE_ALTITUDES; a++)
      to->number[HOOKE_REST_LENGTH][HOOKE_ALTITUDES * k + a] = t->side * t->rest[a];
  }
}

const struct hk_force_row hk_force_altitude = {.name = "altitude",
                                               .kind = HOOKE_KEPT,
                                               .title = "altitude springs",
                                               .members = "tetrahedra",
                                               .options = &hk_altitude_options,
                                               .member = "tetrahedron",
                                               .place = "tetrahedra",
                                               .width = {1, 1, HOOKE_ALTITUDES},
                                               .member_particles = 4,
                                               HOOKE_FORCE_OF_GROUPS,
                                               .bytes = 170.0,
                                               .add = add,
                                               .energy = energy,
                                               .heat = heat,
                                               .change = change,
                                               .elements = elements,
                                               .add_stiffness = add_stiffness,
                                               .damped = damped};

/* ---- queries ---- */

int32_t hooke_system_altitude_lengths(const hooke_system *system, const double *q, double *length) {
  const int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    struct hk_tautness tautness;
    const int32_t found = hk_tautness_find(&system->altitudes->tetrahedron[k], q, NULL, &tautness);
    length[k] = found ? tautness.altitude.length : 0.0;
  }
  return HOOKE_OK;
}
