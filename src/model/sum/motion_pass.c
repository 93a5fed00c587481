/* One pass over memory: sums of springs, and their use. */
#include "model/sum/motion.h"
#include "model/sum/tiled.h"

#include <string.h>

struct tile_move {
  const struct hooke_system *system;
  struct hk_motion *motion;
  const struct hk_move *move;
};

/* Forces are zero before springs are added, so sums are the forces. */
static void keep_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const int32_t *order = to->motion->order ? NULL : to->system->tiled->order;
  for (int a = 0; a < 3; a++) {
    double *kept = to->motion->f[a];
    if (order == NULL) memcpy(kept + from, f[a], (size_t)count * sizeof(double));
    for (int64_t k = 0; k < count && order; k++)
      kept[order[from + k]] = f[a][k];
  }
}

static void move_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const struct hk_moved moved = hk_motion_moved(to->motion);
  const double *const force[3] = {f[0], f[1], f[2]};
  hk_spring_set(0)->move(to->move, &moved, (ptrdiff_t)from, (ptrdiff_t)count, force);
}

struct hk_moved hk_motion_moved(const struct hk_motion *motion) {
  return (struct hk_moved){motion->w, motion->q[0], motion->v[0], hk_motion_stride(motion)};
}

void hk_motion_pass(const hooke_system *system, struct hk_motion *motion, const struct hk_move *move) {
  struct tile_move to = {system, motion, move};
  const int64_t shortness =
      system->strided->count > 0
          ? hk_strided_batches_pass(system, motion, move)
          : hk_tiled_pass(system->tiled, motion, move->kind == HOOKE_MOVE_KEEP ? keep_tile : move_tile, &to);
  hk_motion_keep_short(motion, shortness);
}
