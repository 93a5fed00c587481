#include "measure/why/why_trial.h"

#include "core/number.h"
#include "core/print.h"
#include "integrate/loop/run_loop.h"
#include "model/group.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TRIALS = 16, ENOUGH = 2 };

/* ---- trials ---- */

/* Evaluations of the run up to the failure, times its size. */
static double work_of_run(const hooke_integrator *run, double size) {
  return size * (double)(run->count.force_evaluations + run->count.derivative_products);
}

/* The start of the run: the kept one, else the system's own. If a trial could not reach the failure from
 * there, the earliest of the last good states. */
static void find_first(struct hk_trials *trials) {
  const hooke_integrator *run = trials->inquiry->run;
  const hooke_state *oldest = hk_recent_state(&run->recent, run->recent.count - 1, NULL);
  trials->late = work_of_run(run, trials->size) > 0.5 * HOOKE_TRIAL_WORK && *oldest->t > run->t0;
  trials->first = trials->late ? oldest : run->recent.first;
  if (trials->first) return;
  trials->status = hooke_state_create(trials->inquiry->system, &trials->initial);
  trials->first = run->t0 == 0.0 ? trials->initial : oldest;
}

void hk_trials_begin(struct hk_inquiry *inquiry, struct hk_trials *trials) {
  const hooke_integrator *run = inquiry->run;
  const hooke_system *system = inquiry->system;
  const struct hk_schedule *s = &run->schedule;
  const double span = inquiry->why->noticed - run->t0;
  *trials = (struct hk_trials){.inquiry = inquiry, .step = run->method->adaptive ? NAN : s->step};
  /* a loop of the caller's own has no end: some way past the failure */
  trials->duration = !isnan(s->duration)   ? s->duration
                     : isnan(trials->step) ? 2.0 * span
                                           : 2.0 * fmax(1.0, (double)run->k) * s->step;
  trials->every = s->every_given ? s->every : NAN;
  /* a callback of a script costs far more than springs */
  trials->size =
      (double)(system->particle_count + hk_system_members_of(system, NULL) + 50 + (system->force ? 1000 : 0));
  find_first(trials);
}

void hk_trials_release(struct hk_trials *trials) {
  hooke_state_destroy(trials->initial);
}

void hk_change_begin(struct hk_trials *trials, struct hk_change *change, const char *option) {
  *change = (struct hk_change){.status = &trials->status};
  snprintf(change->option, sizeof change->option, "%s", option);
  if (trials->status == HOOKE_OK) trials->status = hk_options_create(&hk_run_options, &change->run);
}

void hk_change_method(struct hk_change *change, const char *method) {
  if (*change->status == HOOKE_OK) *change->status = hooke_options_set_text(change->run, "method", method);
}

void hk_change_number(struct hk_change *change, const char *name, double value) {
  if (*change->status == HOOKE_OK) *change->status = hooke_options_set_number(change->run, name, value);
}

void hk_change_say(struct hk_change *change, const char *format, ...) {
  va_list args;
  va_start(args, format);
  hk_print_list(change->words, sizeof change->words, format, args);
  va_end(args);
}

void hk_change_drop(struct hk_change *change) {
  hooke_options_destroy(change->run);
  change->run = NULL;
}

/* The options of the run with the changes; frames chosen by hooke are chosen anew. */
static int32_t changed_options(const struct hk_trials *trials, const struct hk_change *change,
                               hooke_options **out) {
  const hooke_integrator *run = trials->inquiry->run;
  int32_t status = hooke_options_copy(run->options, out);
  if (status == HOOKE_OK && !run->schedule.every_given) status = hooke_options_unset(*out, "every");
  if (status == HOOKE_OK && isnan(run->schedule.duration))
    status = hooke_options_set_number(*out, "duration", trials->duration);
  return status == HOOKE_OK ? hk_options_set_from(*out, change->run) : status;
}

/* ---- trials ---- */

struct effort {
  const hooke_integrator *integrator;
  struct hk_inquiry *inquiry;
  double size, work; /* of an evaluation; counted so far [s] */
  int32_t spent;
};

