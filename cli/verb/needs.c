/* hooke needs: the ingredients that a scene needs for a wanted accuracy, and a lean scene without the rest.
 */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 110, LABEL = 14 };

/* ---- the table ---- */

enum { TITLE = 24 };

/* With the unit of errors. */
static const char *title(const hooke_measurement *needs, const char *format, char text[TITLE]) {
  text[0] = '\0';
  cli_append(text, TITLE, format, hooke_measurement_text(needs, "needs", 0, "error_unit"));
  return text;
}

static void print_head(const hooke_measurement *needs, int32_t width) {
  printf("%-*s %10s %12s %10s %10s %10s\n", width, "without", "change", "evaluations", "ns a", "wall time",
         "largest");
  char unit[TITLE];
  printf("%-*s %10s %12s %10s %10s %10s\n", width, "", title(needs, "[%s]", unit), "of forces", "step", "[s]",
         "step [s]");
}

static double number(const hooke_measurement *needs, const char *table, int64_t row, const char *what) {
  return hooke_measurement_number(needs, table, row, what);
}

static void print_costs(const hooke_measurement *needs, const char *table, int64_t row) {
  const double wall = number(needs, table, row, "wall_seconds"), steps = number(needs, table, row, "steps");
  printf(" %12.0f", number(needs, table, row, "force_evaluations"));
  cli_rows_print_cell(10, steps > 0.0 ? 1e9 * wall / steps : (double)NAN);
  cli_rows_print_cell(10, wall);
  cli_rows_print_as(10, number(needs, table, row, "step_limit"), "%.4g", "none", NULL);
}

static void print_row(const hooke_measurement *needs, int64_t row, int32_t width) {
  const char *note = hooke_measurement_text(needs, "rows", row, "note");
  const double error = number(needs, "rows", row, "error"), needed = number(needs, "rows", row, "needed");
  cli_print_padded(stdout, width, hooke_measurement_text(needs, "rows", row, "without"));
  if (isnan(error)) {
    printf("  needed: ");
    cli_print_wrapped(stdout, width + LABEL, width + LABEL, WIDTH, note);
    return;
  }
  cli_rows_print_cell(10, error);
  print_costs(needs, "rows", row);
  const char *verdict = isnan(needed) ? "not known" : needed == 1.0 ? "needed" : "-";
  cli_say("  %s%s%s%s\n", verdict, note[0] ? "; " : "", note,
          number(needs, "rows", row, "timed_alone") == 0.0 ? "; timed beside others" : "");
}

static void print_table(const hooke_measurement *needs) {
  static const char full[] = "nothing (the full scene)";
  const int32_t width = cli_rows_width(needs, "rows", "without", strlen(full));
  print_head(needs, width);
  printf("%-*s %10s", width, full, "");
  print_costs(needs, "full", 0);
  printf("\n");
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++)
    print_row(needs, row, width);
}

/* ---- by degree ---- */

static void print_degrees(const hooke_measurement *needs) {
  const int32_t width = cli_rows_width(needs, "degrees", "quantity", strlen("by degree"));
  const int64_t rows = hooke_measurement_row_count(needs, "degrees");
  char unit[TITLE];
  if (rows == 0) return;
  printf("\n%-*s %10s %10s %10s %10s\n", width, "by degree", "factor", "change", "largest", "work");
  printf("%-*s %10s %10s %10s\n", width, "", "", title(needs, "[%s]", unit), "step [s]");
  for (int64_t row = 0; row < rows; row++) {
    const double beyond = number(needs, "degrees", row, "beyond");
    cli_print_padded(stdout, width, hooke_measurement_text(needs, "degrees", row, "quantity"));
    if (number(needs, "degrees", row, "tried") == 0.0) {
      printf("  not tried\n");
      continue;
    }
    cli_rows_print_cell(10, number(needs, "degrees", row, "factor"));
    cli_rows_print_cell(10, number(needs, "degrees", row, "error"));
    cli_rows_print_as(10, number(needs, "degrees", row, "step_limit"), "%.4g", "none", NULL);
    cli_rows_print_cell(10, number(needs, "degrees", row, "work"));
    if (!isnan(beyond)) {
      printf("  by %.4g:", beyond);
      cli_rows_print_as(0, number(needs, "degrees", row, "error_beyond"), title(needs, "%%.3g %s", unit),
                        "none", NULL);
    }
    printf("\n");
  }
}

/* ---- resolutions ---- */

static void print_cells(const hooke_measurement *needs, int64_t part, const char *const numbers[3]) {
  char text[64] = "";
  for (int a = 0; a < 3; a++) {
    const double cells = number(needs, "parts", part, numbers[a]);
    if (!isnan(cells)) cli_append(text, sizeof text, "%s%.0f", text[0] ? " x " : "", cells);
  }
  printf(" %14s", text[0] ? text : "-");
}

