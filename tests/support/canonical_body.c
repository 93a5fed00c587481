/* Compile without contraction of products and sums (-ffp-contract=off), like the library. */
#include "canonical_body.h"

#include "canonical_step.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A body's own coordinates: its point, the quaternion from its axes to those of space, the velocity of the
 * point, and the angular momentum about it. */
struct own {
  double x[3], turn[4], v[3], l[3];
};

/* ---- vectors ---- */

static double dot(const double *a, const double *b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out) {
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = a[i] * b[j] - a[j] * b[i];
  }
}

/* The columns of m are the body's axes. A quaternion of length 1 is first made one of length 1.3. */
static void matrix_of(const double *turn, double m[3][3]) {
  double p[4][4];
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      p[i][j] = (1.3 * turn[i]) * (1.3 * turn[j]);
  const double all = ((p[0][0] + p[1][1]) + p[2][2]) + p[3][3];
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double others = j < k ? p[1 + j][1 + j] + p[1 + k][1 + k] : p[1 + k][1 + k] + p[1 + j][1 + j];
    m[i][i] = ((p[0][0] + p[1 + i][1 + i]) - others) / all;
    m[i][j] = 2.0 * (p[1 + i][1 + j] - p[0][1 + k]) / all;
    m[j][i] = 2.0 * (p[1 + i][1 + j] + p[0][1 + k]) / all;
  }
}

static void to_space(double m[3][3], const double *in, double *out) {
  for (int i = 0; i < 3; i++)
    out[i] = dot(m[i], in);
}

static void to_body(double m[3][3], const double *in, double *out) {
  for (int k = 0; k < 3; k++) {
    const double axis[3] = {m[0][k], m[1][k], m[2][k]};
    out[k] = dot(axis, in);
  }
}

static void normalise(double *turn) {
  const double length =
      sqrt(((turn[0] * turn[0] + turn[1] * turn[1]) + turn[2] * turn[2]) + turn[3] * turn[3]);
  for (int k = 0; k < 4; k++)
    turn[k] /= length;
}

/* turn = a turn b, of which one is 1. */
static void multiply(const double *a, const double *b, double *out) {
  const double product[4] = {((a[0] * b[0] - a[1] * b[1]) - a[2] * b[2]) - a[3] * b[3],
                             ((a[0] * b[1] + a[1] * b[0]) + a[2] * b[3]) - a[3] * b[2],
                             ((a[0] * b[2] - a[1] * b[3]) + a[2] * b[0]) + a[3] * b[1],
                             ((a[0] * b[3] + a[1] * b[2]) - a[2] * b[1]) + a[3] * b[0]};
  memcpy(out, product, sizeof product);
}

/* ---- from rows to a body's own coordinates ---- */

/* e1 along d1, e2 across it towards d2 or, of points in a line, towards the axis of space farthest from
 * it. */
static void directions(int32_t rank, double d[3][3], double e[3][3]) {
  double other[3] = {0.0, 0.0, 0.0};
  memset(e, 0, 9 * sizeof(double));
  for (int a = 0; a < 3 && rank == 0; a++)
    e[a][a] = 1.0;
  if (rank == 0) return;
  const double along = 1.0 / sqrt(dot(d[1], d[1]));
  for (int a = 0; a < 3; a++)
    e[0][a] = along * d[1][a];
  int farthest = 0;
  for (int a = 1; a < 3; a++)
    if (fabs(e[0][a]) < fabs(e[0][farthest])) farthest = a;
  if (rank == 1)
    other[farthest] = 1.0;
  else
    memcpy(other, d[2], sizeof other);
  const double component = -dot(other, e[0]);
  for (int a = 0; a < 3; a++)
    other[a] += component * e[0][a];
  const double across = 1.0 / sqrt(dot(other, other));
  for (int a = 0; a < 3; a++)
    e[1][a] = across * other[a];
  cross(e[0], e[1], e[2]);
}

