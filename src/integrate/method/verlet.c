/* Velocity Verlet (Swope and others 1982), order 2, as kick, drift, kick:
 *   v_half = v + h/2 a(t, q, v),  q' = q + h v_half,  v' = v_half + h/2 a(t + h, q', v')
 * Where forces depend on velocities, the second kick takes them at the predicted velocity
 *   v_pred = v_half + h/2 a(t, q, v)
 * (Groot and Warren 1997, with lambda = 1), which is of order 2 and keeps nothing across steps; or, where
 * that may be unstable, solves for the new velocity, with D = df/dv at (q', v_pred):
 *   (M - h/2 D) (v' - v_pred) = h/2 (f(t + h, q', v_pred) + M g) - M (v_pred - v_half)
 * D is that of the springs, altitude springs and drag: a callback sees v_pred. A spring that only pulls
 * counts if it pulls at (q', v_pred), else not at all. Drag alone, or with explicit damping, is a division.
 */
#include "integrate/method/verlet.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/reduced.h"
#include "model/force/altitude.h"
#include "model/force/force.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

/* The residual, over that of the predicted velocity: what the solve leaves is a part of what the step does,
 * or, where damping is so strong that the prediction is beside the point, of the velocity before it. */
static const double PART = 1e-3, EXACT = 1e-9, LEAST_RESIDUAL = 1e-13;

struct verlet {
  int32_t implicit, predicts;
  int32_t keeps;             /* forces at the end of a step are those at the next start, */
  int32_t kept;              /* which are in motion->f, and only drag is missing to them */
  int32_t drifted;           /* the motion has done the first kick of the next step, and its drift */
  struct hk_reduced reduced; /* implicit */
  double *numbers;           /* all arrays below */
  double *half[3];           /* predicts: velocities half-way, with room as in the motion */
  double *right, *change;    /* implicit: 3n each */
};

