#include "integrate/solve/stage.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "model/force/force.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

/* Of what is still to be corrected: the error of the linear equations of a correction. Downhill the last one
 * is to leave less than what a potential can tell. */
static const double LINEAR_SHARE = 0.1, DOWNHILL_SHARE = 0.01, LINEAR_OF_TOLERANCE = 0.1;
/* Residuals of the whole matrix: the least and the largest that are asked for, and of one iteration. */
static const double LEAST_RESIDUAL = 1e-12, LARGEST_RESIDUAL = 1e-2, FAR_ENOUGH = 1e-9;
/* Corrections that do not fall below this share of the ones before are slow. No error falls faster than by
 * the other, as far as the tolerance is concerned. */
static const double SLOW = 0.5, FASTEST = 0.1;
/* The share of compression in the matrix: none; where that is slow; downhill. */
static const double NONE = 0.0, HALF = 0.5, ALL = 1.0;
static const double LEAST_SHARE = 1e-4, LEAST_OF_DESCENT = 1e-12, ROUNDINGS = 1.0, ALL_ROUNDINGS = 100.0;
/* One iteration is taken where it leaves no more than this of the residual of the linearised equations. */
static const double ONE_LEAVES = 1.0;
/* How far F.dv may turn along a correction. With inertia stiff springs that it stretches sideways are no
 * obstacle: the next one lets them go. Without, it would lead away from where motion goes. */
static const double MOST_TURN = 100.0, MOST_TURN_OVERDAMPED = 0.5;
static const double ARMIJO = 1e-4;
enum { MOST_ITERATIONS = 100, FINEST_SPLIT = 1024, QUARTER = FINEST_SPLIT / 4 };

static int32_t allocate(struct hk_stage *stage, int64_t states) {
  hooke_integrator *it = stage->reduced.integrator;
  const int64_t own = stage->body.count > 0,
                numbers = (2 + states) * stage->state_size + (5 + own) * stage->size;
  double *block = hk_new(numbers, sizeof(double));
  stage->start = block;
  if (block == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += numbers * (int64_t)sizeof(double);
  block += stage->state_size;
  stage->begin = hk_part(&block, stage->state_size);
  stage->old = own ? hk_part(&block, stage->size) : stage->begin + it->size;
  stage->v = hk_part(&block, stage->size);
  stage->change = hk_part(&block, stage->size);
  stage->right = hk_part(&block, stage->size);
  stage->moved = hk_part(&block, stage->size);
  stage->straight = hk_part(&block, stage->size);
  stage->others = block;
  return HOOKE_OK;
}

/* Reads the options `newton`, `newton_tolerance` and `linear_solver`. */
static int32_t create(hooke_integrator *it) {
  struct hk_stage *stage = hk_new(1, sizeof *stage);
  if (stage == NULL) return HOOKE_NO_MEMORY;
  it->own = stage;
  stage->one_iteration = strcmp(hooke_options_text(it->options, "newton"), "one-iteration") == 0;
  stage->tolerance = hooke_options_number(it->options, "newton_tolerance");
  stage->order = it->method->order;
  stage->overdamped = it->system->overdamped;
  int32_t status = hk_integrator_keep_start(it);
  if (status == HOOKE_OK) status = hk_body_stage_create(it, &stage->body);
  if (status == HOOKE_OK && stage->overdamped &&
      !hk_forces_do_work(it->system)) /* else U is not that of motion */
    status = hk_descent_create(it, &stage->descent);
  const struct hk_more_unknowns more = hk_body_stage_unknowns(stage);
  if (status == HOOKE_OK) status = hk_reduced_create(it, HOOKE_REDUCED_GENERAL, &more, &stage->reduced);
  stage->size = it->size + more.count;
  stage->state_size = 2 * it->size + HOOKE_BODY_NUMBERS * stage->body.count;
  return status == HOOKE_OK ? allocate(stage, it->method->states) : status;
}

static void destroy(hooke_integrator *it) {
  struct hk_stage *stage = it->own;
  hk_body_stage_release(&stage->body);
  hk_descent_release(&stage->descent);
  hk_reduced_release(&stage->reduced);
  hk_free(stage->start);
  hk_free(stage);
  it->own = NULL;
}

void hk_stage_save(const struct hk_stage *stage, double *state) {
  const hooke_integrator *it = stage->reduced.integrator;
  hk_motion_save(it->motion, state);
  for (int64_t k = 0; k < HOOKE_BODY_NUMBERS * stage->body.count; k++)
    state[2 * it->size + k] = stage->body.own[k];
}

static void restore(struct hk_stage *stage, double *state) {
  const hooke_integrator *it = stage->reduced.integrator;
  hk_motion_restore(it->motion, state);
  for (int64_t k = 0; k < HOOKE_BODY_NUMBERS * stage->body.count; k++)
    stage->body.own[k] = state[2 * it->size + k];
}

/* ---- the equations ---- */

/* The motion at velocity v (3n), constrained particles where the drives have said. */
static void place(struct hk_stage *stage, const double *v) {
  const hooke_integrator *it = stage->reduced.integrator;
  struct hk_motion *m = it->motion;
  for (int a = 0; a < 3; a++) {
    const double *old = stage->at.place + a * m->n;
    for (int64_t p = 0; p < m->n; p++) {
      m->v[a][p] = v[a * m->n + p];
      m->q[a][p] = old[p] + stage->at.a * m->v[a][p];
    }
  }
  hk_body_stage_place(stage, v);
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, m);
}

