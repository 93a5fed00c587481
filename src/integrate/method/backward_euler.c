/* Backward Euler: v' = v + h a(t + h, q', v'), q' = q + h v'. Order 1, stable at every step. With
 * F(v') = M (v' - v - h g) - h f(t + h, q + h v', v'), K = df/dq and D = df/dv,
 *   one iteration  (M - h D - h^2 K) dv = h (f + M g + h K v), all at the old state (Baraff and Witkin 1998)
 *   converged      from there on, Newton: (M - h D - h^2 K) dv = -F at the last guess, with a line search on
 *                  F.M^-1 F
 * Driven particles are at their new position in F. The first iteration has their change of position and
 * velocity, multiplied by K and D, on its right-hand side. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/reduced.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Residual of the linear equations: requested, and acceptable if rounding allows no more. */
static const double RESIDUAL = 1e-12, FAR_ENOUGH = 1e-9;
/* A correction below this fraction of the change of velocity is the last one: Newton squares the error.
 * Rounding of positions and velocities sets a floor. */
static const double CORRECTION = 1e-9, POSITION_FLOOR = 1e-13, VELOCITY_FLOOR = 1e-14;
static const double SAFE_RESIDUAL = 1e-2, LEAST_NEWTON_SHARE = 0.1, LEAST_SAFE_SHARE = 1e-8;
enum { MOST_ITERATIONS = 200, LONGEST_PAUSE = 16, MEMORY = 8 };

struct backward_euler {
  int32_t one_iteration;
  struct hk_reduced reduced;
  double *start; /* q and v at the start of the step, 6 components of n */
  double *v, *change, *right,
      *moved; /* the guess, the correction, F or a right-hand side, scratch; 3n each */
};

static int32_t create(hooke_integrator *it) {
  struct backward_euler *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->one_iteration = strcmp(hooke_options_text(it->options, "newton"), "one-iteration") == 0;
  own->start = hk_new(6 * it->size, sizeof(double));
  if (own->start == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += 6 * it->size * (int64_t)sizeof(double);
  own->v = own->start + 2 * it->size;
  own->change = own->v + it->size;
  own->right = own->change + it->size;
  own->moved = own->right + it->size;
  return hk_reduced_create(it, HOOKE_REDUCED_GENERAL, &own->reduced);
}

static void destroy(hooke_integrator *it) {
  struct backward_euler *own = it->own;
  hk_reduced_release(&own->reduced);
  hk_free(own->start);
  hk_free(own);
  it->own = NULL;
}

static double largest(int64_t count, const double *x) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++)
    most = fmax(most, fabs(x[k]));
  return most;
}

/* The motion at velocity v (3n): q + h v, constrained particles at the end of the step. */
static void place(hooke_integrator *it, const double *v) {
  const struct backward_euler *own = it->own;
  struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  for (int a = 0; a < 3; a++) {
    const double *old = own->start + a * m->n;
    for (int64_t p = 0; p < m->n; p++) {
      m->v[a][p] = v[a * m->n + p];
      m->q[a][p] = old[p] + h * m->v[a][p];
    }
  }
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, m);
}

/* right = -F at the motion's position, and its square F.M^-1 F. */
static int32_t find_residual(hooke_integrator *it, double *square) {
  struct backward_euler *own = it->own;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  const int32_t status = hk_integrator_forces(it, hk_integrator_next_time(it));
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    const double *old = own->start + (3 + a) * m->n, g = h * system->gravity[a];
    for (int64_t p = 0; p < m->n; p++) {
      const double w = system->inverse_mass[p];
      const double value = w == 0.0 ? 0.0 : h * m->f[a][p] - system->mass[p] * ((m->v[a][p] - old[p]) - g);
      own->right[a * m->n + p] = value;
      sum += w * (value * value);
    }
  }
  *square = sum;
  return status;
}

/* Displacement of the old state with dv = 0: h v, and constrained particles to the end of the step. */
static void find_moved(const hooke_integrator *it, double *dq, double *dv) {
  const struct backward_euler *own = it->own;
  const hooke_system *system = it->system;
  const double h = it->schedule.step;
  const int64_t n = system->particle_count;
  for (int64_t k = 0; k < 3 * n; k++) {
    const int held = system->constrained[k % n] != 0;
    const double q = own->start[k], v = own->start[3 * n + k];
    dq[k] = held ? it->motion->q[k / n][k % n] - q : h * v;
    dv[k] = held ? it->motion->v[k / n][k % n] - v : 0.0;
  }
}

