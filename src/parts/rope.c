/* Rope: particles in a line, springs between neighbours (stretch) and between every second one (bend), and
 * bending. */
#include "parts/part.h"

#include "core/memory.h"
#include "core/status.h"

#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_PART_POINT("from", "0,0,0", "where it begins"),
    HOOKE_PART_POINT("to", "1,0,0", "where it ends"),
    HOOKE_OPTION("segments", HOOKE_OPTION_WHOLE(1, INT32_MAX), NULL,
                 "pieces it is cut into; it has one particle more", .required = 1, .example = "24"),
    HOOKE_PART_MASS("equally"),
    HOOKE_PART_DENSITY("kg/m", "mass over length, instead of mass: every particle has that of its piece"),
    HOOKE_PART_PINNED("start end", "particles held still: numbers within the rope, or words"),
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("stretch", "springs between neighbours"),
    HOOKE_PART_FAMILY("bend", "springs two apart"),
    HOOKE_PART_BENDING("N m^2", "stiffness of the rope as a beam"),
};

static const struct hk_option_table table = {"rope", HOOKE_OPTION_ROWS(rows)};

static int32_t build(struct hk_part *part) {
  const double *from = hooke_options_numbers(part->options, "from");
  const double *to = hooke_options_numbers(part->options, "to");
  const int64_t segments = (int64_t)hooke_options_number(part->options, "segments");
  const double span[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};

  const double links = (double)segments;
  const struct hk_more more = {
      .particles = links + 1.0,
      .of = {{&hk_force_springs,
              hk_part_if_family(part, "stretch", links) + hk_part_if_family(part, "bend", links - 1.0)},
             {&hk_force_bending, hooke_options_number(part->options, "bending") > 0.0 ? links - 1.0 : 0.0}}};
  double *position;
  int32_t status =
      hk_part_new_positions(part, more, &position, "a rope of %lld segments", (long long)segments);
  if (status != HOOKE_OK) return hk_fail_within(status, "segments");
  for (int64_t k = 0; k < segments; k++) {
    const double fraction = (double)k / (double)segments;
    for (int i = 0; i < 3; i++)
      position[3 * k + i] = from[i] + fraction * span[i];
  }
  memcpy(position + 3 * segments, to, 3 * sizeof(double));
  const double piece = hk_part_length(span) / (double)segments;
  status = hk_part_add_particles(part, 1, segments + 1, piece, position);
  hk_free(position);

  const struct hk_part_strip stretch = {1, segments, 0, 1, piece, HOOKE_PART_ALONG};
  const struct hk_part_strip bend = {1, segments - 1, 0, 2, 2.0 * piece, HOOKE_PART_ALONG};
  const double stiffness = hooke_options_number(part->options, "bending");
  const struct hk_part_beams beam = {
      1, segments - 1, 1, stiffness / (piece * piece * piece), HOOKE_PART_ALONG, HOOKE_BEAMS_ALONE};
  if (status == HOOKE_OK) status = hk_part_add_family(part, "stretch", segments + 1, 1, &stretch);
  if (status == HOOKE_OK) status = hk_part_add_family(part, "bend", segments + 1, 1, &bend);
  if (status == HOOKE_OK) status = hk_part_add_bending(part, segments + 1, 1, &beam);
  return status;
}

static int64_t named(const struct hk_part *part, const char *word, int64_t k) {
  if (k > 0) return -1;
  return strcmp(word, "start") == 0 ? 0 : part->count - 1;
}

static int32_t cells(const hooke_options *options, int64_t cells[3]) {
  cells[0] = (int64_t)hooke_options_number(options, "segments");
  return 1;
}

static int32_t set_cells(hooke_options *options, const int64_t cells[3]) {
  return hooke_options_set_number(options, "segments", (double)cells[0]);
}

static const struct hk_part_grid grid = {cells, set_cells};

const struct hooke_part_kind hk_part_rope = {
    &table, build, named, &grid, "particles in a line, with springs between neighbours and two apart"};
