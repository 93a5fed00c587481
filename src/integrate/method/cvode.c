/* CVODE (Cohen and Hindmarsh 1996; Hindmarsh et al. 2005): backward differentiation formulas with Newton and
 * GMRES, and Adams-Moulton with fixed-point iteration. */
#include "integrate/integrator.h"

#if HOOKE_HAVE_SUNDIALS

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/sundials_problem.h"

#include <cvode/cvode.h>
#include <math.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

/* ---- the highest order of cvode-bdf, adapted during a run ---- */

/* BDF of order 1 and 2 damps every mode that steps do not resolve. Order 3 and above amplifies weakly damped
 * ones, at omega h of order one, until the error control limits the step there although the motion does not
 * require it.
 *
 * So if steps are longer than LONG/omega, with omega and the damping ratio of the fastest modes, and that
 * ratio is below the stable one of order 3, order 2 becomes the highest, before those modes have grown. If
 * steps then stay shorter than SHORT/omega, accuracy limits them, and the higher orders return. CVODE keeps
 * its history in the current order, so each change is a start from order 1; hence the budget. */
struct hk_order_choice {
  int32_t low;               /* 1: order 2 is currently the highest */
  int64_t steps, looks;      /* since the order was last chosen: steps, and windows of steps examined */
  int64_t window_steps;      /* steps in the current window, and its start time */
  double window_begun;       /* [s] */
  int64_t short_windows;     /* in a row */
  int64_t quiet_until;       /* no check before so many steps */
  int64_t quiet_next;        /* and their number the next time that orders 3 to 5 return */
  double frequency, damping; /* angular frequency [rad/s] and damping ratio of the fastest modes */
  double *scratch;           /* two vectors of unknowns */
};

enum {
  WINDOW = 50, /* steps of the mean, with all orders and with the low ones */
  LOW_WINDOW = 100,
  LOW_START = 200, /* steps before the first check with the low orders */
  BUDGET = 10,     /* successive windows of short steps before the higher orders return */
  QUIET = 500,  /* steps before the next check with all orders; 4 times as many each time that they return */
  REFRESH = 10, /* windows before the fastest modes are computed again */
  ITERATIONS = 15
};
static const double LOOSE_RTOL = 1e-6, LONG = 2.0, SHORT = 1.0;
/* Cosine of 86.03 degrees: Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section
 * V.2. */
static const double DAMPING_OF_ORDER_3 = 0.0692;

/* Creates own->choice if there is a choice: the options leave max_order open and rtol is not tight.
 * HOOKE_NO_MEMORY. */
static int32_t create_choice(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (own->unknowns.rows == NULL || !own->unknowns.has_v ||
      !isnan(hooke_options_number(it->options, "max_order")) ||
      hooke_options_number(it->options, "rtol") < LOOSE_RTOL)
    return HOOKE_OK;
  own->choice = hk_new(1, sizeof *own->choice);
  if (own->choice == NULL) return HOOKE_NO_MEMORY;
  own->choice->scratch = hk_new(2 * own->unknowns.size, sizeof(double));
  it->own_memory += 2 * own->unknowns.size * (int64_t)sizeof(double);
  return own->choice->scratch ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void release_choice(struct hk_order_choice *choice) {
  if (choice == NULL) return;
  hk_free(choice->scratch);
  hk_free(choice);
}

/* Restarts at time t with orders up to 5. */
static void begin_choice(struct hk_order_choice *c, double t) {
  *c = (struct hk_order_choice){.window_begun = t, .quiet_next = QUIET, .scratch = c->scratch};
}

/* ---- the fastest modes ---- */

/* Both over the unknowns that are velocities; x and p are scratch. */
static double product_of(const hooke_integrator *it, const struct hk_unknowns *u, const double *x,
                         const double *p) {
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < u->stretch_count; k++) {
      const struct hk_stretch_of_free *s = &u->stretch[k];
      const double *mass = it->system->inertia + s->particle;
      const int64_t from = a * u->free_count + s->unknown;
      for (int64_t j = 0; j < s->count; j++)
        sum += mass[j] * x[from + j] * p[from + j];
    }
  }
  return sum;
}

/* Power iterations with the derivative of the forces by the positions, from pseudo-random numbers; then the
 * damping of the result. A few are enough: the mean over the fastest modes is needed. Frequency 0 if nothing
 * is stiff. */
