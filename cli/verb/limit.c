/* hooke limit: the largest stable step of each method, predicted and measured, and what determines it. */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 12 };

/* ---- the state ---- */

/* FILE:FRAME, or FILE alone for its last frame. */
static int read_state(struct cli_results *l, const char *at) {
  const char *colon = strrchr(at, ':');
  char *end = NULL;
  errno = 0;
  const long long frame = colon ? strtoll(colon + 1, &end, 10) : -1;
  if (colon && (end == colon + 1 || *end || errno)) {
    return cli_report(l->arguments, HOOKE_EXIT_USAGE,
                      "--at %s: allowed: a trajectory and a frame of it, FILE:FRAME, counted from 0, or from "
                      "-1 backwards; the last one if not given",
                      at);
  }
  hooke_record *record = NULL;
  char *file = strdup(at);
  if (file && colon) file[colon - at] = '\0';
  if (!file) return cli_report(l->arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  const char *report = cli_arguments_text(l->arguments, "report");
  const int code = cli_setup_check_apart(l->arguments, file, "the trajectory of --at", report);
  int32_t status = code == HOOKE_EXIT_DONE ? hooke_record_open(file, &record) : HOOKE_OK;
  if (status == HOOKE_OK && record) status = hooke_record_read(record, frame, l->setup.state);
  free(file);
  hooke_record_close(record);
  if (code != HOOKE_EXIT_DONE) return code;
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(l->arguments, status);
}

/* ---- computing ---- */

static int make_ready(struct cli_results *l) {
  const char *at = cli_arguments_text(l->arguments, "at");
  const int code = at ? read_state(l, at) : HOOKE_EXIT_DONE;
  if (code != HOOKE_EXIT_DONE) return code;
  l->from = l->setup.state;
  const char *method = hooke_options_text(l->setup.options, "method");
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
    {"smallest_time", "at time", "[s]", 10, "%.6g", "none", NULL, 0}};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

/* The columns in which anything is known. */
static void print_table(const hooke_measurement *limit) {
  struct cli_column shown[COLUMN_COUNT + 1] = {{.what = NULL}};
  const struct cli_rows rows = {.source = limit, .columns = shown};
  int32_t count = 0;
  for (int k = 0; k < COLUMN_COUNT; k++) {
    int32_t known = 0;
    for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++)
      known |= !isnan(hooke_measurement_number(limit, "rows", row, columns[k].what));
    if (known) shown[count++] = columns[k];
  }
  cli_rows_print(&rows, cli_rows_width(limit, "rows", "method", HOOKE_METHOD_WIDTH));
}

static void print_words(const struct cli_results *l) {
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, at t = %s s\n", cli_setup_title(l->arguments, &l->setup),
          cli_format_rounded(cli_number(l->found, "limit", "time"), text));
  cli_claims_print(l->arguments, l->found, INDENT, NULL);
  printf("\nfastest motion %.6g rad/s, fastest damping %.6g 1/s\n\n",
         cli_number(l->found, "limit", "frequency_max"), cli_number(l->found, "limit", "rate_max"));
  print_table(l->found);
  if (hooke_measurement_row_count(l->found, "blame") > 0) printf("\n");
  cli_limiting_print(l->found);
}

static int tell(struct cli_results *l) {
  int code = HOOKE_EXIT_DONE;
  if (!l->arguments->json)
    print_words(l);
  else if (cli_claims_print_json(l->arguments, "scene", l->found) != HOOKE_OK)
    code = cli_report_missing_words(l->arguments);
  cli_print_flush();
  if (l->outcome == HOOKE_STOPPED) {
    cli_report_words(l->arguments, "interrupted; kept: what was found so far");
    code = HOOKE_EXIT_INTERRUPTED;
  } else if (l->outcome != HOOKE_OK) {
    cli_report_words(l->arguments, "the run ended early, at t = %g s: %s", hooke_state_time(l->setup.state),
                     hooke_last_error());
    code = HOOKE_EXIT_DIVERGED;
  }
  if (isnan(cli_number(l->found, "limit", "frequency_max"))) return code;
  return cli_setup_write_report(l->arguments, &l->setup, l->found, code);
}

static int do_limit(const struct cli_arguments *arguments) {
  return cli_results_make(arguments, "limit", NULL, make_ready, tell);
}

static const struct cli_verb_row own_rows[] = {
    {"at", 0, "FILE:FRAME",
     "at a frame of a trajectory, the last one if FRAME is left out; else at the start"},
    HOOKE_FROM_REST,
    {"report", 0, "FILE.html",
     "writes regions of stability, limiting mode, table and "
     "suggestion as one page to read offline, replacing it"},
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
    .function = do_limit,
};
