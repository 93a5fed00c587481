/* The linear equations of a stage with rigid bodies. */
#include "integrate/solve/body_stage.h"

#include "integrate/solve/stage.h"
#include "kernel/vector_loops.h"
#include "model/coordinates/body.h"
#include "model/vector3.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const struct hk_body *body_of(const struct hk_stage *stage, int64_t k) {
  return stage->body.tangents.body[k].body;
}

void hk_body_moments(const struct hk_body *body, double moment[3]) {
  const double largest = body->inertia[2] > 0.0 ? body->inertia[2] : 1.0; /* they ascend */
  for (int k = 0; k < 3; k++)
    moment[k] = body->inertia[k] > 0.0 ? body->inertia[k] : largest;
}

void hk_body_weigh(const double axes[3][3], const double weight[3], const double x[3], double out[3]) {
  double along[3];
  for (int k = 0; k < 3; k++)
    along[k] = weight[k] * ((axes[0][k] * x[0] + axes[1][k] * x[1]) + axes[2][k] * x[2]);
  for (int a = 0; a < 3; a++)
    out[a] = hk_dot3(axes[a], along);
}

void hk_body_project(const struct hk_body *body, const double axes[3][3], const double x[3], double out[3]) {
  double kept[3];
  for (int k = 0; k < 3; k++)
    kept[k] = body->inertia[k] > 0.0 ? 1.0 : 0.0;
  hk_body_weigh(axes, kept, x, out);
}

void hk_body_stage_clear(const struct hk_stage *stage, double *x) {
  const int64_t n = stage->reduced.integrator->system->particle_count;
  for (int64_t k = 0; k < stage->body.count; k++) {
    const struct hk_body *body = body_of(stage, k);
    for (int64_t i = 0; i < 3 * body->count; i++)
      x[i % 3 * n + body->particle[i / 3]] = 0.0;
  }
}

void hk_body_momentum(const struct hk_stage *stage, int64_t k, const double z[3], double p[3]) {
  double moment[3];
  hk_body_moments(body_of(stage, k), moment);
  hk_body_weigh(stage->body.rotation[k].begin, moment, z, p);
}

/* ---- diagonal blocks of S ---- */

/* Motions of a particle by the six of its body, columns of t. */
static void find_columns(const struct hk_body_tangent *tangent, const double *arm, double t[3][6]) {
  memset(t, 0, 18 * sizeof(double));
  for (int j = 0; j < 3; j++) {
    const double unit[3] = {j == 0, j == 1, j == 2};
    double turn[3], swing[3];
    hk_body_project(tangent->body, tangent->axes, unit, turn);
    hk_cross3(turn, arm, swing);
    t[j][j] = tangent->body->inverse_mass > 0.0 ? 1.0 : 0.0;
    for (int a = 0; a < 3; a++)
      t[a][3 + j] = swing[a];
  }
}

/* g += t^T s t with the block s of a particle, of x x, y y, z z, x y, x z, y z, each n apart. */
static void add_block(const double t[3][6], const double *s, int64_t n, double g[6][6]) {
  const double block[3][3] = {
      {s[0], s[3 * n], s[4 * n]}, {s[3 * n], s[n], s[5 * n]}, {s[4 * n], s[5 * n], s[2 * n]}};
  for (int j = 0; j < 6; j++) {
    const double column[3] = {t[0][j], t[1][j], t[2][j]};
    const double moved[3] = {hk_dot3(block[0], column), hk_dot3(block[1], column), hk_dot3(block[2], column)};
    for (int i = 0; i < 6; i++)
      g[i][j] += (t[0][i] * moved[0] + t[1][i] * moved[1]) + t[2][i] * moved[2];
  }
}

/* The inertia of the equations is that where the stage begins: it takes the place of the particles'. */
static void add_inertia(const struct hk_stage *stage, int64_t k, const double z[3], double out[3]) {
  const struct hk_body_tangent *tangent = &stage->body.tangents.body[k];
  double spin[3];
  hk_body_momentum(stage, k, z, spin);
  hk_add3(1.0, spin, out);
  hk_body_weigh(tangent->axes, tangent->body->inertia, z, spin);
  hk_add3(-1.0, spin, out);
}

