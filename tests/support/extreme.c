#include "extreme.h"

#include "check.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- running ---- */

static int all_finite(int64_t count, const double *value) {
  for (int64_t k = 0; k < count; k++) {
    if (!isfinite(value[k])) return 0;
  }
  return 1;
}

struct watcher {
  const hooke_system *system;
  struct extreme_outcome *outcome;
};

static int32_t watch(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  const struct watcher *watcher = ctx;
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const int64_t size = hooke_state_size(state);
  watcher->outcome->frames++;
  watcher->outcome->wrong_frames += !all_finite(size, q) || !all_finite(size, v) ||
                                    !isfinite(hooke_state_time(state)) ||
                                    isnan(hooke_system_energy(watcher->system, "total", q, v));
  return 0;
}

static int32_t set(hooke_options *options, const char *name, double value) {
  return value == 0.0 ? HOOKE_OK : hooke_options_set_number(options, name, value);
}

static int32_t make_integrator(const hooke_system *system, struct extreme_run run,
                               struct extreme_outcome *outcome, hooke_integrator **integrator) {
  const int64_t frame_steps = run.frame_steps ? run.frame_steps : 1;
  const double duration = (double)run.steps * run.step, every = (double)frame_steps * run.step;
  hooke_options *options = options_with("run", "method=%s", run.method);
  int32_t status = set(options, "duration", duration);
  if (status == HOOKE_OK) status = set(options, "every", every);
  if (status == HOOKE_OK) status = set(options, "rtol", run.rtol);
  if (status == HOOKE_OK) status = set(options, "atol", run.atol);
  if (status == HOOKE_OK) status = set(options, "atol_velocity", run.atol_velocity);
  if (status == HOOKE_OK && hooke_method_is_adaptive(run.method) == 1)
    status = set(options, "max_steps", run.max_steps ? (double)run.max_steps : 1e6);
  else if (status == HOOKE_OK)
    status = set(options, "step", run.step);
  if (status == HOOKE_OK) status = hooke_integrator_create(system, options, integrator);
  hooke_options_destroy(options);
  outcome->start = run.start;
  outcome->end = run.start + duration;
  return status;
}

static double *copy_of(int64_t size, const double *from) {
  double *copy = new_doubles(size);
  if (size > 0) memcpy(copy, from, (size_t)size * sizeof(double));
  return copy;
}

void extreme_run(const hooke_system *system, struct extreme_run run, struct extreme_outcome *outcome) {
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  memset(outcome, 0, sizeof *outcome);
  check_ok(hooke_state_create(system, &state));
  hooke_state_set_time(state, run.start);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  outcome->size = hooke_state_size(state);
  outcome->q0 = copy_of(outcome->size, q);
  outcome->v0 = copy_of(outcome->size, v);
  outcome->energy0 = hooke_system_energy(system, "total", q, v);
  outcome->status = make_integrator(system, run, outcome, &integrator);
  outcome->refused = outcome->status != HOOKE_OK;
  struct watcher watcher = {system, outcome};
  if (!outcome->refused) {
    check_ok(hooke_integrator_on_frame(integrator, watch, &watcher));
    outcome->status = hooke_integrator_run(integrator, state);
    outcome->coincident = hooke_integrator_count(integrator, "coincident_springs");
    outcome->explicit_damping = hooke_integrator_count(integrator, "explicit_damping") == 1;
  }
  if (outcome->status != HOOKE_OK)
    snprintf(outcome->message, sizeof outcome->message, "%s", hooke_last_error());
  outcome->t = hooke_state_time(state);
  outcome->q = copy_of(outcome->size, q);
  outcome->v = copy_of(outcome->size, v);
  outcome->energy = hooke_system_energy(system, "total", q, v);
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
}

void extreme_release(struct extreme_outcome *outcome) {
  free(outcome->q);
  free(outcome->v);
  free(outcome->q0);
  free(outcome->v0);
  memset(outcome, 0, sizeof *outcome);
}

/* ---- judges ---- */

/* Words by which a message suggests an action. */
static int says_what_to_do(const char *message) {
  static const char *const words[] = {"try ", "take ", "allowed", "give ", "needs ", "nearest"};
  for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
    if (strstr(message, words[k]) != NULL) return 1;
  }
  return 0;
}

