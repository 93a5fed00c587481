#include "integrate/solve/stage.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Residual of the linear equations: what is asked for, and what is good enough where rounding allows no
 * more. */
static const double RESIDUAL = 1e-12, FAR_ENOUGH = 1e-9;
/* A correction below this share of the change of velocity is the last one: Newton squares what is left.
 * Rounding of positions and velocities sets a floor. */
static const double CORRECTION = 1e-9, POSITION_FLOOR = 1e-13, VELOCITY_FLOOR = 1e-14;
static const double SAFE_RESIDUAL = 1e-2, LEAST_NEWTON_SHARE = 0.1, LEAST_SAFE_SHARE = 1e-8;
enum { MOST_ITERATIONS = 200, LONGEST_PAUSE = 16, MEMORY = 8 };

int32_t hk_stage_create(hooke_integrator *it, struct hk_stage *stage) {
  stage->one_iteration = strcmp(hooke_options_text(it->options, "newton"), "one-iteration") == 0;
  stage->begin = hk_new(6 * it->size, sizeof(double));
  if (stage->begin == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += 6 * it->size * (int64_t)sizeof(double);
  stage->v = stage->begin + 2 * it->size;
  stage->change = stage->v + it->size;
  stage->right = stage->change + it->size;
  stage->moved = stage->right + it->size;
  return hk_reduced_create(it, HOOKE_REDUCED_GENERAL, &stage->reduced);
}

void hk_stage_release(struct hk_stage *stage) {
  hk_reduced_release(&stage->reduced);
  hk_free(stage->begin);
}

static double largest(int64_t count, const double *x) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++)
    most = fmax(most, fabs(x[k]));
  return most;
}

/* The motion at velocity v (3n), held particles where the drives have said. */
static void place(struct hk_stage *stage, const double *v) {
  const hooke_integrator *it = stage->reduced.integrator;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    const double *old = stage->place + a * m->n;
    for (int64_t p = 0; p < m->n; p++) {
      m->v[a][p] = v[a * m->n + p];
      m->q[a][p] = old[p] + stage->a * m->v[a][p];
    }
  }
  if (it->system->held_count > 0) hk_motion_hold(it->system, m);
}

/* right = -F at the motion's place, and its square F.M^-1 F. */
static int32_t find_residual(struct hk_stage *stage, double *square) {
  hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double h = stage->a;
  const int32_t status = hk_integrator_forces(it, stage->t);
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    const double *speed = stage->speed + a * m->n, g = h * system->gravity[a];
    for (int64_t p = 0; p < m->n; p++) {
      const double w = system->inverse_mass[p];
      const double value = w == 0.0 ? 0.0 : h * m->f[a][p] - system->mass[p] * ((m->v[a][p] - speed[p]) - g);
      stage->right[a * m->n + p] = value;
      sum += w * (value * value);
    }
  }
  *square = sum;
  return status;
}

/* How far the state at the beginning moves with dv = 0: to place + a v, and held particles to where they
 * are held. */
static void find_moved(const struct hk_stage *stage, double *dq, double *dv) {
  const hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  const int64_t n = system->particle_count;
  for (int64_t k = 0; k < 3 * n; k++) {
    const int held = system->held[k % n] != 0;
    const double q = stage->begin[k], v = stage->begin[3 * n + k];
    dq[k] = held ? it->motion->q[k / n][k % n] - q : (stage->place[k] - q) + stage->a * v;
    dv[k] = held ? it->motion->v[k / n][k % n] - v : 0.0;
  }
}

/* The first iteration, from the state at the beginning; the guess is its result. */
static int32_t linearise(struct hk_stage *stage) {
  hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double h = stage->a, t = stage->t;
  const int64_t n = m->n;
  const double *old = stage->begin + 3 * n;
  place(stage, old);
  find_moved(stage, stage->v, stage->change);
  hk_motion_restore(m, stage->begin);
  int32_t status = hk_integrator_forces(it, t);
  if (status != HOOKE_OK) return status;
  it->count.nonlinear_iterations++;
  hk_reduced_set(&stage->reduced, t, h * h, h);
  status = hk_reduced_change(&stage->reduced, stage->v, stage->change, stage->moved);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < 3 * n; k++) {
    const int64_t p = k % n;
    const double weight = system->has_gravity ? system->mass[p] * system->gravity[k / n] : 0.0;
    stage->right[k] = h * ((m->f[k / n][p] + stage->moved[k]) + weight);
    if (system->held[p] == 0) stage->right[k] -= system->mass[p] * (old[k] - stage->speed[k]);
  }
  struct hk_solution solution;
  status = hk_reduced_solve(&stage->reduced, stage->right, RESIDUAL, stage->change, &solution);
  if (status == HOOKE_OK && stage->one_iteration && solution.residual > FAR_ENOUGH)
    status = hk_reduced_fail(&stage->reduced, &solution);
  for (int64_t k = 0; k < 3 * n; k++)
    stage->v[k] = old[k] + stage->change[k];
  return status;
}

