/* Compile without contraction of products and sums (-ffp-contract=off), like the library. */
#include "canonical_step.h"

#include "check.h"
#include "run.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double following[2] = {0.001, 0.0065}, stiffnesses[2] = {1.2, 0.7}, rests[2] = {0.9, 1.15};

void canonical_follow(hooke_options *options, const char *family) {
  const char *const factor[2] = {"stiffness_scale", "rest_scale"};
  const double *const value[2] = {stiffnesses, rests};
  char name[64];
  for (int k = 0; k < 2; k++) {
    snprintf(name, sizeof name, "%s%s.motion", family, factor[k]);
    check_ok(hooke_options_set_text(options, name, "table"));
    snprintf(name, sizeof name, "%s%s.time", family, factor[k]);
    check_ok(hooke_options_set_numbers(options, name, 2, following));
    snprintf(name, sizeof name, "%s%s.value", family, factor[k]);
    check_ok(hooke_options_set_numbers(options, name, 2, value[k]));
  }
}

void canonical_create(const hooke_system *system, struct canonical *canonical) {
  const int64_t n = hooke_system_particle_count(system), m = hooke_system_count(system, "springs");
  memset(canonical, 0, sizeof *canonical);
  canonical->particle_count = n;
  canonical->spring_count = m;
  canonical->ends = new_block(2 * m, (int64_t)sizeof(int64_t));
  canonical->kappa = new_doubles(m);
  canonical->gamma = new_doubles(m);
  canonical->rest_length = new_doubles(m);
  canonical->pull_only = new_block(m, 1);
  canonical->follows = new_block(m, 1);
  canonical->inverse_mass = new_doubles(n);
  canonical->triple_count = hooke_system_count(system, "bending");
  canonical->triples = new_block(3 * canonical->triple_count, (int64_t)sizeof(int64_t));
  canonical->coefficient = new_doubles(canonical->triple_count);
  check_ok(hooke_system_members(system, "bending", canonical->triples, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "bending", NULL, canonical->coefficient, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", canonical->ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, canonical->kappa, canonical->gamma,
                                canonical->rest_length));
  memcpy(canonical->inverse_mass, hooke_system_inverse_mass(system), (size_t)n * sizeof(double));
  const int64_t t = canonical->tetrahedron_count = hooke_system_count(system, "altitude");
  canonical->corners = new_block(4 * t, (int64_t)sizeof(int64_t));
  for (int k = 0; k < 3; k++)
    canonical->altitude[k] = new_doubles(k < 2 ? t : 7 * t);
  canonical->altitude_pull_only = new_block(t, 1);
  check_ok(hooke_system_members(system, "altitude", canonical->corners, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "altitude", NULL, canonical->altitude[0], canonical->altitude[1],
                                canonical->altitude[2]));
  for (int64_t g = 0, at = 0; g < hooke_system_group_count(system, "altitude"); g++) {
    const int64_t size = hooke_system_group_size(system, "altitude", g);
    const int pulls = strncmp(hooke_system_group_name(system, "altitude", g), "pull", 4) == 0;
    assert_true(at + size <= t);
    if (size > 0) memset(canonical->altitude_pull_only + at, pulls, (size_t)size);
    at += size;
  }
  const int64_t anchors = canonical->anchor_count = hooke_system_count(system, "anchors");
  canonical->anchored = new_block(anchors, (int64_t)sizeof(int64_t));
  canonical->anchor_point = new_doubles(3 * anchors);
  for (int k = 0; k < 3; k++)
    canonical->anchor[k] = new_doubles(anchors);
  check_ok(hooke_system_members(system, "anchors", canonical->anchored, canonical->anchor[0],
                                canonical->anchor[1], canonical->anchor[2]));
  check_ok(hooke_system_anchor_points(system, canonical->anchor_point));
  canonical->load_count = hooke_system_count(system, "loads");
  canonical->loaded = new_block(canonical->load_count, (int64_t)sizeof(int64_t));
  check_ok(hooke_system_members(system, "loads", canonical->loaded, NULL, NULL, NULL));
  const int64_t pieces = canonical->piece_count = hooke_system_count(system, "fluid_drag");
  canonical->pieces = new_block(3 * pieces, (int64_t)sizeof(int64_t));
  canonical->normal = new_doubles(pieces);
  canonical->tangential = new_doubles(pieces);
  check_ok(hooke_system_members(system, "fluid_drag", canonical->pieces, NULL, canonical->normal,
                                canonical->tangential));
  int64_t spring = 0;
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    const int64_t size = hooke_system_group_size(system, "springs", g);
    const char *name = hooke_system_group_name(system, "springs", g);
    const int pulls = strncmp(name, "pull", 4) == 0,
              follows = strstr(name, "follows") ? CANONICAL_FOLLOWS : 0;
    assert_true(spring + size <= m);
    memset(canonical->pull_only + spring, pulls, (size_t)size);
    memset(canonical->follows + spring,
           follows && strstr(name, "strain") ? follows | CANONICAL_BY_STRAIN : follows, (size_t)size);
    spring += size;
  }
  assert_int_equal(spring, m);
}

