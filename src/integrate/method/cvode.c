/* CVODE (Cohen and Hindmarsh 1996; Hindmarsh et al. 2005): backward differentiation formulas with Newton and
 * GMRES, and Adams-Moulton with fixed-point iteration. */
#include "integrate/integrator.h"

#if HOOKE_HAVE_SUNDIALS

#include "core/status.h"
#include "integrate/method/cvode_order.h"
#include "integrate/solve/sundials_linear.h"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { LOW_ORDER = 2, BDF_ORDER = 5, ADAMS_ORDER = 12 };

static int is_bdf(const hooke_integrator *it) {
  return it->method == &hk_cvode_bdf;
}

static void destroy(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (own->memory) CVodeFree(&own->memory);
  hk_order_choice_release(own->choice);
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
  if (flag == CV_SUCCESS) flag = CVodeSetEpsLin(own->memory, hk_sundials_linear_share(it));
  if (flag != CV_SUCCESS || !hk_unknowns_have_products(it) || hk_sundials_linear_is_own(it)) return flag;
  return CVodeSetJacTimes(own->memory, hk_sundials_product_setup, hk_sundials_product);
}

static int set_up(hooke_integrator *it, struct hk_sundials *own, int order) {
  own->memory = CVodeCreate(is_bdf(it) ? CV_BDF : CV_ADAMS, own->context);
  if (own->memory == NULL) return CV_MEM_FAIL;
  int flag = HOOKE_CVODE_LISTEN(own->memory, own);
  if (flag == CV_SUCCESS) flag = CVodeInit(own->memory, hk_sundials_slope, 0.0, own->y);
  if (flag == CV_SUCCESS) flag = CVodeSetUserData(own->memory, it);
  if (flag == CV_SUCCESS) {
    flag = CVodeSVtolerances(own->memory, hooke_options_number(it->options, "rtol"), own->tolerance);
  }
  if (flag == CV_SUCCESS) flag = CVodeSetMaxOrd(own->memory, order);
  return flag == CV_SUCCESS ? attach_solver(it, own) : flag;
}

static int32_t create(hooke_integrator *it) {
  const int highest = is_bdf(it) ? BDF_ORDER : ADAMS_ORDER;
  int order;
  int32_t status = hk_sundials_order(it, 1, highest, &order);
  /* counts the part of the history that a run of middling order uses */
  if (status == HOOKE_OK) status = hk_sundials_create(it, is_bdf(it), 10 + (highest + 2) / 2);
  if (status == HOOKE_OK && is_bdf(it)) status = hk_order_choice_create(it);
  if (status != HOOKE_OK) return status;
  struct hk_sundials *own = it->own;
  const int flag = set_up(it, own, order);
  return hk_sundials_created(it, "CVODE", flag == CV_SUCCESS, flag == CV_MEM_FAIL);
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
  if (own->choice) hk_order_choice_begin(own->choice, *state->t);
  return start(it, *state->t);
}

/* CVODE writes past its history if the highest order falls below the current one, so it restarts. */
static int32_t choose_order(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  const int32_t low = own->choice->low;
  if (CVodeGetDky(own->memory, it->t, 0, own->y) != CV_SUCCESS) return HOOKE_OK;
  const int32_t status = hk_order_choice_look(it, N_VGetArrayPointer(own->y));
  if (status != HOOKE_OK || own->choice->low == low) return status;
  own->before = it->count;
  return start(it, it->t);
}

static void read_counts(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  long steps = 0, evaluations, setups, failures = 0, iterations = 0, convergence = 0, linear = 0;
  int order, next_order;
  sunrealtype first, last, next, now;
  CVodeGetIntegratorStats(own->memory, &steps, &evaluations, &setups, &failures, &order, &next_order, &first,
                          &last, &next, &now);
  CVodeGetNonlinSolvStats(own->memory, &iterations, &convergence);
  if (own->linear) CVodeGetNumLinIters(own->memory, &linear);
  hk_sundials_count(it, (struct hk_counts){.steps = steps,
                                           .error_test_failures = failures,
                                           .nonlinear_iterations = iterations,
                                           .nonlinear_failures = convergence,
                                           .linear_iterations = linear});
}

static int32_t step(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (own->choice && it->k > 0 && hk_order_choice_is_due(own->choice, it->t)) {
    const int32_t status = choose_order(it);
    if (status != HOOKE_OK) return status;
  }
  sunrealtype reached = it->t;
  const int flag = CVode(own->memory, hk_sundials_towards(it), own->y, &reached, CV_ONE_STEP);
  read_counts(it);
  return hk_sundials_advance(it, "CVODE", flag, reached);
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
  .needs = "SUNDIALS", .adaptive = 1, .first_order = 1, .bodies = 1, .overdamped = 1, .steps = STEPS

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
