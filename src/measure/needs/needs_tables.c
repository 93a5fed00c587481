/* The tables of needs and the lean system. */
#include "measure/needs/needs.h"

#include "core/status.h"

#include <math.h>
#include <stddef.h>

/* ---- costs ---- */

/* Starts the line of every table whose rows are runs. */
struct cost_line {
  struct hk_needs_cost cost;
  double unlimited;
};

static struct cost_line cost_line(const struct hk_needs_cost *cost, int32_t known) {
  static const struct hk_needs_cost none = {NAN, NAN, NAN, 0, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  return (struct cost_line){.cost = known ? *cost : none,
                            .unlimited = known ? (double)isinf(cost->step_limit) : (double)NAN};
}

#define COST(member, kind, units, text) HOOKE_COLUMN(struct hk_needs_cost, member, kind, units, text)
#define COST_COLUMNS                                                                                         \
  COST(wall_seconds, NUMBER, "s", "wall time of stepping alone"), COST(springs, COUNT, "", "springs"),       \
      COST(particles, COUNT, "", "particles"),                                                               \
      COST(step_limit, NUMBER, "s",                                                                          \
           "largest stable step, predicted with LAPACK, else a bound; infinite where nothing limits it"),    \
      HOOKE_COLUMN(struct cost_line, unlimited, FLAG, "", "nothing limits the step"),                        \
      COST(step, NUMBER, "s", "step of a fixed-step method"),                                                \
      COST(rtol, NUMBER, "", "relative tolerance of an error-controlled method"),                            \
      COST(atol, NUMBER, "m", "absolute tolerance of positions"),                                            \
      COST(force_evaluations, COUNT, "", "evaluations of the forces"),                                       \
      COST(steps, COUNT, "", "steps taken"),                                                                 \
      COST(step_error, NUMBER, "m", "how far the step or the tolerance may put the run off")

/* ---- the record ---- */

struct needs_line {
  double want;
  const char *method;
  double method_picked, duration, judged_until, runs, watched, spread;
  const char *note;
};

static void read_needs(const void *object, int64_t row, void *line) {
  const struct hk_needs *needs = object;
  (void)row;
  *(struct needs_line *)line = (struct needs_line){.want = needs->want,
                                                   .method = hooke_options_text(needs->run, "method"),
                                                   .method_picked = (double)needs->method_picked,
                                                   .duration = needs->duration,
                                                   .judged_until = hk_needs_time(needs, needs->judged - 1),
                                                   .runs = (double)needs->runs,
                                                   .watched = (double)needs->watch_count,
                                                   .spread = needs->spread,
                                                   .note = needs->note};
}

static const struct hk_column needs_columns[] = {
    HOOKE_COLUMN(struct needs_line, want, NUMBER, "m", "the wanted error"),
    HOOKE_COLUMN(struct needs_line, method, TEXT, "", "method of all runs"),
    HOOKE_COLUMN(struct needs_line, method_picked, FLAG, "", "no method was given, so one was picked"),
    HOOKE_COLUMN(struct needs_line, duration, NUMBER, "s", "duration of the run"),
    HOOKE_COLUMN(struct needs_line, judged_until, NUMBER, "s",
                 "time up to which changes are judged; beyond it differences grow so fast that no step would "
                 "keep its error small"),
    HOOKE_COLUMN(struct needs_line, runs, COUNT, "", "runs made so far"),
    HOOKE_COLUMN(struct needs_line, watched, COUNT, "", "watched particles"),
    HOOKE_COLUMN(struct needs_line, spread, NUMBER, "",
                 "largest quotient of the slowest and the quickest of equal runs, whose least is told"),
    HOOKE_COLUMN(struct needs_line, note, TEXT, "", "says that nothing moves, or less than the wanted error"),
};

static const struct hk_table needs_table = {
    .name = "needs",
    .doc = "what was asked and how it was judged",
    .record = 1,
    HOOKE_TABLE_COLUMNS(needs_columns, struct needs_line),
    .read = read_needs,
};

/* ---- the full system ---- */

struct full_line {
  struct cost_line cost;
  double own_error, moved;
};

static void read_full(const void *object, int64_t row, void *line) {
  const struct hk_needs *needs = object;
  const int32_t known = needs->path.position != NULL;
  (void)row;
  *(struct full_line *)line = (struct full_line){.cost = cost_line(&needs->full, known),
                                                 .own_error = known ? needs->own_error : NAN,
                                                 .moved = known ? needs->moved : NAN};
}

static const struct hk_column full_columns[] = {
    COST_COLUMNS,
    HOOKE_COLUMN(
        struct full_line, own_error, NUMBER, "m",
        "how far the finer of its last two runs may be off; all variants are compared with that one"),
    HOOKE_COLUMN(struct full_line, moved, NUMBER, "m",
                 "by how much the watched particles move from where they begin, measured like a change"),
};

static const struct hk_table full_table = {
    .name = "full",
    .doc = "the full system, run with errors of the step a tenth of the wanted error",
    .record = 1,
    HOOKE_TABLE_COLUMNS(full_columns, struct full_line),
    .read = read_full,
};

/* ---- the lean system, and the full one at its cheapest ---- */

struct lean_line {
  struct cost_line cost;
  double error, times_less, other_seconds;
  const char *other_method, *note;
};

static int64_t count_lean(const void *object) {
  return ((const struct hk_needs *)object)->lean != NULL;
}

static void read_lean(const void *object, int64_t row, void *line) {
  const struct hk_needs *needs = object;
  (void)row;
  *(struct lean_line *)line =
      (struct lean_line){.cost = cost_line(&needs->lean_cost, 1),
                         .error = needs->lean_error,
                         .times_less = needs->cheapest.wall_seconds / needs->lean_cost.wall_seconds,
                         .other_seconds = needs->other_seconds,
                         .other_method = needs->other_method,
                         .note = needs->lean_note};
}

static const struct hk_column lean_columns[] = {
    HOOKE_COLUMN(struct lean_line, error, NUMBER, "m",
                 "at most that far from the full system: the distance from its finer run and \"own_error\" "
                 "together"),
    COST_COLUMNS,
    HOOKE_COLUMN(struct lean_line, times_less, NUMBER, "",
                 "wall time of \"cheapest\" over that of the lean system, taken in turns"),
    HOOKE_COLUMN(struct lean_line, other_method, TEXT, "",
                 "method by which the full system takes clearly less time; none where none was seen to, or "
                 "where nothing is left out"),
    HOOKE_COLUMN(struct lean_line, other_seconds, NUMBER, "s", "wall time of the full system by that method"),
    HOOKE_COLUMN(struct lean_line, note, TEXT, "",
                 "parts that are rigid bodies in the lean system, and groups of parts that it has spring by "
                 "spring, since it has some of their springs only"),
};

static const struct hk_table lean_table = {
    .name = "lean",
    .doc = "the run of the lean system that is recommended, with the largest step within the wanted error",
    .record = 1,
    HOOKE_TABLE_COLUMNS(lean_columns, struct lean_line),
    .count = count_lean,
    .read = read_lean,
};

static void read_cheapest(const void *object, int64_t row, void *line) {
  const struct hk_needs *needs = object;
  (void)row;
  *(struct lean_line *)line =
      (struct lean_line){.cost = cost_line(&needs->cheapest, 1), .error = needs->cheapest_error};
}

static const struct hk_column cheapest_columns[] = {
    HOOKE_COLUMN(struct lean_line, error, NUMBER, "m", "likewise, of this run"),
    COST_COLUMNS,
};

static const struct hk_table cheapest_table = {
    .name = "cheapest",
    .doc = "the full system by the same method, likewise with the largest step within the wanted error",
    .record = 1,
    HOOKE_TABLE_COLUMNS(cheapest_columns, struct lean_line),
    .count = count_lean,
    .read = read_cheapest,
};

/* ---- rows ---- */

struct row_line {
  struct cost_line cost;
  const char *without, *kind, *note;
  double error, needed, left_out;
};

int64_t hk_needs_known_rows(const struct hk_needs *needs) {
  int64_t count = 0;
  while (count < needs->row_count && (needs->row[count].measured || needs->row[count].note[0]))
    count++;
  return count;
}

static int64_t count_rows(const void *object) {
  return hk_needs_known_rows(object);
}

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_needs_row *r = &((const struct hk_needs *)object)->row[row];
  *(struct row_line *)line = (struct row_line){.cost = cost_line(&r->cost, r->measured),
                                               .without = r->without,
                                               .kind = r->kind,
                                               .note = r->note,
                                               .error = r->error,
                                               .needed = r->untold ? (double)NAN : (double)r->needed,
                                               .left_out = (double)r->left_out};
}

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN(struct row_line, without, TEXT, "", "what was left out"),
    HOOKE_COLUMN(
        struct row_line, kind, TEXT, "",
        "springs, bending, altitude, damping, drag, gravity, callback, idle, loose, part, rigid, compression "
        "or resolution"),
    HOOKE_COLUMN(struct row_line, error, NUMBER, "m",
                 "largest change of position of a watched particle without it; NaN if the run did not end"),
    HOOKE_COLUMN(struct row_line, needed, FLAG, "",
                 "the change is more than the wanted error; NaN where nothing moves that it could change"),
    HOOKE_COLUMN(struct row_line, left_out, FLAG, "", "the lean system is without it, too"),
    COST_COLUMNS,
    HOOKE_COLUMN(struct row_line, note, TEXT, "", "why there is no change, or why it is not left out"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "the ingredients, left out one at a time",
    HOOKE_TABLE_COLUMNS(row_columns, struct row_line),
    .count = count_rows,
    .read = read_row,
};