void canonical_destroy(struct canonical *canonical) {
  free(canonical->ends);
  free(canonical->kappa);
  free(canonical->gamma);
  free(canonical->rest_length);
  free(canonical->pull_only);
  free(canonical->follows);
  free(canonical->triples);
  free(canonical->coefficient);
  free(canonical->corners);
  for (int k = 0; k < 3; k++)
    free(canonical->altitude[k]);
  free(canonical->altitude_pull_only);
  free(canonical->anchored);
  free(canonical->anchor_point);
  free(canonical->loaded);
  for (int k = 0; k < 3; k++)
    free(canonical->anchor[k]);
  free(canonical->inverse_mass);
  free(canonical->pieces);
  free(canonical->normal);
  free(canonical->tangential);
  memset(canonical, 0, sizeof *canonical);
}

/* A spring that only pulls counts as taut by the velocities `seen`. */
static double rate_of(int64_t i, int64_t j, double dx, double dy, double dz, double ir, const double *v) {
  const double vx = v[3 * i] - v[3 * j], vy = v[3 * i + 1] - v[3 * j + 1], vz = v[3 * i + 2] - v[3 * j + 2];
  return ((vx * dx + vy * dy) + vz * dz) * ir;
}

static double brake(const struct canonical *canonical, double gamma, double rate) {
  return gamma == 0.0 && canonical->leaves_out ? 0.0 : gamma * rate;
}

/* The cubic through two samples, whose slopes at both are that of the line. */
static double between(double t, const double value[2]) {
  const double first = following[0], last = following[1];
  if (t <= first) return value[0];
  if (t >= last) return value[1];
  const double width = last - first, s = (t - first) / width, rise = value[1] - value[0];
  const double m = width * (rise / width), c2 = 3.0 * rise - 2.0 * m - m,
               c3 = 2.0 * (value[0] - value[1]) + m + m;
  return value[0] + s * (m + s * (c2 + s * c3));
}

struct numbers {
  double kappa, gamma, l0;
};

static struct numbers scaled(const struct canonical *canonical, int64_t k, double stiffness, double rest) {
  const struct numbers given = {canonical->kappa[k], canonical->gamma[k], canonical->rest_length[k]};
  const double divisor = canonical->follows[k] & CANONICAL_BY_STRAIN ? rest : 1.0;
  if (!canonical->follows[k]) return given;
  return (struct numbers){given.kappa * (stiffness / divisor), given.gamma * (1.0 / divisor),
                          given.l0 * rest};
}

static struct numbers numbers_at(const struct canonical *canonical, int64_t k, double t) {
  return scaled(canonical, k, between(t, stiffnesses), between(t, rests));
}

static void add_spring(const struct canonical *canonical, int64_t k, double t, const double *q,
                       const double *v, const double *seen, double *force) {
  const int64_t i = canonical->ends[2 * k], j = canonical->ends[2 * k + 1];
  const struct numbers now = numbers_at(canonical, k, t);
  const double kappa = now.kappa, gamma = now.gamma, l0 = now.l0;
  const double dx = q[3 * i] - q[3 * j], dy = q[3 * i + 1] - q[3 * j + 1], dz = q[3 * i + 2] - q[3 * j + 2];
  const double r = sqrt((dx * dx + dy * dy) + dz * dz);
  const double ir = r > 0.0 ? 1.0 / r : 0.0;
  double tension = kappa * (r - l0) + brake(canonical, gamma, rate_of(i, j, dx, dy, dz, ir, v));
  const double tension_seen = kappa * (r - l0) + brake(canonical, gamma, rate_of(i, j, dx, dy, dz, ir, seen));
  if (canonical->pull_only[k] && (r <= l0 || tension_seen < 0.0)) tension = 0.0;
  const double s = tension * ir;
  const double fx = -s * dx, fy = -s * dy, fz = -s * dz;
  force[3 * i] += fx;
  force[3 * i + 1] += fy;
  force[3 * i + 2] += fz;
  force[3 * j] -= fx;
  force[3 * j + 1] -= fy;
  force[3 * j + 2] -= fz;
}

