#include "measure/rest/rest_find.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/descent.h"
#include "integrate/solve/stage.h"
#include "kernel/vector_loops.h"
#include "measure/counted_work/work.h"
#include "measure/spectrum/step_bound.h"
#include "model/force/drive.h"
#include "model/system.h"
#include "model/vector3.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Steps begin at some of the explicit limit and grow and shrink by these factors, up to the longest, over the
 * first. */
static const double FIRST = 8.0, LONGER = 4.0, MUCH_LONGER = 16.0, SHORTER = 0.125, LONGEST = 1e10,
                    SHORTEST = 1e-8;
/* The first step of a scene without stiffness [s]. */
static const double WITHOUT_STIFFNESS = 1e-3;
/* Residuals over the largest force: that of rest, and where one that no longer falls is as small as it gets.
 */
static const double AT_REST = 1e-8, ROUNDINGS = 16.0 * DBL_EPSILON, LEAST = 1e-12;
/* The counted work of a search at most [s], and in evaluations of all forces of a large scene. */
static const double MOST_WORK = 20.0, MOST_EVALUATIONS = 1e5;
/* Of the change over a step, how exactly its equations are solved. */
static const double NEWTON = 0.1;
/* A scene that has come this many times its extent under a force that stays, falls. */
static const double FAR = 1e6, STAYS = 0.9, FALLEN = 0.5;
enum { MOST_STEPS = 400, MOST_NUMBERS = 100, FEW = 3 };

struct search {
  const hooke_system *system;
  hooke_system still; /* a shallow copy: drives stopped, obstacles held and without friction */
  struct hk_system_rest rest;
  hooke_integrator *it;
  struct hk_stage *stage;
  struct hk_budget *budget;
  double t, extent, begun; /* begun: the first residual */
  const double *from;      /* q at the start, in rows */
  double *push;
  struct hk_rest *found;
};

/* ---- the scene held still ---- */

static int32_t hold_obstacles(struct search *s) {
  const struct hk_obstacles *all = &s->system->rest->obstacles;
  struct hk_obstacle *held = hk_new(all->count, sizeof *held);
  if (held == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < all->count; k++) {
    double shift[3] = {0.0}, velocity[3];
    held[k] = all->obstacle[k];
    if (held[k].moves) hk_course_at(&held[k].course, s->t, shift, velocity);
    hk_add3(1.0, shift, held[k].point);
    held[k].moves = 0;
    held[k].friction = 0.0;
  }
  s->rest = *s->system->rest;
  s->rest.obstacles.obstacle = held;
  s->still = *s->system;
  s->still.rest = &s->rest;
  s->still.drive_count = 0;
  s->still.moment = s->t;
  return HOOKE_OK;
}

static int32_t place_driven(const struct search *s, double *q) {
  int32_t value = 0;
  for (int64_t k = 0; k < s->system->drive_count && value == 0; k++) {
    const struct hk_drive_group *drive = &s->system->drive[k];
    double *rows = hk_rows_new(6 * drive->count);
    if (rows == NULL) return HOOKE_NO_MEMORY;
    value = hk_drive_evaluate(drive, s->t, rows, rows + 3 * drive->count);
    for (int64_t j = 0; j < drive->count && value == 0; j++)
      memcpy(q + 3 * drive->particle[j], rows + 3 * j, 3 * sizeof(double));
    hooke_rows_hold(rows, -1);
  }
  return value == 0 ? HOOKE_OK : hk_fail(HOOKE_STOPPED, NULL, "a drive callback returned %d", (int)value);
}

/* Where a factor has few numbers a particle, as those of ropes and small cloths have, it beats iterations. */
static int32_t find_factor(const hooke_system *system, int32_t *pays) {
  struct hk_factor *factor = NULL;
  if (system->mover_count > 0) return HOOKE_OK;
  const int32_t status = hk_factor_create(system, MOST_NUMBERS * (system->particle_count + 1), 0, &factor);
  *pays = factor != NULL;
  hk_factor_destroy(factor);
  return status;
}

static int32_t create_integrator(struct search *s) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", "backward-euler");
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", 1.0);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "newton_tolerance", NEWTON);
  int32_t pays = 0;
  if (status == HOOKE_OK) status = find_factor(s->system, &pays);
  if (status == HOOKE_OK && pays) status = hooke_options_set_text(options, "linear_solver", "direct");
  if (status == HOOKE_OK) status = hooke_integrator_create(&s->still, options, &s->it);
  hooke_options_destroy(options);
  if (status != HOOKE_OK) return status;
  s->stage = s->it->own;
  s->it->t = s->it->t0 = s->t;
  if (s->budget) status = hooke_integrator_on_progress(s->it, 0.0, hk_budget_watch, s->budget);
  struct hk_descent *descent = &s->stage->descent;
  if (status == HOOKE_OK && descent->rows == NULL) status = hk_descent_create(s->it, descent);
  descent->t = s->t;
  s->found->has_energy = descent->rows != NULL;
  return status;
}

