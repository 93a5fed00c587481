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

void hk_numbers_move(int32_t kind, double kick, int64_t count, const double *rate, double *start, double *sum,
                     double *x) {
  if (kind == HOOKE_FIRST_STAGE)
    hk_first_stage(count, kick, rate, start, sum, x);
  else if (kind == HOOKE_MIDDLE_STAGE)
    hk_middle_stage(count, kick, rate, start, sum, x);
  else if (kind == HOOKE_LAST_STAGE)
    hk_last_stage(count, kick, rate, start, sum, x);
  else
    hk_advance(count, kick, rate, x);
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

/* With u half-way in `start`, as in move_loops.h. */
static void kick_and_drift(const hooke_system *system, const struct hk_move *move, struct hk_numbers *own) {
  const size_t bytes = (size_t)own->count * sizeof(double);
  if (move->kind == HOOKE_CORRECT) memcpy(own->x, own->start, bytes);
  hk_movers_kick(system, move->kick, own->push, own->x);
  if (move->kind == HOOKE_CORRECT) return;
  hk_movers_drift(system, move->drift, own->x);
  if (move->kind == HOOKE_KICK_THEN_DRIFT) return;
  memcpy(own->start, own->x, bytes);
  hk_movers_kick(system, move->kick, own->push, own->x);
}

/* Stages between have quaternions of other lengths. */
void hk_numbers_follow(const hooke_system *system, const struct hk_move *move, struct hk_numbers *own,
                       struct hk_motion *motion) {
  const int32_t kind = move->kind;
  if (kind == HOOKE_KICK_THEN_DRIFT || kind == HOOKE_PREDICT || kind == HOOKE_CORRECT) {
    kick_and_drift(system, move, own);
  } else {
    hk_movers_slope(system, own->x, own->push, own->rate);
    hk_numbers_move(kind, move->kick, own->count, own->rate, own->start, own->sum, own->x);
  }
  if (kind != HOOKE_FIRST_STAGE && kind != HOOKE_MIDDLE_STAGE) hk_movers_normalise(system, own->x);
  hk_movers_write(system, motion, own->x);
}
