/* Particle (x, y, z) of a grid is (z*ny + y)*nx + x. */
#include "parts/grid.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force/bending.h"
#include "model/force/spring.h"
#include "model/vector3.h"
#include "parts/fluid.h"
#include "parts/material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Directions of springs in order, in steps along the axes; the second end has the higher number. The
 * diagonals of a plane are the first two. */
static const int32_t axis[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const int32_t diagonal[][3] = {{1, 1, 0},  {-1, 1, 0}, {1, 0, 1},  {-1, 0, 1}, {0, 1, 1},
                                      {0, -1, 1}, {1, 1, 1},  {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};
enum { MOST_DIRECTIONS = sizeof diagonal / sizeof diagonal[0] };
static const int32_t diagonals[] = {0, 0, 2, MOST_DIRECTIONS}; /* by the number of axes */

/* Families in the order of their groups, as far as a kind has them; springs join points `apart`. */
static const struct family {
  const char *name;
  int32_t across, apart;
} families[] = {{"stretch", 0, 1}, {"structural", 0, 1}, {"shear", 1, 1}, {"bend", 0, 2}};
enum { FAMILIES = sizeof families / sizeof families[0] };

static const double FLAT = 1e-12; /* of unit edges: area, volume */

/* ---- cells ---- */

/* Runs depend on every bit of these: a lattice has always had the lengths of its sides, the others their part
 * of an edge. */
static void find_cell(struct hk_grid *grid) {
  for (int a = 0; a < grid->axes; a++) {
    const double cells = (double)(grid->size[a] - 1), *edge = grid->edges + 3 * a;
    for (int i = 0; i < 3; i++)
      grid->side[a][i] = edge[i] / cells;
    grid->length[a] = grid->axes == 3 ? hk_length3(grid->side[a]) : hk_length3(edge) / cells;
  }
}

/* Length, area or volume of a cell, which an inner particle stands for. */
static double piece_of(const struct hk_grid *grid) {
  double normal[3], volume = 0.0;
  if (grid->axes == 1) return grid->length[0];
  hk_cross3(grid->side[grid->axes - 2], grid->side[grid->axes - 1], normal);
  if (grid->axes == 2) return hk_length3(normal);
  for (int i = 0; i < 3; i++)
    volume += grid->side[0][i] * normal[i];
  return fabs(volume);
}

/* ---- size ---- */

/* Numbers of springs or triples of one direction, in doubles, which cannot overflow. */
static double members_along(const struct hk_grid *grid, const int32_t *step, int32_t apart) {
  double members = 1.0;
  for (int a = 0; a < grid->axes; a++)
    members *= fmax(0.0, (double)(grid->size[a] - (step[a] ? apart : 0)));
  return members;
}

static int32_t directions_of(const struct hk_grid *grid, const struct family *family) {
  return family->across ? diagonals[grid->axes] : grid->axes;
}

static const int32_t *step_of(const struct family *family, int32_t direction) {
  return family->across ? diagonal[direction] : axis[direction];
}

/* Segments of a rope, triangles of a cloth. */
static double pieces_of(const struct hk_grid *grid) {
  const double cells = (double)(grid->size[0] - 1);
  return grid->axes == 1 ? cells : 2.0 * cells * (double)(grid->size[1] - 1);
}

static struct hk_more size_of(const struct hk_part *part, const struct hk_grid *grid) {
  struct hk_more more = {.particles = 1.0,
                         .of = {{.force = &hk_force_springs},
                                {.force = &hk_force_bending},
                                {&hk_force_fluid, hk_part_if_family(part, "fluid_drag", pieces_of(grid))}}};
  for (int a = 0; a < grid->axes; a++) {
    more.particles *= (double)grid->size[a];
    if (hooke_options_number(part->options, "bending") > 0.0)
      more.of[1].count += members_along(grid, axis[a], 2);
  }
  for (const struct family *family = families; family < families + FAMILIES; family++) {
    for (int32_t d = 0; d < directions_of(grid, family); d++)
      more.of[0].count +=
          hk_part_if_family(part, family->name, members_along(grid, step_of(family, d), family->apart));
  }
  return more;
}

/* ---- particles and springs ---- */

static void place_particles(const struct hk_grid *grid, int64_t count, double *position) {
  for (int64_t k = 0; k < count; k++) {
    int64_t at[3];
    hk_part_point(grid->size, k, grid->size, at);
    for (int i = 0; i < 3; i++) {
      double *x = &position[3 * k + i];
      *x = grid->origin[i];
      for (int a = 0; a < grid->axes; a++)
        *x += (double)at[a] / (double)(grid->size[a] - 1) * grid->edges[3 * a + i];
      if (grid->last && k == count - 1) *x = grid->last[i];
    }
  }
}

/* Springs of one direction: spring (x, y, z) of `count` along each axis joins the points `low` and `high`
 * beyond point (x, y, z), low < high. All have one rest length, equal to the bit. */
struct strip {
  int64_t count[3], springs, low, high;
  double rest_length;
};

static struct strip strip_of(const struct hk_grid *grid, const int32_t *step, int32_t apart) {
  struct strip strip = {.springs = 1};
  double vector[3] = {0.0};
  int64_t stride = 1;
  for (int a = 0; a < 3; stride *= grid->size[a++]) {
    strip.count[a] = grid->size[a] - (step[a] ? apart : 0);
    strip.springs *= strip.count[a];
    if (step[a] < 0) strip.low += stride; /* starts at the other side of the cell */
    strip.high += step[a] * apart * stride;
    hk_add3((double)step[a], grid->side[a], vector);
  }
  strip.high += strip.low;
  strip.rest_length = apart * hk_length3(vector);
  return strip;
}

static void join(const struct hk_part *part, const struct hk_grid *grid, const struct strip *strip,
                 int64_t *ends, double *rest_length) {
  for (int64_t k = 0, x[3]; k < strip->springs; k++) {
    const int64_t at = part->first + hk_part_point(strip->count, k, grid->size, x);
    *ends++ = at + strip->low;
    *ends++ = at + strip->high;
    *rest_length++ = strip->rest_length;
  }
}

#define DIRECTIONS(of)                                                                                       \
  of, of " along u", of " along v", of " along u + v", of " along u - v", /* a lattice: */                   \
      of " along x", of " along y", of " along z", of " along x + y", of " along x - y", of " along x + z",  \
      of " along x - z", of " along y + z", of " along y - z", of " along x + y + z", of " along x - y - z", \
      of " along x - y + z", of " along x + y - z"

/* Records one spring of each direction of the group added last. */
static int32_t derive_springs(const struct hk_part *part, const struct hk_grid *grid,
                              const struct family *family, const struct strip *strip) {
  static const char *const kappa[] = {DIRECTIONS("kappa")}, *const gamma[] = {DIRECTIONS("gamma")};
  static const int32_t first[] = {0, 0, 1, 5}; /* by the number of axes */
  const int32_t own = first[grid->axes] + (family->across ? grid->axes : 0);
  int32_t status = HOOKE_OK;
  int64_t k = 0;
  for (int32_t d = 0; d < directions_of(grid, family) && status == HOOKE_OK; k += strip[d++].springs)
    if (strip[d].springs > 0)
      status = hk_part_derive_spring(part, family->name, k, kappa[own + d], gamma[own + d]);
  return status;
}

static int32_t add_family(struct hk_part *part, const struct hk_grid *grid, const struct family *family) {
  const int32_t directions = directions_of(grid, family);
  struct strip strip[MOST_DIRECTIONS];
  int64_t count = 0, done = 0;
  if (!hk_options_has_family(part->options, family->name)) return HOOKE_OK;
  for (int32_t d = 0; d < directions; count += strip[d++].springs) {
    strip[d] = strip_of(grid, step_of(family, d), family->apart);
    if (!family->across) strip[d].rest_length = family->apart * grid->length[d];
  }
  int64_t *ends = hk_new(2 * count, sizeof(int64_t));
  double *rest_length = hk_new(count, sizeof(double));
  int32_t status = ends && rest_length ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int32_t d = 0; d < directions && status == HOOKE_OK; done += strip[d++].springs)
    join(part, grid, &strip[d], ends + 2 * done, rest_length + done);
  if (status == HOOKE_OK) status = hk_part_add_pairs(part, family->name, count, ends, rest_length);
  hk_free(ends);
  hk_free(rest_length);
  if (status != HOOKE_OK || !hk_part_is_given(part, family->name, "damping_ratio")) return status;
  return derive_springs(part, grid, family, strip);
}

/* ---- bending ---- */

static int32_t derive_beams(const struct hk_part *part, const struct hk_grid *grid, int along, double c) {
  static const char *const inner[] = {"c along u", "c along v"};
  static const char *const edge[] = {"c along u at an edge", "c along v at an edge"};
  if (grid->axes == 1) return hk_part_derive(part, "bending", "c", "N/m", c);
  int32_t status =
      grid->size[1 - along] > 2 ? hk_part_derive(part, "bending", inner[along], "N/m", c) : HOOKE_OK;
  return status == HOOKE_OK ? hk_part_derive(part, "bending", edge[along], "N/m", 0.5 * c) : status;
}

static int32_t check_beams(double coefficient) {
  if (coefficient > 0.0 && coefficient <= 1e300) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "bending",
                 "its triples would have a coefficient of %g N/m; allowed: > 0 up to 1e300, so let the "
                 "ends and edges of the part lie apart",
                 coefficient);
}