/* The factor of the force, b. */
static double gain(const struct hk_stage *stage) {
  return stage->overdamped ? 1.0 : stage->at.a;
}

static double speed_of(const struct hk_stage *stage, int64_t k) {
  return stage->overdamped ? 0.0 : stage->at.speed[k];
}

/* right = -F at velocity v, where it leaves the motion. */
static int32_t find_residual(struct hk_stage *stage, const double *v) {
  hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double h = gain(stage);
  place(stage, v);
  const int32_t status = hk_integrator_forces(it, stage->at.t);
  for (int a = 0; a < 3; a++) {
    const double *factor = system->gravity_factor, fall = h * system->fall[a];
    for (int64_t p = 0; p < m->n; p++) {
      const double w = system->inverse_mass[p], g = factor ? factor[p] * fall : fall;
      stage->right[a * m->n + p] =
          w == 0.0 ? 0.0
                   : h * m->f[a][p] - system->inertia[p] * ((m->v[a][p] - speed_of(stage, a * m->n + p)) - g);
    }
  }
  hk_body_stage_residual(stage, v);
  return status;
}

/* Derivatives where the motion is. */
static void set_matrix(struct hk_stage *stage) {
  const double a = stage->at.a;
  hk_reduced_drop_factor(&stage->reduced); /* a stage depends on its numbers alone */
  hk_reduced_set(&stage->reduced, stage->at.t, a * gain(stage), stage->overdamped ? 0.0 : a);
  hk_body_stage_set(stage);
}

/* How far the state at the beginning moves with dv = 0: to place + a v, and particles that are constrained or
 * in bodies to where they are now. */
static void find_moved(const struct hk_stage *stage, double *dq, double *dv) {
  const hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  const int64_t n = system->particle_count;
  for (int64_t a = 0, k = 0; a < 3; a++) {
    for (int64_t p = 0; p < n; p++, k++) {
      const int held = system->constrained[p] != 0 || hk_is_carried(system, p);
      const double q = stage->begin[k], v = stage->begin[3 * n + k];
      dq[k] = held ? it->motion->q[a][p] - q : (stage->at.place[k] - q) + stage->at.a * v;
      dv[k] = held ? it->motion->v[a][p] - v : 0.0;
    }
  }
}

/* right = -F of the equations linearised at the beginning, at the velocities there, and the matrix there. */
static int32_t linearise(struct hk_stage *stage) {
  hooke_integrator *it = stage->reduced.integrator;
  const hooke_system *system = it->system;
  struct hk_motion *m = it->motion;
  const int64_t n = m->n;
  const double *old = stage->old;
  place(stage, old);
  find_moved(stage, stage->v, stage->change);
  hk_body_stage_aim(stage);
  hk_motion_restore(m, stage->begin);
  int32_t status = hk_integrator_forces(it, stage->at.t);
  if (status != HOOKE_OK) return status;
  set_matrix(stage);
  status = hk_reduced_change(&stage->reduced, stage->v, stage->change, stage->moved);
  for (int64_t a = 0, k = 0; a < 3; a++) {
    const double *factor = system->gravity_factor, fall = system->fall[a];
    for (int64_t p = 0; p < n; p++, k++) {
      const double g = factor ? factor[p] * fall : fall;
      const double force = m->f[a][p], turn = stage->overdamped ? stage->moved[k] : force;
      const double w = system->inverse_mass[p];
      stage->straight[k] = old[k] + (stage->overdamped ? 1.0 : stage->at.length) * (w * turn + g);
      stage->right[k] = gain(stage) * ((force + stage->moved[k]) + system->inertia[p] * g);
      if (system->constrained[p] == 0) stage->right[k] -= system->inertia[p] * (old[k] - speed_of(stage, k));
    }
  }
  hk_body_stage_linearise(stage);
  return status;
}

