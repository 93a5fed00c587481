/* Lattice: nx x ny x nz particles over three edges. Particle (x, y, z) is (z*ny + y)*nx + x. */
#include "parts/grid.h"

#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_PART_ORIGIN,
    HOOKE_OPTION("edges", HOOKE_OPTION_VECTORS("m", 3, 3), NULL,
                 "the three edges from the origin, x, y and z, as vectors", .required = 1,
                 .example = "1,0,0;0,1,0;0,0,1"),
    HOOKE_OPTION("size", HOOKE_OPTION_WHOLES(2, INT32_MAX, 3, 3), NULL,
                 "particles along x, along y and along z", .required = 1, .example = "5x5x5"),
    HOOKE_PART_MASS("equally"),
    HOOKE_PART_DENSITY("kg/m^3", "mass over volume, instead of mass: every particle has that of its piece"),
    HOOKE_PART_PINNED(
        "bottom top",
        "particles held still: numbers within the lattice, or words; bottom is the layer at the origin"),
    HOOKE_PART_GRAVITY,
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("structural", "springs between neighbours along x, y and z"),
    HOOKE_PART_FAMILY("shear", "springs along all diagonals of the faces and of the body of every cell"),
    HOOKE_PART_FAMILY("bend", "springs two apart along x, y and z"),
};

static const struct hk_option_table table = {"lattice", HOOKE_OPTION_ROWS(rows)};

static int64_t named(const struct hk_part *part, const char *word, int64_t k) {
  const double *size = hooke_options_numbers(part->options, "size");
  const int64_t layer = (int64_t)size[0] * (int64_t)size[1];
  if (k >= layer) return -1;
  return strcmp(word, "bottom") == 0 ? k : part->count - layer + k;
}

const struct hooke_part_kind hk_part_lattice = {
    &table, hk_grid_build_sized, named, &hk_part_sized,
    "a grid of particles over three edges, with springs along it, across its cells and two apart"};
