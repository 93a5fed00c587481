/* Limits, why, needs, study, comparison, pick, cost. Times are not among the results. */
#include "scenarios.h"

#include <string.h>

/* From the start, since a failed attempt may have left it. */
static int32_t go_along(hooke_measurement *limit, const hooke_state *start, hooke_state *state) {
  const int32_t status = hooke_state_copy(start, state);
  return status != HOOKE_OK ? status : hooke_measurement_run(limit, state);
}

/* Texts and numbers of the columns of all rows; `columns` ends with NULL, and those of numbers begin with
 * "#". */
static void take_rows(struct attempt *a, const hooke_measurement *m, const char *rows,
                      const char *const *columns) {
  for (int64_t k = 0; k < hooke_measurement_row_count(m, rows); k++) {
    for (const char *const *c = columns; *c; c++) {
      if (**c == '#')
        attempt_number(a, hooke_measurement_number(m, rows, k, *c + 1));
      else
        attempt_text(a, hooke_measurement_text(m, rows, k, *c));
    }
  }
}
#define TAKE(m, rows, ...) take_rows(a, m, rows, (const char *const[]){__VA_ARGS__, NULL})

#define LIMIT " accuracy=0.1 methods=symplectic-euler,rk4"

SCENARIO(limit) {
  struct made m = {.system = make_rope(a, 5)};
  m.run = make_options(a, "run", "step=1e-4 duration=2e-4");
  m.measurement = make_measurement(a, "limit", m.system, m.run, with ? LIMIT : "predict=true" LIMIT);
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_state_create(m.system, &m.other));
  TRY(a, hooke_measurement_run(m.measurement, m.state));
  TAKE(m.measurement, "rows", "#predicted", "#measured", "note");
  attempt_number(a, hooke_measurement_number(m.measurement, "blame", 0, "share"));
  attempt_text(a, hooke_measurement_text(m.measurement, "blame", 0, "group"));
  attempt_text(a, hooke_measurement_text(m.measurement, "changes", 0, "sentence"));
  attempt_number(a, hooke_measurement_number(m.measurement, "changes", 0, "gain"));
  attempt_number(a, hooke_measurement_number(m.measurement, "modes", 0, "frequency"));
  if (with == NULL) {
    m.second = make_measurement(a, "limit", m.system, m.run, "along=true" LIMIT);
    if (m.second == NULL) goto end;
    TRY(a, go_along(m.second, m.state, m.other));
    attempt_number(a, hooke_measurement_number(m.second, "rows", 0, "smallest"));
  }
end:
  release(&m);
}

SCENARIO(rest) {
  struct made m = {.system = make_rope(a, 5)};
  m.measurement = make_measurement(a, "rest", m.system, m.run, "watch=3.y");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TAKE(m.measurement, "rest", "status", "#residual", "#minimum");
  TAKE(m.measurement, "watched", "quantity", "#value");
  (void)with;
end:
  release(&m);
}

SCENARIO(why) {
  struct made m = {.system = make_rope(a, 3)};
  m.run = make_options(a, "run", "method=symplectic-euler step=0.05 duration=100 every=1");
  m.options = make_options(a, "why", "budget=1e300");
  if (m.options == NULL) goto end;
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_state_create(m.system, &m.other));
  TRY_FOR(a, hooke_integrator_run(m.integrator, m.other), HOOKE_DIVERGED);
  TRY(a, hooke_why_create(m.integrator, m.options, &m.measurement));
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  attempt_text(a, hooke_measurement_text(m.measurement, "why", 0, "cause"));
  attempt_text(a, hooke_measurement_text(m.measurement, "why", 0, "sentence"));
  attempt_number(a, hooke_measurement_number(m.measurement, "why", 0, "limit"));
  TRY(a, hooke_why_create_kept(m.system, m.run, m.state, m.other, m.options, &m.second));
  TRY(a, hooke_measurement_run(m.second, NULL));
  attempt_text(a, hooke_measurement_text(m.second, "why", 0, "sentence"));
  TAKE(m.second, "advice", "change");
  if (hooke_measurement_row_count(m.second, "advice") > 0) TRY(a, hooke_why_advice_apply(m.second, 0, m.run));
  attempt_number(a, hooke_options_number(m.run, "step"));
end:
  release(&m);
}

