/* hooke study: accuracy and cost of each method on a scene, and a recommendation. */
#include "claims.h"
#include "command.h"
#include "print.h"
#include "report.h"
#include "rows.h"
#include "results.h"
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

static int check(const struct cli_arguments *arguments) {
  const char *output = cli_arguments_text(arguments, "output");
  int code = HOOKE_EXIT_DONE;
  if (!output) return code;
  if (!ends_in(output, ".csv") && !ends_in(output, ".h5")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "-o %s: allowed: a name that ends in .csv, for the "
                      "rows as a table, or in .h5, for the whole study",
                      output);
  }
  if (ends_in(output, ".h5")) code = cli_setup_check_output(arguments, output);
  return code == HOOKE_EXIT_DONE ? cli_setup_check_ending(arguments, "-o", output) : code;
}

/* ---- the recommended command ---- */

static double recommended(const struct cli_results *results, const char *what) {
  return hooke_measurement_number(results->found, "recommendation", 0, what);
}

/* NULL if the number does not apply, or follows from rtol: an absolute tolerance that the scene leaves open.
 */
static const char *setting(const struct cli_results *results, const char *what,
                           char text[HOOKE_NUMBER_SIZE]) {
  const double value = recommended(results, what);
  const int follows = what[0] == 'a' && !hooke_options_is_set(results->setup.options, what);
  return isnan(value) || follows ? NULL : cli_format_number(value, text);
}

/* HOOKE_NO_MEMORY */
static int32_t find_command(struct cli_results *results) {
  char step[HOOKE_NUMBER_SIZE], rtol[HOOKE_NUMBER_SIZE], atol[2][HOOKE_NUMBER_SIZE];
  const char *method = hooke_measurement_text(results->found, "recommendation", 0, "method");
  if (!method) return HOOKE_OK;
  struct cli_setting settings[] = {{"method", method},
                                   {"step", setting(results, "step", step)},
                                   {"rtol", setting(results, "rtol", rtol)},
                                   {"atol", setting(results, "atol", atol[0])},
                                   {"atol_velocity", setting(results, "atol_velocity", atol[1])},
                                   {NULL, NULL}};
  const int32_t status = cli_command_make(results->arguments, settings, &results->command);
  return status == HOOKE_OK ? hooke_measurement_label(results->found, "command", results->command) : status;
}

/* ---- results ---- */

static int32_t write_output(const struct cli_results *results, const char *output) {
  struct cli_watch watch;
  int32_t status =
      hooke_measurement_label(results->found, "scene", hooke_scene_text(results->setup.scene, "text"));
  if (status != HOOKE_OK) return status;
  cli_watch_start(&watch, results->arguments);
  hooke_measurement_on_progress(results->found, cli_watch_progress, &watch);
  status = hooke_measurement_write(results->found, output);
  hooke_measurement_on_progress(results->found, NULL, NULL);
  cli_watch_end(&watch);
  return status;
}

/* The exit code, by the status of the file and of the command. */
static int finish(const struct cli_results *results, int32_t written, int32_t found) {
  if (written != HOOKE_OK) return cli_exit_code(written);
  if (found != HOOKE_OK) return cli_report_missing_words(results->arguments);
  if (results->outcome == HOOKE_STOPPED) return HOOKE_EXIT_INTERRUPTED;
  const int32_t made = hooke_measurement_text(results->found, "recommendation", 0, "note") != NULL;
  const int32_t met = recommended(results, "met") == 1.0 && cli_study_trusts_all(results->found);
  return made && !met ? HOOKE_EXIT_NOT_MET : HOOKE_EXIT_DONE;
}

/* Results are printed also when the file fails. */
static int tell(struct cli_results *results) {
  const struct cli_arguments *arguments = results->arguments;
  const char *output = cli_arguments_text(arguments, "output");
  const int64_t rows = hooke_measurement_row_count(results->found, "rows");
  int32_t written = HOOKE_OK;
  /* a study that was stopped before its first row does not replace an older file */
  if (rows == 0) output = NULL;
  int32_t found = find_command(results);
  if (arguments->json && cli_claims_print_json(arguments, "scene", results->found) != HOOKE_OK)
    found = HOOKE_NO_MEMORY;
  if (!arguments->json) cli_study_results_print(results);
  if (output) written = write_output(results, output);
  if (output && written == HOOKE_OK && !arguments->json) cli_say("\noutput: %s\n", output);
  cli_print_flush();
  if (written != HOOKE_OK)
    cli_report_words(arguments, "%s",
                     written == HOOKE_STOPPED ? "interrupted; nothing is written" : hooke_last_error());
  if (results->outcome == HOOKE_STOPPED) {
    cli_report_words(arguments, "interrupted; kept: the %" PRId64 " rows done so far%s%s", rows,
                     output && written == HOOKE_OK ? ", in " : "",
                     output && written == HOOKE_OK ? output : "");
  }
  int code = finish(results, written, found);
  return rows > 0 ? cli_setup_write_report(arguments, &results->setup, results->found, code) : code;
}

/* A ladder has steps of its own. */
static int require(struct cli_results *results) {
  const int once = cli_arguments_asks(results->arguments, "once");
  int code = cli_setup_require(results->arguments, &results->setup, NULL);
  for (int32_t k = 0; once && k < results->method_count && code == HOOKE_EXIT_DONE; k++)
    code = cli_setup_require(results->arguments, &results->setup, results->method[k]);
  return code;
}

static int do_study(const struct cli_arguments *arguments) {
  return cli_results_make(arguments, "study", check, require, tell);
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "FILE", "writes the rows to FILE.csv, or the whole study to FILE.h5, replacing it"},
    {"report", 0, "FILE.html",
     "writes diagrams, table and recommendation as one page to read offline, replacing it"},
};

const struct cli_verb cli_verb_study = {
    .name = "study",
    .summary = "how accurate each method is for what it costs, and which one to take",
    .text = "Makes a reference by two runs that check each other, runs every method "
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
