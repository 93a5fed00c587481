/* The page of what a scene needs: what it shows, as JSON. */
#include "core/status.h"
#include "hooke/io.h"
#include "io/page/needs_picture.h"
#include "io/page/report.h"
#include "measure/needs/needs.h"

struct request {
  const hooke_needs *needs;
  const char *command;
};

#define COUNT_OF(list) ((int)(sizeof(list) / sizeof((list)[0])))

/* Costs of the full system, of the lean one and of each row; names of the lean one's begin with "lean_". */
static const char *const costs[] = {"lean_particles",    "lean_springs",   "lean_step",
                                    "lean_rtol",         "lean_steps",     "lean_force_evaluations",
                                    "lean_wall_seconds", "lean_step_error"};
enum { BARE = sizeof "lean_" - 1 };

/* ---- full and lean ---- */

static void add_full(struct hk_text *data, const hooke_needs *needs) {
  hk_text_open(data, "full", '{');
  for (int k = 0; k < COUNT_OF(costs); k++)
    hk_text_number(data, costs[k] + BARE, hooke_needs_figure(needs, costs[k] + BARE));
  hk_report_add_step(data, "step_limit", hooke_needs_figure(needs, "step_limit"));
  hk_text_close(data, '}');
}

/* The full system's own run within the want. */
static void add_cheapest(struct hk_text *data, const hooke_needs *needs) {
  static const char *const names[] = {
      "cheapest_particles", "cheapest_springs",           "cheapest_step",         "cheapest_rtol",
      "cheapest_steps",     "cheapest_force_evaluations", "cheapest_wall_seconds", "cheapest_error"};
  hk_text_open(data, "cheapest", '{');
  for (int k = 0; k < COUNT_OF(names); k++)
    hk_text_number(data, names[k] + sizeof "cheapest_" - 1, hooke_needs_figure(needs, names[k]));
  hk_report_add_step(data, "step_limit", hooke_needs_figure(needs, "cheapest_step_limit"));
  hk_text_close(data, '}');
}

static void add_lean(struct hk_text *data, const hooke_needs *needs, const char *command) {
  if (hooke_needs_lean(needs) == NULL) {
    hk_text_word(data, "lean", NULL);
    return;
  }
  hk_text_open(data, "lean", '{');
  hk_text_number(data, "error", hooke_needs_figure(needs, "lean_error"));
  hk_text_number(data, "times_less", hooke_needs_figure(needs, "times_less"));
  hk_text_word(data, "note", hooke_needs_word(needs, "lean_note"));
  hk_text_word(data, "other_method", hooke_needs_word(needs, "other_method"));
  hk_text_number(data, "other_seconds", hooke_needs_figure(needs, "other_seconds"));
  for (int k = 0; k < COUNT_OF(costs); k++)
    hk_text_number(data, costs[k] + BARE, hooke_needs_figure(needs, costs[k]));
  hk_report_add_step(data, "step_limit", hooke_needs_figure(needs, "lean_step_limit"));
  add_cheapest(data, needs);
  hk_text_word(data, "command", command);
  hk_text_close(data, '}');
}

/* ---- rows ---- */

static void add_row(struct hk_text *data, const hooke_needs *needs, int64_t row) {
  static const char *const words[] = {"without", "kind", "note"};
  static const char *const numbers[] = {"error", "needed", "left_out"};
  hk_text_open(data, NULL, '{');
  for (int k = 0; k < COUNT_OF(words); k++)
    hk_text_word(data, words[k], hooke_needs_text(needs, row, words[k]));
  for (int k = 0; k < COUNT_OF(numbers); k++)
    hk_text_number(data, numbers[k], hooke_needs_number(needs, row, numbers[k]));
  for (int k = 0; k < COUNT_OF(costs); k++)
    hk_text_number(data, costs[k] + BARE, hooke_needs_number(needs, row, costs[k] + BARE));
  hk_report_add_step(data, "step_limit", hooke_needs_number(needs, row, "step_limit"));
  hk_text_close(data, '}');
}

static void add_rows(struct hk_text *data, const hooke_needs *needs) {
  const int64_t known = hooke_needs_row_count(needs);
  hk_text_open(data, "rows", '[');
  for (int64_t row = 0; row < known; row++)
    add_row(data, needs, row);
  hk_text_close(data, ']');
  hk_text_open(data, "waiting", '[');
  for (int64_t row = known; row < needs->row_count; row++)
    hk_text_word(data, NULL, needs->row[row].without);
  hk_text_close(data, ']');
}

/* ---- resolutions ---- */

static void add_cells(struct hk_text *data, const char *key, const hooke_needs *needs, int64_t part,
                      const char *const names[3]) {
  hk_text_open(data, key, '[');
  for (int32_t axis = 0; axis < 3 && axis < needs->part[part].axes; axis++)
    hk_text_number(data, NULL, hooke_needs_part_number(needs, part, names[axis]));
  hk_text_close(data, ']');
}

static void add_parts(struct hk_text *data, const hooke_needs *needs) {
  static const char *const has[] = {"cells", "cells_second", "cells_third"};
  static const char *const wanted[] = {"wanted", "wanted_second", "wanted_third"};
  static const char *const numbers[] = {"change", "change_fine", "order", "error", "factor"};
  hk_text_open(data, "parts", '[');
  for (int64_t part = 0; part < hooke_needs_part_count(needs); part++) {
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "part", hooke_needs_part_text(needs, part, "part"));
    hk_text_word(data, "note", hooke_needs_part_text(needs, part, "note"));
    add_cells(data, "cells", needs, part, has);
    add_cells(data, "wanted", needs, part, wanted);
    for (int k = 0; k < COUNT_OF(numbers); k++)
      hk_text_number(data, numbers[k], hooke_needs_part_number(needs, part, numbers[k]));
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
}

/* ---- the page ---- */

static void add_data(struct hk_text *data, const void *ctx) {
  static const char *const figures[] = {"want", "method_picked", "duration", "judged_until", "runs"};
  const struct request *request = ctx;
  const hooke_needs *needs = request->needs;
  for (int k = 0; k < COUNT_OF(figures); k++)
    hk_text_number(data, figures[k], hooke_needs_figure(needs, figures[k]));
  hk_text_word(data, "method", hooke_needs_word(needs, "method"));
  hk_text_word(data, "note", hooke_needs_word(needs, "note"));
  hk_text_number(data, "watched", (double)needs->watch_count);
  hk_text_number(data, "particles", (double)hooke_system_particle_count(needs->system));
  add_full(data, needs);
  add_rows(data, needs);
  add_lean(data, needs, request->command);
  add_parts(data, needs);
  hk_needs_picture_add(data, needs);
}

int32_t hooke_needs_write_report(const hooke_needs *needs, const char *path, const char *scene,
                                 const char *command) {
  const struct request request = {needs, command};
  const struct hk_report report = {"needs", scene, add_data, &request};
  if (needs->row_count == 0 && needs->part == NULL && needs->lean == NULL)
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "there is nothing to report before hooke_needs_find() or hooke_needs_refine()");
  return hk_report_write(&report, path);
}
