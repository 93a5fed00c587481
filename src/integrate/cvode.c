/* CVODE (Cohen and Hindmarsh 1996; Hindmarsh et al. 2005): backward differentiation formulas with Newton and
 * GMRES, and Adams-Moulton with fixed-point iteration. */
#include "integrate/integrator.h"

#if HOOKE_HAVE_SUNDIALS

#include "core/memory.h"
#include "core/status.h"
#include "integrate/cvode.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

/* Krylov vectors kept; stiff scenes need more than CVODE's default of 5. */
enum { KRYLOV_VECTORS = 30, BDF_ORDER = 5, ADAMS_ORDER = 12 };

static int is_bdf(const hooke_integrator *it) {
  return it->method == &hooke_cvode_bdf;
}

static void keep_message(int code, const char *module, const char *function, char *message, void *ctx) {
  (void)code, (void)module, (void)function;
  struct hooke_cvode *own = ctx;
  snprintf(own->message, sizeof own->message, "%s", message);
}

static void destroy(hooke_integrator *it) {
  struct hooke_cvode *own = it->own;
  if (own->memory) CVodeFree(&own->memory);
  if (own->linear) SUNLinSolFree(own->linear);
  if (own->nonlinear) SUNNonlinSolFree(own->nonlinear);
  if (own->y) N_VDestroy(own->y);
  if (own->tolerance) N_VDestroy(own->tolerance);
  if (own->context) SUNContext_Free(&own->context);
  hooke_free(own->free);
  hooke_free(own->rows);
  hooke_free(own);
  it->own = NULL;
}

