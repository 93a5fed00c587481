/* The tables of a rest. */
#include "measure/rest/rest.h"
#include "model/particles.h"

#include <stddef.h>

static const char *status_of(const struct hk_resting *r) {
  return r->position == NULL ? NULL : r->rest.lack == HOOKE_RESTS ? "at rest" : "none";
}

HOOKE_READER(const char *, status, struct hk_resting, status_of(it))
HOOKE_READER(const double *, position, struct hk_resting, it->position)
HOOKE_COUNTER(length, struct hk_resting, 3 * it->m->system->particle_count)

const struct hk_table hk_rest_tables[] = {
    {.name = "rest",
     .doc = "the position of rest",
     .record = 1,
     .length = length,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(status, TEXT, "", "at rest, or none"),
         HOOKE_COLUMN_AS(
             struct hk_resting, rest.residual, residual, NUMBER, "N",
             "largest force that remains on a free particle or a rigid body, of a torque over its "
             "largest arm"),
         HOOKE_COLUMN_AS(struct hk_resting, rest.largest_force, largest_force, NUMBER, "N",
                         "largest force along a spring, in absolute value"),
         HOOKE_COLUMN(struct hk_resting, minimum, FLAG, "",
                      "1: every small displacement raises the energy or leaves it; 0: some lowers it"),
         HOOKE_COLUMN_AS(struct hk_resting, modes.zero_modes, zero_modes, COUNT, "",
                         "free motions without stiffness"),
         HOOKE_COLUMN_AS(struct hk_resting, rest.moved, moved, NUMBER, "m",
                         "how far the farthest particle came from the start"),
         HOOKE_COLUMN_AS(struct hk_resting, rest.steps, steps, COUNT, "", "steps of the search"),
         HOOKE_COLUMN_AS(struct hk_resting, rest.iterations, iterations, COUNT, "",
                         "corrections of Newton's method"),
         HOOKE_COLUMN_AS(struct hk_resting, rest.force_evaluations, force_evaluations, COUNT, "",
                         "evaluations of all forces"),
         HOOKE_COLUMN_BY(position, SERIES, "m",
                         "where particles rest, or the search ended: 3n, particle by particle"))},
    {.name = "watched",
     .doc = "the watched quantities at rest",
     HOOKE_TABLE_ROWS(struct hk_resting, value, watched.count),
     HOOKE_TABLE_COLUMNS(HOOKE_COLUMN(struct hk_rest_watched, quantity, TEXT, "", "as it was asked for"),
                         HOOKE_COLUMN(struct hk_rest_watched, unit, TEXT, "", "its unit"),
                         HOOKE_COLUMN(struct hk_rest_watched, value, NUMBER, "",
                                      "in that unit; NaN of a period, and where there is no rest"))},
    {.name = NULL}};
