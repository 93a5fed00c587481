#include "measure/limit/explicit_step.h"

#include "core/status.h"
#include "measure/limit/limit_predict.h"
#include "model/force/force.h"
#include "model/start.h"
#include "model/system.h"

#include "hooke/measurement.h"

#include <math.h>
#include <string.h>

static const double FARTHEST = 2.0; /* times what is certain wherever the particles are */
static const double SHARE = 0.8;    /* of the limit where the scene begins */
static const double STEPS_OF_SOLVE =
    8.0; /* explicit ones that cost one which solves, on a cloth of 32 x 32 */

/* 1 if stiffness may rise above that at the start by more than turns of springs do. */
static int32_t may_stiffen(const hooke_system *system) {
  int32_t may = hk_force_is_present(system, &hk_force_obstacles);
  for (int64_t g = 0; g < system->group_count; g++)
    may |= system->group[g].curve != NULL || system->group[g].scaling != NULL;
  return may;
}

static int32_t may_solve(const hooke_system *system, const struct hk_method *method) {
  return method && method->explicit_step && system->mover_count == 0 && system->generalized == NULL;
}

/* The step at which 4 (h/stiff)^2 + 4 h/damped = 4: stiffness as at the start, dampers in any direction,
 * which may turn until they act together. */
static double meet(double stiff, double damped) {
  const double c = 2.0 / damped, root = 2.0 / stiff;
  return 4.0 / (c + sqrt(c * c + 4.0 * root * root));
}

/* The largest explicit step of verlet by the prediction at the start, no less than the `certain` one. */
static int32_t predict(const hooke_system *system, double certain, double damped, double *most) {
  double limit = 0.0, of_stiffness = 0.0;
  *most = certain;
  if (!(certain > 0.0) || isinf(certain) || may_stiffen(system)) return HOOKE_OK;
  struct hk_budget endless = hk_budget_of(INFINITY, NULL, NULL);
  const double *q = hk_start_position(system);
  int32_t status = hk_limit_sure(system, q, NULL, hk_symplectic_euler.name, &endless, &limit);
  if (status == HOOKE_OK) status = hk_limit_sure(system, q, NULL, hk_verlet.name, &endless, &of_stiffness);
  limit = fmin(limit, meet(SHARE * of_stiffness, damped) / SHARE);
  *most = fmax(certain, fmin(FARTHEST * certain, SHARE * limit));
  return status;
}

int32_t hk_step_cheapest(const hooke_system *system, const char *name, double *step) {
  const struct hk_method *method = hk_method_find(name);
  double certain = 0.0, damped, most = 0.0;
  if (!may_solve(system, method)) return HOOKE_OK;
  int32_t status = method->explicit_step(system, &certain, &damped);
  if (status == HOOKE_OK) status = predict(system, certain, damped, &most);
  if (most > *step / STEPS_OF_SOLVE) *step = fmin(*step, most);
  return status;
}

int32_t hooke_step_settle(const hooke_system *system, hooke_options *run) {
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_run_options_require(run, "run");
  if (status != HOOKE_OK) return status;
  const struct hk_method *method = hk_method_find(hooke_options_text(run, "method"));
  const double step = hooke_options_number(run, "step");
  double certain, most, damped;
  if (!may_solve(system, method) || strcmp(hooke_options_text(run, "verlet_damping"), "auto") != 0)
    return HOOKE_OK;
  status = method->explicit_step(system, &certain, &damped);
  if (status != HOOKE_OK || !(step > certain && step <= FARTHEST * certain)) return status;
  status = predict(system, certain, damped, &most);
  if (status != HOOKE_OK || step > most) return status;
  return hooke_options_set_text(run, "verlet_damping", "explicit");
}

const char *hk_step_limited_as(const hooke_system *system, const hooke_options *run) {
  const char *name = hooke_options_text(run, "method");
  const int32_t solves = !may_solve(system, hk_method_find(name)) ||
                         strcmp(hooke_options_text(run, "verlet_damping"), "explicit") != 0;
  return solves ? name : hk_symplectic_euler.name;
}
