/* hooke study: accuracy and cost of each method on a scene, and a recommendation. */
#include "measured.h"
#include "command.h"
#include "print.h"
#include "report.h"
#include "results.h"
#include "watch.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INDENT = 16, WIDTH = 110, TIMES = 5, CELL = 11, SETTING = 12 };

/* A bias below this many standard errors is compatible with chance. */
static const double SEEN = 2.0;
static const int MEMBERS_ADVISED = 16;

static const struct cli_column columns[] = {
    {"step", "step", "[s]", 9, "%.4g", NULL, NULL, 0},
    {"rtol", "rtol", "", 9, "%.4g", NULL, NULL, 0},
    {"error", "error", "max [m]", 10, "%.4g", NULL, NULL, 1},
    {"error_final", "error", "end [m]", 10, "%.4g", NULL, NULL, 0},
    {"error_max", "farthest", "particle [m]", 12, "%.4g", NULL, NULL, 0},
    {"energy_drift", "energy", "drift [J]", 10, "%.4g", NULL, NULL, 1},
    {"steps", "steps", "", 9, "%.0f", NULL, NULL, 0},
    {"force_evaluations", "force", "evaluations", 11, "%.0f", NULL, NULL, 0},
    {"wall_seconds", "wall time", "[s]", 10, "%.4g", NULL, NULL, 1},
    {.what = NULL}};

/* 1: the reference, and with it every error of a study, is trusted up to the end of the run. */
static int32_t trusts_all(const hooke_measurement *study) {
  return cli_number(study, "reference", "trusted_until") >=
         cli_number(study, "study", "duration") * (1.0 - 1e-9);
}

static char mark_of(const hooke_measurement *study, int64_t row, const char *what) {
  if (strcmp(what, "error") == 0)
    return hooke_measurement_number(study, "rows", row, "near_floor") == 1.0 ? '*' : ' ';
  if (strcmp(what, "energy_drift") == 0)
    return hooke_measurement_number(study, "rows", row, "near_energy_floor") == 1.0 ? '*' : ' ';
  return hooke_measurement_number(study, "rows", row, "timed_alone") == 0.0 ? '+' : ' ';
}

/* ---- errors over time ---- */

/* At a few evenly spaced frames, including the last. */
static void print_errors(const hooke_measurement *study, int32_t width) {
  int64_t count;
  const double *time = hooke_measurement_series(study, "reference", 0, "time", &count);
  const int64_t last = count - 1, frames = last < TIMES ? last : TIMES;
  printf("\nerror [m]\n%-*s", width, "at t [s] =");
  for (int64_t i = 1; i <= frames; i++)
    cli_rows_print_cell(10, time[last * i / frames]);
  printf("\n");
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "rows"); row++) {
    const double *error = hooke_measurement_series(study, "rows", row, "error_at", NULL);
    cli_print_padded(stdout, width, hooke_measurement_text(study, "rows", row, "method"));
    for (int64_t i = 1; i <= frames; i++)
      cli_rows_print_cell(10, error ? error[last * i / frames] : (double)NAN);
    printf("\n");
  }
}

/* ---- orders ---- */

static void print_order(const hooke_measurement *study, int64_t row, int32_t width) {
  const double order = hooke_measurement_number(study, "orders", row, "order");
  const char *note = hooke_measurement_text(study, "orders", row, "note");
  char seen[HOOKE_NUMBER_SIZE] = "-", interval[HOOKE_NUMBER_SIZE] = "-";
  if (!isnan(order)) {
    snprintf(seen, sizeof seen, "%.2f", order);
    snprintf(interval, sizeof interval, "%.2f to %.2f", hooke_measurement_number(study, "orders", row, "low"),
             hooke_measurement_number(study, "orders", row, "high"));
  }
  cli_print_padded(stdout, width, hooke_measurement_text(study, "orders", row, "method"));
  printf(" %7s %16s", seen, interval);
  cli_rows_print_cell(7, hooke_measurement_number(study, "orders", row, "theory"));
  cli_rows_print_as(9, hooke_measurement_number(study, "orders", row, "order_step"), "%.2f", NULL, NULL);
  printf(note[0] ? "  " : "\n");
  if (note[0]) cli_print_wrapped(stdout, width + 45, width + 45, WIDTH + 20, note);
}

