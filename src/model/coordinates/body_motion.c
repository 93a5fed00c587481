/* The mechanics of one rigid body. Rotations are those of unit quaternions; no function of libm but sqrt. */
#include "model/coordinates/body.h"

#include "model/sum/motion.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* The matrix of a quaternion of any length but 0: m[i][k] is component i of axis k of the body. A sum of
 * squares that is 1 but for rounding is rounded to 1 more often from one side than from the other, which
 * would add up step by step; so the length becomes one that is no power of two. */
void hk_body_axes(const double turn[4], double m[3][3]) {
  const double scale = 1.3, w = scale * turn[0], x = scale * turn[1], y = scale * turn[2],
               z = scale * turn[3];
  const double ww = w * w, xx = x * x, yy = y * y, zz = z * z, all = ((ww + xx) + yy) + zz;
  m[0][0] = ((ww + xx) - (yy + zz)) / all;
  m[0][1] = 2.0 * (x * y - w * z) / all;
  m[0][2] = 2.0 * (x * z + w * y) / all;
  m[1][0] = 2.0 * (x * y + w * z) / all;
  m[1][1] = ((ww + yy) - (xx + zz)) / all;
  m[1][2] = 2.0 * (y * z - w * x) / all;
  m[2][0] = 2.0 * (x * z - w * y) / all;
  m[2][1] = 2.0 * (y * z + w * x) / all;
  m[2][2] = ((ww + zz) - (xx + yy)) / all;
}

/* From the axes of the body to those of space, and back. */
static void to_space(const double m[3][3], const double in[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] = (m[i][0] * in[0] + m[i][1] * in[1]) + m[i][2] * in[2];
}