/* ---- errors ---- */

static double dot(const struct hk_stage *stage, const double *x, const double *y) {
  return hk_dot(stage->size, x, y);
}

/* The length of v - from in the norm of masses. */
static double distance(const struct hk_stage *stage, const double *from) {
  const hooke_system *system = stage->reduced.integrator->system;
  const int64_t n = system->particle_count;
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    const double *to = stage->v + a * n, *of = from + a * n;
    for (int64_t p = 0; p < n; p++)
      sum += system->constrained[p] ? 0.0 : system->inertia[p] * ((to[p] - of[p]) * (to[p] - of[p]));
  }
  return sqrt(sum + hk_body_stage_distance(stage, from));
}

/* The error of the guess that is allowed. A step of order 1 is off by h/2 of the change of velocity. One of
 * order 2 is so by some 1/4 of h times what velocities have left the straight line, or by less than a tenth
 * of h times their change where fast motion bends that line. Rounding of positions and velocities sets a
 * floor. */
static double allowed_error(const struct hk_stage *stage, double *rounding) {
  const hooke_integrator *it = stage->reduced.integrator;
  const struct hk_motion *m = it->motion;
  const double change = distance(stage, stage->old);
  double own = change / 2.0, extent = 0.0, speed = 0.0;
  if (stage->order > 1) own = fmin(change / 10.0, distance(stage, stage->straight) / 4.0);
  for (int a = 0; a < 3; a++) {
    extent = fmax(extent, hk_largest(m->n, m->q[a]));
    speed = fmax(speed, hk_largest(m->n, m->v[a]));
  }
  *rounding =
      ROUNDINGS * DBL_EPSILON * (extent / stage->at.a + speed) * sqrt(hk_reduced_trace(&stage->reduced));
  return stage->tolerance * own + *rounding;
}

/* ---- iterations ---- */

struct iteration {
  double allowed;      /* error */
  double rounding;     /* its share of that */
  double size, before; /* of this correction and the last one, in the norm of S; before 0: there is none */
  double fraction;     /* of the last correction that was taken */
  int slow;            /* slow ones in a row */
  double height;       /* the potential at the guess, where that descends */
};

static int32_t give_up(const struct hk_stage *stage, int iterations, const struct iteration *now,
                       const char *why) {
  const hooke_integrator *it = stage->reduced.integrator;
  return hk_fail(HOOKE_SOLVER_FAILED, NULL,
                 "%s found no solution for the step from t = %.6g s, nor for parts of it down "
                 "to 1/%d: after %d Newton iterations %s (the last correction is %.3g, allowed "
                 "is an error of %.3g, in velocity times root mass); take a smaller step",
                 it->method->name, it->t, (int)FINEST_SPLIT, iterations, why, now->size, now->allowed);
}

static void see_slope(struct hk_stage *stage, struct iteration *now, int may, int *found) {
  const double slope = dot(stage, stage->right, stage->change);
  *found = may && slope >= 0.0 && slope < INFINITY;
  if (*found) now->size = sqrt(slope);
}

/* The whole matrix at the guess, by iterations for any matrix. `found` is 0 where its correction leads
 * nowhere. */
static int32_t whole_correction(struct hk_stage *stage, struct iteration *now, int *found) {
  const double wanted = LINEAR_OF_TOLERANCE * now->allowed / now->before;
  const double residual = fmin(LARGEST_RESIDUAL, fmax(LEAST_RESIDUAL, wanted));
  struct hk_solution solution;
  const int32_t status = hk_reduced_solve(&stage->reduced, stage->right, residual, stage->change, &solution);
  see_slope(stage, now, solution.residual <= fmax(residual, FAR_ENOUGH), found);
  return status;
}