/* The quaternion of a matrix, from its largest component. */
static void turn_of(double m[3][3], double *turn) {
  const double trace = (m[0][0] + m[1][1]) + m[2][2];
  int largest = -1;
  for (int k = 0; k < 3; k++)
    if (m[k][k] > (largest < 0 ? trace : m[largest][largest])) largest = k;
  if (largest < 0) {
    turn[0] = 1.0 + trace;
    for (int i = 0; i < 3; i++)
      turn[1 + i] = m[(i + 2) % 3][(i + 1) % 3] - m[(i + 1) % 3][(i + 2) % 3];
  } else {
    const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    turn[0] = m[k][j] - m[j][k];
    turn[1 + i] = ((1.0 + m[i][i]) - m[j][j]) - m[k][k];
    turn[1 + j] = m[j][i] + m[i][j];
    turn[1 + k] = m[k][i] + m[i][k];
  }
  normalise(turn);
}

/* w of b and c beside a. */
static void rotation_of(int32_t rank, double d[3][3], double w[3][3], double *rotation) {
  double n[3], across[3];
  memset(rotation, 0, 3 * sizeof(double));
  if (rank == 0) return;
  if (rank == 1) {
    cross(d[1], w[1], n);
    const double square = 1.0 / dot(d[1], d[1]);
    for (int a = 0; a < 3; a++)
      rotation[a] += square * n[a];
    return;
  }
  cross(d[1], d[2], n);
  cross(n, d[1], across);
  const double first = dot(w[2], n) / dot(n, n), second = -dot(w[1], n) / dot(n, n);
  const double third = dot(w[1], across) / dot(across, across);
  for (int a = 0; a < 3; a++)
    rotation[a] = (first * d[1][a] + second * d[2][a]) + third * n[a];
}

static void read(const struct canonical_body *body, const double *q, const double *v, struct own *own) {
  double d[3][3] = {{0.0}}, w[3][3] = {{0.0}}, e[3][3], m[3][3], rotation[3], turning[3], arm[3], swing[3];
  const int64_t a = 3 * body->particle[body->base[0]];
  for (int k = 1; k <= body->rank; k++) {
    for (int i = 0; i < 3; i++) {
      d[k][i] = q[3 * body->particle[body->base[k]] + i] - q[a + i];
      w[k][i] = v[3 * body->particle[body->base[k]] + i] - v[a + i];
    }
  }
  directions(body->rank, d, e);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      m[i][k] = (e[0][i] * body->triad[0][k] + e[1][i] * body->triad[1][k]) + e[2][i] * body->triad[2][k];
  turn_of(m, own->turn);
  matrix_of(own->turn, m);
  rotation_of(body->rank, d, w, rotation);
  to_body(m, rotation, turning);
  for (int k = 0; k < 3; k++)
    turning[k] *= body->inertia[k];
  to_space(m, turning, own->l);
  to_space(m, body->place + 3 * (int64_t)body->base[0], arm);
  cross(rotation, arm, swing);
  for (int i = 0; i < 3; i++) {
    own->x[i] = q[a + i] - arm[i];
    own->v[i] = v[a + i] - swing[i];
  }
}

/* ---- and back ---- */

static void rotation_by(const struct canonical_body *body, const struct own *own, double m[3][3],
                        double *rotation) {
  double turning[3];
  to_body(m, own->l, turning);
  for (int k = 0; k < 3; k++)
    turning[k] = body->inertia[k] > 0.0 ? turning[k] / body->inertia[k] : 0.0;
  to_space(m, turning, rotation);
}

static void write(const struct canonical *canonical, const struct canonical_body *body, struct own *own,
                  double *q, double *v) {
  double m[3][3], rotation[3], arm[3], swing[3];
  normalise(own->turn);
  matrix_of(own->turn, m);
  rotation_by(body, own, m, rotation);
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t p = body->particle[k];
    if (!(canonical->inverse_mass[p] > 0.0)) continue;
    to_space(m, body->place + 3 * k, arm);
    cross(rotation, arm, swing);
    for (int i = 0; i < 3; i++) {
      q[3 * p + i] = own->x[i] + arm[i];
      v[3 * p + i] = own->v[i] + swing[i];
    }
  }
}

/* ---- forces, kicks and free motion ---- */

