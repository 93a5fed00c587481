/* What explicit steps move beside the particles in rows: x of a first-order problem, or the own coordinates
 * of movers (model/coordinates). Those of movers are taken from the rows where a step begins and written back
 * by each of its moves, so that a step remains a map of (t, q, v). */
#ifndef HOOKE_INTEGRATE_NUMBERS_H
#define HOOKE_INTEGRATE_NUMBERS_H

#include "kernel/move_loops.h"
#include "model/sum/motion.h"

struct hk_numbers {
  int64_t count;
  double *x, *start, *rate, *sum; /* of its size; x begins the block of all */
  double *push;                   /* of movers: HOOKE_PUSH for each */
};

/* `pushes`: numbers of all pushes. HOOKE_NO_MEMORY; releasing has to follow. */
int32_t hk_numbers_create(int64_t count, int64_t pushes, struct hk_numbers *numbers);
void hk_numbers_release(struct hk_numbers *numbers);

/* Before the first stage of a step, whose forces are those at rows that the own coordinates give. */
void hk_numbers_begin(const struct hooke_system *system, struct hk_motion *motion,
                      struct hk_numbers *numbers);
/* Before particles move under the forces in `motion`: what these do to movers. After: their move. */
void hk_numbers_push(const struct hooke_system *system, const struct hk_motion *motion, int32_t kind,
                     struct hk_numbers *numbers);
void hk_numbers_follow(const struct hooke_system *system, const struct hk_move *move,
                       struct hk_numbers *numbers, struct hk_motion *motion);

#endif