static int32_t watch_work(int64_t step, const hooke_state *state, void *ctx) {
  struct effort *effort = ctx;
  const struct hk_counts *c = &effort->integrator->count;
  (void)step, (void)state;
  hk_inquiry_spend(effort->inquiry, effort->integrator, &effort->work);
  effort->spent = effort->size * (double)(c->force_evaluations + c->derivative_products) > HOOKE_TRIAL_WORK ||
                  !hk_budget_has(&effort->inquiry->budget, 0.0);
  return effort->spent;
}

static int32_t watch_time(double done, const char *method, void *ctx) {
  struct effort *effort = ctx;
  (void)done, (void)method;
  effort->spent = hk_budget_ends(&effort->inquiry->budget, "trying what to do");
  return effort->spent;
}

/* Maximum memory of a run by a method [bytes]. */
static double bytes_of_trial(const struct hk_trials *trials, const char *method) {
  const hooke_integrator *run = trials->inquiry->run;
  const double n = (double)trials->inquiry->system->particle_count;
  const struct hk_method *row = hk_method_find(method);
  const int solves = (row && row->solved) || strcmp(method, "cvode-bdf") == 0;
  /* a particle: vectors of a solver, and matrices of neighbours; else the state and the motion */
  const double numbers = strcmp(method, "cvode-adams") == 0 ? 100.0 : solves ? 300.0 : 25.0;
  const double recent = fmin(16e6, 9.0 * 6.0 * n * sizeof(double)); /* the last states */
  if (strcmp(method, run->method->name) == 0)
    return (double)hooke_integrator_count(run, "memory_bytes") + 6.0 * n * sizeof(double);
  return numbers * n * sizeof(double) + recent;
}

/* Runs as far as the work allows. */
static int32_t run_trial(struct hk_trials *trials, hooke_integrator *integrator, struct hk_trial *trial) {
  hooke_state *state = NULL;
  struct effort effort = {.integrator = integrator, .inquiry = trials->inquiry, .size = trials->size};
  const int64_t stride = integrator->method->adaptive ? 1 : 1 + (int64_t)(1e5 / trials->size);
  int32_t status = hk_state_create_sized(hooke_state_size(trials->first), 1, &state);
  if (status != HOOKE_OK) return status;
  hooke_state_copy(trials->first, state);
  hooke_integrator_on_step(integrator, stride, watch_work, &effort);
  hooke_integrator_on_progress(integrator, 0.0, watch_time, &effort);
  status = hk_run_whole(integrator, state);
  hk_inquiry_spend(trials->inquiry, integrator, &effort.work);
  trial->finished = status == HOOKE_OK;
  trial->diverged = status == HOOKE_DIVERGED;
  trial->failed = !trial->finished && !effort.spent;
  trial->steps = hooke_integrator_count(integrator, "steps");
  if (trial->finished || effort.spent) trial->reached = *state->t;
  hooke_state_destroy(state);
  if (status == HOOKE_STOPPED && !effort.spent) return status;
  return status > 0 || status == HOOKE_SOLVER_FAILED ? HOOKE_OK : status;
}

static int32_t try_run(struct hk_trials *trials, const hooke_system *system, const hooke_options *options,
                       struct hk_trial *trial) {
  hooke_integrator *integrator = NULL;
  trials->count++;
  trial->failed = 1;
  int32_t status = hooke_integrator_create(system, options, &integrator);
  if (status == HOOKE_BAD_VALUE || status == HOOKE_NOT_BUILT)
    return HOOKE_OK; /* it does not fit: not to be suggested */
  if (status == HOOKE_OK) status = run_trial(trials, integrator, trial);
  hooke_integrator_destroy(integrator);
  return status;
}

/* Describes the result of the trial; 0 if it did not get past the failure. */
static int proves(const struct hk_trials *trials, double reached, int32_t finished, char *text, size_t size) {
  const double noticed = trials->inquiry->why->noticed, begun = *trials->first->t;
  if (!finished && !(reached > noticed + 0.5 * (noticed - begun))) return 0;
  if (trials->late)
    hk_print(text, size, " (tried from t = %.6g s to %.6g s: there it is well)", begun, reached);
  else if (finished)
    snprintf(text, size, " (tried: it runs to its end)");
  else
    hk_print(text, size, " (tried up to t = %.3g s: there it is well)", reached);
  return 1;
}

