/* Limits, why, needs, study, comparison, pick, cost. Times are not among the results. */
#include "scenarios.h"

#include <math.h>
#include <stdio.h>

/* A mass that swings on a spring along x, the other end pinned. */
static hooke_system *make_oscillator(struct attempt *a) {
  const double position[] = {0, 0, 0, 1.1, 0, 0}, mass = 1.0;
  const int64_t ends[] = {0, 1}, first = 0;
  hooke_system *system = NULL;
  hooke_options *springs = NULL;
  TRY(a, hooke_system_create(&system));
  TRY(a, hooke_system_add_particles(system, 2, position, NULL, 1, &mass, NULL));
  TRY(a, hooke_system_pin(system, 1, &first));
  TRY(a, hooke_options_create("springs", &springs));
  TRY(a, hooke_options_set_number(springs, "stiffness", 100));
  TRY(a, hooke_options_set_number(springs, "damping", 0.5));
  TRY(a, hooke_options_set_number(springs, "rest_length", 1));
  TRY(a, hooke_system_add_springs(system, "spring", 1, ends, springs));
  TRY(a, hooke_system_commit(system));
  hooke_options_destroy(springs);
  return system;
end:
  hooke_options_destroy(springs);
  hooke_system_destroy(system);
  return NULL;
}

/* From the start, since a failed attempt may have left it. */
static int32_t go_along(hooke_measurement *limit, const hooke_state *start, hooke_state *state) {
  const int32_t status = hooke_state_copy(start, state);
  return status != HOOKE_OK ? status : hooke_measurement_run(limit, state);
}

static void limit(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 5);
  hooke_options *run = system ? make_run(a, NULL, 1e-4, 2e-4, 0.0) : NULL;
  hooke_measurement *limit = run ? make_limit(a, system, run, with ? NULL : "predict") : NULL, *along = NULL;
  hooke_state *state = NULL, *other = NULL;
  if (limit == NULL) goto end;
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_state_create(system, &other));
  TRY(a, hooke_measurement_run(limit, state));
  for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
    attempt_number(a, hooke_measurement_number(limit, "rows", k, "predicted"));
    attempt_number(a, hooke_measurement_number(limit, "rows", k, "measured"));
    attempt_text(a, hooke_measurement_text(limit, "rows", k, "note"));
  }
  attempt_number(a, hooke_measurement_number(limit, "blame", 0, "share"));
  attempt_text(a, hooke_measurement_text(limit, "blame", 0, "group"));
  attempt_text(a, hooke_measurement_text(limit, "changes", 0, "sentence"));
  attempt_number(a, hooke_measurement_number(limit, "changes", 0, "gain"));
  attempt_number(a, hooke_measurement_number(limit, "modes", 0, "frequency"));
  if (with == NULL) {
    along = make_limit(a, system, run, "along");
    if (along == NULL) goto end;
    TRY(a, go_along(along, state, other));
    attempt_number(a, hooke_measurement_number(along, "rows", 0, "smallest"));
  }
end:
  hooke_measurement_destroy(along);
  hooke_state_destroy(other);
  hooke_state_destroy(state);
  hooke_measurement_destroy(limit);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void why(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 3);
  hooke_options *run = system ? make_run(a, "symplectic-euler", 0.05, 100.0, 1.0) : NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL, *last = NULL;
  hooke_measurement *why = NULL;
  hooke_options *options = NULL;
  (void)with;
  if (run == NULL) goto end;
  TRY(a, hooke_integrator_create(system, run, &integrator));
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_state_create(system, &last));
  TRY_FOR(a, hooke_integrator_run(integrator, last), HOOKE_DIVERGED);
  TRY(a, hooke_options_create("why", &options));
  TRY(a, hooke_options_set_number(options, "budget", 1e300));
  TRY(a, hooke_why_create(integrator, options, &why));
  TRY(a, hooke_measurement_run(why, NULL));
  attempt_text(a, hooke_measurement_text(why, "why", 0, "cause"));
  attempt_text(a, hooke_measurement_text(why, "why", 0, "sentence"));
  attempt_number(a, hooke_measurement_number(why, "why", 0, "limit"));
  hooke_measurement_destroy(why);
  why = NULL;
  TRY(a, hooke_why_create_kept(system, run, state, last, options, &why));
  TRY(a, hooke_measurement_run(why, NULL));
  attempt_text(a, hooke_measurement_text(why, "why", 0, "sentence"));
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice"); k++)
    attempt_text(a, hooke_measurement_text(why, "advice", k, "change"));
  if (hooke_measurement_row_count(why, "advice") > 0) TRY(a, hooke_why_advice_apply(why, 0, run));
  attempt_number(a, hooke_options_number(run, "step"));
