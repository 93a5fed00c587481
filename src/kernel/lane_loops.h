/* The loop of lanes: forces of springs of constant offset, their sums at particles and the motion of the
 * particles, one vector of particles after the other.
 *
 * Spring l of a lane joins particles l and l + offset. Its force is written into the ring of the lane when
 * the loop is at particle l, and read once more there and at l + offset. Particles below the place of the
 * loop are ends of no spring that is still to come, so they may move at once. */
#ifndef HOOKE_KERNEL_LANE_LOOPS_H
#define HOOKE_KERNEL_LANE_LOOPS_H

#include <stddef.h>
#include <stdint.h>

enum {
  HOOKE_MOST_LANES = 32,
  HOOKE_LANE_UNIT = 8, /* passes begin and end at whole multiples of this particle number */
  /* A ring holds at least offset + HOOKE_RING_SLACK springs, a power of two, and after them the first unit
   * once more. */
  HOOKE_RING_SLACK = 48
};

struct hk_lane_view {
  int32_t shape;          /* HOOKE_RUN_* */
  const uint8_t *present; /* bit l % 8 of byte l / 8: whether spring l is there */
  ptrdiff_t offset, mask; /* mask: room of the ring less 1 */
  double *ring;           /* x of spring l at l & mask; y, z one and two strides on */
  double kappa, gamma, rest_length;
  /* mixed: those of spring l at l - base; none of a unit that begins beyond `most` */
  const double *kappas, *gammas, *rest_lengths;
  ptrdiff_t base, most;
};

/* Between x, y and z of a ring: the first unit once more, and a distance that keeps them apart in the
 * cache. */
static inline ptrdiff_t hk_ring_stride(ptrdiff_t mask) {
  return mask + 1 + 3 * (ptrdiff_t)HOOKE_LANE_UNIT;
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

/* Arrays have room for HOOKE_LANE_UNIT more particles than there are, q and v for the largest offset besides;
 * what is in there is read and not used. */
struct hk_lane_pass {
  int32_t count;
  struct hk_lane_view lane[HOOKE_MOST_LANES]; /* in the order of the sum */
  ptrdiff_t stride;                           /* between x, y and z of q, and of v and f */
  ptrdiff_t ahead;                            /* q and v are fetched so many particles ahead; 0: not at all */
  double *q, *v, *f;                          /* f: HOOKE_MOVE_KEEP */
  const double *w;
  struct hk_move move;
};

/* Particles `from` .. `to` - 1; returns how many springs that begin there have a rest length but no
 * direction. */
typedef int64_t hk_lane_loop(const struct hk_lane_pass *pass, ptrdiff_t from, ptrdiff_t to);

#endif