static void add_triple(const struct canonical *canonical, int64_t k, const double *q, double *force) {
  const int64_t *p = canonical->triples + 3 * k;
  for (int a = 0; a < 3; a++) {
    const double d = (q[3 * p[0] + a] - 2.0 * q[3 * p[1] + a]) + q[3 * p[2] + a];
    const double f = canonical->coefficient[k] * d;
    force[3 * p[0] + a] -= f;
    force[3 * p[1] + a] += 2.0 * f;
    force[3 * p[2] + a] -= f;
  }
}

/* ---- altitude springs ---- */

/* The corners i0 .. i3 of each altitude. */
static const int role[7][4] = {{1, 3, 2, 0}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 2, 3},
                               {0, 1, 3, 2}, {0, 2, 1, 3}, {0, 3, 2, 1}};

static void altitude_vectors(const double *const x[4], int k, double e[3], double f[3], double r[3]) {
  const double *x0 = x[role[k][0]], *x1 = x[role[k][1]], *x2 = x[role[k][2]], *x3 = x[role[k][3]];
  for (int a = 0; a < 3; a++) {
    e[a] = x1[a] - x0[a];
    f[a] = k < 4 ? x2[a] - x0[a] : x3[a] - x2[a];
    r[a] = k < 4 ? x3[a] - x0[a] : x2[a] - x0[a];
  }
}

void canonical_altitudes(const double *const x[4], double square[7]) {
  for (int k = 0; k < 7; k++) {
    double e[3], f[3], r[3], n[3];
    altitude_vectors(x, k, e, f, r);
    canonical_cross(e, f, n);
    square[k] = canonical_dot(n, n);
  }
}

static double altitude_tension(const struct canonical *canonical, int64_t k, double h, double l,
                               double rate) {
  return (canonical->altitude[0][k] * (h - l) + canonical->altitude[1][k] * rate) / l;
}

/* The rate of an altitude with weights g. */
static double altitude_rate(const int64_t *p, const double g[4], const double u[3], const double *v) {
  double w[3];
  for (int a = 0; a < 3; a++)
    w[a] =
        ((g[0] * v[3 * p[0] + a] + g[1] * v[3 * p[1] + a]) + g[2] * v[3 * p[2] + a]) + g[3] * v[3 * p[3] + a];
  return canonical_dot(u, w);
}

/* The altitude that acts: its length, rest length, direction and weights. */
struct altitude {
  double h, l, u[3], g[4];
};

/* 0 if none does. */
static int find_altitude(const struct canonical *canonical, int64_t number, const double *q,
                         struct altitude *out) {
  const int64_t *p = canonical->corners + 4 * number;
  const double *const x[4] = {q + 3 * p[0], q + 3 * p[1], q + 3 * p[2], q + 3 * p[3]};
  double square[7], e[3], f[3], r[3], n[3], rf[3], re[3];
  canonical_altitudes(x, square);
  int k = -1; /* an overflowed altitude does not count */
  for (int other = 0; other < 7; other++) {
    if (square[other] > (k < 0 ? 0.0 : square[k])) k = other;
  }
  if (k < 0) return 0;
  altitude_vectors(x, k, e, f, r);
  canonical_cross(e, f, n);
  canonical_cross(r, f, rf);
  canonical_cross(r, e, re);
  const double rest = canonical->altitude[2][7 * number + k], side = rest < 0.0 ? -1.0 : 1.0;
  const double c = side * (1.0 / sqrt(square[k]));
  out->l = fabs(rest);
  for (int a = 0; a < 3; a++)
    out->u[a] = c * n[a];
  const double a = canonical_dot(rf, n) / square[k], b = canonical_dot(re, n) / square[k];
  out->h = canonical_dot(out->u, r);
  out->g[role[k][0]] = k < 4 ? (a - b) - 1.0 : a - 1.0;
  out->g[role[k][1]] = -a;
  out->g[role[k][2]] = k < 4 ? b : 1.0 - b;
  out->g[role[k][3]] = k < 4 ? 1.0 : b;
  return 1;
}

