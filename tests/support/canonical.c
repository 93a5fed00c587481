/* Compile without contraction of products and sums (-ffp-contract=off), like the library. */
#include "canonical.h"

#include "check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void canonical_create(const hooke_system *system, struct canonical *canonical) {
  const int64_t n = hooke_system_particle_count(system), m = hooke_system_spring_count(system);
  memset(canonical, 0, sizeof *canonical);
  canonical->particle_count = n;
  canonical->spring_count = m;
  canonical->ends = new_block(2 * m, (int64_t)sizeof(int64_t));
  canonical->kappa = new_doubles(m);
  canonical->gamma = new_doubles(m);
  canonical->rest_length = new_doubles(m);
  canonical->pull_only = new_block(m, 1);
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
  int64_t spring = 0;
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    const int64_t size = hooke_system_group_size(system, "springs", g);
    const int pulls = strncmp(hooke_system_group_name(system, "springs", g), "pull", 4) == 0;
    assert_true(spring + size <= m);
    memset(canonical->pull_only + spring, pulls, (size_t)size);
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
  free(canonical->triples);
  free(canonical->coefficient);
  free(canonical->corners);
  for (int k = 0; k < 3; k++)
    free(canonical->altitude[k]);
  free(canonical->altitude_pull_only);
  free(canonical->anchored);
  free(canonical->anchor_point);
  for (int k = 0; k < 3; k++)
    free(canonical->anchor[k]);
  free(canonical->inverse_mass);
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

static void add_spring(const struct canonical *canonical, int64_t k, const double *q, const double *v,
                       const double *seen, double *force) {
  const int64_t i = canonical->ends[2 * k], j = canonical->ends[2 * k + 1];
  const double kappa = canonical->kappa[k], gamma = canonical->gamma[k], l0 = canonical->rest_length[k];
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

static double dot(const double a[3], const double b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double n[3]) {
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
}

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
    cross(e, f, n);
    square[k] = dot(n, n);
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
  return dot(u, w);
}

static void add_tetrahedron(const struct canonical *canonical, int64_t number, const double *q,
                            const double *v, const double *seen, double *force) {
  const int64_t *p = canonical->corners + 4 * number;
  const double *const x[4] = {q + 3 * p[0], q + 3 * p[1], q + 3 * p[2], q + 3 * p[3]};
  double square[7], e[3], f[3], r[3], n[3], rf[3], re[3], u[3], g[4];
  canonical_altitudes(x, square);
  int k = -1; /* an overflowed altitude does not count */
  for (int other = 0; other < 7; other++) {
    if (square[other] > (k < 0 ? 0.0 : square[k])) k = other;
  }
  if (k < 0) return;
  altitude_vectors(x, k, e, f, r);
  cross(e, f, n);
  cross(r, f, rf);
  cross(r, e, re);
  const double rest = canonical->altitude[2][7 * number + k], side = rest < 0.0 ? -1.0 : 1.0;
  const double l = fabs(rest), c = side * (1.0 / sqrt(square[k]));
  for (int a = 0; a < 3; a++)
    u[a] = c * n[a];
  const double h = dot(u, r), a = dot(rf, n) / square[k], b = dot(re, n) / square[k];
  g[role[k][0]] = k < 4 ? (a - b) - 1.0 : a - 1.0;
  g[role[k][1]] = -a;
  g[role[k][2]] = k < 4 ? b : 1.0 - b;
  g[role[k][3]] = k < 4 ? 1.0 : b;
  double tension = altitude_tension(canonical, number, h, l, altitude_rate(p, g, u, v));
  const double tension_seen = altitude_tension(canonical, number, h, l, altitude_rate(p, g, u, seen));
  if (canonical->altitude_pull_only[number] && (h <= l || tension_seen < 0.0)) tension = 0.0;
  for (int j = 0; j < 4; j++) {
    const double s = tension * g[j];
    for (int axis = 0; axis < 3; axis++)
      force[3 * p[j] + axis] -= s * u[axis];
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
static void accelerate(const struct canonical *canonical, double t, const double *q, const double *v,
                       const double *seen, double *acceleration) {
  const int64_t n = canonical->particle_count;
  const double *w = canonical->inverse_mass;
  double *force = acceleration;
  memset(force, 0, (size_t)(3 * n) * sizeof(double));
  for (int64_t k = 0; k < canonical->spring_count; k++)
    add_spring(canonical, k, q, v, seen, force);
  for (int64_t k = 0; k < canonical->triple_count; k++)
    add_triple(canonical, k, q, force);
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++)
    add_tetrahedron(canonical, k, q, v, seen, force);
  for (int64_t k = 0; k < canonical->anchor_count; k++)
    add_anchor(canonical, k, q, v, force);
  if (canonical->drag != 0.0) {
    for (int64_t p = 0; p < n; p++) {
      for (int a = 0; a < 3 && w[p] != 0.0; a++)
        force[3 * p + a] -= canonical->drag * v[3 * p + a];
    }
  }
  if (canonical->force != NULL) assert_int_equal(canonical->force(n, t, q, seen, force, canonical->ctx), 0);
  for (int64_t p = 0; p < n; p++) {
    for (int a = 0; a < 3; a++) {
      double *f = &force[3 * p + a];
      *f = w[p] * *f;
      if (canonical->gravity != NULL) *f += canonical->gravity[a];
      if (w[p] == 0.0) *f = 0.0;
    }
  }
}

void canonical_acceleration(const struct canonical *canonical, double t, const double *q, const double *v,
                            double *acceleration) {
  accelerate(canonical, t, q, v, v, acceleration);
}

/* ---- steps ---- */

static void place(const struct canonical *canonical, double t, double *q, double *v) {
  if (canonical->place != NULL) canonical->place(t, q, v, canonical->place_ctx);
}

static int is_free(const struct canonical *canonical, int64_t k) {
  return canonical->inverse_mass[k / 3] != 0.0;
}

static void forward_euler(const struct canonical *canonical, double t, double h, double *q, double *v,
                          double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!is_free(canonical, k)) continue;
    q[k] += h * v[k];
    v[k] += h * a[k];
  }
}

