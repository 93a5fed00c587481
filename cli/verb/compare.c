/* hooke compare: a scene by several methods, each against a reference that checks itself. */
#include "methods.h"
#include "print.h"
#include "report.h"
#include "rows.h"
#include "setup.h"
#include "table.h"
#include "watch.h"

#include <math.h>
#include <stdio.h>

enum { COLUMNS = 5, MESSAGE_SIZE = 2048 };

struct compare {
  const struct cli_arguments *arguments;
  struct cli_methods methods;
  struct cli_setup setup;
  hooke_measurement *comparison;
  hooke_comparison_file *file; /* NULL without -o */
  const char *output;
};

/* ---- running ---- */

/* The options with the methods in their order. */
static int32_t make_options(const struct cli_methods *methods, hooke_options **options) {
  char names[HOOKE_MOST_METHODS * 32] = "";
  for (int32_t k = 0; k < methods->count; k++)
    cli_append(names, sizeof names, "%s%s", k ? "," : "", methods->name[k]);
  const int32_t status = hooke_options_create("comparison", options);
  return status == HOOKE_OK ? hooke_options_set_text(*options, "methods", names) : status;
}

static int32_t prepare(struct compare *compare) {
  const struct cli_setup *setup = &compare->setup;
  hooke_options *options = NULL;
  int32_t status = make_options(&compare->methods, &options);
  if (status == HOOKE_OK)
    status =
        hooke_measurement_create("comparison", setup->system, setup->options, options, &compare->comparison);
  hooke_options_destroy(options);
  if (status != HOOKE_OK) return status;
  if (!compare->output) return HOOKE_OK;
  status = hooke_measurement_label(compare->comparison, "scene", hooke_scene_text(setup->scene, "text"));
  if (status != HOOKE_OK) return status;
  return hooke_comparison_file_create(compare->output, compare->comparison, &compare->file);
}

/* Runs and closes the file. A failure is reported and returned as exit code; so is an interruption, which is
 * not reported yet. */
static int run_all(struct compare *compare) {
  char message[MESSAGE_SIZE];
  struct cli_watch watch;
  cli_watch_start(&watch, compare->arguments); /* before there is a file */
  int32_t status = prepare(compare);
  if (status != HOOKE_OK) return cli_report_status(compare->arguments, status);
  int32_t outcome = cli_watch_run(compare->arguments, compare->comparison, NULL);
  snprintf(message, sizeof message, "%s", hooke_last_error());
  status = hooke_comparison_file_close(compare->file);
  compare->file = NULL;
  /* a failed file stops the comparison; its own message says more */
  if (status != HOOKE_OK && outcome >= 0) return cli_report_status(compare->arguments, status);
  if (outcome == HOOKE_STOPPED && cli_watch_interrupted()) return HOOKE_EXIT_INTERRUPTED;
  if (outcome == HOOKE_OK) return HOOKE_EXIT_DONE;
  return cli_report(compare->arguments, cli_exit_code(outcome), "the reference: %s", message);
}

/* ---- results ---- */

/* Rows that were run, at least in part: an interruption omits the others. */
static int64_t rows_done(const hooke_measurement *comparison) {
  int64_t rows = 0;
  while (!isnan(hooke_measurement_number(comparison, "rows", rows, "wall_seconds")))
    rows++;
  return rows;
}

static const char *reference_of(const struct compare *compare, const char *what) {
  return hooke_measurement_text(compare->comparison, "reference", 0, what);
}

static double reference_number(const struct compare *compare, const char *what) {
  return hooke_measurement_number(compare->comparison, "reference", 0, what);
}

static void print_json(const struct compare *compare) {
  const hooke_measurement *comparison = compare->comparison;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "scene", compare->arguments->scene);
  cli_table_print_row(&json, comparison, "comparison", 0);
  cli_json_open(&json, "reference", '{');
  cli_json_open(&json, "methods", '[');
  if (reference_of(compare, "method")) cli_json_text(&json, NULL, reference_of(compare, "method"));
  if (reference_of(compare, "check")) cli_json_text(&json, NULL, reference_of(compare, "check"));
  cli_json_close(&json);
  cli_json_number(&json, "agreement", reference_number(compare, "agreement"));
  cli_json_number(&json, "trusted_until", reference_number(compare, "trusted_until"));
  cli_json_close(&json);
  cli_json_open(&json, "rows", '[');
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    cli_json_open(&json, NULL, '{');
    cli_table_print_row(&json, comparison, "rows", row);
    cli_json_close(&json);
  }
  cli_json_close(&json);
  cli_json_end(&json);
}

