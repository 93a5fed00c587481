/* How far steps that are solved for are from their equations. Compile like canonical.c. */
#include "canonical_step.h"

#include "check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Transverse stiffness of a spring: its tension over its length. Where two particles nearly meet it is far
 * larger than the stiffness along it. */
static double across(const struct canonical *canonical, int64_t k, const double *q, double speed) {
  const double *a = q + 3 * canonical->ends[2 * k], *b = q + 3 * canonical->ends[2 * k + 1];
  const double r = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
  const double tension =
      canonical->kappa[k] * fabs(r - canonical->rest_length[k]) + 2.0 * canonical->gamma[k] * speed;
  return r > 0.0 ? tension / r : 0.0;
}

/* The largest coordinate and velocity, and of single forces h^2 stiffness/mass and h damping/mass. */
struct scale {
  double extent, speed, stiff, damped;
};

static struct scale scale_of(const struct canonical *canonical, double h, const double *q, const double *v) {
  double extent = 0.0, speed = 0.0, stiffness = 0.0, damping = canonical->drag;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++) {
    extent = fmax(extent, fabs(q[k]));
    speed = fmax(speed, fabs(v[k]));
  }
  double lightest = 0.0;
  for (int64_t p = 0; p < canonical->particle_count && canonical->drags; p++)
    damping = fmax(damping, canonical->drags[p]);
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
  return (struct scale){extent, speed, h * h * lightest * stiffness, h * lightest * damping};
}

/* What 100 roundings of positions and velocities make of the change of a velocity in one step. */
static double rounding(const struct canonical *canonical, double h, const double *q, const double *v) {
  const struct scale s = scale_of(canonical, h, q, v);
  return 100.0 * DBL_EPSILON * (s.speed + s.stiff * s.extent / h + s.damped * s.speed);
}

/* 1 if x1 is x0 but for a few roundings of numbers of this size. */
static int is_near(double x0, double x1, double size) {
  return fabs(x1 - x0) <= 8.0 * DBL_EPSILON * size;
}

/* The size of a change of velocity: the root of the sum of its squares times masses. */
static double weighed(const struct canonical *canonical, const double *v) {
  double sum = 0.0;
  for (int64_t k = 0; k < 3 * canonical->particle_count; k++)
    sum += canonical_is_free(canonical, k) ? v[k] * v[k] / canonical->inverse_mass[k / 3] : 0.0;
  return sqrt(sum);
}

/* Of the equations of the middle, whose velocity is the mean of the old and the new one: the defects of all
 * over 1e-9 of the change of all velocities, and rounding. */
static double midpoint_defect(const struct canonical *canonical, double t, double end, double h,
                              const double *const from[2], const double *const to[2]) {
  const int64_t size = 3 * canonical->particle_count;
  double *q = new_doubles(size), *v = new_doubles(size), *a = new_doubles(size), defect = 0.0;
  double *wrong = new_doubles(size), *change = new_doubles(size);
  for (int64_t k = 0; k < size; k++) {
    v[k] = (from[1][k] + to[1][k]) / 2.0;
    q[k] = canonical_is_free(canonical, k) ? from[0][k] + h / 2.0 * v[k] : from[0][k];
    if (canonical_is_free(canonical, k) &&
        !is_near(from[0][k] + h * v[k], to[0][k], fabs(from[0][k]) + h * (fabs(from[1][k]) + fabs(to[1][k]))))
      defect = INFINITY;
  }
  canonical_place(canonical, t + (end - t) / 2.0, q, v);
  canonical_acceleration(canonical, t + (end - t) / 2.0, q, v, a);
  double mass = 0.0;
  for (int64_t k = 0; k < size; k++) {
    wrong[k] = v[k] - (from[1][k] + h / 2.0 * a[k]);
    change[k] = to[1][k] - from[1][k];
    mass += canonical_is_free(canonical, k) ? 1.0 / canonical->inverse_mass[k / 3] : 0.0;
  }
  /* the forces are those of the middle, where two particles may nearly meet */
  const double found = weighed(canonical, wrong),
               allowed = 1e-9 * weighed(canonical, change) + sqrt(mass) * rounding(canonical, h, q, v);
  if (found > 0.0) defect = fmax(defect, found / allowed);
  free(wrong);
  free(change);
  free(q);
  free(v);
  free(a);
  return defect;
}

