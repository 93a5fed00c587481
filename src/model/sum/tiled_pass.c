/* The pass over tiles: fills the window, then the ring, sums, and passes the tile on. Workers of a thread
 * pool have nearly equal ranges of tiles, the same in every pass. */
#include "model/sum/tiled.h"

#include "core/memory.h"
#include "model/sum/motion.h"

#include <string.h>

/* ---- the part of each worker, and its data ---- */

/* A worker has the tiles `first` .. `end` - 1. Before any particle moves it computes the springs of the tiles
 * from `begin` on that end in its own, and saves the rows of the particles from its last one to `saved_end` -
 * 1, which others move. */
struct partition {
  int64_t begin, first, end, saved_end;
  const void *slot;                     /* of the first force on the first particle */
  double *rows, *forces, *saved, *f[3]; /* saved: NULL without; f: HOOKE_TILE each */
  int64_t seen, done;                   /* particles in the window and springs in the ring so far */
  int64_t lost;
};

struct hk_tiled_scratch {
  int32_t workers, damped;
  struct partition *partition;
  const struct hk_tiled_loops *loops;
  int64_t memory;
};

/* Cost of moving a particle, in springs. */
enum { WORK_OF_PARTICLE = 2 };

static int64_t work_before(const struct hk_tiled *tiled, int64_t tile) {
  return tile == 0 ? 0 : tiled->tile[tile - 1].end + (int64_t)WORK_OF_PARTICLE * HOOKE_TILE * tile;
}

