/* The frame of a rigid body: its point, its axes, and the three particles that tell where they are. */
#include "model/coordinates/body.h"

#include "core/memory.h"
#include "core/status.h"
#include "core/sum.h"
#include "model/particles.h"
#include "model/start.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* Distances below this part of a body's size are rounding of positions. */
static const double DISTANCE_ROUNDING = 1e-10;

static const double *row(const hooke_system *system, const struct hk_body *body, int64_t k) {
  return system->position + 3 * (int64_t)body->particle[k];
}

static int32_t is_free(const hooke_system *system, const struct hk_body *body, int64_t k) {
  return system->constrained[body->particle[k]] == 0;
}

static int32_t is_pinned(const hooke_system *system, const struct hk_body *body, int64_t k) {
  return system->constrained[body->particle[k]] == HOOKE_IS_PINNED;
}

static void subtract(const double a[3], const double b[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = a[k] - b[k];
}

/* Mean position by mass of the free particles, taken from the first for digits. */
static void find_centre(const hooke_system *system, struct hk_body *body, double centre[3]) {
  struct hk_sum mass = {0.0, 0.0}, sum[3] = {{0.0, 0.0}};
  const double *first = row(system, body, 0);
  for (int64_t k = 0; k < body->count; k++) {
    if (!is_free(system, body, k)) continue;
    const double m = system->mass[body->particle[k]], *x = row(system, body, k);
    hk_sum_add(&mass, m);
    for (int a = 0; a < 3; a++)
      hk_sum_add(&sum[a], m * (x[a] - first[a]));
  }
  body->mass = hk_sum_value(&mass);
  for (int a = 0; a < 3; a++)
    centre[a] = first[a] + hk_sum_value(&sum[a]) / body->mass;
}

/* Index of the particle farthest from a point, or from the line through it along `unit`; of all, or of the
 * pinned ones alone; the first of equals. Returns the distance. */
static double find_farthest(const hooke_system *system, const struct hk_body *body, const double from[3],
                            const double *unit, int32_t pinned, int32_t *index) {
  double most = -1.0;
  for (int64_t k = 0; k < body->count; k++) {
    double d[3];
    if (pinned && !is_pinned(system, body, k)) continue;
    subtract(row(system, body, k), from, d);
    if (unit) hk_add3(-hk_dot3(d, unit), unit, d);
    const double length = hk_length3(d);
    if (!(length > most)) continue;
    most = length;
    *index = (int32_t)k;
  }
  return most;
}

/* Chooses the three particles; `pins` becomes the number of pinned points that tell something: 0 to 3. */
static int32_t choose_base(const hooke_system *system, struct hk_body *body, const double centre[3],
                           int32_t *pins) {
  int32_t *base = body->base, pin = 0;
  double d[3];
  while (pin < body->count && !is_pinned(system, body, pin))
    pin++;
  *pins = pin < body->count;
  if (*pins)
    base[0] = pin;
  else
    find_farthest(system, body, centre, NULL, 0, &base[0]);
  const double *a = row(system, body, base[0]);
  const double size = find_farthest(system, body, a, NULL, 0, &base[1]), least = DISTANCE_ROUNDING * size;
  if (body->count > 1 && !(size > 0.0))
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "its %lld particles are all at one position; allowed: some apart, or one particle",
                   (long long)body->count);
  if (!(size > 0.0)) return HOOKE_OK;
  if (*pins && find_farthest(system, body, a, NULL, 1, &pin) > least) {
    base[1] = pin;
    *pins = 2;
  }
  subtract(row(system, body, base[1]), a, d);
  hk_scale3(1.0 / hk_length3(d), d, d);
  body->rank = find_farthest(system, body, a, d, 0, &base[2]) > least ? 2 : 1;
  if (*pins == 2) *pins += body->rank == 1 || find_farthest(system, body, a, d, 1, &pin) > least;
  return HOOKE_OK;
}

/* ---- axes ---- */

/* One rotation of the method of Jacobi (1846), which makes m[i][j] zero; the rows of `axis` turn along. */
static void rotate(int i, int j, double m[3][3], double axis[3][3]) {
  if (m[i][j] == 0.0) return;
  const int k = 3 - i - j;
  const double theta = (m[j][j] - m[i][i]) / (2.0 * m[i][j]);
  const double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
  const double c = 1.0 / sqrt(t * t + 1.0), s = t * c, off = m[i][j], x = m[i][k], y = m[j][k];
  m[i][i] -= t * off;
  m[j][j] += t * off;
  m[i][j] = m[j][i] = 0.0;
  m[i][k] = m[k][i] = c * x - s * y;
  m[j][k] = m[k][j] = s * x + c * y;
  for (int a = 0; a < 3; a++) {
    const double p = axis[i][a], q = axis[j][a];
    axis[i][a] = c * p - s * q;
    axis[j][a] = s * p + c * q;
  }
}

