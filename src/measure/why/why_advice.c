/* Suggestions: changes of the run, the likeliest first, each tried on a run of its own before it is given. */
#include "integrate/method.h"
#include "measure/counted_work/work.h"
#include "measure/limit/limit.h"
#include "measure/limit/limit_predict.h"
#include "measure/recommend/soundness.h"
#include "measure/why/why_trial.h"

#include "core/number.h"
#include "core/print.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double TOO_LONG = 1e5; /* times the work of a trial: a run of impractical length */
static const double ACCURACY = 1e-3;
static const double PASSES = 2.0; /* of a bound */
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

/* The limit of `method` at q, if there is memory and time for it; otherwise the bound. */
static int32_t find_limit(struct hk_inquiry *inquiry, const double *q, const char *method, double *limit) {
  int32_t status = HOOKE_STOPPED;
  if (!inquiry->large)
    status = hk_limit_predict_within(inquiry->system, q, NULL, method, NULL, NULL, ACCURACY,
                                     inquiry->memory_limit - inquiry->memory_used, &inquiry->budget, limit);
  if (status == HOOKE_OK || status == HOOKE_NO_MEMORY) return status;
  *limit = 0.0;
  const double work = PASSES * hk_work_of_pass(inquiry->system);
  if (!hk_budget_has(&inquiry->budget, work)) return HOOKE_OK;
  hk_budget_spend(&inquiry->budget, work);
  return hooke_step_bound(inquiry->system, method, q, limit);
}

/* The largest step known to be stable by `method`: what is known of the run; of others at the start, and
 * where the step was found too large. */
static double stable_step(struct hk_trials *trials, const char *method) {
  struct hk_inquiry *inquiry = trials->inquiry;
  const struct hk_violation *violation = &inquiry->violation;
  double limit = 0.0, later = INFINITY;
  if (strcmp(method, method_of(trials)) == 0 && !isnan(violation->bound) &&
      (violation->found || inquiry->large))
    return violation->found && !isnan(violation->limit) ? violation->limit : violation->bound;
  hk_budget_lend(&inquiry->budget, 0.3);
  trials->status = find_limit(inquiry, trials->first->q, method, &limit);
  if (trials->status == HOOKE_OK && violation->found)
    trials->status = find_limit(inquiry, violation->q, method, &later);
  hk_inquiry_end_part(inquiry, "what else to do");
  return fmin(limit, later);
}

/* A run of the same method or another, with steps up to `limit`; a shorter one if the whole would take days.
 * Without a run if no step fits. */
static void change_step(struct hk_trials *trials, const char *method, double limit, const char *why_so,
                        struct hk_change *change) {
  const int other = strcmp(method, method_of(trials)) != 0;
  change->run = NULL;
  if (!(limit > 0.0)) return;
  if (isinf(limit) && isnan(trials->step)) limit = trials->duration / SHORT_RUN;
  const double most = isnan(trials->step) ? limit : fmin(limit, trials->step);
  double step = hk_handy_step(trials->step, most, trials->every, trials->duration);
  if (!(step > 0.0) || (!other && step == trials->step)) return;
  hk_change_begin(trials, change, other ? "method" : "step");
  const int too_long = trials->inquiry->squares > 0.0 ||
                       !(trials->duration / step * trials->size <= TOO_LONG * HOOKE_TRIAL_WORK);
  if (too_long) step = hk_handy_step(NAN, most, NAN, NAN);
  if (other) hk_change_method(change, method);
  if (step != trials->step) hk_change_number(change, "step", step);
  if (too_long) hk_change_number(change, "duration", SHORT_RUN * step);
  if (too_long && !isnan(trials->every)) hk_change_number(change, "every", SHORT_FRAME * step);
  hk_change_say(change, "%s%s%sa step of %.6g s%s%s", other ? "the method " : "", other ? method : "",
                other ? ", with " : "", step, why_so,
                too_long ? ", for a run that is as short as such steps make it" : "");
}

static int32_t offer_step(struct hk_trials *trials, const char *method, double limit, const char *why_so) {
  struct hk_change change;
  change_step(trials, method, limit, why_so, &change);
  return hk_trials_offer(trials, &change);
}

/* The same method at a fraction of its limit, then at smaller and smaller steps. */
static void offer_smaller(struct hk_trials *trials, double limit, const char *why_so) {
  for (int k = 0; k < 4 && !offer_step(trials, method_of(trials), limit, k == 0 ? why_so : ""); k++)
    limit *= k == 0 ? 0.5 : 0.25;
}

static void offer_fixed(struct hk_trials *trials, const char *method) {
  if (trials->status != HOOKE_OK) return;
  const double limit = stable_step(trials, method);
  trials->backed = trials->inquiry->violation.found;
  offer_step(trials, method, hk_soundness_limit_share * limit,
             isinf(limit) ? ": it is stable at every step" : ", which is stable");
  trials->backed = 0;
}