SCENARIO(needs) {
  struct made m = {.system = make_rope(a, 4)};
  m.run = make_options(a, "run", "method=symplectic-euler step=1e-3 duration=0.1 every=0.02 threads=2");
  m.measurement = make_measurement(a, "needs", m.system, m.run, "want=1e-2 refine=0");
  m.second = make_measurement(a, "needs", m.system, m.run, "want=1e-2 refine=1");
  if (m.measurement == NULL || m.second == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TRY(a, hooke_measurement_run(m.second, NULL));
  TAKE(m.measurement, "rows", "without", "#error", "#needed");
  attempt_number(a, hooke_measurement_number(m.second, "parts", 0, "change"));
  attempt_number(a, (double)hooke_system_count(hooke_needs_lean(m.measurement), "springs"));
end:
  release(&m);
}

SCENARIO(study) {
  struct made m = {.system = make_oscillator(a)};
  m.run = make_options(a, "run", "duration=0.05 every=0.01");
  m.measurement =
      make_measurement(a, "study", m.system, m.run, "methods=symplectic-euler,rk4,cvode-adams points=6");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TAKE(m.measurement, "rows", "status", "#error");
  attempt_number(a, hooke_measurement_number(m.measurement, "orders", 0, "order"));
  attempt_number(a, hooke_measurement_number(m.measurement, "reference", 0, "agreement"));
  TRY(a, hooke_study_recommend(m.measurement, 1e-3));
end:
  release(&m);
}

SCENARIO(pick) {
  struct made m = {.system = make_oscillator(a)};
  m.run = make_options(a, "run", "duration=0.2 every=0.1");
  m.measurement = make_measurement(a, "estimate", m.system, NULL, "want=1e-3");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_estimate_pick(m.measurement, NULL, m.run));
end:
  release(&m);
}

/* By a reference, if no step is given, whose picking may not fail here. */
SCENARIO(estimate) {
  struct made m = {.system = make_oscillator(a)};
  const char *words = with;
  m.run = make_options(a, "run", "%s", words);
  m.measurement =
      make_measurement(a, "estimate", m.system, NULL, "want=1e-7 watch=1.x,0.reaction,period:1.x");
  if (m.measurement == NULL) goto end;
  if (strstr(words, "step") == NULL) {
    fault_pause();
    const int32_t status = hooke_estimate_pick(m.measurement, "verlet", m.run);
    fault_resume();
    TRY(a, status);
  }
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_integrator_on_frame(m.integrator, hooke_estimate_see, m.measurement));
  TRY(a, hooke_estimate_begin(m.measurement, m.integrator, m.state));
  TRY(a, hooke_estimate_follow(m.measurement, m.integrator));
  TRY(a, hooke_integrator_run(m.integrator, m.state));
  TRY(a, hooke_measurement_run(m.measurement, m.state));
  TAKE(m.measurement, "estimate", "by", "#estimate", "#met", "#heat_excess");
end:
  release(&m);
}

SCENARIO(compare) {
  struct made m = {.system = make_rope(a, 3)};
  m.run = make_options(a, "run", "step=1e-3 duration=0.02 every=0.01");
  m.measurement = make_measurement(a, "study", m.system, m.run, "methods=verlet,cvode-bdf once=1");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TAKE(m.measurement, "rows", "status", "#error", "#energy_drift");
end:
  release(&m);
}

SCENARIO(cost) {
  struct made m = {.system = make_rope(a, 3)};
  m.run = make_options(a, "run", "method=verlet step=1e-3 duration=0.02 every=0.01");
  m.measurement = make_measurement(a, "cost", m.system, m.run, with ? "groups=0 budget=5e-4" : "budget=5e-4");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_measurement_run(m.measurement, m.state));
  TAKE(m.measurement, "rows", "ingredient", "#step_limit_without");
end:
  release(&m);
}

SCENARIO(check) {
  struct made m = {.system = make_rope(a, 3)};
  m.run = make_options(a, "run", "method=verlet step=1 duration=2 every=1");
  m.measurement = make_measurement(a, "check", m.system, m.run, "");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TAKE(m.measurement, "warnings", "kind", "text");
  attempt_number(a, hooke_measurement_number(m.measurement, "check", 0, "memory_bytes"));
end:
  release(&m);
}

const struct scenario measuring[] = {
    {"rest", rest, NULL, 1, "lapack", NULL},
    {"limit, predicted", limit, NULL, 1, "lapack", NULL},
    {"limit, measured", limit, "", 5, "lapack", NULL},
    {"why", why, NULL, 20, "lapack", NULL},
    {"needs", needs, NULL, 300, NULL, NULL},
    {"study", study, NULL, 100, "sundials gsl", NULL},
    {"pick", pick, NULL, 2000, NULL, NULL},
    {"estimate", estimate, "method=verlet step=0.02 duration=0.4 every=0.1", 1, "lapack", NULL},
    {"estimate, judged at its beginning", estimate,
     "method=implicit-midpoint step=0.02 duration=0.4 every=0.1", 1, "lapack", NULL},
    {"estimate, and by rk4", estimate, "method=shardlow step=0.02 duration=0.4 every=0.1", 1, "lapack", NULL},
    {"estimate, at the limit", estimate, "method=symplectic-euler step=0.19 duration=7.6 every=0.19", 1,
     "lapack", NULL},
    {"estimate, by a reference", estimate, "duration=0.4 every=0.1", 1, "lapack", NULL},
    {"compare", compare, NULL, 3, "sundials", NULL},
    {"cost", cost, NULL, 5, "lapack", NULL},
    {"cost, groups left out", cost, "", 5, "lapack", NULL},
    {"check", check, NULL, 5, NULL, NULL},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