/* The first iteration, from the old state; the guess is its result. */
static int32_t linearise(hooke_integrator *it) {
  struct backward_euler *own = it->own;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const double h = it->schedule.step, t = hk_integrator_next_time(it);
  const int64_t n = m->n;
  const double *old = own->start + 3 * n;
  place(it, old);
  find_moved(it, own->v, own->change);
  hk_motion_restore(m, own->start);
  int32_t status = hk_integrator_forces(it, t);
  if (status != HOOKE_OK) return status;
  it->count.nonlinear_iterations++;
  hk_reduced_set(&own->reduced, t, h * h, h);
  status = hk_reduced_change(&own->reduced, own->v, own->change, own->moved);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < 3 * n; k++) {
    const int64_t p = k % n;
    const double weight = system->has_gravity ? system->mass[p] * system->gravity[k / n] : 0.0;
    own->right[k] = h * ((m->f[k / n][p] + own->moved[k]) + weight);
  }
  struct hk_solution solution;
  status = hk_reduced_solve(&own->reduced, own->right, RESIDUAL, own->change, &solution);
  if (status == HOOKE_OK && own->one_iteration && solution.residual > FAR_ENOUGH)
    status = hk_reduced_fail(&own->reduced, &solution);
  for (int64_t k = 0; k < 3 * n; k++)
    own->v[k] = old[k] + own->change[k];
  return status;
}

static int is_last_correction(const hooke_integrator *it) {
  const struct backward_euler *own = it->own;
  const struct hk_motion *m = it->motion;
  const double h = it->schedule.step;
  double change = 0.0, speed = 0.0, extent = 0.0;
  for (int a = 0; a < 3; a++) {
    const double *old = own->start + (3 + a) * m->n, *v = own->v + a * m->n;
    speed = fmax(speed, largest(m->n, v));
    extent = fmax(extent, largest(m->n, m->q[a]));
    for (int64_t p = 0; p < m->n; p++)
      change = fmax(change, fabs(v[p] - old[p]));
  }
  return largest(3 * m->n, own->change) <=
         CORRECTION * change + VELOCITY_FLOOR * speed + POSITION_FLOOR * extent / h;
}

/* -F at the guess moved by a fraction of the correction. */
static int32_t try_share(hooke_integrator *it, double share, double *square) {
  struct backward_euler *own = it->own;
  for (int64_t j = 0; j < it->size; j++)
    own->moved[j] = own->v[j] + share * own->change[j];
  place(it, own->moved);
  return find_residual(it, square);
}

static double downhill(const hooke_integrator *it) {
  const struct backward_euler *own = it->own;
  return hk_dot(it->size, own->right, own->change);
}

/* Moves the guess along Newton's correction until F.M^-1 F is below `allowed`, the worst of the last few
 * (Grippo, Lampariello and Lucidi 1986: across a stiff spring the valley is narrow and curved, so that F.M^-1
 * F has to rise in between), or along a safe one until F.dv hardly falls any more; `square` is F.M^-1 F
 * there. Fractions below `least` are not tried. */
static int32_t search(hooke_integrator *it, int newton, double least, double allowed, double *square,
                      int *found) {
  struct backward_euler *own = it->own;
  const double slope = downhill(it);
  *found = 0;
  for (double share = 1.0; share >= least && !*found;) {
    double there, lowest; /* the latter from the parabola through the known values */
    const int32_t status = try_share(it, share, &there);
    if (status != HOOKE_OK) return status;
    if (newton) {
      *found = there <= allowed - 2e-4 * share * *square;
      lowest = share * share * *square / (there - *square + 2.0 * share * *square);
    } else {
      const double left = downhill(it);
      *found = left >= -0.5 * slope;
      lowest = share * slope / (slope - left);
    }
    if (*found) {
      memcpy(own->v, own->moved, (size_t)it->size * sizeof(double));
      *square = there;
    }
    share = lowest > 0.1 * share ? fmin(lowest, 0.5 * share) : 0.1 * share;
  }
  return HOOKE_OK;
}

/* Newton's correction at the guess, where the motion is; `last` if it is small enough to be accepted
 * unchecked. */
static int32_t newton_step(hooke_integrator *it, double allowed, double *square, int *found, int *last) {
  struct backward_euler *own = it->own;
  const double h = it->schedule.step;
  struct hk_solution solution;
  hk_reduced_set(&own->reduced, hk_integrator_next_time(it), h * h, h);
  const int32_t status = hk_reduced_solve(&own->reduced, own->right, RESIDUAL, own->change, &solution);
  *found = *last = 0;
  /* a non-finite correction is useless */
  if (status != HOOKE_OK || solution.residual > FAR_ENOUGH || !(downhill(it) >= 0.0)) return status;
  *last = is_last_correction(it);
  for (int64_t j = 0; *last && j < it->size; j++)
    own->v[j] += own->change[j];
  return *last ? HOOKE_OK : search(it, 1, LEAST_NEWTON_SHARE, allowed, square, found);
}

