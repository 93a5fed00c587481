#include "want.h"

#include "claims.h"
#include "print.h"
#include "report.h"
#include "setup.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 22 };

/* ---- picking ---- */

static int refuse_typed(const struct cli_arguments *arguments) {
  static const char *const chosen[] = {"step", "rtol", "atol", "atol_velocity"};
  char flag[HOOKE_FLAG_SIZE];
  for (size_t k = 0; k < sizeof chosen / sizeof chosen[0]; k++) {
    if (!cli_arguments_text(arguments, chosen[k])) continue;
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--want picks the step or the tolerance; leave out --%s, or --want",
                      cli_arguments_flag(chosen[k], flag));
  }
  return HOOKE_EXIT_DONE;
}

static void tell_choice(const struct cli_run *run, const char *done, const char *want) {
  const hooke_options *options = run->setup.options;
  const char *method = hooke_options_text(options, "method");
  const int adaptive = hooke_method_is_adaptive(method);
  char number[HOOKE_NUMBER_SIZE];
  if (run->arguments->quiet) return;
  cli_report_words(run->arguments, "%s %s%s: %s, %s %s%s", done, want,
                   want[strspn(want, "+-.0123456789eE")] ? "" : " m", method, adaptive ? "rtol" : "step",
                   cli_format_rounded(hooke_options_number(options, adaptive ? "rtol" : "step"), number),
                   adaptive ? "" : " s");
}

/* `want`: NULL without one. */
static int create(struct cli_run *run, const char *want) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("estimate", &options);
  if (status == HOOKE_OK && want) status = hooke_options_set_text(options, "want", want);
  const int32_t refused = status == HOOKE_BAD_VALUE;
  if (status == HOOKE_OK)
    status = hooke_measurement_create("estimate", run->setup.system, NULL, options, &run->estimate);
  hooke_options_destroy(options);
  if (refused) return cli_report(run->arguments, HOOKE_EXIT_USAGE, "--want: %s", hooke_last_error());
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

int cli_want_pick(struct cli_run *run) {
  const struct cli_arguments *arguments = run->arguments;
  const char *text = cli_arguments_text(arguments, "want");
  int code = text ? cli_setup_require(arguments, &run->setup, NULL) : HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE && text) code = refuse_typed(arguments);
  if (!text && cli_arguments_text(arguments, "no-estimate")) return HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE) code = create(run, text);
  if (code != HOOKE_EXIT_DONE) return code;
  hooke_measurement_on_progress(run->estimate, cli_watch_progress, &run->watch);
  if (!text) return HOOKE_EXIT_DONE;
  cli_watch_start(&run->watch, arguments);
  const int32_t status =
      hooke_estimate_pick(run->estimate, cli_arguments_text(arguments, "method"), run->setup.options);
  cli_watch_end(&run->watch);
  if (status == HOOKE_STOPPED)
    return cli_report(arguments, HOOKE_EXIT_INTERRUPTED,
                      "interrupted while a method was picked; nothing was run");
  if (status == HOOKE_UNSUITED) return cli_report(arguments, HOOKE_EXIT_NOT_MET, "%s", hooke_last_error());
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  tell_choice(run, "picked for an error of", text);
  return HOOKE_EXIT_DONE;
}

/* ---- after the run ---- */

int32_t cli_want_measure(struct cli_run *run) {
  if (!run->estimate || run->outcome != HOOKE_OK || run->was_finished) return HOOKE_OK;
  cli_watch_start(&run->watch, run->arguments);
  hooke_integrator_destroy(run->integrator); /* the following runs need as much memory */
  run->integrator = NULL;
  const int32_t status = hooke_measurement_run(run->estimate, run->setup.state);
  cli_watch_end(&run->watch);
  return status;
}

static const char *text_of(const struct cli_run *run, const char *what) {
  return hooke_measurement_text(run->estimate, "estimate", 0, what);
}

static double number_of(const struct cli_run *run, const char *what) {
  return hooke_measurement_number(run->estimate, "estimate", 0, what);
}

static int is_wanted(const struct cli_run *run) {
  return run->estimate && !isnan(number_of(run, "wanted"));
}

int32_t cli_want_goes_on(struct cli_run *run) {
  if (!is_wanted(run) || run->outcome != HOOKE_OK || number_of(run, "met") == 1.0) return 0;
  if (cli_watch_interrupted() || hooke_estimate_refine(run->estimate, run->setup.options) != HOOKE_OK)
    return 0;
  if (!run->arguments->quiet) cli_report_words(run->arguments, "%s", cli_claim(run->estimate, "want"));
  tell_choice(run, "once more for", cli_arguments_text(run->arguments, "want"));
  return 1;
}

void cli_want_print(const struct cli_run *run) {
  if (!run->estimate || run->outcome != HOOKE_OK || run->was_finished) return;
  cli_claims_print(run->arguments, run->estimate, INDENT, NULL);
  if (!text_of(run, "by") && !run->arguments->quiet)
    cli_report_words(run->arguments, "'hooke study' on the same may tell how wrong it is");
  cli_print_flush();
}

static void print_json_error(const struct cli_run *run) {
  const char *by = text_of(run, "by"), *reason = text_of(run, "reason");
  const double piece = number_of(run, "last_piece");
  cli_print_json("'error': {'estimate': %g, 'rms': %g, 'known_until': %g, 'by': %s, 'energy_rise': %g, "
                 "'heat_excess': %g, 'reason': %s}, ",
                 number_of(run, "estimate"), number_of(run, "rms"), number_of(run, "known_until"), by,
                 number_of(run, "energy_rise"), number_of(run, "heat_excess"), reason[0] ? reason : NULL);
  if (!isnan(piece))
    cli_print_json("'last_piece': {'error': %g, 'from': %g, 'until': %g}, ", piece,
                   number_of(run, "last_from"), hooke_state_time(run->setup.state));
}

void cli_want_print_json(const struct cli_run *run) {
  if (!run->estimate || run->was_finished) return;
  const double met = number_of(run, "met");
  if (run->outcome == HOOKE_OK) print_json_error(run);
  if (!is_wanted(run)) return;
  cli_print_json("'want': {'wanted': %g, 'met': ", number_of(run, "wanted"));
  cli_print_json(isnan(met) ? "null" : met == 1.0 ? "true" : "false");
  cli_print_json(", 'seconds': %g}, ", number_of(run, "seconds"));
}

int cli_want_exit_code(const struct cli_run *run) {
  if (!is_wanted(run) || run->outcome != HOOKE_OK || number_of(run, "met") == 1.0) return HOOKE_EXIT_DONE;
  return cli_watch_interrupted() ? HOOKE_EXIT_INTERRUPTED : HOOKE_EXIT_NOT_MET;
}
