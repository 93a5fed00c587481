#include "parts/surface.h"

#include "parts/weld.h"
#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double FLAT = 1e-12; /* height over the longest edge, below which a triangle counts as flat */

/* ---- faults ---- */

/* Ends the message about a fault at a given triangle, or at a vertex. */
static int32_t fail_at(const struct hk_surface *surface, int of_vertex, int64_t k) {
  struct hk_surface_lines *lines = surface->lines;
  if (lines == NULL)
    return hk_fail_within(HOOKE_BAD_VALUE, of_vertex ? "vertices[%lld]" : "triangles[%lld]", (long long)k);
  lines->fault = (of_vertex ? lines->vertex : lines->triangle)[k];
  return HOOKE_BAD_VALUE;
}

/* A given vertex, and where a triangle is, in messages. */
static long long vertex_at(const struct hk_surface *surface, double vertex) {
  return (long long)vertex + (surface->lines != NULL);
}

static const char *place_of(const struct hk_surface *surface, int64_t triangle, char place[32]) {
  const struct hk_surface_lines *lines = surface->lines;
  snprintf(place, 32, "%s %lld", lines ? "line" : "triangle",
           (long long)(lines ? lines->triangle[triangle] : triangle));
  return place;
}

/* ---- vertices ---- */

static void place_vertices(const hooke_options *options, int64_t count, double *position) {
  const double *vertex = hooke_options_numbers(options, "vertices");
  const double scale = hooke_options_number(options, "transform.scale");
  const double *translate = hooke_options_numbers(options, "transform.translate");
  for (int64_t k = 0; k < 3 * count; k++)
    position[k] = scale * vertex[k] + translate[k % 3];
}

static int32_t check_range(const double *corner, int64_t count, int64_t vertices) {
  for (int64_t k = 0; k < count; k++) {
    if (corner[k] < (double)vertices) continue;
    char where[64];
    snprintf(where, sizeof where, "triangles[%lld][%lld]", (long long)(k / 3), (long long)(k % 3));
    return hk_fail_index(where, "there is no vertex", corner[k], vertices);
  }
  return HOOKE_OK;
}

/* ---- triangles ---- */

static int32_t check_corners(const struct hk_surface *surface, const double *corner, int64_t t) {
  const int32_t *v = surface->triangle + 3 * t;
  for (int e = 0; e < 3; e++) {
    if (v[e] != v[(e + 1) % 3]) continue;
    const long long a = vertex_at(surface, corner[3 * t + e]),
                    b = vertex_at(surface, corner[3 * t + (e + 1) % 3]);
    hk_fail(HOOKE_BAD_VALUE, NULL,
            a == b ? "vertex %lld is two of its corners; allowed: three different ones"
                   : "its corners %lld and %lld become one particle; allowed: three different ones",
            a, b);
    return fail_at(surface, 0, t);
  }
  return HOOKE_OK;
}

/* The longest edge is factored out, so that flat triangles are recognised at any size. */
static double area_of(const double *a, const double *b, const double *c) {
  double u[3], v[3], longest = 0.0;
  for (int i = 0; i < 3; i++) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    longest = fmax(longest, fmax(fmax(fabs(u[i]), fabs(v[i])), fabs(u[i] - v[i])));
  }
  for (int i = 0; i < 3 && longest > 0.0; i++) {
    u[i] /= longest;
    v[i] /= longest;
  }
  double square = 0.0;
  for (int i = 0; i < 3; i++) {
    const double normal = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    square += normal * normal;
  }
  const double ratio = sqrt(square);
  return ratio > FLAT ? 0.5 * ratio * longest * longest : 0.0;
}

static int32_t share_areas(struct hk_surface *surface, const double *corner) {
  for (int64_t t = 0; t < surface->triangle_count; t++) {
    const int32_t *v = surface->triangle + 3 * t;
    const double area = area_of(surface->position + 3 * (int64_t)v[0], surface->position + 3 * (int64_t)v[1],
                                surface->position + 3 * (int64_t)v[2]);
    if (!(area > 0.0) || !isfinite(area)) {
      const double *given = corner + 3 * t;
      hk_fail(HOOKE_BAD_VALUE, NULL,
              "the triangle of vertices %lld, %lld and %lld has no area, or one that is not finite; allowed: "
              "an area > 0, as the mass is shared out by it",
              vertex_at(surface, given[0]), vertex_at(surface, given[1]), vertex_at(surface, given[2]));
      return fail_at(surface, 0, t);
    }
    for (int e = 0; e < 3; e++)
      surface->area[v[e]] += area / 3.0;
  }
  return HOOKE_OK;
}

static int32_t check_used(const struct hk_surface *surface) {
  for (int64_t v = 0; v < surface->vertex_count; v++) {
    if (surface->area[v] != 0.0) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "vertex %lld is in no face; allowed: vertices of faces only, as the mass is shared out by area",
            vertex_at(surface, surface->first[v]));
    return fail_at(surface, 1, surface->first[v]);
  }
  return HOOKE_OK;
}

/* ---- edges ---- */

/* A side of a triangle. */
struct side {
  int32_t low, high, across, triangle;
};

static void list_sides(const struct hk_surface *surface, struct side *side) {
  for (int64_t t = 0; t < surface->triangle_count; t++) {
    const int32_t *v = surface->triangle + 3 * t;
    for (int e = 0; e < 3; e++) {
      const int32_t a = v[e], b = v[(e + 1) % 3];
      *side++ = (struct side){a < b ? a : b, a < b ? b : a, v[(e + 2) % 3], (int32_t)t};
    }
  }
}