/* ---- resolution ---- */

struct part_line {
  const char *part, *note;
  double cells, cells_second, cells_third, change, change_fine, order, error, factor;
  double wanted, wanted_second, wanted_third;
};

static double cells_at(const struct hk_needs_part *part, int32_t axis, double factor) {
  if (axis >= part->axes || !isfinite(factor)) return NAN;
  return fmax(1.0, ceil((double)part->cells[axis] * factor * (1.0 - 1e-12)));
}

static void read_part(const void *object, int64_t row, void *line) {
  const struct hk_needs_part *p = &((const struct hk_needs *)object)->part[row];
  *(struct part_line *)line = (struct part_line){.part = p->name,
                                                 .note = p->note,
                                                 .cells = cells_at(p, 0, 1.0),
                                                 .cells_second = cells_at(p, 1, 1.0),
                                                 .cells_third = cells_at(p, 2, 1.0),
                                                 .change = p->change,
                                                 .change_fine = p->change_fine,
                                                 .order = p->order,
                                                 .error = p->error,
                                                 .factor = p->factor,
                                                 .wanted = cells_at(p, 0, p->factor),
                                                 .wanted_second = cells_at(p, 1, p->factor),
                                                 .wanted_third = cells_at(p, 2, p->factor)};
}

static const struct hk_column part_columns[] = {
    HOOKE_COLUMN(struct part_line, part, TEXT, "", "name of the part"),
    HOOKE_COLUMN(struct part_line, cells, COUNT, "", "cells along the first axis of the part"),
    HOOKE_COLUMN(struct part_line, cells_second, COUNT, "", "cells along its second axis"),
    HOOKE_COLUMN(struct part_line, cells_third, COUNT, "", "cells along its third axis"),
    HOOKE_COLUMN(struct part_line, change, NUMBER, "m", "change from once to twice the resolution"),
    HOOKE_COLUMN(struct part_line, change_fine, NUMBER, "m",
                 "change from twice to four times the resolution"),
    HOOKE_COLUMN(struct part_line, order, NUMBER, "", "order by which the changes fall"),
    HOOKE_COLUMN(struct part_line, error, NUMBER, "m",
                 "estimate of the error that is left at the resolution that the part has (Richardson)"),
    HOOKE_COLUMN(struct part_line, factor, NUMBER, "", "factor on the cells for the wanted error"),
    HOOKE_COLUMN(struct part_line, wanted, COUNT, "", "cells along the first axis at that factor"),
    HOOKE_COLUMN(struct part_line, wanted_second, COUNT, "", "cells along the second axis at that factor"),
    HOOKE_COLUMN(struct part_line, wanted_third, COUNT, "", "cells along the third axis at that factor"),
    HOOKE_COLUMN(struct part_line, note, TEXT, "", "why there is no order or factor"),
};

