/* GSL's rk8pd: the explicit Runge-Kutta formulas of order 8(7) by Prince and Dormand (1981), under the step
 * control of gsl_odeiv2. The first choice for checking a reference, as it shares nothing with SUNDIALS but
 * the force.
 *
 * GSL reports errors to a global handler, which by default ends the process; a library must not replace it.
 * So no call here can fail in this way: gsl_odeiv2_step_apply() and _hadjust() report no errors, the
 * arguments of the constructors are in range, and memory is test-allocated before GSL requests it. */
#include "integrate/integrator.h"

#if HOOKE_HAVE_GSL

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/unknowns.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

enum { ARRAYS_OF_GSL = 16 }; /* 13 stages, 2 states, the tolerances */

struct hk_rk8pd {
  struct hk_unknowns unknowns;
  gsl_odeiv2_system system;
  gsl_odeiv2_step *stepper;
  gsl_odeiv2_control *control;
  double *y, *before, *slope, *next_slope, *error, *tolerance; /* one block */
  double rtol;
  double step; /* next proposal of the control; 0 before the first step */
};

static int slope(double t, const double *y, double *to, void *ctx) {
  hooke_integrator *it = ctx;
  const struct hk_rk8pd *own = it->own;
  const int answer = hk_unknowns_slope(it, &own->unknowns, t, y, to);
  return answer == HOOKE_SLOPE_FINE ? GSL_SUCCESS : GSL_FAILURE;
}

static void destroy(hooke_integrator *it) {
  struct hk_rk8pd *own = it->own;
  if (own->stepper) gsl_odeiv2_step_free(own->stepper);
  if (own->control) gsl_odeiv2_control_free(own->control);
  hk_unknowns_release(&own->unknowns);
  hk_free(own->y);
  hk_free(own);
  it->own = NULL;
}

static int32_t create_gsl(struct hk_rk8pd *own) {
  const size_t size = own->system.dimension;
  void *work = hk_reserve((int64_t)size, (ARRAYS_OF_GSL + 1) * sizeof(double)); /* not touched */
  if (work == NULL) return HOOKE_NO_MEMORY;
  hk_free(work);
  own->stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size);
  own->control = gsl_odeiv2_control_scaled_new(1.0, own->rtol, 1.0, 0.0, own->tolerance, size);
  if (own->stepper && own->control) return HOOKE_OK;
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for rk8pd on %lld numbers", (long long)size);
}

static int32_t create(hooke_integrator *it) {
  struct hk_rk8pd *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  const int32_t status = hk_unknowns_create(it, 0, &own->unknowns);
  if (status != HOOKE_OK) return status;
  const int64_t size = own->unknowns.size;
  double **const arrays[] = {&own->y,          &own->before, &own->slope,
                             &own->next_slope, &own->error,  &own->tolerance};
  const int64_t count = sizeof arrays / sizeof arrays[0];
  double *block = hk_new(count * size, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++)
    *arrays[k] = block + k * size;
  it->own_memory += (count + ARRAYS_OF_GSL) * size * (int64_t)sizeof(double);
  own->rtol = hooke_options_number(it->options, "rtol");
  hk_unknowns_tolerance(it, &own->unknowns, own->tolerance);
  own->system = (gsl_odeiv2_system){.function = slope, .dimension = (size_t)size, .params = it};
  return create_gsl(own);
}

static int32_t begin(hooke_integrator *it, const hooke_state *state) {
  struct hk_rk8pd *own = it->own;
  hk_unknowns_load(it, &own->unknowns, state, own->y);
  own->step = 0.0;
  return HOOKE_OK;
}

/* Largest |value| in units of the allowed error of one step. */
static double weighed(const struct hk_rk8pd *own, const double *value) {
  double most = 0.0;
  for (int64_t k = 0; k < own->unknowns.size; k++)
    most = fmax(most, fabs(value[k]) / (own->tolerance[k] + own->rtol * fabs(own->y[k])));
  return most;
}

/* The slope at the start, and a first step of one per cent of the time in which y would change by itself
 * (Hairer, Norsett and Wanner 1993, section II.4). */
static int32_t start(hooke_integrator *it, struct hk_rk8pd *own) {
  const int answer = hk_unknowns_slope(it, &own->unknowns, it->t, own->y, own->slope);
  if (answer == HOOKE_SLOPE_STOPPED) return HOOKE_STOPPED;
  if (answer == HOOKE_SLOPE_NOT_FINITE) {
    return hk_fail(HOOKE_SOLVER_FAILED, NULL, "rk8pd cannot start at t = %.6g s: a force is not finite",
                   it->t);
  }
  const double size = weighed(own, own->y), rate = weighed(own, own->slope);
  own->step = size > 1e-5 && rate > 1e-5 ? 0.01 * size / rate : 1e-6;
  return HOOKE_OK;
}

/* One attempt at a step of h to time `end`: 1 if accepted, 0 if rejected and undone; own->step is the next to
 * try. */
static int32_t attempt(hooke_integrator *it, struct hk_rk8pd *own, double h, double end) {
  const size_t bytes = own->system.dimension * sizeof(double);
  memcpy(own->before, own->y, bytes);
  own->step = h;
  const int flag = gsl_odeiv2_step_apply(own->stepper, it->t, h, own->y, own->error, own->slope,
                                         own->next_slope, &own->system);
  if (flag != GSL_SUCCESS) {
    own->step = 0.25 * h;
  } else if (gsl_odeiv2_control_hadjust(own->control, own->stepper, own->y, own->error, own->next_slope,
                                        &own->step) != GSL_ODEIV_HADJ_DEC) {
    memcpy(own->slope, own->next_slope, bytes);
    it->t = end;
    it->count.steps++;
    return 1;
  } else {
    it->count.error_test_failures++;
  }
  memcpy(own->y, own->before, bytes);
  return 0;
}

/* Steps end at the goal, where the run loop needs the solution: nothing is interpolated. Two equal steps to
 * it rather than a long and a short one, unless rounding of times alone puts it beyond the next step. */
static int32_t step(hooke_integrator *it) {
  struct hk_rk8pd *own = it->own;
  if (own->step == 0.0) {
    const int32_t status = start(it, own);
    if (status != HOOKE_OK) return status;
  }
  for (;;) {
    const double left = it->goal - it->t;
    const int32_t reaches = own->step >= left * (1.0 - 1e-9);
    const double h = reaches ? left : fmin(own->step, 0.5 * left), end = reaches ? it->goal : it->t + h;
    if (!(end > it->t)) {
      return hk_fail(HOOKE_SOLVER_FAILED, NULL,
                     "rk8pd gave up at t = %.6g s: its step would be %.3g s, too small to change the time; "
                     "loosen rtol and atol, or look for a force that is not finite",
                     it->t, own->step);
    }
    if (attempt(it, own, h, end)) return HOOKE_OK;
    if (it->stop_value != 0) return HOOKE_STOPPED;
  }
}

static int32_t store(hooke_integrator *it, double t, hooke_state *state) {
  const struct hk_rk8pd *own = it->own;
  return hk_unknowns_store(it, &own->unknowns, t, own->y, state);
}

static const struct hk_steps steps = {create, destroy, NULL, begin, step, store};
#define STEPS &steps

#else

#define STEPS NULL

#endif

const struct hk_method hk_rk8pd = {
    .name = "rk8pd",
    .summary = "GSL, error-controlled, explicit Runge-Kutta, order 8; to check a reference",
    .needs = "GSL",
    .reference = 1,
    .adaptive = 1,
    .takes = HOOKE_TAKES_ALL,
    .steps = STEPS};