static void print_orders(const hooke_measurement *study, int32_t width) {
  int32_t any = 0;
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "orders"); row++) {
    if (isnan(hooke_measurement_number(study, "orders", row, "theory"))) continue; /* of no fixed step */
    if (!any)
      printf("\n%-*s %7s %16s %7s %9s\n", width, "order", "seen", "95 % interval", "theory", "one step");
    any = 1;
    print_order(study, row, width);
  }
  if (any)
    printf(
        "95 %% interval: of the slope of a straight line, as if errors scattered about it by chance; one step: "
        "the slope\nof the error of one step, from two fifths of the run, which is one more\n");
}

/* Legend of the columns, and of the marks that occur. */
static void print_legend(const hooke_measurement *study, int32_t once) {
  int32_t shared = 0, marked = 0;
  double spread = 0.0;
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "rows"); row++) {
    shared |= mark_of(study, row, "wall_seconds") == '+';
    marked |= mark_of(study, row, "error") == '*' || mark_of(study, row, "energy_drift") == '*';
    spread = fmax(spread, hooke_measurement_number(study, "rows", row, "wall_median") /
                              hooke_measurement_number(study, "rows", row, "wall_seconds"));
  }
  printf("\nerror: the root mean square over free particles of the distance to the reference; farthest: the "
         "largest distance of\na particle, which a wanted error is held against; wall time: ");
  if (once)
    printf("of one run");
  else
    printf("the least of several runs, whose median is up to %.0f %% longer",
           fmax(0.0, 100.0 * (spread - 1.0)));
  printf("\n%s%s", marked ? "*: within ten times of the floor\n" : "",
         shared ? "+: other rows ran beside it, so its time may be too long\n" : "");
}

/* ---- watched quantities ---- */

/* The step, or the tolerance that stands for it. */
static void print_setting(const hooke_measurement *study, const char *table, int64_t row) {
  const double step = hooke_measurement_number(study, table, row, "step");
  cli_rows_print_as(SETTING, isnan(step) ? hooke_measurement_number(study, table, row, "rtol") : step,
                    isnan(step) ? "rtol %.4g" : "%.4g", NULL, NULL);
}

/* Of a value and an error; the name stands over both. */
static int width_of(const hooke_measurement *study, int64_t quantity) {
  char head[HOOKE_HEAD_SIZE];
  const int length = (int)strlen(cli_quantity(study, "watched", quantity, head));
  return length < 2 * CELL + 1 ? 2 * CELL + 1 : length;
}

/* Values at the end and errors of a row, marked within ten times the agreement of the reference; of the
 * reference, with its agreements, if it is -1. */
static void print_cells(const hooke_measurement *study, int64_t row) {
  const int64_t count = hooke_measurement_row_count(study, "watched");
  const char *table = row < 0 ? "watched" : "watched_errors", *end = row < 0 ? "reference_end" : "at_end";
  for (int64_t k = 0; k < count; k++) {
    const int64_t at = row < 0 ? k : row * count + k;
    const double agreement = hooke_measurement_number(study, "watched", k, "agreement"),
                 error = hooke_measurement_number(study, "watched_errors", at, "error");
    cli_rows_print_as(width_of(study, k) - CELL - 1, hooke_measurement_number(study, table, at, end), "%.6g",
                      NULL, NULL);
    cli_rows_print_as(CELL, row < 0 ? agreement : error, "%.4g", NULL, NULL);
    putchar(row >= 0 && error <= 10.0 * agreement ? '*' : ' ');
  }
  printf("\n");
}

/* A line a row of the study; nothing if none are watched. */
static void print_watched(const hooke_measurement *study, int32_t method_width) {
  const int64_t count = hooke_measurement_row_count(study, "watched");
  char head[HOOKE_HEAD_SIZE];
  if (count <= 0) return;
  printf("\n%-*s %*s", method_width, "watched", SETTING, "");
  for (int64_t k = 0; k < count; k++) {
    const char *text = cli_quantity(study, "watched", k, head);
    cli_say("%*s%s ", 1 + width_of(study, k) - (int)strlen(text), "", text);
  }
  printf("\n%-*s %*s", method_width, "", SETTING, "step [s]");
  for (int64_t k = 0; k < count; k++)
    printf(" %*s %*s ", width_of(study, k) - CELL - 1, "at the end", CELL, "error");
  printf("\n%-*s %*s", method_width, "reference", SETTING, "");
  print_cells(study, -1);
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "rows"); row++) {
    cli_print_padded(stdout, method_width, hooke_measurement_text(study, "rows", row, "method"));
    print_setting(study, "rows", row);
    print_cells(study, row);
  }
  printf(
      "at the end: the value at the last frame that the reference is trusted at, of a period that until then (-: none "
      "is seen);\nerror: the largest difference from the reference, of the reference its agreement, in a period "
      "that of the two periods;\n*: within ten times of the agreement\n");
}

