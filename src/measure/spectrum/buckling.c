#include "measure/spectrum/buckling.h"

#include "core/memory.h"
#include "core/random.h"
#include "measure/spectrum/node_blocks.h"

#include <math.h>
#include <string.h>

/* By the power method on J + s, with J = K/gamma and s a bound of its eigenvalues: they are -s to s. A
 * growing motion that is slower than LEAST of s counts as none. */
enum { ITERATIONS = 300 };
static const double LEAST = 1e-9;

static double length(int64_t size, const double *x) {
  double sum = 0.0;
  for (int64_t k = 0; k < size; k++)
    sum += x[k] * x[k];
  return sqrt(sum);
}

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
  const double by = length(size, x);
  for (int64_t k = 0; k < size && by > 0.0; k++)
    x[k] /= by;
  return status;
}

static int32_t search(const hooke_system *system, double t, const double *q, double shift, double *x,
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

int32_t hk_buckling_rate(const hooke_system *system, double t, const double *q, double *rate) {
  struct hk_node_blocks blocks;
  *rate = 0.0;
  int32_t status = hk_node_blocks_create(system, q, &blocks);
  if (status != HOOKE_OK) return status;
  const double shift = 1.0 / hk_node_blocks_reach(&blocks, (struct hk_node_limit){.k = 1.0}, INFINITY, NULL);
  hk_node_blocks_release(&blocks);
  double *vectors = hk_new(9 * system->particle_count, sizeof(double));
  if (vectors == NULL) return HOOKE_NO_MEMORY;
  status = search(system, t, q, shift, vectors, rate);
  hk_free(vectors);
  return status;
}
