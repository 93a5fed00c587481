/* One pass over memory: sums of springs, and their use. */
#include "model/sum/motion.h"

#include <string.h>

struct tile_move {
  const struct hooke_system *system;
  struct hk_motion *motion;
  const struct hk_move *move;
};

/* Forces are zero before springs are added, so sums are the forces. */
static void keep_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const int32_t *order = to->motion->order ? NULL : to->system->tiled.order;
  for (int a = 0; a < 3; a++) {
    double *kept = to->motion->f[a];
    if (order == NULL) memcpy(kept + from, f[a], (size_t)count * sizeof(double));
    for (int64_t k = 0; k < count && order; k++)
      kept[order[from + k]] = f[a][k];
  }
}

/* Adds drag on a tile, as its row in the table of forces does; constrained particles are restored after a
 * step. */
static void brake(double drag, int64_t from, int64_t count, const struct hk_motion *m, double *const f[3]) {
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < count; k++)
      f[a][k] -= drag * m->v[a][from + k];
  }
}

static void move_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const struct hk_motion *m = to->motion;
  const struct hk_move *move = to->move;
  hk_step_loop *loop = hk_step_loop_of(move->kind);
  hk_verlet_loop *half = hk_verlet_loop_of(move->kind);
  if (move->drag > 0.0 && move->kind != HOOKE_CORRECT) brake(move->drag, from, count, m, f);
  for (int a = 0; a < 3; a++) {
    const double *w = m->w + from, *g = move->heavy ? &move->gravity[a] : NULL;
    double *q = m->q[a] + from, *v = m->v[a] + from;
    if (half)
      half(count, move->step, move->drag, w, f[a], g, move->half[a] + from, q, v);
    else
      loop(count, move->step, w, f[a], g, q, v);
  }
}

void hk_motion_pass(const hooke_system *system, struct hk_motion *motion, const struct hk_move *move) {
  struct tile_move to = {system, motion, move};
  if (system->strided.count > 0)
    motion->coincident = hk_strided_batches_pass(system, motion, move);
  else
    motion->coincident =
        hk_tiled_pass(&system->tiled, motion, move->kind == HOOKE_MOVE_KEEP ? keep_tile : move_tile, &to);
}