/* Without the components about axes that the body does not turn about. */
static void keep_axes(const struct canonical_body *body, const double *turn, double *x) {
  double m[3][3], turning[3];
  int32_t all = 1;
  for (int k = 0; k < 3; k++)
    all &= body->inverse_inertia[k] > 0.0;
  if (all) return;
  matrix_of(turn, m);
  to_body(m, x, turning);
  for (int k = 0; k < 3; k++)
    if (!(body->inverse_inertia[k] > 0.0)) turning[k] = 0.0;
  to_space(m, turning, x);
}

/* Acceleration of the point and torque about it, over free particles in ascending number. */
static void find_push(const struct canonical *canonical, const struct canonical_body *body,
                      const struct own *own, const double *q, const double *f, double *acceleration,
                      double *torque) {
  double sum[3] = {0.0, 0.0, 0.0}, arm[3], turning[3], m[3][3];
  memset(torque, 0, 3 * sizeof(double));
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t p = body->particle[k];
    if (!(canonical->inverse_mass[p] > 0.0)) continue;
    for (int i = 0; i < 3; i++)
      arm[i] = q[3 * p + i] - own->x[i];
    cross(arm, f + 3 * p, turning);
    for (int i = 0; i < 3; i++) {
      sum[i] += f[3 * p + i];
      torque[i] += turning[i];
    }
  }
  for (int i = 0; i < 3; i++)
    acceleration[i] = body->inverse_mass * sum[i];
  for (int i = 0; i < 3 && canonical->gravity != NULL && body->inverse_mass > 0.0; i++)
    acceleration[i] += body->lift * canonical->gravity[i];
  if (canonical->gravity != NULL && (body->inverse_mass == 0.0 || canonical->factor != NULL)) {
    matrix_of(own->turn, m);
    to_space(m, body->centre, arm);
    cross(arm, canonical->gravity, turning);
    for (int i = 0; i < 3; i++)
      torque[i] += body->mass * turning[i];
  }
  keep_axes(body, own->turn, torque);
}

static void kick(const struct canonical_body *body, double h, const double *push, struct own *own) {
  for (int i = 0; i < 3; i++) {
    own->v[i] += h * push[i];
    own->l[i] += h * push[3 + i];
  }
  keep_axes(body, own->turn, own->l);
}

/* By the angle 2 atan(a) about axis k. */
static void turn_about(int k, double a, double *turn, double *momentum) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double scale = 1.0 / (1.0 + a * a), x = momentum[i], y = momentum[j];
  double by[4] = {1.0, 0.0, 0.0, 0.0};
  by[1 + k] = a;
  multiply(turn, by, turn);
  momentum[i] = (1.0 - a * a) * scale * x + 2.0 * a * scale * y;
  momentum[j] = (1.0 - a * a) * scale * y - 2.0 * a * scale * x;
}

/* A sphere of the middle moment about the momentum, after what the first and the last axis turn
 * differently. */
static void drift(const struct canonical_body *body, double h, struct own *own) {
  const double *inverse = body->inverse_inertia;
  const double first = inverse[0] > 0.0 ? inverse[0] - inverse[1] : 0.0;
  const double last = inverse[2] > 0.0 ? inverse[2] - inverse[1] : 0.0;
  double m[3][3], momentum[3], around[4] = {1.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 3; i++)
    own->x[i] += h * own->v[i];
  matrix_of(own->turn, m);
  to_body(m, own->l, momentum);
  turn_about(0, 0.25 * h * (first * momentum[0]), own->turn, momentum);
  turn_about(2, 0.5 * h * (last * momentum[2]), own->turn, momentum);
  turn_about(0, 0.25 * h * (first * momentum[0]), own->turn, momentum);
  for (int i = 0; i < 3; i++)
    around[1 + i] = 0.5 * h * inverse[1] * own->l[i];
  multiply(around, own->turn, own->turn);
  normalise(own->turn);
}

/* ---- steps ---- */

struct stepped {
  const struct canonical *canonical;
  int64_t count;
  const struct canonical_body *body;
  unsigned char *inside; /* by particle */
  struct own *own, *half;
  double *f, *push; /* 6 of each body: acceleration and torque */
};

static int is_loose(const struct stepped *s, int64_t k) {
  return !s->inside[k / 3] && s->canonical->inverse_mass[k / 3] > 0.0;
}