end:
  hooke_measurement_destroy(why);
  hooke_options_destroy(options);
  hooke_state_destroy(last);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void needs(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 4);
  hooke_options *run = system ? make_run(a, "symplectic-euler", 1e-3, 0.1, 0.02) : NULL;
  hooke_measurement *needs = make_needs(a, system, run, 0), *finer = make_needs(a, system, run, 1);
  (void)with;
  if (needs == NULL || finer == NULL) goto end;
  TRY(a, hooke_measurement_run(needs, NULL));
  TRY(a, hooke_measurement_run(finer, NULL));
  for (int64_t k = 0; k < hooke_measurement_row_count(needs, "rows"); k++) {
    attempt_text(a, hooke_measurement_text(needs, "rows", k, "without"));
    attempt_number(a, hooke_measurement_number(needs, "rows", k, "error"));
    attempt_number(a, hooke_measurement_number(needs, "rows", k, "needed"));
  }
  attempt_number(a, hooke_measurement_number(finer, "parts", 0, "change"));
  attempt_number(a, (double)hooke_system_count(hooke_needs_lean(needs), "springs"));
end:
  hooke_measurement_destroy(needs);
  hooke_measurement_destroy(finer);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void study(struct attempt *a, const void *with) {
  hooke_system *system = make_oscillator(a);
  hooke_options *run = system ? make_run(a, NULL, 0.0, 0.05, 0.01) : NULL;
  hooke_measurement *study = make_study(a, system, run, "symplectic-euler,rk4,cvode-adams");
  (void)with;
  if (study == NULL) goto end;
  TRY(a, hooke_measurement_run(study, NULL));
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    attempt_text(a, hooke_measurement_text(study, "rows", k, "status"));
    attempt_number(a, hooke_measurement_number(study, "rows", k, "error"));
  }
  attempt_number(a, hooke_measurement_number(study, "orders", 0, "order"));
  attempt_number(a, hooke_measurement_number(study, "reference", 0, "agreement"));
  TRY(a, hooke_study_recommend(study, 1e-3));
end:
  hooke_measurement_destroy(study);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void pick(struct attempt *a, const void *with) {
  hooke_system *system = make_oscillator(a);
  hooke_options *run = system ? make_run(a, NULL, 0.0, 0.2, 0.1) : NULL;
  hooke_options *options = NULL;
  hooke_measurement *estimate = NULL;
  (void)with;
  if (run == NULL) goto end;
  TRY(a, hooke_options_create("estimate", &options));
  TRY(a, hooke_options_set_number(options, "want", 1e-3));
  TRY(a, hooke_measurement_create("estimate", system, NULL, options, &estimate));
  TRY(a, hooke_estimate_pick(estimate, NULL, run));
end:
  hooke_measurement_destroy(estimate);
  hooke_options_destroy(options);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void compare(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 3);
  hooke_options *run = system ? make_run(a, NULL, 1e-3, 0.02, 0.01) : NULL;
  hooke_measurement *comparison = make_comparison(a, system, run, "verlet,cvode-bdf");
  (void)with;
  if (comparison == NULL) goto end;
  TRY(a, hooke_measurement_run(comparison, NULL));
  for (int64_t k = 0; k < hooke_measurement_row_count(comparison, "rows"); k++) {
    attempt_text(a, hooke_measurement_text(comparison, "rows", k, "status"));
    attempt_number(a, hooke_measurement_number(comparison, "rows", k, "error"));
    attempt_number(a, hooke_measurement_number(comparison, "rows", k, "energy_drift"));
  }
end:
  hooke_measurement_destroy(comparison);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void cost(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 3);
  hooke_options *run = system ? make_run(a, "verlet", 1e-3, 0.02, 0.01) : NULL, *options = NULL;
  hooke_measurement *cost = NULL;
  hooke_state *state = NULL;
  if (run == NULL) goto end;
  TRY(a, hooke_options_create("cost", &options));
  if (with) TRY(a, hooke_options_set_number(options, "groups", 0));
  TRY(a, hooke_options_set_number(options, "budget", 5e-4));
  TRY(a, hooke_measurement_create("cost", system, run, options, &cost));
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_measurement_run(cost, state));
  for (int64_t k = 0; k < hooke_measurement_row_count(cost, "rows"); k++) {
    attempt_text(a, hooke_measurement_text(cost, "rows", k, "ingredient"));
    attempt_number(a, hooke_measurement_number(cost, "rows", k, "step_limit_without"));
  }
end:
  hooke_state_destroy(state);
  hooke_measurement_destroy(cost);
  hooke_options_destroy(options);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

const struct scenario measuring[] = {
    {"limit, predicted", limit, NULL, 1, "lapack", NULL},
    {"limit, measured", limit, "", 5, "lapack", NULL},
    {"why", why, NULL, 20, "lapack", NULL},
    {"needs", needs, NULL, 300, NULL, NULL},
    {"study", study, NULL, 100, "sundials gsl", NULL},
    {"pick", pick, NULL, 2000, "sundials gsl", NULL},
    {"compare", compare, NULL, 3, "sundials", NULL},
    {"cost", cost, NULL, 5, "lapack", NULL},
    {"cost, groups left out", cost, "", 5, "lapack", NULL},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
