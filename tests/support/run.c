#include "run.h"

#include "check.h"
#include "small.h"

#include <math.h>
#include <string.h>

static void set_number(hooke_options *options, const char *name, double value) {
  if (value != 0.0) check_ok(hooke_options_set_number(options, name, value));
}

hooke_options *run_options(struct run run) {
  hooke_options *options = new_options("run");
  if (run.method != NULL) check_ok(hooke_options_set_text(options, "method", run.method));
  if (run.newton != NULL) check_ok(hooke_options_set_text(options, "newton", run.newton));
  if (run.verlet_damping != NULL)
    check_ok(hooke_options_set_text(options, "verlet_damping", run.verlet_damping));
  if (run.linear_solver != NULL)
    check_ok(hooke_options_set_text(options, "linear_solver", run.linear_solver));
  if (run.newton_tolerance != BY_DEFAULT)
    set_number(options, "newton_tolerance", run.newton_tolerance == 0.0 ? 1e-12 : run.newton_tolerance);
  set_number(options, "step", run.step);
  set_number(options, "duration", run.duration);
  set_number(options, "every", run.every);
  set_number(options, "checkpoint", run.checkpoint);
  set_number(options, "rtol", run.rtol);
  set_number(options, "atol", run.atol);
  set_number(options, "atol_velocity", run.atol_velocity);
  set_number(options, "threads", run.threads);
  return options;
}

hooke_integrator *start_run(const hooke_system *system, struct run run) {
  hooke_integrator *integrator = NULL;
  owned_options *options = run_options(run);
  check_ok(hooke_integrator_create(system, options, &integrator));
  return integrator;
}

hooke_integrator *start_first_order(int64_t size, hooke_rate *rate, void *ctx, struct run run) {
  hooke_integrator *integrator = NULL;
  owned_options *options = run_options(run);
  check_ok(hooke_integrator_create_first_order(size, rate, ctx, options, &integrator));
  return integrator;
}

hooke_state *start_state(const hooke_system *system) {
  hooke_state *state = NULL;
  check_ok(hooke_state_create(system, &state));
  return state;
}

void run_to_end(const hooke_system *system, struct run run, double *q, double *v) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  const size_t size = (size_t)hooke_state_size(state) * sizeof(double);
  if (q != NULL) memcpy(q, hooke_state_position(state), size);
  if (v != NULL) memcpy(v, hooke_state_velocity(state), size);
}

static int32_t create_why(const hooke_integrator *integrator, hooke_measurement **why) {
  owned_options *options = options_with("why", "budget=1e300");
  return hooke_why_create(integrator, options, why);
}

int32_t estimate_of(const hooke_system *system, double want, hooke_measurement **estimate) {
  owned_options *options = NULL;
  int32_t status = hooke_options_create("estimate", &options);
  if (status == HOOKE_OK && !isnan(want)) status = hooke_options_set_number(options, "want", want);
  if (status == HOOKE_OK) status = hooke_measurement_create("estimate", system, NULL, options, estimate);
  return status;
}

int32_t explain_run(const hooke_integrator *integrator, hooke_measurement **why) {
  *why = NULL;
  int32_t status = create_why(integrator, why);
  if (status != HOOKE_OK) return status;
  status = hooke_measurement_run(*why, NULL);
  if (status == HOOKE_OK) return status;
  hooke_measurement_destroy(*why);
  *why = NULL;
  return status;
}

int32_t is_fixed_step(const char *method) {
  return hooke_method_is_built(method) == 1 && hooke_method_is_adaptive(method) == 0;
}

const char *next_method(const char *method, int32_t (*taken)(const char *method)) {
  int64_t m = 0;
  while (method != NULL && strcmp(hooke_method_name(m++), method) != 0)
    ;
  while (m < hooke_method_count() && !taken(hooke_method_name(m)))
    m++;
  return m < hooke_method_count() ? hooke_method_name(m) : NULL;
}

int32_t is_implicit(const char *method) {
  const char *const known[] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
    if (strcmp(method, known[k]) == 0) return 1;
  }
  return 0;
}

double largest(int64_t count, const double *a) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++) {
    if (!(fabs(a[k]) <= most)) most = fabs(a[k]);
  }
  return most;
}

/* Ends the test where a build is without something. */
static void skip_if_not_built(int32_t status, const hooke_system *system) {
  if (status != HOOKE_NOT_BUILT) return;
  hooke_system_destroy((hooke_system *)(uintptr_t)system);
  skip();
}

double bound_at_start(const hooke_system *system, const char *method) {
  hooke_state *state = start_state(system);
  double bound = NAN;
  const int32_t status = hooke_step_bound(system, method, hooke_state_position(state), &bound);
  hooke_state_destroy(state);
  skip_if_not_built(status, system);
  check_status(status, HOOKE_OK);
  return bound;
}

hooke_measurement *start_limit(const hooke_system *system, const hooke_options *run, hooke_options *options) {
  hooke_measurement *limit = NULL;
  const int32_t status = hooke_measurement_create("limit", system, run, options, &limit);
  hooke_options_destroy(options);
  skip_if_not_built(status, system);
  check_status(status, HOOKE_OK);
  return limit;
}

hooke_measurement *limit_at_start(const hooke_system *system, const hooke_options *run,
                                  hooke_options *options) {
  hooke_measurement *limit = start_limit(system, run, options);
  owned_state *state = start_state(system);
  check_ok(hooke_measurement_run(limit, state));
  return limit;
}

hooke_measurement *limits_of(const hooke_system *system, const char *methods, int32_t predict) {
  hooke_options *options =
      options_with("limit", "methods=%s accuracy=1e-3 predict=%d budget=200", methods, predict);
  return limit_at_start(system, NULL, options);
}

void check_limits_met(hooke_system *system, const char *methods) {
  owned_measurement *limit = limits_of(system, methods, 0);
  for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++) {
    const double predicted = hooke_measurement_number(limit, "rows", row, "predicted");
    const double measured = hooke_measurement_number(limit, "rows", row, "measured");
    if (!(fabs(measured / predicted - 1.0) <= 1e-3)) {
      check_failed("%s: measured %.8g, predicted %.8g (%s)",
                   hooke_measurement_text(limit, "rows", row, "method"), measured, predicted,
                   hooke_measurement_text(limit, "rows", row, "note"));
    }
    check_between(hooke_measurement_number(limit, "rows", row, "bound"), 0.3 * measured,
                  measured * (1.0 + 1e-3));
  }
  hooke_system_destroy(system);
}
