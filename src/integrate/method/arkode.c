/* ARKODE (Reynolds et al. 2023): the ESDIRK formulas of Kennedy and Carpenter (2016, 2019), L-stable and
 * stiffly accurate, with Newton and GMRES. Checks a reference where the explicit rk8pd costs too much. */
#include "integrate/integrator.h"

#if HOOKE_HAVE_SUNDIALS

#include "core/status.h"
#include "integrate/solve/sundials_problem.h"

#include <arkode/arkode_arkstep.h>
#include <float.h>
#include <math.h>

enum { LOWEST_ORDER = 3, HIGHEST_ORDER = 5, VECTORS = 25 };
enum { HIGHEST_ORDER_PREDICTOR = 1, MOST_FAILURES = 100 };

static const ARKODE_DIRKTableID tables[] = {ARKODE_ESDIRK325L2SA_5_2_3, ARKODE_ESDIRK437L2SA_7_3_4,
                                            ARKODE_ESDIRK547L2SA2_7_4_5};

static const struct hk_sundials_solver solver = {"ARKODE",
                                                 ARKodeFree,
                                                 ARKodeGetNumSteps,
                                                 ARKodeGetNumErrTestFails,
                                                 ARKodeGetNonlinSolvStats,
                                                 ARKodeGetNumLinIters};

static int where(void *memory, sunrealtype *t, sunrealtype *gamma, N_Vector *y) {
  N_Vector predicted, slope, start;
  void *ctx;
  return ARKodeGetNonlinearSystemData(memory, t, &predicted, y, &slope, gamma, &start, &ctx);
}

static int attach_solver(hooke_integrator *it, struct hk_sundials *own) {
  own->where = where;
  int flag = ARKodeSetLinearSolver(own->memory, own->linear, NULL);
  flag = hk_first_flag(flag, ARKodeSetEpsLin(own->memory, hk_sundials_linear_share(it)));
  if (flag != ARK_SUCCESS || own->unknowns.rows == NULL || hk_sundials_linear_is_own(it)) return flag;
  return ARKodeSetJacTimes(own->memory, hk_sundials_product_setup, hk_sundials_product);
}

static int set_up(hooke_integrator *it, struct hk_sundials *own, int order) {
  own->memory = ARKStepCreate(NULL, hk_sundials_slope, 0.0, own->y, own->context);
  if (own->memory == NULL) return ARK_MEM_FAIL;
  int flag = HOOKE_ARKODE_LISTEN(own->memory, own);
  const double rtol = hooke_options_number(it->options, "rtol");
  flag = hk_first_flag(flag, ARKodeSetUserData(own->memory, it));
  flag = hk_first_flag(flag, ARKodeSVtolerances(own->memory, rtol, own->tolerance));
  flag = hk_first_flag(flag, ARKStepSetTableNum(own->memory, tables[order - LOWEST_ORDER], ARKODE_ERK_NONE));
  /* stages predicted from earlier steps: less than half the linear iterations */
  flag = hk_first_flag(flag, ARKodeSetInterpolantType(own->memory, ARK_INTERP_LAGRANGE));
  flag = hk_first_flag(flag, ARKodeSetPredictorMethod(own->memory, HIGHEST_ORDER_PREDICTOR));
  /* where a force jumps, such as where a damped spring that only pulls becomes slack, a step may have to
   * shrink far */
  flag = hk_first_flag(flag, ARKodeSetMaxErrTestFails(own->memory, MOST_FAILURES));
  return flag == ARK_SUCCESS ? attach_solver(it, own) : flag;
}

static int32_t create(hooke_integrator *it) {
  int order;
  int32_t status = hk_sundials_order(it, LOWEST_ORDER, HIGHEST_ORDER, &order);
  if (status == HOOKE_OK) status = hk_sundials_create(it, &solver, 1, VECTORS);
  if (status != HOOKE_OK) return status;
  struct hk_sundials *own = it->own;
  const int flag = set_up(it, own, order);
  return hk_sundials_created(it, flag == ARK_SUCCESS, flag == ARK_MEM_FAIL);
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  const int32_t status = hk_sundials_renew(it);
  if (status != HOOKE_OK) return status;
  const struct hk_sundials *own = it->own;
  hk_sundials_load(it, state);
  if (ARKStepReInit(own->memory, NULL, hk_sundials_slope, *state->t, own->y) == ARK_SUCCESS) return HOOKE_OK;
  return hk_fail(HOOKE_SOLVER_FAILED, NULL, "ARKODE could not start at t = %.6g s: %s", *state->t,
                 own->message);
}

/* Steps end at the goal, where the run loop needs the solution: ARKODE's interpolants have a larger error
 * than its steps. */
static int32_t step(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  sunrealtype reached = it->t;
  int flag = ARKodeSetStopTime(own->memory, fmin(it->goal, DBL_MAX));
  if (flag == ARK_SUCCESS)
    flag = ARKodeEvolve(own->memory, hk_sundials_towards(it), own->y, &reached, ARK_ONE_STEP);
  return hk_sundials_advance(it, flag, reached);
}

static int32_t store(hooke_integrator *it, double t, hooke_state *state) {
  struct hk_sundials *own = it->own;
  return hk_unknowns_store(it, &own->unknowns, t, N_VGetArrayPointer(own->y), state);
}

static const struct hk_steps steps = {create, hk_sundials_release, NULL, begin, step, store};
#define STEPS &steps

#else

#define STEPS NULL

#endif

const struct hk_method hk_arkode_esdirk = {
    .name = "arkode-esdirk",
    .summary = "SUNDIALS ARKODE, error-controlled, implicit Runge-Kutta, orders 3 to 5; to check a reference",
    .needs = "SUNDIALS",
    .reference = 1,
    .adaptive = 1,
    .takes = HOOKE_TAKES_ALL,
    .steps = STEPS};