static void to_body(const double m[3][3], const double in[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = (m[0][k] * in[0] + m[1][k] * in[1]) + m[2][k] * in[2];
}

/* out = a b, quaternions. */
static void multiply(const double a[4], const double b[4], double out[4]) {
  const double w = ((a[0] * b[0] - a[1] * b[1]) - a[2] * b[2]) - a[3] * b[3];
  const double x = ((a[0] * b[1] + a[1] * b[0]) + a[2] * b[3]) - a[3] * b[2];
  const double y = ((a[0] * b[2] - a[1] * b[3]) + a[2] * b[0]) + a[3] * b[1];
  const double z = ((a[0] * b[3] + a[1] * b[2]) - a[2] * b[1]) + a[3] * b[0];
  out[0] = w, out[1] = x, out[2] = y, out[3] = z;
}

void hk_body_normalise(double *own) {
  double *s = own + HOOKE_BODY_TURN;
  const double length = sqrt(((s[0] * s[0] + s[1] * s[1]) + s[2] * s[2]) + s[3] * s[3]);
  for (int k = 0; k < 4; k++)
    s[k] /= length;
}

/* The component of largest absolute value is found first, and has no cancellation. */
static void set_turn(const double m[3][3], double *own) {
  const double diagonal[4] = {(m[0][0] + m[1][1]) + m[2][2], m[0][0], m[1][1], m[2][2]};
  int largest = 0;
  for (int k = 1; k < 4; k++)
    largest = diagonal[k] > diagonal[largest] ? k : largest;
  double *s = own + HOOKE_BODY_TURN;
  if (largest == 0) {
    s[0] = 1.0 + diagonal[0];
    s[1] = m[2][1] - m[1][2];
    s[2] = m[0][2] - m[2][0];
    s[3] = m[1][0] - m[0][1];
  } else {
    const int i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    s[0] = m[k][j] - m[j][k];
    s[1 + i] = ((1.0 + m[i][i]) - m[j][j]) - m[k][k];
    s[1 + j] = m[j][i] + m[i][j];
    s[1 + k] = m[k][i] + m[i][k];
  }
  hk_body_normalise(own);
}

/* ---- between rows and own coordinates ---- */

void hk_body_triad(int32_t rank, const double ab[3], const double ac[3], double e[3][3]) {
  double other[3] = {0.0, 0.0, 0.0};
  memset(e, 0, 9 * sizeof(double));
  if (rank == 0) {
    e[0][0] = e[1][1] = e[2][2] = 1.0;
    return;
  }
  hk_scale3(1.0 / hk_length3(ab), ab, e[0]);
  if (rank == 2) {
    memcpy(other, ac, sizeof other);
  } else { /* the axis of space that is farthest from the line */
    int axis = fabs(e[0][1]) < fabs(e[0][0]) ? 1 : 0;
    axis = fabs(e[0][2]) < fabs(e[0][axis]) ? 2 : axis;
    other[axis] = 1.0;
  }
  hk_add3(-hk_dot3(other, e[0]), e[0], other);
  hk_scale3(1.0 / hk_length3(other), other, e[1]);
  hk_cross3(e[0], e[1], e[2]);
}

/* Rows of the three particles: the first, and the others from there. */
static void get_base(const struct hk_body *body, const double *const component[3], int64_t stride,
                     double row[3][3]) {
  memset(row, 0, 9 * sizeof(double));
  for (int k = 0; k <= body->rank; k++) {
    for (int a = 0; a < 3; a++)
      row[k][a] = component[a][stride * body->particle[body->base[k]]];
    if (k > 0) hk_add3(-1.0, row[0], row[k]);
  }
}

/* Angular velocity from b and c beside a, as a sum of d1, d2 and n = d1 x d2. Nothing is normalised: lengths
 * do not change, so the rounding of one would be the same in every step, and add up. */
static void find_rotation(const struct hk_body *body, const double d[3][3], const double v[3][3],
                          double w[3]) {
  double n[3], across[3];
  memset(w, 0, 3 * sizeof(double));
  if (body->rank == 0) return;
  if (body->rank == 1) {
    hk_cross3(d[1], v[1], n);
    hk_add3(1.0 / hk_dot3(d[1], d[1]), n, w);
    return;
  }
  hk_cross3(d[1], d[2], n);
  hk_cross3(n, d[1], across);
  const double square = hk_dot3(n, n);
  hk_add3(hk_dot3(v[2], n) / square, d[1], w);
  hk_add3(-hk_dot3(v[1], n) / square, d[2], w);
  hk_add3(hk_dot3(v[1], across) / hk_dot3(across, across), n, w);
}

void hk_body_read(const void *thing, const double *const all_q[3], const double *const all_v[3],
                  int64_t stride, double *own) {
  const struct hk_body *body = thing;
  double q[3][3], v[3][3], e[3][3], m[3][3], rotation[3], momentum[3], arm[3], swing[3];
  get_base(body, all_q, stride, q);
  get_base(body, all_v, stride, v);
  hk_body_triad(body->rank, q[1], q[2], e);
  for (int i = 0; i < 3; i++) {
    const double column[3] = {e[0][i], e[1][i], e[2][i]};
    to_body(body->triad, column, m[i]);
  }
  set_turn(m, own);
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  find_rotation(body, q, v, rotation);
  to_body(m, rotation, momentum);
  for (int k = 0; k < 3; k++)
    momentum[k] *= body->inertia[k];
  to_space(m, momentum, own + HOOKE_BODY_SPIN);
  to_space(m, body->place + 3 * (int64_t)body->base[0], arm);
  hk_cross3(rotation, arm, swing);
  for (int a = 0; a < 3; a++) {
    own[HOOKE_BODY_POINT + a] = q[0][a] - arm[a];
    own[HOOKE_BODY_VELOCITY + a] = v[0][a] - swing[a];
  }
}

void hk_body_read_rows(const struct hk_body *body, const double *q, const double *v, double *own) {
  hk_body_read(body, (const double *const[3]){q, q + 1, q + 2}, (const double *const[3]){v, v + 1, v + 2}, 3,
               own);
}

/* The angular velocity of an angular momentum, or what a torque changes it by. */
static void divide_by_inertia(const struct hk_body *body, const double m[3][3], const double *spin,
                              double w[3]) {
  double turn[3];
  to_body(m, spin, turn);
  for (int k = 0; k < 3; k++)
    turn[k] = body->inertia[k] > 0.0 ? turn[k] / body->inertia[k] : 0.0;
  to_space(m, turn, w);
}

void hk_body_write(const struct hooke_system *system, const void *thing, const double *own,
                   double *const q[3], double *const v[3], int64_t stride, int32_t only_acted) {
  const struct hk_body *body = thing;
  const int64_t count = only_acted ? body->acted_count : body->count;
  double m[3][3], w[3], arm[3], swing[3];
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  divide_by_inertia(body, m, own + HOOKE_BODY_SPIN, w);
  for (int64_t i = 0; i < count; i++) {
    const int64_t k = only_acted ? body->acted[i] : i, p = body->particle[k], at = stride * p;
    if (system->constrained[p]) continue;
    to_space(m, body->place + 3 * k, arm);
    hk_cross3(w, arm, swing);
    for (int a = 0; a < 3; a++) {
      q[a][at] = own[HOOKE_BODY_POINT + a] + arm[a];
      v[a][at] = own[HOOKE_BODY_VELOCITY + a] + swing[a];
    }
  }
}

void hk_body_write_rows(const struct hooke_system *system, const struct hk_body *body, const double *own,
                        double *q, double *v) {
  hk_body_write(system, body, own, (double *const[3]){q, q + 1, q + 2}, (double *const[3]){v, v + 1, v + 2},
                3, 0);
}

/* ---- forces ---- */

/* Leaves out the components about axes that the body does not turn about. */
static void keep_axes(const struct hk_body *body, const double *own, double x[3]) {
  const double *inverse = body->inverse_inertia;
  if (inverse[0] > 0.0 && inverse[1] > 0.0 && inverse[2] > 0.0) return;
  double m[3][3], turn[3];
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  to_body(m, x, turn);
  for (int k = 0; k < 3; k++)
    turn[k] = inverse[k] > 0.0 ? turn[k] : 0.0;
  to_space(m, turn, x);
}

/* Gravity acts on the centre of mass, which is not the point of a pinned body, or elsewhere by its factors.
 */
static void add_gravity(const struct hooke_system *system, const struct hk_body *body, const double *own,
                        double acceleration[3], double torque[3]) {
  if (body->inverse_mass > 0.0) hk_add3(body->lift, system->gravity, acceleration);
  if (body->inverse_mass > 0.0 && system->gravity_factor == NULL) return;
  double m[3][3], arm[3], turning[3];
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  to_space(m, body->heavy, arm);
  hk_cross3(arm, system->gravity, turning);
  hk_add3(body->mass, turning, torque);
}

/* Particles that no force acts on would add zeros. */
void hk_body_push(const struct hooke_system *system, const void *thing, const struct hk_motion *motion,
                  const double *own, double *push) {
  const struct hk_body *body = thing;
  const int only_acted = system->force == NULL;
  const int64_t count = only_acted ? body->acted_count : body->count;
  double sum[3] = {0.0, 0.0, 0.0}, *acceleration = push, *torque = push + 3;
  memset(torque, 0, 3 * sizeof(double));
  for (int64_t i = 0; i < count; i++) {
    const int64_t p = body->particle[only_acted ? body->acted[i] : i];
    if (system->constrained[p]) continue;
    const double force[3] = {motion->f[0][p], motion->f[1][p], motion->f[2][p]};
    double arm[3], turning[3];
    for (int a = 0; a < 3; a++)
      arm[a] = motion->q[a][p] - own[HOOKE_BODY_POINT + a];
    hk_cross3(arm, force, turning);
    hk_add3(1.0, force, sum);
    hk_add3(1.0, turning, torque);
  }
  hk_scale3(body->inverse_mass, sum, acceleration);
  if (system->has_gravity) add_gravity(system, body, own, acceleration, torque);
  keep_axes(body, own, torque);
}

void hk_body_clear(const void *thing, double *const f[3]) {
  const struct hk_body *body = thing;
  for (int64_t i = 0; i < body->acted_count; i++) {
    for (int a = 0; a < 3; a++)
      f[a][body->particle[body->acted[i]]] = 0.0;
  }
}

void hk_body_kick(const void *thing, double h, const double *push, double *own) {
  hk_add3(h, push, own + HOOKE_BODY_VELOCITY);
  hk_add3(h, push + 3, own + HOOKE_BODY_SPIN);
  keep_axes(thing, own, own + HOOKE_BODY_SPIN);
}

void hk_body_accelerate(const struct hooke_system *system, const void *thing, const double *own,
                        const double *push, double *out) {
  const struct hk_body *body = thing;
  double m[3][3], w[3], gyration[3], turning[3], arm[3], swing[3], inward[3], change[3];
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  divide_by_inertia(body, m, own + HOOKE_BODY_SPIN, w);
  hk_cross3(w, own + HOOKE_BODY_SPIN, gyration);
  for (int a = 0; a < 3; a++)
    turning[a] = push[3 + a] - gyration[a];
  divide_by_inertia(body, m, turning, turning);
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t p = body->particle[k];
    if (system->constrained[p]) continue;
    to_space(m, body->place + 3 * k, arm);
    hk_cross3(w, arm, swing);
    hk_cross3(w, swing, inward);
    hk_cross3(turning, arm, change);
    for (int a = 0; a < 3; a++)
      out[3 * p + a] = (push[a] + change[a]) + inward[a];
  }
}

