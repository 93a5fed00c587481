/* A step that fits: for a fixed-step method, `every` and `duration` have to be whole multiples of it. */
#include "core/print.h"
#include "core/status.h"
#include "hooke/measurement.h"

#include <math.h>

enum { MOST_PARTS = 10000 };
static const double SHARE_OF_SAFE = 0.5, SHARE_OF_DURATION = 1e-3; /* of the safe step, of the duration */
static const double SHRINK = 0.9;                                  /* smallest fraction of a given step */
static const double MOST_COUNTED = 9e15;
static const double MOST_STEPS = 1e8; /* maximum number of steps that is chosen by default */

struct fit {
  hooke_options *options;
  hooke_warning *told; /* NULL: nobody */
  void *ctx;
  double step, every, duration; /* NaN: not given */
};

static int is_whole(double quotient) {
  return round(quotient) >= 1.0 && fabs(quotient - round(quotient)) <= 1e-9 * quotient;
}

static int fits(const struct fit *fit, double step) {
  return is_whole(fit->duration / step) && (isnan(fit->every) || is_whole(fit->every / step));
}

/* The largest step that fits, between `least` and `most`; NaN if there is none. */
static double largest_that_fits(const struct fit *fit, double most, double least) {
  const double shorter = isnan(fit->every) ? fit->duration : fmin(fit->every, fit->duration);
  double parts = ceil(shorter / most * (1.0 - 1e-12));
  for (int k = 0; k < MOST_PARTS; k++, parts++) {
    const double step = shorter / fmax(1.0, parts);
    if (step < least) break;
    if (fits(fit, step)) return step;
  }
  return NAN;
}

static int32_t set(struct fit *fit, const char *name, double *number, double value, const char *why) {
  char sentence[256];
  const int32_t status = hooke_options_set_number(fit->options, name, value);
  *number = value;
  if (status != HOOKE_OK || fit->told == NULL) return status;
  hk_print(sentence, sizeof sentence, "%s is %.6g s: %s", name, value, why);
  if (fit->told(name, sentence, 0.0, NAN, -1, -1, fit->ctx) == 0) return HOOKE_OK;
  return hk_fail(HOOKE_STOPPED, NULL, "stopped where it was told of a step");
}

/* ---- without a given step ---- */

static int32_t refuse(const char *method, double safe) {
  char where[80] = "here at no step";
  if (safe > 0.0) hk_print(where, sizeof where, "up to %.6g s alone, which would mean over 1e8 steps", safe);
  return hk_fail(HOOKE_UNSUITED, NULL,
                 "no step: %s is certain to be stable %s; give one, or take another method", method, where);
}

static int32_t choose_step(struct fit *fit, const hooke_system *system, const double *q, const char *method) {
  double safe = NAN;
  const int32_t status = hooke_step_bound(system, method, q, &safe);
  if (status != HOOKE_OK) return status;
  const int limited = !isnan(safe) && !isinf(safe);
  double most = limited ? SHARE_OF_SAFE * safe : SHARE_OF_DURATION * fit->duration;
  if (!(most > 0.0) || fit->duration / most > MOST_STEPS) return refuse(method, safe);
  if (fit->every < most) most = fit->every;
  if (fit->duration < most) most = fit->duration;
  double step = largest_that_fits(fit, most, 0.5 * most);
  if (isnan(step)) step = fit->every / ceil(fit->every / most * (1.0 - 1e-12));
  return set(fit, "step", &fit->step, step,
             limited ? "the largest that fits, up to half of the safe one" : "a thousandth of the duration");
}

/* ---- with a given step that does not fit ---- */

static int32_t move_times(struct fit *fit) {
  int32_t status = HOOKE_OK;
  const double every = fit->step * fmax(1.0, round(fit->every / fit->step));
  const double duration = fit->step * fmax(1.0, round(fit->duration / fit->step));
  if (!isnan(fit->every) && !is_whole(fit->every / fit->step))
    status = set(fit, "every", &fit->every, every, "the nearest whole multiple of the step");
  if (status == HOOKE_OK && !is_whole(fit->duration / fit->step))
    status = set(fit, "duration", &fit->duration, duration, "the nearest whole multiple of the step");
  return status;
}

int32_t hooke_step_fit(const hooke_system *system, const double *q, hooke_options *run, hooke_warning *told,
                       void *ctx) {
  const char *method = hooke_options_text(run, "method");
  struct fit fit = {.options = run,
                    .told = told,
                    .ctx = ctx,
                    .step = hooke_options_number(run, "step"),
                    .every = hooke_options_number(run, "every"),
                    .duration = hooke_options_number(run, "duration")};
  if (isnan(fit.duration) || hooke_method_is_adaptive(method) != 0) return HOOKE_OK;
  if (isnan(fit.step)) {
    const int32_t status = choose_step(&fit, system, q, method);
    return status == HOOKE_OK ? move_times(&fit) : status;
  }
  /* times that no whole number of steps can make up are refused */
  const int countable = fit.duration / fit.step < MOST_COUNTED;
  if (!countable || fits(&fit, fit.step)) return HOOKE_OK;
  const double smaller = largest_that_fits(&fit, fit.step, SHRINK * fit.step);
  return isnan(smaller) ? move_times(&fit)
                        : set(&fit, "step", &fit.step, smaller,
                              "a little less, so that every and duration are whole multiples of it");
}
