/* Iteration over all springs of a system in batches, in memory order: by number, or by the tiles of a tiled
 * batch, whose springs are in no order. For sums and counts that treat all springs alike; the order is fixed
 * by the system, so that sums always have the same bits. */
#pragma once

#include "kernel/energy_loops.h"
#include "model/force/spring.h"
#include "model/particles.h"

enum { HOOKE_SPRING_BATCH = HOOKE_ELEMENTS };

struct hk_spring_batch {
  int64_t count;
  int32_t damped, pull_only;
  const struct hk_curve *curve; /* of all; NULL: they are linear */
  double scale;                 /* factor on its tension */
  int32_t consecutive;          /* 1: spring k joins particles head[0] + k and tail[0] + k */
  int32_t head[HOOKE_SPRING_BATCH],
      tail[HOOKE_SPRING_BATCH]; /* in a tiled batch the first end may be the second one as given */
  double kappa[HOOKE_SPRING_BATCH], gamma[HOOKE_SPRING_BATCH], rest_length[HOOKE_SPRING_BATCH];

  struct hk_scaler scaler;
  int64_t row, done; /* position: a run, or a tile and kind; next spring in it */
  int64_t at;        /* index in the tiled batch */
};

/* Starts before the first batch, for the springs of time t; fetches the next one, or returns 0 if there are
 * none. */
static inline void hk_begin_batches(double t, struct hk_spring_batch *batch) {
  batch->scaler = (struct hk_scaler){.t = t};
  batch->count = batch->row = batch->done = batch->at = 0;
  batch->curve = NULL;
  batch->scale = 1.0;
}
int32_t hk_next_batch(const hooke_system *system, struct hk_spring_batch *batch);

static inline struct hk_spring hk_batch_spring(const struct hk_spring_batch *batch, int64_t k) {
  return (struct hk_spring){batch->head[k],        batch->tail[k],   batch->kappa[k], batch->gamma[k],
                            batch->rest_length[k], batch->pull_only, batch->curve,    batch->scale};
}

static inline struct hk_some_springs hk_batch_springs(const struct hk_spring_batch *batch) {
  return (struct hk_some_springs){.count = batch->count,
                                  .consecutive = batch->consecutive,
                                  .head = batch->head,
                                  .tail = batch->tail,
                                  .kappa = batch->kappa,
                                  .gamma = batch->gamma,
                                  .rest_length = batch->rest_length};
}