static void fill_block(const struct hk_stage *stage, int64_t k, double g[6][6]) {
  const struct hk_reduced *reduced = &stage->reduced;
  const struct hk_body_tangent *tangent = &stage->body.tangents.body[k];
  const hooke_system *system = reduced->integrator->system;
  double t[3][6];
  memset(g, 0, 36 * sizeof(double));
  for (int64_t i = 0; i < tangent->body->count; i++) {
    const int64_t p = tangent->body->particle[i];
    if (system->constrained[p]) continue;
    find_columns(tangent, tangent->arm + 3 * i, t);
    add_block(t, reduced->block + p, system->particle_count, g);
  }
  for (int j = 0; j < 3; j++) {
    const double unit[3] = {j == 0, j == 1, j == 2};
    double turning[3] = {0.0, 0.0, 0.0};
    add_inertia(stage, k, unit, turning);
    if (!(tangent->body->inverse_mass > 0.0)) g[j][j] = 1.0;
    for (int a = 0; a < 3; a++)
      g[3 + a][3 + j] += turning[a];
  }
}

/* The lower triangle of g = L L^T, in place. Pivots below rounding are rounding. */
static void factorise(double g[6][6]) {
  for (int j = 0; j < 6; j++) {
    const double least = DBL_EPSILON * g[j][j];
    for (int k = 0; k < j; k++)
      g[j][j] -= g[j][k] * g[j][k];
    g[j][j] = sqrt(g[j][j] < least ? least : g[j][j]);
    for (int i = j + 1; i < 6; i++) {
      for (int k = 0; k < j; k++)
        g[i][j] -= g[i][k] * g[j][k];
      g[i][j] /= g[j][j];
    }
  }
}

/* x = L^-1 x, and x = L^-T x. */
static void divide(void *ctx, double *x) {
  const struct hk_body_stage *bodies = &((struct hk_stage *)ctx)->body;
  for (int64_t k = 0; k < bodies->count; k++, x += HOOKE_BODY_VELOCITIES) {
    const double *l = bodies->factor + 36 * k;
    for (int i = 0; i < 6; i++) {
      for (int j = 0; j < i; j++)
        x[i] -= l[6 * i + j] * x[j];
      x[i] /= l[7 * i];
    }
  }
}

static void divide_transposed(void *ctx, double *x) {
  const struct hk_body_stage *bodies = &((struct hk_stage *)ctx)->body;
  for (int64_t k = 0; k < bodies->count; k++, x += HOOKE_BODY_VELOCITIES) {
    const double *l = bodies->factor + 36 * k;
    for (int i = 5; i >= 0; i--) {
      for (int j = i + 1; j < 6; j++)
        x[i] -= l[6 * j + i] * x[j];
      x[i] /= l[7 * i];
    }
  }
}

/* ---- the matrix ---- */

void hk_body_stage_gather(const struct hk_stage *stage, int64_t k, const double *f, double push[6]) {
  const hooke_system *system = stage->reduced.integrator->system;
  const int64_t n = system->particle_count;
  const double *const from[3] = {f, f + n, f + 2 * n};
  hk_body_gather(system, &stage->body.tangents.body[k], NULL, from, 1, push, push + 3);
  for (int a = 0; a < 3 && !(body_of(stage, k)->inverse_mass > 0.0); a++)
    push[a] = 0.0;
}

void hk_body_stage_aim(struct hk_stage *stage) {
  struct hk_body_stage *bodies = &stage->body;
  if (bodies->count == 0) return;
  hk_motion_store(stage->reduced.integrator->motion, bodies->dq, bodies->dv); /* in rows */
  hk_body_tangents_set(&bodies->tangents, bodies->dq);
}

/* Forces on all particles, gravity among them. */
static void find_forces(struct hk_stage *stage) {
  const hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  const int64_t n = system->particle_count;
  double *f = stage->body.df;
  for (int64_t k = 0; k < 3 * n; k++)
    f[k] = it->motion->f[k / n][k % n] + system->mass[k % n] * hk_fall(system, k % n, (int)(k / n));
  const double *const force[3] = {f, f + n, f + 2 * n};
  hk_body_tangents_stiffen(&stage->body.tangents, force, 1);
}

