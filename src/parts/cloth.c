/* Cloth: nu x nv particles over two edges. Particle (r, c) is r*nu + c, at origin + c/(nu-1) u + r/(nv-1) v.
 */
#include "parts/fluid.h"
#include "parts/grid.h"

#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_PART_ORIGIN,
    HOOKE_OPTION("edges", HOOKE_OPTION_VECTORS("m", 2, 2), NULL,
                 "the two edges from the origin, u and v, as vectors", .required = 1,
                 .example = "1,0,0;0,0,1"),
    HOOKE_OPTION("size", HOOKE_OPTION_WHOLES(2, INT32_MAX, 2, 2), NULL, "particles along u and along v",
                 .required = 1, .example = "16x16"),
    HOOKE_PART_MASS("equally"),
    HOOKE_PART_DENSITY("kg/m^2", "mass over area, instead of mass: every particle has that of its piece"),
    HOOKE_PART_PINNED(
        "corners top top-corners",
        "particles held still: numbers within the cloth, or words; top is the row at the origin"),
    HOOKE_PART_GRAVITY,
    HOOKE_PART_CLAMPED("top left right bottom"),
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("structural", "springs between neighbours along u and v"),
    HOOKE_PART_FAMILY("shear", "springs along both diagonals of every cell"),
    HOOKE_PART_FAMILY("bend", "springs two apart along u and v"),
    HOOKE_PART_BENDING("N m", "stiffness of a strip of the cloth as a beam, over its width"),
    HOOKE_PART_FLUID(hk_part_surface_fluid),
};

static const struct hk_option_table table = {"cloth", HOOKE_OPTION_ROWS(rows)};

static int64_t named(const struct hk_part *part, const char *word, int64_t k) {
  const int64_t nu = (int64_t)hooke_options_numbers(part->options, "size")[0];
  if (strcmp(word, "top") == 0) return k < nu ? k : -1;
  const int64_t corner[] = {0, nu - 1, part->count - nu, part->count - 1};
  return k < (strcmp(word, "top-corners") == 0 ? 2 : 4) ? corner[k] : -1;
}

const struct hooke_part_kind hk_part_cloth = {
    &table, hk_grid_build_sized, named, &hk_part_sized,
    "a grid of particles over two edges, with springs along it, across its cells and two apart"};