/* Rounded to two digits, for display. */
static double rounded(double value) {
  char text[32];
  double read = value;
  hk_print(text, sizeof text, "%.1e", value);
  return hk_number_parse(text, (int64_t)strlen(text), &read) == HOOKE_NUMBER_FINE ? read : value;
}

static void offer_adaptive(struct hk_trials *trials, const char *method, double looser) {
  struct hk_change change;
  const hooke_options *run = trials->inquiry->run->options;
  const int other = strcmp(method, method_of(trials)) != 0;
  const double rtol = rounded(looser * hooke_options_number(run, "rtol")),
               atol = rounded(looser * hooke_options_number(run, "atol"));
  if (!hooke_method_is_built(method) || rtol > 0.1) return;
  hk_change_begin(trials, &change, other ? "method" : "rtol");
  if (other) hk_change_method(&change, method);
  if (looser > 1.0) {
    hk_change_number(&change, "rtol", rtol);
    hk_change_number(&change, "atol", atol);
    hk_change_number(&change, "atol_velocity", rounded(looser * hooke_options_number(run, "atol_velocity")));
  }
  if (other)
    hk_change_say(&change, "the method %s, which chooses its steps itself", method);
  else
    hk_change_say(&change, "looser tolerances, %g times", looser);
  hk_trials_offer(trials, &change);
}

/* As many steps as needed. */
static void offer_more_steps(struct hk_trials *trials) {
  struct hk_change change;
  struct hk_trial trial;
  hk_change_begin(trials, &change, "max_steps");
  hk_change_number(&change, "max_steps", 9e15);
  hk_trials_try(trials, trials->inquiry->system, &change, &trial);
  const int64_t steps = trial.finished && !trials->late ? trial.steps : 0;
  if (steps > 0) {
    hk_change_number(&change, "max_steps", ceil(1.25 * (double)steps));
    hk_change_say(&change, "more steps: the whole run takes %lld", (long long)steps);
    hk_trials_offer(trials, &change);
  }
  hk_change_drop(&change);
}

/* The run up to its last good time. */
static void offer_shorter(struct hk_trials *trials) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  struct hk_change change;
  const double step = trials->step, begun = inquiry->run->t0;
  double duration = isnan(step) ? *hk_inquiry_last(inquiry)->t - begun : (double)inquiry->last_step * step;
  if (inquiry->bad_value.found && inquiry->bad_value.time - begun < duration) {
    duration = isnan(step) ? inquiry->bad_value.time - begun
                           : floor((inquiry->bad_value.time - begun) / step - 1.0) * step;
  }
  if (isnan(step)) duration *= 0.9;
  if (!(duration > 0.0) || duration >= trials->duration) return;
  hk_change_begin(trials, &change, "duration");
  hk_change_number(&change, "duration", duration);
  if (!isnan(trials->every) && trials->every > duration)
    hk_change_number(&change, "every", isnan(step) ? duration : step);
  hk_change_say(&change, "a run that ends before the trouble, at t = %.6g s, to look at how it gets there",
                begun + duration);
  hk_trials_offer(trials, &change);
}

/* ---- suggestions by cause ---- */

static void offer_others(struct hk_trials *trials) {
  const hooke_system *system = trials->inquiry->system;
  const char *const fixed[] = {hk_method_of_euler(system), "verlet", "tr-bdf2", "backward-euler"};
  const char *const adaptive[] = {"cvode-adams", "cvode-bdf"};
  const char *mine = method_of(trials);
  for (int k = 0; k < 4; k++)
    if (strcmp(mine, fixed[k]) != 0 && hk_method_suits(fixed[k], system)) offer_fixed(trials, fixed[k]);
  for (int k = 0; k < 2; k++)
    if (strcmp(mine, adaptive[k]) != 0 && hk_method_suits(adaptive[k], system))
      offer_adaptive(trials, adaptive[k], 1.0);
}

static void offer_for_step(struct hk_trials *trials) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  const char *mine = method_of(trials);
  const int above = inquiry->violation.found || !isnan(inquiry->violation.bound);
  const double limit = above ? hk_soundness_limit_share * stable_step(trials, mine) : 0.5 * trials->step;
  trials->backed = above;
  if (limit > 0.0) offer_smaller(trials, limit, above ? ", below the limit" : "");
  trials->backed = 0;
  const int implicit =
      hk_participation_is_drag(inquiry->force) || inquiry->force == HOOKE_PARTICIPATION_DAMPING;
  if (implicit && strcmp(mine, "verlet") != 0) offer_fixed(trials, "verlet");
  offer_others(trials);
}