/* The backward difference, solved for the state between the two stages, which then has to be that of the
 * trapezoidal rule. */
static double tr_bdf2_defect(const struct canonical *canonical, double t, double end, double h,
                             const double *const from[2], const double *const to[2]) {
  const int64_t size = 3 * canonical->particle_count;
  const double c = 2.0 - sqrt(2.0), d = (sqrt(2.0) - 1.0) / 2.0, a = c * h / 2.0;
  double *q = new_doubles(size), *v = new_doubles(size), defect = 0.0;
  double *first = new_doubles(size), *middle = new_doubles(size), *last = new_doubles(size);
  canonical_acceleration(canonical, t, from[0], from[1], first);
  canonical_acceleration(canonical, end, to[0], to[1], last);
  for (int64_t k = 0; k < size; k++) {
    q[k] = (to[0][k] - a * to[1][k] + d * from[0][k]) / (1.0 + d);
    v[k] = (to[1][k] - a * last[k] + d * from[1][k]) / (1.0 + d);
    /* an end on its anchor has no direction; a rounding away from it, it has one */
    if (to[0][k] == from[0][k]) q[k] = from[0][k];
  }
  canonical_place(canonical, t + c * h, q, v);
  for (int64_t k = 0; k < size; k++) {
    if (canonical_is_free(canonical, k)) continue;
    if (canonical->place == NULL) q[k] = from[0][k];
    if (canonical->place == NULL) v[k] = 0.0;
  }
  canonical_acceleration(canonical, t + c * h, q, v, middle);
  for (int64_t k = 0; k < size; k++) {
    if (!canonical_is_free(canonical, k)) continue;
    const double speed = v[k] - (from[1][k] + a * (first[k] + middle[k]));
    const double place = q[k] - (from[0][k] + a * (from[1][k] + v[k]));
    const double rounding = 16.0 * DBL_EPSILON * (fabs(to[0][k]) + fabs(from[0][k]) + a * fabs(to[1][k]));
    defect = fmax(defect, fmax(fabs(speed), (fabs(place) - rounding) / a));
  }
  free(q);
  free(v);
  free(first);
  free(middle);
  free(last);
  return defect;
}

/* Over 1e-9 of the change of velocity and rounding, by which `grown` times is allowed. */
static double weigh(const struct canonical *canonical, double h, double defect, double grown,
                    const double *const from[2], const double *const to[2]) {
  const double change = largest_difference(3 * canonical->particle_count, from[1], to[1]);
  return defect == 0.0 ? 0.0 : defect / (grown * (1e-9 * change + rounding(canonical, h, to[0], to[1])));
}

/* The largest h/2 c/m of a particle with all that damps it. */
static double damping_of_kick(const struct canonical *canonical, double h) {
  const int64_t n = canonical->particle_count;
  double *damping = new_doubles(n), most = 0.0;
  for (int64_t k = 0; k < canonical->spring_count; k++) {
    for (int e = 0; e < 2; e++)
      damping[canonical->ends[2 * k + e]] += canonical->gamma[k];
  }
  for (int64_t k = 0; k < canonical->tetrahedron_count; k++) {
    double least = INFINITY;
    for (int a = 0; a < 7; a++)
      least = fmin(least, fabs(canonical->altitude[2][7 * k + a]));
    for (int j = 0; j < 4; j++)
      damping[canonical->corners[4 * k + j]] += canonical->altitude[1][k] / least;
  }
  for (int64_t k = 0; k < canonical->anchor_count; k++)
    damping[canonical->anchored[k]] += canonical->anchor[1][k];
  for (int64_t p = 0; p < n; p++)
    most = fmax(most, h / 2.0 * canonical->inverse_mass[p] *
                          (damping[p] + canonical->drag + (canonical->drags ? canonical->drags[p] : 0.0)));
  free(damping);
  return most;
}

/* A step of Verlet that solves for its damping leaves a thousandth of what the predicted velocity does, times
 * how large that is beside the kick, 1 at most. Residuals are measured with more than the masses: that much
 * is allowed here. */
