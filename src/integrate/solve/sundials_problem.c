#if HOOKE_HAVE_SUNDIALS

#include "integrate/solve/sundials_problem.h"
#include "integrate/solve/sundials_vector.h"

#include "core/memory.h"
#include "core/status.h"

#include <cvode/cvode.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int32_t no_memory(const hooke_integrator *it, int64_t size) {
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %s on %lld numbers", it->method->name,
                 (long long)size);
}

int32_t hk_sundials_create(hooke_integrator *it, const struct hk_sundials_solver *solver, int32_t implicit,
                           int64_t vectors) {
  struct hk_sundials *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->solver = solver;
  const int32_t status = hk_unknowns_create(it, implicit, &own->unknowns);
  if (status != HOOKE_OK) return status;
  const int64_t size = own->unknowns.size;
  it->own_memory += vectors * size * (int64_t)sizeof(double);
  if (hk_sundials_context(&own->context, own) != 0) return no_memory(it, size);
  own->y = hk_sundials_vector(size, it->pool, own->context);
  own->tolerance = hk_sundials_vector(size, it->pool, own->context);
  if (own->y == NULL || own->tolerance == NULL || !hk_sundials_spare_create(own->y, &own->spare))
    return no_memory(it, size);
  N_VConst(0.0, own->y);
  hk_unknowns_tolerance(it, &own->unknowns, N_VGetArrayPointer(own->tolerance));
  return implicit ? hk_sundials_linear_create(it) : HOOKE_OK;
}

int32_t hk_sundials_created(const hooke_integrator *it, int32_t created, int32_t no_space) {
  const struct hk_sundials *own = it->own;
  if (own->spare.taken || no_space) return no_memory(it, own->unknowns.size);
  if (created) return HOOKE_OK;
  return hk_fail(HOOKE_SOLVER_FAILED, NULL, "%s could not be set up: %s", own->solver->name, own->message);
}

int32_t hk_sundials_renew(hooke_integrator *it) {
  if (it->own) {
    const struct hk_sundials *own = it->own;
    if (!own->spare.taken) return HOOKE_OK;
    it->method->steps->destroy(it);
  }
  it->own_memory = 0;
  const int32_t status = it->method->steps->create(it);
  if (status != HOOKE_OK && it->own) it->method->steps->destroy(it);
  return status;
}

void hk_sundials_release(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (own->memory) own->solver->free(&own->memory);
  if (own->linear) SUNLinSolFree(own->linear);
  if (own->nonlinear) SUNNonlinSolFree(own->nonlinear);
  if (own->y) N_VDestroy(own->y);
  if (own->tolerance) N_VDestroy(own->tolerance);
  hk_sundials_spare_release(&own->spare);
  if (own->context) SUNContext_Free(&own->context);
  hk_unknowns_release(&own->unknowns);
  hk_free(own);
  it->own = NULL;
}

int32_t hk_sundials_order(const hooke_integrator *it, int lowest, int highest, int *order) {
  const double given = hooke_options_number(it->options, "max_order");
  *order = isnan(given) ? highest : (int)given;
  if (*order >= lowest && *order <= highest) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "max_order", "%d is not allowed; %s takes %d to %d", *order,
                 it->method->name, lowest, highest);
}

/* Along stiff springs a small residual is a large error, which costs steps, so this is below the 0.05 of
 * SUNDIALS; if the Krylov space holds every unknown, accuracy is free. */
double hk_sundials_linear_share(const hooke_integrator *it) {
  const struct hk_sundials *own = it->own;
  return own->unknowns.rows && 6 * own->unknowns.free_count <= HOOKE_KRYLOV_VECTORS ? 1e-4 : 1e-2;
}

void hk_sundials_load(hooke_integrator *it, const hooke_state *state) {
  struct hk_sundials *own = it->own;
  hk_unknowns_load(it, &own->unknowns, state, N_VGetArrayPointer(own->y));
  hk_sundials_linear_begin(it);
  own->before = it->count;
  own->no_memory = 0;
  own->message[0] = '\0';
}

