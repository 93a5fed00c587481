/* Bounds, predictions and modes of all rows at one state. */
#include "measure/limit/limit.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/random.h"
#include "kernel/vector_loops.h"
#include "measure/spectrum/step_bound.h"
#include "model/sum/motion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int32_t find_bounds(struct hk_limit *limit, const double *q, const double *v) {
  struct hk_node_blocks blocks;
  const int32_t status = hk_node_blocks_create(limit->system, q, v, &blocks);
  if (status != HOOKE_OK) return status;
  for (int32_t k = 0; k < limit->row_count; k++)
    limit->row[k].bound = hk_step_bound_of(&blocks, limit->row[k].method, INFINITY, NULL);
  hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}

static int32_t find_row(struct hk_limit *limit, struct hk_spectrum *spectrum, double *mode,
                        struct hk_limit_row *row) {
  const int64_t n = limit->system->particle_count;
  struct hk_prediction prediction = {.mode = mode};
  const int32_t status = hk_limit_rule(spectrum, row->method, &prediction);
  if (status != HOOKE_OK) return status;
  /* a prediction of limited accuracy may come out below the bound, which is certain; NaN stays NaN */
  row->predicted = prediction.never_stable         ? 0.0
                   : prediction.limit < row->bound ? row->bound
                                                   : prediction.limit;
  row->exact = prediction.exact;
  row->never_stable = prediction.never_stable;
  row->spins = prediction.spins;
  row->has_mode = prediction.has_mode;
  snprintf(row->note, sizeof row->note, "%s", prediction.note);
  double *const component[3] = {mode, mode + n, mode + 2 * n};
  if (row->has_mode) hk_rows_from_components(n, component, row->mode);
  return HOOKE_OK;
}

/* An overdamped system has the eigenvalue -k/gamma alone, and nothing swings. */
static void find_overdamped_modes(struct hk_limit *limit, const struct hk_spectrum *s) {
  const double rate = s->linearised->rate * s->linearised->rate;
  for (int64_t k = 0; k < s->count; k++)
    limit->mode[k] =
        (struct hk_limit_mode){.real = -rate * s->value[k].stiffness, .decay = rate * s->value[k].stiffness};
  limit->frequency = 0.0;
  limit->decay = rate * s->stiffest;
}

static int32_t keep_modes(struct hk_limit *limit, const struct hk_spectrum *s) {
  const double rate = s->linearised->rate;
  limit->mode = hk_new(s->count, sizeof *limit->mode);
  if (limit->mode == NULL) return HOOKE_NO_MEMORY;
  limit->mode_count = s->count;
  for (int64_t k = 0; k < s->count; k++) {
    const struct hk_eigenvalue *v = &s->value[k];
    const double half = v->imaginary != 0.0 ? v->real : 0.5 * (v->real + v->stiffness / v->real);
    limit->mode[k] = (struct hk_limit_mode){.real = rate * v->real,
                                            .imaginary = rate * v->imaginary,
                                            .frequency = rate * sqrt(v->stiffness),
                                            .decay = -rate * half};
  }
  limit->frequency = rate * sqrt(s->stiffest);
  limit->decay = rate * s->fastest_decay;
  if (limit->system->overdamped) find_overdamped_modes(limit, s);
  limit->clamped = s->linearised->clamped;
  limit->tipping = s->linearised->rigid.tipping;
  memcpy(limit->stiffest, s->stiffest_mode, (size_t)s->linearised->size * sizeof(double));
  limit->has_stiffest = 1;
  return HOOKE_OK;
}

/* ---- buckling ---- */

/* By the power method on J + s, with J = K/gamma and s a bound of its eigenvalues: they are -s to s. A
 * growing motion that is slower than LEAST of s counts as none. */
enum { ITERATIONS = 300 };
static const double LEAST = 1e-9;

/* One iteration; returns x.Jx of the unit vector x that it began with. */
static int32_t iterate(const hooke_system *system, double t, const double *q, double shift, double *x,
                       double *product, double *growth) {
  const int64_t size = 3 * system->particle_count;
  const double *still = product + size;
  const int32_t status = hooke_system_derivative_product(system, t, q, still, x, still, product);
  *growth = 0.0;
  for (int64_t k = 0; k < size; k++) {
    const double rate = system->inverse_mass[k / 3] * product[k];
    *growth += x[k] * rate;
    x[k] = system->constrained[k / 3] ? 0.0 : rate + shift * x[k];
  }
  const double by = sqrt(hk_dot(size, x, x));
  for (int64_t k = 0; k < size && by > 0.0; k++)
    x[k] /= by;
  return status;
}

