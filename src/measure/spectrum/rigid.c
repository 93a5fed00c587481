#include "measure/spectrum/rigid.h"

#include "core/memory.h"
#include "model/force/force.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

/* Rounding of positions, as part of the largest coordinate. */
static const double POSITION_ROUNDING = 1e-14;

/* ---- creating ---- */

/* The sum of the stiffnesses of all elements at each body, by its number. */
static void find_strengths(const hooke_system *system, const double *q, double *strength) {
  struct hk_elements at;
  if (system->bodies->of == NULL) return;
  hk_begin_elements(system, system->moment, q, NULL, &at);
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    for (int j = 0; j < e->count; j++) {
      const int32_t body = system->bodies->of[e->particle[j]];
      if (body >= 0) strength[body] += fabs(e->weight[j]) * e->k_along;
    }
  }
}

/* Geometric stiffness [N m] that springs of this strength at their rest lengths, and gravity about the centre
 * of mass, have by rounding. */
static double rounding_of(const hooke_system *system, const double *q, const struct hk_body_tangent *t,
                          double strength) {
  double extent = 0.0, size = 0.0;
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    extent = fmax(extent, fabs(q[k]));
  for (int64_t i = 0; i < t->body->count; i++)
    size = fmax(size, hk_length3(t->arm + 3 * i));
  return POSITION_ROUNDING * size * (strength * extent + t->body->mass * hk_length3(system->gravity));
}

/* Over the inertia, and without negative eigenvalues and those of rounding, `slight`. */
static void make_positive(struct hk_rigid *rigid, struct hk_body_tangent *t, double slight) {
  const double *inverse = t->body->inverse_inertia;
  double axis[3][3], m[3][3], vector[3][3];
  int tips = 0;
  slight *= fmax(inverse[0], fmax(inverse[1], inverse[2]));
  hk_body_unit_axes(t, axis);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      const double there[3] = {hk_dot3(t->geometric[0], axis[j]), hk_dot3(t->geometric[1], axis[j]),
                               hk_dot3(t->geometric[2], axis[j])};
      m[i][j] = hk_dot3(axis[i], there);
    }
    for (int j = 0; j < i; j++)
      m[i][j] = m[j][i] = 0.5 * (m[i][j] + m[j][i]);
  }
  hk_body_diagonalise(m, vector);
  memset(t->geometric, 0, sizeof t->geometric);
  for (int k = 0; k < 3; k++) {
    tips |= m[k][k] < -slight;
    if (m[k][k] <= slight) continue;
    rigid->stiffest = fmax(rigid->stiffest, m[k][k]);
    for (int i = 0; i < 3; i++)
      hk_add3(m[k][k] * vector[k][i], vector[k], t->geometric[i]);
  }
  rigid->tipping += tips;
}

/* Forces of springs become those of springs that are stiffer by their factors. */
static void scale_springs(const hooke_system *system, const double *q, const double *spring_scale,
                          double *const f[3]) {
  struct hk_scaler scaler = {.t = system->moment};
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const double more = spring_scale[run->first + k] - 1.0;
      if (more == 0.0) continue;
      const struct hk_spring spring = hk_run_spring_at(run, k, &scaler);
      struct hk_stretch s;
      hk_spring_stretch(&spring, q, NULL, &s);
      for (int a = 0; a < 3; a++) {
        f[a][spring.head] -= more * s.tension * s.direction[a];
        f[a][spring.tail] += more * s.tension * s.direction[a];
      }
    }
  }
}

/* Of springs and gravity at rest; `still` has 3n zeros. */
static int32_t stiffen(struct hk_rigid *rigid, const double *q, const double *still,
                       const double *spring_scale) {
  const hooke_system *system = rigid->tangents.system;
  struct hk_motion *motion = NULL;
  int32_t status = hk_motion_create(system, 0, NULL, &motion);
  if (status != HOOKE_OK) return status;
  hk_motion_load(system, motion, q, still);
  status = hk_motion_forces_without(system, motion, system->moment, HOOKE_CALLED);
  for (int a = 0; a < 3 && system->falls; a++) {
    for (int64_t p = 0; p < system->particle_count; p++)
      motion->f[a][p] += system->mass[p] * hk_fall(system, p, a);
  }
  if (spring_scale) scale_springs(system, q, spring_scale, motion->f);
  hk_body_tangents_stiffen(&rigid->tangents, (const double *const *)motion->f, 1);
  hk_motion_destroy(motion);
  return status;
}

int32_t hk_rigid_create(const hooke_system *system, const double *q, const double *spring_scale,
                        struct hk_rigid *rigid) {
  memset(rigid, 0, sizeof *rigid);
  if (system->mover_count == 0) return HOOKE_OK;
  int32_t status = hk_body_tangents_create(system, q, &rigid->tangents);
  if (status != HOOKE_OK) return status;
  double *still = hk_new(3 * system->particle_count + system->bodies->count, sizeof(double));
  double *strength = still ? still + 3 * system->particle_count : NULL;
  status = still ? stiffen(rigid, q, still, spring_scale) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) find_strengths(system, q, strength);
  for (int64_t k = 0; k < rigid->tangents.count && status == HOOKE_OK; k++) {
    struct hk_body_tangent *t = &rigid->tangents.body[k];
    if (t->body) make_positive(rigid, t, rounding_of(system, q, t, strength[t->body - system->bodies->body]));
  }
  hk_free(still);
  if (status != HOOKE_OK) hk_rigid_release(rigid);
  return status;
}