static double beam_coefficient(const struct hk_part *part, const struct hk_grid *grid, int along) {
  const double l = grid->length[along], width = grid->axes == 1 ? 1.0 : piece_of(grid) / l;
  return hooke_options_number(part->options, "bending") * width / (l * l * l);
}

/* Lines of the grid as parallel beams. A line of a cloth is a beam of the width between its neighbours,
 * perpendicular to it; at an edge, of half of that. */
static int32_t add_beams(const struct hk_part *part, const struct hk_grid *grid, int along, int64_t *triple,
                         double *coefficient, int64_t *done) {
  const double c = beam_coefficient(part, grid, along);
  const struct strip strip = strip_of(grid, axis[along], 2);
  const int64_t end = *done + strip.springs;
  int32_t status = end > *done ? check_beams(c) : HOOKE_OK;
  if (status == HOOKE_OK && end > *done) status = derive_beams(part, grid, along, c);
  for (int64_t k = 0; *done < end; k++, (*done)++) {
    int64_t x[3];
    const int64_t at = part->first + hk_part_point(strip.count, k, grid->size, x);
    for (int e = 0; e < 3; e++)
      triple[3 * *done + e] = at + e * (strip.high / 2);
    const int outside = grid->axes > 1 && x[1 - along] % (grid->size[1 - along] - 1) == 0;
    coefficient[*done] = outside ? 0.5 * c : c;
  }
  return status;
}