/* ---- where the search stands ---- */

static void stop_motion(struct search *s) {
  for (int a = 0; a < 3; a++)
    memset(s->it->motion->v[a], 0, (size_t)s->it->motion->n * sizeof(double));
  hk_movers_read(s->system, s->it->motion, s->stage->body.own);
}

/* The residual at the motion, at rest. */
static int32_t find_residual(struct search *s) {
  const hooke_system *system = s->system;
  const struct hk_motion *m = s->it->motion;
  struct hk_rest *found = s->found;
  double sum[3] = {0.0};
  const int32_t status = hk_integrator_forces(s->it, s->t);
  double most = 0.0;
  for (int64_t p = 0; p < m->n; p++) {
    if (system->constrained[p] || hk_is_carried(system, p)) continue;
    double f[3];
    for (int a = 0; a < 3; a++)
      f[a] = m->f[a][p] + system->inertia[p] * hk_fall(system, p, a), sum[a] += f[a];
    most = fmax(most, hk_length3(f));
  }
  hk_movers_push(system, m, s->stage->body.own, s->push);
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_body *body = system->mover[k].thing;
    const double *push = s->push + HOOKE_PUSH * k;
    double reach = 0.0;
    for (int64_t j = 0; j < body->count; j++)
      reach = fmax(reach, hk_length3(body->place + 3 * j));
    hk_add3(body->mass, push, sum);
    most = fmax(most, body->mass * hk_length3(push));
    if (reach > 0.0) most = fmax(most, hk_length3(push + 3) / reach);
  }
  const double length = hk_length3(sum);
  found->residual = most;
  for (int a = 0; a < 3; a++)
    found->fall[a] = length > 0.0 ? sum[a] / length : 0.0;
  return status;
}

static double extent_of(const struct hk_motion *m) {
  double extent = 0.0;
  for (int a = 0; a < 3; a++)
    extent = fmax(extent, hk_largest(m->n, m->q[a]));
  return extent;
}

/* What a force may be by rounding of positions: by the diagonal of the last matrix. */
static double find_rounding(const struct search *s) {
  const struct hk_reduced *reduced = &s->stage->reduced;
  const int64_t n = s->system->particle_count;
  double most = 0.0;
  for (int64_t p = 0; p < n; p++) {
    double stiffness = 0.0;
    for (int a = 0; a < 3; a++)
      stiffness += reduced->block[a * n + p] - reduced->diagonal[p];
    if (!s->system->constrained[p]) most = fmax(most, stiffness / reduced->alpha);
  }
  return ROUNDINGS * extent_of(s->it->motion) * most;
}

/* The largest force along a spring, and that or the largest weight. */
static double find_scale(struct search *s) {
  const hooke_system *system = s->system;
  double *q = s->stage->moved, strength;
  hk_rows_from_components(system->particle_count, s->it->motion->q, q);
  hk_springs_largest(system->springs, s->t, q, &s->found->largest_force, &strength);
  double scale = s->found->largest_force;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    const double g[3] = {hk_fall(system, p, 0), hk_fall(system, p, 1), hk_fall(system, p, 2)};
    scale = fmax(scale, system->inertia[p] * hk_length3(g));
  }
  return scale;
}

/* ---- steps ---- */

/* How far the farthest particle has come from where it started. */
static double distance(const struct search *s) {
  const struct hk_motion *m = s->it->motion;
  double most = 0.0;
  for (int64_t p = 0; p < m->n; p++) {
    const double d[3] = {m->q[0][p] - s->from[3 * p], m->q[1][p] - s->from[3 * p + 1],
                         m->q[2][p] - s->from[3 * p + 2]};
    most = fmax(most, hk_length3(d));
  }
  return most;
}

/* 1 if the motion is where the search may go on: finite, and no higher than before. */
static int may_stay(struct search *s, double energy, double slack) {
  if (!hk_motion_is_finite(s->it)) return 0;
  if (!s->found->has_energy) return 1;
  const double now = hk_descent_energy(&s->stage->descent, s->it);
  return now <= energy + (slack + s->stage->descent.slack);
}

/* One step over h, from rest. `ok` is 0 where it finds no solution, or would climb; then the motion is as far
 * down as it came, or back. */
