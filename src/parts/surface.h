/* A surface of triangles: welds vertices, finds faults, lists edges. */
#ifndef HOOKE_PARTS_SURFACE_H
#define HOOKE_PARTS_SURFACE_H

#include "hooke/options.h"

/* An edge of one or two triangles; `across` are the vertices opposite to it, -1 where there is no second
 * triangle. */
struct hk_surface_edge {
  int32_t low, high, across[2];
};

/* Vertices are numbered in the order of their first appearance; coincident ones are one. */
struct hk_surface {
  int64_t vertex_count, triangle_count, edge_count;
  double *position;  /* 3 vertex_count */
  double *area;      /* vertex_count: a third of each triangle's area at the vertex [m^2] */
  int32_t *first;    /* vertex_count: number of the given vertex, the first of those at its position */
  int32_t *triangle; /* 3 triangle_count */
  struct hk_surface_edge *edge; /* edge_count, ascending by low, then high */
};

/* Fault of a surface; numbers are those of the given mesh. */
enum hk_surface_trouble {
  HOOKE_SURFACE_FINE,
  HOOKE_SURFACE_CORNERS, /* vertex[0] and vertex[1] are the same corner */
  HOOKE_SURFACE_FLAT,    /* the triangle on vertex[] has no area */
  HOOKE_SURFACE_UNUSED,  /* vertex[0] is in no triangle */
  HOOKE_SURFACE_CROWDED, /* the edge vertex[0], vertex[1] has three triangles, triangle[] */
  HOOKE_SURFACE_TWICE    /* triangle[0] is on the same vertices as triangle[1] */
};
struct hk_surface_fault {
  enum hk_surface_trouble trouble;
  int64_t vertex[3], triangle[3];
};

/* Makes the surface from options of a mesh: `vertices`, `triangles`, `transform`, `weld`. For a faulty mesh
 * it returns HOOKE_BAD_VALUE and fills `fault`; other failures have their message. Must be released in each
 * case. */
int32_t hk_surface_create(const hooke_options *options, struct hk_surface *surface,
                          struct hk_surface_fault *fault);
void hk_surface_release(struct hk_surface *surface);

/* Describes the fault; vertices are counted from `base`, and triangles are identified by number, or by line
 * of a file if `line` is not NULL. */
void hk_surface_describe(const struct hk_surface_fault *fault, int64_t base, const int32_t *line, char *text,
                         int64_t size);

#endif
