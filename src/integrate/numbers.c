#include "integrate/numbers.h"

#include "core/memory.h"
#include "kernel/step_loops.h"
#include "model/coordinates/coordinates.h"
#include "model/particles.h"

#include <string.h>

int32_t hk_numbers_create(int64_t count, int64_t pushes, struct hk_numbers *numbers) {
  double *block = hk_new(4 * count + pushes, sizeof(double));
  *numbers = (struct hk_numbers){.count = count};
  if (block == NULL) return HOOKE_NO_MEMORY;
  numbers->x = hk_part(&block, count);
  numbers->start = hk_part(&block, count);
  numbers->rate = hk_part(&block, count);
  numbers->sum = hk_part(&block, count);
  numbers->push = block;
  return HOOKE_OK;
}

void hk_numbers_release(struct hk_numbers *numbers) {
  hk_free(numbers->x);
}

/* ---- movers ---- */

void hk_numbers_begin(const hooke_system *system, struct hk_motion *motion, struct hk_numbers *own) {
  hk_movers_read(system, motion, own->x);
  hk_movers_write(system, motion, own->x);
}

void hk_numbers_push(const hooke_system *system, const struct hk_motion *motion, int32_t kind,
                     struct hk_numbers *own) {
  if (kind == HOOKE_KICK_THEN_DRIFT || kind == HOOKE_PREDICT) hk_movers_read(system, motion, own->x);
  hk_movers_push(system, motion, own->x, own->push);
}

/* As in move_loops.h, with `start` for u. Stages between have quaternions of other lengths. */
void hk_numbers_follow(const hooke_system *system, const struct hk_move *move, struct hk_numbers *own,
                       struct hk_motion *motion) {
  const int32_t kind = move->kind;
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *m = &system->mover[k];
    const size_t bytes = (size_t)m->row->numbers * sizeof(double);
    double *x = own->x + m->at, *start = own->start + m->at, *push = own->push + HOOKE_PUSH * k;
    if (kind == HOOKE_KICK_THEN_DRIFT || kind == HOOKE_PREDICT || kind == HOOKE_CORRECT) {
      if (kind == HOOKE_CORRECT) memcpy(x, start, bytes);
      m->row->kick(m->thing, move->kick, push, x);
      if (kind != HOOKE_CORRECT) m->row->drift(m->thing, move->drift, x);
      if (kind == HOOKE_PREDICT) memcpy(start, x, bytes);
      if (kind == HOOKE_PREDICT) m->row->kick(m->thing, move->kick, push, x);
    } else {
      m->row->slope(m->thing, x, push, own->rate + m->at);
      hk_move_numbers(kind, move->kick, m->row->numbers, own->rate + m->at, start, own->sum + m->at, x);
    }
  }
  if (kind != HOOKE_FIRST_STAGE && kind != HOOKE_MIDDLE_STAGE) hk_movers_normalise(system, own->x);
  hk_movers_write(system, motion, own->x);
}