/* A correction by conjugate gradients that end where the matrix is not positive. It decreases the energy of
 * the step from any guess, but slowly. */
static int32_t safe_step(hooke_integrator *it, double *square, int *found) {
  struct backward_euler *own = it->own;
  const double h = it->schedule.step;
  place(it, own->v);
  const int32_t status = find_residual(it, square);
  if (status != HOOKE_OK) return status;
  hk_reduced_set(&own->reduced, hk_integrator_next_time(it), h * h, h);
  const int32_t solved = hk_reduced_descend(&own->reduced, own->right, SAFE_RESIDUAL, own->change);
  if (solved != HOOKE_OK) return solved;
  return search(it, 0, LEAST_SAFE_SHARE, INFINITY, square, found);
}

static int32_t give_up(const hooke_integrator *it, int iterations, double first, double square,
                       const char *why) {
  return hk_fail(
      HOOKE_SOLVER_FAILED, NULL,
      "backward-euler found no solution for the step from t = %.6g s: after %d Newton iterations %s "
      "(residual %.3g, at first %.3g, in units of momentum over root mass); take a smaller step, or "
      "newton one-iteration",
      it->t, iterations, why, sqrt(square), sqrt(first));
}

/* The result of the first iteration if it is reasonable, otherwise the old velocity. */
static int32_t choose_guess(hooke_integrator *it, double *square) {
  struct backward_euler *own = it->own;
  place(it, own->v);
  const int32_t status = find_residual(it, square);
  if (status != HOOKE_OK || *square < INFINITY) return status;
  memcpy(own->v, own->start + it->size, (size_t)it->size * sizeof(double));
  place(it, own->v);
  return find_residual(it, square);
}

static double worst_of(const double past[MEMORY]) {
  double worst = past[0];
  for (int k = 1; k < MEMORY; k++)
    worst = fmax(worst, past[k]);
  return worst;
}

/* Newton wherever it works. Where the matrix is not positive, as with springs under compression, Newton may
 * lead to a saddle of the energy of the step or nowhere; then safe steps, more of them each time that Newton
 * fails again. */
static int32_t converge(hooke_integrator *it) {
  double square;
  int wait = 0, pause = 0;
  int32_t status = choose_guess(it, &square);
  const double first = square;
  double past[MEMORY] = {square};
  for (int k = 1; k <= MOST_ITERATIONS && status == HOOKE_OK && square != 0.0; k++) {
    int found = 0, last = 0;
    it->count.nonlinear_iterations++;
    if (wait == 0) {
      status = newton_step(it, worst_of(past), &square, &found, &last);
      if (status != HOOKE_OK || last) return status;
      pause = found ? 0 : pause == 0 ? 1 : pause < LONGEST_PAUSE ? 2 * pause : pause;
      wait = pause;
    } else {
      wait--;
    }
    if (!found) status = safe_step(it, &square, &found);
    if (status == HOOKE_OK && !found) return give_up(it, k, first, square, "no way leads on");
    past[k % MEMORY] = square;
  }
  if (status != HOOKE_OK || square == 0.0) return status;
  return give_up(it, MOST_ITERATIONS, first, square, "it still changes");
}

static int32_t step(hooke_integrator *it) {
  struct backward_euler *own = it->own;
  const struct hk_counts before = it->count;
  hk_motion_save(it->motion, own->start);
  hk_reduced_drop_factor(&own->reduced); /* a step depends on its start alone */
  int32_t status = linearise(it);
  if (status == HOOKE_OK && !own->one_iteration) status = converge(it);
  if (status == HOOKE_OK) {
    place(it, own->v);
    return HOOKE_OK;
  }
  if (status == HOOKE_SOLVER_FAILED) it->count.nonlinear_failures++;
  if (status == HOOKE_STOPPED) it->count = before; /* a continued run repeats the step */
  hk_motion_restore(it->motion, own->start);
  return status;
}

const struct hk_method hk_backward_euler = {
    .name = "backward-euler",
    .summary = "fixed step, order 1, implicit; stable at every step, damps everything",
    .built = 1,
    .order = 1,
    .second_order = 1,
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note = "stable at every step; accuracy limits it, and in large steps whether the "
                          "equations can be solved"},
    .no_first_order = "solves its step with the derivative of the forces, and x' = phi(t, x) brings none",
    .create = create,
    .destroy = destroy,
    .begin = hk_fixed_begin,
    .step = step,
    .store = hk_fixed_store};
