#include "model/sum/spring_batch.h"

#include "kernel/spring_body.h"

static int64_t at_most(int64_t count) {
  return count < HOOKE_SPRING_BATCH ? count : HOOKE_SPRING_BATCH;
}

/* ---- by runs ---- */

static void take_run(const struct hk_run *run, struct hk_spring_batch *batch) {
  batch->count = at_most(run->count - batch->done);
  batch->damped = (run->shape & HOOKE_RUN_DAMPED) != 0;
  batch->pull_only = (run->shape & HOOKE_RUN_PULL_ONLY) != 0;
  for (int64_t k = 0; k < batch->count; k++) {
    const struct hk_spring spring = hk_run_spring(run, batch->done + k);
    batch->head[k] = (int32_t)spring.head;
    batch->tail[k] = (int32_t)spring.tail;
    batch->kappa[k] = spring.kappa;
    batch->gamma[k] = spring.gamma;
    batch->rest_length[k] = spring.rest_length;
  }
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

static void take_ends(const struct hk_net *net, int64_t tile, struct hk_spring_batch *batch) {
  const int64_t first = tile * HOOKE_TILE, first_row = first % net->rows;
  const uint16_t *narrow = net->upper;
  const uint32_t *wide = net->upper;
  for (int64_t k = 0; k < batch->count; k++) {
    const int64_t row = net->wide ? wide[batch->at + k] : narrow[batch->at + k];
    const int64_t lower = first + net->lower[batch->at + k];
    const int64_t upper = first + (row - first_row) + (row < first_row ? net->rows : 0);
    batch->head[k] = net->order ? net->order[lower] : (int32_t)lower;
    batch->tail[k] = net->order ? net->order[upper] : (int32_t)upper;
  }
}

/* As the loops of the net have it, to the bit. */
static void take_material(const struct hk_net *net, const struct hk_net_class *class,
                          struct hk_spring_batch *batch) {
  const int32_t form = class->shape & HOOKE_NET_MIXED;
  for (int64_t k = 0; k < batch->count; k++) {
    const double length = form ? net->rest_length[batch->at + k] : class->rest_length;
    batch->rest_length[k] = length;
    batch->kappa[k] = form == HOOKE_NET_MIXED    ? net->kappa[batch->at + k]
                      : form == HOOKE_NET_STRAIN ? class->kappa / length
                                                 : class->kappa;
    batch->gamma[k] = form == HOOKE_NET_MIXED    ? net->gamma[batch->at + k]
                      : form == HOOKE_NET_STRAIN ? class->gamma / length
                                                 : class->gamma;
  }
}

static int32_t next_of_net(const struct hk_net *net, struct hk_spring_batch *batch) {
  const int64_t rows = net->tiles * net->classes;
  while (batch->row < rows && batch->done == net->batch[batch->row]) {
    batch->row++;
    batch->done = 0;
  }
  batch->at += batch->count;
  batch->count = 0;
  if (batch->row == rows) return 0;
  const struct hk_net_class *class = &net->class[batch->row % net->classes];
  batch->count = at_most(net->batch[batch->row] - batch->done);
  batch->damped = (class->shape & HOOKE_NET_DAMPED) != 0;
  batch->pull_only = (class->shape & HOOKE_NET_PULL_ONLY) != 0;
  take_ends(net, batch->row / net->classes, batch);
  take_material(net, class, batch);
  batch->done += batch->count;
  return 1;
}

int32_t hk_next_batch(const hooke_system *system, struct hk_spring_batch *batch) {
  if (system->net.particles > 0) return next_of_net(&system->net, batch);
  return next_of_runs(&system->springs, batch);
}

void hk_batch_lengths(const struct hk_spring_batch *batch, const double *q, double *length) {
  for (int64_t k = 0; k < batch->count; k++) {
    const double *qi = q + 3 * (int64_t)batch->head[k], *qj = q + 3 * (int64_t)batch->tail[k];
    length[k] = hk_spring_length(qi[0] - qj[0], qi[1] - qj[1], qi[2] - qj[2]);
  }
}