static int32_t create(hooke_integrator *it) {
  struct verlet *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  const int callback = it->system->force != NULL;
  const int64_t stride = hk_motion_stride(it->motion);
  own->implicit =
      hk_system_is_damped(it->system, ~HOOKE_UNIFORM) && !it->explicit_damping && !it->motion->zero;
  const int drag_is_between = it->system->brake > 0.0 && it->system->sums_after_drag;
  const int movers = it->system->mover_count > 0;
  own->predicts = own->implicit || it->explicit_damping || callback || drag_is_between || movers;
  own->keeps = !own->predicts || (!callback && !hk_system_is_damped(it->system, 0));
  if (!own->predicts) return HOOKE_OK;
  if ((own->implicit || callback) && hk_integrator_keep_start(it) != HOOKE_OK) return HOOKE_NO_MEMORY;
  const int64_t numbers = 3 * stride + (own->implicit ? 2 * it->size : 0);
  own->numbers = hk_new(numbers, sizeof(double));
  if (own->numbers == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += numbers * (int64_t)sizeof(double);
  for (int a = 0; a < 3; a++)
    own->half[a] = own->numbers + a * stride;
  if (!own->implicit) return HOOKE_OK;
  own->right = own->numbers + 3 * stride;
  own->change = own->right + it->size;
  return hk_reduced_create(it, HOOKE_REDUCED_SYMMETRIC, NULL, &own->reduced);
}

static void destroy(hooke_integrator *it) {
  struct verlet *own = it->own;
  hk_reduced_release(&own->reduced);
  hk_free(own->numbers);
  hk_free(own);
  it->own = NULL;
}

int32_t hk_verlet_begin(hooke_integrator *it, const hooke_state *state) {
  struct verlet *own = it->own;
  own->kept = own->drifted = 0;
  return hk_fixed_begin(it, state);
}

void hk_verlet_forget(hooke_integrator *it) {
  struct verlet *own = it->own;
  it->count.force_evaluations += own->kept; /* counts to be added by first_forces() again */
  own->kept = 0;
}

static void move_of(const hooke_integrator *it, int32_t kind, struct hk_move *move) {
  const struct verlet *own = it->own;
  hk_integrator_move_of(it, kind, it->schedule.step / 2.0, it->schedule.step, move);
  move->half = own->half[0];
}

/* The first kick, and the drift. The force is that of the step before, if it has left it. */
static int32_t begin_step(hooke_integrator *it) {
  struct verlet *own = it->own;
  struct hk_move move;
  int32_t status = HOOKE_OK;
  move_of(it, own->predicts ? HOOKE_PREDICT : HOOKE_KICK_THEN_DRIFT, &move);
  if (own->kept)
    hk_integrator_move_on(it, &move);
  else
    status = hk_integrator_move(it, it->t, &move);
  if (own->keeps && !own->kept && it->k > 0) it->count.force_evaluations--; /* as the run that came here */
  own->kept = 0;
  return status;
}

/* A step of springs whose forces depend on positions alone, and of drag. If nobody sees its end, the next one
 * begins in the same pass; a drive may still stop before that one. */
static int32_t step_undamped(hooke_integrator *it) {
  struct verlet *own = it->own;
  const int goes_on = it->goes_on && it->system->drive_count == 0;
  int32_t status = own->drifted ? HOOKE_OK : begin_step(it);
  if (status != HOOKE_OK) return status;
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
  struct hk_move move;
  move_of(it, goes_on ? HOOKE_KICK_DRIFT_KICK : HOOKE_KICK, &move);
  status = hk_integrator_move(it, hk_integrator_next_time(it), &move);
  own->drifted = status == HOOKE_OK && goes_on;
  own->kept = status == HOOKE_OK && !goes_on;
  return status;
}

/* ---- the second kick, solved for ---- */

/* The right side; returns how large it is beside the whole step's kick, or the inverse if that is below 1,
 * both as squares of velocities times masses. */
static double set_right(const hooke_integrator *it) {
  const struct verlet *own = it->own;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const double half = it->schedule.step / 2.0;
  double left = 0.0, kicked = 0.0;
  for (int a = 0; a < 3; a++) {
    double *right = own->right + a * m->n;
    const double *factor = system->gravity_factor, g = system->fall[a];
    for (int64_t p = 0; p < m->n; p++) {
      const double mass = system->mass[p], by = m->v[a][p] - own->half[a][p];
      const double force = system->falls ? m->f[a][p] + mass * (factor ? factor[p] * g : g) : m->f[a][p];
      right[p] = half * force - mass * by;
      left += right[p] * (system->inverse_mass[p] * right[p]);
      kicked += system->constrained[p] ? 0.0 : (mass * by) * by;
    }
  }
  const double beside = sqrt(left / (4.0 * kicked));
  return beside > 1.0 ? 1.0 / beside : beside;
}

static int32_t solve(hooke_integrator *it) {
  struct verlet *own = it->own;
  const struct hk_motion *m = it->motion;
  const double part = set_right(it) * (it->exactly ? EXACT : PART);
  const double tolerance = part > LEAST_RESIDUAL ? part : LEAST_RESIDUAL;
  hk_reduced_set(&own->reduced, hk_integrator_next_time(it), 0.0, it->schedule.step / 2.0);
  struct hk_solution solution;
  int32_t status = hk_reduced_solve(&own->reduced, own->right, tolerance, own->change, &solution);
  if (status == HOOKE_OK && !solution.converged)
    status = hk_fail(HOOKE_SOLVER_FAILED, NULL,
                     "%s could not solve the linear equations of the step from t = %.6g s: the residual is "
                     "%.3g of the right-hand side after %lld iterations; take a smaller step",
                     it->method->name, it->t, solution.residual, (long long)solution.iterations);
  for (int a = 0; a < 3 && status == HOOKE_OK; a++) {
    for (int64_t p = 0; p < m->n; p++)
      m->v[a][p] += own->change[a * m->n + p];
  }
  return status;
}

/* ---- a step that predicts the velocity ---- */

static int32_t second_kick(hooke_integrator *it) {
  const struct verlet *own = it->own;
  const double t = hk_integrator_next_time(it);
  struct hk_move move;
  move_of(it, HOOKE_CORRECT, &move);
  if (!own->implicit) return hk_integrator_move(it, t, &move);
  const int32_t status = hk_integrator_forces(it, t);
  return status == HOOKE_OK ? solve(it) : status;
}

static int32_t step(hooke_integrator *it) {
  struct verlet *own = it->own;
  if (!own->predicts) return step_undamped(it);
  int32_t status = begin_step(it);
  if (status != HOOKE_OK) return status;
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion);
  status = second_kick(it);
  own->kept = status == HOOKE_OK && own->keeps;
  return status;
}

/* ---- the choice of damping ---- */

/* Whether a step takes the damping explicitly, at the predicted velocity, or solves for it. With A = h^2 M^-1
 * K and B = h M^-1 C the explicit step is stable where A + 2 B <= 4; of one mode it is up to A < 4 - 2 B +
 * B^2, B < 2. The bound below holds wherever the particles are: of every element it takes the stiffness and
 * the damping in all directions, those of springs that follow time the largest of all times, and gives each
 * particle its row of g g^T. So the choice depends on the system and the step alone, and a run that goes on
 * from any of its states makes the same one. */
static const double MARGIN = 0.8; /* of the bound */

static double larger(double along, double across, double over) {
  return fmax(0.0, fmax(along, across)) / over;
}

/* Stiffness and damping of all elements of these kinds at every particle, 2n. */
static void add_rows(const hooke_system *system, double t, int32_t kinds, double *stiffness,
                     double *damping) {
  struct hk_element room;
  struct hk_elements at;
  hk_begin_elements(system, t, system->position, NULL, &at);
  at.kinds = kinds;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    e = hk_element_at_most(&at, e, &room);
    const double k = larger(e->k_along, e->k_across, e->over), c = larger(e->c_along, e->c_across, e->over);
    for (int j = 0; j < e->count; j++) {
      const double row = hk_element_row(system->constrained, e, j);
      stiffness[e->particle[j]] += row * k;
      damping[e->particle[j]] += row * c;
    }
  }
}