/* Stable counting sort; `start` has room for one number more than there are vertices. */
static void sort_sides(int64_t count, int64_t vertices, int by_low, const struct side *from, struct side *to,
                       int64_t *start) {
  memset(start, 0, (size_t)(vertices + 1) * sizeof *start);
  for (int64_t k = 0; k < count; k++)
    start[(by_low ? from[k].low : from[k].high) + 1]++;
  for (int64_t v = 0; v < vertices; v++)
    start[v + 1] += start[v];
  for (int64_t k = 0; k < count; k++)
    to[start[by_low ? from[k].low : from[k].high]++] = from[k];
}

/* Of the sides on one edge: a third one, or a second one of the same triangle. */
static int32_t check_edge(const struct hk_surface *surface, const struct side *side, int64_t count) {
  char first[32], second[32];
  const long long low = vertex_at(surface, surface->first[side->low]),
                  high = vertex_at(surface, surface->first[side->high]);
  place_of(surface, side[0].triangle, first);
  if (count > 2) {
    hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "the edge of vertices %lld and %lld has a third face here, after those of %s and %s; allowed: two "
        "faces at an edge",
        low, high, first, place_of(surface, side[1].triangle, second));
    return fail_at(surface, 0, side[2].triangle);
  }
  if (count < 2 || side[0].across != side[1].across) return HOOKE_OK;
  hk_fail(HOOKE_BAD_VALUE, NULL,
          "a second face on vertices %lld, %lld and %lld, after that of %s; allowed: each face once", low,
          high, vertex_at(surface, surface->first[side->across]), first);
  return fail_at(surface, 0, side[1].triangle);
}

static int32_t join_sides(struct hk_surface *surface, int64_t count, const struct side *side) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0, next; k < count && status == HOOKE_OK; k = next) {
    for (next = k + 1; next < count && side[next].low == side[k].low && side[next].high == side[k].high;)
      next++;
    if (next - k > 1) status = check_edge(surface, &side[k], next - k);
    surface->edge[surface->edge_count++] = (struct hk_surface_edge){
        side[k].low, side[k].high, {side[k].across, next - k > 1 ? side[k + 1].across : -1}};
  }
  return status;
}

static int32_t list_edges(struct hk_surface *surface) {
  const int64_t count = 3 * surface->triangle_count;
  struct side *side = hk_new(count, sizeof *side), *sorted = hk_new(count, sizeof *sorted);
  int64_t *start = hk_new(surface->vertex_count + 1, sizeof *start);
  surface->edge = hk_new(count, sizeof *surface->edge);
  int32_t status = HOOKE_NO_MEMORY;
  if (side && sorted && start && surface->edge) {
    list_sides(surface, side);
    sort_sides(count, surface->vertex_count, 0, side, sorted, start);
    sort_sides(count, surface->vertex_count, 1, sorted, side, start);
    status = join_sides(surface, count, side);
  }
  hk_free(side);
  hk_free(sorted);
  hk_free(start);
  return status;
}

/* ---- surface ---- */

static int32_t fill(const hooke_options *options, struct hk_surface *surface, int32_t *became) {
  const int64_t given = hooke_options_number_count(options, "vertices") / 3;
  const double *corner = hooke_options_numbers(options, "triangles");
  place_vertices(options, given, surface->position);
  int32_t status = check_range(corner, 3 * surface->triangle_count, given);
  if (status == HOOKE_OK) {
    status = hk_weld(given, hooke_options_number(options, "weld"), surface->position, became, surface->first,
                     &surface->vertex_count);
  }
  for (int64_t k = 0; k < 3 * surface->triangle_count && status == HOOKE_OK; k++)
    surface->triangle[k] = became[(int64_t)corner[k]];
  for (int64_t t = 0; t < surface->triangle_count && status == HOOKE_OK; t++)
    status = check_corners(surface, corner, t);
  if (status == HOOKE_OK) status = share_areas(surface, corner);
  if (status == HOOKE_OK) status = check_used(surface);
  if (status == HOOKE_OK) status = list_edges(surface);
  return status;
}

int32_t hk_surface_create(const hooke_options *options, struct hk_surface_lines *lines,
                          struct hk_surface *surface) {
  const int64_t vertices = hooke_options_number_count(options, "vertices") / 3;
  const int64_t triangles = hooke_options_number_count(options, "triangles") / 3;
  *surface = (struct hk_surface){.triangle_count = triangles, .lines = lines};
  if (vertices > INT32_MAX || 3 * triangles > INT32_MAX) {
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "a mesh of %lld vertices and %lld triangles; allowed: "
                   "up to 2147483647 vertices and 715827882 triangles",
                   (long long)vertices, (long long)triangles);
  }
  surface->position = hk_new(3 * vertices, sizeof(double));
  surface->area = hk_new(vertices, sizeof(double));
  surface->first = hk_new(vertices, sizeof(int32_t));
  surface->triangle = hk_new(3 * triangles, sizeof(int32_t));
  int32_t *became = hk_new(vertices, sizeof(int32_t));
  int32_t status = HOOKE_NO_MEMORY;
  if (surface->position && surface->area && surface->first && surface->triangle && became)
    status = fill(options, surface, became);
  hk_free(became);
  return status;
}

void hk_surface_release(struct hk_surface *surface) {
  hk_free(surface->position);
  hk_free(surface->area);
  hk_free(surface->first);
  hk_free(surface->triangle);
  hk_free(surface->edge);
  *surface = (struct hk_surface){.edge = NULL};
}