static void offer_for_collapse(struct hk_trials *trials) {
  if (!isnan(trials->step)) offer_smaller(trials, 0.25 * trials->step, ", with which it jumps less far");
  offer_others(trials);
}

static void offer_for_solver(struct hk_trials *trials) {
  static const double looser[] = {10.0, 100.0, 1e3, 1e4};
  if (trials->inquiry->run->outcome == HOOKE_STEP_LIMIT) offer_more_steps(trials);
  if (!isnan(trials->step)) offer_smaller(trials, 0.5 * trials->step, ", which is easier to solve");
  for (int k = 0; k < 4 && isnan(trials->step); k++)
    offer_adaptive(trials, method_of(trials), looser[k]);
  offer_others(trials);
}

/* No step cures it; damping does, and perhaps the damping of a method. */
static void offer_for_gain(struct hk_trials *trials) {
  offer_shorter(trials);
  hk_trials_try_damping(trials);
  offer_fixed(trials, "backward-euler");
  offer_adaptive(trials, "cvode-bdf", 1.0);
}

/* A step while the squares of moving particles are finite, where these overflow. */
static void offer_for_overflow(struct hk_trials *trials) {
  const double squares = trials->inquiry->squares;
  if (!(squares > 0.0))
    offer_for_step(trials);
  else if (!isnan(trials->step))
    offer_step(trials, method_of(trials), squares,
               ", by which nothing moves beyond numbers that have squares");
}

/* A known limit gives a step even where no trial of one below it ran on: something else goes wrong as well.
 */
static void give_step(struct hk_trials *trials) {
  const struct hk_why *why = trials->inquiry->why;
  struct hk_change change;
  if (!(why->limit > 0.0) || isinf(why->limit)) return;
  for (int64_t k = 0; k < why->advice_count; k++)
    if (strcmp(why->advice[k].option, "step") == 0) return;
  change_step(trials, method_of(trials), hk_soundness_limit_share * why->limit, ", below the limit", &change);
  hk_trials_take(trials, &change, ", which is not enough (tried: the run ends early with it, too)");
}

static void offer_all(struct hk_trials *trials) {
  static const struct {
    const char *cause;
    void (*offer)(struct hk_trials *trials);
  } rows[] = {{"force-not-finite", NULL}, /* no other step or method makes it finite */
              {"collapsed-spring", offer_for_collapse},
              {"solver-failed", offer_for_solver},
              {"never-stable", offer_others},
              {"model-gains-energy", offer_for_gain},
              {"overflow", offer_for_overflow}};
  const struct hk_why *why = trials->inquiry->why;
  void (*offer)(struct hk_trials *) = offer_for_step;
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
    if (strcmp(why->cause, rows[k].cause) == 0) offer = rows[k].offer;
  if (offer) offer(trials);
  if (why->advice_count == 0) offer_shorter(trials);
  give_step(trials);
}

/* ---- the scene ---- */

/* "change the scene: ...", with its price. */
static int32_t advise_change(struct hk_inquiry *inquiry, struct hk_why_advice *advice) {
  struct hk_limit *limit = inquiry->limit ? inquiry->limit->object : NULL;
  const int32_t own = limit && strcmp(inquiry->suggestion, limit->suggestion.sentence) == 0,
                status = own ? hk_limit_price(limit) : HOOKE_OK;
  if (own) advice->want = limit->suggestion.price.want;
  snprintf(advice->change, sizeof advice->change, "change the scene: %s%s",
           own ? limit->suggestion.sentence : inquiry->suggestion, own ? "" : "; its error is not known");
  return status;
}

static int32_t advise_scene(struct hk_inquiry *inquiry) {
  struct hk_why *why = inquiry->why;
  struct hk_why_advice *advice = &why->advice[why->advice_count];
  int32_t status = HOOKE_OK;
  advice->want = NAN;
  if (inquiry->bad_value.found) {
    hk_print(advice->change, sizeof advice->change,
             "correct the %s callback: what it gives for particle %lld at t = %.6g s is not finite",
             inquiry->bad_value.of_drive ? "drive" : "force", (long long)inquiry->bad_value.particle,
             inquiry->bad_value.time);
  } else if (inquiry->suggestion[0]) {
    status = advise_change(inquiry, advice);
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
    return HOOKE_OK;
  }
  why->advice_count++;
  return status;
}

int32_t hk_inquiry_advise(struct hk_inquiry *inquiry) {
  struct hk_trials trials;
  hk_trials_begin(inquiry, &trials);
  if (trials.status == HOOKE_OK && trials.duration > 0.0) offer_all(&trials);
  hk_trials_release(&trials);
  hk_inquiry_end_part(inquiry, "what else to do");
  return trials.status == HOOKE_OK ? advise_scene(inquiry) : trials.status;
}