void hk_rigid_release(struct hk_rigid *rigid) {
  hk_body_tangents_release(&rigid->tangents);
  memset(rigid, 0, sizeof *rigid);
}

/* ---- unknowns ---- */

/* x = J y */
static void spread(const struct hk_rigid *rigid, const struct hk_body_tangent *t, const double *y,
                   double *const x[3], int64_t stride) {
  t->mover->row->spread(rigid->tangents.system, t, y, x, stride);
}

/* y = J^T M x: the nearest motion, that of rigid bodies exactly, as J^T M J = I. */
static void find_motion(const struct hk_rigid *rigid, const struct hk_body_tangent *t,
                        const double *const x[3], int64_t stride, double *y) {
  t->mover->row->gather(rigid->tangents.system, t, rigid->tangents.system->mass, x, stride, y);
}

static int32_t is_free(const struct hk_rigid *rigid, int64_t mover, int k) {
  const struct hk_mover *m = rigid->tangents.body[mover].mover;
  return m->row->has(m->thing, k);
}

int64_t hk_rigid_unknowns(const struct hk_rigid *rigid) {
  int64_t count = 0;
  for (int64_t k = 0; k < HOOKE_PUSH * rigid->tangents.count; k++)
    count += is_free(rigid, k / HOOKE_PUSH, (int)(k % HOOKE_PUSH));
  return count;
}

void hk_rigid_pack(const struct hk_rigid *rigid, const double *const x[3], int64_t stride, double *unknown) {
  for (int64_t k = 0; k < rigid->tangents.count; k++) {
    double y[HOOKE_PUSH];
    find_motion(rigid, &rigid->tangents.body[k], x, stride, y);
    for (int j = 0; j < HOOKE_PUSH; j++)
      if (is_free(rigid, k, j)) *unknown++ = y[j];
  }
}

void hk_rigid_unpack(const struct hk_rigid *rigid, const double *unknown, double *const x[3],
                     int64_t stride) {
  for (int64_t k = 0; k < rigid->tangents.count; k++) {
    double y[HOOKE_PUSH];
    for (int j = 0; j < HOOKE_PUSH; j++)
      y[j] = is_free(rigid, k, j) ? *unknown++ : 0.0;
    spread(rigid, &rigid->tangents.body[k], y, x, stride);
  }
}

/* ---- products ---- */

void hk_rigid_project(const struct hk_rigid *rigid, double *const x[3], int64_t stride) {
  for (int64_t k = 0; k < rigid->tangents.count; k++) {
    double y[HOOKE_PUSH];
    find_motion(rigid, &rigid->tangents.body[k], (const double *const *)x, stride, y);
    spread(rigid, &rigid->tangents.body[k], y, x, stride);
  }
}

/* y += scale times the geometric stiffness times a motion. */
static void add_geometric(const struct hk_body_tangent *t, double scale, const double *motion, double *y) {
  for (int k = 0; k < 3 && t->body; k++)
    y[3 + k] += scale * hk_dot3(t->geometric[k], motion + 3);
}

void hk_rigid_reduce(const struct hk_rigid *rigid, double scale, const double *const x[3], double *const f[3],
                     int64_t stride) {
  const hooke_system *system = rigid->tangents.system;
  for (int64_t k = 0; k < rigid->tangents.count; k++) {
    const struct hk_body_tangent *t = &rigid->tangents.body[k];
    int64_t count;
    const int32_t *particle = t->mover->row->particles(t->mover->thing, &count);
    double y[HOOKE_PUSH], motion[HOOKE_PUSH];
    t->mover->row->gather(system, t, NULL, (const double *const *)f, stride, y);
    find_motion(rigid, t, x, stride, motion);
    add_geometric(t, scale, motion, y);
    spread(rigid, t, y, f, stride);
    for (int64_t i = 0; i < 3 * count; i++) {
      const int64_t p = particle[i / 3];
      if (!system->constrained[p]) f[i % 3][stride * p] *= system->mass[p];
    }
  }
}

double hk_rigid_energy(const struct hk_rigid *rigid, const double *const x[3], int64_t stride) {
  double sum = 0.0;
  for (int64_t k = 0; k < rigid->tangents.count && rigid->stiffest > 0.0; k++) {
    double motion[HOOKE_PUSH], y[HOOKE_PUSH] = {0.0};
    find_motion(rigid, &rigid->tangents.body[k], x, stride, motion);
    add_geometric(&rigid->tangents.body[k], 1.0, motion, y);
    if (rigid->tangents.body[k].body) sum += hk_dot3(motion + 3, y + 3);
  }
  return sum;
}

double hk_rigid_spin(const struct hk_rigid *rigid, const double *v) {
  const double *const from[3] = {v, v + 1, v + 2};
  double most = 0.0;
  for (int64_t k = 0; k < rigid->tangents.count; k++) {
    const struct hk_body_tangent *t = &rigid->tangents.body[k];
    double y[HOOKE_PUSH];
    if (t->body == NULL) continue;
    find_motion(rigid, t, from, 3, y);
    for (int a = 0; a < 3; a++)
      y[a] = sqrt(t->body->inverse_inertia[a]) * y[3 + a];
    most = fmax(most, hk_length3(y));
  }
  return most;
}