static void symplectic_euler(const struct canonical *canonical, double t, double h, double *q, double *v,
                             double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!is_free(canonical, k)) continue;
    v[k] += h * a[k];
    q[k] += h * v[k];
  }
}

/* The first kick and the drift of a Verlet step: v is the velocity half-way. */
static void verlet_drift(const struct canonical *canonical, double t, double h, double *q, double *v,
                         double *a) {
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!is_free(canonical, k)) continue;
    v[k] += h / 2.0 * a[k];
    q[k] += h * v[k];
  }
}

/* Without spring damping, and with drag at the new velocity. */
static void verlet(const struct canonical *canonical, double t, double end, double h, double *q, double *v,
                   double *a) {
  struct canonical without_drag = *canonical;
  without_drag.drag = 0.0;
  verlet_drift(canonical, t, h, q, v, a);
  place(canonical, end, q, v);
  canonical_acceleration(&without_drag, end, q, v, a);
  const double brake = h / 2.0 * canonical->drag;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    if (!is_free(canonical, k)) continue;
    v[k] += h / 2.0 * a[k];
    if (canonical->drag != 0.0) v[k] /= 1.0 + brake * canonical->inverse_mass[k / 3];
  }
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
      if (!is_free(canonical, k)) continue;
      stage_q[k] = q[k] + ahead[s] * speed[s - 1][k];
      stage_v[k] = v[k] + ahead[s] * rate[s - 1][k];
    }
    if (s > 0) place(canonical, time[s], stage_q, stage_v);
    memcpy(speed[s], stage_v, (size_t)size * sizeof(double));
    canonical_acceleration(canonical, time[s], stage_q, stage_v, a);
    memcpy(rate[s], a, (size_t)size * sizeof(double));
  }
  for (int64_t k = 0; k < size; k++) {
    if (!is_free(canonical, k)) continue;
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
    next_q[k] = is_free(canonical, k) ? q[k] + h * v[k] : q[k];
    next_v[k] = is_free(canonical, k) ? v[k] + h * a[k] : v[k];
  }
  place(canonical, end, next_q, next_v);
  canonical_acceleration(canonical, end, next_q, next_v, next_a);
  for (int64_t k = 0; k < size; k++) {
    if (!is_free(canonical, k)) continue;
    q[k] += h / 2.0 * (v[k] + next_v[k]);
    v[k] += h / 2.0 * (a[k] + next_a[k]);
  }
  free(next_q);
  free(next_v);
  free(next_a);
}

static int is_damped(const struct canonical *canonical) {
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    if (canonical->gamma[k] != 0.0) return 1;
  }
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++) {
    if (canonical->altitude[1][k] != 0.0) return 1;
  }
  for (int64_t k = 0; k < canonical->anchor_count; k++) {
    if (canonical->anchor[1][k] != 0.0) return 1;
  }
  return 0;
}

