/* Suggestions: changes of the run, the likeliest first, each tried on a run of its own before it is given. */
#include "integrate/method.h"
#include "measure/recommend/soundness.h"
#include "measure/why/why_trial.h"

#include "core/number.h"
#include "core/print.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double TOO_LONG = 1e5; /* times the work of a trial: a run of impractical length */
static const double ACCURACY = 1e-3;
enum { HANDY_TRIES = 9, SHORT_RUN = 1000, SHORT_FRAME = 10 };

/* ---- steps that fit ---- */

static int fits(double step, double whole) {
  const double count = whole / step;
  return isnan(whole) || (count >= 1.0 - 1e-9 && fabs(count - round(count)) <= 1e-9 * count);
}

double hk_handy_step(double step, double limit, double every, double duration) {
  static const int factors[] = {5, 2, 1};
  const int exponent = (int)floor(log10(limit));
  for (int i = 0; i < HANDY_TRIES; i++) {
    char text[32];
    double handy = 0.0;
    snprintf(text, sizeof text, "%de%d", factors[i % 3], exponent - i / 3);
    if (hk_number_parse(text, (int64_t)strlen(text), &handy) != HOOKE_NUMBER_FINE) continue;
    if (handy > 0.0 && handy <= limit && fits(handy, every) && fits(handy, duration)) return handy;
  }
  const double whole = !isnan(step) ? step : !isnan(every) && fits(every, duration) ? every : duration;
  return whole / ceil(whole / limit);
}

/* ---- candidates ---- */

static const char *method_of(const struct hk_trials *trials) {
  return trials->inquiry->run->method->name;
}

/* The largest step known to be stable by `method`: what is known of the run; of others at the start, and
 * where the step was found too large. */
static int32_t stable_step(struct hk_trials *trials, const char *method, double *limit) {
  struct hk_inquiry *inquiry = trials->inquiry;
  const struct hk_violation *violation = &inquiry->violation;
  double later = INFINITY;
  int32_t known;
  if (strcmp(method, method_of(trials)) == 0 && !isnan(violation->bound) &&
      (violation->found || inquiry->large)) {
    *limit = violation->found && !isnan(violation->limit) ? violation->limit : violation->bound;
    return HOOKE_OK;
  }
  hk_budget_lend(&inquiry->budget, 0.3);
  int32_t status = hk_inquiry_limit(inquiry, trials->first->q, method, ACCURACY, limit, &known);
  if (status == HOOKE_OK && violation->found)
    status = hk_inquiry_limit(inquiry, violation->q, method, ACCURACY, &later, &known);
  hk_inquiry_end_part(inquiry, "what else to do");
  *limit = fmin(*limit, later);
  return status;
}

static int32_t set_step(const struct hk_trials *trials, hooke_options *run, double step, int shorter) {
  int32_t status = step == trials->step ? HOOKE_OK : hooke_options_set_number(run, "step", step);
  if (status == HOOKE_OK && shorter) status = hooke_options_set_number(run, "duration", SHORT_RUN * step);
  if (status == HOOKE_OK && shorter && !isnan(trials->every))
    status = hooke_options_set_number(run, "every", SHORT_FRAME * step);
  return status;
}

/* A run of the same method or another, with steps up to `limit`; a shorter one if the whole would take days.
 * Without a run if no step fits. */
static int32_t change_step(const struct hk_trials *trials, const char *method, double limit,
                           const char *why_so, struct hk_change *change) {
  const int other = strcmp(method, method_of(trials)) != 0;
  change->run = NULL;
  if (!(limit > 0.0)) return HOOKE_OK;
  if (isinf(limit) && isnan(trials->step)) limit = trials->duration / SHORT_RUN;
  const double most = isnan(trials->step) ? limit : fmin(limit, trials->step);
  double step = hk_handy_step(trials->step, most, trials->every, trials->duration);
  if (!(step > 0.0) || (!other && step == trials->step)) return HOOKE_OK;
  int32_t status = hk_change_begin(change, other ? "method" : "step");
  const int too_long = trials->inquiry->squares > 0.0 ||
                       !(trials->duration / step * trials->size <= TOO_LONG * HOOKE_TRIAL_WORK);
  if (too_long) step = hk_handy_step(NAN, most, NAN, NAN);
  if (status == HOOKE_OK && other) status = hooke_options_set_text(change->run, "method", method);
  if (status == HOOKE_OK) status = set_step(trials, change->run, step, too_long);
  if (status != HOOKE_OK) hk_change_drop(change);
  hk_change_say(change, "%s%s%sa step of %.6g s%s%s", other ? "the method " : "", other ? method : "",
                other ? ", with " : "", step, why_so,
                too_long ? ", for a run that is as short as such steps make it" : "");
  return status;
}