static void print_parts(const hooke_measurement *needs) {
  static const char *const has[] = {"cells", "cells_second", "cells_third"};
  static const char *const wanted[] = {"wanted", "wanted_second", "wanted_third"};
  static const char *const numbers[] = {"change", "change_fine", "order", "error"};
  const int32_t width = cli_rows_width(needs, "parts", "part", strlen("part"));
  char head[3][TITLE];
  printf("%-*s %14s %12s %12s %8s %12s %14s\n", width, "part", "cells N",
         title(needs, "N to 2N [%s]", head[0]), title(needs, "2N to 4N [%s]", head[1]), "order",
         title(needs, "left [%s]", head[2]), "want asks for");
  for (int64_t part = 0; part < hooke_measurement_row_count(needs, "parts"); part++) {
    const char *note = hooke_measurement_text(needs, "parts", part, "note");
    cli_print_padded(stdout, width, hooke_measurement_text(needs, "parts", part, "part"));
    print_cells(needs, part, has);
    for (int k = 0; k < 4; k++)
      cli_rows_print_cell(k == 2 ? 8 : 12, number(needs, "parts", part, numbers[k]));
    print_cells(needs, part, wanted);
    printf("\n");
    if (note[0]) {
      printf("%*s", width + 1, "");
      cli_print_wrapped(stdout, width + 1, width + 1, WIDTH, note);
    }
  }
}

static void print_words(const struct cli_results *results) {
  const hooke_measurement *needs = results->found;
  const double spread = cli_number(needs, "needs", "spread");
  const char *want = cli_arguments_text(results->arguments, "want");
  cli_say("%s, ", cli_setup_title(results->arguments, &results->setup));
  if (strcmp(hooke_measurement_text(needs, "needs", 0, "error_unit"), "m") != 0)
    cli_say("%s wanted\n", want);
  else
    cli_say("%g m wanted\n", cli_number(needs, "needs", "want"));
  cli_claims_print(results->arguments, needs, LABEL, results->command);
  if (isnan(cli_number(needs, "full", "step_error"))) return;
  printf("\n");
  if (cli_arguments_asks(results->arguments, "refine")) {
    print_parts(needs);
    return;
  }
  print_table(needs);
  print_degrees(needs);
  printf("\nchange: the largest distance of a watched position at any time; wall time: the least of equal "
         "runs, which take up to\n%.0f %% longer\n",
         100.0 * (spread - 1.0));
  if (cli_claim(needs, "saving") && !results->command) printf("-o LEAN.json writes the lean scene\n");
}

/* ---- the verb ---- */

static int check(const struct cli_arguments *arguments) {
  const char *output = cli_arguments_text(arguments, "output");
  if (!cli_arguments_text(arguments, "want")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "no want: give the error that you can live with, such as --want 1mm");
  }
  if (output && cli_arguments_asks(arguments, "refine")) {
    return cli_report(
        arguments, HOOKE_EXIT_USAGE,
        "-o and --refine: a lean scene is written from the table of ingredients; leave one out");
  }
  if (output && cli_arguments_text(arguments, "force"))
    return cli_report(arguments, HOOKE_EXIT_USAGE, "no scene holds the force of --force; leave out -o %s",
                      output);
  return HOOKE_EXIT_DONE;
}

static int require(struct cli_results *results) {
  return cli_setup_require(results->arguments, &results->setup, NULL);
}

/* ---- the lean scene ---- */

static int write_lean(struct cli_results *results) {
  const char *output = cli_arguments_text(results->arguments, "output");
  const hooke_system *lean = hooke_needs_lean(results->found);
  if (!output || !lean) return HOOKE_EXIT_DONE;
  const int32_t status = hooke_scene_write(output, lean, hooke_scene_text(results->setup.scene, "title"),
                                           hooke_needs_lean_run(results->found));
  if (status != HOOKE_OK) {
    cli_report_words(results->arguments, "%s", hooke_last_error());
    return cli_exit_code(status);
  }
  struct cli_string command = {.bytes = NULL};
  cli_string_add(&command, "hooke run ");
  cli_string_quote(&command, output);
  results->command = command.bytes;
  int32_t made = command.status;
  if (made == HOOKE_OK) made = hooke_measurement_label(results->found, "command", results->command);
  if (made == HOOKE_OK) made = hooke_measurement_label(results->found, "output", output);
  return made == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_missing_words(results->arguments);
}

/* Results are printed also when a file fails. */
static int tell(struct cli_results *results) {
  int code = write_lean(results);
  if (results->arguments->json && cli_claims_print_json(results->arguments, NULL, results->found) != HOOKE_OK)
    code = cli_report_missing_words(results->arguments);
  if (!results->arguments->json) print_words(results);
  cli_print_flush();
  code = cli_setup_write_report(results->arguments, &results->setup, results->found, code);
  if (results->outcome != HOOKE_STOPPED) return code;
  cli_report_words(results->arguments, "%s; kept: what is known so far", cli_force_stop());
  return code == HOOKE_EXIT_DONE ? cli_exit_code(HOOKE_STOPPED) : code;
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "LEAN.json", "writes the lean scene, replacing it"},
    {"report", 0, "FILE.html", "writes table and pictures as one page to read offline, replacing it"},
    HOOKE_FROM_REST,
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_needs = {
    .name = "needs",
    .summary = "what a scene needs for a wanted accuracy, and a lean scene without the rest",
    .text = "Leaves out one ingredient after another (spring groups and families, damping, drag, gravity, "
            "idle springs, what touches nothing, resistance to compression, the deformation of parts, which "
            "become rigid bodies, half the resolution), runs each variant with errors of the time step a "
            "tenth of --want, and prints by how much the watched positions change and what it saves. Then "
            "leaves out together what is not needed, checks the lean scene against the full one, and "
            "compares what each takes at its cheapest within --want. Ctrl-C prints what is known so far.",
    .example = "hooke needs cloth.json --want 1cm -o lean.json",
    HOOKE_VERB_ROWS(own_rows),
    .options = "needs",
    .without = "step checkpoint",
    .check = check,
    .ready = require,
    .tell = tell,
};