/* S with this share of the compression of springs. `found` is 0 where that proves not to be positive;
 * downhill, what was found before leads on. */
static int32_t correction(struct hk_stage *stage, struct iteration *now, double share, int *found) {
  struct hk_solution solution;
  const int32_t status = hk_reduced_correct(&stage->reduced, share, stage->right,
                                            stage->descends ? DOWNHILL_SHARE : LINEAR_SHARE,
                                            LINEAR_OF_TOLERANCE * now->allowed, stage->change, &solution);
  const int positive = share == NONE || solution.converged;
  see_slope(stage, now, positive || (stage->descends && solution.iterations > 0), found);
  return status;
}

/* 1 if the guess may move by this share of the correction: where F.dv, which would be 0 at the least of a
 * potential, has not turned by far; or the potential is lower by a part of what its slope promises (Armijo
 * 1966). */
static int may_move(struct hk_stage *stage, struct iteration *now, double fraction, double left) {
  const double slope = now->size * now->size, a = stage->at.a, of_potential = stage->overdamped ? a : 1.0;
  double slack;
  const double turn = stage->overdamped ? MOST_TURN_OVERDAMPED : MOST_TURN;
  if (!stage->descends) return left >= -turn * slope && left < INFINITY;
  const double height =
      hk_descent_potential(&stage->descent, stage->reduced.integrator, a, stage->moved, &slack);
  if (!(height <= now->height - ARMIJO * fraction * of_potential * slope + slack)) return 0;
  now->height = height;
  return 1;
}

static int32_t search(struct hk_stage *stage, struct iteration *now, int *found) {
  const double slope = now->size * now->size, least = stage->descends ? LEAST_OF_DESCENT : LEAST_SHARE;
  *found = 0;
  for (double fraction = 1.0; fraction >= least && !*found;) {
    for (int64_t j = 0; j < stage->size; j++)
      stage->moved[j] = stage->v[j] + fraction * stage->change[j];
    const int32_t status = find_residual(stage, stage->moved);
    if (status != HOOKE_OK) return status;
    const double left = dot(stage, stage->right, stage->change), lowest = fraction * slope / (slope - left);
    *found = may_move(stage, now, fraction, left);
    now->fraction = fraction;
    fraction = lowest > 0.1 * fraction ? fmin(lowest, 0.5 * fraction) : 0.1 * fraction;
  }
  if (*found) memcpy(stage->v, stage->moved, (size_t)stage->size * sizeof(double));
  return HOOKE_OK;
}

/* 1 if what is left after this correction is allowed, as the last two foretell it; or if corrections that are
 * down at rounding become no smaller. */
static int is_last(const struct iteration *now) {
  if (now->before > 0.0 && now->size > SLOW * now->before && now->size <= ALL_ROUNDINGS * now->rounding)
    return 1;
  const double rate =
      now->before > 0.0 && now->fraction == 1.0 ? fmax(now->size / now->before, FASTEST) : SLOW;
  return rate < 1.0 && rate / (1.0 - rate) * now->size <= now->allowed;
}

static int32_t iterate(struct hk_stage *stage, struct iteration *now, int *found) {
  const int whole = stage->reduced.integrator->system->force && now->slow > 1;
  const double share = stage->descends ? ALL : now->slow > 0 ? HALF : NONE;
  int32_t status = HOOKE_OK;
  *found = 0;
  hk_body_stage_aim(stage);
  set_matrix(stage);
  now->allowed = allowed_error(stage, &now->rounding);
  if (whole) status = whole_correction(stage, now, found);
  if (status == HOOKE_OK && !*found && share > NONE) status = correction(stage, now, share, found);
  if (status == HOOKE_OK && !*found) status = correction(stage, now, NONE, found);
  return status;
}