static void add_tetrahedron(const struct canonical *canonical, int64_t number, const double *q,
                            const double *v, const double *seen, double *force) {
  const int64_t *p = canonical->corners + 4 * number;
  struct altitude s;
  if (!find_altitude(canonical, number, q, &s)) return;
  double tension = altitude_tension(canonical, number, s.h, s.l, altitude_rate(p, s.g, s.u, v));
  const double seen_rate = altitude_rate(p, s.g, s.u, seen);
  const double tension_seen = altitude_tension(canonical, number, s.h, s.l, seen_rate);
  if (canonical->altitude_pull_only[number] && (s.h <= s.l || tension_seen < 0.0)) tension = 0.0;
  for (int j = 0; j < 4; j++) {
    const double size = tension * s.g[j];
    for (int axis = 0; axis < 3; axis++)
      force[3 * p[j] + axis] -= size * s.u[axis];
  }
}

/* As a spring, whose second end is a point at rest. */
static void add_anchor(const struct canonical *canonical, int64_t k, const double *q, const double *v,
                       double *force) {
  const double *x = q + 3 * canonical->anchored[k], *u = v + 3 * canonical->anchored[k];
  const double *point = canonical->anchor_point + 3 * k, gamma = canonical->anchor[1][k];
  const double d[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
  const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]), ir = r > 0.0 ? 1.0 / r : 0.0;
  double tension = canonical->anchor[0][k] * (r - canonical->anchor[2][k]);
  if (gamma != 0.0) tension += gamma * (((u[0] * d[0] + u[1] * d[1]) + u[2] * d[2]) * ir);
  for (int a = 0; a < 3; a++)
    force[3 * canonical->anchored[k] + a] -= tension * ir * d[a];
}

/* Damping at v; springs that only pull and the callback are evaluated at `seen`. */
void canonical_accelerate(const struct canonical *canonical, double t, const double *q, const double *v,
                          const double *seen, double *acceleration) {
  const int64_t n = canonical->particle_count;
  const double *w = canonical->inverse_mass;
  double *force = acceleration;
  memset(force, 0, (size_t)(3 * n) * sizeof(double));
  for (int64_t k = 0; k < canonical->spring_count; k++)
    add_spring(canonical, k, t, q, v, seen, force);
  for (int64_t k = 0; k < canonical->triple_count; k++)
    add_triple(canonical, k, q, force);
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++)
    add_tetrahedron(canonical, k, q, v, seen, force);
  for (int64_t k = 0; k < canonical->anchor_count; k++)
    add_anchor(canonical, k, q, v, force);
  for (int64_t k = 0; k < canonical->obstacle_count * n; k++)
    if (w[k % n] != 0.0)
      canonical_push_out(&canonical->obstacle[k / n], q + 3 * (k % n), v + 3 * (k % n), force + 3 * (k % n));
  canonical_add_pieces(canonical, q, v, force);
  if (canonical->drag != 0.0) {
    for (int64_t p = 0; p < n; p++) {
      for (int a = 0; a < 3 && w[p] != 0.0; a++)
        force[3 * p + a] -= canonical->drag * v[3 * p + a];
    }
  }
  canonical_add_drag(canonical, canonical->drags, 0, v, force);
  canonical_add_drag(canonical, canonical->quadratic, 1, v, force);
  if (canonical->load_count > 0) canonical_add_loads(canonical, t, force);
  if (canonical->force != NULL) assert_int_equal(canonical->force(n, t, q, seen, force, canonical->ctx), 0);
  for (int64_t p = 0; p < n; p++) {
    for (int a = 0; a < 3; a++) {
      double *f = &force[3 * p + a];
      *f = w[p] * *f;
      if (canonical->gravity != NULL) *f += canonical_fall(canonical, 3 * p + a);
      if (w[p] == 0.0) *f = 0.0;
    }
  }
}

void canonical_acceleration(const struct canonical *canonical, double t, const double *q, const double *v,
                            double *acceleration) {
  canonical_accelerate(canonical, t, q, v, v, acceleration);
}

/* ---- steps ---- */

void canonical_place(const struct canonical *canonical, double t, double *q, double *v) {
  if (canonical->place != NULL) canonical->place(t, q, v, canonical->place_ctx);
}

int canonical_is_free(const struct canonical *canonical, int64_t k) {
  return canonical->inverse_mass[k / 3] != 0.0;
}