static int32_t offer_step(struct hk_trials *trials, const char *method, double limit, const char *why_so,
                          int32_t *taken) {
  struct hk_change change;
  const int32_t status = change_step(trials, method, limit, why_so, &change);
  *taken = 0;
  return status == HOOKE_OK && change.run ? hk_trials_offer(trials, &change, taken) : status;
}

/* The same method at a fraction of its limit, then at smaller and smaller steps. */
static int32_t offer_smaller(struct hk_trials *trials, double limit, const char *why_so) {
  int32_t taken = 0, status = HOOKE_OK;
  for (int k = 0; k < 4 && !taken && status == HOOKE_OK; k++) {
    status = offer_step(trials, method_of(trials), limit, k == 0 ? why_so : "", &taken);
    limit *= k == 0 ? 0.5 : 0.25;
  }
  return status;
}

static int32_t offer_fixed(struct hk_trials *trials, const char *method) {
  double limit = 0.0;
  int32_t taken;
  int32_t status = stable_step(trials, method, &limit);
  if (status != HOOKE_OK) return status;
  trials->backed = trials->inquiry->violation.found;
  status = offer_step(trials, method, hk_soundness_limit_share * limit,
                      isinf(limit) ? ": it is stable at every step" : ", which is stable", &taken);
  trials->backed = 0;
  return status;
}

/* Rounded to two digits, for display. */
static double rounded(double value) {
  char text[32];
  double read = value;
  hk_print(text, sizeof text, "%.1e", value);
  return hk_number_parse(text, (int64_t)strlen(text), &read) == HOOKE_NUMBER_FINE ? read : value;
}

static int32_t offer_adaptive(struct hk_trials *trials, const char *method, double looser) {
  struct hk_change change;
  int32_t taken;
  const hooke_options *run = trials->inquiry->run->options;
  const int other = strcmp(method, method_of(trials)) != 0;
  const double rtol = rounded(looser * hooke_options_number(run, "rtol")),
               atol = rounded(looser * hooke_options_number(run, "atol"));
  if (!hooke_method_is_built(method) || rtol > 0.1) return HOOKE_OK;
  int32_t status = hk_change_begin(&change, other ? "method" : "rtol");
  if (status == HOOKE_OK && other) status = hooke_options_set_text(change.run, "method", method);
  if (status == HOOKE_OK && looser > 1.0) status = hooke_options_set_number(change.run, "rtol", rtol);
  if (status == HOOKE_OK && looser > 1.0) status = hooke_options_set_number(change.run, "atol", atol);
  if (status == HOOKE_OK && looser > 1.0)
    status = hooke_options_set_number(change.run, "atol_velocity", atol);
  if (status != HOOKE_OK) {
    hk_change_drop(&change);
    return status;
  }
  if (other)
    hk_change_say(&change, "the method %s, which chooses its steps itself", method);
  else
    hk_change_say(&change, "looser tolerances, %g times", looser);
  return hk_trials_offer(trials, &change, &taken);
}

/* As many steps as needed. */
static int32_t offer_more_steps(struct hk_trials *trials) {
  struct hk_change change;
  int32_t taken;
  int64_t steps = -1;
  int32_t status = hk_change_begin(&change, "max_steps");
  if (status == HOOKE_OK) status = hooke_options_set_number(change.run, "max_steps", 9e15);
  if (status == HOOKE_OK) status = hk_trials_count_steps(trials, &change, &steps);
  if (status == HOOKE_OK && steps > 0) {
    status = hooke_options_set_number(change.run, "max_steps", ceil(1.25 * (double)steps));
    hk_change_say(&change, "more steps: the whole run takes %lld", (long long)steps);
    if (status == HOOKE_OK) return hk_trials_offer(trials, &change, &taken);
  }
  hk_change_drop(&change);
  return status;
}

