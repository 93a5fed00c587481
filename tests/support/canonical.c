/* Compile without contraction of products and sums (-ffp-contract=off), like the library. */
#include "canonical.h"

#include "check.h"

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
  check_ok(hooke_system_spring_ends(system, canonical->ends));
  check_ok(hooke_system_spring_material(system, canonical->kappa, canonical->gamma, canonical->rest_length));
  memcpy(canonical->inverse_mass, hooke_system_inverse_mass(system), (size_t)n * sizeof(double));
  int64_t spring = 0;
  for (int64_t g = 0; g < hooke_system_group_count(system); g++) {
    const int64_t size = hooke_system_group_size(system, g);
    const int pulls = strncmp(hooke_system_group_name(system, g), "pull", 4) == 0;
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
  free(canonical->inverse_mass);
  memset(canonical, 0, sizeof *canonical);
}

static void add_spring(const struct canonical *canonical, int64_t k, const double *q, const double *v,
                       double *force) {
  const int64_t i = canonical->ends[2 * k], j = canonical->ends[2 * k + 1];
  const double kappa = canonical->kappa[k], gamma = canonical->gamma[k], l0 = canonical->rest_length[k];
  const double dx = q[3 * i] - q[3 * j], dy = q[3 * i + 1] - q[3 * j + 1], dz = q[3 * i + 2] - q[3 * j + 2];
  const double vx = v[3 * i] - v[3 * j], vy = v[3 * i + 1] - v[3 * j + 1], vz = v[3 * i + 2] - v[3 * j + 2];
  const double r = sqrt((dx * dx + dy * dy) + dz * dz);
  const double ir = r > 0.0 ? 1.0 / r : 0.0;
  double tension = kappa * (r - l0) + gamma * (((vx * dx + vy * dy) + vz * dz) * ir);
  if (canonical->pull_only[k] && (r <= l0 || tension < 0.0)) tension = 0.0;
  const double s = tension * ir;
  const double fx = -s * dx, fy = -s * dy, fz = -s * dz;
  force[3 * i] += fx;
  force[3 * i + 1] += fy;
  force[3 * i + 2] += fz;
  force[3 * j] -= fx;
  force[3 * j + 1] -= fy;
  force[3 * j + 2] -= fz;
}

void canonical_acceleration(const struct canonical *canonical, double t, const double *q, const double *v,
                            double *acceleration) {
  const int64_t n = canonical->particle_count;
  const double *w = canonical->inverse_mass;
  double *force = acceleration;
  memset(force, 0, (size_t)(3 * n) * sizeof(double));
  for (int64_t k = 0; k < canonical->spring_count; k++)
    add_spring(canonical, k, q, v, force);
  if (canonical->drag != 0.0) {
    for (int64_t p = 0; p < n; p++) {
      for (int a = 0; a < 3 && w[p] != 0.0; a++)
        force[3 * p + a] -= canonical->drag * v[3 * p + a];
    }
  }
  if (canonical->force != NULL) assert_int_equal(canonical->force(n, t, q, v, force, canonical->ctx), 0);
  for (int64_t p = 0; p < n; p++) {
    for (int a = 0; a < 3; a++) {
      double *f = &force[3 * p + a];
      *f = w[p] * *f;
      if (canonical->gravity != NULL) *f += canonical->gravity[a];
      if (w[p] == 0.0) *f = 0.0;
    }
  }
}

int32_t canonical_step(const struct canonical *canonical, const char *method, double t, double h, double *q,
                       double *v) {
  const int64_t n = canonical->particle_count;
  const double *w = canonical->inverse_mass;
  const int forward = strcmp(method, "forward-euler") == 0;
  if (!forward && strcmp(method, "symplectic-euler") != 0) return 0;
  double *a = new_doubles(3 * n);
  canonical_acceleration(canonical, t, q, v, a);
  for (int64_t k = 0; k < 3 * n; k++) {
    if (w[k / 3] == 0.0) continue;
    if (forward) {
      q[k] += h * v[k];
      v[k] += h * a[k];
    } else {
      v[k] += h * a[k];
      q[k] += h * v[k];
    }
  }
  free(a);
  return 1;
}
