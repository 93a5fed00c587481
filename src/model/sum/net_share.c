/* Shares of a net: near equal ranges of tiles, which do not change from pass to pass. */
#include "model/sum/net_share.h"

#include "core/memory.h"

/* What it takes to move a particle, in springs. */
enum { WORK_OF_PARTICLE = 2 };

static int64_t work_before(const struct hk_net *net, int64_t tile) {
  return tile == 0 ? 0 : net->tile[tile - 1].end + (int64_t)WORK_OF_PARTICLE * HOOKE_TILE * tile;
}

/* The first tile with at least this much work before it. */
static int64_t tile_at(const struct hk_net *net, int64_t work) {
  int64_t low = 0, high = net->tiles;
  while (low < high) {
    const int64_t middle = (low + high) / 2;
    if (work_before(net, middle) < work)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The first tile whose springs, or those of a tile after it, end in `first` .. `end` - 1. */
static int64_t begin_of(const struct hk_net *net, int64_t first, int64_t end) {
  int64_t before = net->springs, tile = first;
  for (int64_t t = first; t < end; t++) {
    if (net->tile[t].before < before) before = net->tile[t].before;
  }
  while (tile > 0 && net->tile[tile - 1].end > before)
    tile--;
  return tile;
}

static const void *place_of(const struct hk_net *net, int64_t particle) {
  int64_t at = 0;
  for (int64_t p = 0; p < particle; p++)
    at += net->degree[p];
  return net->wide ? (const void *)((const uint32_t *)net->force + at)
                   : (const void *)((const uint16_t *)net->force + at);
}

static void place(const struct hk_net *net, int32_t worker, int32_t workers, struct hk_net_share *share) {
  const int64_t work = work_before(net, net->tiles);
  share->first = tile_at(net, work * worker / workers);
  share->end = tile_at(net, work * (worker + 1) / workers);
  share->begin = begin_of(net, share->first, share->end);
  const int64_t first = share->first * HOOKE_TILE; /* past the last particle if no tile is left */
  share->place = place_of(net, first < net->particles ? first : net->particles);
  share->saved_end = share->end > share->first ? net->tile[share->end - 1].reach : 0;
}

static int64_t saved_rows(const struct hk_net_share *share) {
  const int64_t rows = share->saved_end - share->end * HOOKE_TILE;
  return rows > 0 ? rows : 0;
}

/* A block of its own for each worker, so that no two write to one page. */
static int32_t new_block(const struct hk_net *net, struct hk_net_share *share, int64_t *memory) {
  const int64_t numbers = hk_net_numbers(net) + HOOKE_NET_ROW * saved_rows(share) + (int64_t)3 * HOOKE_TILE;
  double *block = hk_new(numbers, sizeof(double));
  if (block == NULL) return 0;
  *memory += numbers * (int64_t)sizeof(double);
  share->rows = block;
  share->saved = share->rows + HOOKE_NET_ROW * net->rows;
  share->forces = share->saved + HOOKE_NET_ROW * saved_rows(share);
  for (int64_t a = 0; a < 3; a++)
    share->f[a] = share->forces + HOOKE_NET_FORCE * (net->list + net->ring) + a * HOOKE_TILE;
  return 1;
}

struct hk_net_scratch *hk_net_scratch_create(const struct hk_net *net, int32_t workers) {
  struct hk_net_scratch *scratch = hk_new(1, sizeof *scratch);
  if (scratch == NULL) return NULL;
  scratch->workers = workers;
  scratch->loops = hk_spring_set(0)->net;
  for (int32_t c = 0; c < net->classes; c++)
    scratch->damped |= net->class[c].shape & HOOKE_NET_DAMPED;
  scratch->share = hk_new(workers, sizeof *scratch->share);
  scratch->memory = (int64_t)sizeof *scratch + workers * (int64_t)sizeof *scratch->share;
  int there = scratch->share != NULL;
  for (int32_t m = 0; m < workers && there; m++) {
    place(net, m, workers, &scratch->share[m]);
    there = new_block(net, &scratch->share[m], &scratch->memory);
  }
  if (there) return scratch;
  hk_net_scratch_destroy(scratch);
  return NULL;
}

void hk_net_scratch_destroy(struct hk_net_scratch *scratch) {
  if (scratch == NULL) return;
  for (int32_t m = 0; m < scratch->workers && scratch->share; m++)
    hk_free(scratch->share[m].rows);
  hk_free(scratch->share);
  hk_free(scratch);
}

int64_t hk_net_scratch_memory(const struct hk_net_scratch *scratch) {
  return scratch ? scratch->memory : 0;
}
