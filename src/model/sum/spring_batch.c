#include "model/sum/spring_batch.h"
#include "model/sum/tiled.h"

static int64_t at_most(int64_t count) {
  return count < HOOKE_SPRING_BATCH ? count : HOOKE_SPRING_BATCH;
}

/* ---- by runs ---- */

/* Of one material, and of one offset: numbers that nobody has to look up. The first batch of a run is the
 * longest, and has the material of those that follow. */
static void take_plain(const struct hk_run *run, struct hk_spring_batch *batch) {
  const int32_t first = run->start + (int32_t)batch->done;
  for (int32_t k = 0; k < (int32_t)batch->count; k++) {
    batch->head[k] = first + k;
    batch->tail[k] = first + k + run->offset;
  }
  const struct hk_spring all = hk_run_spring_at(run, 0, &batch->scaler);
  for (int64_t k = 0; k < batch->count && batch->done == 0; k++) {
    batch->kappa[k] = all.kappa;
    batch->gamma[k] = all.gamma;
    batch->rest_length[k] = all.rest_length;
  }
}

static void take_any(const struct hk_run *run, struct hk_spring_batch *batch) {
  for (int64_t k = 0; k < batch->count; k++) {
    const ptrdiff_t at = batch->done + k;
    const struct hk_material m = hk_scaled(hk_run_material(run, at), run->scaling, &batch->scaler);
    batch->head[k] = (int32_t)hk_run_head(run, at);
    batch->tail[k] = (int32_t)hk_run_tail(run, at);
    batch->kappa[k] = m.kappa;
    batch->gamma[k] = m.gamma;
    batch->rest_length[k] = m.rest_length;
  }
}

static void take_run(const struct hk_run *run, struct hk_spring_batch *batch) {
  batch->count = at_most(run->count - batch->done);
  batch->damped = (run->shape & HOOKE_RUN_DAMPED) != 0;
  batch->pull_only = (run->shape & HOOKE_RUN_PULL_ONLY) != 0;
  batch->consecutive = (run->shape & HOOKE_RUN_INDEXED) == 0;
  batch->curve = run->curve;
  batch->scale = run->curve ? hk_run_spring_at(run, 0, &batch->scaler).scale : 1.0;
  if (batch->consecutive && !(run->shape & HOOKE_RUN_MIXED))
    take_plain(run, batch);
  else
    take_any(run, batch);
  batch->done += batch->count;
}

static int32_t next_of_runs(const struct hk_springs *springs, struct hk_spring_batch *batch) {
  while (batch->row < springs->run_count && batch->done == springs->run[batch->row].count) {
    batch->row++;
    batch->done = 0;
  }
  batch->count = 0;
  if (batch->row < springs->run_count) take_run(&springs->run[batch->row], batch);
  return batch->count > 0;
}

/* ---- by tiles ---- */

static void take_ends(const struct hk_tiled *tiled, int64_t tile, struct hk_spring_batch *batch) {
  const int64_t first = tile * HOOKE_TILE, first_row = first % tiled->rows;
  const uint16_t *narrow = tiled->upper;
  const uint32_t *wide = tiled->upper;
  for (int64_t k = 0; k < batch->count; k++) {
    const int64_t row = tiled->wide ? wide[batch->at + k] : narrow[batch->at + k];
    const int64_t lower = first + tiled->lower[batch->at + k];
    const int64_t upper = first + (row - first_row) + (row < first_row ? tiled->rows : 0);
    batch->head[k] = tiled->order ? tiled->order[lower] : (int32_t)lower;
    batch->tail[k] = tiled->order ? tiled->order[upper] : (int32_t)upper;
  }
}

static void take_material(const struct hk_tiled *tiled, const struct hk_tiled_kind *kind,
                          struct hk_spring_batch *batch) {
  const int32_t each = kind->shape & HOOKE_TILED_MIXED; /* 0: one material */
  struct hk_material m = {0};
  for (int64_t k = 0; k < batch->count; k++) {
    if (k == 0 || each)
      m = hk_scaled(hk_tiled_material(tiled, kind, batch->at + k), kind->scaling, &batch->scaler);
    batch->kappa[k] = m.kappa;
    batch->gamma[k] = m.gamma;
    batch->rest_length[k] = m.rest_length;
  }
}

static int32_t next_of_tiled(const struct hk_tiled *tiled, struct hk_spring_batch *batch) {
  const int64_t rows = tiled->tiles * tiled->kinds;
  while (batch->row < rows && batch->done == tiled->batch[batch->row]) {
    batch->row++;
    batch->done = 0;
  }
  batch->at += batch->count;
  batch->count = 0;
  if (batch->row == rows) return 0;
  const struct hk_tiled_kind *kind = &tiled->kind[batch->row % tiled->kinds];
  batch->count = at_most(tiled->batch[batch->row] - batch->done);
  batch->damped = (kind->shape & HOOKE_TILED_DAMPED) != 0;
  batch->pull_only = (kind->shape & HOOKE_TILED_PULL_ONLY) != 0;
  batch->consecutive = 0;
  take_ends(tiled, batch->row / tiled->kinds, batch);
  take_material(tiled, kind, batch);
  batch->done += batch->count;
  return 1;
}

int32_t hk_next_batch(const hooke_system *system, struct hk_spring_batch *batch) {
  if (system->tiled->stored) return next_of_tiled(system->tiled, batch);
  return next_of_runs(system->springs, batch);
}