/* ---- motion ---- */

/* Turns by the angle 2 atan(a) about axis `k` of the body; the momentum in its axes turns the other way. */
static void turn_about(int k, double a, double turn[4], double momentum[3]) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double scale = 1.0 / (1.0 + a * a), cosine = (1.0 - a * a) * scale, sine = 2.0 * a * scale;
  double step[4] = {1.0, 0.0, 0.0, 0.0};
  step[1 + k] = a;
  multiply(turn, step, turn);
  const double x = momentum[i], y = momentum[j];
  momentum[i] = cosine * x + sine * y;
  momentum[j] = cosine * y - sine * x;
}

void hk_body_drift(const void *thing, double h, double *own) {
  const struct hk_body *body = thing;
  const double *inverse = body->inverse_inertia;
  double *turn = own + HOOKE_BODY_TURN, *spin = own + HOOKE_BODY_SPIN, m[3][3], momentum[3];
  const double first = inverse[0] > 0.0 ? inverse[0] - inverse[1] : 0.0,
               last = inverse[2] > 0.0 ? inverse[2] - inverse[1] : 0.0, half = 0.5 * h * inverse[1];
  hk_add3(h, own + HOOKE_BODY_VELOCITY, own + HOOKE_BODY_POINT);
  hk_body_axes(turn, m);
  to_body(m, spin, momentum);
  turn_about(0, 0.25 * h * (first * momentum[0]), turn, momentum);
  turn_about(2, 0.5 * h * (last * momentum[2]), turn, momentum);
  turn_about(0, 0.25 * h * (first * momentum[0]), turn, momentum);
  const double around[4] = {1.0, half * spin[0], half * spin[1], half * spin[2]};
  multiply(around, turn, turn);
  hk_body_normalise(own);
}