static void forward_euler(const struct canonical *canonical, double t, double h, double *q, double *v,
                          double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    q[k] += h * v[k];
    v[k] += h * a[k];
  }
}

static void symplectic_euler(const struct canonical *canonical, double t, double h, double *q, double *v,
                             double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    v[k] += h * a[k];
    q[k] += h * v[k];
  }
}

/* What a step of Verlet does before its second kick: q at the end, the velocity half-way, and in v that at
 * the end as far as the first kick tells it. */
void canonical_predict(const struct canonical *canonical, double t, double end, double h, double *q,
                       double *v, double *half, double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    half[k] = v[k];
    if (!canonical_is_free(canonical, k)) continue;
    half[k] = v[k] + h / 2.0 * a[k];
    q[k] += h * half[k];
    v[k] = half[k] + h / 2.0 * a[k];
  }
  canonical_place(canonical, end, q, v);
}

/* Forces of springs and callbacks at the predicted velocity, drag at the new one. */
static void verlet(const struct canonical *canonical, double t, double end, double h, double *q, double *v,
                   double *a) {
  struct canonical without_drag = *canonical;
  without_drag.drag = 0.0;
  double *half = new_doubles(3 * canonical->particle_count);
  canonical_predict(canonical, t, end, h, q, v, half, a);
  canonical_acceleration(&without_drag, end, q, v, a);
  const double brake = h / 2.0 * canonical->drag;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    v[k] = half[k] + h / 2.0 * a[k];
    if (canonical->drag != 0.0) v[k] /= 1.0 + brake * canonical->inverse_mass[k / 3];
  }
  free(half);
}

/* ---- dampers of pairs, one after the other ---- */

/* The part of its rate that a damper of strength c takes in a time, over the inverse mass that it acts on. */
static double damper_share(double time, double c, double w) {
  const double z = time * c * w, y = z * (1.0 + z / 2.0);
  return y > 0.0 ? 1.0 / (1.0 + 1.0 / y) / w : 0.0;
}

static int has_damper(const struct canonical *canonical, int64_t k) {
  const double *w = canonical->inverse_mass;
  return canonical->gamma[k] != 0.0 && w[canonical->ends[2 * k]] + w[canonical->ends[2 * k + 1]] > 0.0;
}

/* Damped springs by colour, and in ascending number within each; `count` of them. The colour of a spring is
 * the lowest that no earlier damped spring has at either end. */
static int64_t *damper_order(const struct canonical *canonical, int64_t *count) {
  const int64_t m = canonical->spring_count;
  int64_t *colour = new_block(m, (int64_t)sizeof *colour), *order = new_block(m, (int64_t)sizeof *order);
  /* the colours that are taken at each particle, in lists */
  int64_t *newest = new_block(canonical->particle_count, (int64_t)sizeof *newest),
          *older = new_block(2 * m, (int64_t)sizeof *older),
          *seen = new_block(2 * m + 2, (int64_t)sizeof *seen),
          *first = new_block(m + 2, (int64_t)sizeof *first);
  for (int64_t p = 0; p < canonical->particle_count; p++)
    newest[p] = -1;
  *count = 0;
  for (int64_t k = 0; k < m; k++) {
    colour[k] = -1;
    if (!has_damper(canonical, k)) continue;
    for (int e = 0; e < 2; e++) {
      for (int64_t at = newest[canonical->ends[2 * k + e]]; at >= 0; at = older[at])
        seen[colour[at / 2]] = k + 1;
    }
    colour[k] = 0;
    while (seen[colour[k]] == k + 1)
      colour[k]++;
    for (int e = 0; e < 2; e++) {
      older[2 * k + e] = newest[canonical->ends[2 * k + e]];
      newest[canonical->ends[2 * k + e]] = 2 * k + e;
    }
    first[colour[k] + 1]++;
    ++*count;
  }
  for (int64_t c = 0; c <= m; c++)
    first[c + 1] += first[c];
  for (int64_t k = 0; k < m; k++) {
    if (colour[k] >= 0) order[first[colour[k]]++] = k;
  }
  free(colour);
  free(newest);
  free(older);
  free(seen);
  free(first);
  return order;
}

