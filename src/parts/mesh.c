/* Mesh: particles at the vertices of a surface, springs along its edges and across them. */
#include "parts/part.h"

#include "parts/fluid.h"
#include "parts/material.h"
#include "parts/surface.h"
#include "core/memory.h"
#include "core/status.h"
#include "model/group.h"
#include "model/vector3.h"

#include <math.h>

static const struct hk_option_row transform_rows[] = {
    HOOKE_OPTION("scale", HOOKE_OPTION_POSITIVE(NULL), "1", "factor on the coordinates"),
    HOOKE_OPTION("translate", HOOKE_OPTION_VECTOR("m"), "0,0,0", "vector that is added then"),
};

static const struct hk_option_table transform = {"transform", HOOKE_OPTION_ROWS(transform_rows)};

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("file", .type = HOOKE_OPTION_TEXT, NULL, "OBJ file, instead of vertices and triangles",
                 .example = "mesh.obj"),
    HOOKE_OPTION("vertices", HOOKE_OPTION_VECTORS("m", 3, 0), NULL, "one row a vertex, before the transform"),
    HOOKE_OPTION("triangles", HOOKE_OPTION_WHOLES(0, INT32_MAX, 3, 0), NULL,
                 "three numbers of vertices each, from 0", .columns = 3),
    HOOKE_OPTION("transform", .type = HOOKE_OPTION_FAMILY, NULL,
                 "from the coordinates of the vertices to metres", .family = &transform),
    HOOKE_OPTION("weld", HOOKE_OPTION_NOT_NEGATIVE("m"), "0",
                 "distance up to which vertices are one particle; 0: those at the same place"),
    HOOKE_PART_MASS("by area"),
    HOOKE_PART_DENSITY("kg/m^2", "mass over area, instead of mass"),
    HOOKE_OPTION("pinned", HOOKE_OPTION_WHOLES(0, INT32_MAX, 0, 0), NULL, "numbers of particles held still"),
    HOOKE_PART_GRAVITY,
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("structural", "springs along the edges"),
    HOOKE_PART_FAMILY("bend", "springs between the vertices opposite to each other across an edge"),
    HOOKE_PART_FLUID(hk_part_surface_fluid),
};

static const struct hk_option_table table = {"mesh", HOOKE_OPTION_ROWS(rows)};

int32_t hooke_mesh_set(hooke_options *options, int64_t vertex_count, const double *vertices,
                       int64_t triangle_count, const int64_t *triangles) {
  int32_t status = hk_options_require(options, &table, "options", "mesh");
  if (status != HOOKE_OK) return status;
  if (vertex_count < 0 || triangle_count < 0 || vertex_count > INT32_MAX || triangle_count > INT32_MAX ||
      !vertices || !triangles) {
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "%lld vertices and %lld triangles given; allowed: arrays of both, of up to 2147483647 rows",
        (long long)vertex_count, (long long)triangle_count);
  }
  double *corner = hk_new(3 * triangle_count, sizeof *corner);
  if (corner == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < 3 * triangle_count; k++)
    corner[k] = (double)triangles[k];
  status = hooke_options_set_numbers(options, "vertices", 3 * vertex_count, vertices);
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "triangles", 3 * triangle_count, corner);
  hk_free(corner);
  return status;
}

static int32_t check_given(const hooke_options *options) {
  const int vertices = hooke_options_is_set(options, "vertices");
  if (hooke_options_is_set(options, "file")) {
    return hk_fail(HOOKE_BAD_VALUE, "file",
                   "\"%s\" is not read here; hooke_mesh_read() puts the "
                   "vertices and triangles of a file into the options",
                   hooke_options_text(options, "file"));
  }
  if (vertices && hooke_options_is_set(options, "triangles")) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, vertices ? "triangles" : "vertices",
                 "is missing; allowed: a file, or vertices and triangles");
}

/* ---- particles ---- */

static int32_t derive_range(const struct hk_part *part, const char *family, const char *least,
                            const char *most, const char *unit, int64_t count, const double *value) {
  double low = value[0], high = value[0];
  for (int64_t k = 1; k < count; k++) {
    low = fmin(low, value[k]);
    high = fmax(high, value[k]);
  }
  const int32_t status = hk_part_derive(part, family, least, unit, low);
  return status == HOOKE_OK ? hk_part_derive(part, family, most, unit, high) : status;
}

/* Replaces the areas by masses. */
static void find_masses(const struct hk_part *part, const struct hk_surface *surface, double *mass) {
  const int by_density = hooke_options_is_set(part->options, "density");
  const double given = by_density ? hooke_options_number(part->options, "density") : hk_part_total_mass(part);
  double area = 0.0;
  for (int64_t v = 0; v < surface->vertex_count; v++)
    area += surface->area[v];
  for (int64_t v = 0; v < surface->vertex_count; v++)
    mass[v] = by_density ? given * surface->area[v] : given * (surface->area[v] / area);
}