static int32_t add_triples(const struct hk_part *part, const struct hk_grid *grid, int64_t *triple,
                           double *coefficient) {
  int64_t done = 0;
  int32_t status = HOOKE_OK;
  for (int a = 0; a < grid->axes && status == HOOKE_OK; a++)
    status = add_beams(part, grid, a, triple, coefficient, &done);
  char *name = hk_part_group_name(part, "bending");
  if (name == NULL) return HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    status = hk_system_add_bending(part->system,
                                   &(struct hk_addition){&hk_force_bending, name, done, triple, NULL, 1},
                                   done, coefficient);
  hk_free(name);
  return status;
}

static int32_t add_bending(const struct hk_part *part, const struct hk_grid *grid) {
  const int64_t triples = (int64_t)size_of(part, grid).of[1].count;
  if (triples == 0) return HOOKE_OK;
  int64_t *triple = hk_new(3 * triples, sizeof(int64_t));
  double *coefficient = hk_new(triples, sizeof(double));
  int32_t status = HOOKE_NO_MEMORY;
  if (triple && coefficient) status = add_triples(part, grid, triple, coefficient);
  hk_free(triple);
  hk_free(coefficient);
  return status;
}

/* ---- drag in a fluid ---- */

/* Segments, or cells cut along (r, c)-(r + 1, c + 1). */
static int32_t add_fluid_drag(const struct hk_part *part, const struct hk_grid *grid) {
  const int64_t pieces = (int64_t)size_of(part, grid).of[2].count, nu = grid->size[0];
  int64_t *corner = pieces > 0 ? hk_new(3 * pieces, sizeof *corner) : NULL;
  if (corner == NULL) return pieces > 0 ? HOOKE_NO_MEMORY : HOOKE_OK;
  for (int64_t k = 0; k < pieces; k++) {
    const int64_t cell = grid->axes == 1 ? k : k / 2, at = part->first + cell + cell / (nu - 1);
    const int64_t ends[3][3] = {{0, 1, 1}, {0, 1, nu + 1}, {0, nu + 1, nu}};
    for (int e = 0; e < 3; e++)
      corner[3 * k + e] = grid->axes == 1 ? part->first + k + ends[0][e] : at + ends[1 + k % 2][e];
  }
  const int32_t status = hk_part_add_fluid_drag(part, pieces, corner);
  hk_free(corner);
  return status;
}

/* ---- clamps ---- */

/* Where a word clamps the lines along an axis: at their first particle, or at their last. */
static const struct clamp {
  const char *word;
  int32_t along, last;
} clamps[] = {{"start", 0, 0}, {"end", 0, 1}, {"left", 0, 0},
              {"right", 0, 1}, {"top", 1, 0}, {"bottom", 1, 1}};

/* A line is pinned at its end q_0, and goes on beyond it by a fixed particle q_0 - l t: with t the direction
 * as built, its triple of twice the coefficient is a spring of no length of its next particle, to where that
 * was built. The single coefficient would leave an error of order 1 at the tip of a cantilever. */
static int32_t clamp_lines(const struct hk_part *part, const struct hk_grid *grid, const struct clamp *clamp,
                           int64_t *next, double *stiffness) {
  const int a = clamp->along, b = 1 - a;
  const double c = beam_coefficient(part, grid, a);
  const int64_t stride = a == 0 ? 1 : grid->size[0], across = a == 0 ? grid->size[0] : 1;
  const int64_t end = clamp->last ? (grid->size[a] - 1) * stride : 0;
  for (int64_t k = 0; k < grid->size[b]; k++) {
    const int64_t held = part->first + end + k * across;
    const int32_t status = hooke_system_pin(part->system, 1, &held);
    if (status != HOOKE_OK) return status;
    next[k] = held + (clamp->last ? -stride : stride);
    stiffness[k] = grid->axes > 1 && k % (grid->size[b] - 1) == 0 ? c : 2.0 * c;
  }
  return HOOKE_OK;
}