/* The sum of the forces alone: the canonical accelerations of particles of 1 kg without gravity. */
static void find_forces(const struct stepped *s, double t, const double *q, const double *v) {
  struct canonical unit = *s->canonical;
  unit.gravity = NULL;
  unit.inverse_mass = new_doubles(unit.particle_count);
  for (int64_t p = 0; p < unit.particle_count; p++)
    unit.inverse_mass[p] = s->canonical->inverse_mass[p] > 0.0;
  canonical_acceleration(&unit, t, q, v, s->f);
  free(unit.inverse_mass);
  for (int64_t b = 0; b < s->count; b++)
    find_push(s->canonical, &s->body[b], &s->own[b], q, s->f, s->push + 6 * b, s->push + 6 * b + 3);
}

static void kick_all(const struct stepped *s, double h, double *v, struct own *own) {
  const struct canonical *canonical = s->canonical;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    double a = canonical->inverse_mass[k / 3] * s->f[k];
    if (canonical->gravity != NULL) a += canonical_fall(canonical, k);
    if (is_loose(s, k)) v[k] += h * a;
  }
  for (int64_t b = 0; b < s->count; b++)
    kick(&s->body[b], h, s->push + 6 * b, &own[b]);
}

static void drift_all(const struct stepped *s, double h, double *q, const double *v) {
  for (int64_t k = 0; k < 3 * s->canonical->particle_count; k++)
    if (is_loose(s, k)) q[k] += h * v[k];
  for (int64_t b = 0; b < s->count; b++)
    drift(&s->body[b], h, &s->own[b]);
}

static void write_all(const struct stepped *s, struct own *own, double *q, double *v) {
  for (int64_t b = 0; b < s->count; b++)
    write(s->canonical, &s->body[b], &own[b], q, v);
}

/* The second kick is that of the forces at the velocities and momenta that the first, taken twice,
 * predicts. */
static void verlet(const struct stepped *s, double t, double end, double h, double *q, double *v) {
  const size_t size = 3 * (size_t)s->canonical->particle_count * sizeof(double);
  double *half = malloc(size);
  assert_non_null(half);
  find_forces(s, t, q, v);
  kick_all(s, 0.5 * h, v, s->own);
  drift_all(s, h, q, v);
  memcpy(half, v, size);
  memcpy(s->half, s->own, (size_t)s->count * sizeof *s->half);
  kick_all(s, 0.5 * h, v, s->own);
  write_all(s, s->own, q, v);
  canonical_place(s->canonical, end, q, v);
  find_forces(s, end, q, v);
  for (int64_t k = 0; k < 3 * s->canonical->particle_count; k++)
    if (is_loose(s, k)) v[k] = half[k];
  kick_all(s, 0.5 * h, v, s->half);
  write_all(s, s->half, q, v);
  free(half);
}

/* ---- Runge-Kutta methods, of everything as one array: loose q and v, and own coordinates ---- */

#define ROOT 1.41421356237309504880

static const struct tableau {
  const char *method;
  int stages;
  double a[4][4], b[4], at[4];
} tableaus[] = {
    {"forward-euler", 1, {{0}}, {1}, {0}},
    {"heun", 2, {{0}, {1}}, {0.5, 0.5}, {0, 1}},
    {"rk4", 4, {{0}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}, {0, 0.5, 0.5, 1}},
    {"backward-euler", 1, {{1}}, {1}, {1}},
    {"implicit-midpoint", 1, {{0.5}}, {1}, {0.5}},
    {"tr-bdf2",
     3,
     {{0}, {1 - ROOT / 2, 1 - ROOT / 2}, {ROOT / 4, ROOT / 4, 1 - ROOT / 2}},
     {ROOT / 4, ROOT / 4, 1 - ROOT / 2},
     {0, 2 - ROOT, 1}},
};

/* Leaves the rows of y in q and v. */
static void put(const struct stepped *s, double t, const double *y, double *q, double *v) {
  const int64_t size = 3 * s->canonical->particle_count;
  for (int64_t k = 0; k < size; k++) {
    if (is_loose(s, k)) q[k] = y[k];
    if (is_loose(s, k)) v[k] = y[size + k];
  }
  memcpy(s->own, y + 2 * size, (size_t)s->count * sizeof *s->own);
  write_all(s, s->own, q, v);
  canonical_place(s->canonical, t, q, v);
}