static double verlet_defect(const struct canonical *canonical, double t, double end, double h,
                            const double *q0, const double *v0, const double *q1, const double *v1) {
  const int64_t size = 3 * canonical->particle_count;
  double *q = new_doubles(size), *v = new_doubles(size), *a = new_doubles(size), *half = new_doubles(size);
  double *left = new_doubles(size), *kick = new_doubles(size), *wrong = new_doubles(size), defect = 0.0;
  memcpy(q, q0, (size_t)size * sizeof(double));
  memcpy(v, v0, (size_t)size * sizeof(double));
  canonical_predict(canonical, t, end, h, q, v, half, a);
  canonical_acceleration(canonical, end, q, v, a);
  for (int64_t k = 0; k < size; k++) {
    if (memcmp(&q[k], &q1[k], sizeof q[k]) != 0) defect = INFINITY;
    kick[k] = 2.0 * (v[k] - half[k]);
    left[k] = (half[k] + h / 2.0 * a[k]) - v[k];
  }
  canonical_accelerate(canonical, end, q, v1, v, a);
  double mass = 0.0;
  for (int64_t k = 0; k < size; k++) {
    wrong[k] = v1[k] - (half[k] + h / 2.0 * a[k]);
    if (canonical_is_free(canonical, k)) mass += 1.0 / canonical->inverse_mass[k / 3];
  }
  const double before = weighed(canonical, left), ratio = before / weighed(canonical, kick);
  const double part = 1e-3 * (ratio < 1.0 ? ratio : 1.0);
  const double allowed = before * (part > 1e-13 ? part : 1e-13) * sqrt(1.0 + damping_of_kick(canonical, h));
  if (defect == 0.0) {
    const double found = weighed(canonical, wrong);
    defect = found == 0.0 ? 0.0 : found / (allowed + sqrt(mass) * rounding(canonical, h, q1, v1));
  }
  free(q);
  free(v);
  free(a);
  free(half);
  free(left);
  free(kick);
  free(wrong);
  return defect;
}

static double backward_euler_defect(const struct canonical *canonical, double end, double h, const double *q0,
                                    const double *v0, const double *q1, const double *v1) {
  const int64_t size = 3 * canonical->particle_count;
  double *q = new_doubles(size), *a = new_doubles(size), *seen = new_doubles(size);
  memcpy(q, q0, (size_t)size * sizeof(double));
  memcpy(seen, v1, (size_t)size * sizeof(double));
  double *wrong = new_doubles(size), *change = new_doubles(size), mass = 0.0, defect = 0.0;
  for (int64_t k = 0; k < size; k++) {
    if (canonical_is_free(canonical, k)) q[k] += h * v1[k];
  }
  canonical_place(canonical, end, q, seen);
  canonical_accelerate(canonical, end, q, v1, seen, a);
  for (int64_t k = 0; k < size; k++) {
    if (memcmp(&q[k], &q1[k], sizeof q[k]) != 0) defect = INFINITY;
    wrong[k] = v1[k] - (v0[k] + h * a[k]);
    change[k] = v1[k] - v0[k];
    mass += canonical_is_free(canonical, k) ? 1.0 / canonical->inverse_mass[k / 3] : 0.0;
  }
  const double found = weighed(canonical, wrong),
               allowed = 1e-9 * weighed(canonical, change) + sqrt(mass) * rounding(canonical, h, q1, v1);
  if (!(found <= defect)) defect = fmax(defect, found / allowed);
  free(wrong);
  free(change);
  free(q);
  free(a);
  free(seen);
  return defect;
}

double canonical_defect(const struct canonical *canonical, const char *method, double t, double end, double h,
                        const double *q0, const double *v0, const double *q1, const double *v1) {
  const double *const from[2] = {q0, v0}, *const to[2] = {q1, v1};
  if (strcmp(method, "verlet") == 0) return verlet_defect(canonical, t, end, h, q0, v0, q1, v1);
  if (strcmp(method, "implicit-midpoint") == 0) return midpoint_defect(canonical, t, end, h, from, to);
  if (strcmp(method, "tr-bdf2") == 0) {
    /* what the second stage leaves open comes back through the forces of the first */
    const struct scale s = scale_of(canonical, h, q1, v1);
    return weigh(canonical, h, tr_bdf2_defect(canonical, t, end, h, from, to), 1.0 + s.stiff + s.damped, from,
                 to);
  }
  return backward_euler_defect(canonical, end, h, q0, v0, q1, v1);
}