void hk_body_stage_set(struct hk_stage *stage) {
  struct hk_body_stage *bodies = &stage->body;
  const hooke_integrator *it = stage->reduced.integrator;
  if (bodies->count == 0) return;
  find_forces(stage);
  hk_body_stage_clear(stage, stage->reduced.factor);
  hk_body_stage_clear(stage, stage->reduced.factor + it->size);
  for (int64_t k = 0; k < bodies->count; k++) {
    const double *spin = stage->at.speed + it->size + HOOKE_BODY_NUMBERS * k + HOOKE_BODY_SPIN;
    double g[6][6], *push = bodies->push + 6 * k;
    hk_body_stage_gather(stage, k, bodies->df, push);
    for (int a = 0; a < 3; a++)
      bodies->rotation[k].spin[a] = spin[a] + stage->at.a * push[3 + a];
    fill_block(stage, k, g);
    factorise(g);
    memcpy(bodies->factor + 36 * k, g, sizeof g);
  }
}

/* ---- products ---- */

void hk_body_turn_by(const double w[3], double h, const double change[3], double turn[3]) {
  hk_cross3(w, change, turn);
  for (int c = 0; c < 3; c++)
    turn[c] = h / (1.0 + 0.25 * h * h * hk_dot3(w, w)) * (change[c] + 0.5 * h * turn[c]);
}

/* A small change of a body: of its position, orientation, and both velocities. */
struct change {
  double move[3], turn[3], velocity[3], rotation[3];
};

/* By a change of the unknowns. */
static void find_change(const struct hk_stage *stage, int64_t k, const double *x, struct change *change) {
  const struct hk_body_rotation *r = &stage->body.rotation[k];
  double p[3];
  memcpy(change->velocity, x, sizeof change->velocity);
  hk_scale3(stage->at.a, x, change->move);
  hk_body_momentum(stage, k, x + 3, p);
  for (int c = 0; c < 3; c++)
    change->rotation[c] = hk_dot3(r->inverse[c], p);
  hk_body_turn_by(r->w, stage->at.a, change->rotation, change->turn);
}

/* Of a body's particles: d (w x r) = dw x r + w x dr, where P w is what the body turns with. */
static void spread_change(const struct hk_stage *stage, int64_t k, const struct change *change, double *dq,
                          double *dv) {
  const hooke_system *system = stage->reduced.integrator->system;
  const struct hk_body_tangent *tangent = &stage->body.tangents.body[k];
  double w[3], dw[3], across[3], less[3];
  hk_body_project(tangent->body, tangent->axes, stage->body.rotation[k].w, w);
  hk_cross3(change->turn, stage->body.rotation[k].w, across);
  hk_add3(-1.0, change->rotation, across);
  hk_body_project(tangent->body, tangent->axes, across, less);
  hk_cross3(change->turn, w, dw);
  hk_add3(-1.0, less, dw);
  for (int64_t i = 0; i < tangent->body->count; i++) {
    const int64_t n = system->particle_count, p = tangent->body->particle[i];
    double moved[3], swing[3], carried[3];
    if (system->constrained[p]) continue;
    hk_cross3(change->turn, tangent->arm + 3 * i, moved);
    hk_cross3(dw, tangent->arm + 3 * i, swing);
    hk_cross3(w, moved, carried);
    for (int a = 0; a < 3; a++) {
      dq[a * n + p] = change->move[a] + moved[a];
      dv[a * n + p] = change->velocity[a] + (swing[a] + carried[a]);
    }
  }
}

/* out = the change of F of body k, with that of the forces of particles, df: d (p - P s) = dp - d x P s + P
 * (d x s) - P ds for a turn d. */
