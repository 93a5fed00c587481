/* hooke compare: a scene by several methods, each against CVODE at tight tolerance. */
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLUMNS = 5, MOST_METHODS = 32, CELL_SIZE = 24, MESSAGE_SIZE = 2048 };

struct compare {
  const struct hooke_arguments *arguments;
  const char *method[MOST_METHODS]; /* to be compared, no two alike */
  int64_t method_count;
  struct hooke_setup setup;
  hooke_comparison *comparison;
  hooke_comparison_file *file; /* NULL without -o */
  const char *output;
  struct hooke_watch watch;
};

/* ---- which methods ---- */

/* The library's own copy of the name that `word` begins with, up to `length`; NULL if there is no such
 * method. */
static const char *find_method(const char *word, size_t length) {
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    if (strlen(name) == length && strncmp(name, word, length) == 0) return name;
  }
  return NULL;
}

static int add_method(struct compare *compare, const char *name) {
  if (!hooke_method_is_built(name)) {
    return hooke_report(compare->arguments, HOOKE_EXIT_NOT_BUILT,
                        "%s is not in this build of hooke; 'hooke --version' says what it was built with",
                        name);
  }
  for (int64_t i = 0; i < compare->method_count; i++) {
    if (compare->method[i] == name) {
      return hooke_report(compare->arguments, HOOKE_EXIT_USAGE, "--methods: %s is named twice", name);
    }
  }
  if (compare->method_count < MOST_METHODS) compare->method[compare->method_count++] = name;
  return HOOKE_EXIT_DONE;
}

/* The methods of --methods a,b,c, else every method that this build has. */
static int choose_methods(struct compare *compare) {
  const char *word = hooke_arguments_text(compare->arguments, "methods");
  if (!word) {
    for (int64_t i = 0; i < hooke_method_count() && i < MOST_METHODS; i++) {
      const char *name = hooke_method_name(i);
      if (hooke_method_is_built(name)) compare->method[compare->method_count++] = name;
    }
    return HOOKE_EXIT_DONE;
  }
  for (;;) {
    size_t length = strcspn(word, ",");
    const char *name = find_method(word, length);
    int code = name ? add_method(compare, name)
                    : hooke_report_unknown_method(compare->arguments, "methods", word, length);
    if (code != HOOKE_EXIT_DONE || !word[length]) return code;
    word += length + 1;
  }
}

/* ---- running ---- */

static int32_t see_progress(double done, const char *what, void *ctx) {
  struct compare *compare = ctx;
  return hooke_watch_tell(&compare->watch, done, what);
}

static int32_t prepare(struct compare *compare) {
  int32_t status =
      hooke_comparison_create(compare->setup.system, compare->setup.options, &compare->comparison);
  for (int64_t i = 0; status == HOOKE_OK && i < compare->method_count; i++) {
    status = hooke_comparison_add(compare->comparison, compare->method[i]);
  }
  if (status != HOOKE_OK) return status;
  hooke_comparison_on_progress(compare->comparison, see_progress, compare);
  if (!compare->output) return HOOKE_OK;
  return hooke_comparison_file_create(compare->output, compare->setup.system, compare->comparison,
                                      hooke_scene_text(compare->setup.scene), &compare->file);
}

/* Runs and puts the file away. A failure is reported and comes back as exit code; so does an interruption,
 * which is not reported yet. */
static int run_all(struct compare *compare) {
  char message[MESSAGE_SIZE];
  hooke_watch_start(&compare->watch, compare->arguments);
  int32_t status = prepare(compare);
  if (status != HOOKE_OK) return hooke_report_status(compare->arguments, status);
  int32_t outcome = hooke_comparison_run(compare->comparison);
  hooke_watch_end(&compare->watch);
  snprintf(message, sizeof message, "%s", hooke_last_error());
  status = hooke_comparison_file_close(compare->file);
  compare->file = NULL;
  /* a file that fails stops the comparison; its own message says more */
  if (status != HOOKE_OK && outcome >= 0) return hooke_report_status(compare->arguments, status);
  if (outcome == HOOKE_STOPPED && hooke_watch_interrupted()) return HOOKE_EXIT_INTERRUPTED;
  if (outcome == HOOKE_OK) return HOOKE_EXIT_DONE;
  return hooke_report(compare->arguments, hooke_exit_code(outcome), "the reference: %s", message);
}