/* ---- statistics ---- */

/* Of the table "statistics", whose rows are those of each method, the reference first, times these. */
static int64_t quantity_count(const hooke_measurement *study) {
  const int64_t count = hooke_measurement_row_count(study, "statistics");
  int64_t quantities = 0;
  while (quantities < count &&
         strcmp(hooke_measurement_text(study, "statistics", quantities, "method"), "reference") == 0)
    quantities++;
  return quantities;
}

static double statistic(const hooke_measurement *study, int64_t row, const char *what) {
  return hooke_measurement_number(study, "statistics", row, what);
}

static void print_bias(const hooke_measurement *study, int64_t row) {
  const double bias = statistic(study, row, "bias");
  if (strcmp(hooke_measurement_text(study, "statistics", row, "method"), "reference") == 0)
    printf("\n");
  else if (statistic(study, row, "failed") > 0.0)
    printf("  unknown: a run did not come to its end\n");
  else if (isnan(bias))
    printf("  unknown\n");
  else if (fabs(bias) < SEEN)
    printf("  none seen (%+.1f)\n", bias);
  else
    printf("  %+.3g standard errors\n", bias);
}

static void print_source(const hooke_measurement *study, int32_t method_width, int64_t row) {
  printf("  ");
  cli_print_padded(stdout, method_width, hooke_measurement_text(study, "statistics", row, "method"));
  print_setting(study, "statistics", row);
  printf(" %5.0f", statistic(study, row, "members"));
  cli_rows_print_cell(CELL, statistic(study, row, "mean"));
  cli_rows_print_cell(CELL, statistic(study, row, "spread"));
  print_bias(study, row);
}

static void print_ensemble(const hooke_measurement *study, int32_t method_width) {
  const int64_t count = quantity_count(study);
  char head[HOOKE_HEAD_SIZE];
  if (isnan(cli_number(study, "ensemble", "from"))) return;
  printf("\nstatistics\n  %-*s %*s %5s %*s %*s  %s\n", method_width, "method", SETTING, "step [s]", "runs",
         CELL, "mean", CELL, "spread", "bias");
  for (int64_t k = 0; k < count; k++) {
    cli_say("%s\n", cli_quantity(study, "statistics", k, head));
    for (int64_t row = k; row < hooke_measurement_row_count(study, "statistics"); row += count)
      print_source(study, method_width, row);
  }
  printf("spread: the standard deviation of the runs; bias: the difference from the reference's mean, in "
         "standard errors of it;\nbelow %.0f none is seen, and where there is none, one figure in twenty is "
         "above, more with few runs\n",
         SEEN);
}

/* Means, spreads and biases where the motion cannot be judged; or how to obtain them. */
static void print_statistics(const struct cli_results *results, int32_t method_width) {
  const hooke_measurement *study = results->found;
  const int32_t asked = cli_arguments_text(results->arguments, "ensemble") != NULL;
  if (hooke_measurement_row_count(study, "ensemble") > 0) {
    print_ensemble(study, method_width);
  } else if (!trusts_all(study) && !asked && hooke_measurement_row_count(study, "rows") > 0 &&
             !results->arguments->quiet) {
    printf("\n");
    cli_print_fact(INDENT, WIDTH, "statistics", "--ensemble %d tells means and spreads beyond %.6g s",
                   MEMBERS_ADVISED, cli_number(study, "reference", "trusted_until"));
  }
}

/* ---- all words ---- */