static const struct hk_table part_table = {
    .name = "parts",
    .doc = "the resolution of every part, with the option `refine`",
    HOOKE_TABLE_COLUMNS(part_columns, struct part_line),
    HOOKE_TABLE_COUNT(struct hk_needs, part_count),
    .read = read_part,
};

const struct hk_table *const hk_needs_tables[HOOKE_NEEDS_TABLES] = {
    &needs_table, &full_table, &lean_table, &cheapest_table, &row_table, &part_table};

/* ---- the lean system ---- */

/* NULL for another kind, and while there is no lean system. */
static const struct hk_needs *find_lean(const hooke_measurement *m, const char *function) {
  const struct hk_needs *needs = m->object;
  return hk_measurement_require(m, &hk_needs_kind, function) == HOOKE_OK && needs->lean ? needs : NULL;
}

const hooke_system *hooke_needs_lean(const hooke_measurement *m) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean");
  return needs ? needs->lean : NULL;
}

const hooke_options *hooke_needs_lean_run(const hooke_measurement *m) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean_run");
  return needs ? needs->lean_run : NULL;
}

int64_t hooke_needs_lean_particle(const hooke_measurement *m, int64_t particle) {
  const struct hk_needs *needs = find_lean(m, "hooke_needs_lean_particle");
  if (needs == NULL || particle < 0 || particle >= needs->system->particle_count) return -1;
  return hk_variant_is_same(&needs->lean_map, particle) ? needs->lean_map.to[particle] : -1;
}

int32_t hooke_needs_lean_position(const hooke_measurement *m, const double *q, double *position) {
  const int32_t status = hk_measurement_require(m, &hk_needs_kind, "hooke_needs_lean_position");
  if (status != HOOKE_OK) return status;
  const struct hk_needs *needs = m->object;
  if (needs->lean == NULL) {
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "there is no lean system yet; call hooke_measurement_run() first, without `refine`");
  }
  for (int64_t p = 0; p < needs->system->particle_count; p++)
    hk_variant_place(&needs->lean_map, p, q, position + 3 * p);
  return HOOKE_OK;
}