/* ---- results ---- */

/* Rows that were run, if only in part: an interruption leaves the others out. */
static int64_t rows_done(const hooke_comparison *comparison) {
  int64_t rows = 0;
  while (rows < hooke_comparison_row_count(comparison) &&
         !isnan(hooke_comparison_number(comparison, rows, "wall_seconds"))) {
    rows++;
  }
  return rows;
}

static void print_json(const struct compare *compare) {
  static const char *const numbers[] = {
      "step",  "rtol",        "error", "error_max", "error_final", "energy_drift", "force_evaluations",
      "steps", "wall_seconds"};
  const hooke_comparison *comparison = compare->comparison;
  struct hooke_json json;
  hooke_json_begin(&json, stdout);
  hooke_json_text(&json, "scene", compare->arguments->scene);
  hooke_json_number(&json, "duration", hooke_options_number(compare->setup.options, "duration"));
  hooke_json_open(&json, "reference", '{');
  hooke_json_open(&json, "methods", '[');
  hooke_json_text(&json, NULL, hooke_comparison_reference(comparison));
  hooke_json_close(&json);
  /* one reference, unchecked by a second: these do not apply */
  hooke_json_number(&json, "agreement", (double)NAN);
  hooke_json_number(&json, "trusted_until", (double)NAN);
  hooke_json_close(&json);
  hooke_json_open(&json, "rows", '[');
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    hooke_json_open(&json, NULL, '{');
    hooke_json_text(&json, "method", hooke_comparison_text(comparison, row, "method"));
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
      hooke_json_number(&json, numbers[i], hooke_comparison_number(comparison, row, numbers[i]));
    }
    hooke_json_text(&json, "status", hooke_comparison_text(comparison, row, "status"));
    hooke_json_close(&json);
  }
  hooke_json_end(&json);
}

/* A number in `width` columns to 4 digits, "-" where there is none. */
static void print_cell(int width, double value) {
  char cell[CELL_SIZE] = "-";
  if (!isnan(value)) snprintf(cell, sizeof cell, "%.4g", value);
  printf(" %*s", width, cell);
}

static int method_width(const hooke_comparison *comparison) {
  size_t width = strlen("method");
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    size_t length = strlen(hooke_comparison_text(comparison, row, "method"));
    if (length > width) width = length;
  }
  return (int)width;
}

/* Error over time at a few frames, evenly spaced, the last one included. */
static void print_errors(const hooke_comparison *comparison, int width) {
  int64_t last = hooke_comparison_frame_count(comparison) - 1;
  int64_t frames = last < COLUMNS ? last : COLUMNS;
  printf("error [m]: root mean square over free particles of the distance to the reference\n%-*s", width,
         "at t [s] =");
  for (int64_t i = 1; i <= frames; i++)
    print_cell(10, hooke_comparison_series(comparison, 0, "time")[last * i / frames]);
  printf("\n");
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    const double *error = hooke_comparison_series(comparison, row, "error");
    printf("%-*s", width, hooke_comparison_text(comparison, row, "method"));
    for (int64_t i = 1; i <= frames; i++)
      print_cell(10, error ? error[last * i / frames] : (double)NAN);
    printf("\n");
  }
}