static int is_last_correction(const struct hk_stage *stage) {
  const hooke_integrator *it = stage->reduced.integrator;
  const struct hk_motion *m = it->motion;
  const double h = stage->a;
  double change = 0.0, speed = 0.0, extent = 0.0;
  for (int a = 0; a < 3; a++) {
    const double *old = stage->begin + (3 + a) * m->n, *v = stage->v + a * m->n;
    speed = fmax(speed, largest(m->n, v));
    extent = fmax(extent, largest(m->n, m->q[a]));
    for (int64_t p = 0; p < m->n; p++)
      change = fmax(change, fabs(v[p] - old[p]));
  }
  return largest(3 * m->n, stage->change) <=
         CORRECTION * change + VELOCITY_FLOOR * speed + POSITION_FLOOR * extent / h;
}

/* -F at the guess moved by a share of the correction. */
static int32_t try_share(struct hk_stage *stage, double share, double *square) {
  hooke_integrator *it = stage->reduced.integrator;
  for (int64_t j = 0; j < it->size; j++)
    stage->moved[j] = stage->v[j] + share * stage->change[j];
  place(stage, stage->moved);
  return find_residual(stage, square);
}

static double downhill(const struct hk_stage *stage) {
  const hooke_integrator *it = stage->reduced.integrator;
  return hk_dot(it->size, stage->right, stage->change);
}

/* Moves the guess along Newton's correction until F.M^-1 F is below `allowed`, the worst of the last few
 * (Grippo, Lampariello and Lucidi 1986: across a stiff spring the way is narrow and bent, and leads over
 * higher ground), or along a safe one until F.dv hardly falls any more; `square` is F.M^-1 F there. Shares
 * below `least` are not tried. */
static int32_t search(struct hk_stage *stage, int newton, double least, double allowed, double *square,
                      int *found) {
  hooke_integrator *it = stage->reduced.integrator;
  const double slope = downhill(stage);
  *found = 0;
  for (double share = 1.0; share >= least && !*found;) {
    double there, lowest; /* the latter of the parabola through what is known */
    const int32_t status = try_share(stage, share, &there);
    if (status != HOOKE_OK) return status;
    if (newton) {
      *found = there <= allowed - 2e-4 * share * *square;
      lowest = share * share * *square / (there - *square + 2.0 * share * *square);
    } else {
      const double left = downhill(stage);
      *found = left >= -0.5 * slope;
      lowest = share * slope / (slope - left);
    }
    if (*found) {
      memcpy(stage->v, stage->moved, (size_t)it->size * sizeof(double));
      *square = there;
    }
    share = lowest > 0.1 * share ? fmin(lowest, 0.5 * share) : 0.1 * share;
  }
  return HOOKE_OK;
}

/* Newton's correction at the guess, where the motion is; `last` if it is small enough to be taken as it
 * is. */
static int32_t newton_step(struct hk_stage *stage, double allowed, double *square, int *found, int *last) {
  hooke_integrator *it = stage->reduced.integrator;
  const double h = stage->a;
  struct hk_solution solution;
  hk_reduced_set(&stage->reduced, stage->t, h * h, h);
  const int32_t status = hk_reduced_solve(&stage->reduced, stage->right, RESIDUAL, stage->change, &solution);
  *found = *last = 0;
  /* a correction with numbers that are none leads nowhere */
  if (status != HOOKE_OK || solution.residual > FAR_ENOUGH || !(downhill(stage) >= 0.0)) return status;
  *last = is_last_correction(stage);
  for (int64_t j = 0; *last && j < it->size; j++)
    stage->v[j] += stage->change[j];
  return *last ? HOOKE_OK : search(stage, 1, LEAST_NEWTON_SHARE, allowed, square, found);
}

