#include "long_force.h"

#include "check.h"

#include <math.h>
#include <string.h>

typedef long double real;

static real dot(const real a[3], const real b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const real a[3], const real b[3], real n[3]) {
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
}

static void subtract(const real *a, const real *b, real d[3]) {
  for (int k = 0; k < 3; k++)
    d[k] = a[k] - b[k];
}

/* ---- forces ---- */

static void add_springs(const struct canonical *canonical, const real *q, const real *v, real *force) {
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    const int64_t i = 3 * canonical->ends[2 * k], j = 3 * canonical->ends[2 * k + 1];
    const real l0 = canonical->rest_length[k], gamma = canonical->gamma[k];
    real d[3], u[3];
    subtract(q + i, q + j, d);
    const real r = sqrtl(dot(d, d));
    if (r == 0.0L) continue;
    real tension = (real)canonical->kappa[k] * (r - l0);
    if (gamma != 0.0L) {
      subtract(v + i, v + j, u);
      tension += gamma * dot(u, d) / r;
    }
    if (canonical->pull_only[k] && (r <= l0 || tension < 0.0L)) continue;
    const real s = tension / r;
    for (int a = 0; a < 3; a++) {
      force[i + a] -= s * d[a];
      force[j + a] += s * d[a];
    }
  }
}

static void add_triples(const struct canonical *canonical, const real *q, real *force) {
  for (int64_t k = 0; k < canonical->triple_count; k++) {
    const int64_t *p = canonical->triples + 3 * k;
    for (int a = 0; a < 3; a++) {
      const real bend = q[3 * p[0] + a] - 2.0L * q[3 * p[1] + a] + q[3 * p[2] + a];
      const real f = (real)canonical->coefficient[k] * bend;
      force[3 * p[0] + a] -= f;
      force[3 * p[1] + a] += 2.0L * f;
      force[3 * p[2] + a] -= f;
    }
  }
}

/* An altitude from a corner to a face, or from an edge to an edge: the corners, and the weights that it
 * follows them with. */
struct altitude {
  int64_t corner[4];
  real along[3], height, weight[4], square;
};

/* From corner k to the face of the others for k < 4, otherwise from an edge to the opposite one. */
static void find_altitude(const int64_t *p, int k, const real *q, struct altitude *altitude) {
  static const int order[7][4] = {{1, 3, 2, 0}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 2, 3},
                                  {0, 1, 3, 2}, {0, 2, 1, 3}, {0, 3, 2, 1}};
  const real *x[4];
  real e[3], f[3], r[3], n[3], side[3];
  for (int c = 0; c < 4; c++) {
    altitude->corner[c] = p[order[k][c]];
    x[c] = q + 3 * altitude->corner[c];
  }
  subtract(x[1], x[0], e);
  subtract(k < 4 ? x[2] : x[3], k < 4 ? x[0] : x[2], f);
  subtract(k < 4 ? x[3] : x[2], x[0], r);
  cross(e, f, n);
  const real square = altitude->square = dot(n, n);
  if (square == 0.0L) return;
  for (int a = 0; a < 3; a++)
    altitude->along[a] = n[a] / sqrtl(square);
  altitude->height = dot(altitude->along, r);
  cross(r, f, side);
  const real a = dot(side, n) / square;
  cross(r, e, side);
  const real b = dot(side, n) / square;
  const real face[4] = {a - b - 1.0L, -a, b, 1.0L}, edge[4] = {a - 1.0L, -a, 1.0L - b, b};
  memcpy(altitude->weight, k < 4 ? face : edge, sizeof face);
}

