#include "baseline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct spring {
  int32_t i, j;
  double kappa, gamma, l0;
};

struct baseline {
  int64_t particle_count, spring_count;
  int is_damped;
  void (*step)(struct baseline *b, double h, int64_t steps);
  struct spring *spring;
  double *q, *v, *f, *w;
  double *q0, *v0, *sum_q, *sum_v; /* of rk4 */
};

/* ---- forces ---- */

static void add_damped(const struct baseline *b) {
  const double *q = b->q, *v = b->v;
  double *f = b->f;
  for (int64_t s = 0; s < b->spring_count; s++) {
    const struct spring spring = b->spring[s];
    const int64_t i = 3 * (int64_t)spring.i, j = 3 * (int64_t)spring.j;
    const double dx = q[i] - q[j], dy = q[i + 1] - q[j + 1], dz = q[i + 2] - q[j + 2];
    const double vx = v[i] - v[j], vy = v[i + 1] - v[j + 1], vz = v[i + 2] - v[j + 2];
    const double r = sqrt(dx * dx + dy * dy + dz * dz), ir = 1.0 / r;
    const double along = (vx * dx + vy * dy + vz * dz) * ir;
    const double t = (spring.kappa * (r - spring.l0) + spring.gamma * along) * ir;
    f[i] -= t * dx;
    f[i + 1] -= t * dy;
    f[i + 2] -= t * dz;
    f[j] += t * dx;
    f[j + 1] += t * dy;
    f[j + 2] += t * dz;
  }
}

static void add_undamped(const struct baseline *b) {
  const double *q = b->q;
  double *f = b->f;
  for (int64_t s = 0; s < b->spring_count; s++) {
    const struct spring spring = b->spring[s];
    const int64_t i = 3 * (int64_t)spring.i, j = 3 * (int64_t)spring.j;
    const double dx = q[i] - q[j], dy = q[i + 1] - q[j + 1], dz = q[i + 2] - q[j + 2];
    const double r = sqrt(dx * dx + dy * dy + dz * dz);
    const double t = spring.kappa * (r - spring.l0) / r;
    f[i] -= t * dx;
    f[i + 1] -= t * dy;
    f[i + 2] -= t * dz;
    f[j] += t * dx;
    f[j + 1] += t * dy;
    f[j + 2] += t * dz;
  }
}

static void compute_forces(const struct baseline *b) {
  memset(b->f, 0, (size_t)(3 * b->particle_count) * sizeof(double));
  if (b->is_damped)
    add_damped(b);
  else
    add_undamped(b);
}

/* ---- steps ---- */

static const double GRAVITY[3] = {0.0, -9.81, 0.0};

static void kick(const struct baseline *b, double h) {
  for (int64_t p = 0; p < b->particle_count; p++) {
    if (b->w[p] == 0.0) continue;
    for (int a = 0; a < 3; a++)
      b->v[3 * p + a] += h * (b->w[p] * b->f[3 * p + a] + GRAVITY[a]);
  }
}

static void drift(const struct baseline *b, double h) {
  for (int64_t k = 0; k < 3 * b->particle_count; k++)
    b->q[k] += h * b->v[k];
}

static void forward_euler(struct baseline *b, double h, int64_t steps) {
  for (int64_t k = 0; k < steps; k++) {
    compute_forces(b);
    for (int64_t p = 0; p < b->particle_count; p++) {
      if (b->w[p] == 0.0) continue;
      for (int a = 0; a < 3; a++) {
        b->q[3 * p + a] += h * b->v[3 * p + a];
        b->v[3 * p + a] += h * (b->w[p] * b->f[3 * p + a] + GRAVITY[a]);
      }
    }
  }
}

static void symplectic_euler(struct baseline *b, double h, int64_t steps) {
  for (int64_t k = 0; k < steps; k++) {
    compute_forces(b);
    for (int64_t p = 0; p < b->particle_count; p++) {
      if (b->w[p] == 0.0) continue;
      for (int a = 0; a < 3; a++) {
        b->v[3 * p + a] += h * (b->w[p] * b->f[3 * p + a] + GRAVITY[a]);
        b->q[3 * p + a] += h * b->v[3 * p + a];
      }
    }
  }
}

static void verlet(struct baseline *b, double h, int64_t steps) {
  compute_forces(b);
  for (int64_t k = 0; k < steps; k++) {
    kick(b, 0.5 * h);
    drift(b, h);
    compute_forces(b);
    kick(b, 0.5 * h);
  }
}

/* Adds `weight` times this stage's rates to the sums, and advances by `h` along them from the start of the
 * step. */