void hk_body_slope(const void *body, const double *own, const double *push, double *slope) {
  double m[3][3], w[3];
  hk_body_axes(own + HOOKE_BODY_TURN, m);
  divide_by_inertia(body, m, own + HOOKE_BODY_SPIN, w);
  const double rotation[4] = {0.0, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]};
  multiply(rotation, own + HOOKE_BODY_TURN, slope + HOOKE_BODY_TURN);
  for (int a = 0; a < 3; a++) {
    slope[HOOKE_BODY_POINT + a] = own[HOOKE_BODY_VELOCITY + a];
    slope[HOOKE_BODY_VELOCITY + a] = push[a];
    slope[HOOKE_BODY_SPIN + a] = push[3 + a];
  }
}

void hk_body_turn(const double w[3], double h, const double from[4], double turn[4]) {
  const double half[3] = {0.5 * h * w[0], 0.5 * h * w[1], 0.5 * h * w[2]}, all = 1.0 + hk_dot3(half, half);
  const double step[4] = {1.0 / all, half[0] / all, half[1] / all, half[2] / all};
  multiply(step, from, turn);
}

void hk_body_tolerance(const void *thing, double position, double velocity, double *tolerance) {
  const struct hk_body *body = thing;
  double size = 0.0, inertia = 0.0;
  for (int64_t k = 0; k < body->count; k++)
    size = fmax(size, hk_length3(body->place + 3 * k));
  for (int a = 0; a < 3; a++)
    inertia = fmax(inertia, body->inertia[a]);
  for (int k = 0; k < HOOKE_BODY_NUMBERS; k++)
    tolerance[k] = k < HOOKE_BODY_TURN                               ? position
                   : k >= HOOKE_BODY_VELOCITY && k < HOOKE_BODY_SPIN ? velocity
                                                                     : 1.0; /* of what is always 0 */
  for (int k = 0; k < 4 && size > 0.0; k++)
    tolerance[HOOKE_BODY_TURN + k] = 0.5 * position / size;
  for (int k = 0; k < 3 && size > 0.0; k++)
    tolerance[HOOKE_BODY_SPIN + k] = inertia * velocity / size;
}
