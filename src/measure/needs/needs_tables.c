/* The tables of needs and the lean system. */
#include "measure/needs/needs.h"

#include "core/status.h"

#include <math.h>
#include <stddef.h>

/* ---- costs ---- */

/* The columns of a struct hk_needs_cost, which is the member `at` of a `holder`. */
#define COST(holder, at, member, kind, units, text)                                                          \
  HOOKE_COLUMN_AS(holder, at.member, member, kind, units, text)
#define COST_COLUMNS(holder, at)                                                                             \
  COST(holder, at, wall_seconds, NUMBER, "s", "wall time of stepping alone"),                                \
      COST(holder, at, springs, COUNT, "", "springs"), COST(holder, at, particles, COUNT, "", "particles"),  \
      COST(holder, at, step_limit, NUMBER, "s",                                                              \
           "largest stable step, predicted with LAPACK, else a bound; infinite where nothing limits it"),    \
      COST(holder, at, unlimited, FLAG, "", "nothing limits the step"),                                      \
      COST(holder, at, step, NUMBER, "s", "step of a fixed-step method"),                                    \
      COST(holder, at, rtol, NUMBER, "", "relative tolerance of an error-controlled method"),                \
      COST(holder, at, atol, NUMBER, "m", "absolute tolerance of positions"),                                \
      COST(holder, at, force_evaluations, COUNT, "", "evaluations of the forces"),                           \
      COST(holder, at, steps, COUNT, "", "steps taken"),                                                     \
      COST(holder, at, step_error, NUMBER, "m", "how far the step or the tolerance may put the run off")

/* ---- the record ---- */

HOOKE_READER(const char *, method, struct hk_needs, hooke_options_text(it->m->run, "method"))
HOOKE_READER(double, judged_until, struct hk_needs, hk_needs_judged_until(it))

double hk_needs_judged_until(const struct hk_needs *needs) {
  return hk_needs_time(needs, needs->judged - 1);
}

/* ---- the full system ---- */

HOOKE_READER(const void *, find_full, struct hk_needs, it->path.position ? it : NULL)

/* ---- the lean system, and the full one at its cheapest ---- */

HOOKE_READER(double, times_less, struct hk_needs, it->cheapest.wall_seconds / it->lean.cost.wall_seconds)
HOOKE_COUNTER(count_found, struct hk_needs, it->lean.path.position ? it->wants.count : 0)
HOOKE_COUNTER(count_lean, struct hk_needs, it->lean.system != NULL)
HOOKE_READER(const char *, scene, struct hk_needs, it->m->label[HOOKE_LABEL_OUTPUT])
HOOKE_READER(const char *, command, struct hk_needs, it->m->label[HOOKE_LABEL_COMMAND])

/* ---- what the lean system has changed ---- */

static const struct hk_needs_degree *changed(const struct hk_needs *needs, int64_t row) {
  int64_t k = hk_needs_next_changed(needs, 0);
  while (row-- > 0)
    k = hk_needs_next_changed(needs, k + 1);
  return &needs->degree[k];
}

static int64_t count_changed(const void *any) {
  const struct hk_needs *needs = any;
  int64_t count = 0;
  for (int64_t k = 0; (k = hk_needs_next_changed(needs, k)) < needs->degree_count && needs->lean.system; k++)
    count++;
  return count;
}

HOOKE_READER(const char *, changed_quantity, struct hk_needs, changed(it, row)->quantity)
HOOKE_READER(double, changed_factor, struct hk_needs, changed(it, row)->lean_factor)

/* ---- rows ---- */

int64_t hk_needs_known_rows(const struct hk_needs *needs) {
  int64_t count = 0;
  while (count < needs->row_count && (needs->row[count].measured || needs->row[count].note[0]))
    count++;
  return count;
}

HOOKE_COUNTER(count_rows, struct hk_needs, hk_needs_known_rows(it))

/* ---- resolution ---- */

double hk_needs_cells(const struct hk_needs_part *part, int32_t axis, double factor) {
  if (part->cells[axis] < 0 || !isfinite(factor)) return NAN;
  return fmax(1.0, ceil((double)part->cells[axis] * factor * (1.0 - 1e-12)));
}

HOOKE_READER(double, wanted, struct hk_needs, hk_needs_cells(&it->part[row], 0, it->part[row].factor))
HOOKE_READER(double, wanted_second, struct hk_needs, hk_needs_cells(&it->part[row], 1, it->part[row].factor))
HOOKE_READER(double, wanted_third, struct hk_needs, hk_needs_cells(&it->part[row], 2, it->part[row].factor))

HOOKE_READER(const char *, error_unit, struct hk_needs, it->wants.list ? "wants" : "m")

/* ---- the tables ---- */