/* 1 if there is time and memory for a trial; otherwise that is recorded. */
static int32_t can_try(const struct hk_trials *trials, const hooke_options *options) {
  struct hk_inquiry *inquiry = trials->inquiry;
  const double bytes = bytes_of_trial(trials, hooke_options_text(options, "method"));
  if (hk_budget_ends(&inquiry->budget, "trying what to do")) return 0;
  return hk_inquiry_has_memory(inquiry, bytes, "trials of what to do");
}

void hk_trials_try(struct hk_trials *trials, const hooke_system *system, const struct hk_change *change,
                   struct hk_trial *trial) {
  hooke_options *options = NULL;
  *trial = (struct hk_trial){.reached = -INFINITY};
  if (trials->status == HOOKE_OK) trials->status = changed_options(trials, change, &options);
  trial->tried = trials->status == HOOKE_OK && can_try(trials, options);
  if (trial->tried) trials->status = try_run(trials, system, options, trial);
  if (trial->tried && trials->status == HOOKE_OK)
    proves(trials, trial->reached, trial->finished, trial->proof, sizeof trial->proof);
  hooke_options_destroy(options);
}

/* ---- advice ---- */

static int same_changes(const hooke_options *a, const hooke_options *b) {
  for (int64_t k = 0; k < hooke_options_row_count(a); k++) {
    const char *name = hooke_options_row(a, k, "name");
    if (hooke_options_is_set(a, name) != hooke_options_is_set(b, name)) return 0;
    if (!hooke_options_is_set(a, name)) continue;
    if (strcmp(hooke_options_text(a, name), hooke_options_text(b, name)) != 0) return 0;
    if (hooke_options_number_count(a, name) && hooke_options_number(a, name) != hooke_options_number(b, name))
      return 0;
  }
  return 1;
}

static int is_known(const struct hk_trials *trials, const struct hk_change *change) {
  const struct hk_why *why = trials->inquiry->why;
  for (int64_t k = 0; k < why->advice_count; k++) {
    if (why->advice[k].run && same_changes(why->advice[k].run, change->run)) return 1;
  }
  return 0;
}

void hk_trials_take(struct hk_trials *trials, struct hk_change *change, const char *proof) {
  struct hk_why *why = trials->inquiry->why;
  if (change->run == NULL || trials->status != HOOKE_OK) {
    hk_change_drop(change);
    return;
  }
  struct hk_why_advice *advice = &why->advice[why->advice_count++];
  advice->run = change->run;
  advice->want = NAN;
  change->run = NULL;
  snprintf(advice->change, sizeof advice->change, "%s%s", change->words, proof);
  snprintf(advice->option, sizeof advice->option, "%s", change->option);
  if (hooke_options_number_count(advice->run, change->option) > 0)
    hk_number_print(hooke_options_number(advice->run, change->option), advice->value);
  else
    snprintf(advice->value, sizeof advice->value, "%s", hooke_options_text(advice->run, change->option));
}

int32_t hk_trials_offer(struct hk_trials *trials, struct hk_change *change) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  struct hk_trial trial = {.proof = ""};
  if (change->run && inquiry->why->advice_count < ENOUGH && trials->count < MOST_TRIALS &&
      !is_known(trials, change)) {
    hk_trials_try(trials, inquiry->system, change, &trial);
    /* another method is worth the trial of a third one */
    const int32_t cut = !trial.tried || inquiry->budget.spent || strcmp(change->option, "step") == 0;
    if (!trial.proof[0] && trials->backed && cut && !trial.failed) {
      snprintf(trial.proof, sizeof trial.proof, " (not tried%s, for want of %s)",
               trial.tried ? " to its end" : "", trial.tried || inquiry->budget.spent ? "time" : "memory");
    }
    if (trial.proof[0]) hk_trials_take(trials, change, trial.proof);
  }
  hk_change_drop(change);
  return trials->status == HOOKE_OK && trial.proof[0];
}