/* Error over time at a few evenly spaced frames, including the last. */
static void print_errors(const hooke_measurement *comparison, int32_t width) {
  int64_t count;
  const double *time = hooke_measurement_series(comparison, "reference", 0, "time", &count);
  const int64_t last = count - 1, frames = last < COLUMNS ? last : COLUMNS;
  printf("error [m]: root mean square over free particles of the distance to the reference; wall time: of "
         "one run\n%-*s",
         width, "at t [s] =");
  for (int64_t i = 1; i <= frames; i++)
    cli_rows_print_cell(10, time[last * i / frames]);
  printf("\n");
  for (int64_t row = 0; row < rows_done(comparison); row++) {
    const double *error = hooke_measurement_series(comparison, "rows", row, "error_at", NULL);
    cli_print_padded(stdout, width, hooke_measurement_text(comparison, "rows", row, "method"));
    for (int64_t i = 1; i <= frames; i++)
      cli_rows_print_cell(10, error ? error[last * i / frames] : (double)NAN);
    printf("\n");
  }
}

/* The reference, and what is known by it. */
static void print_reference(const struct compare *compare) {
  const double agreement = reference_number(compare, "agreement");
  const double until = reference_number(compare, "trusted_until");
  char time[HOOKE_NUMBER_SIZE];
  if (isnan(until)) {
    printf("reference: not finished, so there is nothing to measure against\n\n");
    return;
  }
  cli_say("reference: %s at tight tolerance, checked by %s\n", reference_of(compare, "method"),
          reference_of(compare, "check"));
  cli_format_rounded(until, time);
  if (isnan(agreement))
    printf("WARNING: the two part before the first frame after the start, so no error is known\n");
  else if (until < hooke_options_number(compare->setup.options, "duration") * (1.0 - 1e-9))
    printf("agreement: %.3g m until they part after %s s; errors and energy drift are those up to then\n",
           agreement, time);
  else
    printf("agreement: %.3g m, up to the end\n", agreement);
  printf("\n");
}

static void print_words(const struct compare *compare) {
  const struct cli_rows rows = {.source = compare->comparison,
                                .count = rows_done(compare->comparison),
                                .columns = cli_rows_of_runs,
                                .status = 1};
  int32_t width = cli_rows_method_width(&rows);
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, %s s\n", cli_setup_title(compare->arguments, &compare->setup),
          cli_format_rounded(hooke_options_number(compare->setup.options, "duration"), text));
  print_reference(compare);
  if (rows.count > 0) {
    print_errors(compare->comparison, width);
    printf("\n");
    cli_rows_print(&rows, width);
  }
  if (compare->output) cli_say("\noutput: %s\n", compare->output);
}

static int compare_and_tell(struct compare *compare) {
  int code = run_all(compare);
  if (code != HOOKE_EXIT_DONE && code != HOOKE_EXIT_INTERRUPTED) return code;
  if (compare->arguments->json) {
    print_json(compare);
  } else {
    print_words(compare);
  }
  cli_print_flush();
  if (code == HOOKE_EXIT_INTERRUPTED) {
    cli_report_words(compare->arguments, "interrupted; the rows done so far are kept%s%s",
                     compare->output ? " in " : "", compare->output ? compare->output : "");
  }
  return code;
}

/* Checks the requirements of all methods before anything runs. */
static int require_all(const struct compare *compare) {
  for (int64_t i = 0; i < compare->methods.count; i++) {
    int code = cli_setup_require(compare->arguments, &compare->setup, compare->methods.name[i]);
    if (code != HOOKE_EXIT_DONE) return code;
  }
  return HOOKE_EXIT_DONE;
}

static int do_compare(const struct cli_arguments *arguments) {
  struct compare compare = {.arguments = arguments, .output = cli_arguments_text(arguments, "output")};
  int code = cli_methods_choose(arguments, &compare.methods);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_check_output(arguments, compare.output);
  if (code != HOOKE_EXIT_DONE) return code;
  code = cli_setup_load(arguments, &compare.setup);
  if (code == HOOKE_EXIT_DONE) code = require_all(&compare);
  if (code == HOOKE_EXIT_DONE) code = compare_and_tell(&compare);
  hooke_measurement_destroy(compare.comparison);
  cli_setup_destroy(&compare.setup);
  return code;
}

static const struct cli_verb_row own_rows[] = {
    {"methods", 'm', "A,B,...", "the methods to compare; default: all that this build has"},
    {"output", 'o', "FILE.h5",
     "writes every run, the table and the error over time to FILE.h5 (HDF5), replacing it"},
};

const struct cli_verb cli_verb_compare = {
    .name = "compare",
    .summary = "the scene by each method against a reference that checks itself",
    .text = "Runs the scene by each method and by two integrators at tight tolerances that check each other, "
            "and prints how far each method is from that reference over time, as long as the two agree, how "
            "far its energy drifts, and what it costs. A method that diverges stays as a row. "
            "Tables are rounded; --json has every digit.",
    .example = "hooke compare cloth.json --methods symplectic-euler,cvode-adams",
    HOOKE_VERB_ROWS(own_rows),
    .without = "method checkpoint",
    .function = do_compare,
};