/* The run up to its last good time. */
static int32_t offer_shorter(struct hk_trials *trials) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  struct hk_change change;
  int32_t taken;
  const double step = trials->step, begun = inquiry->run->t0;
  double duration = isnan(step) ? *hk_inquiry_last(inquiry)->t - begun : (double)inquiry->last_step * step;
  if (inquiry->bad_value.found && inquiry->bad_value.time - begun < duration) {
    duration = isnan(step) ? inquiry->bad_value.time - begun
                           : floor((inquiry->bad_value.time - begun) / step - 1.0) * step;
  }
  if (isnan(step)) duration *= 0.9;
  if (!(duration > 0.0) || duration >= trials->duration) return HOOKE_OK;
  int32_t status = hk_change_begin(&change, "duration");
  if (status == HOOKE_OK) status = hooke_options_set_number(change.run, "duration", duration);
  if (status == HOOKE_OK && !isnan(trials->every) && trials->every > duration)
    status = hooke_options_set_number(change.run, "every", isnan(step) ? duration : step);
  if (status != HOOKE_OK) {
    hk_change_drop(&change);
    return status;
  }
  hk_change_say(&change, "a run that ends before the trouble, at t = %.6g s, to look at how it gets there",
                begun + duration);
  return hk_trials_offer(trials, &change, &taken);
}

/* ---- suggestions by cause ---- */

static int32_t offer_others(struct hk_trials *trials) {
  const hooke_system *system = trials->inquiry->system;
  const char *const fixed[] = {hk_method_of_euler(system), "verlet", "tr-bdf2", "backward-euler"};
  const char *const adaptive[] = {"cvode-adams", "cvode-bdf"};
  const char *mine = method_of(trials);
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 4 && status == HOOKE_OK; k++) {
    if (strcmp(mine, fixed[k]) != 0 && hk_method_suits(fixed[k], system))
      status = offer_fixed(trials, fixed[k]);
  }
  for (int k = 0; k < 2 && status == HOOKE_OK; k++) {
    if (strcmp(mine, adaptive[k]) != 0 && hk_method_suits(adaptive[k], system))
      status = offer_adaptive(trials, adaptive[k], 1.0);
  }
  return status;
}

static int32_t offer_for_step(struct hk_trials *trials) {
  const struct hk_violation *violation = &trials->inquiry->violation;
  const char *mine = method_of(trials);
  double limit = 0.5 * trials->step;
  int32_t status = HOOKE_OK;
  const int above = violation->found || !isnan(violation->bound);
  if (above) status = stable_step(trials, mine, &limit);
  trials->backed = above;
  if (status == HOOKE_OK && limit > 0.0)
    status = offer_smaller(trials, (above ? hk_soundness_limit_share : 1.0) * limit,
                           above ? ", below the limit" : "");
  trials->backed = 0;
  const int implicit = hk_participation_is_drag(trials->inquiry->force) ||
                       trials->inquiry->force == HOOKE_PARTICIPATION_DAMPING;
  if (status == HOOKE_OK && implicit && strcmp(mine, "verlet") != 0) status = offer_fixed(trials, "verlet");
  return status == HOOKE_OK ? offer_others(trials) : status;
}

static int32_t offer_for_collapse(struct hk_trials *trials) {
  int32_t status = HOOKE_OK;
  if (!isnan(trials->step))
    status = offer_smaller(trials, 0.25 * trials->step, ", with which it jumps less far");
  return status == HOOKE_OK ? offer_others(trials) : status;
}

static int32_t offer_for_solver(struct hk_trials *trials) {
  int32_t status = HOOKE_OK;
  if (trials->inquiry->run->outcome == HOOKE_STEP_LIMIT) status = offer_more_steps(trials);
  if (status == HOOKE_OK && !isnan(trials->step)) {
    status = offer_smaller(trials, 0.5 * trials->step, ", which is easier to solve");
  } else {
    static const double looser[] = {10.0, 100.0, 1e3, 1e4};
    for (int k = 0; k < 4 && status == HOOKE_OK; k++)
      status = offer_adaptive(trials, method_of(trials), looser[k]);
  }
  return status == HOOKE_OK ? offer_others(trials) : status;
}

/* No step cures it; damping does, and perhaps the damping of a method. */
static int32_t offer_for_gain(struct hk_trials *trials) {
  int32_t status = offer_shorter(trials);
  if (status == HOOKE_OK) status = hk_trials_try_damping(trials);
  if (status == HOOKE_OK) status = offer_fixed(trials, "backward-euler");
  return status == HOOKE_OK ? offer_adaptive(trials, "cvode-bdf", 1.0) : status;
}

