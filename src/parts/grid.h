/* Grids of particles over one edge (a rope), two (a cloth) or three (a lattice). */
#pragma once

#include "parts/part.h"

struct hk_grid {
  int32_t axes;
  int64_t size[3]; /* particles along each axis; 1 along those that there are not */
  const double *origin, *edges;
  const double *last;           /* the last particle; NULL: where the edges end */
  double side[3][3], length[3]; /* of a cell, as vectors; filled by hk_grid_build() */
};

/* Builds the part: particles, the families of springs that its options have, and bending. `what` describes it
 * in messages: "a rope of 3 segments"; `size` is the option that says how large it is. */
int32_t hk_grid_build(struct hk_part *part, struct hk_grid *grid, const char *size, const char *what);

/* The same of a cloth or a lattice by its options `origin`, `edges` and `size`. */
int32_t hk_grid_build_sized(struct hk_part *part);