/* A correction by conjugate gradients that end where the matrix is not positive. It leads downhill in the
 * energy of the step wherever the guess is, but slowly. */
static int32_t safe_step(struct hk_stage *stage, double *square, int *found) {
  const double h = stage->a;
  place(stage, stage->v);
  const int32_t status = find_residual(stage, square);
  if (status != HOOKE_OK) return status;
  hk_reduced_set(&stage->reduced, stage->t, h * h, h);
  const int32_t solved = hk_reduced_descend(&stage->reduced, stage->right, SAFE_RESIDUAL, stage->change);
  if (solved != HOOKE_OK) return solved;
  return search(stage, 0, LEAST_SAFE_SHARE, INFINITY, square, found);
}

static int32_t give_up(const struct hk_stage *stage, int iterations, double first, double square,
                       const char *why) {
  const hooke_integrator *it = stage->reduced.integrator;
  return hk_fail(
      HOOKE_SOLVER_FAILED, NULL,
      "%s found no solution for the step from t = %.6g s: after %d Newton iterations %s "
      "(residual %.3g, at first %.3g, in units of momentum over root mass); take a smaller step, or "
      "newton one-iteration",
      it->method->name, it->t, iterations, why, sqrt(square), sqrt(first));
}

/* The result of the first iteration, if that makes sense, else the old velocity. */
static int32_t choose_guess(struct hk_stage *stage, double *square) {
  hooke_integrator *it = stage->reduced.integrator;
  place(stage, stage->v);
  const int32_t status = find_residual(stage, square);
  if (status != HOOKE_OK || *square < INFINITY) return status;
  memcpy(stage->v, stage->begin + it->size, (size_t)it->size * sizeof(double));
  place(stage, stage->v);
  return find_residual(stage, square);
}

static double worst_of(const double past[MEMORY]) {
  double worst = past[0];
  for (int k = 1; k < MEMORY; k++)
    worst = fmax(worst, past[k]);
  return worst;
}

/* Newton wherever it works. Where the matrix is not positive, as it may be for springs under compression,
 * Newton may lead to a saddle of the energy of the step or nowhere; then safe steps, more of them each time
 * that Newton fails again. */
static int32_t converge(struct hk_stage *stage) {
  hooke_integrator *it = stage->reduced.integrator;
  double square;
  int wait = 0, pause = 0;
  int32_t status = choose_guess(stage, &square);
  const double first = square;
  double past[MEMORY] = {square};
  for (int k = 1; k <= MOST_ITERATIONS && status == HOOKE_OK && square != 0.0; k++) {
    int found = 0, last = 0;
    it->count.nonlinear_iterations++;
    if (wait == 0) {
      status = newton_step(stage, worst_of(past), &square, &found, &last);
      if (status != HOOKE_OK || last) return status;
      pause = found ? 0 : pause == 0 ? 1 : pause < LONGEST_PAUSE ? 2 * pause : pause;
      wait = pause;
    } else {
      wait--;
    }
    if (!found) status = safe_step(stage, &square, &found);
    if (status == HOOKE_OK && !found) return give_up(stage, k, first, square, "no way leads on");
    past[k % MEMORY] = square;
  }
  if (status != HOOKE_OK || square == 0.0) return status;
  return give_up(stage, MOST_ITERATIONS, first, square, "it still changes");
}

int32_t hk_stage_solve(struct hk_stage *stage, double t, double a, const double *at, const double *speed) {
  stage->t = t;
  stage->a = a;
  stage->place = at;
  stage->speed = speed;
  hk_motion_save(stage->reduced.integrator->motion, stage->begin);
  hk_reduced_drop_factor(&stage->reduced); /* a stage depends on its numbers alone */
  int32_t status = linearise(stage);
  if (status == HOOKE_OK && !stage->one_iteration) status = converge(stage);
  if (status == HOOKE_OK) place(stage, stage->v);
  return status;
}

int32_t hk_stage_step(hooke_integrator *it, double *start, hk_stages_of_step *step) {
  const struct hk_counts before = it->count;
  hk_motion_save(it->motion, start);
  const int32_t status = step(it);
  if (status == HOOKE_OK) return HOOKE_OK;
  if (status == HOOKE_SOLVER_FAILED) it->count.nonlinear_failures++;
  if (status == HOOKE_STOPPED) it->count = before;
  hk_motion_restore(it->motion, start);
  return status;
}
