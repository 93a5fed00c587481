/* Warnings of a step that is near its limit or above it, while a run goes on. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct warned {
  int64_t count;
  char kind[32], sentence[640];
  double t, limit;
  int64_t spring, particle;
  int32_t answer;
};

static int32_t note(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  struct warned *warned = ctx;
  warned->count++;
  snprintf(warned->kind, sizeof warned->kind, "%s", kind);
  snprintf(warned->sentence, sizeof warned->sentence, "%s", sentence);
  warned->t = t;
  warned->limit = limit;
  warned->spring = spring;
  warned->particle = particle;
  return warned->answer;
}

/* One step of a run with warnings; the bound of the oscillator is its limit. */
static int32_t watch_run(const char *method, double step, struct warned *warned, double *q) {
  owned_system *system = small_oscillator(10.0);
  owned_run(integrator, state, system, .method = method, .step = step, .duration = 10.0 * step,
            .every = step);
  if (warned) check_ok(hooke_integrator_on_warning(integrator, note, warned));
  const int32_t status = hooke_integrator_run(integrator, state);
  if (q) memcpy(q, hooke_state_position(state), 6 * sizeof(double));
  if (status == HOOKE_STOPPED)
    assert_int_equal(hooke_integrator_count(integrator, "stop_value"), warned->answer);
  return status;
}

TEST(test_warnings) {
  const struct {
    const char *method;
    double step;
    const char *kind;
  } cases[] = {
      {"symplectic-euler", 0.188, ""},
      {"symplectic-euler", 0.192, "near-limit"},
      {"symplectic-euler", 0.2001, "above-limit"},
      {"verlet", 0.188, ""},
      {"verlet", 0.192, "near-limit"},
      {"verlet", 0.2001, "above-limit"},
      {"rk4", 0.2456, ""},
      {"rk4", 0.2512, "near-limit"},
      {"rk4", 0.2623, "above-limit"},
      {"forward-euler", 1e-6, "never-stable"},
      {"backward-euler", 100.0, ""},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    struct warned warned = {.count = 0};
    watch_run(cases[k].method, cases[k].step, &warned, NULL);
    assert_string_equal(warned.kind, cases[k].kind);
    assert_int_equal(warned.count, cases[k].kind[0] != '\0');
    if (warned.count == 0) continue;
    const double limit = strcmp(cases[k].kind, "never-stable") == 0 ? 0.0
                         : strcmp(cases[k].method, "rk4") == 0      ? 0.26156
                                                                    : 0.2;
    check_close(warned.limit, limit, 1e-9);
    check_close(warned.t, 0.0, 0.0);
    assert_int_equal(warned.spring, 0);
    assert_int_equal(warned.particle, 1);
    assert_non_null(strstr(warned.sentence, "spring 0 (particles 0 and 1, group springs)"));
  }
}

TEST(test_a_warning_may_stop_the_run) {
  struct warned warned = {.answer = 7};
  check_status(watch_run("verlet", 0.192, &warned, NULL), HOOKE_STOPPED);
  check_message("warning callback returned 7");
}

TEST(test_a_watch_changes_no_bits) {
  double watched[6], alone[6];
  struct warned warned = {.count = 0};
  check_ok(watch_run("symplectic-euler", 0.192, &warned, watched));
  check_ok(watch_run("symplectic-euler", 0.192, NULL, alone));
  assert_int_equal(warned.count, 1);
  check_same_bits(6, watched, alone);
}

/* Each kind once a run, and again in the next run. */
TEST(test_once_a_run) {
  struct warned warned = {.count = 0};
  owned_system *system = small_oscillator(10.0);
  owned_integrator *integrator =
      start_with(system, .method = "symplectic-euler", .step = 0.192, .duration = 1920.0, .every = 0.192);
  check_ok(hooke_integrator_on_warning(integrator, note, &warned));
  for (int k = 1; k <= 2; k++) {
    owned_state *state = start_state(system);
    check_ok(hooke_integrator_run(integrator, state));
    assert_int_equal(warned.count, k);
  }
  check_ok(hooke_integrator_on_warning(integrator, NULL, NULL));
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(warned.count, 2);
}

/* The oscillator of 10 rad/s is stable up to 0.2 s. */
TEST(test_a_step_that_fits) {
  owned_system *system = small_oscillator(10.0);
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state);
  const struct {
    const char *words, *kind;
    double step, duration;
    int64_t told;
  } cases[] = {
      {"method=verlet duration=1", "step", 0.1, 1.0, 1},
      {"method=verlet duration=1 every=0.09", "duration", 0.09, 0.99, 2},
      {"method=verlet duration=1 step=0.08", "step", 1.0 / 13.0, 1.0, 1},
      {"method=verlet duration=1 step=0.3", "duration", 0.3, 0.9, 1},
      {"method=verlet duration=1 step=0.05", "", 0.05, 1.0, 0},
      {"method=cvode-adams duration=1", "", 0.0, 1.0, 0},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    struct warned warned = {.count = 0};
    owned_options *run = options_with("run", "%s", cases[k].words);
    check_ok(hooke_step_fit(system, q, run, note, &warned));
    assert_int_equal(warned.count, cases[k].told);
    assert_string_equal(warned.kind, cases[k].kind);
    check_close(hooke_options_number(run, "duration"), cases[k].duration, 1e-12);
    if (cases[k].step > 0.0) check_close(hooke_options_number(run, "step"), cases[k].step, 1e-12);
  }
  struct warned warned = {.answer = 1};
  owned_options *run = options_with("run", "method=verlet duration=1");
  assert_int_equal(hooke_step_fit(system, q, run, note, &warned), HOOKE_STOPPED);
  owned_options *unstable = options_with("run", "method=forward-euler duration=1");
  assert_int_equal(hooke_step_fit(system, q, unstable, NULL, NULL), HOOKE_UNSUITED);
  assert_true(isnan(hooke_options_number(unstable, "step")));
}
