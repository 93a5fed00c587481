/* hooke limit: the largest stable step of each method, predicted and measured, and what determines it. */
#include "claims.h"
#include "methods.h"
#include "output_file.h"
#include "limiting.h"
#include "print.h"
#include "report.h"
#include "rows.h"
#include "setup.h"
#include "watch.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 12 };

struct limit {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *limit;
  int32_t along, outcome;
};

/* ---- the state ---- */

/* FILE:FRAME, or FILE alone for its last frame. */
static int read_state(struct limit *l, const char *at) {
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

static int check_names(const struct cli_arguments *arguments) {
  struct cli_methods methods;
  if (!cli_arguments_text(arguments, "methods")) return HOOKE_EXIT_DONE;
  return cli_methods_choose(arguments, &methods);
}

static int check_needs(const struct limit *l) {
  const char *method = hooke_options_text(l->setup.options, "method");
  if (l->along) return cli_setup_require(l->arguments, &l->setup, method);
  if (hooke_options_number(l->arguments->more, "nonlinear") != 0.0)
    return cli_setup_require_duration(l->arguments, &l->setup);
  return HOOKE_EXIT_DONE;
}

/* ---- words ---- */

static double number_of(const struct limit *l, const char *what) {
  return cli_number(l->limit, "limit", what);
}

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
  const struct cli_rows rows = {
      .source = limit, .count = hooke_measurement_row_count(limit, "rows"), .columns = shown};
  int32_t count = 0;
  for (int k = 0; k < COLUMN_COUNT; k++) {
    int32_t known = 0;
    for (int64_t row = 0; row < rows.count; row++)
      known |= !isnan(hooke_measurement_number(limit, "rows", row, columns[k].what));
    if (known) shown[count++] = columns[k];
  }
  cli_rows_print(&rows, cli_rows_method_width(&rows));
}

static void print_words(const struct limit *l) {
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, at t = %s s\n", cli_setup_title(l->arguments, &l->setup),
          cli_format_rounded(number_of(l, "time"), text));
  cli_claims_print(l->arguments, l->limit, INDENT, NULL);
  printf("\nfastest motion %.6g rad/s, fastest damping %.6g 1/s\n\n", number_of(l, "frequency_max"),
         number_of(l, "rate_max"));
  print_table(l->limit);
  if (hooke_measurement_row_count(l->limit, "blame") > 0) printf("\n");
  cli_limiting_print(l->limit);
}

static int tell(const struct limit *l) {
  int code = HOOKE_EXIT_DONE;
  if (!l->arguments->json)
    print_words(l);
  else if (cli_claims_print_json(l->arguments, "scene", l->limit) != HOOKE_OK)
    code = cli_report_missing_words(l->arguments);
  cli_print_flush();
  if (l->outcome == HOOKE_STOPPED) {
    cli_report_words(l->arguments, "interrupted; kept: what was found so far");
    return HOOKE_EXIT_INTERRUPTED;
  }
  if (l->outcome == HOOKE_OK) return code;
  cli_report_words(l->arguments, "the run ended early, at t = %g s: %s", hooke_state_time(l->setup.state),
                   hooke_last_error());
  return HOOKE_EXIT_DIVERGED;
}

static int do_limit(const struct cli_arguments *arguments) {
  struct limit l = {.arguments = arguments, .along = hooke_options_number(arguments->more, "along") != 0.0};
  const char *at = cli_arguments_text(arguments, "at");
  const char *report = cli_arguments_text(arguments, "report");
  int code = check_names(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_output_file_check_report(arguments, report);
  if (code != HOOKE_EXIT_DONE) return code;
  code = cli_setup_load(arguments, &l.setup);
  if (code == HOOKE_EXIT_DONE && at) code = read_state(&l, at);
  if (code == HOOKE_EXIT_DONE) code = check_needs(&l);
  if (code == HOOKE_EXIT_DONE)
    code = cli_watch_measure(arguments, "limit", &l.setup, l.setup.state, &l.limit, &l.outcome);
  if (code == HOOKE_EXIT_DONE) {
    code = tell(&l);
    if (!isnan(number_of(&l, "frequency_max")))
      code = cli_output_file_write_report(arguments, &l.setup, l.limit, code);
  }
  hooke_measurement_destroy(l.limit);
  cli_setup_destroy(&l.setup);
  return code;
}

static const struct cli_verb_row own_rows[] = {
    {"at", 0, "FILE:FRAME",
     "at a frame of a trajectory, the last one if FRAME is left out; else at the start"},
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
