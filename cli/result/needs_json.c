/* What a scene needs, as JSON. */
#include "needs_results.h"

#include <math.h>

static const char *const cost_numbers[] = {"wall_seconds", "springs", "step_limit",        "particles",
                                           "step",         "rtol",    "force_evaluations", "steps"};
enum { COSTS = sizeof cost_numbers / sizeof cost_numbers[0] };

static void print_full(struct cli_json *json, const hooke_needs *needs) {
  cli_json_open(json, "full", '{');
  for (int k = 0; k < COSTS; k++)
    cli_json_number(json, cost_numbers[k], hooke_needs_figure(needs, cost_numbers[k]));
  cli_json_number(json, "step_error", hooke_needs_figure(needs, "step_error"));
  cli_json_number(json, "own_error", hooke_needs_figure(needs, "own_error"));
  cli_json_number(json, "moved", hooke_needs_figure(needs, "moved"));
  cli_json_close(json);
}

static void print_warnings(struct cli_json *json, const hooke_needs *needs) {
  char text[HOOKE_NEEDS_TRUST];
  const char *note = hooke_needs_word(needs, "note");
  cli_json_open(json, "warnings", '[');
  if (cli_needs_results_trust(needs, text)) cli_json_text(json, NULL, text);
  if (note[0]) cli_json_text(json, NULL, note);
  cli_json_close(json);
}

/* null where it cannot be told */
static void print_needed(struct cli_json *json, double needed) {
  if (isnan(needed))
    cli_json_text(json, "needed", NULL);
  else
    cli_json_flag(json, "needed", needed == 1.0);
}

static void print_rows(struct cli_json *json, const hooke_needs *needs) {
  cli_json_open(json, "rows", '[');
  for (int64_t row = 0; row < hooke_needs_row_count(needs); row++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "without", hooke_needs_text(needs, row, "without"));
    cli_json_text(json, "kind", hooke_needs_text(needs, row, "kind"));
    cli_json_number(json, "error", hooke_needs_number(needs, row, "error"));
    for (int k = 0; k < COSTS; k++)
      cli_json_number(json, cost_numbers[k], hooke_needs_number(needs, row, cost_numbers[k]));
    print_needed(json, hooke_needs_number(needs, row, "needed"));
    cli_json_text(json, "note", hooke_needs_text(needs, row, "note"));
    cli_json_close(json);
  }
  cli_json_close(json);
}

/* The full scene's own cheapest run within the want. */
static void print_cheapest(struct cli_json *json, const hooke_needs *needs) {
  static const char *const numbers[] = {"cheapest_error", "cheapest_wall_seconds",      "cheapest_step",
                                        "cheapest_rtol",  "cheapest_force_evaluations", "cheapest_steps"};
  cli_json_open(json, "full", '{');
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    cli_json_number(json, numbers[k] + sizeof "cheapest_" - 1, hooke_needs_figure(needs, numbers[k]));
  cli_json_close(json);
}

static void print_lean(struct cli_json *json, const struct cli_needs_results *results) {
  static const char *const numbers[] = {"lean_wall_seconds",      "lean_springs", "lean_step_limit",
                                        "lean_particles",         "lean_step",    "lean_rtol",
                                        "lean_force_evaluations", "lean_steps"};
  const hooke_needs *needs = results->needs;
  if (!hooke_needs_lean(needs)) {
    cli_json_text(json, "lean", NULL);
    return;
  }
  cli_json_open(json, "lean", '{');
  cli_json_text(json, "scene", results->written);
  cli_json_open(json, "without", '[');
  for (int64_t row = 0; row < hooke_needs_row_count(needs); row++) {
    if (hooke_needs_number(needs, row, "left_out") == 1.0)
      cli_json_text(json, NULL, hooke_needs_text(needs, row, "without"));
  }
  cli_json_close(json);
  cli_json_number(json, "error", hooke_needs_figure(needs, "lean_error"));
  for (int k = 0; k < COSTS; k++)
    cli_json_number(json, numbers[k] + sizeof "lean_" - 1, hooke_needs_figure(needs, numbers[k]));
  print_cheapest(json, needs);
  cli_json_number(json, "times_less", hooke_needs_figure(needs, "times_less"));
  cli_json_text(json, "other_method", hooke_needs_word(needs, "other_method"));
  cli_json_number(json, "other_seconds", hooke_needs_figure(needs, "other_seconds"));
  cli_json_text(json, "note", hooke_needs_word(needs, "lean_note"));
  cli_json_text(json, "command", results->command);
  cli_json_close(json);
}

static void print_cells(struct cli_json *json, const hooke_needs *needs, int64_t part, const char *key,
                        const char *const numbers[3]) {
  cli_json_open(json, key, '[');
  for (int a = 0; a < 3; a++) {
    const double cells = hooke_needs_part_number(needs, part, numbers[a]);
    if (!isnan(cells)) cli_json_number(json, NULL, cells);
  }
  cli_json_close(json);
}

static void print_parts(struct cli_json *json, const hooke_needs *needs) {
  static const char *const has[] = {"cells", "cells_second", "cells_third"};
  static const char *const wanted[] = {"wanted", "wanted_second", "wanted_third"};
  static const char *const numbers[] = {"change", "change_fine", "order", "error", "factor"};
  cli_json_open(json, "parts", '[');
  for (int64_t part = 0; part < hooke_needs_part_count(needs); part++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "part", hooke_needs_part_text(needs, part, "part"));
    print_cells(json, needs, part, "cells", has);
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
      cli_json_number(json, numbers[k], hooke_needs_part_number(needs, part, numbers[k]));
    print_cells(json, needs, part, "wanted", wanted);
    cli_json_text(json, "note", hooke_needs_part_text(needs, part, "note"));
    cli_json_close(json);
  }
  cli_json_close(json);
}

void cli_needs_results_print_json(const struct cli_needs_results *results) {
  const hooke_needs *needs = results->needs;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_number(&json, "want", hooke_needs_figure(needs, "want"));
  cli_json_text(&json, "method", hooke_needs_word(needs, "method"));
  cli_json_number(&json, "duration", hooke_needs_figure(needs, "duration"));
  cli_json_number(&json, "judged_until", hooke_needs_figure(needs, "judged_until"));
  print_warnings(&json, needs);
  print_full(&json, needs);
  if (results->refine) {
    print_parts(&json, needs);
  } else {
    print_rows(&json, needs);
    print_lean(&json, results);
  }
  cli_json_end(&json);
}
