/* Needs of a scene, in words and as JSON. */
#include "needs_results.h"
#include "rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 110, LABEL = 10, TRUST_SIZE = 256 };

static double nanoseconds(double wall, double steps) {
  return steps > 0.0 ? 1e9 * wall / steps : (double)NAN;
}

/* ---- the table ---- */

static void print_head(int32_t width) {
  printf("%-*s %10s %12s %10s %10s %10s %10s\n", width, "without", "change", "evaluations", "ns a",
         "wall time", "largest", "");
  printf("%-*s %10s %12s %10s %10s %10s\n", width, "", "[m]", "of forces", "step", "[s]", "step [s]");
}

static void print_costs(double evaluations, double per_step, double wall, double limit) {
  printf(" %12.0f", evaluations);
  cli_rows_print_cell(10, per_step);
  cli_rows_print_cell(10, wall);
  cli_rows_print_as(10, limit, "%.4g", "none", NULL);
}

static void print_row(const hooke_measurement *needs, int64_t row, int32_t width) {
  const char *note = hooke_measurement_text(needs, "rows", row, "note");
  const double wall = hooke_measurement_number(needs, "rows", row, "wall_seconds");
  cli_print_padded(stdout, width, hooke_measurement_text(needs, "rows", row, "without"));
  if (isnan(hooke_measurement_number(needs, "rows", row, "error"))) {
    printf("  needed: ");
    cli_print_wrapped(stdout, width + LABEL, width + LABEL, WIDTH, note);
    return;
  }
  cli_rows_print_cell(10, hooke_measurement_number(needs, "rows", row, "error"));
  print_costs(hooke_measurement_number(needs, "rows", row, "force_evaluations"),
              nanoseconds(wall, hooke_measurement_number(needs, "rows", row, "steps")), wall,
              hooke_measurement_number(needs, "rows", row, "step_limit"));
  const double needed = hooke_measurement_number(needs, "rows", row, "needed");
  const char *verdict = isnan(needed) ? "not known" : needed == 1.0 ? "needed" : "-";
  cli_say("  %s%s%s\n", verdict, note[0] ? "; " : "", note);
}

static void print_table(const hooke_measurement *needs) {
  static const char full[] = "nothing (the full scene)";
  const int32_t width = cli_rows_width(needs, "rows", "without", strlen(full));
  const double wall = cli_number(needs, "full", "wall_seconds");
  print_head(width);
  printf("%-*s %10s", width, full, "");
  print_costs(cli_number(needs, "full", "force_evaluations"),
              nanoseconds(wall, cli_number(needs, "full", "steps")), wall,
              cli_number(needs, "full", "step_limit"));
  printf("\n");
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++)
    print_row(needs, row, width);
}

/* ---- the lean scene ---- */

static int32_t has_unknown(const hooke_measurement *needs) {
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    if (isnan(hooke_measurement_number(needs, "rows", row, "needed"))) return 1;
  }
  return 0;
}

/* Both within the wanted error, each at its cheapest. */
static void print_saving(const hooke_measurement *needs) {
  const double less = cli_number(needs, "lean", "times_less");
  const char *other = cli_text(needs, "lean", "other_method");
  char ratio[64], cheaper[160] = "";
  snprintf(ratio, sizeof ratio, less >= 1.0 ? "%.1f times less" : "%.1f times more",
           less >= 1.0 ? less : 1.0 / less);
  if (other)
    snprintf(cheaper, sizeof cheaper, "; %s would bring the full scene there in %.3g s", other,
             cli_number(needs, "lean", "other_seconds"));
  cli_print_fact(LABEL, WIDTH, "",
                 "left out together: error at most %.3g m, %.0f springs instead of %.0f; wall time %.3g s by "
                 "%s, where the full scene takes %.3g s to be within the want (%s)%s",
                 cli_number(needs, "lean", "error"), cli_number(needs, "lean", "springs"),
                 cli_number(needs, "full", "springs"), cli_number(needs, "lean", "wall_seconds"),
                 cli_text(needs, "needs", "method"), cli_number(needs, "cheapest", "wall_seconds"), ratio,
                 cheaper);
}

static void print_lean(const struct cli_needs_results *results) {
  const hooke_measurement *needs = results->needs;
  if (hooke_measurement_row_count(needs, "lean") == 0) return;
  int32_t left_out = 0;
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    if (hooke_measurement_number(needs, "rows", row, "left_out") != 1.0) continue;
    if (!left_out) printf("\n");
    cli_say("%-*s%s\n", LABEL, left_out ? "" : "lean", hooke_measurement_text(needs, "rows", row, "without"));
    left_out++;
  }
  if (!left_out) {
    const char *note = cli_text(needs, "lean", "note");
    printf("\n");
    cli_print_fact(LABEL, WIDTH, "lean", "%s",
                   note[0] ? note
                   : has_unknown(needs)
                       ? "nothing is left out: it cannot be told what is not needed"
                       : "all that would save something is needed: there is nothing to leave out");
    return;
  }
  print_saving(needs);
  if (cli_text(needs, "lean", "note")[0]) {
    cli_print_fact(LABEL, WIDTH, "", "%s", cli_text(needs, "lean", "note"));
  }
  cli_say("%-*s%s\n", LABEL, "",
          results->command ? results->command : "add -o LEAN.json to have it as a scene");
}

