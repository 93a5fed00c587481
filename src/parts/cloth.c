/* Cloth: nu x nv particles over two edges. Particle (r, c) is r*nu + c, at origin + c/(nu-1) u + r/(nv-1) v.
 */
#include "parts/part.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
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
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("structural", "springs between neighbours along u and v"),
    HOOKE_PART_FAMILY("shear", "springs along both diagonals of every cell"),
    HOOKE_PART_FAMILY("bend", "springs two apart along u and v"),
    HOOKE_PART_BENDING("N m", "stiffness of a strip of the cloth as a beam, over its width"),
};

static const struct hk_option_table table = {"cloth", HOOKE_OPTION_ROWS(rows)};

static void place_particles(const double *origin, const double *edges, int64_t nu, int64_t nv,
                            double *position) {
  for (int64_t r = 0; r < nv; r++) {
    const double along_v = (double)r / (double)(nv - 1);
    for (int64_t c = 0; c < nu; c++) {
      const double along_u = (double)c / (double)(nu - 1);
      double *p = position + 3 * (r * nu + c);
      for (int i = 0; i < 3; i++)
        p[i] = origin[i] + along_u * edges[i] + along_v * edges[3 + i];
    }
  }
}

/* One cell of the cloth. */
struct cell {
  int64_t nu, nv;
  double u, v, along, across, area; /* sides, diagonals */
};

static struct cell find_cell(const double *edges, int64_t nu, int64_t nv) {
  double u[3], v[3], along[3], across[3], normal[3];
  for (int i = 0; i < 3; i++) {
    u[i] = edges[i] / (double)(nu - 1);
    v[i] = edges[3 + i] / (double)(nv - 1);
    along[i] = u[i] + v[i];
    across[i] = u[i] - v[i];
  }
  for (int i = 0; i < 3; i++)
    normal[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  return (struct cell){.nu = nu,
                       .nv = nv,
                       .u = hk_part_length(edges) / (double)(nu - 1),
                       .v = hk_part_length(edges + 3) / (double)(nv - 1),
                       .along = hk_part_length(along),
                       .across = hk_part_length(across),
                       .area = hk_part_length(normal)};
}

static int32_t add_springs(struct hk_part *part, const struct cell *cell) {
  const int64_t nu = cell->nu, nv = cell->nv;
  const struct hk_part_strip structural[] = {{nv, nu - 1, 0, 1, cell->u, HOOKE_PART_U},
                                             {nv - 1, nu, 0, nu, cell->v, HOOKE_PART_V}};
  const struct hk_part_strip shear[] = {{nv - 1, nu - 1, 0, nu + 1, cell->along, HOOKE_PART_DIAGONAL},
                                        {nv - 1, nu - 1, 1, nu, cell->across, HOOKE_PART_OTHER_DIAGONAL}};
  const struct hk_part_strip bend[] = {{nv, nu - 2, 0, 2, 2.0 * cell->u, HOOKE_PART_U},
                                       {nv - 2, nu, 0, 2 * nu, 2.0 * cell->v, HOOKE_PART_V}};
  int32_t status = hk_part_add_family(part, "structural", nu, 2, structural);
  if (status == HOOKE_OK) status = hk_part_add_family(part, "shear", nu, 2, shear);
  if (status == HOOKE_OK) status = hk_part_add_family(part, "bend", nu, 2, bend);
  return status;
}

/* A line is a beam of the width between its neighbours, perpendicular to it. */
static int32_t add_bending(struct hk_part *part, const struct cell *cell) {
  const double stiffness = hooke_options_number(part->options, "bending"), u = cell->u, v = cell->v;
  const struct hk_part_beams beams[] = {
      {cell->nv, cell->nu - 2, 1, stiffness * (cell->area / u) / (u * u * u), HOOKE_PART_U, HOOKE_BEAMS_ROWS},
      {cell->nv - 2, cell->nu, cell->nu, stiffness * (cell->area / v) / (v * v * v), HOOKE_PART_V,
       HOOKE_BEAMS_COLUMNS}};
  return hk_part_add_bending(part, cell->nu, 2, beams);
}

/* In doubles, which cannot overflow. */
static struct hk_more size_of(const struct hk_part *part, double nu, double nv) {
  const double along = (nu - 1.0) * nv + nu * (nv - 1.0), across = 2.0 * (nu - 1.0) * (nv - 1.0);
  const double two_apart = fmax(0.0, nu - 2.0) * nv + nu * fmax(0.0, nv - 2.0);
  const double springs = hk_part_if_family(part, "structural", along) +
                         hk_part_if_family(part, "shear", across) +
                         hk_part_if_family(part, "bend", two_apart);
  const double triples = hooke_options_number(part->options, "bending") > 0.0 ? two_apart : 0.0;
  return (struct hk_more){.particles = nu * nv,
                          .of = {{&hk_force_springs, springs}, {&hk_force_bending, triples}}};
}

static int32_t build(struct hk_part *part) {
  const double *size = hooke_options_numbers(part->options, "size");
  const double *edges = hooke_options_numbers(part->options, "edges");
  const int64_t nu = (int64_t)size[0], nv = (int64_t)size[1];

  double *position;
  int32_t status = hk_part_check_edges(edges, 2);
  if (status != HOOKE_OK) return status;
  status = hk_part_new_positions(part, size_of(part, size[0], size[1]), &position,
                                 "a cloth of %lld x %lld particles", (long long)nu, (long long)nv);
  if (status != HOOKE_OK) return hk_fail_within(status, "size");
  const struct cell cell = find_cell(edges, nu, nv);
  place_particles(hooke_options_numbers(part->options, "origin"), edges, nu, nv, position);
  status = hk_part_add_particles(part, nv, nu, cell.area, position);
  hk_free(position);
  if (status == HOOKE_OK) status = add_springs(part, &cell);
  return status == HOOKE_OK ? add_bending(part, &cell) : status;
}

static int64_t named(const struct hk_part *part, const char *word, int64_t k) {
  const int64_t nu = (int64_t)hooke_options_numbers(part->options, "size")[0];
  if (strcmp(word, "top") == 0) return k < nu ? k : -1;
  const int64_t corner[] = {0, nu - 1, part->count - nu, part->count - 1};
  return k < (strcmp(word, "top-corners") == 0 ? 2 : 4) ? corner[k] : -1;
}

const struct hooke_part_kind hk_part_cloth = {
    &table, build, named, &hk_part_sized,
    "a grid of particles over two edges, with springs along it, across its cells and two apart"};
