/* Rope: particles in a line, springs between neighbours (stretch) and between every second one (bend), and
 * bending. */
#include "parts/fluid.h"
#include "parts/grid.h"

#include <stdio.h>

static const struct hk_option_row rows[] = {
    HOOKE_PART_POINT("from", "0,0,0", "where it begins"),
    HOOKE_PART_POINT("to", "1,0,0", "where it ends"),
    HOOKE_OPTION("segments", HOOKE_OPTION_WHOLE(1, INT32_MAX), NULL,
                 "pieces it is cut into; it has one particle more", .required = 1, .example = "24"),
    HOOKE_PART_MASS("equally"),
    HOOKE_PART_DENSITY("kg/m", "mass over length, instead of mass: every particle has that of its piece"),
    HOOKE_PART_PINNED("start end", "particles held still: numbers within the rope, or words"),
    HOOKE_PART_GRAVITY,
    HOOKE_PART_CLAMPED("start end"),
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("stretch", "springs between neighbours"),
    HOOKE_PART_FAMILY("bend", "springs two apart"),
    HOOKE_PART_BENDING("N m^2", "stiffness of the rope as a beam"),
    HOOKE_PART_FLUID(hk_part_rope_fluid),
};

static const struct hk_option_table table = {"rope", HOOKE_OPTION_ROWS(rows)};

static int32_t build(struct hk_part *part) {
  const double *from = hooke_options_numbers(part->options, "from");
  const double *to = hooke_options_numbers(part->options, "to");
  const double span[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const int64_t segments = (int64_t)hooke_options_number(part->options, "segments");
  struct hk_grid grid = {.axes = 1, .size = {segments + 1, 1, 1}, .origin = from, .edges = span, .last = to};
  char what[64];
  snprintf(what, sizeof what, "a rope of %lld segments", (long long)segments);
  return hk_grid_build(part, &grid, "segments", what);
}

const struct hooke_part_kind hk_part_rope = {
    &table, build, hk_part_named_end, &hk_part_sized,
    "particles in a line, with springs between neighbours and two apart"};
