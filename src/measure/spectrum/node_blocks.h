/* Bounds of the stiffness and damping of a system by one 3x3 block for each particle:
 *   K <= blockdiag(sum_e w_e B_e),  B_e = kappa u u^T + max(0, T/r) (I - u u^T)
 *   C <= blockdiag(sum_e w_e G_e),  G_e = gamma u u^T
 * of every altitude spring its rows: 2 |g_j| kappa u u^T and 2 |g_j| gamma u u^T, less where some corners are
 * held; and of every triple of bending its rows: c times 4, 8, 4 at its particles, less where some of them
 * are held; with w_e = 2, and 1 where the other end is held, from (a - b)^2 <= 2 a^2 + 2 b^2. Drag adds c
 * I. */
#ifndef HOOKE_MEASURE_SPECTRUM_NODE_BLOCKS_H
#define HOOKE_MEASURE_SPECTRUM_NODE_BLOCKS_H

#include "measure/trial/patience.h"
#include "model/system.h"

struct hk_node_blocks {
  const hooke_system *system;
  double *stiffness, *damping;  /* 6 a particle: xx, yy, zz, xy, xz, yz */
  double least_ratio;           /* smallest gamma/kappa of a stiff spring, infinity without one */
  struct hk_patience *patience; /* whose end ends a filling half-way (NULL: none) */
  /* some stretched spring is stiff across its direction, where it has no damping, or there is bending,
   * which has none */
  int32_t across;
};

/* At positions q (3n). HOOKE_NO_MEMORY. */
int32_t hk_node_blocks_create(const hooke_system *system, const double *q, struct hk_node_blocks *blocks);
/* Without positions yet. */
int32_t hk_node_blocks_begin(const hooke_system *system, struct hk_node_blocks *blocks);
/* The same again at other positions, in the memory there is. */
void hk_node_blocks_fill(struct hk_node_blocks *blocks, const double *q);
void hk_node_blocks_release(struct hk_node_blocks *blocks);

/* Bounds of the largest frequency [rad/s] and of the largest damping rate [1/s]. */
double hk_node_blocks_frequency(const struct hk_node_blocks *blocks);
double hk_node_blocks_damping_rate(const struct hk_node_blocks *blocks);

/* 1 if no eigenvalue of (a K + b C)/m is above `limit` at any particle by these blocks, else 0, and
 * `particle` is the first one at which one is. Far quicker than eigenvalues. */
int32_t hk_node_blocks_stay_below(const struct hk_node_blocks *blocks, double a, double b, double limit,
                                  int64_t *particle);

/* The largest h at which h^2 K + 2 h C stays below 4 M by these blocks; infinity if none limits it. */
double hk_node_blocks_step(const struct hk_node_blocks *blocks);

#endif
