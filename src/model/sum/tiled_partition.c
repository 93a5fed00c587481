/* Partition of a tiled batch: nearly equal ranges of tiles, the same in every pass. */
#include "model/sum/tiled_partition.h"

#include "core/memory.h"

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

static void slot(const struct hk_tiled *tiled, int32_t worker, int32_t workers,
                 struct hk_tiled_partition *partition) {
  const int64_t work = work_before(tiled, tiled->tiles);
  partition->first = tile_at(tiled, work * worker / workers);
  partition->end = tile_at(tiled, work * (worker + 1) / workers);
  partition->begin = begin_of(tiled, partition->first, partition->end);
  const int64_t first = partition->first * HOOKE_TILE; /* past the last particle if no tile is left */
  partition->slot = place_of(tiled, first < tiled->particles ? first : tiled->particles);
  partition->saved_end = partition->end > partition->first ? tiled->tile[partition->end - 1].reach : 0;
}

static int64_t saved_rows(const struct hk_tiled_partition *partition) {
  const int64_t rows = partition->saved_end - partition->end * HOOKE_TILE;
  return rows > 0 ? rows : 0;
}

/* A separate block for each worker, so that no two write to one page. */
static int32_t new_block(const struct hk_tiled *tiled, struct hk_tiled_partition *partition,
                         int64_t *memory) {
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