static int32_t find_fastest_modes(hooke_integrator *it, struct hk_order_choice *c, const double *y) {
  struct hk_unknowns *u = &((struct hk_sundials *)it->own)->unknowns;
  const int64_t half = u->size / 2;
  c->frequency = c->damping = 0.0;
  double *x = c->scratch, *p = x + u->size, squared = 0.0;
  uint64_t number = 1;
  if (hk_unknowns_linearise(it, u, it->t, y) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
  for (int64_t k = 0; k < half; k++) {
    number = number * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX */
    x[k] = (double)(number >> 40) / 8388608.0 - 1.0;
    x[half + k] = 0.0;
  }
  for (int i = 0; i < ITERATIONS; i++) {
    if (hk_unknowns_product(it, u, it->t, x, p) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
    const double size = product_of(it, u, x, x), grown = product_of(it, u, p + half, p + half);
    squared = sqrt(grown / size);
    if (!(squared > 0.0) || !isfinite(squared)) return HOOKE_OK;
    for (int64_t k = 0; k < half; k++)
      x[k] = p[half + k] / sqrt(grown);
  }
  for (int64_t k = 0; k < half; k++) {
    x[half + k] = x[k];
    x[k] = 0.0;
  }
  if (hk_unknowns_product(it, u, it->t, x, p) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
  const double rate = -product_of(it, u, x + half, p + half) / product_of(it, u, x + half, x + half);
  if (!isfinite(rate)) return HOOKE_OK;
  c->frequency = sqrt(squared);
  c->damping = rate / (2.0 * c->frequency);
  return HOOKE_OK;
}

/* ---- the choice ---- */

/* Counts a step that reached time t: 1 if a check is due. */
static int32_t is_due(struct hk_order_choice *c, double t) {
  c->steps++;
  if (++c->window_steps < (c->low ? LOW_WINDOW : WINDOW)) return 0;
  if (c->steps >= (c->low ? LOW_START : c->quiet_until)) return 1;
  c->window_steps = 0;
  c->window_begun = t;
  return 0;
}

static void change(struct hk_order_choice *c, int32_t low) {
  c->low = low;
  c->steps = c->looks = c->short_windows = 0;
  c->quiet_until = low ? 0 : c->quiet_next;
  if (!low) c->quiet_next *= 4;
}

/* Checks, with the solution y at the integrator's time; if that changes `low` the solver has to restart from
 * there. HOOKE_STOPPED by a callback. */
static int32_t look(hooke_integrator *it, const double *y) {
  struct hk_order_choice *c = ((struct hk_sundials *)it->own)->choice;
  const double step = (it->t - c->window_begun) / (double)c->window_steps;
  c->window_steps = 0;
  c->window_begun = it->t;
  if (c->low || c->looks++ % REFRESH == 0 || step * c->frequency > LONG) {
    const int32_t status = find_fastest_modes(it, c, y);
    if (status != HOOKE_OK) return status;
  }
  if (c->low) {
    c->short_windows = step * c->frequency < SHORT ? c->short_windows + 1 : 0;
    if (c->short_windows >= BUDGET) change(c, 0);
  } else if (step * c->frequency > LONG) {
    if (c->damping < DAMPING_OF_ORDER_3)
      change(c, 1);
    else
      c->quiet_until = c->steps + QUIET;
  }
  return HOOKE_OK;
}

/* ---- the solver ---- */

enum { LOW_ORDER = 2, BDF_ORDER = 5, ADAMS_ORDER = 12 };

static const struct hk_sundials_solver solver = {"CVODE",
                                                 CVodeFree,
                                                 CVodeGetNumSteps,
                                                 CVodeGetNumErrTestFails,
                                                 CVodeGetNonlinSolvStats,
                                                 CVodeGetNumLinIters};

static int is_bdf(const hooke_integrator *it) {
  return it->method == &hk_cvode_bdf;
}

static void destroy(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  release_choice(own->choice);
  hk_sundials_release(it);
}

static int where(void *memory, sunrealtype *t, sunrealtype *gamma, N_Vector *y) {
  N_Vector predicted, slope, first;
  sunrealtype scale;
  void *ctx;
  return CVodeGetNonlinearSystemData(memory, t, &predicted, y, &slope, gamma, &scale, &first, &ctx);
}

static int attach_solver(hooke_integrator *it, struct hk_sundials *own) {
  if (!is_bdf(it)) {
    own->nonlinear = SUNNonlinSol_FixedPoint(own->y, 0, own->context);
    return own->nonlinear ? CVodeSetNonlinearSolver(own->memory, own->nonlinear) : CV_MEM_FAIL;
  }
  own->where = where;
  int flag = CVodeSetLinearSolver(own->memory, own->linear, NULL);
  flag = hk_first_flag(flag, CVodeSetEpsLin(own->memory, hk_sundials_linear_share(it)));
  if (flag != CV_SUCCESS || own->unknowns.rows == NULL || hk_sundials_linear_is_own(it)) return flag;
  return CVodeSetJacTimes(own->memory, hk_sundials_product_setup, hk_sundials_product);
}

static int set_up(hooke_integrator *it, struct hk_sundials *own, int order) {
  own->memory = CVodeCreate(is_bdf(it) ? CV_BDF : CV_ADAMS, own->context);
  if (own->memory == NULL) return CV_MEM_FAIL;
  int flag = HOOKE_CVODE_LISTEN(own->memory, own);
  const double rtol = hooke_options_number(it->options, "rtol");
  flag = hk_first_flag(flag, CVodeInit(own->memory, hk_sundials_slope, 0.0, own->y));
  flag = hk_first_flag(flag, CVodeSetUserData(own->memory, it));
  flag = hk_first_flag(flag, CVodeSVtolerances(own->memory, rtol, own->tolerance));
  flag = hk_first_flag(flag, CVodeSetMaxOrd(own->memory, order));
  return flag == CV_SUCCESS ? attach_solver(it, own) : flag;
}

static int32_t create(hooke_integrator *it) {
  const int highest = is_bdf(it) ? BDF_ORDER : ADAMS_ORDER;
  int order;
  int32_t status = hk_sundials_order(it, 1, highest, &order);
  /* counts the part of the history that a run of middling order uses */
  if (status == HOOKE_OK) status = hk_sundials_create(it, &solver, is_bdf(it), 10 + (highest + 2) / 2);
  if (status == HOOKE_OK && is_bdf(it)) status = create_choice(it);
  if (status != HOOKE_OK) return status;
  struct hk_sundials *own = it->own;
  const int flag = set_up(it, own, order);
  return hk_sundials_created(it, flag == CV_SUCCESS, flag == CV_MEM_FAIL);
}

static int32_t start(hooke_integrator *it, double t) {
  struct hk_sundials *own = it->own;
  int flag = CVodeReInit(own->memory, t, own->y);
  if (flag == CV_SUCCESS && own->choice)
    flag = CVodeSetMaxOrd(own->memory, own->choice->low ? LOW_ORDER : BDF_ORDER);
  if (flag == CV_SUCCESS) return HOOKE_OK;
  return hk_fail(HOOKE_SOLVER_FAILED, NULL, "CVODE could not start at t = %.6g s: %s", t, own->message);
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  const int32_t status = hk_sundials_renew(it);
  if (status != HOOKE_OK) return status;
  const struct hk_sundials *own = it->own;
  hk_sundials_load(it, state);
  if (own->choice) begin_choice(own->choice, *state->t);
  return start(it, *state->t);
}

/* CVODE writes past its history if the highest order falls below the current one, so it restarts. */
static int32_t choose_order(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  const int32_t low = own->choice->low;
  if (CVodeGetDky(own->memory, it->t, 0, own->y) != CV_SUCCESS) return HOOKE_OK;
  const int32_t status = look(it, N_VGetArrayPointer(own->y));
  if (status != HOOKE_OK || own->choice->low == low) return status;
  own->before = it->count;
  return start(it, it->t);
}

static int32_t step(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (own->choice && it->k > 0 && is_due(own->choice, it->t)) {
    const int32_t status = choose_order(it);
    if (status != HOOKE_OK) return status;
  }
  sunrealtype reached = it->t;
  const int flag = CVode(own->memory, hk_sundials_towards(it), own->y, &reached, CV_ONE_STEP);
  return hk_sundials_advance(it, flag, reached);
}

/* Before the first step y is still the initial value, and there is nothing to interpolate. */
static int32_t store(hooke_integrator *it, double t, hooke_state *state) {
  struct hk_sundials *own = it->own;
  long steps = 0;
  CVodeGetNumSteps(own->memory, &steps);
  if (steps > 0 && CVodeGetDky(own->memory, t, 0, own->y) != CV_SUCCESS) {
    return hk_fail(HOOKE_SOLVER_FAILED, NULL, "CVODE has no solution at t = %.6g s: %s", t, own->message);
  }
  return hk_unknowns_store(it, &own->unknowns, t, N_VGetArrayPointer(own->y), state);
}

static const struct hk_steps steps = {create, destroy, NULL, begin, step, store};
#define STEPS &steps

#else

#define STEPS NULL

#endif

#define ROW_OF_CVODE                                                                                         \
  .needs = "SUNDIALS", .adaptive = 1, .interpolates = 1, .takes = HOOKE_TAKES_ALL, .steps = STEPS

const struct hk_method hk_cvode_bdf = {
    .name = "cvode-bdf",
    .summary = "SUNDIALS CVODE, error-controlled, implicit, orders 1 to 5; for strong damping",
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note = "chooses its steps; error control limits them"},
    ROW_OF_CVODE};

const struct hk_method hk_cvode_adams = {
    .name = "cvode-adams",
    .summary = "SUNDIALS CVODE, error-controlled, explicit in effect, orders 1 to 12; for weak damping",
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .note = "chooses its steps; error control limits them, and for fast "
                          "motion also stability, which it sees as error"},
    ROW_OF_CVODE};