/* While the squares of moving particles are finite. */
static int32_t offer_for_squares(struct hk_trials *trials) {
  int32_t taken;
  if (isnan(trials->step)) return HOOKE_OK;
  return offer_step(trials, method_of(trials), trials->inquiry->squares,
                    ", by which nothing moves beyond numbers that have squares", &taken);
}

/* A known limit gives a step even where no trial of one below it ran on: something else goes wrong as well.
 */
static int32_t give_step(struct hk_trials *trials) {
  const struct hk_why *why = trials->inquiry->why;
  struct hk_change change;
  if (!(why->limit > 0.0) || isinf(why->limit)) return HOOKE_OK;
  for (int64_t k = 0; k < why->advice_count; k++) {
    if (strcmp(why->advice[k].option, "step") == 0) return HOOKE_OK;
  }
  const int32_t status = change_step(trials, method_of(trials), hk_soundness_limit_share * why->limit,
                                     ", below the limit", &change);
  if (status == HOOKE_OK && change.run)
    hk_trials_take(trials, &change, ", which is not enough (tried: the run ends early with it, too)");
  return status;
}

static int32_t offer_all(struct hk_trials *trials) {
  const struct hk_why *why = trials->inquiry->why;
  int32_t status;
  if (strcmp(why->cause, "force-not-finite") == 0)
    status = HOOKE_OK; /* no other step or method makes it finite */
  else if (strcmp(why->cause, "collapsed-spring") == 0)
    status = offer_for_collapse(trials);
  else if (strcmp(why->cause, "solver-failed") == 0)
    status = offer_for_solver(trials);
  else if (strcmp(why->cause, "never-stable") == 0)
    status = offer_others(trials);
  else if (strcmp(why->cause, "model-gains-energy") == 0)
    status = offer_for_gain(trials);
  else if (strcmp(why->cause, "overflow") == 0 && trials->inquiry->squares > 0.0)
    status = offer_for_squares(trials);
  else
    status = offer_for_step(trials);
  if (status == HOOKE_OK && why->advice_count == 0) status = offer_shorter(trials);
  return status == HOOKE_OK ? give_step(trials) : status;
}

/* ---- the scene ---- */

static void advise_scene(struct hk_inquiry *inquiry) {
  struct hk_why *why = inquiry->why;
  struct hk_why_advice *advice = &why->advice[why->advice_count];
  if (inquiry->bad_value.found) {
    hk_print(advice->change, sizeof advice->change,
             "correct the %s callback: what it gives for particle %lld at t = %.6g s is not finite",
             inquiry->bad_value.of_drive ? "drive" : "force", (long long)inquiry->bad_value.particle,
             inquiry->bad_value.time);
  } else if (inquiry->suggestion[0]) {
    snprintf(advice->change, sizeof advice->change, "change the scene: %s", inquiry->suggestion);
  } else if (strcmp(why->cause, "overflow") == 0 && inquiry->run->outcome == HOOKE_DIVERGED &&
             !isnan(why->particle) && why->limiting.count == 0) {
    snprintf(advice->change, sizeof advice->change,
             "look at the units of the scene: positions in m, "
             "velocities in m/s; no square of them may be beyond 1.8e308");
  } else if (strcmp(why->cause, "overflow") == 0) {
    snprintf(
        advice->change, sizeof advice->change,
        "look at the units of the scene: stiffness in N (or N/m by the length law), mass in kg, time in s");
  } else if (strcmp(why->cause, "collapsed-spring") == 0) {
    snprintf(advice->change, sizeof advice->change,
             "keep the ends of that spring apart: a shorter rest length, or one more spring that holds them");
  } else {
    return;
  }
  why->advice_count++;
}

int32_t hk_inquiry_advise(struct hk_inquiry *inquiry) {
  struct hk_trials trials;
  int32_t status = hk_trials_begin(inquiry, &trials);
  if (status == HOOKE_OK && trials.duration > 0.0) status = offer_all(&trials);
  hk_trials_release(&trials);
  hk_inquiry_end_part(inquiry, "what else to do");
  if (status == HOOKE_OK) advise_scene(inquiry);
  return status;
}