static void damp_spring(const struct canonical *canonical, int64_t k, double t, double time, const double *q,
                        double *v) {
  const struct numbers now = numbers_at(canonical, k, t);
  const int64_t i = canonical->ends[2 * k], j = canonical->ends[2 * k + 1];
  const double *w = canonical->inverse_mass;
  const double dx = q[3 * i] - q[3 * j], dy = q[3 * i + 1] - q[3 * j + 1], dz = q[3 * i + 2] - q[3 * j + 2];
  const double r = sqrt((dx * dx + dy * dy) + dz * dz), ir = r > 0.0 ? 1.0 / r : 0.0;
  const double rate = rate_of(i, j, dx, dy, dz, ir, v);
  double impulse = damper_share(time, now.gamma, w[i] + w[j]) * rate;
  if (canonical->pull_only[k]) {
    const double least = -(time * (now.kappa * (r - now.l0)));
    if (impulse < least) impulse = least;
    if (r <= now.l0) impulse = 0.0;
  }
  const double s = impulse * ir, b[3] = {s * dx, s * dy, s * dz};
  for (int a = 0; a < 3; a++) {
    v[3 * i + a] -= w[i] * b[a];
    v[3 * j + a] += w[j] * b[a];
  }
}

/* One element with `count` weights, c along u; `elastic` is the tension of what only pulls, else NULL. */
static void damp_element(const struct canonical *canonical, int count, const int64_t *particle,
                         const double *weight, const double u[3], double c, const double *elastic,
                         double time, double *v) {
  double w = 0.0, rate[3];
  for (int j = 0; j < count; j++) {
    w += weight[j] * weight[j] * canonical->inverse_mass[particle[j]];
    for (int a = 0; a < 3; a++) {
      const double own = weight[j] * v[3 * particle[j] + a];
      rate[a] = j == 0 ? own : rate[a] + own;
    }
  }
  if (!(w > 0.0)) return;
  double impulse = damper_share(time, c, w) * canonical_dot(u, rate);
  if (elastic && impulse < -(time * *elastic)) impulse = -(time * *elastic);
  if (elastic && !(*elastic > 0.0)) impulse = 0.0;
  for (int j = 0; j < count; j++) {
    const double by = canonical->inverse_mass[particle[j]] * weight[j];
    for (int a = 0; a < 3; a++)
      v[3 * particle[j] + a] -= by * (impulse * u[a]);
  }
}

static void damp_tetrahedron(const struct canonical *canonical, int64_t number, double time, const double *q,
                             double *v) {
  struct altitude altitude;
  if (!find_altitude(canonical, number, q, &altitude)) return;
  const double stiffness = canonical->altitude[0][number], l = altitude.l;
  const double elastic = altitude.h <= l ? 0.0 : stiffness * (altitude.h - l) / l;
  damp_element(canonical, 4, canonical->corners + 4 * number, altitude.g, altitude.u,
               canonical->altitude[1][number] / l, canonical->altitude_pull_only[number] ? &elastic : NULL,
               time, v);
}

static void damp_anchor(const struct canonical *canonical, int64_t k, double time, const double *q,
                        double *v) {
  const double one = 1.0, *x = q + 3 * canonical->anchored[k], *point = canonical->anchor_point + 3 * k;
  const double d[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
  const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]), ir = r > 0.0 ? 1.0 / r : 0.0;
  const double u[3] = {d[0] * ir, d[1] * ir, d[2] * ir};
  damp_element(canonical, 1, canonical->anchored + k, &one, u, canonical->anchor[1][k], NULL, time, v);
}

/* Of the velocity beside the wind. */
static void damp_in_wind(const struct canonical *canonical, int64_t p, double time, double *v) {
  const double w = canonical->inverse_mass[p];
  for (int a = 0; a < 3 && w > 0.0; a++)
    v[3 * p + a] -=
        w * (damper_share(time, canonical->drags[p], w) * (v[3 * p + a] - canonical_wind(canonical, a)));
}

/* Springs in their order, tetrahedra and anchors by number, then drag; or all of it backwards. */
static void damp(const struct canonical *canonical, double at, double time, int backwards, int64_t springs,
                 const int64_t *order, const double *q, double *v) {
  const int64_t t = canonical->tetrahedron_count, n = canonical->anchor_count;
  for (int part = 0; part < 5; part++) {
    const int what = backwards ? 4 - part : part;
    for (int64_t k = 0; what == 0 && k < springs; k++)
      damp_spring(canonical, order[backwards ? springs - 1 - k : k], at, time, q, v);
    for (int64_t k = 0; what == 1 && k < t; k++)
      damp_tetrahedron(canonical, backwards ? t - 1 - k : k, time, q, v);
    for (int64_t k = 0; what == 2 && k < n; k++)
      damp_anchor(canonical, backwards ? n - 1 - k : k, time, q, v);
    for (int64_t k = 0; what == 3 && canonical->drags && k < canonical->particle_count; k++)
      damp_in_wind(canonical, k, time, v);
    for (int64_t k = 0; what == 4 && canonical->drag != 0.0 && k < 3 * canonical->particle_count; k++) {
      const double z = time * canonical->drag * canonical->inverse_mass[k / 3];
      v[k] /= 1.0 + z * (1.0 + z / 2.0);
    }
  }
}

