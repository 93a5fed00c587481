#include "baseline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct spring {
  int32_t i, j;
  double kappa, gamma, rest_length;
};

struct baseline {
  int64_t particle_count, spring_count;
  struct spring *spring;
  double *q, *v, *f, *inverse_mass;
};

static int fill(const hooke_system *system, struct baseline *b) {
  const int64_t n = b->particle_count, m = b->spring_count;
  int64_t *ends = malloc((size_t)(2 * m + 1) * sizeof *ends);
  double *material = malloc((size_t)(3 * m + 1) * sizeof *material);
  hooke_state *state = NULL;
  int done = ends && material && hooke_state_create(system, &state) == HOOKE_OK &&
             hooke_system_spring_ends(system, ends) == HOOKE_OK &&
             hooke_system_spring_material(system, material, material + m, material + 2 * m) == HOOKE_OK;
  if (done) {
    for (int64_t s = 0; s < m; s++) {
      b->spring[s] = (struct spring){(int32_t)ends[2 * s], (int32_t)ends[2 * s + 1], material[s],
                                     material[m + s], material[2 * m + s]};
    }
    memcpy(b->q, hooke_state_position(state), (size_t)(3 * n) * sizeof(double));
    memcpy(b->v, hooke_state_velocity(state), (size_t)(3 * n) * sizeof(double));
    memcpy(b->inverse_mass, hooke_system_inverse_mass(system), (size_t)n * sizeof(double));
  }
  hooke_state_destroy(state);
  free(material);
  free(ends);
  return done;
}

struct baseline *baseline_create(const hooke_system *system) {
  struct baseline *b = calloc(1, sizeof *b);
  if (b == NULL) return NULL;
  b->particle_count = hooke_system_particle_count(system);
  b->spring_count = hooke_system_spring_count(system);
  const size_t n = (size_t)b->particle_count;
  b->spring = malloc(((size_t)b->spring_count + 1) * sizeof *b->spring);
  b->q = malloc(3 * n * sizeof(double));
  b->v = malloc(3 * n * sizeof(double));
  b->f = malloc(3 * n * sizeof(double));
  b->inverse_mass = malloc(n * sizeof(double));
  if (b->spring && b->q && b->v && b->f && b->inverse_mass && fill(system, b)) return b;
  baseline_destroy(b);
  return NULL;
}

void baseline_destroy(struct baseline *b) {
  if (b == NULL) return;
  free(b->spring);
  free(b->q);
  free(b->v);
  free(b->f);
  free(b->inverse_mass);
  free(b);
}

const double *baseline_position(const struct baseline *b) {
  return b->q;
}

static void add_forces(struct baseline *b) {
  const double *q = b->q, *v = b->v;
  double *f = b->f;
  for (int64_t s = 0; s < b->spring_count; s++) {
    const struct spring spring = b->spring[s];
    const double *qi = q + 3 * spring.i, *qj = q + 3 * spring.j, *vi = v + 3 * spring.i,
                 *vj = v + 3 * spring.j;
    const double dx = qi[0] - qj[0], dy = qi[1] - qj[1], dz = qi[2] - qj[2];
    const double r = sqrt(dx * dx + dy * dy + dz * dz);
    const double along = ((vi[0] - vj[0]) * dx + (vi[1] - vj[1]) * dy + (vi[2] - vj[2]) * dz) / r;
    const double t = (spring.kappa * (r - spring.rest_length) + spring.gamma * along) / r;
    double *fi = f + 3 * spring.i, *fj = f + 3 * spring.j;
    fi[0] -= t * dx;
    fi[1] -= t * dy;
    fi[2] -= t * dz;
    fj[0] += t * dx;
    fj[1] += t * dy;
    fj[2] += t * dz;
  }
}

void baseline_step(struct baseline *b, double h, int64_t steps) {
  for (int64_t k = 0; k < steps; k++) {
    memset(b->f, 0, (size_t)(3 * b->particle_count) * sizeof(double));
    add_forces(b);
    for (int64_t p = 0; p < b->particle_count; p++) {
      const double w = b->inverse_mass[p];
      if (w == 0.0) continue;
      const double gravity[3] = {0.0, -9.81, 0.0};
      for (int a = 0; a < 3; a++) {
        b->v[3 * p + a] += h * (w * b->f[3 * p + a] + gravity[a]);
        b->q[3 * p + a] += h * b->v[3 * p + a];
      }
    }
  }
}