const struct hk_table hk_needs_tables[] = {
    {.name = "needs",
     .doc = "what was asked and how it was judged",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_needs, want, NUMBER, "m", "the wanted error; 1 of a list"),
         HOOKE_COLUMN_BY(error_unit, TEXT, "",
                         "unit of errors: m, or \"wants\": they are parts of what a list wants"),
         HOOKE_COLUMN_BY(method, TEXT, "", "method of all runs"),
         HOOKE_COLUMN(struct hk_needs, method_picked, FLAG, "", "no method was given, so one was picked"),
         HOOKE_COLUMN(struct hk_needs, duration, NUMBER, "s", "duration of the run"),
         HOOKE_COLUMN_BY(judged_until, NUMBER, "s",
                         "time up to which changes are judged; beyond it differences grow so fast that no "
                         "step would keep its error small"),
         HOOKE_COLUMN(struct hk_needs, runs, COUNT, "", "runs made so far"),
         HOOKE_COLUMN_AS(struct hk_needs, watch_count, watched, COUNT, "", "watched particles"),
         HOOKE_COLUMN(struct hk_needs, spread, NUMBER, "",
                      "largest quotient of the slowest and the quickest of equal runs, whose least is told"),
         HOOKE_COLUMN(struct hk_needs, note, TEXT, "",
                      "says that nothing moves, or less than the wanted error"))},
    {.name = "full",
     .doc = "the full system, run with errors of the step a tenth of the wanted error",
     .record = 1,
     .row = find_full,
     HOOKE_TABLE_COLUMNS(
         COST_COLUMNS(struct hk_needs, full),
         HOOKE_COLUMN(
             struct hk_needs, own_error, NUMBER, "m",
             "how far the finer of its last two runs may be off; all variants are compared with that one"),
         HOOKE_COLUMN(
             struct hk_needs, moved, NUMBER, "m",
             "by how much the watched particles move from where they begin, measured like a change"))},
    {.name = "lean",
     .doc = "the run of the lean system that is recommended, with the largest step within the wanted error",
     .record = 1,
     .count = count_lean,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(struct hk_needs, lean.error, error, NUMBER, "m",
                         "at most that far from the full system: the distance from its finer run and "
                         "\"own_error\" together"),
         COST_COLUMNS(struct hk_needs, lean.cost),
         HOOKE_COLUMN_BY(times_less, NUMBER, "",
                         "wall time of \"cheapest\" over that of the lean system, taken in turns"),
         HOOKE_COLUMN(
             struct hk_needs, other_method, TEXT, "",
             "method by which the full system takes clearly less time; none where none was seen to, or "
             "where nothing is left out"),
         HOOKE_COLUMN(struct hk_needs, other_seconds, NUMBER, "s",
                      "wall time of the full system by that method"),
         HOOKE_COLUMN_AS(
             struct hk_needs, lean_note, note, TEXT, "",
             "parts that are rigid bodies in the lean system, and groups of parts that it has spring by "
             "spring, since it has some of their springs only"),
         HOOKE_COLUMN_BY(scene, TEXT, "", "file with it, where the caller wrote one and said so by a label"),
         HOOKE_COLUMN_BY(command, TEXT, "", "command line that runs it, likewise"))},
    {.name = "cheapest",
     .inside = "lean",
     .key = "full",
     .doc = "the full system by the same method, likewise with the largest step within the wanted error",
     .record = 1,
     .count = count_lean,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(struct hk_needs, cheapest_error, error, NUMBER, "m", "likewise, of this run"),
         COST_COLUMNS(struct hk_needs, cheapest))},
    {.name = "changed",
     .inside = "lean",
     .empty_in_json = 1,
     .doc = "numbers that the lean system has changed",
     .count = count_changed,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY_AS(changed_quantity, quantity, TEXT, "", "as in the table of degrees"),
         HOOKE_COLUMN_BY_AS(changed_factor, factor, NUMBER, "", "on it"))},
    {HOOKE_WANTS_TABLE, .count = count_found, HOOKE_TABLE_AT(struct hk_needs, found)},
    {.name = "rows",
     .doc = "the ingredients, left out one at a time",
     .count = count_rows,
     HOOKE_TABLE_AT(struct hk_needs, row),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_needs_row, without, TEXT, "", "what was left out"),
         HOOKE_COLUMN(
             struct hk_needs_row, kind, TEXT, "",
             "springs, bending, altitude, fluid_drag, damping, drag, quadratic_drag, wind, gravity, callback, idle, loose, part, "
             "rigid, compression or resolution"),
         HOOKE_COLUMN(
             struct hk_needs_row, error, NUMBER, "m",
             "largest change of position of a watched particle without it; NaN if the run did not end"),
         HOOKE_COLUMN(
             struct hk_needs_row, needed, FLAG, "",
             "the change is more than the wanted error; NaN where nothing moves that it could change"),
         HOOKE_COLUMN(struct hk_needs_row, left_out, FLAG, "", "the lean system is without it, too"),
         COST_COLUMNS(struct hk_needs_row, cost),
         HOOKE_COLUMN(struct hk_needs_row, timed_alone, FLAG, "",
                      "0: timed while other rows were running, so its time may be too long"),
         HOOKE_COLUMN(struct hk_needs_row, note, TEXT, "",
                      "why there is no change, or why it is not left out"))},
    {.name = "degrees",
     .doc =
         "how far single numbers may be changed within the wanted error, by runs with the step of the full system",
     HOOKE_TABLE_ROWS(struct hk_needs, degree, degree_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_needs_degree, quantity, TEXT, "",
                      "stiffness or damping of a group, mass of a particle, or drag"),
         HOOKE_COLUMN(struct hk_needs_degree, factor, NUMBER, "",
                      "on it, the farthest that holds; 1 where none of those tried does"),
         HOOKE_COLUMN(struct hk_needs_degree, error, NUMBER, "m",
                      "largest change of position by that factor"),
         HOOKE_COLUMN(struct hk_needs_degree, beyond, NUMBER, "",
                      "next factor, by which the change is more than the wanted error; NaN: none was found"),
         HOOKE_COLUMN(struct hk_needs_degree, error_beyond, NUMBER, "m",
                      "largest change by that one, at least to a quarter; NaN: its run does not end"),
         HOOKE_COLUMN(struct hk_needs_degree, step_limit, NUMBER, "s",
                      "largest stable step with the factor; infinite where nothing limits it"),
         HOOKE_COLUMN(struct hk_needs_degree, work, NUMBER, "",
                      "steps at that limit over those of the full system at its own"),
         HOOKE_COLUMN(struct hk_needs_degree, tried, FLAG, "",
                      "no: it was not tried, within the work allowed"))},
    {.name = "parts",
     .doc = "the resolution of every part, with the option `refine`",
     .lists = {{"cells", "cells", "cells_second", "cells_third"},
               {"wanted", "wanted", "wanted_second", "wanted_third"}},
     HOOKE_TABLE_ROWS(struct hk_needs, part, part_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(struct hk_needs_part, name, part, TEXT, "", "name of the part"),
         HOOKE_COLUMN_AS(struct hk_needs_part, cells[0], cells, COUNT, "",
                         "cells along the first axis of the part"),
         HOOKE_COLUMN_AS(struct hk_needs_part, cells[1], cells_second, COUNT, "",
                         "cells along its second axis"),
         HOOKE_COLUMN_AS(struct hk_needs_part, cells[2], cells_third, COUNT, "",
                         "cells along its third axis"),
         HOOKE_COLUMN(struct hk_needs_part, change, NUMBER, "m", "change from once to twice the resolution"),
         HOOKE_COLUMN(struct hk_needs_part, change_fine, NUMBER, "m",
                      "change from twice to four times the resolution"),
         HOOKE_COLUMN(struct hk_needs_part, order, NUMBER, "", "order by which the changes fall"),
         HOOKE_COLUMN(struct hk_needs_part, error, NUMBER, "m",
                      "estimate of the error that is left at the resolution that the part has (Richardson)"),
         HOOKE_COLUMN(struct hk_needs_part, factor, NUMBER, "", "factor on the cells for the wanted error"),
         HOOKE_COLUMN_BY(wanted, COUNT, "", "cells along the first axis at that factor"),
         HOOKE_COLUMN_BY(wanted_second, COUNT, "", "cells along the second axis at that factor"),
         HOOKE_COLUMN_BY(wanted_third, COUNT, "", "cells along the third axis at that factor"),
         HOOKE_COLUMN(struct hk_needs_part, note, TEXT, "", "why there is no order or factor"))},
    {.name = NULL}};