/* A step of Verlet without damping between two sweeps over the dampers. */
static void shardlow(const struct canonical *canonical, double t, double end, double h, double *q, double *v,
                     double *a) {
  const int64_t m = canonical->spring_count, t_count = canonical->tetrahedron_count,
                n = canonical->anchor_count;
  struct canonical undamped = *canonical;
  undamped.drag = 0.0;
  undamped.drags = NULL;
  undamped.leaves_out = 1;
  undamped.gamma = new_doubles(m);
  undamped.altitude[1] = new_doubles(t_count);
  undamped.anchor[1] = new_doubles(n);
  int64_t springs, *order = damper_order(canonical, &springs);
  damp(canonical, t, h / 2.0, 0, springs, order, q, v);
  verlet(&undamped, t, end, h, q, v, a);
  damp(canonical, end, h / 2.0, 1, springs, order, q, v);
  free(order);
  free(undamped.gamma);
  free(undamped.altitude[1]);
  free(undamped.anchor[1]);
}

static void rk4(const struct canonical *canonical, double t, double end, double h, double *q, double *v,
                double *a) {
  const int64_t size = 3 * canonical->particle_count;
  const double time[4] = {t, t + h / 2.0, t + h / 2.0, end}, ahead[4] = {0.0, h / 2.0, h / 2.0, h};
  double *speed[4], *rate[4];
  double *stage_q = new_doubles(size), *stage_v = new_doubles(size);
  memcpy(stage_q, q, (size_t)size * sizeof(double));
  memcpy(stage_v, v, (size_t)size * sizeof(double));
  for (int s = 0; s < 4; s++) {
    speed[s] = new_doubles(size);
    rate[s] = new_doubles(size);
    for (int64_t k = 0; k < size && s > 0; k++) {
      if (!canonical_is_free(canonical, k)) continue;
      stage_q[k] = q[k] + ahead[s] * speed[s - 1][k];
      stage_v[k] = v[k] + ahead[s] * rate[s - 1][k];
    }
    if (s > 0) canonical_place(canonical, time[s], stage_q, stage_v);
    memcpy(speed[s], stage_v, (size_t)size * sizeof(double));
    canonical_acceleration(canonical, time[s], stage_q, stage_v, a);
    memcpy(rate[s], a, (size_t)size * sizeof(double));
  }
  for (int64_t k = 0; k < size; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    q[k] += h / 6.0 * (((speed[0][k] + 2.0 * speed[1][k]) + 2.0 * speed[2][k]) + speed[3][k]);
    v[k] += h / 6.0 * (((rate[0][k] + 2.0 * rate[1][k]) + 2.0 * rate[2][k]) + rate[3][k]);
  }
  for (int s = 0; s < 4; s++) {
    free(speed[s]);
    free(rate[s]);
  }
  free(stage_q);
  free(stage_v);
}

static void heun(const struct canonical *canonical, double t, double end, double h, double *q, double *v,
                 double *a) {
  const int64_t size = 3 * canonical->particle_count;
  double *next_q = new_doubles(size), *next_v = new_doubles(size), *next_a = new_doubles(size);
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < size; k++) {
    next_q[k] = canonical_is_free(canonical, k) ? q[k] + h * v[k] : q[k];
    next_v[k] = canonical_is_free(canonical, k) ? v[k] + h * a[k] : v[k];
  }
  canonical_place(canonical, end, next_q, next_v);
  canonical_acceleration(canonical, end, next_q, next_v, next_a);
  for (int64_t k = 0; k < size; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    q[k] += h / 2.0 * (v[k] + next_v[k]);
    v[k] += h / 2.0 * (a[k] + next_a[k]);
  }
  free(next_q);
  free(next_v);
  free(next_a);
}

/* What an element between `count` particles, with these weights, adds at each of them that is free: its
 * strength times the row of its matrix, wherever it points. */