/* The first tile with at least this much work before it. */
static int64_t tile_at(const struct hk_tiled *tiled, int64_t work) {
  int64_t low = 0, high = tiled->tiles;
  while (low < high) {
    const int64_t middle = (low + high) / 2;
    if (work_before(tiled, middle) < work)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The first tile whose springs, or those of a later tile, end in `first` .. `end` - 1. */
static int64_t begin_of(const struct hk_tiled *tiled, int64_t first, int64_t end) {
  int64_t before = tiled->springs, tile = first;
  for (int64_t t = first; t < end; t++) {
    if (tiled->tile[t].before < before) before = tiled->tile[t].before;
  }
  while (tile > 0 && tiled->tile[tile - 1].end > before)
    tile--;
  return tile;
}

static const void *place_of(const struct hk_tiled *tiled, int64_t particle) {
  int64_t at = 0;
  for (int64_t p = 0; p < particle; p++)
    at += tiled->degree[p];
  return tiled->wide ? (const void *)((const uint32_t *)tiled->force + at)
                     : (const void *)((const uint16_t *)tiled->force + at);
}

static void slot(const struct hk_tiled *tiled, int32_t worker, int32_t workers, struct partition *partition) {
  const int64_t work = work_before(tiled, tiled->tiles);
  partition->first = tile_at(tiled, work * worker / workers);
  partition->end = tile_at(tiled, work * (worker + 1) / workers);
  partition->begin = begin_of(tiled, partition->first, partition->end);
  const int64_t first = partition->first * HOOKE_TILE; /* past the last particle if no tile is left */
  partition->slot = place_of(tiled, first < tiled->particles ? first : tiled->particles);
  partition->saved_end = partition->end > partition->first ? tiled->tile[partition->end - 1].reach : 0;
}

static int64_t saved_rows(const struct partition *partition) {
  const int64_t rows = partition->saved_end - partition->end * HOOKE_TILE;
  return rows > 0 ? rows : 0;
}

/* A separate block for each worker, so that no two write to one page. */
static int32_t new_block(const struct hk_tiled *tiled, struct partition *partition, int64_t *memory) {
  const int64_t numbers =
      hk_tiled_numbers(tiled) + HOOKE_TILED_ROW * saved_rows(partition) + (int64_t)3 * HOOKE_TILE;
  double *block = hk_new(numbers, sizeof(double));
  if (block == NULL) return 0;
  *memory += numbers * (int64_t)sizeof(double);
  partition->rows = block;
  partition->saved = partition->rows + HOOKE_TILED_ROW * tiled->rows;
  partition->forces = partition->saved + HOOKE_TILED_ROW * saved_rows(partition);
  for (int64_t a = 0; a < 3; a++)
    partition->f[a] = partition->forces + HOOKE_TILED_FORCE * (tiled->list + tiled->ring) + a * HOOKE_TILE;
  return 1;
}

struct hk_tiled_scratch *hk_tiled_scratch_create(const struct hk_tiled *tiled, int32_t workers) {
  struct hk_tiled_scratch *scratch = hk_new(1, sizeof *scratch);
  if (scratch == NULL) return NULL;
  scratch->workers = workers;
  scratch->loops = hk_spring_set(0)->tiled;
  for (int32_t c = 0; c < tiled->kinds; c++)
    scratch->damped |= tiled->kind[c].shape & HOOKE_TILED_DAMPED;
  scratch->partition = hk_new(workers, sizeof *scratch->partition);
  scratch->memory = (int64_t)sizeof *scratch + workers * (int64_t)sizeof *scratch->partition;
  int there = scratch->partition != NULL;
  for (int32_t m = 0; m < workers && there; m++) {
    slot(tiled, m, workers, &scratch->partition[m]);
    there = new_block(tiled, &scratch->partition[m], &scratch->memory);
  }
  if (there) return scratch;
  hk_tiled_scratch_destroy(scratch);
  return NULL;
}

void hk_tiled_scratch_destroy(struct hk_tiled_scratch *scratch) {
  if (scratch == NULL) return;
  for (int32_t m = 0; m < scratch->workers && scratch->partition; m++)
    hk_free(scratch->partition[m].rows);
  hk_free(scratch->partition);
  hk_free(scratch);
}

int64_t hk_tiled_scratch_memory(const struct hk_tiled_scratch *scratch) {
  return scratch ? scratch->memory : 0;
}

/* ---- the pass ---- */

struct pass {
  const struct hk_tiled *tiled;
  struct hk_motion *motion;
  hk_tile *tile;
  void *ctx;
  const struct hk_scaler *scaler; /* of each kind that follows time */
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
static void fill_rows(const struct pass *pass, struct partition *partition, int64_t to, int64_t saved) {
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

/* Their material at the time of the pass, which each has of its own unless the kind shares all of it. */
struct scaled {
  double kappa[HOOKE_TILED_BATCH], gamma[HOOKE_TILED_BATCH], rest_length[HOOKE_TILED_BATCH];
};

static void scale(const struct pass *pass, int32_t c, int64_t at, int64_t count, struct scaled *to,
                  struct hk_tiled_springs *springs) {
  const struct hk_tiled_kind *kind = &pass->tiled->kind[c];
  struct hk_scaler scaler = pass->scaler[c];
  for (int64_t k = 0; k < count; k++) {
    const struct hk_material m =
        hk_scaled(hk_tiled_material(pass->tiled, kind, at + k), kind->scaling, &scaler);
    springs->kappa = to->kappa[k] = m.kappa;
    springs->gamma = to->gamma[k] = m.gamma;
    springs->rest_length = to->rest_length[k] = m.rest_length;
  }
  springs->kappas = to->kappa;
  springs->gammas = to->gamma;
  springs->rest_lengths = to->rest_length;
}

static int32_t shape_of(const struct hk_tiled *tiled, const struct hk_tiled_kind *kind) {
  const int32_t own = kind->scaling && kind->shape & HOOKE_TILED_MIXED ? HOOKE_TILED_MIXED : 0;
  return kind->shape | own | (tiled->wide ? HOOKE_TILED_WIDE : 0);
}

/* Computes the next `count` springs, of one kind and one tile, into the ring. */
static void fill_kind(const struct pass *pass, struct partition *partition, int64_t tile, int32_t c,
                      int64_t count) {
  const struct hk_tiled *tiled = pass->tiled;
  const struct hk_tiled_kind *kind = &tiled->kind[c];
  const double *low = partition->rows + HOOKE_TILED_ROW * (tile * HOOKE_TILE % tiled->rows);
  const int32_t left_out = pass->motion->zero ? HOOKE_TILED_DAMPED : 0;
  hk_tiled_fill *fill = pass->motion->tiled->loops->fill[shape_of(tiled, kind) & ~left_out];
  struct scaled scaled;
  const int64_t first = tile > 0 ? tiled->tile[tile - 1].end : 0, end = partition->done + count;
  while (partition->done < end) {
    const int64_t at = partition->done % tiled->ring,
                  some = least(least(end - partition->done, tiled->ring - at), HOOKE_TILED_BATCH);
    struct hk_tiled_springs springs = springs_at(tiled, kind, partition->done);
    if (kind->scaling) scale(pass, c, partition->done, some, &scaled, &springs);
    partition->lost += fill(&springs, (ptrdiff_t)some, low, partition->rows,
                            partition->forces + HOOKE_TILED_FORCE * (partition->done - first),
                            partition->forces + HOOKE_TILED_FORCE * (tiled->list + at));
    partition->done += some;
  }
}

static void fill_tile(const struct pass *pass, struct partition *partition, int64_t tile, int64_t saved) {
  const struct hk_tiled *tiled = pass->tiled;
  fill_rows(pass, partition, tiled->tile[tile].reach, saved);
  for (int32_t c = 0; c < tiled->kinds; c++)
    fill_kind(pass, partition, tile, c, tiled->batch[tile * tiled->kinds + c]);
}

/* Reads everything that is needed before anyone moves. */
static void prepare(const struct pass *pass, struct partition *partition) {
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
  struct partition *partition = &m->tiled->partition[worker];
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

int64_t hk_tiled_pass(const struct hk_tiled *tiled, struct hk_motion *motion, double t, hk_tile *tile,
                      void *ctx) {
  struct hk_scaler scaler[HOOKE_TILED_KINDS]; /* to clear all takes a sixth of a small scene's step */
  struct pass pass = {.tiled = tiled, .motion = motion, .tile = tile, .ctx = ctx, .scaler = scaler};
  for (int32_t c = 0; c < tiled->kinds; c++) {
    if (tiled->kind[c].scaling == NULL) continue;
    scaler[c] = (struct hk_scaler){.t = t};
    hk_scaler_find(&scaler[c], tiled->kind[c].scaling);
  }
  int64_t lost = 0;
  hk_pool_run(motion->pool, go_over, &pass);
  for (int32_t m = 0; m < motion->tiled->workers; m++)
    lost += motion->tiled->partition[m].lost;
  return lost;
}