static void add_tetrahedra(const struct canonical *canonical, const real *q, const real *v, real *force) {
  for (int64_t t = 0; t < canonical->tetrahedron_count; t++) {
    struct altitude shortest = {.square = 0.0L}, other;
    int which = 0;
    for (int k = 0; k < 7; k++) {
      find_altitude(canonical->corners + 4 * t, k, q, &other);
      if (!(other.square > shortest.square)) continue;
      shortest = other;
      which = k;
    }
    if (shortest.square == 0.0L) continue;
    const real rest = canonical->altitude[2][7 * t + which], length = fabsl(rest);
    if (rest < 0.0L) { /* measured in the other direction in an inverted tetrahedron */
      shortest.height = -shortest.height;
      for (int a = 0; a < 3; a++)
        shortest.along[a] = -shortest.along[a];
    }
    real rate = 0.0L;
    for (int c = 0; c < 4; c++)
      rate += shortest.weight[c] * dot(shortest.along, v + 3 * shortest.corner[c]);
    const real tension = ((real)canonical->altitude[0][t] * (shortest.height - length) +
                          (real)canonical->altitude[1][t] * rate) /
                         length;
    if (canonical->altitude_pull_only[t] && (shortest.height <= length || tension < 0.0L)) continue;
    for (int c = 0; c < 4; c++) {
      for (int a = 0; a < 3; a++)
        force[3 * shortest.corner[c] + a] -= tension * shortest.weight[c] * shortest.along[a];
    }
  }
}

/* As a spring whose second end is a point at rest. */
static void add_anchors(const struct canonical *canonical, const real *q, const real *v, real *force) {
  for (int64_t k = 0; k < canonical->anchor_count; k++) {
    const int64_t i = 3 * canonical->anchored[k];
    const double *point = canonical->anchor_point + 3 * k;
    const real d[3] = {q[i] - point[0], q[i + 1] - point[1], q[i + 2] - point[2]}, r = sqrtl(dot(d, d));
    if (r == 0.0L) continue;
    const real stretch = r - canonical->anchor[2][k];
    const real tension = canonical->anchor[0][k] * stretch + canonical->anchor[1][k] * dot(v + i, d) / r;
    for (int a = 0; a < 3; a++)
      force[i + a] -= tension / r * d[a];
  }
}

/* ---- bodies ---- */

/* The solution of a x = b with a symmetric 3x3 matrix, of its rows. */
static void solve(real a[3][3], const real b[3], real x[3]) {
  real side[3][3];
  for (int k = 0; k < 3; k++)
    cross(a[(k + 1) % 3], a[(k + 2) % 3], side[k]);
  const real determinant = dot(a[0], side[0]);
  for (int k = 0; k < 3; k++)
    x[k] = (side[0][k] * b[0] + side[1][k] * b[1] + side[2][k] * b[2]) / determinant;
}

static real mass_of(const struct long_force *force, int64_t particle) {
  const real w = force->canonical->inverse_mass[particle];
  return w != 0.0L ? 1.0L / w : 0.0L;
}

/* The point about which a body turns, its centre of mass or its pinned particle, and the velocity and the
 * acceleration of that point; `a` has the accelerations that the particles would have by themselves. */
static void find_point(const struct long_force *force, const struct long_body *body, const real *y,
                       const real *a, real point[3][3]) {
  const int64_t size = 3 * force->canonical->particle_count;
  const real *of[3] = {y, y + size, a};
  real mass = 0.0L;
  memset(point, 0, 9 * sizeof(real));
  for (int64_t k = 0; k < body->count; k++) {
    const real m = body->pivot < 0 ? mass_of(force, body->particle[k]) : body->particle[k] == body->pivot;
    mass += m;
    for (int n = 0; n < 9; n++)
      point[n / 3][n % 3] += m * of[n / 3][3 * body->particle[k] + n % 3];
  }
  for (int n = 0; n < 9; n++)
    point[n / 3][n % 3] /= mass;
}

/* Angular momentum, torque and inertia about that point. */
struct turning {
  real momentum[3], torque[3], inertia[3][3];
};

