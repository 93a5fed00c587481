/* The tables of a cost. */
#include "measure/cost/cost.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- the whole scene ---- */

struct cost_line {
  const char *method;
  double step, nanoseconds, resolution, memory_bytes, step_limit, dropped_springs, idle_particles;
};

static void read_cost(const void *object, int64_t row, void *line) {
  const struct hk_cost *cost = object;
  (void)row;
  *(struct cost_line *)line =
      (struct cost_line){.method = cost->method,
                         .step = cost->step,
                         .nanoseconds = cost->nanoseconds,
                         .resolution = cost->resolution,
                         .memory_bytes = cost->memory,
                         .step_limit = cost->limit,
                         .dropped_springs = (double)hooke_system_count(cost->system, "dropped_springs"),
                         .idle_particles = (double)hooke_system_count(cost->system, "idle")};
}

static const struct hk_column cost_columns[] = {
    HOOKE_COLUMN(
        struct cost_line, method, TEXT, "",
        "method that was timed and whose steps are limited: that of the run, or symplectic Euler where "
        "that chooses its own steps or is not in this build"),
    HOOKE_COLUMN(struct cost_line, step, NUMBER, "s", "step that was timed"),
    HOOKE_COLUMN(struct cost_line, nanoseconds, NUMBER, "ns", "time of one step of the whole scene"),
    HOOKE_COLUMN(struct cost_line, resolution, NUMBER, "ns", "resolution of differences of it"),
    HOOKE_COLUMN(struct cost_line, memory_bytes, COUNT, "B", "memory of system, state and integrator"),
    HOOKE_COLUMN(struct cost_line, step_limit, NUMBER, "s",
                 "largest stable step, as a limit predicts it; infinity where nothing limits it, NaN without "
                 "LAPACK"),
    HOOKE_COLUMN(struct cost_line, dropped_springs, COUNT, "",
                 "springs without stiffness and damping, which commit has left out"),
    HOOKE_COLUMN(struct cost_line, idle_particles, COUNT, "", "pinned particles that nothing touches"),
};

static const struct hk_table cost_table = {
    .name = "cost",
    .doc = "the whole scene",
    .record = 1,
    HOOKE_TABLE_COLUMNS(cost_columns, struct cost_line),
    .read = read_cost,
};

/* ---- ingredients ---- */

struct row_line {
  const char *ingredient, *kind;
  double group, springs, nanoseconds, resolution, memory_bytes, step_limit_without;
};

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_cost *cost = object;
  const struct hk_cost_row *r = &cost->row[row];
  *(struct row_line *)line =
      (struct row_line){.ingredient = hk_cost_row_name(cost, r),
                        .kind = r->kind,
                        .group = r->group >= 0 ? (double)hk_cost_row_group(cost, r) : NAN,
                        .springs = strcmp(r->kind, "springs") == 0 ? (double)r->size : NAN,
                        .nanoseconds = r->nanoseconds,
                        .resolution = r->resolution,
                        .memory_bytes = r->memory,
                        .step_limit_without = r->limit};
}

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN(struct row_line, ingredient, TEXT, "", "name of the group, else the kind"),
    HOOKE_COLUMN(struct row_line, kind, TEXT, "",
                 "springs, bending, altitude, damping, drag, callback or gravity"),
    HOOKE_COLUMN(struct row_line, group, COUNT, "", "number of the group, among those of its kind"),
    HOOKE_COLUMN(struct row_line, springs, COUNT, "", "springs of the group"),
    HOOKE_COLUMN(struct row_line, nanoseconds, NUMBER, "ns",
                 "time of a step that it costs; 0 where nothing can be seen"),
    HOOKE_COLUMN(struct row_line, resolution, NUMBER, "ns", "difference of two equal systems"),
    HOOKE_COLUMN(struct row_line, memory_bytes, COUNT, "B", "memory that it costs"),
    HOOKE_COLUMN(struct row_line, step_limit_without, NUMBER, "s",
                 "largest stable step of the scene without it; infinity where nothing limits it"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "the ingredients that are there; numbers are NaN of those that were not looked at",
    HOOKE_TABLE_COLUMNS(row_columns, struct row_line),
    HOOKE_TABLE_COUNT(struct hk_cost, row_count),
    .read = read_row,
};

/* ---- the list ---- */

const struct hk_table *const hk_cost_tables[HOOKE_COST_TABLES] = {&cost_table, &row_table};