static int is_documented(int32_t status) {
  return status == HOOKE_OK || status == HOOKE_DIVERGED || status == HOOKE_STEP_LIMIT ||
         status == HOOKE_SOLVER_FAILED || status == HOOKE_BAD_VALUE;
}

const char *extreme_unsound(const struct extreme_outcome *o) {
  if (!is_documented(o->status)) return "a status that no run may end with";
  if (!all_finite(o->size, o->q) || !all_finite(o->size, o->v))
    return "the state has numbers that are not finite";
  if (!isfinite(o->t)) return "the time is no number";
  if (isnan(o->energy0) || isnan(o->energy)) return "the energy is not a number";
  if (o->wrong_frames > 0) return "a frame has numbers that are not finite";
  if (o->status == HOOKE_OK) return o->t == o->end ? NULL : "the end of the run was not reached";
  if (o->message[0] == '\0') return "there is no message";
  if (!says_what_to_do(o->message)) return "the message does not say what to do";
  if (!(o->t >= o->start && o->t <= o->end)) return "the time is not within the run";
  if (o->refused && (memcmp(o->q, o->q0, (size_t)o->size * sizeof(double)) != 0 || o->t != o->start))
    return "a refusal has changed the state";
  return NULL;
}

const char *extreme_not_right(const struct extreme_outcome *o, double error, double low, double high) {
  const char *complaint = extreme_unsound(o);
  if (complaint) return complaint;
  if (o->status != HOOKE_OK) return "the run did not come to its end";
  return error >= low && error <= high ? NULL : "the error is not within its bounds";
}

const char *extreme_not_ended(const struct extreme_outcome *o, int32_t status, const char *text) {
  const char *complaint = extreme_unsound(o);
  if (complaint) return complaint;
  if (o->status != status) return "another status was promised";
  return strstr(o->message, text) ? NULL : "the message does not name the cause";
}

const char *extreme_not_refused(const struct extreme_outcome *o) {
  const char *complaint = extreme_unsound(o);
  if (complaint) return complaint;
  return o->status != HOOKE_OK ? NULL : "the run came to its end";
}

double extreme_error(const struct extreme_outcome *o, const double *expected, double scale) {
  double most = 0.0;
  for (int64_t k = 0; k < o->size; k++) {
    const double error = fabs(o->q[k] - expected[k]) / scale;
    if (!(error <= most)) most = isnan(error) ? INFINITY : error;
  }
  return most;
}

void extreme_demand(const char *family, const char *name, const char *method, const char *complaint,
                    const struct extreme_outcome *o) {
  if (complaint == NULL) return;
  print_error("%s, %s, %s: %s\n  status %d (%s) at t = %.17g s of %.17g to %.17g\n  message: %s\n", family,
              name, method, complaint, o->status, hooke_status_name(o->status), o->t, o->start, o->end,
              o->message);
  for (int64_t k = 0; k < o->size && k < 12; k++)
    print_error("  %.17g (velocity %.17g)\n", o->q[k], o->v[k]);
  fail();
}

/* ---- rows ---- */

enum { MOST_ROWS = 4096, ROW_SIZE = 200 };

static char rows[MOST_ROWS][ROW_SIZE];
static int row_count;

void extreme_note(const char *family, const char *name, const char *method, const char *words) {
  assert_true(row_count < MOST_ROWS);
  const int length =
      snprintf(rows[row_count++], ROW_SIZE, "row\t%s\t%s\t%s\t%s", family, name, method, words);
  assert_true(length > 0 && length < ROW_SIZE);
}

void extreme_record(const char *family, const char *name, const char *method, const struct extreme_outcome *o,
                    double error) {
  char words[64];
  if (o->status != HOOKE_OK)
    snprintf(words, sizeof words, "%s", hooke_status_name(o->status));
  else if (isnan(error))
    snprintf(words, sizeof words, "runs");
  else
    snprintf(words, sizeof words, "%.0e", error);
  extreme_note(family, name, method, words);
}

int extreme_finish(int argc, char **argv, int failed) {
  if (argc == 2 && strcmp(argv[1], "--rows") == 0) {
    for (int k = 0; k < row_count; k++)
      puts(rows[k]);
  }
  return failed;
}
