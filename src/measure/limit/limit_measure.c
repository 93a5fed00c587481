#include "measure/limit/limit_measure.h"

#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "integrate/method.h"
#include "measure/trial/bracket.h"
#include "measure/limit/growth.h"
#include "measure/spectrum/mode_growth.h"

#include <math.h>
#include <stddef.h>

static const char OUT_OF_TIME[] = "the budget ended before the limit was found";
static const char WITHIN[] = "the budget ended early: the limit measured is certain to 5 % only";
static const char TOO_SLOW[] = "growth near the limit is too slow for a run to show it";
static const char TOO_SLOW_WITHIN[] = "growth near the limit is too slow for a run to show it: the limit "
                                      "measured is certain to 5 % only";
static const char UNSOLVED[] = "the method did not solve its step while the limit was measured";
static const char DIFFERS[] = "a mode that the prediction did not name limits the step";

/* ---- the linear twin ---- */

/* Motion that doubles in a step, were it a millionth of all, has outgrown the rest after so many. */
enum { STEPS_OF_VIOLENCE = 20 };

struct trial {
  const struct hk_limit *limit;
  struct hk_growth *growth;
  int64_t most_steps;
  double predicted; /* [s] */
  const struct hk_stability *stability;
  int32_t exact;  /* the prediction knows all modes that may limit the step */
  int32_t slow;   /* needs damping: steadiness means that growth is too slow to be seen */
  int32_t degree; /* if slow, growth is that of (omega h)^(2 degree) */
  int32_t coarse; /* the accuracy is less than was asked for */
  const char *note;
};

/* Certainty that a search which ended early needs for its result to be reported. */
static const double CERTAIN = 0.05;

/* The rise of the log of an amplitude that a run shows for certain; where it never falls, much less does. */
static const double CERTAIN_RISE = 3.0, CERTAIN_IF_CONVEX = 0.1;

/* 1 if a run at `step`, or at one as far above the limit, grows by so much in its steps, as eigenvalues have
 * it. Without them, or where they limit nothing, it may; where only some are known, another mode may grow
 * more slowly than any of them. */
static int is_seen(const struct trial *trial, double step) {
  if (isinf(trial->predicted)) return 1;
  if (trial->limit->mode_count > 0 && !trial->exact) return 0;
  const double mirrored = trial->predicted * trial->predicted / step, h = fmax(step, mirrored);
  double growth = trial->limit->mode_count > 0 ? 0.0 : INFINITY;
  for (int64_t k = 0; k < trial->limit->mode_count; k++) {
    const struct hk_limit_mode *mode = &trial->limit->mode[k];
    growth = fmax(growth, log(hk_eigenvalue_growth(trial->stability, h, mode->real, mode->imaginary)));
  }
  const double least = trial->growth->is_convex ? CERTAIN_IF_CONVEX : CERTAIN_RISE;
  return growth * (double)trial->most_steps > least;
}

static int32_t try_frozen(void *ctx, double step, enum hk_trial_end *end) {
  struct trial *trial = ctx;
  enum hk_verdict verdict = HOOKE_STEADY;
  int32_t status = HOOKE_OK;
  if (!trial->slow || is_seen(trial, step))
    status = hk_growth_see(trial->growth, step, 0, trial->most_steps, &verdict);
  if (status != HOOKE_OK) return status;
  *end = verdict == HOOKE_GROWS ? HOOKE_TRIAL_FAILS : HOOKE_TRIAL_HOLDS;
  if (verdict == HOOKE_OUT_OF_TIME) trial->note = OUT_OF_TIME;
  if (verdict == HOOKE_UNSOLVED) trial->note = UNSOLVED;
  if (verdict == HOOKE_STEADY && trial->slow) trial->note = TOO_SLOW;
  if (trial->note) *end = HOOKE_TRIAL_UNKNOWN;
  return HOOKE_OK;
}

static int is_symplectic(const struct trial *trial) {
  const int32_t kind = trial->stability->kind;
  return kind == HOOKE_STABLE_BY_K || kind == HOOKE_STABLE_BY_PREDICTION || kind == HOOKE_STABLE_BY_K_AND_C;
}

