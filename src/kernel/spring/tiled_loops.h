/* The loops of tiled batches: springs whose ends are looked up, summed in one pass over tiles of particles.
 * Positions and velocities of the particles near a tile are in rows; the forces of a spring on its two ends
 * are in rows of forces, so that the sum at a particle is a sum of rows that are looked up. */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum {
  HOOKE_TILED_ROW = 8,    /* numbers in a row of a particle: x, y, z, vz, vx, vy, two unused */
  HOOKE_TILED_FORCE = 4,  /* in a row of a force: x, y, z, one unused */
  HOOKE_TILED_BATCH = 256 /* maximum number of springs computed at once */
};

/* The shape of springs that are computed together is a sum of these. */
enum {
  HOOKE_TILED_DAMPED = 1,
  HOOKE_TILED_PULL_ONLY = 2,
  HOOKE_TILED_WIDE = 4,    /* indices are uint32_t, else uint16_t */
  HOOKE_TILED_LENGTHS = 8, /* each spring has a rest length; kappa and gamma are shared */
  HOOKE_TILED_STRAIN = 16, /* in addition: they are kappa/l0 and gamma/l0 */
  HOOKE_TILED_MIXED = 24,  /* each spring has all three */
  HOOKE_TILED_SHAPES = 32
};

struct hk_tiled_springs {
  const uint8_t *lower; /* rows of the lower ends, from the first of the tile */
  const void *upper;    /* rows of the upper ends */
  double kappa, gamma, rest_length;
  const double *kappas, *gammas, *rest_lengths;
};

/* Forces of `count` springs on their lower and upper ends; returns how short they are
 * (spring_body.h). */
typedef int64_t hk_tiled_fill(const struct hk_tiled_springs *springs, ptrdiff_t count, const double *lower,
                              const double *upper, double *on_lower, double *on_upper);

/* f = sums of the rows of forces at `slot`, degree[p] of them at particle p, in this order; returns the end
 * of `slot`. */
typedef const void *hk_tiled_sum(ptrdiff_t count, const uint16_t *degree, const void *slot,
                                 const double *force, double *const f[3]);

/* Rows of `count` particles, those in `order` (NULL: the first ones); v NULL: positions only. */
typedef void hk_tiled_rows(ptrdiff_t count, const int32_t *order, const double *const q[3],
                           const double *const v[3], double *rows);

struct hk_tiled_loops {
  hk_tiled_fill *fill[HOOKE_TILED_SHAPES];
  hk_tiled_sum *sum[2]; /* narrow, wide */
  hk_tiled_rows *rows;
};
