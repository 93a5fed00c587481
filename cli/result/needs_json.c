/* Needs of a scene, as JSON. */
#include "needs_results.h"
#include "table.h"

#include <math.h>

static void print_warnings(struct cli_json *json, const hooke_measurement *needs) {
  char text[HOOKE_NEEDS_TRUST];
  const char *note = hooke_measurement_text(needs, "needs", 0, "note");
  cli_json_open(json, "warnings", '[');
  if (cli_needs_results_trust(needs, text)) cli_json_text(json, NULL, text);
  if (note[0]) cli_json_text(json, NULL, note);
  cli_json_close(json);
}

static void print_left_out(struct cli_json *json, const hooke_measurement *needs) {
  cli_json_open(json, "without", '[');
  for (int64_t row = 0; row < hooke_measurement_row_count(needs, "rows"); row++) {
    if (hooke_measurement_number(needs, "rows", row, "left_out") == 1.0)
      cli_json_text(json, NULL, hooke_measurement_text(needs, "rows", row, "without"));
  }
  cli_json_close(json);
}

static void print_lean(struct cli_json *json, const struct cli_needs_results *results) {
  const hooke_measurement *needs = results->needs;
  if (hooke_measurement_row_count(needs, "lean") == 0) {
    cli_json_text(json, "lean", NULL);
    return;
  }
  cli_json_open(json, "lean", '{');
  cli_json_text(json, "scene", results->written);
  print_left_out(json, needs);
  cli_table_print_row(json, needs, "lean", 0);
  cli_table_print(json, "full", needs, "cheapest");
  cli_json_text(json, "command", results->command);
  cli_json_close(json);
}

static void print_cells(struct cli_json *json, const hooke_measurement *needs, int64_t part,
                        const char *const columns[3]) {
  cli_json_open(json, columns[0], '[');
  for (int a = 0; a < 3; a++) {
    const double cells = hooke_measurement_number(needs, "parts", part, columns[a]);
    if (!isnan(cells)) cli_json_number(json, NULL, cells);
  }
  cli_json_close(json);
}

/* Cells along all axes in one list. */
static void print_parts(struct cli_json *json, const hooke_measurement *needs) {
  static const char *const has[] = {"cells", "cells_second", "cells_third"};
  static const char *const wanted[] = {"wanted", "wanted_second", "wanted_third"};
  static const char *const numbers[] = {"change", "change_fine", "order", "error", "factor"};
  cli_json_open(json, "parts", '[');
  for (int64_t part = 0; part < hooke_measurement_row_count(needs, "parts"); part++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "part", hooke_measurement_text(needs, "parts", part, "part"));
    print_cells(json, needs, part, has);
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
      cli_json_number(json, numbers[k], hooke_measurement_number(needs, "parts", part, numbers[k]));
    print_cells(json, needs, part, wanted);
    cli_json_text(json, "note", hooke_measurement_text(needs, "parts", part, "note"));
    cli_json_close(json);
  }
  cli_json_close(json);
}

void cli_needs_results_print_json(const struct cli_needs_results *results) {
  const hooke_measurement *needs = results->needs;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_table_print_row(&json, needs, "needs", 0);
  print_warnings(&json, needs);
  cli_table_print(&json, "full", needs, "full");
  if (results->refine) {
    print_parts(&json, needs);
  } else {
    cli_table_print(&json, "rows", needs, "rows");
    print_lean(&json, results);
  }
  cli_json_end(&json);
}
