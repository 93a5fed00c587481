/* The part of each worker of a thread pool in a pass over a tiled batch, and its data. */
#ifndef HOOKE_MODEL_SUM_TILED_PARTITION_H
#define HOOKE_MODEL_SUM_TILED_PARTITION_H

#include "model/sum/tiled.h"

/* A worker has the tiles `first` .. `end` - 1. Before any particle moves it computes the springs of the tiles
 * from `begin` on that end in its own, and saves the rows of the particles from its last one to `saved_end` -
 * 1, which others move. */
struct hk_tiled_partition {
  int64_t begin, first, end, saved_end;
  const void *slot;                     /* of the first force on the first particle */
  double *rows, *forces, *saved, *f[3]; /* saved: NULL without; f: HOOKE_TILE each */
  int64_t seen, done;                   /* particles in the window and springs in the ring so far */
  int64_t lost;
};

struct hk_tiled_scratch {
  int32_t workers, damped;
  struct hk_tiled_partition *partition;
  const struct hk_tiled_loops *loops;
  int64_t memory;
};

#endif