/* A fraction e above the limit, undamped motion grows by 1 + sqrt(8 e) a step of a symplectic method, and by
 * 1 + 7 e of rk4; damped motion by 1 + 2 e or somewhat less, and by 1 + 2 zeta^2 e of forward Euler, which a
 * run may not show: told apart to a quarter of the accuracy. Undamped motion then has 24 powers of e to grow
 * by, of which a rise above all swings takes 7, and as much where only the random share grows (growth.c). */
static int64_t steps_for(const struct trial *trial) {
  const double accuracy = trial->growth->accuracy;
  if (trial->slow) return 1000 + (int64_t)fmin(4000.0 / accuracy, 1e15);
  if (trial->growth->twin->lin.damped || !is_symplectic(trial))
    return 1000 + (int64_t)fmin(40.0 / accuracy, 1e15);
  return 200 + (int64_t)fmin(24.0 / sqrt(2.0 * accuracy), 1e15);
}

/* A mode whose limit lies lower by the accuracy has 16 powers of e, or more, to rise from random motion. */
static int64_t steps_to_confirm(const struct trial *trial) {
  const double accuracy = trial->growth->accuracy;
  if (trial->coarse) return trial->most_steps;
  if (trial->growth->twin->lin.damped || trial->slow) return 1000 + (int64_t)fmin(8.0 / accuracy, 1e15);
  if (is_symplectic(trial)) return steps_for(trial);
  return 1000 + (int64_t)fmin(2.3 / accuracy, 1e15);
}

/* Checks for a mode that the search did not see: it needs a run just below the limit found. */
static int32_t confirm(struct trial *trial, struct hk_bracket *bracket) {
  for (int k = 0; k < 5 && !bracket->unknown && bracket->holds > 0.0 && isfinite(bracket->fails); k++) {
    const double found = bracket->holds;
    enum hk_verdict verdict;
    const double step = found * (1.0 - 0.5 * bracket->accuracy);
    const int32_t status = hk_growth_see(trial->growth, step, 1, steps_to_confirm(trial), &verdict);
    if (status != HOOKE_OK) return status;
    if (verdict == HOOKE_OUT_OF_TIME) {
      trial->note = "the budget ended before the limit was confirmed";
      return HOOKE_OK;
    }
    if (verdict != HOOKE_GROWS) return HOOKE_OK;
    trial->note = NULL;
    bracket->fails = found;
    bracket->holds = 0.0;
    const int32_t searched = hk_bracket_search(bracket, found);
    if (searched != HOOKE_OK) return searched;
    if (!trial->note) trial->note = DIFFERS;
  }
  return HOOKE_OK;
}

static void read_bracket(const struct hk_bracket *bracket, struct hk_measured_limit *out) {
  const int both = bracket->holds > 0.0 && isfinite(bracket->fails);
  if (both && (!bracket->unknown || bracket->fails - bracket->holds < 2.0 * CERTAIN * bracket->fails))
    out->step = 0.5 * (bracket->holds + bracket->fails);
  else if (bracket->unknown)
    out->step = NAN;
  else if (isinf(bracket->fails))
    out->step = INFINITY;
  else
    out->step = 0.0, out->never_stable = 1;
}

/* Predicted stable at no step: growth has to be seen at small ones. Predicted stable at every step: none may
 * be seen at large ones, where it would be violent. `confirmed` is 0 if the bracket contradicts. */
static int32_t try_extremes(struct trial *trial, struct hk_bracket *bracket, int small, int *confirmed) {
  static const double fraction[2][3] = {{10.0, 100.0, 1000.0}, {0.3, 0.1, 0.03}};
  const int64_t most_steps = trial->most_steps;
  *confirmed = 1;
  if (!small) trial->most_steps = STEPS_OF_VIOLENCE;
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 3 && *confirmed && status == HOOKE_OK; k++) {
    const double part = small ? pow(fraction[small][k], 1.0 / trial->degree) : fraction[small][k];
    const double step = part * trial->growth->twin->lin.slow_step;
    enum hk_trial_end end = HOOKE_TRIAL_UNKNOWN;
    status = try_frozen(trial, step, &end);
    if (end == HOOKE_TRIAL_UNKNOWN) bracket->unknown = 1;
    if (end == HOOKE_TRIAL_HOLDS) bracket->holds = fmax(step, bracket->holds);
    if (end == HOOKE_TRIAL_FAILS) bracket->fails = fmin(step, bracket->fails);
    *confirmed = end == (small ? HOOKE_TRIAL_FAILS : HOOKE_TRIAL_HOLDS);
  }
  trial->most_steps = most_steps;
  return status;
}