static int32_t step(struct search *s, double h, int *ok) {
  struct hk_stage *stage = s->stage;
  const int guarded = s->found->has_energy, descends = guarded && s->system->mover_count == 0;
  const double energy = guarded ? hk_descent_energy(&stage->descent, s->it) : 0.0,
               slack = stage->descent.slack;
  hk_stage_save(stage, stage->start);
  const struct hk_equations equations = {s->t, h, stage->start, stage->start + s->it->size, h};
  const int32_t status = descends ? hk_stage_descend(stage, &equations) : hk_stage_solve(stage, &equations);
  if (status != HOOKE_OK && status != HOOKE_SOLVER_FAILED) return status;
  if (s->still.constrained_count > 0) hk_motion_hold(&s->still, s->it->motion);
  if (status == HOOKE_OK) hk_body_stage_end(stage);
  const int stays = (status == HOOKE_OK || descends) && may_stay(s, energy, slack);
  *ok = stays && status == HOOKE_OK;
  if (!stays) hk_motion_restore(s->it->motion, stage->start);
  stop_motion(s);
  s->found->moved = distance(s);
  return HOOKE_OK;
}

/* 1 if the search is over, with its result. */
static int is_over(struct search *s, double before, int *stalled) {
  struct hk_rest *found = s->found;
  const double scale = find_scale(s),
               allowed = fmax(AT_REST * (scale > 0.0 ? scale : s->begun), find_rounding(s));
  *stalled = found->residual < FALLEN * before ? 0 : *stalled + 1;
  if (found->residual <= LEAST * scale || (found->residual <= allowed && *stalled >= 1)) return 1;
  if (found->moved > FAR * s->extent && found->residual > STAYS * before) found->lack = HOOKE_FALLS;
  return found->lack != HOOKE_RESTS;
}

static int32_t search(struct search *s) {
  struct hk_rest *found = s->found;
  double bound = NAN;
  const double most = fmax(MOST_WORK, MOST_EVALUATIONS * hk_work_of_evaluation(s->system));
  int stalled = 0;
  int32_t status =
      hk_step_bound_at(s->system, s->system->overdamped ? "heun" : "verlet", s->from, NULL, &bound);
  const double first = bound > 0.0 && bound < INFINITY ? FIRST * bound : WITHOUT_STIFFNESS;
  if (status == HOOKE_OK) status = find_residual(s);
  s->begun = found->residual;
  for (double h = first; status == HOOKE_OK && found->residual != 0.0;) {
    const double before = found->residual;
    const int64_t counted = s->it->count.nonlinear_iterations;
    int ok;
    found->lack = hk_budget_ends(s->budget, "rest") ? HOOKE_REST_SPENT : found->lack;
    if (found->steps + found->failures >= MOST_STEPS || hk_work_of(s->it) > most)
      found->lack = HOOKE_TOO_LONG;
    if (found->lack != HOOKE_RESTS) break;
    status = step(s, h, &ok);
    if (status != HOOKE_OK) break;
    found->steps += ok;
    found->failures += !ok;
    status = find_residual(s);
    if (ok && status == HOOKE_OK && is_over(s, before, &stalled)) break;
    const int easy = s->it->count.nonlinear_iterations - counted <= FEW;
    h = ok ? fmin((easy ? MUCH_LONGER : LONGER) * h, LONGEST * first) : SHORTER * h;
    if (h < SHORTEST * first || !isfinite(found->residual)) {
      found->lack = HOOKE_NO_WAY_ON;
      break;
    }
  }
  return status;
}

int32_t hk_rest_find(const hooke_system *system, double t, double *q, struct hk_budget *budget,
                     struct hk_rest *found) {
  struct search s = {.system = system, .from = q, .t = t, .budget = budget, .found = found};
  *found = (struct hk_rest){.lack = HOOKE_RESTS};
  int32_t status = hold_obstacles(&s);
  if (status == HOOKE_OK) status = place_driven(&s, q);
  s.push = hk_new(HOOKE_PUSH * system->mover_count, sizeof(double));
  double *zeros = hk_new(3 * system->particle_count, sizeof(double));
  if (s.push == NULL || zeros == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = create_integrator(&s);
  if (status == HOOKE_OK) {
    const double diagonal = hk_diagonal(system->particle_count, q);
    s.extent = diagonal > 0.0 ? diagonal : 1.0;
    hk_motion_load(&s.still, s.it->motion, q, zeros);
    stop_motion(&s);
    status = search(&s);
    if (budget && budget->stopped)
      status = hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop");
    else if (status == HOOKE_STOPPED && budget && budget->spent)
      status = HOOKE_OK, found->lack = HOOKE_REST_SPENT;
    if (status != HOOKE_OK) found->lack = HOOKE_REST_SPENT;
    (void)find_scale(&s);
    hk_motion_store(s.it->motion, q, zeros);
    found->iterations = s.it->count.nonlinear_iterations;
    found->force_evaluations = s.it->count.force_evaluations;
  }
  hooke_integrator_destroy(s.it);
  hk_free(s.rest.obstacles.obstacle);
  hk_free(s.push);
  hk_free(zeros);
  return status;
}