/* The free particles, and rows for products with the derivative. */
static int32_t create_particles(hooke_integrator *it, struct hooke_cvode *own) {
  const hooke_system *system = it->system;
  const int64_t n = system->particle_count;
  own->free_count = n - system->held_count;
  if (system->held_count > 0) {
    own->free = hooke_new(own->free_count, sizeof *own->free);
    if (own->free == NULL) return HOOKE_NO_MEMORY;
    for (int64_t p = 0, k = 0; p < n; p++) {
      if (!system->held[p]) own->free[k++] = (int32_t)p;
    }
  }
  if (!is_bdf(it)) return HOOKE_OK;
  own->rows = hooke_new(5 * it->size, sizeof(double));
  it->own_memory += 5 * it->size * (int64_t)sizeof(double);
  return own->rows ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void set_tolerance(const hooke_integrator *it, const struct hooke_cvode *own, int64_t size) {
  const double position = hooke_options_number(it->options, "atol");
  const double velocity = hooke_options_number(it->options, "atol_velocity");
  double *tolerance = N_VGetArrayPointer(own->tolerance);
  for (int64_t k = 0; k < size; k++)
    tolerance[k] = it->rate || k < 3 * own->free_count ? position : velocity;
}

/* How far a linear solve goes, as a share of what Newton may leave. Along stiff springs a small residual is a large error,
 * which costs steps, so this is below CVODE's 0.05; and where the Krylov space holds every unknown, accuracy is free. */
static double linear_share(const hooke_integrator *it, const struct hooke_cvode *own) {
  return !it->rate && 6 * own->free_count <= KRYLOV_VECTORS ? 1e-4 : 1e-2;
}

static int attach_solver(hooke_integrator *it, struct hooke_cvode *own) {
  if (!is_bdf(it)) {
    own->nonlinear = SUNNonlinSol_FixedPoint(own->y, 0, own->context);
    return own->nonlinear ? CVodeSetNonlinearSolver(own->memory, own->nonlinear) : CV_MEM_FAIL;
  }
  own->linear = SUNLinSol_SPGMR(own->y, SUN_PREC_NONE, KRYLOV_VECTORS, own->context);
  if (own->linear == NULL) return CV_MEM_FAIL;
  int flag = CVodeSetLinearSolver(own->memory, own->linear, NULL);
  if (flag == CV_SUCCESS) flag = CVodeSetEpsLin(own->memory, linear_share(it, own));
  if (flag != CV_SUCCESS || it->rate) return flag;
  return CVodeSetJacTimes(own->memory, hooke_cvode_product_setup, hooke_cvode_product);
}

static int32_t read_order(const hooke_integrator *it, int *order) {
  const int highest = is_bdf(it) ? BDF_ORDER : ADAMS_ORDER;
  const double given = hooke_options_number(it->options, "max_order");
  *order = isnan(given) ? highest : (int)given;
  if (*order <= highest) return HOOKE_OK;
  return hooke_fail(HOOKE_BAD_VALUE, "max_order", "%d is not allowed; %s takes 1 to %d", *order,
                    it->method->name, highest);
}

static int32_t create_solver(hooke_integrator *it, struct hooke_cvode *own, int64_t size) {
  int order;
  const int32_t status = read_order(it, &order);
  if (status != HOOKE_OK) return status;
  if (SUNContext_Create(NULL, &own->context) != 0)
    return hooke_fail(HOOKE_NO_MEMORY, NULL, "no memory for SUNDIALS");
  own->y = N_VNew_Serial(size, own->context);
  own->tolerance = N_VNew_Serial(size, own->context);
  own->memory = CVodeCreate(is_bdf(it) ? CV_BDF : CV_ADAMS, own->context);
  if (own->y == NULL || own->tolerance == NULL || own->memory == NULL) {
    return hooke_fail(HOOKE_NO_MEMORY, NULL, "no memory for CVODE on %lld numbers", (long long)size);
  }
  N_VConst(0.0, own->y);
  set_tolerance(it, own, size);
  int flag = CVodeSetErrHandlerFn(own->memory, keep_message, own);
  if (flag == CV_SUCCESS) flag = CVodeInit(own->memory, hooke_cvode_rhs, 0.0, own->y);
  if (flag == CV_SUCCESS) flag = CVodeSetUserData(own->memory, it);
  if (flag == CV_SUCCESS) {
    flag = CVodeSVtolerances(own->memory, hooke_options_number(it->options, "rtol"), own->tolerance);
  }
  if (flag == CV_SUCCESS) flag = CVodeSetMaxOrd(own->memory, order);
  if (flag == CV_SUCCESS) flag = attach_solver(it, own);
  if (flag == CV_SUCCESS) return HOOKE_OK;
  return hooke_fail(flag == CV_MEM_FAIL ? HOOKE_NO_MEMORY : HOOKE_SOLVER_FAILED, NULL,
                    "CVODE could not be set up: %s", own->message);
}

static int32_t create(hooke_integrator *it) {
  struct hooke_cvode *own = hooke_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  const int32_t status = it->system ? create_particles(it, own) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  /* CVODE takes no empty vector */
  const int64_t size = it->rate ? it->size : own->free_count > 0 ? 6 * own->free_count : 1;
  const int vectors = is_bdf(it) ? 10 + BDF_ORDER + KRYLOV_VECTORS : 10 + ADAMS_ORDER;
  it->own_memory += vectors * size * (int64_t)sizeof(double);
  return create_solver(it, own, size);
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  struct hooke_cvode *own = it->own;
  double *y = N_VGetArrayPointer(own->y);
  if (it->rate) {
    memcpy(y, state->q, (size_t)it->size * sizeof(double));
  } else {
    hooke_motion_load(it->system, it->motion, state->q, state->v);
    hooke_cvode_pack(it, state->q, state->v, y);
  }
  own->before = it->count;
  own->message[0] = '\0';
  if (CVodeReInit(own->memory, *state->t, own->y) == CV_SUCCESS) return HOOKE_OK;
  return hooke_fail(HOOKE_SOLVER_FAILED, NULL, "CVODE could not start at t = %.17g s: %s", *state->t,
                    own->message);
}

/* CVODE counts from its last start; these counts go on over starts. */
static void read_counts(hooke_integrator *it) {
  struct hooke_cvode *own = it->own;
  long steps = 0, evaluations, setups, failures = 0, iterations = 0, convergence = 0, linear = 0;
  int order, next_order;
  realtype first, last, next, now;
  CVodeGetIntegratorStats(own->memory, &steps, &evaluations, &setups, &failures, &order, &next_order, &first,
                          &last, &next, &now);
  CVodeGetNonlinSolvStats(own->memory, &iterations, &convergence);
  if (own->linear) CVodeGetNumLinIters(own->memory, &linear);
  it->count.steps = own->before.steps + steps;
  it->count.error_test_failures = own->before.error_test_failures + failures;
  it->count.nonlinear_iterations = own->before.nonlinear_iterations + iterations;
  it->count.nonlinear_failures = own->before.nonlinear_failures + convergence;
  it->count.linear_iterations = own->before.linear_iterations + linear;
}

static int32_t step(hooke_integrator *it) {
  struct hooke_cvode *own = it->own;
  const double duration = it->schedule.duration;
  /* only the first step looks at the goal, for its direction and size */
  const double goal = it->t + (isnan(duration) ? 1.0 : duration);
  realtype reached = it->t;
  const int flag = CVode(own->memory, goal, own->y, &reached, CV_ONE_STEP);
  read_counts(it);
  if (it->stop_value != 0) return HOOKE_STOPPED;
  if (flag >= 0) {
    it->t = reached;
    return HOOKE_OK;
  }
  return hooke_fail(HOOKE_SOLVER_FAILED, NULL, "CVODE gave up at t = %.17g s: %s", it->t, own->message);
}

static int32_t store(hooke_integrator *it, double t, hooke_state *state) {
  struct hooke_cvode *own = it->own;
  if (CVodeGetDky(own->memory, t, 0, own->y) != CV_SUCCESS) {
    return hooke_fail(HOOKE_SOLVER_FAILED, NULL, "CVODE has no solution at t = %.17g s: %s", t, own->message);
  }
  const double *y = N_VGetArrayPointer(own->y);
  *state->t = t;
  if (it->rate) {
    memcpy(state->q, y, (size_t)it->size * sizeof(double));
    return HOOKE_OK;
  }
  const int32_t status = hooke_integrator_hold(it, t);
  hooke_motion_store(it->motion, state->q, state->v);
  hooke_cvode_unpack(it, y, state->q, state->v);
  return status;
}

#define ROW_OF_CVODE                                                                                         \
  .built = 1, .adaptive = 1, .first_order = 1, .second_order = 1, .create = create, .destroy = destroy,      \
  .begin = begin, .step = step, .store = store

#else

#define ROW_OF_CVODE .built = 0, .adaptive = 1, .first_order = 1, .second_order = 1

#endif

const struct hooke_method hooke_cvode_bdf = {
    .name = "cvode-bdf",
    .summary = "SUNDIALS CVODE, error-controlled, implicit, orders 1 to 5; for strong damping",
    ROW_OF_CVODE};

const struct hooke_method hooke_cvode_adams = {
    .name = "cvode-adams",
    .summary = "SUNDIALS CVODE, error-controlled, explicit in effect, orders 1 to 12; for weak damping",
    ROW_OF_CVODE};
