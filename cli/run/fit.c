#include "fit.h"

#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PARTS = 10000 };
static const double SHARE_OF_SAFE = 0.5, SHARE_OF_DURATION = 1e-3; /* of the safe step, of the duration */
static const double SHRINK = 0.9;                                  /* smallest fraction of a given step */
static const double MOST_COUNTED = 9e15;
static const double MOST_STEPS = 1e8; /* maximum number of steps that is chosen by default */

struct fit {
  const struct cli_arguments *arguments;
  hooke_options *options;
  double step, every, duration; /* NaN: not given */
  int32_t may_lack;             /* 1: no step is no failure */
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

static int set(struct fit *fit, const char *name, double *number, double value, const char *why) {
  const int32_t status = hooke_options_set_number(fit->options, name, value);
  *number = value;
  if (status != HOOKE_OK) return cli_report_status(fit->arguments, status);
  if (!fit->arguments->quiet) cli_report_words(fit->arguments, "%s is %.6g s: %s", name, value, why);
  return HOOKE_EXIT_DONE;
}

/* ---- without a given step ---- */

static int refuse(const struct fit *fit, const char *method, double safe) {
  char where[80] = "here at no step";
  if (fit->may_lack) return HOOKE_EXIT_DONE;
  if (safe > 0.0) snprintf(where, sizeof where, "up to %.6g s alone, which would mean over 1e8 steps", safe);
  return cli_report(fit->arguments, HOOKE_EXIT_USAGE,
                    "no step: %s is certain to be stable %s; give one with --step, or take another method",
                    method, where);
}

static int choose_step(struct fit *fit, const hooke_system *system, const double *q, const char *method) {
  double safe = NAN;
  const int32_t status = hooke_step_bound(system, method, q, &safe);
  if (status != HOOKE_OK) return cli_report_status(fit->arguments, status);
  const int limited = !isnan(safe) && !isinf(safe);
  double most = limited ? SHARE_OF_SAFE * safe : SHARE_OF_DURATION * fit->duration;
  if (!(most > 0.0) || fit->duration / most > MOST_STEPS) return refuse(fit, method, safe);
  if (fit->every < most) most = fit->every;
  if (fit->duration < most) most = fit->duration;
  double step = largest_that_fits(fit, most, 0.5 * most);
  if (isnan(step)) step = fit->every / ceil(fit->every / most * (1.0 - 1e-12));
  return set(fit, "step", &fit->step, step,
             limited ? "the largest that fits, up to half of the safe one" : "a thousandth of the duration");
}

/* ---- with a given step that does not fit ---- */

static int move_times(struct fit *fit) {
  int code = HOOKE_EXIT_DONE;
  const double every = fit->step * fmax(1.0, round(fit->every / fit->step));
  const double duration = fit->step * fmax(1.0, round(fit->duration / fit->step));
  if (!isnan(fit->every) && !is_whole(fit->every / fit->step))
    code = set(fit, "every", &fit->every, every, "the nearest whole multiple of the step");
  if (code == HOOKE_EXIT_DONE && !is_whole(fit->duration / fit->step))
    code = set(fit, "duration", &fit->duration, duration, "the nearest whole multiple of the step");
  return code;
}

int cli_fit_run(const struct cli_arguments *arguments, struct cli_setup *setup, int32_t may_lack) {
  const char *method = hooke_options_text(setup->options, "method");
  struct fit fit = {.arguments = arguments,
                    .options = setup->options,
                    .step = hooke_options_number(setup->options, "step"),
                    .every = hooke_options_number(setup->options, "every"),
                    .duration = hooke_options_number(setup->options, "duration"),
                    .may_lack = may_lack};
  if (cli_arguments_text(arguments, "strict") || isnan(fit.duration)) return HOOKE_EXIT_DONE;
  if (hooke_method_is_adaptive(method) != 0) return HOOKE_EXIT_DONE;
  if (isnan(fit.step)) {
    const int code = choose_step(&fit, setup->system, hooke_state_position(setup->state), method);
    return code == HOOKE_EXIT_DONE && !isnan(fit.step) ? move_times(&fit) : code;
  }
  /* times that no whole number of steps can make up are refused */
  const int countable = fit.duration / fit.step < MOST_COUNTED;
  if (!countable || fits(&fit, fit.step)) return HOOKE_EXIT_DONE;
  const double smaller = largest_that_fits(&fit, fit.step, SHRINK * fit.step);
  return isnan(smaller) ? move_times(&fit)
                        : set(&fit, "step", &fit.step, smaller,
                              "a little less, so that every and duration are whole multiples of it");
}