/* ---- the lean system ---- */

/* NULL for another kind, and while there is no lean system. */
static const struct hk_needs *find_lean(const hooke_measurement *m, const char *function) {
  const struct hk_needs *needs = m->object;
  return hk_measurement_require(m, &hk_needs_kind, function) == HOOKE_OK && needs->lean.system ? needs : NULL;
}

const hooke_system *hooke_needs_lean(const hooke_measurement *m) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean");
  return needs ? needs->lean.system : NULL;
}

const hooke_options *hooke_needs_lean_run(const hooke_measurement *m) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean_run");
  return needs ? needs->lean_run : NULL;
}

int64_t hooke_needs_lean_particle(const hooke_measurement *m, int64_t particle) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean_particle");
  if (needs == NULL || particle < 0 || particle >= needs->m->system->particle_count) return -1;
  return hk_variant_is_same(&needs->lean.map, particle) ? needs->lean.map.to[particle] : -1;
}

int32_t hooke_needs_lean_position(const hooke_measurement *m, const double *q, double *position) {
  const int32_t status = hk_measurement_require(m, &hk_needs_kind, "hooke_needs_lean_position");
  if (status != HOOKE_OK) return status;
  const struct hk_needs *needs = m->object;
  if (needs->lean.system == NULL) {
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "there is no lean system yet; call hooke_measurement_run() first, without `refine`");
  }
  for (int64_t p = 0; p < needs->m->system->particle_count; p++)
    hk_variant_place(&needs->lean.map, p, q, position + 3 * p);
  return HOOKE_OK;
}
