/* hooke study: accuracy and cost of each method on a scene, and a recommendation. */
#include "claims.h"
#include "command.h"
#include "methods.h"
#include "output_file.h"
#include "print.h"
#include "report.h"
#include "rows.h"
#include "study_results.h"
#include "watch.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the file of -o ---- */

static int ends_in(const char *name, const char *ending) {
  const size_t length = strlen(name), end = strlen(ending);
  return length > end && strcmp(name + length - end, ending) == 0;
}

static int check_output(const struct cli_arguments *arguments, const char *output) {
  if (!output) return HOOKE_EXIT_DONE;
  if (!ends_in(output, ".csv") && !ends_in(output, ".h5")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "-o %s: allowed: a name that ends in .csv, for the "
                      "rows as a table, or in .h5, for the whole study",
                      output);
  }
  const int code = ends_in(output, ".h5") ? cli_setup_check_output(arguments, output) : HOOKE_EXIT_DONE;
  return code == HOOKE_EXIT_DONE ? cli_output_file_check(arguments, "-o", output) : code;
}

/* ---- the recommended command ---- */

static double recommended(const struct cli_study_results *results, const char *what) {
  return hooke_measurement_number(results->study, "recommendation", 0, what);
}

/* NULL if the number does not apply. */
static const char *setting(const struct cli_study_results *results, const char *what,
                           char text[HOOKE_NUMBER_SIZE]) {
  double value = recommended(results, what);
  return isnan(value) ? NULL : cli_format_number(value, text);
}

/* HOOKE_NO_MEMORY */
static int32_t find_command(struct cli_study_results *results) {
  char step[HOOKE_NUMBER_SIZE], rtol[HOOKE_NUMBER_SIZE], atol[HOOKE_NUMBER_SIZE];
  const char *method = hooke_measurement_text(results->study, "recommendation", 0, "method");
  if (!method) return HOOKE_OK;
  struct cli_setting settings[] = {{"method", method},
                                   {"step", setting(results, "step", step)},
                                   {"rtol", setting(results, "rtol", rtol)},
                                   {"atol", setting(results, "atol", atol)},
                                   {"atol_velocity", NULL},
                                   {NULL, NULL}};
  /* the study sets it to the number of atol, for any scene */
  if (hooke_options_is_set(results->setup.options, "atol_velocity")) settings[4].text = settings[3].text;
  const int32_t status = cli_command_make(results->arguments, settings, &results->command);
  return status == HOOKE_OK ? hooke_measurement_label(results->study, "command", results->command) : status;
}

/* ---- results ---- */

static int32_t write_output(const struct cli_study_results *results, const char *output) {
  struct cli_watch watch;
  int32_t status =
      hooke_measurement_label(results->study, "scene", hooke_scene_text(results->setup.scene, "text"));
  if (status != HOOKE_OK) return status;
  cli_watch_start(&watch, results->arguments);
  hooke_measurement_on_progress(results->study, cli_watch_progress, &watch);
  status = hooke_measurement_write(results->study, output);
  hooke_measurement_on_progress(results->study, NULL, NULL);
  cli_watch_end(&watch);
  return status;
}

