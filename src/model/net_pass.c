/* The pass over tiles: fills the window, then the ring, sums, hands the tile on. */
#include "model/net.h"

#include "core/memory.h"
#include "model/motion.h"

struct hooke_net_scratch {
  double *rows, *pairs, *f[3]; /* f: HOOKE_TILE each */
  const struct hooke_net_loops *loops;
  int64_t memory;
};

struct hooke_net_scratch *hooke_net_scratch_create(const struct hooke_net *net) {
  const int64_t numbers = HOOKE_NET_ROW * (net->rows + net->pairs) + 3 * HOOKE_TILE;
  struct hooke_net_scratch *scratch = hooke_new(1, sizeof *scratch);
  double *block = hooke_new(numbers, sizeof(double));
  if (scratch == NULL || block == NULL) {
    hooke_free(scratch);
    hooke_free(block);
    return NULL;
  }
  scratch->rows = block;
  scratch->pairs = block + HOOKE_NET_ROW * net->rows;
  for (int a = 0; a < 3; a++)
    scratch->f[a] = scratch->pairs + HOOKE_NET_ROW * net->pairs + a * HOOKE_TILE;
  scratch->loops = hooke_spring_set(0)->net;
  scratch->memory = (int64_t)sizeof *scratch + numbers * (int64_t)sizeof(double);
  return scratch;
}

void hooke_net_scratch_destroy(struct hooke_net_scratch *scratch) {
  if (scratch == NULL) return;
  hooke_free(scratch->rows);
  hooke_free(scratch);
}

int64_t hooke_net_scratch_memory(const struct hooke_net_scratch *scratch) {
  return scratch ? scratch->memory : 0;
}

static int is_damped(const struct hooke_net *net) {
  int damped = 0;
  for (int32_t c = 0; c < net->classes; c++)
    damped |= net->class[c].shape & HOOKE_NET_DAMPED;
  return damped;
}

/* Rows of particles `from` .. `to` - 1, in the ring of rows. */
static void fill_rows(const struct hooke_net *net, const struct hooke_motion *m, int64_t from, int64_t to) {
  const int damped = is_damped(net);
  const int32_t *order = m->order ? NULL : net->order;
  while (from < to) {
    const int64_t at = from % net->rows, room = net->rows - at, count = to - from < room ? to - from : room;
    const double *q[3], *v[3];
    for (int a = 0; a < 3; a++) {
      q[a] = order ? m->q[a] : m->q[a] + from;
      v[a] = order ? m->v[a] : m->v[a] + from;
    }
    hooke_net_rows((ptrdiff_t)count, order ? order + from : NULL, q, damped ? v : NULL,
                   m->net->rows + HOOKE_NET_ROW * at);
    from += count;
  }
}

static struct hooke_net_springs springs_at(const struct hooke_net *net, const struct hooke_net_class *class,
                                           int64_t at) {
  const char *upper = net->upper;
  struct hooke_net_springs springs = {.lower = net->lower + at,
                                      .upper = upper + at * (int64_t)(net->wide ? 4 : 2),
                                      .kappa = class->kappa,
                                      .gamma = class->gamma,
                                      .rest_length = class->rest_length};
  if (net->rest_length) springs.rest_lengths = net->rest_length + at;
  if (net->kappa) springs.kappas = net->kappa + at;
  if (net->gamma) springs.gammas = net->gamma + at;
  return springs;
}

/* Springs `from` .. `to` - 1, of one class and of one tile, into the ring. */
static int64_t fill_class(const struct hooke_net *net, const struct hooke_net_scratch *scratch, int64_t tile,
                          int32_t c, int64_t from, int64_t to) {
  const struct hooke_net_class *class = &net->class[c];
  const double *low = scratch->rows + HOOKE_NET_ROW * (tile * HOOKE_TILE % net->rows);
  hooke_net_fill *fill = scratch->loops->fill[class->shape | (net->wide ? HOOKE_NET_WIDE : 0)];
  int64_t lost = 0;
  while (from < to) {
    const int64_t at = from % net->pairs, room = net->pairs - at;
    int64_t count = to - from < room ? to - from : room;
    if (count > HOOKE_NET_BATCH) count = HOOKE_NET_BATCH;
    const struct hooke_net_springs springs = springs_at(net, class, from);
    lost += fill(&springs, (ptrdiff_t)count, low, scratch->rows, scratch->pairs + HOOKE_NET_ROW * at);
    from += count;
  }
  return lost;
}

int64_t hooke_net_pass(const struct hooke_net *net, struct hooke_motion *m, hooke_tile *tile, void *ctx) {
  struct hooke_net_scratch *scratch = m->net;
  const void *half = net->half;
  int64_t lost = 0, at = 0, seen = 0;
  for (int64_t t = 0; t < net->tiles; t++) {
    const int64_t from = t * HOOKE_TILE,
                  end = from + HOOKE_TILE < net->particles ? from + HOOKE_TILE : net->particles;
    fill_rows(net, m, seen, net->tile[t].reach);
    seen = net->tile[t].reach;
    for (int32_t c = 0; c < net->classes; c++) {
      const int64_t count = net->batch[t * net->classes + c];
      lost += fill_class(net, scratch, t, c, at, at + count);
      at += count;
    }
    half = scratch->loops->sum[net->wide](end - from, net->degree + from, half, scratch->pairs, scratch->f);
    tile(from, end - from, scratch->f, ctx);
  }
  return lost;
}
