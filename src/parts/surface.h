/* A surface of triangles: welds vertices, finds faults, lists edges. */
#pragma once

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
  struct hk_surface_edge *edge;   /* edge_count, ascending by low, then high */
  struct hk_surface_lines *lines; /* while it is made; NULL: none */
};

/* Lines of a file that a mesh was read from, by vertex and by triangle. */
struct hk_surface_lines {
  const int32_t *vertex, *triangle;
  int64_t fault; /* the one at fault; 0: none */
};

/* Makes the surface from options of a mesh: `vertices`, `triangles`, `transform`, `weld`. The message about a
 * faulty mesh has its place in the options, or with `lines` (may be NULL) has vertices counted from 1, and
 * sets the line at fault. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. Must be released in each case. */
int32_t hk_surface_create(const hooke_options *options, struct hk_surface_lines *lines,
                          struct hk_surface *surface);
void hk_surface_release(struct hk_surface *surface);