enum { SWEEPS = 12 }; /* it converges quadratically: 5 suffice */

void hk_body_diagonalise(double m[3][3], double axis[3][3]) {
  memset(axis, 0, 9 * sizeof(double));
  for (int a = 0; a < 3; a++)
    axis[a][a] = 1.0;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    rotate(0, 1, m, axis);
    rotate(0, 2, m, axis);
    rotate(1, 2, m, axis);
  }
}

static void swap_axes(int i, int j, double m[3][3], double axis[3][3]) {
  if (m[i][i] <= m[j][j]) return;
  const double value = m[i][i];
  m[i][i] = m[j][j];
  m[j][j] = value;
  for (int a = 0; a < 3; a++) {
    const double kept = axis[i][a];
    axis[i][a] = axis[j][a];
    axis[j][a] = kept;
  }
}

/* Principal axes of inertia about `point`, ascending, right-handed. */
static void find_principal_axes(const hooke_system *system, const struct hk_body *body, const double point[3],
                                double axis[3][3]) {
  double m[3][3] = {{0.0}};
  for (int64_t k = 0; k < body->count; k++) {
    if (!is_free(system, body, k)) continue;
    double d[3];
    subtract(row(system, body, k), point, d);
    const double square = hk_dot3(d, d), mass = system->mass[body->particle[k]];
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++)
        m[i][j] += mass * ((i == j ? square : 0.0) - d[i] * d[j]);
    }
  }
  hk_body_diagonalise(m, axis);
  swap_axes(0, 1, m, axis);
  swap_axes(1, 2, m, axis);
  swap_axes(0, 1, m, axis);
  hk_cross3(axis[0], axis[1], axis[2]);
}

/* ---- the frame ---- */

static void place_particles(const hooke_system *system, struct hk_body *body, const double point[3],
                            const double axis[3][3]) {
  for (int64_t k = 0; k < body->count; k++) {
    double d[3], *place = body->place + 3 * k;
    subtract(row(system, body, k), point, d);
    for (int a = 0; a < 3; a++)
      place[a] = body->rank == 0 || (body->rank == 1 && a > 0) ? 0.0 : hk_dot3(axis[a], d);
  }
}

/* About each axis; about an axis through two pins the other two do not count. */
static void find_inertia(const hooke_system *system, struct hk_body *body, int32_t pins) {
  const double *factor = system->gravity_factor;
  struct hk_sum sum[3] = {{0.0, 0.0}}, moment[3] = {{0.0, 0.0}}, weight = {0.0, 0.0};
  for (int64_t k = 0; k < body->count; k++) {
    if (!is_free(system, body, k)) continue;
    const int32_t p = body->particle[k];
    const double *x = body->place + 3 * k, m = system->mass[p], heavy = factor ? m * factor[p] : m;
    hk_sum_add(&weight, heavy);
    for (int a = 0; a < 3; a++) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      hk_sum_add(&sum[a], m * (x[b] * x[b] + x[c] * x[c]));
      hk_sum_add(&moment[a], heavy * x[a]);
    }
  }
  body->lift = factor ? hk_sum_value(&weight) / body->mass : 1.0;
  for (int a = 0; a < 3; a++) {
    body->inertia[a] = pins == 2 && a > 0 ? 0.0 : hk_sum_value(&sum[a]);
    body->inverse_inertia[a] = body->inertia[a] > 0.0 ? 1.0 / body->inertia[a] : 0.0;
    body->heavy[a] = pins > 0 || factor ? hk_sum_value(&moment[a]) / body->mass : 0.0;
  }
}

static void find_triad(struct hk_body *body) {
  double ab[3] = {0.0}, ac[3] = {0.0};
  const double *a = body->place + 3 * (int64_t)body->base[0];
  if (body->rank > 0) subtract(body->place + 3 * (int64_t)body->base[1], a, ab);
  if (body->rank > 1) subtract(body->place + 3 * (int64_t)body->base[2], a, ac);
  hk_body_triad(body->rank, ab, ac, body->triad);
}

static const double SMALLEST = 1e-50,
                    LARGEST = 1e50; /* radii of gyration whose sixth powers are numbers [m] */

