/* The loop of strided batches: forces of springs of constant offset, their sums at particles and the motion
 * of the particles, one vector of particles after the other.
 *
 * Spring l of a batch joins particles l and l + offset. Its force is written into the ring of the batch when
 * the loop is at particle l, and read there and at l + offset. Particles that the loop has passed are ends of
 * no later spring, so they may move at once. Triples of bending follow the springs: triple l of a batch joins
 * particles l, l + offset and l + 2 offset, and its force is read at each of them. */
#pragma once

#include "kernel/move_loops.h"

enum {
  HOOKE_MOST_STRIDED = 32,
  HOOKE_STRIDED_UNIT = 8, /* passes begin and end at multiples of this particle number */
  /* A ring holds as many springs or triples as lie between the ends of one, and HOOKE_RING_SLACK more, a
   * power of two and not less than HOOKE_LEAST_RING, and has space for a unit after them, where the first
   * vector is repeated. */
  HOOKE_RING_SLACK = 48,
  HOOKE_LEAST_RING = 64
};

enum {
  HOOKE_STRIDED_KAPPA,
  HOOKE_STRIDED_GAMMA,
  HOOKE_STRIDED_REST,
  HOOKE_STRIDED_NUMBERS,
  HOOKE_STRIDED_ROW = HOOKE_STRIDED_NUMBERS * HOOKE_STRIDED_UNIT
};

/* Kappas, gammas and rest lengths of the springs of a batch, those of a unit of springs in a row. Rows equal
 * to the bit are stored once: number j of spring l is value[unit[l / 8 & mask] + 8 j + l % 8]. If all springs
 * have one material, mask is 0. If rows are consecutive, values are prefetched so many ahead; 0: never.
 * `lean`: after the row of the first spring come rest lengths alone, to which the units lead. Of triples,
 * value l is the coefficient of triple l, and there are no units. */
struct hk_strided_material {
  double *value;
  uint32_t *unit;
  ptrdiff_t mask, ahead;
  int32_t lean;
};

/* Number j of spring l and those after it in its unit. */
static inline const double *hk_strided_number(const struct hk_strided_material *material, ptrdiff_t l,
                                              int j) {
  const size_t unit = (size_t)l / HOOKE_STRIDED_UNIT & (size_t)material->mask, rest = j == HOOKE_STRIDED_REST;
  const size_t row = material->lean && !rest ? 0 : material->unit[unit];
  const size_t column = material->lean && rest ? 0 : (size_t)(HOOKE_STRIDED_UNIT * j);
  return material->value + row + column + (size_t)l % HOOKE_STRIDED_UNIT;
}

struct hk_strided_view {
  int32_t shape;                        /* HOOKE_RUN_*; not mixed: all springs have one material */
  const uint8_t *present;               /* bit l % 8 of byte l / 8: spring l exists */
  ptrdiff_t offset, mask;               /* mask: size of the ring minus 1 */
  double *ring;                         /* x of spring l at l & mask; y, z one and two strides of rings on */
  double shared[HOOKE_STRIDED_NUMBERS]; /* not mixed: the material, close in memory */
  struct hk_strided_material material;
};

/* A batch as seen by particles: the springs that end at them, whose forces are added, or, if `offset` is 0,
 * that begin there, whose forces are subtracted. */
struct hk_strided_item {
  const double *ring;
  ptrdiff_t offset, mask;
};

/* Arrays are padded by HOOKE_STRIDED_UNIT particles, q and v also by the largest offset; the padding is read
 * and not used. */
struct hk_strided_pass {
  int32_t count, bent; /* batches of springs, and of triples after them */
  struct hk_strided_view batch[HOOKE_MOST_STRIDED];
  struct hk_strided_item item[2 * HOOKE_MOST_STRIDED]; /* two a batch, in the order of the sum */
  const uint8_t *present;                              /* springs that all batches have there */
  ptrdiff_t ring_stride;                               /* between x, y and z of rings */
  ptrdiff_t stride;                                    /* between x, y and z of q, and of v */
  ptrdiff_t ahead; /* q and v are prefetched so many particles ahead; 0: never */
  double *q, *v;
  const double *w;
  struct hk_move move;
};

/* Processes particles `from` .. `to` - 1; returns how short the springs are that begin there
 * (spring_body.h). */
typedef int64_t hk_strided_loop(const struct hk_strided_pass *pass, ptrdiff_t from, ptrdiff_t to);
