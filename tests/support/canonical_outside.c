/* Canonical forces from outside: loads, drag in a medium, obstacles. */
#include "canonical_step.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>

void canonical_add_loads(const struct canonical *canonical, double t, double *force) {
  const int64_t n = canonical->load_count;
  double *zero = new_doubles(3 * n), *load = new_doubles(3 * n);
  check_ok(hooke_system_force(canonical->loads, t, zero, zero, load));
  for (int64_t k = 0; k < 3 * n; k++)
    force[3 * canonical->loaded[k / 3] + k % 3] += load[k];
  free(zero);
  free(load);
}

/* ---- drag in a medium ---- */

static void add_segment(const struct canonical *canonical, int64_t k, const double *q, const double *v,
                        double *force) {
  const int64_t *p = canonical->pieces + 3 * k;
  double d[3], t[3], w[3], across[3];
  for (int a = 0; a < 3; a++) {
    d[a] = q[3 * p[1] + a] - q[3 * p[0] + a];
    w[a] = 0.5 * (v[3 * p[0] + a] + v[3 * p[1] + a]) - canonical_wind(canonical, a);
  }
  const double l = sqrt(canonical_dot(d, d)), il = l > 0.0 ? 1.0 / l : 0.0;
  for (int a = 0; a < 3; a++)
    t[a] = il * d[a];
  const double along = canonical_dot(w, t);
  for (int a = 0; a < 3; a++)
    across[a] = w[a] - along * t[a];
  const double by_normal = canonical->normal[k] * sqrt(canonical_dot(across, across)),
               by_tangential = canonical->tangential[k] * fabs(along) * along;
  for (int e = 0; e < 2; e++) {
    for (int a = 0; a < 3; a++)
      force[3 * p[e] + a] += 0.5 * -(l * (by_normal * across[a] + by_tangential * t[a]));
  }
}

static void add_triangle(const struct canonical *canonical, int64_t k, const double *q, const double *v,
                         double *force) {
  const int64_t *p = canonical->pieces + 3 * k;
  double one[3], other[3], n[3], w[3];
  for (int a = 0; a < 3; a++) {
    one[a] = q[3 * p[1] + a] - q[3 * p[0] + a];
    other[a] = q[3 * p[2] + a] - q[3 * p[0] + a];
    w[a] = ((v[3 * p[0] + a] + v[3 * p[1] + a]) + v[3 * p[2] + a]) / 3.0 - canonical_wind(canonical, a);
  }
  canonical_cross(one, other, n);
  const double twice = sqrt(canonical_dot(n, n)), by = twice > 0.0 ? 1.0 / twice : 0.0;
  for (int a = 0; a < 3; a++)
    n[a] = by * n[a];
  const double rate = canonical_dot(w, n), size = -(canonical->normal[k] * twice * fabs(rate) * rate);
  for (int e = 0; e < 3; e++) {
    for (int a = 0; a < 3; a++)
      force[3 * p[e] + a] += size * n[a] / 3.0;
  }
}

/* Segments first. */
void canonical_add_pieces(const struct canonical *canonical, const double *q, const double *v,
                          double *force) {
  for (int triangles = 0; triangles < 2; triangles++) {
    for (int64_t k = 0; k < canonical->piece_count; k++) {
      const int64_t *p = canonical->pieces + 3 * k;
      if ((p[1] != p[2]) == triangles) (triangles ? add_triangle : add_segment)(canonical, k, q, v, force);
    }
  }
}

/* f = -c w, or -c |w| w. */
void canonical_add_drag(const struct canonical *canonical, const double *each, int squared, const double *v,
                        double *force) {
  for (int64_t p = 0; each && p < canonical->particle_count; p++) {
    double w[3];
    for (int a = 0; a < 3; a++)
      w[a] = v[3 * p + a] - canonical_wind(canonical, a);
    const double c = squared ? each[p] * sqrt(canonical_dot(w, w)) : each[p];
    for (int a = 0; a < 3 && canonical->inverse_mass[p] != 0.0; a++)
      force[3 * p + a] -= c * w[a];
  }
}

void canonical_push_out(const struct canonical_obstacle *o, const double *q, const double *v, double *force) {
  double arm[3], n[3], w[3], distance = 0.0, depth;
  for (int a = 0; a < 3; a++)
    arm[a] = q[a] - o->point[a];
  const double along = (arm[0] * o->axis[0] + arm[1] * o->axis[1]) + arm[2] * o->axis[2];
  for (int a = 0; a < 3 && o->shape == 2; a++)
    arm[a] -= along * o->axis[a];
  if (o->shape > 0) distance = sqrt((arm[0] * arm[0] + arm[1] * arm[1]) + arm[2] * arm[2]);
  depth = o->shape == 0 ? o->clearance - along : (o->radius + o->clearance) - distance;
  if (!(depth > 0.0) || (o->shape > 0 && distance == 0.0)) return;
  for (int a = 0; a < 3; a++)
    n[a] = o->shape == 0 ? o->axis[a] : 1.0 / distance * arm[a];
  const double rate = -((v[0] * n[0] + v[1] * n[1]) + v[2] * n[2]);
  const double push = fmax(0.0, o->stiffness * depth + o->damping * rate);
  for (int a = 0; a < 3; a++)
    w[a] = v[a] + rate * n[a];
  const double slip =
      sqrt(((w[0] * w[0] + w[1] * w[1]) + w[2] * w[2]) + o->friction_speed * o->friction_speed);
  const double brake = o->friction > 0.0 ? o->friction * push / slip : 0.0;
  for (int a = 0; a < 3; a++)
    force[a] += push * n[a] - brake * w[a];
}
