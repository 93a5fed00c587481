/* Lanczos's recurrence, restarted from its best vector when its memory is full. */
#include "measure/spectrum/eigen/dominant_mode.h"

#include "core/memory.h"
#include "kernel/vector_loops.h"
#include "measure/spectrum/eigen/dense.h"

#include <math.h>
#include <string.h>

enum { FEWEST = 12, MOST = 400, MOST_PRODUCTS = 20000 };
static const double MEMORY = 5e8; /* [bytes] of the basis */
static const double RISE = 4.0;
/* Off-diagonals below this are rounding: the space is exhausted. */
static const double EXHAUSTED = 1e-14;

struct lanczos {
  struct hk_linearised *lin;
  int64_t most, count;
  double **vector; /* up to most + 1, not normalised */
  double *length;  /* of each vector, in the norm of masses */
  double *diagonal,
      *fraction; /* tridiagonal matrix with off-diagonals length[1..]; vector of its largest value */
};

static int32_t make_space(struct hk_linearised *lin, struct lanczos *z) {
  const double fit = (lin->memory > 0.0 ? fmin(lin->memory, MEMORY) : MEMORY) / (8.0 * (double)lin->size);
  *z = (struct lanczos){.lin = lin, .most = fit < FEWEST ? FEWEST : fit > MOST ? MOST : (int64_t)fit};
  z->vector = hk_new(z->most + 1, sizeof *z->vector);
  z->length = hk_new(3 * (z->most + 1), sizeof(double));
  if (z->vector == NULL || z->length == NULL) return HOOKE_NO_MEMORY;
  z->diagonal = z->length + z->most + 1;
  z->fraction = z->diagonal + z->most + 1;
  return HOOKE_OK;
}

static void release(struct lanczos *z) {
  for (int64_t k = 0; z->vector && k <= z->most; k++)
    hk_free(z->vector[k]);
  hk_free(z->vector);
  hk_free(z->length);
}

/* One product, one more row of the tridiagonal matrix. */
static int32_t turn(struct lanczos *z) {
  const struct hk_linearised *lin = z->lin;
  const int64_t n = lin->system->particle_count, k = z->count;
  double **next = &z->vector[k + 1];
  if (*next)
    memset(*next, 0, (size_t)lin->size * sizeof(double));
  else
    *next = hk_new(lin->size, sizeof(double));
  if (*next == NULL) return HOOKE_NO_MEMORY;
  const double length = z->length[k], ratio = k > 0 ? length / z->length[k - 1] : 0.0;
  const double *before = z->vector[k > 0 ? k - 1 : 0];
  hk_linearised_add_product(z->lin, z->vector[k], *next);
  z->diagonal[k] =
      hk_lanczos_begin(n, lin->mass, lin->inverse, 1.0 / length, ratio, before, z->vector[k], *next) / length;
  const double square = hk_lanczos_end(n, lin->mass, z->diagonal[k] / length, z->vector[k], *next);
  z->length[k + 1] = sqrt(square);
  z->count++;
  return HOOKE_OK;
}

/* The largest value of the first `count` rows. */
static int32_t largest(const struct lanczos *z, int64_t count, double *value, double *fraction) {
  return hk_dense_tridiagonal(count, z->diagonal, z->length + 1, value, fraction);
}

/* x = the vector of the largest value, normalised. */
static void combine(const struct lanczos *z, double *x) {
  memset(x, 0, (size_t)z->lin->size * sizeof(double));
  for (int64_t k = 0; k < z->count; k++)
    hk_add_multiple(z->lin->size, z->fraction[k] / z->length[k], z->vector[k], x);
  const double length = sqrt(hk_linearised_dot(z->lin, x, x));
  for (int64_t k = 0; k < z->lin->size && length > 0.0; k++)
    x[k] /= length;
}

/* Converged when the residual is below the accuracy; or when the second half of the iterations raised the
 * value by little. For densely spaced values the remainder decreases with the square of the iterations, so it
 * is a third of that rise, and was observed to be up to four fifths: half of it is added. */
static int32_t judge(struct lanczos *z, double accuracy, double *value, int *done) {
  double half = 0.0;
  int32_t status = largest(z, z->count, value, z->fraction);
  const double residual = z->length[z->count] * fabs(z->fraction[z->count - 1]);
  *done = z->length[z->count] <= EXHAUSTED * *value || residual <= accuracy * *value;
  if (status != HOOKE_OK || *done || z->count < FEWEST) return status;
  status = largest(z, z->count / 2, &half, NULL);
  *done = *value - half <= RISE * accuracy * *value;
  if (*done) *value += 0.5 * (*value - half);
  return status;
}

/* Starts from `mode`, as far as the memory reaches. */
static int32_t sweep(struct lanczos *z, double accuracy, double *value, double *mode, int *done) {
  z->count = 0;
  if (z->vector[0] == NULL) z->vector[0] = hk_new(z->lin->size, sizeof(double));
  if (z->vector[0] == NULL) return HOOKE_NO_MEMORY;
  memcpy(z->vector[0], mode, (size_t)z->lin->size * sizeof(double));
  z->length[0] = sqrt(hk_linearised_dot(z->lin, mode, mode));
  int32_t status = HOOKE_OK;
  for (int64_t check = 4; status == HOOKE_OK && !*done && z->count < z->most;) {
    if (hk_budget_ends(z->lin->budget, "eigenvalues")) return HOOKE_STOPPED;
    status = turn(z);
    const int exhausted = !(z->length[z->count] > EXHAUSTED * fabs(z->diagonal[0]));
    if (status != HOOKE_OK || (z->count < check && z->count < z->most && !exhausted)) continue;
    check = z->count + (z->count < 40 ? 4 : z->count / 10);
    status = judge(z, accuracy, value, done);
    *done |= exhausted;
  }
  if (status == HOOKE_OK) combine(z, mode);
  return status;
}

int32_t hk_dominant_mode_lanczos(struct hk_linearised *lin, double accuracy, double *value, double *mode) {
  struct lanczos z;
  int done = 0;
  const int64_t begun = lin->products;
  double before = 0.0;
  int32_t status = make_space(lin, &z);
  while (status == HOOKE_OK && !done) {
    status = sweep(&z, accuracy, value, mode, &done);
    done |= *value - before <= accuracy * *value || lin->products - begun > MOST_PRODUCTS;
    before = *value;
  }
  release(&z);
  return status;
}