static int32_t add_clamp(const struct hk_part *part, const struct hk_grid *grid, const struct clamp *clamp,
                         hooke_options *options) {
  const int64_t lines = grid->size[1 - clamp->along];
  int64_t *next = hk_new(lines, sizeof *next);
  double *stiffness = hk_new(lines, sizeof *stiffness);
  int32_t status = next && stiffness ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = clamp_lines(part, grid, clamp, next, stiffness);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "stiffness", lines, stiffness);
  char *name = status == HOOKE_OK ? hk_part_group_name(part, clamp->word) : NULL;
  if (status == HOOKE_OK)
    status = name ? hk_system_add_anchors(
                        part->system, &(struct hk_addition){&hk_force_anchor, name, lines, next, options, 1})
                  : HOOKE_NO_MEMORY;
  hk_free(name);
  hk_free(next);
  hk_free(stiffness);
  return status;
}

static int32_t add_clamps(const struct hk_part *part, const struct hk_grid *grid) {
  const char *rest = hooke_options_text(part->options, "clamped");
  hooke_options *options = NULL;
  int64_t length;
  if (rest[0] == '\0') return HOOKE_OK;
  if (!(hooke_options_number(part->options, "bending") > 0.0))
    return hk_fail(HOOKE_BAD_VALUE, "clamped", "needs bending > 0, which holds the direction");
  int32_t status = hooke_options_create("anchors", &options);
  for (const char *word; status == HOOKE_OK && (word = hk_option_next_word(&rest, &length));) {
    const struct clamp *clamp = clamps;
    while (strncmp(clamp->word, word, (size_t)length) != 0 || clamp->word[length])
      clamp++;
    status = add_clamp(part, grid, clamp, options);
  }
  hooke_options_destroy(options);
  return status;
}

/* ---- the part ---- */

int32_t hk_grid_build(struct hk_part *part, struct hk_grid *grid, const char *size, const char *what) {
  double *position;
  find_cell(grid);
  int32_t status = hk_part_new_positions(part, size_of(part, grid), what, &position);
  if (status != HOOKE_OK) return hk_fail_within(status, "%s", size);
  place_particles(grid, part->count, position);
  status = hk_part_add_particles(part, grid->axes, grid->size, piece_of(grid), position);
  hk_free(position);
  for (int k = 0; k < FAMILIES && status == HOOKE_OK; k++)
    status = add_family(part, grid, &families[k]);
  if (status == HOOKE_OK) status = add_bending(part, grid);
  if (status == HOOKE_OK) status = add_clamps(part, grid);
  return status == HOOKE_OK ? add_fluid_drag(part, grid) : status;
}

/* Fails for two edges in one line, or three in one plane. */
static int32_t check_edges(const double *edges, int32_t count) {
  double unit[3][3] = {{0.0}}, normal[3];
  for (int e = 0; e < count; e++) {
    const double length = hk_length3(edges + 3 * e);
    if (!(length > 0.0 && isfinite(length))) return HOOKE_OK; /* left to the rest lengths */
    for (int i = 0; i < 3; i++)
      unit[e][i] = edges[3 * e + i] / length;
  }
  hk_cross3(unit[0], unit[1], normal);
  if ((count == 3 ? fabs(hk_dot3(normal, unit[2])) : hk_length3(normal)) > FLAT) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "edges", "the edges span no %s; allowed: vectors in different directions",
                 count == 3 ? "volume" : "area");
}

int32_t hk_grid_build_sized(struct hk_part *part) {
  const double *size = hooke_options_numbers(part->options, "size");
  struct hk_grid grid = {.axes = (int32_t)hooke_options_number_count(part->options, "size"),
                         .size = {1, 1, 1},
                         .origin = hooke_options_numbers(part->options, "origin"),
                         .edges = hooke_options_numbers(part->options, "edges")};
  const char *form = grid.axes == 2 ? "a cloth of %lld x %lld particles" : "a lattice of %lld x %lld x %lld";
  char what[128];
  for (int a = 0; a < grid.axes; a++)
    grid.size[a] = (int64_t)size[a];
  snprintf(what, sizeof what, form, (long long)grid.size[0], (long long)grid.size[1],
           (long long)grid.size[2]);
  const int32_t status = check_edges(grid.edges, grid.axes);
  return status == HOOKE_OK ? hk_grid_build(part, &grid, "size", what) : status;
}