static void find_turning(const struct long_force *force, const struct long_body *body, const real *y,
                         const real *a, real point[3][3], struct turning *turning) {
  const real *v = y + 3 * force->canonical->particle_count;
  memset(turning, 0, sizeof *turning);
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t at = 3 * body->particle[k];
    const real m = mass_of(force, body->particle[k]);
    real r[3], u[3], moment[3], torque[3];
    subtract(y + at, point[0], r);
    subtract(v + at, point[1], u);
    cross(r, u, moment);
    cross(r, a + at, torque);
    for (int i = 0; i < 3; i++) {
      turning->momentum[i] += m * moment[i];
      turning->torque[i] += m * torque[i];
      for (int j = 0; j < 3; j++)
        turning->inertia[i][j] += m * ((i == j ? dot(r, r) : 0.0L) - r[i] * r[j]);
    }
  }
}

/* Replaces the accelerations of its particles by those of a rigid motion, which keeps their distances. */
static void stiffen(const struct long_force *force, const struct long_body *body, const real *y, real *a) {
  struct turning turning;
  real point[3][3], omega[3], alpha[3], spin[3], gyration[3];
  find_point(force, body, y, a, point);
  find_turning(force, body, y, a, point, &turning);
  solve(turning.inertia, turning.momentum, omega);
  cross(omega, turning.momentum, gyration);
  subtract(turning.torque, gyration, spin);
  solve(turning.inertia, spin, alpha);
  for (int64_t k = 0; k < body->count; k++) {
    real r[3], u[3], along[3], inward[3];
    subtract(y + 3 * body->particle[k], point[0], r);
    cross(alpha, r, along);
    cross(omega, r, u);
    cross(omega, u, inward);
    for (int i = 0; i < 3; i++)
      a[3 * body->particle[k] + i] = point[2][i] + along[i] + inward[i];
  }
}

/* ---- motions ---- */

static void move_harmonic(const struct long_drive *drive, real t, real d[3], real u[3]) {
  const real omega = 2.0L * acosl(-1.0L) * (real)drive->frequency, angle = omega * t + (real)drive->phase;
  for (int a = 0; a < 3; a++) {
    d[a] = (real)drive->amplitude[a] * sinl(angle);
    u[a] = (real)drive->amplitude[a] * omega * cosl(angle);
  }
}

/* Slope at sample k of the parabola through it and its neighbours, at the ends through the nearest three. */
static real slope(const struct long_drive *drive, int64_t k, int a) {
  const int64_t last = drive->samples - 1;
  const double *x = drive->displacement + a;
  if (last == 1) return ((real)x[3] - x[0]) / ((real)drive->time[1] - drive->time[0]);
  const int64_t m = k == 0 ? 1 : k == last ? last - 1 : k;
  const real t0 = drive->time[m - 1], t1 = drive->time[m], t2 = drive->time[m + 1], t = drive->time[k];
  const real first = ((real)x[3 * m] - x[3 * m - 3]) / (t1 - t0),
             second = (((real)x[3 * m + 3] - x[3 * m]) / (t2 - t1) - first) / (t2 - t0);
  return first + second * ((t - t0) + (t - t1));
}

static void move_by_table(const struct long_drive *drive, real t, real d[3], real u[3]) {
  const int64_t last = drive->samples - 1;
  int64_t k = 0;
  const int rests = t <= (real)drive->time[0] || t >= (real)drive->time[last];
  while (k + 1 < last && t >= (real)drive->time[k + 1])
    k++;
  const real h = (real)drive->time[k + 1] - drive->time[k], z = (t - drive->time[k]) / h;
  for (int a = 0; a < 3; a++) {
    const double *x = drive->displacement + 3 * k + a;
    const real m0 = slope(drive, k, a), m1 = slope(drive, k + 1, a), chord = ((real)x[3] - x[0]) / h;
    const real c2 = 3.0L * chord - 2.0L * m0 - m1, c3 = m0 + m1 - 2.0L * chord;
    d[a] = x[0] + h * z * (m0 + z * (c2 + z * c3));
    u[a] = m0 + z * (2.0L * c2 + 3.0L * z * c3);
    if (!rests) continue;
    d[a] = drive->displacement[(t <= (real)drive->time[0] ? 0 : 3 * last) + a];
    u[a] = 0.0L;
  }
}