static int32_t measure(struct trial *trial, struct hk_measured_limit *out) {
  const double predicted = trial->predicted;
  const double slow_step = trial->growth->twin->lin.slow_step;
  struct hk_bracket bracket = {.try_step = try_frozen,
                               .ctx = trial,
                               .accuracy = trial->growth->accuracy,
                               .sharp = 1,
                               .least = 1e-6 * slow_step,
                               .most = 2e3 * slow_step,
                               .fails = INFINITY};
  if (isinf(slow_step)) {
    out->step = INFINITY;
    return HOOKE_OK;
  }
  double guess = predicted;
  if (predicted == 0.0 || isinf(predicted)) {
    int confirmed;
    const int32_t status = try_extremes(trial, &bracket, predicted == 0.0, &confirmed);
    if (status != HOOKE_OK || confirmed || bracket.unknown) {
      read_bracket(&bracket, out);
      return status;
    }
    guess = predicted == 0.0 ? bracket.holds : bracket.fails;
  } else if (isnan(predicted)) {
    guess = slow_step;
  } else {
    bracket.least = fmin(bracket.least, 1e-3 * predicted);
    bracket.most = fmax(bracket.most, 1e3 * predicted);
  }
  int32_t status = hk_bracket_search(&bracket, guess);
  if (status == HOOKE_OK) status = confirm(trial, &bracket);
  read_bracket(&bracket, out);
  return status;
}

/* Less accuracy where growth at what was asked for is too slow. */
static void choose_accuracy(struct trial *trial) {
  const double nearest = 0.25 * trial->growth->accuracy;
  const int is_limit = trial->predicted > 0.0 && isfinite(trial->predicted);
  if (!trial->slow || !is_limit || is_seen(trial, trial->predicted * (1.0 + nearest))) return;
  trial->growth->accuracy = fmax(trial->growth->accuracy, CERTAIN);
  trial->coarse = 1;
}

static void find_note(const struct trial *trial, struct hk_measured_limit *out) {
  const int known = !isnan(out->step);
  if (trial->note) out->note = trial->note;
  if (known && trial->note == OUT_OF_TIME) out->note = WITHIN;
  if (known && (trial->note == TOO_SLOW || (trial->coarse && !trial->note))) out->note = TOO_SLOW_WITHIN;
}

int32_t hk_limit_measure(const struct hk_limit *limit, const struct hk_limit_row *row, const double *q,
                         const double *v, double predicted, double accuracy, struct hk_budget *budget,
                         struct hk_measured_limit *out) {
  struct hk_twin twin;
  struct hk_growth growth;
  *out = (struct hk_measured_limit){.step = NAN, .note = ""};
  int32_t status = hk_twin_create(limit->system, q, v, &twin);
  if (status != HOOKE_OK) return status;
  status = hk_growth_create(&twin, limit->run, row->method, row->has_mode ? row->mode : NULL, accuracy,
                            budget, &growth);
  if (status == HOOKE_OK) {
    const struct hk_stability *stability = hk_method_stability_in(row->method, limit->system);
    const int slow = hk_method_needs_damping(row->method) && !limit->system->overdamped;
    growth.is_named = predicted > 0.0 && isfinite(predicted);
    growth.turns_at_rest = stability->kind == HOOKE_STABLE_BY_K;
    growth.is_convex = !twin.lin.damped && stability->kind == HOOKE_STABLE_BY_POLYNOMIAL;
    struct trial trial = {.limit = limit,
                          .growth = &growth,
                          .predicted = predicted,
                          .exact = row->exact,
                          .stability = stability,
                          .slow = slow,
                          .degree = slow ? stability->degree : 1};
    trial.most_steps = steps_for(&trial);
    choose_accuracy(&trial);
    status = measure(&trial, out);
    out->steps_run = growth.steps_run;
    find_note(&trial, out);
    hk_growth_release(&growth);
  }
  hk_twin_release(&twin);
  return status;
}

