/* Bounds of the stiffness and damping of a system by one 3x3 block for each particle, summed over the
 * elements at it:
 *   K <= blockdiag(sum w_j (k_along u u^T + max(0, k_across) (I - u u^T)))     C likewise
 * with w_j = |g_j| times the sum of |g| over the particles of the element that are free, from
 *   (a + b + c)^2 <= (a^2/p + b^2/q + c^2/r) (p + q + r):
 * 2 for a spring, and 1 where its other end is constrained; 4, 8, 4 for a triple. */
#ifndef HOOKE_MEASURE_SPECTRUM_NODE_BLOCKS_H
#define HOOKE_MEASURE_SPECTRUM_NODE_BLOCKS_H

#include "measure/trial/budget.h"
#include "model/particles.h"

struct hk_node_blocks {
  const hooke_system *system;
  double *stiffness, *damping; /* 6 a particle: xx, yy, zz, xy, xz, yz */
  double least_ratio; /* smallest damping over stiffness of an element, in any direction; infinity: none */
  int32_t unknown;    /* 1: some element is so long that its square overflows */
  struct hk_budget *budget; /* ends filling midway (NULL: none) */
};

/* At positions q (3n). HOOKE_NO_MEMORY. */
int32_t hk_node_blocks_create(const hooke_system *system, const double *q, struct hk_node_blocks *blocks);
/* Without positions yet. */
int32_t hk_node_blocks_begin(const hooke_system *system, struct hk_node_blocks *blocks);
/* Recomputes them at other positions, in the existing memory. */
void hk_node_blocks_fill(struct hk_node_blocks *blocks, const double *q);
void hk_node_blocks_release(struct hk_node_blocks *blocks);

/* Bounds of the largest frequency [rad/s] and of the largest damping rate [1/s]. */
double hk_node_blocks_frequency(const struct hk_node_blocks *blocks);
double hk_node_blocks_damping_rate(const struct hk_node_blocks *blocks);

/* 1 if no eigenvalue of (a K + b C)/m exceeds `limit` at any particle by these blocks; otherwise 0, and
 * `particle` is the first one at which one does. Far quicker than eigenvalues. */
int32_t hk_node_blocks_stay_below(const struct hk_node_blocks *blocks, double a, double b, double limit,
                                  int64_t *particle);

/* The largest h at which h^2 K + 2 h C stays below 4 M by these blocks; infinity if none limits it. */
double hk_node_blocks_step(const struct hk_node_blocks *blocks);

#endif