static int32_t add_particles(struct hk_part *part, const struct hk_surface *surface) {
  int32_t status = hk_part_check_masses(part);
  if (status != HOOKE_OK) return status;
  double *mass = hk_new(surface->vertex_count, sizeof(double));
  if (mass == NULL) return HOOKE_NO_MEMORY;
  find_masses(part, surface, mass);
  status = hooke_system_add_particles(part->system, part->count, surface->position, NULL, part->count, mass,
                                      &part->first);
  if (status == HOOKE_OK && hooke_options_is_set(part->options, "density")) {
    status = derive_range(part, NULL, "mass of the lightest particle", "mass of the heaviest particle", "kg",
                          part->count, mass);
  }
  hk_free(mass);
  return status;
}

/* ---- springs ---- */

static int32_t add_family(struct hk_part *part, const char *family, int64_t count, const int64_t *ends) {
  double *rest_length = hk_new(count, sizeof(double));
  if (rest_length == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++) {
    const double *a = part->system->position + 3 * ends[2 * k],
                 *b = part->system->position + 3 * ends[2 * k + 1];
    rest_length[k] = hk_length3((const double[]){a[0] - b[0], a[1] - b[1], a[2] - b[2]});
  }
  const int32_t status = hk_part_add_pairs(part, family, count, ends, rest_length);
  hk_free(rest_length);
  if (status != HOOKE_OK || count == 0 || !hk_part_is_given(part, family, "damping_ratio")) return status;
  return derive_range(part, family, "smallest gamma", "largest gamma", "N s/m", count,
                      hk_system_last_group(part->system, &hk_force_springs)->number[HOOKE_GAMMA]);
}

static int32_t add_springs(struct hk_part *part, const struct hk_surface *surface) {
  int64_t *ends = hk_new(2 * surface->edge_count, sizeof *ends), bends = 0;
  if (ends == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < surface->edge_count; k++) {
    ends[2 * k] = part->first + surface->edge[k].low;
    ends[2 * k + 1] = part->first + surface->edge[k].high;
  }
  int32_t status = add_family(part, "structural", surface->edge_count, ends);
  for (int64_t k = 0; k < surface->edge_count; k++) {
    const int32_t a = surface->edge[k].across[0], b = surface->edge[k].across[1];
    if (b < 0) continue;
    ends[2 * bends] = part->first + (a < b ? a : b);
    ends[2 * bends++ + 1] = part->first + (a < b ? b : a);
  }
  if (status == HOOKE_OK) status = add_family(part, "bend", bends, ends);
  hk_free(ends);
  return status;
}

static int32_t add_fluid_drag(const struct hk_part *part, const struct hk_surface *surface) {
  if (!hk_options_has_family(part->options, "fluid_drag")) return HOOKE_OK;
  int64_t *corner = hk_new(3 * surface->triangle_count, sizeof *corner);
  if (corner == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < 3 * surface->triangle_count; k++)
    corner[k] = part->first + surface->triangle[k];
  const int32_t status = hk_part_add_fluid_drag(part, surface->triangle_count, corner);
  hk_free(corner);
  return status;
}

/* ---- the kind ---- */

static int32_t check_space(const struct hk_part *part, const struct hk_surface *surface) {
  const double edges = (double)surface->edge_count;
  const struct hk_more more = {
      .particles = (double)surface->vertex_count,
      .of = {{&hk_force_springs,
              hk_part_if_family(part, "structural", edges) + hk_part_if_family(part, "bend", edges)},
             {&hk_force_fluid, hk_part_if_family(part, "fluid_drag", (double)surface->triangle_count)}}};
  const int32_t status = hk_system_check_size(part->system, more, "the mesh");
  return status == HOOKE_OK ? status : hk_fail_within(status, "vertices");
}

static int32_t build(struct hk_part *part) {
  struct hk_surface surface;
  int32_t status = check_given(part->options);
  if (status != HOOKE_OK) return status;
  status = hk_surface_create(part->options, NULL, &surface);
  if (status == HOOKE_OK) status = check_space(part, &surface);
  part->count = surface.vertex_count;
  if (status == HOOKE_OK) status = add_particles(part, &surface);
  if (status == HOOKE_OK) {
    const int64_t given = hooke_options_number_count(part->options, "vertices") / 3;
    if (given > part->count)
      status = hk_part_derive(part, NULL, "vertices welded to others", "", (double)(given - part->count));
  }
  if (status == HOOKE_OK) status = add_springs(part, &surface);
  if (status == HOOKE_OK) status = add_fluid_drag(part, &surface);
  hk_surface_release(&surface);
  return status;
}

const struct hooke_part_kind hk_part_mesh = {
    &table, build, NULL, NULL, "a surface of triangles, with springs along its edges and across them"};
