/* Bounds of the stiffness and damping of a system by one 3x3 block for each particle, summed over the
 * elements at it:
 *   K <= blockdiag(sum w_j (k_along u u^T + max(0, k_across) (I - u u^T)))     C likewise
 * with w_j = |g_j| times the sum of |g| over the particles of the element that are free, from
 *   (a + b + c)^2 <= (a^2/p + b^2/q + c^2/r) (p + q + r):
 * 2 for a spring, and 1 where its other end is constrained; 4, 8, 4 for a triple. */
#pragma once

#include "measure/trial/budget.h"
#include "model/particles.h"

struct hk_node_blocks {
  const hooke_system *system;
  double *stiffness, *damping; /* 6 a particle: xx, yy, zz, xy, xz, yz */
  double least_ratio; /* smallest damping over stiffness of an element, in any direction; infinity: none */
  int32_t unknown;    /* 1: some element is so long that its square overflows, or needs velocities */
  struct hk_budget *budget; /* ends filling midway (NULL: none) */
};

/* At positions q (3n), and at velocities v (3n, NULL: unknown), on which only what is not linear in them
 * depends. HOOKE_NO_MEMORY. */
int32_t hk_node_blocks_create(const hooke_system *system, const double *q, const double *v,
                              struct hk_node_blocks *blocks);
/* Without positions yet. */
int32_t hk_node_blocks_begin(const hooke_system *system, struct hk_node_blocks *blocks);
/* Recomputes them at other positions, in the existing memory. */
void hk_node_blocks_fill(struct hk_node_blocks *blocks, double t, const double *q, const double *v);
void hk_node_blocks_release(struct hk_node_blocks *blocks);

/* A limit of steps: h (h kk K + k K + c C) < M. */
struct hk_node_limit {
  double kk, k, c;
};

/* The largest step up to `most` within the limit at all particles by these blocks; if it is smaller,
 * `particle` (or NULL) becomes the one that determines it. Where `most` is within the limit this is one
 * elimination a particle. */
double hk_node_blocks_reach(const struct hk_node_blocks *blocks, struct hk_node_limit limit, double most,
                            int64_t *particle);