/* ---- the scene itself ---- */

struct whole {
  const hooke_system *system;
  const hooke_state *start;
  hooke_options *run;
  hooke_state *state;
  double duration;
  int64_t steps_run;
  struct hk_budget *budget;
};

/* The whole duration, rounded up to whole steps. */
static int32_t try_whole(void *ctx, double step, enum hk_trial_end *end) {
  struct whole *whole = ctx;
  hooke_integrator *integrator = NULL;
  const double duration = step * fmax(1.0, ceil(whole->duration / step * (1.0 - 1e-12)));
  int32_t status = hooke_options_set_number(whole->run, "step", step);
  if (status == HOOKE_OK) status = hooke_options_set_number(whole->run, "duration", duration);
  if (status == HOOKE_OK) status = hooke_options_unset(whole->run, "every");
  if (status == HOOKE_OK) status = hooke_integrator_create(whole->system, whole->run, &integrator);
  if (status == HOOKE_OK)
    status = hooke_integrator_on_progress(integrator, 0.0, hk_budget_watch, whole->budget);
  if (status == HOOKE_OK) status = hooke_state_copy(whole->start, whole->state);
  if (status == HOOKE_OK) status = hk_run_whole(integrator, whole->state);
  if (integrator) whole->steps_run += hooke_integrator_count(integrator, "steps");
  hooke_integrator_destroy(integrator);
  *end = status == HOOKE_OK ? HOOKE_TRIAL_HOLDS : HOOKE_TRIAL_FAILS;
  if (status == HOOKE_STOPPED && whole->budget->stopped)
    return hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop while a limit was measured");
  if (status == HOOKE_STOPPED && whole->budget->spent) {
    *end = HOOKE_TRIAL_UNKNOWN;
    return HOOKE_OK;
  }
  return status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED ? HOOKE_OK : status;
}

static int32_t measure_whole(struct whole *whole, double predicted, double accuracy,
                             struct hk_measured_limit *out) {
  struct hk_linearised lin;
  const double *q = hooke_state_position((hooke_state *)whole->start);
  int32_t status = hk_linearised_create(whole->system, q, NULL, NULL, NULL, &lin);
  if (status != HOOKE_OK) return status;
  const double guess =
      fmin(whole->duration, predicted > 0.0 && isfinite(predicted) ? predicted : lin.slow_step);
  hk_linearised_release(&lin);
  struct hk_bracket bracket = {.try_step = try_whole,
                               .ctx = whole,
                               .accuracy = accuracy,
                               .least = 1e-4 * guess,
                               .most = whole->duration,
                               .fails = INFINITY};
  status = hk_bracket_search(&bracket, guess);
  out->steps_run = whole->steps_run;
  read_bracket(&bracket, out);
  if (bracket.unknown)
    out->note = isnan(out->step) ? OUT_OF_TIME : WITHIN;
  else if (isinf(out->step))
    out->note = "the run holds even as a single step";
  else if (out->step == 0.0)
    out->note = "the run diverged at every step that was tried";
  return status;
}

int32_t hk_limit_measure_nonlinear(const hooke_system *system, const hooke_state *start,
                                   const hooke_options *run, const char *method, double predicted,
                                   double accuracy, struct hk_budget *budget, struct hk_measured_limit *out) {
  struct whole whole = {.system = system, .start = start, .budget = budget};
  *out = (struct hk_measured_limit){.step = NAN, .note = ""};
  whole.duration = run ? hooke_options_number(run, "duration") : NAN;
  if (!(whole.duration > 0.0))
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  int32_t status = hooke_options_copy(run, &whole.run);
  if (status == HOOKE_OK) status = hooke_options_set_text(whole.run, "method", method);
  if (status == HOOKE_OK) status = hooke_state_create(system, &whole.state);
  if (status == HOOKE_OK) status = measure_whole(&whole, predicted, accuracy, out);
  hooke_options_destroy(whole.run);
  hooke_state_destroy(whole.state);
  return status;
}