static void print_rows(const hooke_comparison *comparison, int width) {
  static const struct {
    const char *what, *head, *unit;
    int width;
  } columns[] = {{"step", "step", "[s]", 9},
                 {"rtol", "rtol", "", 9},
                 {"error", "error", "max [m]", 10},
                 {"error_final", "error", "end [m]", 10},
                 {"error_max", "farthest", "particle [m]", 12},
                 {"energy_drift", "energy", "drift [J]", 10},
                 {"steps", "steps", "", 9},
                 {"force_evaluations", "force", "evaluations", 11},
                 {"wall_seconds", "wall time", "[s]", 10}};
  enum { COUNT = sizeof columns / sizeof columns[0] };
  printf("\n%-*s", width, "method");
  for (int i = 0; i < COUNT; i++)
    printf(" %*s", columns[i].width, columns[i].head);
  printf("\n%-*s", width, "");
  for (int i = 0; i < COUNT; i++)
    printf(" %*s", columns[i].width, columns[i].unit);
  printf("\n");
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    printf("%-*s", width, hooke_comparison_text(comparison, row, "method"));
    for (int i = 0; i < COUNT; i++) {
      double value = hooke_comparison_number(comparison, row, columns[i].what);
      if (i == 6 || i == 7) {
        printf(" %*.0f", columns[i].width, value);
      } else {
        print_cell(columns[i].width, value);
      }
    }
    printf("  %s\n", hooke_comparison_text(comparison, row, "status"));
  }
}

static void print_words(const struct compare *compare) {
  const char *title = hooke_scene_title(compare->setup.scene);
  int width = method_width(compare->comparison);
  char text[HOOKE_NUMBER_SIZE];
  hooke_print_text(stdout, title && title[0] ? title : compare->arguments->scene);
  printf(", %s s\n", hooke_format_number(hooke_options_number(compare->setup.options, "duration"), text));
  printf("reference: %s at tight tolerance\n\n", hooke_comparison_reference(compare->comparison));
  if (rows_done(compare->comparison) > 0) {
    print_errors(compare->comparison, width > 10 ? width : 10);
    print_rows(compare->comparison, width > 10 ? width : 10);
  }
  if (compare->output) {
    printf("\noutput: ");
    hooke_print_text(stdout, compare->output);
    printf("\n");
  }
}

static int compare_and_tell(struct compare *compare) {
  int code = run_all(compare);
  if (code != HOOKE_EXIT_DONE && code != HOOKE_EXIT_INTERRUPTED) return code;
  if (compare->arguments->json) {
    print_json(compare);
  } else {
    print_words(compare);
  }
  fflush(stdout);
  if (code == HOOKE_EXIT_INTERRUPTED) {
    hooke_report_words(compare->arguments, "interrupted; the rows done so far are kept%s%s",
                       compare->output ? " in " : "", compare->output ? compare->output : "");
  }
  return code;
}

/* What every method of the comparison needs, asked for before anything runs. */
static int require_all(const struct compare *compare) {
  for (int64_t i = 0; i < compare->method_count; i++) {
    int code = hooke_setup_require(compare->arguments, &compare->setup, compare->method[i]);
    if (code != HOOKE_EXIT_DONE) return code;
  }
  return HOOKE_EXIT_DONE;
}

static int do_compare(const struct hooke_arguments *arguments) {
  struct compare compare = {.arguments = arguments, .output = hooke_arguments_text(arguments, "output")};
  int code = choose_methods(&compare);
  if (code == HOOKE_EXIT_DONE) code = hooke_setup_check_output(arguments, compare.output);
  if (code != HOOKE_EXIT_DONE) return code;
  code = hooke_setup_load(arguments, &compare.setup);
  if (code == HOOKE_EXIT_DONE) code = require_all(&compare);
  if (code == HOOKE_EXIT_DONE) code = compare_and_tell(&compare);
  hooke_comparison_destroy(compare.comparison);
  hooke_setup_destroy(&compare.setup);
  return code;
}

static const struct hooke_verb_row rows[] = {
    {"methods", 'm', "A,B,...", "the methods to compare; default: all that this build has"},
    {"output", 'o', "FILE",
     "writes every run, the table and the error over time to FILE (HDF5), replacing it"},
};

const struct hooke_verb hooke_verb_compare = {
    .name = "compare",
    .summary = "the scene by each method against CVODE at tight tolerance",
    .text = "Runs the scene by each method and by CVODE at tight tolerance, and prints how far each method "
            "is from that "
            "reference over time, how far its energy drifts, and what it costs. A method that diverges stays "
            "as a row. "
            "Tables are rounded; --json has every digit.",
    HOOKE_VERB_ROWS(rows),
    .without = "method",
    .function = do_compare,
};