/* The largest step [s] that is stable for certain, at any positions, and that which damping alone allows.
 * HOOKE_NO_MEMORY. */
static int32_t find_bound(const hooke_system *system, double *bound, double *damped) {
  const int64_t n = system->particle_count;
  double *stiffness = hk_new(2 * n, sizeof(double)), *damping = stiffness ? stiffness + n : NULL;
  if (stiffness == NULL) return HOOKE_NO_MEMORY;
  add_rows(system, HOOKE_STIFFEST, HOOKE_LOOPED, stiffness, damping);
  add_rows(system, 0.0, ~(HOOKE_UNIFORM | HOOKE_LOOPED), stiffness, damping);
  *bound = *damped = INFINITY;
  for (int64_t p = 0; p < n; p++) {
    const double w = system->inverse_mass[p], k = w * stiffness[p], c = w * damping[p];
    if (k > 0.0 || c > 0.0) *bound = fmin(*bound, 4.0 / (c + sqrt(c * c + 4.0 * k)));
    if (c > 0.0) *damped = fmin(*damped, 2.0 / c);
  }
  hk_free(stiffness);
  return HOOKE_OK;
}

/* 1 if no bound holds wherever the particles are, and however fast: with dampers of springs that only pull,
 * with curves whose stiffness has no bound, and with altitude springs, of which one of seven altitudes acts,
 * with weights of its own. */
static int32_t depends_on_state(const hooke_system *system) {
  int32_t depends = system->altitudes->count > 0 ||
                    hk_springs_curved(system->springs, HOOKE_AS_GIVEN, system->position).unbounded > 0;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const int32_t both = HOOKE_RUN_DAMPED | HOOKE_RUN_PULL_ONLY;
    depends |= (system->springs->run[r].shape & both) == both;
  }
  return depends;
}

static int32_t find_explicit_step(const hooke_system *system, double *step, double *damped) {
  const int solves = hk_system_is_damped(system, ~HOOKE_UNIFORM) && !hk_system_is_not_linear(system);
  *step = *damped = solves ? 0.0 : INFINITY;
  if (isinf(*step) || depends_on_state(system)) return HOOKE_OK;
  const int32_t status = find_bound(system, step, damped);
  *step *= MARGIN;
  return status;
}

/* Damping is taken at the predicted velocity: of bodies, and where it depends on velocities, by which no
 * choice may be made. */
static int32_t predict_always(hooke_integrator *it, const char *asked, const char *unknown) {
  it->explicit_damping = hk_system_is_damped(it->system, ~HOOKE_UNIFORM);
  if (strcmp(asked, "implicit") != 0) return HOOKE_OK;
  return hk_fail(HOOKE_UNSUITED, "verlet_damping", "implicit does not know %s; allowed: auto, explicit",
                 unknown);
}

/* Decides by the system, the step and the option `verlet_damping`, whose value it sets to what it decided. */
static int32_t choose(hooke_integrator *it) {
  const char *asked = hooke_options_text(it->options, "verlet_damping");
  if (it->system->mover_count > 0) return predict_always(it, asked, "rigid bodies yet");
  if (hk_system_is_not_linear(it->system))
    return predict_always(it, asked, "forces that are not linear in velocities");
  double most = 0.0, damped;
  if (!hk_system_is_damped(it->system, ~HOOKE_UNIFORM)) {
    if (it->by_tiles) it->by_tiles |= HOOKE_MOTION_KEEPS;
    return HOOKE_OK;
  }
  const int32_t status =
      strcmp(asked, "auto") == 0 ? find_explicit_step(it->system, &most, &damped) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  it->explicit_damping = strcmp(asked, "explicit") == 0 || it->schedule.step <= most;
  if (!it->explicit_damping) it->by_tiles = 0;
  return hooke_options_set_text(it->options, "verlet_damping",
                                it->explicit_damping ? "explicit" : "implicit");
}

/* ---- the method ---- */

static const struct hk_steps steps = {create,          destroy, hk_verlet_forget,
                                      hk_verlet_begin, step,    hk_fixed_store};

const struct hk_method hk_verlet = {
    .name = "verlet",
    .summary = "fixed step, order 2; keeps undamped motion bounded, and damping leaves its limit",
    .order = 2,
    .judge = "rk4",
    .takes = HOOKE_TAKES_BODIES,
    .stability = {.kind = HOOKE_STABLE_BY_K, .damps_implicitly = 1},
    .with_bodies = {.kind = HOOKE_STABLE_BY_PREDICTION},
    .by_tiles = 1,
    .explicit_step = find_explicit_step,
    .choose = choose,
    .steps = &steps};
