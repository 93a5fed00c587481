/* Lattice: nx x ny x nz particles over three edges. Particle (x, y, z) is (z*ny + y)*nx + x. */
#include "parts/part.h"

#include "parts/material.h"
#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
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
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("structural", "springs between neighbours along x, y and z"),
    HOOKE_PART_FAMILY("shear", "springs along all diagonals of the faces and of the body of every cell"),
    HOOKE_PART_FAMILY("bend", "springs two apart along x, y and z"),
};

static const struct hk_option_table table = {"lattice", HOOKE_OPTION_ROWS(rows)};

/* Directions of springs in order, in steps along x, y and z; the second end has the higher number. */
enum { AXES = 3, DIAGONALS = 10 };
static const int32_t axis[AXES][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const int32_t diagonal[DIAGONALS][3] = {{1, 1, 0},  {-1, 1, 0}, {1, 0, 1},  {-1, 0, 1}, {0, 1, 1},
                                               {0, -1, 1}, {1, 1, 1},  {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};

struct lattice {
  int64_t size[3];
  double side[3][3]; /* of a cell, as vectors */
};

static struct lattice lattice_of(const hooke_options *options) {
  const double *size = hooke_options_numbers(options, "size");
  const double *edges = hooke_options_numbers(options, "edges");
  struct lattice lattice;
  for (int a = 0; a < 3; a++) {
    lattice.size[a] = (int64_t)size[a];
    for (int i = 0; i < 3; i++)
      lattice.side[a][i] = edges[3 * a + i] / (size[a] - 1.0);
  }
  return lattice;
}

/* ---- size ---- */

static double springs_along(const struct lattice *lattice, const int32_t *step, int32_t apart) {
  double springs = 1.0;
  for (int a = 0; a < 3; a++)
    springs *= fmax(0.0, (double)(lattice->size[a] - (step[a] ? apart : 0)));
  return springs;
}

/* In doubles, which cannot overflow. */
static struct hk_more size_of(const struct hk_part *part, const struct lattice *lattice) {
  struct hk_more more = {.particles = 1.0, .of = {{.force = &hk_force_springs}}};
  for (int a = 0; a < 3; a++) {
    more.particles *= (double)lattice->size[a];
    more.of[0].count += hk_part_if_family(part, "structural", springs_along(lattice, axis[a], 1));
    more.of[0].count += hk_part_if_family(part, "bend", springs_along(lattice, axis[a], 2));
  }
  for (int d = 0; d < DIAGONALS; d++)
    more.of[0].count += hk_part_if_family(part, "shear", springs_along(lattice, diagonal[d], 1));
  return more;
}

/* ---- particles ---- */

static void place_particles(const hooke_options *options, const struct lattice *lattice, double *position) {
  const double *origin = hooke_options_numbers(options, "origin");
  const double *edges = hooke_options_numbers(options, "edges");
  const int64_t *size = lattice->size;
  for (int64_t z = 0; z < size[2]; z++) {
    const double along_z = (double)z / (double)(size[2] - 1);
    for (int64_t y = 0; y < size[1]; y++) {
      const double along_y = (double)y / (double)(size[1] - 1);
      for (int64_t x = 0; x < size[0]; x++) {
        const double along_x = (double)x / (double)(size[0] - 1);
        for (int i = 0; i < 3; i++)
          *position++ = ((origin[i] + along_x * edges[i]) + along_y * edges[3 + i]) + along_z * edges[6 + i];
      }
    }
  }
}

static double cell_volume(const struct lattice *lattice) {
  const double *x = lattice->side[0], *y = lattice->side[1], *z = lattice->side[2];
  double volume = 0.0;
  for (int i = 0; i < 3; i++)
    volume += x[i] * (y[(i + 1) % 3] * z[(i + 2) % 3] - y[(i + 2) % 3] * z[(i + 1) % 3]);
  return fabs(volume);
}

/* Halved for each pair of faces that the particle is on: 1/2 on a face, 1/4 on an edge, 1/8 at a corner. */
static void share_mass(const struct lattice *lattice, double inner, double *mass) {
  const int64_t *size = lattice->size;
  for (int64_t z = 0; z < size[2]; z++) {
    for (int64_t y = 0; y < size[1]; y++) {
      for (int64_t x = 0; x < size[0]; x++) {
        const int outside = (x % (size[0] - 1) == 0) + (y % (size[1] - 1) == 0) + (z % (size[2] - 1) == 0);
        *mass++ = ldexp(inner, -outside);
      }
    }
  }
}

static int32_t derive_masses(const struct hk_part *part, const struct lattice *lattice) {
  static const char *const name[] = {"mass of an inner particle", "mass of a particle on a face",
                                     "mass of a particle on an edge", "mass of a corner"};
  int wide = 0; /* axes with particles between the two faces */
  for (int a = 0; a < 3; a++)
    wide += lattice->size[a] > 2;
  int32_t status = HOOKE_OK;
  for (int outside = 3 - wide; outside <= 3 && status == HOOKE_OK; outside++) {
    status = hk_system_add_derived(part->system, part->name, NULL, name[outside], "kg",
                                   ldexp(part->inner_mass, -outside));
  }
  return status;
}

static int32_t add_by_density(struct hk_part *part, const struct lattice *lattice, const double *position) {
  const double piece = cell_volume(lattice);
  part->inner_mass = hooke_options_number(part->options, "density") * piece;
  if (!isfinite(part->inner_mass) || !isfinite(1.0 / (0.125 * part->inner_mass))) {
    return hk_fail(HOOKE_BAD_VALUE, "density",
                   "an inner particle stands for %g m^3 and would have a mass of %g kg; allowed: finite "
                   "and > 0, so let the edges of the part span a volume",
                   piece, part->inner_mass);
  }
  double *mass = hk_new(part->count, sizeof(double));
  if (mass == NULL) return HOOKE_NO_MEMORY;
  share_mass(lattice, part->inner_mass, mass);
  int32_t status =
      hooke_system_add_particles(part->system, part->count, position, NULL, part->count, mass, &part->first);
  hk_free(mass);
  return status == HOOKE_OK ? derive_masses(part, lattice) : status;
}

static int32_t add_particles(struct hk_part *part, const struct lattice *lattice, const double *position) {
  int32_t status = hk_part_check_masses(part);
  if (status != HOOKE_OK) return status;
  if (hooke_options_is_set(part->options, "density")) return add_by_density(part, lattice, position);
  part->inner_mass = hk_part_total_mass(part) / (double)part->count;
  return hooke_system_add_particles(part->system, part->count, position, NULL, 1, &part->inner_mass,
                                    &part->first);
}

/* ---- springs ---- */

static double rest_length(const struct lattice *lattice, const int32_t *step, double apart) {
  double vector[3];
  for (int i = 0; i < 3; i++)
    vector[i] = ((double)step[0] * lattice->side[0][i] + (double)step[1] * lattice->side[1][i]) +
                (double)step[2] * lattice->side[2][i];
  return apart * hk_part_length(vector);
}

/* Springs of one direction, one strip a layer. */
static void fill_strips(const struct lattice *lattice, const int32_t *step, int32_t apart, int32_t direction,
                        struct hk_part_strip *strip) {
  const int64_t nx = lattice->size[0], ny = lattice->size[1];
  int64_t low = 0, stride[3] = {1, nx, nx * ny}, jump = 0;
  for (int a = 0; a < 3; a++) {
    if (step[a] < 0) low += stride[a]; /* starts at the other side of the cell */
    jump += (int64_t)step[a] * apart * stride[a];
  }
  for (int64_t z = 0; z < lattice->size[2] - (step[2] ? apart : 0); z++) {
    const int64_t first = low + z * stride[2];
    *strip++ = (struct hk_part_strip){.rows = ny - (step[1] ? apart : 0),
                                      .columns = nx - (step[0] ? apart : 0),
                                      .low = first,
                                      .high = first + jump,
                                      .rest_length = rest_length(lattice, step, apart),
                                      .direction = (enum hk_part_direction)direction};
  }
}

static int32_t add_family(struct hk_part *part, const struct lattice *lattice, const char *family,
                          int32_t count, const int32_t (*step)[3], int32_t apart, int32_t first) {
  struct hk_part_strip *strip = hk_new(count * lattice->size[2], sizeof *strip);
  if (strip == NULL) return HOOKE_NO_MEMORY;
  int32_t strips = 0;
  for (int32_t d = 0; d < count; d++) {
    const int64_t layers = lattice->size[2] - (step[d][2] ? apart : 0);
    fill_strips(lattice, step[d], apart, first + d, strip + strips);
    strips += layers > 0 ? (int32_t)layers : 0;
  }
  const int32_t status = hk_part_add_family(part, family, lattice->size[0], strips, strip);
  hk_free(strip);
  return status;
}

static int32_t add_springs(struct hk_part *part, const struct lattice *lattice) {
  const int32_t along = HOOKE_PART_LATTICE, across = HOOKE_PART_LATTICE + AXES;
  int32_t status = add_family(part, lattice, "structural", AXES, axis, 1, along);
  if (status == HOOKE_OK) status = add_family(part, lattice, "shear", DIAGONALS, diagonal, 1, across);
  if (status == HOOKE_OK) status = add_family(part, lattice, "bend", AXES, axis, 2, along);
  return status;
}

/* ---- the kind ---- */

static int32_t build(struct hk_part *part) {
  const struct lattice lattice = lattice_of(part->options);
  const int64_t *size = lattice.size;
  double *position;
  int32_t status = hk_part_check_edges(hooke_options_numbers(part->options, "edges"), 3);
  if (status != HOOKE_OK) return status;
  status = hk_part_new_positions(part, size_of(part, &lattice), &position, "a lattice of %lld x %lld x %lld",
                                 (long long)size[0], (long long)size[1], (long long)size[2]);
  if (status != HOOKE_OK) return hk_fail_within(status, "size");
  place_particles(part->options, &lattice, position);
  status = add_particles(part, &lattice, position);
  hk_free(position);
  return status == HOOKE_OK ? add_springs(part, &lattice) : status;
}

static int64_t named(const struct hk_part *part, const char *word, int64_t k) {
  const struct lattice lattice = lattice_of(part->options);
  const int64_t layer = lattice.size[0] * lattice.size[1];
  if (k >= layer) return -1;
  return strcmp(word, "bottom") == 0 ? k : part->count - layer + k;
}

const struct hooke_part_kind hk_part_lattice = {
    &table, build, named, &hk_part_sized,
    "a grid of particles over three edges, with springs along it, across its cells and two apart"};
