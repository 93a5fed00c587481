/* The tables of a cost. */
#include "measure/cost/cost.h"
#include "model/group.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- the whole scene ---- */

HOOKE_READER(double, dropped_springs, struct hk_cost,
             (double)hooke_system_count(it->m->system, "dropped_springs"))
HOOKE_READER(double, idle_particles, struct hk_cost, (double)hooke_system_count(it->m->system, "idle"))

/* ---- ingredients ---- */

/* Number among the groups of its force. */
static double group_of(const struct hk_cost *cost, const struct hk_cost_row *row) {
  if (row->group < 0) return NAN;
  const struct hk_force_row *force = cost->m->system->group[row->group].force;
  return (double)(row->group - hk_system_first_group(cost->m->system, force));
}

HOOKE_READER(const char *, ingredient, struct hk_cost, hk_cost_row_name(it, &it->row[row]))
HOOKE_READER(double, group, struct hk_cost, group_of(it, &it->row[row]))
HOOKE_READER(double, springs, struct hk_cost,
             strcmp(it->row[row].kind, "springs") == 0 ? (double)it->row[row].size : NAN)

/* ---- the tables ---- */

const struct hk_table hk_cost_tables[] = {
    {.name = "cost",
     .doc = "the whole scene",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(
             struct hk_cost, method, TEXT, "",
             "method that was timed and whose steps are limited: that of the run, or symplectic Euler "
             "where that chooses its own steps or is not in this build"),
         HOOKE_COLUMN(struct hk_cost, step, NUMBER, "s", "step that was timed"),
         HOOKE_COLUMN(struct hk_cost, nanoseconds, NUMBER, "ns", "time of one step of the whole scene"),
         HOOKE_COLUMN(struct hk_cost, resolution, NUMBER, "ns", "resolution of differences of it"),
         HOOKE_COLUMN_AS(struct hk_cost, memory, memory_bytes, COUNT, "B",
                         "memory of system, state and integrator"),
         HOOKE_COLUMN_AS(struct hk_cost, limit, step_limit, NUMBER, "s",
                         "largest stable step, as a limit predicts it; infinity where nothing limits it, "
                         "NaN without LAPACK"),
         HOOKE_COLUMN_BY(dropped_springs, COUNT, "",
                         "springs without stiffness and damping, which commit has left out"),
         HOOKE_COLUMN_BY(idle_particles, COUNT, "", "pinned particles that nothing touches"))},
    {.name = "rows",
     .doc = "the ingredients that are there; numbers are NaN of those that were not looked at",
     HOOKE_TABLE_ROWS(struct hk_cost, row, row_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(ingredient, TEXT, "", "name of the group, else the kind"),
         HOOKE_COLUMN(
             struct hk_cost_row, kind, TEXT, "",
             "springs, bending, altitude, fluid_drag, damping, drag, quadratic_drag, wind, callback or gravity"),
         HOOKE_COLUMN_BY(group, COUNT, "", "number of the group, among those of its kind"),
         HOOKE_COLUMN_BY(springs, COUNT, "", "springs of the group"),
         HOOKE_COLUMN(struct hk_cost_row, nanoseconds, NUMBER, "ns",
                      "time of a step that it costs; 0 where nothing can be seen"),
         HOOKE_COLUMN(struct hk_cost_row, resolution, NUMBER, "ns", "difference of two equal systems"),
         HOOKE_COLUMN_AS(struct hk_cost_row, memory, memory_bytes, COUNT, "B", "memory that it costs"),
         HOOKE_COLUMN_AS(struct hk_cost_row, limit, step_limit_without, NUMBER, "s",
                         "largest stable step of the scene without it; infinity where nothing limits it"))},
    {.name = NULL}};