int32_t canonical_step(const struct canonical *canonical, const char *method, double t, double end, double h,
                       double *q, double *v) {
  if (strcmp(method, "backward-euler") == 0) return CANONICAL_SOLVED;
  if (strcmp(method, "verlet") == 0 && is_damped(canonical)) return CANONICAL_SOLVED;
  int32_t result = CANONICAL_STEPPED;
  double *a = new_doubles(3 * canonical->particle_count);
  if (strcmp(method, "forward-euler") == 0)
    forward_euler(canonical, t, h, q, v, a);
  else if (strcmp(method, "symplectic-euler") == 0)
    symplectic_euler(canonical, t, h, q, v, a);
  else if (strcmp(method, "verlet") == 0)
    verlet(canonical, t, end, h, q, v, a);
  else if (strcmp(method, "heun") == 0)
    heun(canonical, t, end, h, q, v, a);
  else if (strcmp(method, "rk4") == 0)
    rk4(canonical, t, end, h, q, v, a);
  else
    result = CANONICAL_UNKNOWN;
  if (result == CANONICAL_STEPPED) place(canonical, end, q, v);
  free(a);
  return result;
}

/* Transverse stiffness of a spring: its tension over its length. Where two particles nearly meet it is far
 * larger than the stiffness along it. */
static double across(const struct canonical *canonical, int64_t k, const double *q, double speed) {
  const double *a = q + 3 * canonical->ends[2 * k], *b = q + 3 * canonical->ends[2 * k + 1];
  const double r = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
  const double tension =
      canonical->kappa[k] * fabs(r - canonical->rest_length[k]) + 2.0 * canonical->gamma[k] * speed;
  return r > 0.0 ? tension / r : 0.0;
}

/* Effect of 100 roundings of positions and velocities on the change of a velocity in one step. */
static double rounding(const struct canonical *canonical, double h, const double *q, const double *v) {
  double extent = 0.0, speed = 0.0, stiffness = 0.0, damping = canonical->drag;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    extent = fmax(extent, fabs(q[k]));
    speed = fmax(speed, fabs(v[k]));
  }
  double lightest = 0.0;
  for (int64_t p = 0; p < canonical->particle_count; p++)
    lightest = fmax(lightest, canonical->inverse_mass[p]);
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    stiffness = fmax(stiffness, canonical->kappa[k] + across(canonical, k, q, speed));
    damping = fmax(damping, canonical->gamma[k]);
  }
  for (int64_t k = 0; k < canonical->triple_count; k++)
    stiffness = fmax(stiffness, 4.0 * canonical->coefficient[k]);
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++) {
    for (int a = 0; a < 7; a++) {
      const double l = fabs(canonical->altitude[2][7 * k + a]);
      stiffness = fmax(stiffness, canonical->altitude[0][k] / l);
      damping = fmax(damping, canonical->altitude[1][k] / l);
    }
  }
  for (int64_t k = 0; k < canonical->anchor_count; k++) {
    const double *x = q + 3 * canonical->anchored[k], *point = canonical->anchor_point + 3 * k;
    const double r = hypot(hypot(x[0] - point[0], x[1] - point[1]), x[2] - point[2]);
    const double kappa = canonical->anchor[0][k], gamma = canonical->anchor[1][k];
    const double tension = kappa * fabs(r - canonical->anchor[2][k]) + 2.0 * gamma * speed;
    stiffness = fmax(stiffness, kappa + (r > 0.0 ? tension / r : 0.0));
    damping = fmax(damping, gamma);
  }
  return 100.0 * DBL_EPSILON * (speed + h * lightest * (stiffness * extent + damping * speed));
}

double canonical_defect(const struct canonical *canonical, const char *method, double t, double end, double h,
                        const double *q0, const double *v0, const double *q1, const double *v1) {
  const int64_t size = 3 * canonical->particle_count;
  const int kicks = strcmp(method, "verlet") == 0; /* otherwise backward Euler */
  double *q = new_doubles(size), *v = new_doubles(size), *a = new_doubles(size);
  memcpy(q, q0, (size_t)size * sizeof(double));
  memcpy(v, v0, (size_t)size * sizeof(double));
  double change = 0.0, defect = 0.0;
  if (kicks) {
    verlet_drift(canonical, t, h, q, v, a);
  } else {
    for (int64_t k = 0; k < size; k++) {
      if (is_free(canonical, k)) q[k] += h * v1[k];
    }
  }
  double *seen = new_doubles(size);
  memcpy(seen, kicks ? v : v1, (size_t)size * sizeof(double));
  place(canonical, end, q, seen);
  accelerate(canonical, end, q, v1, seen, a);
  for (int64_t k = 0; k < size; k++) {
    if (memcmp(&q[k], &q1[k], sizeof q[k]) != 0) defect = INFINITY;
    if (!is_free(canonical, k)) continue;
    const double wrong = v1[k] - (v[k] + (kicks ? h / 2.0 : h) * a[k]);
    if (!(fabs(wrong) <= defect)) defect = fabs(wrong);
    change = fmax(change, fmax(fabs(v1[k] - v0[k]), fabs(v1[k] - v[k])));
  }
  free(q);
  free(v);
  free(a);
  free(seen);
  return defect == 0.0 ? 0.0 : defect / (1e-9 * change + rounding(canonical, h, q1, v1));
}
