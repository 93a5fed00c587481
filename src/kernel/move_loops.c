/* Compiled once per instruction set, with HOOKE_ISA naming it. */
#include "kernel/instruction_set.h"
#include "kernel/move_body.h"

HOOKE_INLINE void move_all(const struct hk_move move, const int kind, const int has_factors,
                           const struct hk_moved moved, ptrdiff_t from, ptrdiff_t count,
                           const double *const f[3]) {
  for (ptrdiff_t k = 0; k < count; k += HOOKE_WIDTH) {
    const ptrdiff_t p = from + k;
    const hk_vector force[3] = {hk_load(f[0] + k), hk_load(f[1] + k), hk_load(f[2] + k)};
    const double *factor = has_factors ? move.gravity_factor + p : NULL;
    hk_move_vector(&move, kind, p, moved.w + p, factor, moved.q + p, moved.v + p, moved.stride, force);
  }
}

#define MOVE(kind)                                                                                           \
  case kind:                                                                                                 \
    if (move->gravity_factor)                                                                                \
      move_all(*move, kind, 1, *moved, from, count, f);                                                      \
    else                                                                                                     \
      move_all(*move, kind, 0, *moved, from, count, f);                                                      \
    break;

void HOOKE_MOVE_LOOP(const struct hk_move *move, const struct hk_moved *moved, ptrdiff_t from,
                     ptrdiff_t count, const double *const f[3]) {
  switch (move->kind) {
    MOVE(HOOKE_MOVE_KEEP)
    MOVE(HOOKE_KICK_THEN_DRIFT)
    MOVE(HOOKE_DRIFT_THEN_KICK)
    MOVE(HOOKE_PREDICT)
    MOVE(HOOKE_CORRECT)
    MOVE(HOOKE_KICK)
    MOVE(HOOKE_KICK_DRIFT_KICK)
    MOVE(HOOKE_FIRST_STAGE)
    MOVE(HOOKE_MIDDLE_STAGE)
    MOVE(HOOKE_LAST_STAGE)
  default:
    break;
  }
}