static void find_slope(const struct stepped *s, double t, const double *y, double *q, double *v,
                       double *rate) {
  const struct canonical *canonical = s->canonical;
  const int64_t size = 3 * canonical->particle_count;
  put(s, t, y, q, v);
  find_forces(s, t, q, v);
  for (int64_t k = 0; k < size; k++) {
    rate[k] = is_loose(s, k) ? v[k] : 0.0;
    rate[size + k] = canonical->inverse_mass[k / 3] * s->f[k];
    if (canonical->gravity != NULL) rate[size + k] += canonical_fall(canonical, k);
  }
  for (int64_t b = 0; b < s->count; b++) {
    const struct own *at = (const struct own *)(const void *)(y + 2 * size) + b;
    struct own *to = (struct own *)(void *)(rate + 2 * size) + b;
    double m[3][3], around[4] = {0.0, 0.0, 0.0, 0.0};
    matrix_of(at->turn, m);
    rotation_by(&s->body[b], at, m, around + 1);
    multiply(around, at->turn, to->turn);
    for (int k = 0; k < 4; k++)
      to->turn[k] *= 0.5;
    memcpy(to->x, at->v, sizeof to->x);
    memcpy(to->v, s->push + 6 * b, sizeof to->v);
    memcpy(to->l, s->push + 6 * b + 3, sizeof to->l);
  }
}

/* Stages that need each other come from sweep after sweep, by which the rest shrinks to rounding. */
static void runge_kutta(const struct stepped *s, const struct tableau *with, double t, double h, double *q,
                        double *v) {
  enum { SWEEPS = 30 };
  const int64_t size = 3 * s->canonical->particle_count, all = 2 * size + 13 * s->count;
  double *y = new_doubles(all), *stage = new_doubles(all), *rate = new_doubles(4 * all);
  memcpy(y, q, (size_t)size * sizeof *y);
  memcpy(y + size, v, (size_t)size * sizeof *y);
  memcpy(y + 2 * size, s->own, (size_t)s->count * sizeof *s->own);
  for (int i = 0; i < SWEEPS * with->stages; i++) {
    const int now = i % with->stages;
    memcpy(stage, y, (size_t)all * sizeof *y);
    for (int64_t k = 0; k < 4 * all; k++)
      stage[k % all] += h * with->a[now][k / all] * rate[k];
    find_slope(s, t + with->at[now] * h, stage, q, v, rate + now * all);
  }
  for (int64_t k = 0; k < with->stages * all; k++)
    y[k % all] += h * with->b[k / all] * rate[k];
  put(s, t + h, y, q, v);
  free(y);
  free(stage);
  free(rate);
}

void canonical_body_step(const struct canonical *canonical, int64_t count, const struct canonical_body *body,
                         const char *method, double t, double end, double h, double *q, double *v) {
  const struct tableau *tableau = NULL;
  struct stepped s = {.canonical = canonical, .count = count, .body = body};
  s.inside = new_block(canonical->particle_count, 1);
  s.own = new_block(count, sizeof *s.own);
  s.half = new_block(count, sizeof *s.half);
  s.f = new_doubles(3 * canonical->particle_count);
  s.push = new_doubles(6 * count);
  for (int64_t b = 0; b < count; b++) {
    for (int64_t k = 0; k < body[b].count; k++)
      s.inside[body[b].particle[k]] = 1;
    read(&body[b], q, v, &s.own[b]);
  }
  for (size_t k = 0; k < sizeof tableaus / sizeof tableaus[0]; k++)
    if (strcmp(method, tableaus[k].method) == 0) tableau = &tableaus[k];
  if (tableau) {
    runge_kutta(&s, tableau, t, h, q, v);
  } else if (strcmp(method, "verlet") == 0) {
    verlet(&s, t, end, h, q, v);
  } else {
    assert_string_equal(method, "symplectic-euler"); /* a new method needs its own loop here */
    find_forces(&s, t, q, v);
    kick_all(&s, h, v, s.own);
    drift_all(&s, h, q, v);
    write_all(&s, s.own, q, v);
  }
  canonical_place(canonical, end, q, v);
  free(s.inside);
  free(s.own);
  free(s.half);
  free(s.f);
  free(s.push);
}