static void add_row(const struct canonical *canonical, int count, const int64_t *particle,
                    const double *weight, double strength, double *sum) {
  double all = 0.0;
  for (int j = 0; j < count; j++)
    all += canonical->inverse_mass[particle[j]] != 0.0 ? weight[j] : 0.0;
  for (int j = 0; j < count; j++)
    sum[particle[j]] += weight[j] * all * strength;
}

static void add_rows(const struct canonical *canonical, double *stiffness, double *damping) {
  const double pair[2] = {1.0, 1.0}, triple[3] = {1.0, 2.0, 1.0};
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    const struct numbers most = scaled(canonical, k, stiffnesses[0], rests[0]);
    add_row(canonical, 2, canonical->ends + 2 * k, pair, most.kappa, stiffness);
    add_row(canonical, 2, canonical->ends + 2 * k, pair, most.gamma, damping);
  }
  for (int64_t k = 0; k < canonical->triple_count; k++)
    add_row(canonical, 3, canonical->triples + 3 * k, triple, canonical->coefficient[k], stiffness);
  for (int64_t k = 0; k < canonical->anchor_count; k++) {
    add_row(canonical, 1, canonical->anchored + k, pair, canonical->anchor[0][k], stiffness);
    add_row(canonical, 1, canonical->anchored + k, pair, canonical->anchor[1][k], damping);
  }
  for (int64_t p = 0; canonical->drags && p < canonical->particle_count; p++)
    add_row(canonical, 1, &p, pair, canonical->drags[p], damping);
}

double canonical_explicit_bound(const struct canonical *canonical) {
  const int64_t n = canonical->particle_count;
  double *stiffness = new_doubles(n), *damping = new_doubles(n), bound = INFINITY;
  add_rows(canonical, stiffness, damping);
  for (int64_t p = 0; p < n; p++) {
    const double k = canonical->inverse_mass[p] * stiffness[p], c = canonical->inverse_mass[p] * damping[p];
    if (k > 0.0 || c > 0.0) bound = fmin(bound, 4.0 / (c + sqrt(c * c + 4.0 * k)));
  }
  free(stiffness);
  free(damping);
  return bound;
}

/* Whether Verlet solves for the damping: of springs that only pull, beside altitude springs, and where the
 * step is above 0.8 of the bound. */
static int is_solved(const struct canonical *canonical, double h) {
  int damped = canonical->drags != NULL, pulls = 0;
  if (canonical->quadratic || canonical->piece_count > 0) return 0; /* not linear, and predicted always */
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    damped |= canonical->gamma[k] != 0.0;
    pulls |= canonical->gamma[k] != 0.0 && canonical->pull_only[k];
  }
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++)
    damped |= canonical->altitude[1][k] != 0.0;
  for (int64_t k = 0; k < canonical->anchor_count; k++)
    damped |= canonical->anchor[1][k] != 0.0;
  if (!damped || pulls || canonical->tetrahedron_count > 0) return damped;
  return !(h <= 0.8 * canonical_explicit_bound(canonical));
}

static const char *const solved[] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};

int32_t canonical_step(const struct canonical *canonical, const char *method, double t, double end, double h,
                       double *q, double *v) {
  for (size_t k = 0; k < sizeof solved / sizeof solved[0]; k++) {
    if (strcmp(method, solved[k]) == 0) return CANONICAL_SOLVED;
  }
  if (strcmp(method, "verlet") == 0 && is_solved(canonical, h)) return CANONICAL_SOLVED;
  int32_t result = CANONICAL_STEPPED;
  double *a = new_doubles(3 * canonical->particle_count);
  if (strcmp(method, "forward-euler") == 0)
    forward_euler(canonical, t, h, q, v, a);
  else if (strcmp(method, "symplectic-euler") == 0)
    symplectic_euler(canonical, t, h, q, v, a);
  else if (strcmp(method, "verlet") == 0)
    verlet(canonical, t, end, h, q, v, a);
  else if (strcmp(method, "shardlow") == 0)
    shardlow(canonical, t, end, h, q, v, a);
  else if (strcmp(method, "heun") == 0)
    heun(canonical, t, end, h, q, v, a);
  else if (strcmp(method, "rk4") == 0)
    rk4(canonical, t, end, h, q, v, a);
  else
    result = CANONICAL_UNKNOWN;
  if (result == CANONICAL_STEPPED) canonical_place(canonical, end, q, v);
  free(a);
  return result;
}
