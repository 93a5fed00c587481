/* The pass over tiles: fills the window, then the ring, sums, hands the tile on. */
#include "model/sum/net_share.h"

#include "model/sum/motion.h"

#include <string.h>

struct pass {
  const struct hk_net *net;
  struct hk_motion *motion;
  hk_tile *tile;
  void *ctx;
};

static int64_t least(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* Rows of particles `from` .. `to` - 1, as they are now. */
static void copy_rows(const struct pass *pass, int64_t from, int64_t to, double *rows) {
  const struct hk_motion *m = pass->motion;
  const int32_t *order = m->order ? NULL : pass->net->order;
  const double *q[3], *v[3];
  for (int a = 0; a < 3; a++) {
    q[a] = order ? m->q[a] : m->q[a] + from;
    v[a] = order ? m->v[a] : m->v[a] + from;
  }
  m->net->loops->rows((ptrdiff_t)(to - from), order ? order + from : NULL, q, m->net->damped ? v : NULL,
                      rows);
}

/* The window reaches to particle `to` - 1; those from `saved` on are taken from what was saved. */
static void fill_rows(const struct pass *pass, struct hk_net_share *share, int64_t to, int64_t saved) {
  const struct hk_net *net = pass->net;
  while (share->seen < to) {
    const int64_t from = share->seen, at = from % net->rows, end = least(to, from + net->rows - at);
    double *rows = share->rows + HOOKE_NET_ROW * at;
    const int64_t cut = from < saved ? least(end, saved) : end;
    if (from < saved)
      copy_rows(pass, from, cut, rows);
    else
      memcpy(rows, share->saved + HOOKE_NET_ROW * (from - saved),
             (size_t)(cut - from) * HOOKE_NET_ROW * sizeof *rows);
    share->seen = cut;
  }
}

static struct hk_net_springs springs_at(const struct hk_net *net, const struct hk_net_class *class,
                                        int64_t at) {
  const char *upper = net->upper;
  struct hk_net_springs springs = {.lower = net->lower + at,
                                   .upper = upper + at * (int64_t)(net->wide ? 4 : 2),
                                   .kappa = class->kappa,
                                   .gamma = class->gamma,
                                   .rest_length = class->rest_length};
  if (net->rest_length) springs.rest_lengths = net->rest_length + at;
  if (net->kappa) springs.kappas = net->kappa + at;
  if (net->gamma) springs.gammas = net->gamma + at;
  return springs;
}

/* The next `count` springs, of one class and of one tile, into the ring. */
static void fill_class(const struct pass *pass, struct hk_net_share *share, int64_t tile, int32_t c,
                       int64_t count) {
  const struct hk_net *net = pass->net;
  const struct hk_net_class *class = &net->class[c];
  const double *low = share->rows + HOOKE_NET_ROW * (tile * HOOKE_TILE % net->rows);
  const int32_t shape = pass->motion->zero ? class->shape & ~HOOKE_NET_DAMPED : class->shape;
  hk_net_fill *fill = pass->motion->net->loops->fill[shape | (net->wide ? HOOKE_NET_WIDE : 0)];
  const int64_t first = tile > 0 ? net->tile[tile - 1].end : 0, end = share->done + count;
  while (share->done < end) {
    const int64_t at = share->done % net->ring,
                  some = least(least(end - share->done, net->ring - at), HOOKE_NET_BATCH);
    const struct hk_net_springs springs = springs_at(net, class, share->done);
    share->lost += fill(&springs, (ptrdiff_t)some, low, share->rows,
                        share->forces + HOOKE_NET_FORCE * (share->done - first),
                        share->forces + HOOKE_NET_FORCE * (net->list + at));
    share->done += some;
  }
}

static void fill_tile(const struct pass *pass, struct hk_net_share *share, int64_t tile, int64_t saved) {
  const struct hk_net *net = pass->net;
  fill_rows(pass, share, net->tile[tile].reach, saved);
  for (int32_t c = 0; c < net->classes; c++)
    fill_class(pass, share, tile, c, net->batch[tile * net->classes + c]);
}

/* What has to be read before anyone moves. */
static void prepare(const struct pass *pass, struct hk_net_share *share) {
  const struct hk_net *net = pass->net;
  share->seen = share->begin * HOOKE_TILE;
  share->done = share->begin > 0 ? net->tile[share->begin - 1].end : 0;
  for (int64_t t = share->begin; t < share->first; t++)
    fill_tile(pass, share, t, net->particles);
  share->lost = 0; /* others count these springs */
  const int64_t from = share->end * HOOKE_TILE;
  if (from < share->saved_end) copy_rows(pass, from, share->saved_end, share->saved);
}

static void go_over(int32_t worker, int32_t workers, void *ctx) {
  (void)workers;
  const struct pass *pass = ctx;
  const struct hk_net *net = pass->net;
  struct hk_motion *m = pass->motion;
  struct hk_net_share *share = &m->net->share[worker];
  const void *place = share->place;
  prepare(pass, share);
  hk_pool_barrier(m->pool);
  for (int64_t t = share->first; t < share->end; t++) {
    const int64_t from = t * HOOKE_TILE, end = least(from + HOOKE_TILE, net->particles);
    fill_tile(pass, share, t, share->end * HOOKE_TILE);
    place = m->net->loops->sum[net->wide](end - from, net->degree + from, place, share->forces, share->f);
    pass->tile(from, end - from, share->f, pass->ctx);
  }
}

int64_t hk_net_pass(const struct hk_net *net, struct hk_motion *motion, hk_tile *tile, void *ctx) {
  struct pass pass = {net, motion, tile, ctx};
  int64_t lost = 0;
  hk_pool_run(motion->pool, go_over, &pass);
  for (int32_t m = 0; m < motion->net->workers; m++)
    lost += motion->net->share[m].lost;
  return lost;
}