/* ---- resolutions ---- */

static void print_cells(const hooke_measurement *needs, int64_t part, const char *const numbers[3]) {
  char text[64] = "";
  for (int a = 0; a < 3; a++) {
    const double cells = hooke_measurement_number(needs, "parts", part, numbers[a]);
    if (!isnan(cells)) cli_append(text, sizeof text, "%s%.0f", text[0] ? " x " : "", cells);
  }
  printf(" %14s", text[0] ? text : "-");
}

static void print_parts(const hooke_measurement *needs) {
  static const char *const has[] = {"cells", "cells_second", "cells_third"};
  static const char *const wanted[] = {"wanted", "wanted_second", "wanted_third"};
  static const char *const numbers[] = {"change", "change_fine", "order", "error"};
  const int32_t width = cli_rows_width(needs, "parts", "part", strlen("part"));
  printf("%-*s %14s %12s %12s %8s %12s %14s\n", width, "part", "cells N", "N to 2N [m]", "2N to 4N [m]",
         "order", "left [m]", "want asks for");
  for (int64_t part = 0; part < hooke_measurement_row_count(needs, "parts"); part++) {
    const char *note = hooke_measurement_text(needs, "parts", part, "note");
    cli_print_padded(stdout, width, hooke_measurement_text(needs, "parts", part, "part"));
    print_cells(needs, part, has);
    for (int k = 0; k < 4; k++)
      cli_rows_print_cell(k == 2 ? 8 : 12, hooke_measurement_number(needs, "parts", part, numbers[k]));
    print_cells(needs, part, wanted);
    printf("\n");
    if (note[0]) {
      printf("%*s", width + 1, "");
      cli_print_wrapped(stdout, width + 1, width + 1, WIDTH, note);
    }
  }
}

/* States until when the results hold; 0: to the end, and nothing is printed. */
static int32_t tell_trust(const hooke_measurement *needs, char text[TRUST_SIZE]) {
  const double until = cli_number(needs, "needs", "judged_until");
  if (until >= cli_number(needs, "needs", "duration") * (1.0 - 1e-9)) return 0;
  snprintf(text, TRUST_SIZE,
           "after %g s small differences grow so fast that no time step keeps its error below a tenth of "
           "what is wanted: changes are those up to %g s of %g s",
           until, until, cli_number(needs, "needs", "duration"));
  return 1;
}

static void print_warning(const char *text) {
  cli_print_fact(LABEL, WIDTH, "WARNING", "%s", text);
  printf("\n");
}

static void print_warnings(const hooke_measurement *needs) {
  char text[TRUST_SIZE];
  const char *note = cli_text(needs, "needs", "note");
  if (tell_trust(needs, text)) print_warning(text);
  if (note[0]) print_warning(note);
}

void cli_needs_results_print(const struct cli_needs_results *results) {
  const hooke_measurement *needs = results->needs;
  cli_say("%s\n", cli_setup_title(results->arguments, &results->setup));
  cli_say("%s%s, %g m wanted", cli_text(needs, "needs", "method"),
          cli_number(needs, "needs", "method_picked") == 1.0 ? " (picked)" : "",
          cli_number(needs, "needs", "want"));
  const double step_error = cli_number(needs, "full", "step_error");
  if (isnan(step_error)) {
    printf("; the full scene was not run to its end\n");
    return;
  }
  printf("; the time step puts the full scene off by at most %.2g m\n\n", step_error);
  print_warnings(needs);
  if (results->refine) {
    print_parts(needs);
    return;
  }
  print_table(needs);
  printf("\nchange: the largest distance of a watched position at any time; wall time: the least of equal "
         "runs, which take up to\n%.0f %% longer\n",
         100.0 * (cli_number(needs, "needs", "spread") - 1.0));
  print_lean(results);
}

/* ---- JSON ---- */

static void print_json_warnings(struct cli_json *json, const hooke_measurement *needs) {
  char text[TRUST_SIZE];
  const char *note = cli_text(needs, "needs", "note");
  cli_json_open(json, "warnings", '[');
  if (tell_trust(needs, text)) cli_json_text(json, NULL, text);
  if (note[0]) cli_json_text(json, NULL, note);
  cli_json_close(json);
}

static void print_json_lean(struct cli_json *json, const struct cli_needs_results *results) {
  if (hooke_measurement_row_count(results->needs, "lean") == 0) {
    cli_json_text(json, "lean", NULL);
    return;
  }
  cli_json_open(json, "lean", '{');
  cli_json_text(json, "scene", results->written);
  cli_json_measured(json, NULL, results->needs, "lean", 0);
  cli_json_text(json, "command", results->command);
  cli_json_close(json);
}

int32_t cli_needs_results_print_json(const struct cli_needs_results *results) {
  const char *found = results->refine ? "parts" : "rows";
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_measured(&json, NULL, results->needs, "needs", 0);
  print_json_warnings(&json, results->needs);
  cli_json_measured(&json, "full", results->needs, "full", -1);
  cli_json_measured(&json, found, results->needs, found, -1);
  if (!results->refine) print_json_lean(&json, results);
  return cli_json_end(&json);
}