/* Corrections until what is left is allowed. The last one is taken without asking, but not downhill. */
static int32_t converge(struct hk_stage *stage, double height) {
  hooke_integrator *it = stage->reduced.integrator;
  struct iteration now = {.fraction = 1.0, .height = height};
  int32_t status = find_residual(stage, stage->v);
  for (int k = 1; k <= MOST_ITERATIONS && status == HOOKE_OK; k++) {
    int found;
    it->count.nonlinear_iterations++;
    status = iterate(stage, &now, &found);
    if (status != HOOKE_OK) break;
    if (!found) return give_up(stage, k, &now, "numbers are not finite");
    const int last = is_last(&now);
    if (last && !stage->descends) {
      hk_add_multiple(stage->size, 1.0, stage->change, stage->v);
      return HOOKE_OK;
    }
    now.slow = now.before > 0.0 && (now.fraction < 1.0 || now.size > SLOW * now.before) ? now.slow + 1 : 0;
    now.before = now.size;
    status = search(stage, &now, &found);
    if (last || status != HOOKE_OK) return status;
    if (!found) return give_up(stage, k, &now, "no way leads on");
  }
  return status == HOOKE_OK ? give_up(stage, MOST_ITERATIONS, &now, "it still changes") : status;
}

/* From the state at the beginning: exact in its derivatives for one iteration, else a guess. */
static int32_t first_correction(struct hk_stage *stage, double *open) {
  hooke_integrator *it = stage->reduced.integrator;
  struct hk_solution solution = {0};
  it->count.nonlinear_iterations++;
  int32_t status = linearise(stage);
  *open = hk_reduced_square(&stage->reduced, stage->right);
  if (status != HOOKE_OK) return status;
  if (stage->one_iteration) {
    const double residual = fmax(LEAST_RESIDUAL, LINEAR_OF_TOLERANCE * stage->tolerance);
    status = hk_reduced_solve(&stage->reduced, stage->right, residual, stage->change, &solution);
    if (solution.residual > fmax(residual, FAR_ENOUGH)) *open = 0.0;
  } else {
    status =
        hk_reduced_correct(&stage->reduced, NONE, stage->right, LINEAR_SHARE, 0.0, stage->change, &solution);
  }
  for (int64_t k = 0; k < stage->size; k++)
    stage->v[k] = stage->old[k] + stage->change[k];
  return status;
}

/* 1 if the residual at v says that one iteration was enough; rounding is. */
static int one_is_enough(struct hk_stage *stage, double open) {
  double rounding;
  const double floor = allowed_error(stage, &rounding);
  const double left = hk_reduced_square(&stage->reduced, stage->right);
  return left <= ONE_LEAVES * ONE_LEAVES * open || left <= floor * floor;
}

static int32_t solve_from_beginning(struct hk_stage *stage) {
  double open;
  hk_body_stage_begin(stage);
  int32_t status = first_correction(stage, &open);
  if (status == HOOKE_OK && stage->one_iteration) {
    status = find_residual(stage, stage->v);
    if (status != HOOKE_OK || one_is_enough(stage, open)) return status;
  }
  /* numbers that are none are no guess, nor is one iteration that went astray */
  if (stage->one_iteration || !(distance(stage, stage->old) < INFINITY))
    memcpy(stage->v, stage->old, (size_t)stage->size * sizeof(double));
  if (status == HOOKE_OK) status = converge(stage, NAN);
  if (status == HOOKE_OK) place(stage, stage->v);
  return status;
}

/* ---- the potential ---- */

/* The guess that leaves free particles where they are. */
static void begin_at_rest(struct hk_stage *stage) {
  for (int64_t k = 0; k < stage->reduced.integrator->size; k++)
    stage->v[k] = (stage->begin[k] - stage->at.place[k]) / stage->at.a;
}

static double potential(struct hk_stage *stage, double *slack) {
  return hk_descent_potential(&stage->descent, stage->reduced.integrator, stage->at.a, stage->v, slack);
}

static int is_right(struct hk_stage *stage, double height, double slack) {
  double own;
  const double reached = potential(stage, &own);
  return reached <= height + (slack + own);
}

static int32_t rises(const hooke_integrator *it, const char *what) {
  return hk_fail(HOOKE_SOLVER_FAILED, NULL,
                 "%s found no solution for the step from t = %.6g s, nor for parts of it, that does not "
                 "raise the %s; take a smaller step",
                 it->method->name, it->t, what);
}

/* Downhill all the way from where the stage begins. */
static int32_t descend(struct hk_stage *stage, double height, double slack) {
  begin_at_rest(stage);
  stage->descends = 1;
  const int32_t status = converge(stage, height);
  stage->descends = 0;
  place(stage, stage->v);
  if (status != HOOKE_OK) return status;
  return is_right(stage, height, slack) ? HOOKE_OK
                                        : rises(stage->reduced.integrator, "potential of its equations");
}