static void change_right(const struct hk_stage *stage, int64_t k, const double *x, const double *df,
                         double out[6]) {
  const struct hk_body_tangent *tangent = &stage->body.tangents.body[k];
  const double *s = stage->body.rotation[k].spin, a = stage->at.a;
  const double mass = tangent->body->inverse_mass > 0.0 ? tangent->body->mass : 0.0;
  struct change change;
  double push[6], along[3], across[3];
  find_change(stage, k, x, &change);
  hk_body_stage_gather(stage, k, df, push);
  hk_body_turn_forces(tangent, 1.0, change.turn, push + 3);
  for (int c = 0; c < 3; c++)
    out[c] = mass * x[c] - a * push[c];
  hk_body_momentum(stage, k, x + 3, out + 3);
  hk_body_project(tangent->body, tangent->axes, s, along);
  hk_cross3(change.turn, along, across);
  hk_add3(-1.0, across, out + 3);
  hk_cross3(change.turn, s, across);
  hk_add3(-a, push + 3, across);
  hk_body_project(tangent->body, tangent->axes, across, along);
  hk_add3(1.0, along, out + 3);
}

static int32_t multiply_whole(struct hk_stage *stage, const double *x, double *out) {
  struct hk_body_stage *bodies = &stage->body;
  hooke_integrator *it = stage->reduced.integrator;
  const int64_t n = it->system->particle_count;
  int32_t status = hk_integrator_tell(it);
  if (status != HOOKE_OK) return status;
  for (int64_t j = 0; j < it->size; j++) {
    bodies->dq[j] = stage->at.a * x[j];
    bodies->dv[j] = x[j];
  }
  for (int64_t k = 0; k < bodies->count; k++) {
    struct change change;
    find_change(stage, k, x + it->size + HOOKE_BODY_VELOCITIES * k, &change);
    spread_change(stage, k, &change, bodies->dq, bodies->dv);
  }
  status = hk_reduced_change(&stage->reduced, bodies->dq, bodies->dv, bodies->df);
  for (int64_t j = 0; j < it->size; j++)
    out[j] = it->system->mass[j % n] * x[j] - stage->at.a * bodies->df[j];
  for (int64_t k = 0; k < bodies->count; k++) {
    const int64_t at = it->size + HOOKE_BODY_VELOCITIES * k;
    change_right(stage, k, x + at, bodies->df, out + at);
  }
  return status;
}

static int32_t multiply_positive(struct hk_stage *stage, const double *x, double *out) {
  struct hk_body_stage *bodies = &stage->body;
  const hooke_system *system = stage->reduced.integrator->system;
  const int64_t n = system->particle_count;
  double *const to[3] = {bodies->dq, bodies->dq + n, bodies->dq + 2 * n};
  memcpy(bodies->dq, x, (size_t)(3 * n) * sizeof(double));
  for (int64_t k = 0; k < bodies->count; k++) {
    const struct hk_body_tangent *tangent = &bodies->tangents.body[k];
    const double *velocity = x + 3 * n + HOOKE_BODY_VELOCITIES * k;
    double turn[3];
    hk_body_project(tangent->body, tangent->axes, velocity + 3, turn);
    hk_body_spread(system, tangent, velocity, turn, to, 1);
  }
  const int32_t status = hk_reduced_multiply(&stage->reduced, bodies->dq, out);
  for (int64_t k = 0; k < bodies->count; k++) {
    const struct hk_body_tangent *tangent = &bodies->tangents.body[k];
    const int64_t at = 3 * n + HOOKE_BODY_VELOCITIES * k;
    double push[6];
    hk_body_stage_gather(stage, k, out, push);
    memcpy(out + at, push, 3 * sizeof(double));
    hk_body_project(tangent->body, tangent->axes, push + 3, out + at + 3);
    add_inertia(stage, k, x + at + 3, out + at + 3);
  }
  return status;
}

static int32_t multiply(void *ctx, const double *x, double *out) {
  struct hk_stage *stage = ctx;
  return stage->reduced.projected ? multiply_positive(stage, x, out) : multiply_whole(stage, x, out);
}

struct hk_more_unknowns hk_body_stage_unknowns(struct hk_stage *stage) {
  const int64_t count = HOOKE_BODY_VELOCITIES * stage->body.count;
  return (struct hk_more_unknowns){count, multiply, divide, divide_transposed, stage};
}