static void print_words(const struct cli_results *results) {
  const struct cli_arguments *arguments = results->arguments;
  const hooke_measurement *study = results->found;
  const int once = cli_arguments_asks(arguments, "once");
  const int met = cli_number(study, "recommendation", "met") == 1.0;
  const int32_t width = cli_rows_width(study, "rows", "method", HOOKE_METHOD_WIDTH);
  const struct cli_rows rows = {
      .source = study, .columns = columns, .grouped = !once, .status = 1, .mark = mark_of};
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, %s s\n", cli_setup_title(arguments, &results->setup),
          cli_format_rounded(cli_number(study, "study", "duration"), text));
  cli_claims_print(arguments, study, INDENT, met ? results->command : NULL);
  if (hooke_measurement_row_count(study, "rows") > 0) {
    if (once) print_errors(study, width);
    printf("\n");
    cli_rows_print(&rows, width);
    print_legend(study, once);
    print_watched(study, width);
    if (!once) print_orders(study, width);
    if (!arguments->quiet && !cli_arguments_text(arguments, "want"))
      printf("\nwhich one to take: %s the error that you can live with, such as --want 1mm\n",
             once ? "'hooke study' with" : "add");
  }
  if (!once) print_statistics(results, width);
}

/* ---- the file of -o ---- */

static int ends_in(const char *name, const char *ending) {
  const size_t length = strlen(name), end = strlen(ending);
  return length > end && strcmp(name + length - end, ending) == 0;
}

static int check(const struct cli_arguments *arguments) {
  const char *output = cli_arguments_text(arguments, "output");
  if (!output) return HOOKE_EXIT_DONE;
  if (!ends_in(output, ".csv") && !ends_in(output, ".h5")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "-o %s: allowed: a name that ends in .csv, for the "
                      "rows as a table, or in .h5, for all that is found",
                      output);
  }
  return ends_in(output, ".h5") ? cli_setup_check_output(arguments, output) : HOOKE_EXIT_DONE;
}

/* ---- the recommended command ---- */

/* An absolute tolerance that the scene leaves open follows from rtol. HOOKE_NO_MEMORY */
static int32_t find_command(struct cli_results *results) {
  static const char *const numbers[] = {"step", "rtol", "atol", "atol_velocity"};
  const char *method = cli_text(results->found, "recommendation", "method");
  struct cli_string command = {.bytes = NULL};
  hooke_options *changes = NULL;
  if (!method) return HOOKE_OK;
  int32_t status = hooke_options_create("run", &changes);
  if (status == HOOKE_OK) status = hooke_options_set_text(changes, "method", method);
  for (int k = 0; k < 4 && status == HOOKE_OK; k++) {
    const double value = cli_number(results->found, "recommendation", numbers[k]);
    const int follows = k >= 2 && !hooke_options_is_set(results->setup.options, numbers[k]);
    if (!isnan(value) && !follows) status = hooke_options_set_number(changes, numbers[k], value);
  }
  if (status == HOOKE_OK) cli_command_add(&command, results->arguments, "run", changes);
  hooke_options_destroy(changes);
  results->command = command.bytes;
  if (status == HOOKE_OK) status = command.status;
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
  if (results->outcome == HOOKE_STOPPED) return cli_exit_code(HOOKE_STOPPED);
  const int32_t made = cli_text(results->found, "recommendation", "note") != NULL;
  const int32_t met =
      cli_number(results->found, "recommendation", "met") == 1.0 && trusts_all(results->found);
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
  if (!arguments->json) print_words(results);
  if (output) written = write_output(results, output);
  if (output && written == HOOKE_OK && !arguments->json) cli_say("\noutput: %s\n", output);
  cli_print_flush();
  if (written != HOOKE_OK)
    cli_report_words(arguments, "%s",
                     written == HOOKE_STOPPED ? "interrupted; nothing is written" : hooke_last_error());
  if (results->outcome == HOOKE_STOPPED) {
    cli_report_words(arguments, "%s; kept: the %" PRId64 " rows done so far%s%s", cli_force_stop(), rows,
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

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "FILE", "writes the rows to FILE.csv, or the whole study to FILE.h5, replacing it"},
    {"report", 0, "FILE.html",
     "writes diagrams, table and recommendation as one page to read offline, replacing it"},
    HOOKE_FROM_REST,
    HOOKE_FORCE,
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
    .check = check,
    .ready = require,
    .tell = tell,
};