static int32_t find_growth(const hooke_system *system, double t, const double *q, double shift, double *x,
                           double *rate) {
  const int64_t size = 3 * system->particle_count;
  uint64_t random = 1;
  double growth = 0.0;
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < size; k++)
    x[k] = system->constrained[k / 3] ? 0.0 : hk_random_uniform(&random);
  for (int k = 0; k < ITERATIONS && status == HOOKE_OK; k++)
    status = iterate(system, t, q, shift, x, x + size, &growth);
  *rate = growth > LEAST * shift ? growth : 0.0;
  return status;
}

/* A rate [1/s] at which some motion of the system linearised at q and time t grows by itself: a lower bound
 * of the largest one, by a vector that shows it; 0 if none was found, which proves nothing. */
static int32_t buckling_rate(const hooke_system *system, double t, const double *q, double *rate) {
  struct hk_node_blocks blocks;
  *rate = 0.0;
  int32_t status = hk_node_blocks_create(system, q, NULL, &blocks);
  if (status != HOOKE_OK) return status;
  const double shift = 1.0 / hk_node_blocks_reach(&blocks, (struct hk_node_limit){.k = 1.0}, INFINITY, NULL);
  hk_node_blocks_release(&blocks);
  double *vectors = hk_new(9 * system->particle_count, sizeof(double));
  if (vectors == NULL) return HOOKE_NO_MEMORY;
  status = find_growth(system, t, q, shift, vectors, rate);
  hk_free(vectors);
  return status;
}

/* In an overdamped scene what buckles grows by itself; in the limits of steps it counts as nothing. */
static int32_t note_buckling(struct hk_limit *limit, const double *q) {
  double rate = 0.0;
  int32_t status = HOOKE_OK;
  if (limit->system->overdamped && limit->clamped > 0)
    status = buckling_rate(limit->system, limit->time, q, &rate);
  for (int32_t k = 0; k < limit->row_count && rate > 0.0; k++) {
    if (!limit->row[k].note[0])
      hk_print(limit->row[k].note, sizeof limit->row[k].note,
               "buckling: springs under compression give way sideways, "
               "at any step; some motion grows by exp(%.3g t) or faster",
               rate);
  }
  return status;
}

/* ---- all of them ---- */

static int32_t find_rows(struct hk_limit *limit, struct hk_linearised *linearised) {
  struct hk_spectrum spectrum;
  double *mode = hk_new(linearised->size, sizeof(double));
  if (mode == NULL) return HOOKE_NO_MEMORY;
  /* from a closer one the measuring takes fewer runs, each of which costs more */
  const int measured = hooke_options_number(limit->options, "predict") == 0.0 &&
                       hooke_options_number(limit->options, "along") == 0.0;
  const double accuracy = hooke_options_number(limit->options, "accuracy") * (measured ? 0.1 : 1.0);
  int32_t status = hk_spectrum_create(linearised, accuracy, HOOKE_SPECTRUM_ALL,
                                      limit->has_stiffest ? limit->stiffest : NULL, &spectrum);
  if (status == HOOKE_OK) {
    status = keep_modes(limit, &spectrum);
    for (int32_t k = 0; k < limit->row_count && status == HOOKE_OK; k++)
      status = find_row(limit, &spectrum, mode, &limit->row[k]);
    hk_spectrum_release(&spectrum);
  }
  hk_free(mode);
  return status;
}

int32_t hk_limit_predict_rows(struct hk_limit *limit, const double *q, const double *v) {
  struct hk_linearised linearised;
  int32_t status = hk_linearised_create(limit->system, q, v, NULL, NULL, &linearised);
  if (status != HOOKE_OK) return status;
  linearised.budget = limit->budget;
  linearised.memory = limit->memory;
  status = find_bounds(limit, q, v);
  if (status == HOOKE_OK) status = find_rows(limit, &linearised);
  if (status == HOOKE_OK) status = note_buckling(limit, q);
  limit->products = linearised.products;
  limit->found = status == HOOKE_OK;
  hk_linearised_release(&linearised);
  return status;
}