static void stage(const struct baseline *b, double weight, double h) {
  compute_forces(b);
  for (int64_t p = 0; p < b->particle_count; p++) {
    if (b->w[p] == 0.0) continue;
    for (int a = 0; a < 3; a++) {
      const int64_t k = 3 * p + a;
      const double v = b->v[k], acceleration = b->w[p] * b->f[k] + GRAVITY[a];
      b->sum_q[k] += weight * v;
      b->sum_v[k] += weight * acceleration;
      b->q[k] = b->q0[k] + h * v;
      b->v[k] = b->v0[k] + h * acceleration;
    }
  }
}

static void rk4(struct baseline *b, double h, int64_t steps) {
  const size_t bytes = (size_t)(3 * b->particle_count) * sizeof(double);
  for (int64_t k = 0; k < steps; k++) {
    memcpy(b->q0, b->q, bytes);
    memcpy(b->v0, b->v, bytes);
    memset(b->sum_q, 0, bytes);
    memset(b->sum_v, 0, bytes);
    stage(b, 1.0 / 6.0, 0.5 * h);
    stage(b, 1.0 / 3.0, 0.5 * h);
    stage(b, 1.0 / 3.0, h);
    stage(b, 1.0 / 6.0, 0.0);
    for (int64_t n = 0; n < 3 * b->particle_count; n++) {
      b->q[n] = b->q0[n] + h * b->sum_q[n];
      b->v[n] = b->v0[n] + h * b->sum_v[n];
    }
  }
}

static const struct loop {
  const char *method;
  int does_damping;
  void (*step)(struct baseline *b, double h, int64_t steps);
} table[] = {
    {"forward-euler", 1, forward_euler},
    {"symplectic-euler", 1, symplectic_euler},
    {"verlet", 0, verlet}, /* its second kick is implicit in the damping */
    {"rk4", 1, rk4},
};

static const struct loop *find(const char *method) {
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
    if (strcmp(table[k].method, method) == 0) return &table[k];
  }
  return NULL;
}

int baseline_has(const char *method, int is_damped) {
  const struct loop *loop = find(method);
  return loop && (loop->does_damping || !is_damped);
}

/* ---- creating ---- */

static int fill(const hooke_system *system, struct baseline *b) {
  const int64_t m = b->spring_count;
  int64_t *ends = malloc((size_t)(2 * m + 1) * sizeof *ends);
  double *material = malloc((size_t)(3 * m + 1) * sizeof *material);
  const int done =
      ends && material &&
      hooke_system_members(system, "springs", ends, material, material + m, material + 2 * m) == HOOKE_OK;
  for (int64_t s = 0; done && s < m; s++) {
    b->spring[s] = (struct spring){(int32_t)ends[2 * s], (int32_t)ends[2 * s + 1], material[s],
                                   material[m + s], material[2 * m + s]};
    b->is_damped |= b->spring[s].gamma != 0.0;
  }
  free(material);
  free(ends);
  return done;
}

struct baseline *baseline_create(const hooke_system *system, const hooke_state *state, const char *method) {
  struct baseline *b = calloc(1, sizeof *b);
  if (b == NULL) return NULL;
  b->particle_count = hooke_system_particle_count(system);
  b->spring_count = hooke_system_count(system, "springs");
  b->step = find(method)->step;
  const size_t n = (size_t)b->particle_count, bytes = 3 * n * sizeof(double);
  double **const array[] = {&b->q, &b->v, &b->f, &b->q0, &b->v0, &b->sum_q, &b->sum_v};
  b->spring = malloc(((size_t)b->spring_count + 1) * sizeof *b->spring);
  b->w = malloc(n * sizeof(double));
  int done = b->spring && b->w;
  for (int k = 0; k < (b->step == rk4 ? 7 : 3); k++)
    done &= (*array[k] = malloc(bytes)) != NULL;
  if (!done || !fill(system, b)) {
    baseline_destroy(b);
    return NULL;
  }
  memcpy(b->q, hooke_state_position(state), bytes);
  memcpy(b->v, hooke_state_velocity(state), bytes);
  memcpy(b->w, hooke_system_inverse_mass(system), n * sizeof(double));
  return b;
}

void baseline_destroy(struct baseline *b) {
  if (b == NULL) return;
  double *const array[] = {b->w, b->q, b->v, b->f, b->q0, b->v0, b->sum_q, b->sum_v};
  for (size_t k = 0; k < sizeof array / sizeof array[0]; k++)
    free(array[k]);
  free(b->spring);
  free(b);
}

void baseline_step(struct baseline *b, double h, int64_t steps) {
  b->step(b, h, steps);
}

const double *baseline_position(const struct baseline *b) {
  return b->q;
}
