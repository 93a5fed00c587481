/* hooke limit: the largest stable step of each method, predicted and measured, and what determines it. */
#include "command.h"
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 12 };

/* ---- computing ---- */

static int make_ready(struct cli_results *l) {
  const int code = cli_results_at(l);
  if (code != HOOKE_EXIT_DONE) return code;
  const char *method = hooke_options_text(l->setup.options, "method");
  const char *methods = cli_arguments_text(l->arguments, "methods");
  int32_t apart = methods && cli_arguments_text(l->arguments, "method") ? 1 : 0;
  for (int32_t k = 0; k < l->method_count; k++)
    apart &= strcmp(l->method[k], method) != 0;
  if (apart && !cli_arguments_asks(l->arguments, "along"))
    return cli_report(l->arguments, HOOKE_EXIT_USAGE,
                      "--method %s is none of --methods %s; name it there, too, or leave one out", method,
                      methods);
  if (cli_arguments_asks(l->arguments, "along")) return cli_setup_require(l->arguments, &l->setup, method);
  if (cli_arguments_asks(l->arguments, "nonlinear")) return cli_setup_require(l->arguments, &l->setup, NULL);
  return HOOKE_EXIT_DONE;
}

/* ---- words ---- */

static const struct cli_column columns[] = {
    {"bound", "safe bound", "[s]", 12, "%.6g", "none", "no step", 0},
    {"predicted", "predicted", "[s]", 12, "%.6g", "none", "no step", 0},
    {"measured", "measured", "[s]", 12, "%.6g", "none", "no step", 0},
    {"ratio", "measured /", "predicted", 10, "%.6g", "none", "no step", 0},
    {"steps_run", "steps", "run", 10, "%.0f", "none", NULL, 0},
    {"smallest", "smallest", "met [s]", 12, "%.6g", "none", "no step", 0},
    {"smallest_time", "at time", "[s]", 10, "%.6g", "none", NULL, 0},
    {.what = NULL}};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

/* The columns in which anything is known. */
static void print_table(const hooke_measurement *limit) {
  struct cli_column shown[COLUMN_COUNT];
  const struct cli_rows rows = {.source = limit, .columns = shown};
  cli_rows_known(limit, columns, shown);
  cli_rows_print(&rows, cli_rows_width(limit, "rows", "method", HOOKE_METHOD_WIDTH));
}

static void print_words(const struct cli_results *l) {
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, at t = %s s\n", cli_setup_title(l->arguments, &l->setup),
          cli_format_rounded(cli_number(l->found, "limit", "time"), text));
  cli_claims_print(l->arguments, l->found, INDENT, NULL);
  const char *command = hooke_measurement_text(l->found, "changes", 0, "command");
  if (command) printf("  %s\n", command);
  printf("\nfastest motion %.6g rad/s, fastest damping %.6g 1/s\n\n",
         cli_number(l->found, "limit", "frequency_max"), cli_number(l->found, "limit", "rate_max"));
  print_table(l->found);
  if (hooke_measurement_row_count(l->found, "blame") > 0) printf("\n");
  cli_limiting_print(l->found);
}

/* How to ask for the price of what it suggests, where that is not known. */
static int32_t label(const struct cli_results *l) {
  struct cli_string command = {.bytes = NULL};
  int32_t status =
      cli_command_ask_needs(l->arguments, hooke_measurement_number(l->found, "changes", 0, "want"), &command);
  if (status == HOOKE_OK && command.bytes)
    status = hooke_measurement_label(l->found, "command", command.bytes);
  free(command.bytes);
  return status;
}

static int tell(struct cli_results *l) {
  int code = HOOKE_EXIT_DONE;
  if (label(l) != HOOKE_OK) return cli_report_missing_words(l->arguments);
  if (!l->arguments->json)
    print_words(l);
  else if (cli_claims_print_json(l->arguments, "scene", l->found) != HOOKE_OK)
    code = cli_report_missing_words(l->arguments);
  cli_print_flush();
  if (l->outcome == HOOKE_STOPPED) {
    cli_report_words(l->arguments, "%s; kept: what was found so far", cli_force_stop());
    code = cli_exit_code(HOOKE_STOPPED);
  } else if (l->outcome != HOOKE_OK) {
    cli_report_words(l->arguments, "the run ended early, at t = %g s: %s", hooke_state_time(l->setup.state),
                     hooke_last_error());
    code = HOOKE_EXIT_DIVERGED;
  }
  if (isnan(cli_number(l->found, "limit", "frequency_max"))) return code;
  return cli_setup_write_report(l->arguments, &l->setup, l->found, code);
}

static const struct cli_verb_row own_rows[] = {
    HOOKE_AT,
    HOOKE_FROM_REST,
    {"report", 0, "FILE.html",
     "writes regions of stability, limiting mode, table and "
     "suggestion as one page to read offline, replacing it"},
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_limit = {
    .name = "limit",
    .summary = "the largest stable step of each method, predicted and measured, and what determines it",
    .text = "Predicts the largest stable step of each fixed-step method from the eigenvalues of the scene, "
            "frozen at its positions and at rest, then measures it by running the method. Says which springs "
            "carry the motion that limits --method, and what it would buy to change them. Safe bound: a step "
            "that is certain to be stable, from one pass over the springs.",
    .example = "hooke limit cloth.json --predict",
    HOOKE_VERB_ROWS(own_rows),
    .options = "limit",
    .without = "checkpoint",
    .ready = make_ready,
    .tell = tell,
};