int32_t hk_stage_descend(struct hk_stage *stage, const struct hk_equations *equations) {
  double slack;
  stage->at = *equations;
  stage->descent.t = equations->t;
  hk_stage_save(stage, stage->begin);
  begin_at_rest(stage);
  const double height = potential(stage, &slack);
  return descend(stage, height, slack);
}

int32_t hk_stage_solve_by(struct hk_stage *stage, const struct hk_equations *equations,
                          hk_first_solution *first) {
  hooke_integrator *it = stage->reduced.integrator;
  const int guarded = stage->descent.rows != NULL;
  double height = NAN, slack = 0.0;
  stage->at = *equations;
  stage->descent.t = equations->t;
  hk_stage_save(stage, stage->begin);
  if (guarded) {
    if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
    begin_at_rest(stage);
    height = potential(stage, &slack);
  }
  const int32_t status = first(stage);
  if (!guarded || (status != HOOKE_OK && status != HOOKE_SOLVER_FAILED)) return status;
  if (status == HOOKE_OK && is_right(stage, height, slack)) return HOOKE_OK;
  return descend(stage, height, slack);
}

int32_t hk_stage_solve(struct hk_stage *stage, const struct hk_equations *equations) {
  return hk_stage_solve_by(stage, equations, solve_from_beginning);
}

/* ---- steps and their parts ---- */

static double time_of(const hooke_integrator *it, int64_t part) {
  if (part == FINEST_SPLIT) return hk_integrator_next_time(it);
  return it->t + (double)part / FINEST_SPLIT * it->schedule.step;
}

/* One part of the step, from where the motion is. */
static int32_t take_part(struct hk_stage *stage, int64_t done, int64_t parts) {
  hooke_integrator *it = stage->reduced.integrator;
  const double end = time_of(it, done + parts);
  const int guarded = stage->descent.rows != NULL && !hk_system_takes_work(it->system);
  const double energy = guarded ? hk_descent_energy(&stage->descent, it) : 0.0, slack = stage->descent.slack;
  hk_stage_save(stage, stage->start);
  int32_t status = parts == FINEST_SPLIT ? HOOKE_OK : hk_integrator_drive(it, end);
  if (status == HOOKE_OK)
    status = it->method->solved(
        it,
        (struct hk_span_of_time){time_of(it, done), (double)parts / FINEST_SPLIT * it->schedule.step, end});
  if (status == HOOKE_OK && it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
  if (status == HOOKE_OK) hk_body_stage_end(stage);
  stage->raised = status == HOOKE_OK && guarded &&
                  !(hk_descent_energy(&stage->descent, it) <= energy + (slack + stage->descent.slack));
  if (stage->raised) status = rises(it, "energy");
  it->count.force_evaluations += status == HOOKE_OK && stage->overdamped;
  return status == HOOKE_OK ? hk_integrator_flow(it, end) : status;
}

/* Where stages find no solution a step is taken in two halves, and these likewise, down to a thousandth;
 * every such failure is counted. After a failure that remains, the motion is back at the start. A step that
 * a callback stopped is taken again by whoever goes on, so it counts nothing. */
static int32_t step(hooke_integrator *it) {
  struct hk_stage *stage = it->own;
  const struct hk_counts before = it->count;
  int32_t status = HOOKE_OK;
  hk_movers_read(it->system, it->motion, stage->body.own);
  for (int64_t done = 0, parts = FINEST_SPLIT; done < FINEST_SPLIT;) {
    status = take_part(stage, done, parts);
    if (status == HOOKE_OK) {
      done += parts;
      if (done % (2 * parts) == 0) parts *= 2;
      continue;
    }
    if (status != HOOKE_SOLVER_FAILED) break;
    it->count.nonlinear_failures++;
    if (parts == (stage->raised && it->method->swings ? QUARTER : 1)) break;
    restore(stage, stage->start);
    parts /= 2;
  }
  if (status == HOOKE_OK) return HOOKE_OK;
  if (status == HOOKE_STOPPED) it->count = before;
  return status;
}

const struct hk_steps hk_implicit_steps = {create, destroy, NULL, hk_fixed_begin, step, hk_fixed_store};
