/* The pass over tiles: fills the window, then the ring, sums, and passes the tile on. */
#include "model/sum/tiled_partition.h"

#include "model/sum/motion.h"

#include <string.h>

struct pass {
  const struct hk_tiled *tiled;
  struct hk_motion *motion;
  hk_tile *tile;
  void *ctx;
};

static int64_t least(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* Rows of the current particles `from` .. `to` - 1. */
static void copy_rows(const struct pass *pass, int64_t from, int64_t to, double *rows) {
  const struct hk_motion *m = pass->motion;
  const int32_t *order = m->order ? NULL : pass->tiled->order;
  const double *q[3], *v[3];
  for (int a = 0; a < 3; a++) {
    q[a] = order ? m->q[a] : m->q[a] + from;
    v[a] = order ? m->v[a] : m->v[a] + from;
  }
  m->tiled->loops->rows((ptrdiff_t)(to - from), order ? order + from : NULL, q, m->tiled->damped ? v : NULL,
                        rows);
}

/* Extends the window to particle `to` - 1; those from `saved` on come from the saved rows. */
static void fill_rows(const struct pass *pass, struct hk_tiled_partition *partition, int64_t to,
                      int64_t saved) {
  const struct hk_tiled *tiled = pass->tiled;
  while (partition->seen < to) {
    const int64_t from = partition->seen, at = from % tiled->rows, end = least(to, from + tiled->rows - at);
    double *rows = partition->rows + HOOKE_TILED_ROW * at;
    const int64_t cut = from < saved ? least(end, saved) : end;
    if (from < saved)
      copy_rows(pass, from, cut, rows);
    else
      memcpy(rows, partition->saved + HOOKE_TILED_ROW * (from - saved),
             (size_t)(cut - from) * HOOKE_TILED_ROW * sizeof *rows);
    partition->seen = cut;
  }
}

static struct hk_tiled_springs springs_at(const struct hk_tiled *tiled, const struct hk_tiled_kind *kind,
                                          int64_t at) {
  const char *upper = tiled->upper;
  struct hk_tiled_springs springs = {.lower = tiled->lower + at,
                                     .upper = upper + at * (int64_t)(tiled->wide ? 4 : 2),
                                     .kappa = kind->kappa,
                                     .gamma = kind->gamma,
                                     .rest_length = kind->rest_length};
  if (tiled->rest_length) springs.rest_lengths = tiled->rest_length + at;
  if (tiled->kappa) springs.kappas = tiled->kappa + at;
  if (tiled->gamma) springs.gammas = tiled->gamma + at;
  return springs;
}

/* Computes the next `count` springs, of one kind and one tile, into the ring. */
static void fill_kind(const struct pass *pass, struct hk_tiled_partition *partition, int64_t tile, int32_t c,
                      int64_t count) {
  const struct hk_tiled *tiled = pass->tiled;
  const struct hk_tiled_kind *kind = &tiled->kind[c];
  const double *low = partition->rows + HOOKE_TILED_ROW * (tile * HOOKE_TILE % tiled->rows);
  const int32_t shape = pass->motion->zero ? kind->shape & ~HOOKE_TILED_DAMPED : kind->shape;
  hk_tiled_fill *fill = pass->motion->tiled->loops->fill[shape | (tiled->wide ? HOOKE_TILED_WIDE : 0)];
  const int64_t first = tile > 0 ? tiled->tile[tile - 1].end : 0, end = partition->done + count;
  while (partition->done < end) {
    const int64_t at = partition->done % tiled->ring,
                  some = least(least(end - partition->done, tiled->ring - at), HOOKE_TILED_BATCH);
    const struct hk_tiled_springs springs = springs_at(tiled, kind, partition->done);
    partition->lost += fill(&springs, (ptrdiff_t)some, low, partition->rows,
                            partition->forces + HOOKE_TILED_FORCE * (partition->done - first),
                            partition->forces + HOOKE_TILED_FORCE * (tiled->list + at));
    partition->done += some;
  }
}

static void fill_tile(const struct pass *pass, struct hk_tiled_partition *partition, int64_t tile,
                      int64_t saved) {
  const struct hk_tiled *tiled = pass->tiled;
  fill_rows(pass, partition, tiled->tile[tile].reach, saved);
  for (int32_t c = 0; c < tiled->kinds; c++)
    fill_kind(pass, partition, tile, c, tiled->batch[tile * tiled->kinds + c]);
}

/* Reads everything that is needed before anyone moves. */
static void prepare(const struct pass *pass, struct hk_tiled_partition *partition) {
  const struct hk_tiled *tiled = pass->tiled;
  partition->seen = partition->begin * HOOKE_TILE;
  partition->done = partition->begin > 0 ? tiled->tile[partition->begin - 1].end : 0;
  for (int64_t t = partition->begin; t < partition->first; t++)
    fill_tile(pass, partition, t, tiled->particles);
  partition->lost = 0; /* others count these springs */
  const int64_t from = partition->end * HOOKE_TILE;
  if (from < partition->saved_end) copy_rows(pass, from, partition->saved_end, partition->saved);
}

static void go_over(int32_t worker, int32_t workers, void *ctx) {
  (void)workers;
  const struct pass *pass = ctx;
  const struct hk_tiled *tiled = pass->tiled;
  struct hk_motion *m = pass->motion;
  struct hk_tiled_partition *partition = &m->tiled->partition[worker];
  const void *slot = partition->slot;
  prepare(pass, partition);
  hk_pool_barrier(m->pool);
  for (int64_t t = partition->first; t < partition->end; t++) {
    const int64_t from = t * HOOKE_TILE, end = least(from + HOOKE_TILE, tiled->particles);
    fill_tile(pass, partition, t, partition->end * HOOKE_TILE);
    slot = m->tiled->loops->sum[tiled->wide](end - from, tiled->degree + from, slot, partition->forces,
                                             partition->f);
    pass->tile(from, end - from, partition->f, pass->ctx);
  }
}

int64_t hk_tiled_pass(const struct hk_tiled *tiled, struct hk_motion *motion, hk_tile *tile, void *ctx) {
  struct pass pass = {tiled, motion, tile, ctx};
  int64_t lost = 0;
  hk_pool_run(motion->pool, go_over, &pass);
  for (int32_t m = 0; m < motion->tiled->workers; m++)
    lost += motion->tiled->partition[m].lost;
  return lost;
}