/* Results are printed also when the file fails. */
static int tell(struct cli_study_results *results, const char *output) {
  const struct cli_arguments *arguments = results->arguments;
  int32_t written = HOOKE_OK;
  /* a study that was stopped before its first row does not replace an older file */
  if (hooke_measurement_row_count(results->study, "rows") == 0) output = NULL;
  results->trusts_all = cli_number(results->study, "reference", "trusted_until") >=
                        cli_number(results->study, "study", "duration") * (1.0 - 1e-9);
  int32_t found = find_command(results);
  if (arguments->json && cli_claims_print_json(arguments, "scene", results->study) != HOOKE_OK)
    found = HOOKE_NO_MEMORY;
  if (!arguments->json) cli_study_results_print(results);
  if (output) written = write_output(results, output);
  if (output && written == HOOKE_OK && !arguments->json) cli_say("\noutput: %s\n", output);
  cli_print_flush();
  if (written != HOOKE_OK)
    cli_report_words(arguments, "%s",
                     written == HOOKE_STOPPED ? "interrupted; nothing is written" : hooke_last_error());
  if (results->outcome == HOOKE_STOPPED) {
    cli_report_words(arguments, "interrupted; kept: the %" PRId64 " rows done so far%s%s",
                     hooke_measurement_row_count(results->study, "rows"),
                     output && written == HOOKE_OK ? ", in " : "",
                     output && written == HOOKE_OK ? output : "");
  }
  if (written != HOOKE_OK) return cli_exit_code(written);
  if (found != HOOKE_OK) return cli_report_missing_words(arguments);
  if (results->outcome == HOOKE_STOPPED) return HOOKE_EXIT_INTERRUPTED;
  const int32_t made = hooke_measurement_text(results->study, "recommendation", 0, "note") != NULL;
  const int32_t met = recommended(results, "met") == 1.0 && results->trusts_all;
  return made && !met ? HOOKE_EXIT_NOT_MET : HOOKE_EXIT_DONE;
}

/* A ladder has steps of its own. */
static int require(const struct cli_study_results *results, const struct cli_methods *methods) {
  int code = cli_setup_require_duration(results->arguments, &results->setup);
  for (int32_t k = 0; results->once && k < methods->count; k++)
    if (code == HOOKE_EXIT_DONE)
      code = cli_setup_require(results->arguments, &results->setup, methods->name[k]);
  return code;
}

static int do_study(const struct cli_arguments *arguments) {
  struct cli_study_results results = {.arguments = arguments,
                                      .once = hooke_options_number(arguments->more, "once") == 1.0};
  const char *output = cli_arguments_text(arguments, "output");
  const char *report = cli_arguments_text(arguments, "report");
  struct cli_methods methods;
  int code = cli_methods_choose(arguments, &methods);
  if (code == HOOKE_EXIT_DONE) code = check_output(arguments, output);
  if (code == HOOKE_EXIT_DONE) code = cli_output_file_check_report(arguments, report);
  if (code != HOOKE_EXIT_DONE) return code;
  code = cli_setup_load(arguments, &results.setup);
  if (code == HOOKE_EXIT_DONE) code = require(&results, &methods);
  if (code == HOOKE_EXIT_DONE)
    code = cli_watch_measure(arguments, "study", &results.setup, NULL, &results.study, &results.outcome);
  if (code == HOOKE_EXIT_DONE) {
    code = tell(&results, output);
    if (hooke_measurement_row_count(results.study, "rows") > 0)
      code = cli_output_file_write_report(arguments, &results.setup, results.study, code);
  }
  free(results.command);
  hooke_measurement_destroy(results.study);
  cli_setup_destroy(&results.setup);
  return code;
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "FILE", "writes the rows to FILE.csv, or the whole study to FILE.h5, replacing it"},
    {"report", 0, "FILE.html",
     "writes diagrams, table and recommendation as one page to read offline, replacing it"},
};

const struct cli_verb cli_verb_study = {
    .name = "study",
    .summary = "how accurate each method is for what it costs, and which one to take",
    .text = "Makes a reference by two integrators that check each other, runs every method "
            "over a ladder of steps or tolerances, and prints error and cost of each run, the "
            "order of each method, and with --want LENGTH the cheapest run that is accurate "
            "enough, as a command. Runs that diverge stay as rows. Ctrl-C ends a study and "
            "prints what is done so far. Tables are rounded; --json and FILE have every digit.",
    .example = "hooke study cloth.json --want 1cm --budget 2s",
    HOOKE_VERB_ROWS(own_rows),
    .options = "study",
    .hidden = "once",
    .without = "method step rtol atol atol_velocity checkpoint",
    .function = do_study,
};