static void count(hooke_integrator *it) {
  const struct hk_sundials *own = it->own;
  long steps = 0, failures = 0, iterations = 0, unsolved = 0, linear = 0;
  own->solver->steps(own->memory, &steps);
  own->solver->error_test_failures(own->memory, &failures);
  own->solver->nonlinear(own->memory, &iterations, &unsolved);
  if (own->linear) own->solver->linear(own->memory, &linear);
  it->count.steps = own->before.steps + steps;
  it->count.error_test_failures = own->before.error_test_failures + failures;
  it->count.nonlinear_iterations = own->before.nonlinear_iterations + iterations;
  it->count.nonlinear_failures = own->before.nonlinear_failures + unsolved;
  it->count.linear_iterations = own->before.linear_iterations + linear;
}

/* Not the end of a very long run: the solvers try no first step below 1e-14 of the interval, and one that is
 * 1e16 times too long destroys the state when it is rejected. */
static const double FARTHEST = 1e9;

double hk_sundials_towards(const hooke_integrator *it) {
  const double duration = it->schedule.duration;
  return it->t + (isnan(duration) ? 1.0 : fmin(duration, FARTHEST));
}

/* The solver's complaint without its full stop. */
static int complaint_length(const char *message) {
  size_t length = strlen(message);
  while (length > 0 && (message[length - 1] == '.' || message[length - 1] == ' '))
    length--;
  return (int)length;
}

int32_t hk_sundials_advance(hooke_integrator *it, int flag, double reached) {
  const struct hk_sundials *own = it->own;
  count(it);
  if (it->stop_value != 0) return HOOKE_STOPPED;
  /* GMRES allocates its scratch before the first step; the number is that of ARKODE as well */
  if (own->spare.taken || own->no_memory || flag == CV_LINIT_FAIL) return no_memory(it, own->unknowns.size);
  if (flag < 0) {
    return hk_fail(HOOKE_SOLVER_FAILED, NULL,
                   "%s gave up at t = %.6g s: %.*s; try other tolerances, or a fixed-step method",
                   own->solver->name, it->t, complaint_length(own->message), own->message);
  }
  if (!(reached > it->t)) {
    return hk_fail(HOOKE_SOLVER_FAILED, NULL,
                   "%s gave up at t = %.6g s: its step is too small to change the time; try looser "
                   "tolerances or a fixed-step method",
                   own->solver->name, it->t);
  }
  it->t = reached;
  return HOOKE_OK;
}

/* ---- callbacks ---- */

int hk_sundials_slope(sunrealtype t, N_Vector y, N_Vector slope, void *ctx) {
  hooke_integrator *it = ctx;
  const struct hk_sundials *own = it->own;
  return hk_unknowns_slope(it, &own->unknowns, t, N_VGetArrayPointer(y), N_VGetArrayPointer(slope));
}

/* Called once per linear solve. */
int hk_sundials_product_setup(sunrealtype t, N_Vector y, N_Vector slope, void *ctx) {
  (void)slope;
  hooke_integrator *it = ctx;
  const struct hk_sundials *own = it->own;
  return hk_unknowns_linearise(it, &own->unknowns, t, N_VGetArrayPointer(y));
}

int hk_sundials_product(N_Vector direction, N_Vector product, sunrealtype t, N_Vector y, N_Vector slope,
                        void *ctx, N_Vector scratch) {
  (void)y, (void)slope, (void)scratch;
  hooke_integrator *it = ctx;
  struct hk_sundials *own = it->own;
  return hk_unknowns_product(it, &own->unknowns, t, N_VGetArrayPointer(direction),
                             N_VGetArrayPointer(product));
}

void hk_sundials_complain(void *ctx, const char *message) {
  struct hk_sundials *own = ctx;
  snprintf(own->message, sizeof own->message, "%s", message);
}

#else
typedef int hk_sundials_problem_is_not_built;
#endif