static int32_t check_size(const struct hk_body *body) {
  for (int a = 0; a < 3; a++) {
    const double radius = sqrt(body->inertia[a] * body->inverse_mass);
    if (radius == 0.0 || (radius >= SMALLEST && radius <= LARGEST)) continue;
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "its radius of gyration, %g m, is too large or too small to calculate with; allowed: %g to %g m",
        radius, SMALLEST, LARGEST);
  }
  return HOOKE_OK;
}

static int32_t check_numbers(const struct hk_body *body) {
  double sum = body->mass + body->inverse_mass;
  for (int a = 0; a < 3; a++)
    sum += body->inertia[a] + body->inverse_inertia[a];
  if (isfinite(sum)) return check_size(body);
  return hk_fail(
      HOOKE_BAD_VALUE, NULL,
      "its mass %g kg and inertia (%g, %g, %g) kg m^2 are too large or too small to calculate with",
      body->mass, body->inertia[0], body->inertia[1], body->inertia[2]);
}

static int32_t set_frame(const hooke_system *system, struct hk_body *body, const double centre[3],
                         int32_t pins) {
  double ab[3] = {0.0}, ac[3] = {0.0}, axis[3][3];
  const double *first = row(system, body, body->base[0]), *point = pins > 0 ? first : centre;
  body->place = hk_new(3 * body->count, sizeof(double));
  if (body->place == NULL) return HOOKE_NO_MEMORY;
  if (body->rank > 0) subtract(row(system, body, body->base[1]), first, ab);
  if (body->rank > 1) subtract(row(system, body, body->base[2]), first, ac);
  if (body->rank < 2 || pins == 2)
    hk_body_triad(body->rank, ab, ac, axis);
  else
    find_principal_axes(system, body, point, axis);
  place_particles(system, body, point, axis);
  body->inverse_mass = pins > 0 ? 0.0 : 1.0 / body->mass;
  find_inertia(system, body, pins);
  find_triad(body);
  body->moves = 1;
  return check_numbers(body);
}

static int32_t check_driven(const hooke_system *system, const struct hk_body *body, int64_t driven) {
  int64_t k = 0;
  if (driven == 0 || driven == body->count) return HOOKE_OK;
  while (system->constrained[body->particle[k]] != HOOKE_IS_DRIVEN)
    k++;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "particle %d is driven and others of the body are not; "
                 "allowed: all, and the body follows its drive, or none",
                 (int)body->particle[k]);
}

int32_t hk_body_commit(hooke_system *system, struct hk_body *body) {
  int64_t unconstrained = 0, driven = 0;
  int32_t pins = 0;
  double centre[3];
  for (int64_t k = 0; k < body->count; k++) {
    unconstrained += is_free(system, body, k);
    driven += system->constrained[body->particle[k]] == HOOKE_IS_DRIVEN;
  }
  body->moves = body->rank = 0;
  body->base[0] = body->base[1] = body->base[2] = 0;
  int32_t status = check_driven(system, body, driven);
  if (status != HOOKE_OK || unconstrained == 0) return status;
  find_centre(system, body, centre);
  status = choose_base(system, body, centre, &pins);
  return status == HOOKE_OK && pins < 3 ? set_frame(system, body, centre, pins) : status;
}

void hk_body_pin_if_still(hooke_system *system, const struct hk_body *body) {
  for (int64_t k = 0; k < body->count && !body->moves; k++) {
    uint8_t *constrained = &system->constrained[body->particle[k]];
    *constrained = *constrained ? *constrained : HOOKE_IS_PINNED;
  }
}

void hk_body_fit(const hooke_system *system, const struct hk_body *body, double *own) {
  struct hk_sum momentum[3] = {{0.0, 0.0}}, spin[3] = {{0.0, 0.0}};
  const double *q = hk_start_position(system);
  for (int64_t k = 0; k < body->count; k++) {
    if (!is_free(system, body, k)) continue;
    const double *v = system->velocity + 3 * (int64_t)body->particle[k], m = system->mass[body->particle[k]];
    double d[3], turning[3];
    subtract(q + 3 * (int64_t)body->particle[k], own + HOOKE_BODY_POINT, d);
    hk_cross3(d, v, turning);
    for (int a = 0; a < 3; a++) {
      hk_sum_add(&momentum[a], m * v[a]);
      hk_sum_add(&spin[a], m * turning[a]);
    }
  }
  for (int a = 0; a < 3; a++) {
    own[HOOKE_BODY_VELOCITY + a] = body->inverse_mass * hk_sum_value(&momentum[a]);
    own[HOOKE_BODY_SPIN + a] = hk_sum_value(&spin[a]);
  }
}
