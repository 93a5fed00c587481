/* hooke limit: the largest stable step of each method, predicted and measured, and what it hangs on. */
#include "methods.h"
#include "output_file.h"
#include "blame.h"
#include "print.h"
#include "report.h"
#include "rows.h"
#include "setup.h"
#include "watch.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SPRINGS = 5, WIDTH = 110, INDENT = 12 };

struct limit {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_limit *limit;
  int32_t along, interrupted, diverged;
};

/* ---- the state ---- */

/* FILE:FRAME, or FILE alone for its last frame. */
static int read_state(struct limit *l, const char *at) {
  const char *colon = strrchr(at, ':');
  char *end = NULL;
  errno = 0;
  const long long frame = colon ? strtoll(colon + 1, &end, 10) : -1;
  if (colon && (end == colon + 1 || *end || errno)) {
    return cli_report(
        l->arguments, HOOKE_EXIT_USAGE,
        "--at %s: allowed: a trajectory and a frame of it, FILE:FRAME, counted from 0, or from -1 "
        "backwards; the last one if not given",
        at);
  }
  hooke_record *record = NULL;
  char *file = strndup(at, colon ? (size_t)(colon - at) : strlen(at));
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

/* ---- finding ---- */

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

static int find(struct limit *l) {
  struct cli_watch watch;
  int32_t status = hooke_limit_create(l->setup.system, l->setup.options, l->arguments->more, &l->limit);
  if (status != HOOKE_OK) return cli_report_status(l->arguments, status);
  cli_watch_start(&watch, l->arguments);
  hooke_limit_on_progress(l->limit, cli_watch_progress, &watch);
  status =
      l->along ? hooke_limit_along(l->limit, l->setup.state) : hooke_limit_find(l->limit, l->setup.state);
  cli_watch_end(&watch);
  l->interrupted = status == HOOKE_STOPPED;
  l->diverged = status > 0 && !l->interrupted;
  return status >= 0 ? HOOKE_EXIT_DONE : cli_report_status(l->arguments, status);
}

static const char *title_of(const struct limit *l) {
  const char *title = hooke_scene_title(l->setup.scene);
  return title && title[0] ? title : l->arguments->scene;
}

/* ---- JSON ---- */

static double number_of(const struct limit *l, int64_t row, const char *what) {
  return hooke_limit_number(l->limit, row, what);
}

static void print_row_json(struct cli_json *json, const struct limit *l, int64_t row) {
  static const char *const numbers[] = {"bound", "predicted", "measured", "ratio", "steps_run"};
  cli_json_open(json, NULL, '{');
  cli_json_text(json, "method", hooke_limit_text(l->limit, row, "method"));
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    cli_json_number(json, numbers[k], number_of(l, row, numbers[k]));
  cli_json_flag(json, "never_stable", number_of(l, row, "never_stable") == 1.0);
  cli_json_flag(json, "exact", number_of(l, row, "exact") == 1.0);
  if (l->along) {
    cli_json_number(json, "smallest", number_of(l, row, "smallest"));
    cli_json_number(json, "smallest_time", number_of(l, row, "smallest_time"));
  }
  cli_json_text(json, "note", hooke_limit_text(l->limit, row, "note"));
  cli_json_close(json);
}

static void print_remedy_json(struct cli_json *json, const hooke_limit *limit) {
  static const char *const numbers[] = {"springs", "particles", "cost", "factor", "gain", "gain_predicted"};
  if (!hooke_limit_remedy_text(limit, "sentence")) {
    cli_json_text(json, "remedy", NULL);
    return;
  }
  cli_json_open(json, "remedy", '{');
  cli_json_text(json, "kind", hooke_limit_remedy_text(limit, "kind"));
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    cli_json_number(json, numbers[k], hooke_limit_remedy_number(limit, numbers[k]));
  cli_json_text(json, "sentence", hooke_limit_remedy_text(limit, "sentence"));
  cli_json_close(json);
}

static void print_json(const struct limit *l) {
  const hooke_limit *limit = l->limit;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_number(&json, "time", hooke_state_time(l->setup.state));
  cli_json_number(&json, "frequency_max", hooke_limit_figure(limit, "frequency_max"));
  cli_json_number(&json, "rate_max", hooke_limit_figure(limit, "rate_max"));
  cli_json_number(&json, "clamped", hooke_limit_figure(limit, "clamped"));
  cli_json_open(&json, "rows", '[');
  for (int64_t row = 0; row < hooke_limit_row_count(limit); row++)
    print_row_json(&json, l, row);
  cli_json_close(&json);
  cli_json_open(&json, "blame", '[');
  for (int64_t k = 0; k < hooke_limit_blame_count(limit); k++) {
    cli_blame_json(&json, hooke_limit_blame_text(limit, k, "force"),
                   hooke_limit_blame_number(limit, k, "first"), hooke_limit_blame_number(limit, k, "second"),
                   hooke_limit_blame_text(limit, k, "group"), hooke_limit_blame_number(limit, k, "share"));
  }
  cli_json_close(&json);
  print_remedy_json(&json, limit);
  cli_json_end(&json);
}

/* ---- words ---- */

static const struct column {
  const char *what, *head, *unit;
  int32_t width, along; /* 1: along a run alone; -1: at one state alone */
} columns[] = {{"bound", "safe bound", "[s]", 12, 0},     {"predicted", "predicted", "[s]", 12, 0},
               {"measured", "measured", "[s]", 12, -1},   {"ratio", "measured /", "predicted", 10, -1},
               {"steps_run", "steps", "run", 10, -1},     {"smallest", "smallest", "met [s]", 12, 1},
               {"smallest_time", "at time", "[s]", 10, 1}};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

static int32_t is_shown(const struct limit *l, int k) {
  const int32_t measured = hooke_options_number(l->arguments->more, "predict") == 0.0;
  return columns[k].along == 0 || (columns[k].along > 0 ? l->along : !l->along && measured);
}

static void print_cell(const struct limit *l, int64_t row, const struct column *column) {
  const double value = number_of(l, row, column->what);
  const int32_t counts = strcmp(column->what, "steps_run") == 0;
  char cell[HOOKE_NUMBER_SIZE] = "-";
  if (isinf(value)) snprintf(cell, sizeof cell, "none");
  if (isfinite(value)) snprintf(cell, sizeof cell, counts ? "%.0f" : "%.6g", value);
  if (value == 0.0 && !counts && strcmp(column->what, "smallest_time") != 0)
    snprintf(cell, sizeof cell, "no step");
  printf(" %*s", column->width, cell);
}

static void print_table(const struct limit *l, int32_t width) {
  for (int line = 0; line < 2; line++) {
    printf("%-*s", width, line ? "" : "method");
    for (int k = 0; k < COLUMN_COUNT; k++) {
      if (is_shown(l, k)) printf(" %*s", columns[k].width, line ? columns[k].unit : columns[k].head);
    }
    printf("\n");
  }
  for (int64_t row = 0; row < hooke_limit_row_count(l->limit); row++) {
    printf("%-*s", width, hooke_limit_text(l->limit, row, "method"));
    for (int k = 0; k < COLUMN_COUNT; k++) {
      if (is_shown(l, k)) print_cell(l, row, &columns[k]);
    }
    printf("\n");
  }
}

static void print_notes(const struct limit *l, int32_t width) {
  int32_t any = 0;
  for (int64_t row = 0; row < hooke_limit_row_count(l->limit); row++) {
    const char *note = hooke_limit_text(l->limit, row, "note");
    if (!note[0]) continue;
    if (!any) printf("\n");
    any = 1;
    printf("%-*s  ", width, hooke_limit_text(l->limit, row, "method"));
    cli_print_wrapped(stdout, width + 2, width + 2, WIDTH, note);
  }
}

static void print_blame(const hooke_limit *limit) {
  const int64_t count = hooke_limit_blame_count(limit);
  const char *sentence = hooke_limit_remedy_text(limit, "sentence");
  for (int64_t k = 0; k < count && k < MOST_SPRINGS; k++) {
    const char *group = hooke_limit_blame_text(limit, k, "group"),
               *force = hooke_limit_blame_text(limit, k, "force");
    if (force[0]) {
      printf("\n%-*s%5.1f %%  %s\n", INDENT, "blame", 100.0 * hooke_limit_blame_number(limit, k, "share"),
             force);
      continue;
    }
    printf("%s%-*s%5.1f %%  spring %.0f, between particles %.0f and %.0f", k ? "" : "\n", INDENT,
           k ? "" : "blame", 100.0 * hooke_limit_blame_number(limit, k, "share"),
           hooke_limit_blame_number(limit, k, "spring"), hooke_limit_blame_number(limit, k, "first"),
           hooke_limit_blame_number(limit, k, "second"));
    if (group && group[0]) {
      printf(", group ");
      cli_print_text(stdout, group);
    }
    printf("\n");
  }
  if (count > MOST_SPRINGS) printf("%-*sand others with less\n", INDENT, "");
  if (!sentence) return;
  printf("%-*s", INDENT, "remedy");
  cli_print_wrapped(stdout, INDENT, INDENT, WIDTH, sentence);
}

static void print_words(const struct limit *l) {
  const hooke_limit *limit = l->limit;
  char text[HOOKE_NUMBER_SIZE];
  int32_t width = 0;
  for (int64_t row = 0; row < hooke_limit_row_count(limit); row++) {
    const int32_t length = (int32_t)strlen(hooke_limit_text(limit, row, "method"));
    if (length > width) width = length;
  }
  cli_print_text(stdout, title_of(l));
  printf(", at t = %s s\n", cli_format_rounded(hooke_state_time(l->setup.state), text));
  printf("fastest motion %.6g rad/s, fastest damping %.6g 1/s\n", hooke_limit_figure(limit, "frequency_max"),
         hooke_limit_figure(limit, "rate_max"));
  const double clamped = hooke_limit_figure(limit, "clamped");
  if (clamped > 0.0) {
    printf("%.0f %s compressed: what pushes %s sideways is growth by physics, and left out\n", clamped,
           clamped == 1.0 ? "spring is" : "springs are", clamped == 1.0 ? "its ends" : "their ends");
  }
  printf("\n");
  print_table(l, width);
  print_notes(l, width);
  print_blame(limit);
}

static int tell(const struct limit *l) {
  if (l->arguments->json)
    print_json(l);
  else
    print_words(l);
  cli_print_flush();
  if (l->interrupted) {
    cli_report_words(l->arguments, "interrupted; kept: what was found so far");
    return HOOKE_EXIT_INTERRUPTED;
  }
  if (!l->diverged) return HOOKE_EXIT_DONE;
  cli_report_words(l->arguments, "the run ended early, at t = %g s: %s", hooke_state_time(l->setup.state),
                   hooke_last_error());
  return HOOKE_EXIT_DIVERGED;
}

/* The exit code of the limit, or that of a report that could not be written. */
static int write_report(const struct limit *l, const char *report, int code) {
  if (!report || isnan(hooke_limit_figure(l->limit, "frequency_max"))) return code;
  const int32_t status = hooke_limit_write_report(l->limit, l->setup.state, report, title_of(l));
  if (status == HOOKE_OK) return code;
  cli_report_words(l->arguments, "%s", hooke_last_error());
  return cli_exit_code(status);
}

static int do_limit(const struct cli_arguments *arguments) {
  struct limit l = {.arguments = arguments, .along = cli_arguments_text(arguments, "along") != NULL};
  const char *at = cli_arguments_text(arguments, "at");
  const char *report = cli_arguments_text(arguments, "report");
  int code = check_names(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_output_file_check_report(arguments, report);
  if (code != HOOKE_EXIT_DONE) return code;
  code = cli_setup_load(arguments, &l.setup);
  if (code == HOOKE_EXIT_DONE && at) code = read_state(&l, at);
  if (code == HOOKE_EXIT_DONE) code = check_needs(&l);
  if (code == HOOKE_EXIT_DONE) code = find(&l);
  if (code == HOOKE_EXIT_DONE) code = write_report(&l, report, tell(&l));
  hooke_limit_destroy(l.limit);
  cli_setup_destroy(&l.setup);
  return code;
}

static const struct cli_verb_row own_rows[] = {
    {"at", 0, "FILE:FRAME",
     "at a frame of a trajectory, the last one if FRAME is left out; else at the start"},
    {"along", 0, NULL, "at every frame of the run: the smallest limit met and when, predicted alone"},
    {"report", 0, "FILE.html",
     "writes regions of stability, limiting mode, table and remedy as one page to read offline, replacing "
     "it"},
};

const struct cli_verb cli_verb_limit = {
    .name = "limit",
    .summary = "the largest stable step of each method, predicted and measured, and what it hangs on",
    .text =
        "Predicts the largest stable step of each fixed-step method from the eigenvalues of the scene, "
        "frozen "
        "at its positions and at rest, then measures it by running the method. Says which springs carry "
        "the motion that limits --method, and what it would buy to change them. Safe bound: a step that is "
        "certain to be stable, from one pass over the springs.",
    .example = "hooke limit cloth.json --predict",
    HOOKE_VERB_ROWS(own_rows),
    .options = "limit",
    .without = "checkpoint",
    .function = do_limit,
};