void long_drive_move(const struct long_drive *drive, long double t, long double d[3], long double u[3]) {
  (drive->samples > 0 ? move_by_table : move_harmonic)(drive, t, d, u);
}

static void place(const struct long_force *force, real t, real *q, real *v) {
  for (int64_t k = 0; k < force->drive_count; k++) {
    const struct long_drive *drive = &force->drive[k];
    const int64_t at = 3 * drive->particle;
    real d[3];
    long_drive_move(drive, t, d, v + at);
    for (int a = 0; a < 3; a++)
      q[at + a] = force->origin[at + a] + d[a];
  }
}

/* ---- whole ---- */

/* From the forces: accelerations, or the velocities of an overdamped system, whose w is 1/gamma. */
static void accelerate(const struct long_force *force, const real *v, real *a) {
  const struct canonical *canonical = force->canonical;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    const real w = canonical->inverse_mass[k / 3],
               m = force->mass != NULL ? w * (real)force->mass[k / 3] : 1.0L;
    const real g = canonical->gravity != NULL ? m * (real)canonical->gravity[k % 3] : 0.0L;
    const real drag = force->mass != NULL ? 0.0L : (real)canonical->drag;
    a[k] = w != 0.0L ? w * (a[k] - drag * v[k]) + g : 0.0L;
  }
}

void long_force_rate(long double t, long double *y, long double *f, void *ctx) {
  const struct long_force *force = ctx;
  const struct canonical *canonical = force->canonical;
  const int64_t size = 3 * canonical->particle_count;
  real *q = y, *v = y + size, *a = f + size;
  assert_null(canonical->force);
  place(force, t, q, v);
  memset(a, 0, (size_t)size * sizeof *a);
  add_springs(canonical, q, v, a);
  add_triples(canonical, q, a);
  add_tetrahedra(canonical, q, v, a);
  add_anchors(canonical, q, v, a);
  accelerate(force, v, a);
  for (int64_t b = 0; b < force->body_count; b++)
    stiffen(force, &force->body[b], y, a);
  for (int64_t k = 0; k < size; k++) {
    const real moves = canonical->inverse_mass[k / 3] != 0.0;
    f[k] = moves * (force->mass != NULL ? a[k] : v[k]);
    if (force->mass != NULL) a[k] = 0.0L;
  }
}

/* Constrained particles have no error; the scale of velocities is the largest one, including its growth. */
void long_force_scale(const long double *y, const long double *f, long double *scale, void *ctx) {
  const struct long_force *force = ctx;
  const int64_t size = 3 * force->canonical->particle_count;
  real speed = 0.0L, push = 0.0L;
  for (int64_t k = 0; k < size; k++) {
    speed = fmaxl(speed, fabsl(y[size + k]));
    push = fmaxl(push, fabsl(f[size + k]));
  }
  speed = fmaxl(speed, sqrtl(push * (real)force->extent));
  for (int64_t k = 0; k < size; k++) {
    const int held = force->canonical->inverse_mass[k / 3] == 0.0;
    scale[k] = held ? INFINITY : (real)force->extent;
    scale[size + k] = held ? INFINITY : fmaxl(speed, 1e-300L);
  }
}

double long_force_extent(int64_t particles, const double *q) {
  double extent = 0.0;
  for (int a = 0; a < 3; a++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t p = 0; p < particles; p++) {
      low = fmin(low, q[3 * p + a]);
      high = fmax(high, q[3 * p + a]);
    }
    extent = fmax(extent, 0.5 * (high - low));
  }
  return extent > 0.0 ? extent : 1.0;
}
