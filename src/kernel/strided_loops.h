/* The loop of strided batches: forces of springs of constant offset, their sums at particles and the motion of
 * the particles, one vector of particles after the other.
 *
 * Spring l of a batch joins particles l and l + offset. Its force is written into the ring of the batch when
 * the loop is at particle l, and read once more there and at l + offset. Particles below the place of the
 * loop are ends of no spring that is still to come, so they may move at once. */
#ifndef HOOKE_KERNEL_STRIDED_LOOPS_H
#define HOOKE_KERNEL_STRIDED_LOOPS_H

#include <stddef.h>
#include <stdint.h>

enum {
  HOOKE_MOST_STRIDED = 32,
  HOOKE_STRIDED_UNIT = 8, /* passes begin and end at whole multiples of this particle number */
  /* A ring holds at least offset + HOOKE_RING_SLACK springs, a power of two, and after them the first unit
   * once more. */
  HOOKE_RING_SLACK = 48
};

/* Kappa, gamma and rest length of the springs of a batch, in this order. Units that are equal to the bit are
 * stored once: number j of spring l is value[unit[3 (l / 8) + j & mask] + l % 8]. Where all springs have one
 * material, mask is 0. Where units are stored one after the other, values are fetched so many ahead; 0: not
 * at all. */
struct hk_strided_material {
  double *value;
  uint32_t *unit;
  ptrdiff_t mask, ahead;
};

enum { HOOKE_STRIDED_KAPPA, HOOKE_STRIDED_GAMMA, HOOKE_STRIDED_REST, HOOKE_STRIDED_NUMBERS };

/* Number j of spring l and those behind it in its unit. */
static inline const double *hk_strided_number(const struct hk_strided_material *material, ptrdiff_t l,
                                              int j) {
  const size_t unit = HOOKE_STRIDED_NUMBERS * ((size_t)l / HOOKE_STRIDED_UNIT) & (size_t)material->mask;
  return material->value + material->unit[unit + (size_t)j] + (size_t)l % HOOKE_STRIDED_UNIT;
}

struct hk_strided_view {
  int32_t shape;                        /* HOOKE_RUN_*; not mixed: all springs have one material */
  const uint8_t *present;               /* bit l % 8 of byte l / 8: whether spring l is there */
  ptrdiff_t offset, mask;               /* mask: room of the ring less 1 */
  double *ring;                         /* x of spring l at l & mask; y, z one and two strides on */
  double shared[HOOKE_STRIDED_NUMBERS]; /* not mixed: the material, where it is near */
  struct hk_strided_material material;
};

/* A batch as particles see it: the springs that end at them, or, where `offset` is 0, that begin there. */
struct hk_strided_item {
  const double *ring;
  ptrdiff_t offset, mask;
  double sign; /* of forces: 1 at ends, -1 where springs begin */
};

/* Between x, y and z of a ring: the first unit once more, and a distance that keeps them apart in the
 * cache. */
static inline ptrdiff_t hk_ring_stride(ptrdiff_t mask) {
  return mask + 1 + 3 * (ptrdiff_t)HOOKE_STRIDED_UNIT;
}

/* What is done with the sums: nothing, f = sum, or one step of Euler's methods, v += h (w f + g) and q += h
 * v(new), or q += h v(old) first; f has then c v taken away if there is drag, and a = w f if there is no
 * gravity. */
enum { HOOKE_MOVE_NOTHING, HOOKE_MOVE_KEEP, HOOKE_KICK_THEN_DRIFT, HOOKE_DRIFT_THEN_KICK };

struct hk_move {
  int32_t kind;
  int32_t heavy; /* there is gravity */
  double step, drag, gravity[3];
};

/* Arrays have room for HOOKE_STRIDED_UNIT more particles than there are, q and v for the largest offset
 * besides; what is in there is read and not used. */
struct hk_strided_pass {
  int32_t count;
  struct hk_strided_view batch[HOOKE_MOST_STRIDED];
  struct hk_strided_item item[2 * HOOKE_MOST_STRIDED]; /* two a batch, in the order of the sum */
  ptrdiff_t stride;                                    /* between x, y and z of q, and of v and f */
  ptrdiff_t ahead;   /* q and v are fetched so many particles ahead; 0: not at all */
  double *q, *v, *f; /* f: HOOKE_MOVE_KEEP */
  const double *w;
  struct hk_move move;
};

/* Particles `from` .. `to` - 1; returns how many springs that begin there have a rest length but no
 * direction. */
typedef int64_t hk_strided_loop(const struct hk_strided_pass *pass, ptrdiff_t from, ptrdiff_t to);

#endif
