#include "measure/modes/lowest.h"

#include "core/memory.h"
#include "core/random.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "measure/modes/stiffness.h"
#include "measure/spectrum/eigen/dense.h"

#include <math.h>
#include <string.h>

void hk_lowest_release(struct hk_lowest *lowest) {
  hk_free(lowest->value);
  hk_free(lowest->vector);
  hk_free(lowest->zero);
  memset(lowest, 0, sizeof *lowest);
}

/* From the `found` lowest, ascending, and their vectors. */
static int32_t take(int64_t n, int64_t found, const double *value, const double *vector, double bound,
                    int64_t count, struct hk_lowest *lowest) {
  const size_t bytes = (size_t)n * sizeof(double);
  int64_t zeros = 0;
  for (int64_t k = 0; k < found; k++)
    zeros += fabs(value[k]) <= HOOKE_MODES_ZERO * bound;
  *lowest = (struct hk_lowest){.complete =
                                   found == n || (found > 0 && value[found - 1] > HOOKE_MODES_ZERO * bound)};
  count = count < found - zeros ? count : found - zeros;
  lowest->value = hk_new(count, sizeof(double));
  lowest->vector = hk_new(count * n, sizeof(double));
  lowest->zero = hk_new(zeros * n, sizeof(double));
  if (!lowest->value || !lowest->vector || !lowest->zero) {
    hk_lowest_release(lowest);
    return HOOKE_NO_MEMORY;
  }
  for (int64_t k = 0; k < found; k++) {
    if (fabs(value[k]) <= HOOKE_MODES_ZERO * bound) {
      memcpy(lowest->zero + n * lowest->zero_count++, vector + k * n, bytes);
    } else if (lowest->count < count) {
      lowest->value[lowest->count] = value[k];
      memcpy(lowest->vector + n * lowest->count++, vector + k * n, bytes);
    }
  }
  return HOOKE_OK;
}

/* ---- all, by LAPACK ---- */

static void turn_around(int64_t count, int64_t size, double *row) {
  for (int64_t k = 0; k < count / 2 * size; k++) {
    double *one = row + k, *other = row + (count - 1 - k / size) * size + k % size, kept = *one;
    *one = *other;
    *other = kept;
  }
}

int32_t hk_lowest_dense(const struct hk_columns *matrix, double bound, int64_t count,
                        struct hk_lowest *lowest) {
  const int64_t n = matrix->size;
  double *full = hk_new((2 * n + 1) * n, sizeof(double)), *vector = full + n * n, *value = vector + n * n;
  if (full == NULL) return HOOKE_NO_MEMORY;
  for (int64_t j = 0; j < n; j++) {
    for (int32_t k = matrix->start[j]; k < matrix->start[j + 1]; k++)
      full[matrix->row[k] * n + j] = full[j * n + matrix->row[k]] = matrix->number[k];
  }
  int32_t status = hk_dense_symmetric(n, full, value, vector);
  if (status == HOOKE_OK) {
    turn_around(n, 1, value);
    turn_around(n, n, vector);
    status = take(n, n, value, vector, bound, count, lowest);
  }
  hk_free(full);
  return status;
}

/* ---- shifted and inverted, by CHOLMOD ---- */

struct inverse {
  const struct hk_columns *matrix;
  int32_t *number, *order; /* place of each unknown in the factor, and back */
  struct hk_columns shifted;
  struct hk_cholmod *cholmod;
  double shift, *work;
};

static void release(struct inverse *x) {
  if (hk_cholmod) hk_cholmod->destroy(x->cholmod);
  hk_columns_release(&x->shifted);
  hk_free(x->number);
  hk_free(x->work);
}

static int32_t reorder(struct inverse *x) {
  const struct hk_columns *m = x->matrix;
  const int64_t entries = m->start[m->size];
  struct hk_entry *entry = hk_new(entries, sizeof *entry);
  if (entry == NULL) return HOOKE_NO_MEMORY;
  for (int32_t j = 0; j < m->size; j++) {
    x->number[x->order[j]] = j;
    for (int32_t k = m->start[j]; k < m->start[j + 1]; k++)
      entry[k] = (struct hk_entry){m->row[k], j, m->number[k]};
  }
  const int32_t status = hk_columns_make(m->size, entries, entry, x->number, &x->shifted);
  hk_free(entry);
  return status;
}

/* K + shift I with the smallest of some shifts that makes it positive; its diagonal ends each column. */
static int32_t factorise(struct inverse *x, double bound, struct hk_budget *budget) {
  struct hk_columns *m = &x->shifted;
  double before = 0.0;
  int32_t found = 0;
  for (double part = 1e-10; found == 0 && part < 1e3; part *= 100.0) {
    x->shift = bound > 0.0 ? part * bound : 1.0;
    for (int32_t j = 0; j < m->size; j++)
      m->number[m->start[j + 1] - 1] += x->shift - before;
    before = x->shift;
    if (hk_budget_ends(budget, "factor")) return HOOKE_STOPPED;
    found = hk_cholmod->compute(x->cholmod, m);
  }
  if (found == HOOKE_NO_MEMORY) return found;
  return found == 1 ? HOOKE_OK : hk_fail(HOOKE_SOLVER_FAILED, NULL, "the stiffness has no factor");
}

static int32_t invert(const struct hk_columns *matrix, double bound, struct hk_budget *budget,
                      struct inverse *x) {
  const int64_t n = matrix->size;
  *x = (struct inverse){.matrix = matrix};
  x->number = hk_new(2 * n, sizeof *x->number);
  x->work = hk_new(n, sizeof(double));
  if (x->number == NULL || x->work == NULL) return HOOKE_NO_MEMORY;
  x->order = x->number + n;
  int32_t status = hk_cholmod->order(matrix, x->order) ? reorder(x) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) x->cholmod = hk_cholmod->create(&x->shifted);
  if (status != HOOKE_OK || x->cholmod == NULL)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a factor of %lld unknowns", (long long)n);
  return factorise(x, bound, budget);
}

/* out = (K + shift I)^-1 y */
static void divide(const struct inverse *x, const double *y, double *out) {
  const struct hk_columns l = hk_cholmod->factor(x->cholmod);
  const int32_t *count = hk_cholmod->counts(x->cholmod);
  double *w = x->work;
  for (int32_t k = 0; k < l.size; k++)
    w[k] = y[x->order[k]];
  for (int32_t k = 0; k < l.size; k++) {
    w[k] /= l.number[l.start[k]];
    for (int32_t e = l.start[k] + 1; e < l.start[k] + count[k]; e++)
      w[l.row[e]] -= l.number[e] * w[k];
  }
  for (int32_t k = l.size - 1; k >= 0; k--) {
    double sum = w[k];
    for (int32_t e = l.start[k] + 1; e < l.start[k] + count[k]; e++)
      sum -= l.number[e] * w[l.row[e]];
    w[k] = sum / l.number[l.start[k]];
  }
  for (int32_t k = 0; k < l.size; k++)
    out[x->order[k]] = w[k];
}

/* ---- a block of vectors, by Rayleigh and Ritz on what the inverse makes of it ---- */

/* Beside those that are wanted, so that equal eigenvalues and the ends of clusters all come; how often the
 * inverse is applied before vectors are combined anew; and the most rounds. */
enum { MORE = 8, BLOCKS = 3, ROUNDS = 60 };
/* Change of eigenvalues between rounds, against each and against the bound. */
static const double SETTLED = 1e-12, ROUNDING = 1e-14;

struct search {
  struct inverse inverse;
  struct hk_budget *budget;
  double bound;
  int64_t n, block, size; /* vectors of the block, and of the basis that begins with them */
  double *basis, *product, *value, *before;
  uint64_t seed;
};

/* Makes vector k of the basis orthogonal to those before; one of nothing becomes a random one. */
static void orthonormalise(struct search *s, int64_t k) {
  double *q = s->basis + k * s->n;
  for (int again = 0, tries = 0; again < 2 && tries < 8; tries++) {
    const double before = sqrt(hk_dot(s->n, q, q));
    for (int64_t j = 0; j < k && before > 0.0; j++)
      hk_add_multiple(s->n, -hk_dot(s->n, s->basis + j * s->n, q), s->basis + j * s->n, q);
    const double length = sqrt(hk_dot(s->n, q, q));
    again = length > 0.5 * before && length > 0.0 ? again + 1 : length > 1e-10 * before ? 1 : 0;
    for (int64_t i = 0; i < s->n; i++)
      q[i] = again ? q[i] / length : hk_random_uniform(&s->seed);
  }
}

/* The block becomes the sums of the first m vectors with these rows of factors, one number of all at a time.
 */
static void combine(struct search *s, int64_t m, const double *factor, double *sum) {
  for (int64_t i = 0; i < s->n; i++) {
    for (int64_t k = 0; k < s->block; k++) {
      sum[k] = 0.0;
      for (int64_t c = 0; c < m; c++)
        sum[k] += factor[k * m + c] * s->basis[c * s->n + i];
    }
    for (int64_t k = 0; k < s->block; k++)
      s->basis[k * s->n + i] = sum[k];
  }
}

/* Fills the basis from its first `block` vectors on, and finds in it the largest eigenvalues of the inverse,
 * which take their place. */
static int32_t go_round(struct search *s) {
  const int64_t n = s->n, m = s->size;
  double *h = hk_new(2 * m * m + m + s->block, sizeof(double)), *vector = h + m * m, *theta = vector + m * m;
  if (h == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  for (int64_t c = 0; c < m && status == HOOKE_OK; c++) {
    divide(&s->inverse, s->basis + c * n, s->product);
    for (int64_t k = 0; k <= c; k++)
      h[k * m + c] = h[c * m + k] = hk_dot(n, s->basis + k * n, s->product);
    if (c + s->block < m) {
      memcpy(s->basis + (c + s->block) * n, s->product, (size_t)n * sizeof(double));
      orthonormalise(s, c + s->block);
    }
    if (hk_budget_ends(s->budget, "modes")) status = HOOKE_STOPPED;
  }
  if (status == HOOKE_OK) status = hk_dense_symmetric(m, h, theta, vector);
  if (status == HOOKE_OK) combine(s, m, vector, theta + m);
  hk_free(h);
  return status;
}

/* Once more by the inverse, which clears stiff motions away, and then by the matrix itself, which the shift
 * hides, in ascending order. */
static int32_t sharpen(struct search *s) {
  const int64_t n = s->n, m = s->block;
  double *h = hk_new(2 * m * m + m, sizeof(double)), *vector = h + m * m;
  if (h == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < m; k++) {
    divide(&s->inverse, s->basis + k * n, s->product);
    memcpy(s->basis + k * n, s->product, (size_t)n * sizeof(double));
    orthonormalise(s, k);
  }
  for (int64_t k = 0; k < m; k++) {
    hk_columns_multiply(s->inverse.matrix, s->basis + k * n, s->product);
    for (int64_t j = 0; j <= k; j++)
      h[j * m + k] = h[k * m + j] = hk_dot(n, s->basis + j * n, s->product);
  }
  const int32_t status = hk_dense_symmetric(m, h, s->value, vector);
  if (status == HOOKE_OK) {
    turn_around(m, 1, s->value);
    turn_around(m, m, vector);
    combine(s, m, vector, vector + m * m);
  }
  hk_free(h);
  return status;
}

/* The `wanted` lowest, beginning with the `have` vectors that are there. */
static int32_t settle(struct search *s, int64_t have, int64_t wanted) {
  int32_t status = HOOKE_OK, settled = 0;
  for (int64_t k = have; k < s->block; k++) {
    memset(s->basis + k * s->n, 0, (size_t)s->n * sizeof(double));
    orthonormalise(s, k);
  }
  for (int64_t k = 0; k < s->block; k++)
    s->value[k] = INFINITY;
  for (int round = 0; round < ROUNDS && !settled && status == HOOKE_OK; round++) {
    memcpy(s->before, s->value, (size_t)s->block * sizeof(double));
    status = go_round(s);
    if (status == HOOKE_OK) status = sharpen(s);
    settled = status == HOOKE_OK;
    for (int64_t k = 0; k < wanted && settled; k++)
      settled = fabs(s->value[k] - s->before[k]) <= SETTLED * fabs(s->value[k]) + ROUNDING * s->bound;
  }
  if (status == HOOKE_OK && !settled)
    return hk_fail(HOOKE_SOLVER_FAILED, NULL, "the lowest %lld modes were not found", (long long)wanted);
  return status;
}

static int32_t grow(struct search *s, int64_t wanted) {
  const int64_t block = wanted + MORE < s->n ? wanted + MORE : s->n, was = s->size;
  s->size = BLOCKS * block < s->n ? BLOCKS * block : s->n;
  int32_t status = hk_grow((void **)&s->basis, was * s->n, s->size * s->n, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&s->value, s->block, block, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&s->before, s->block, block, sizeof(double));
  s->block = block;
  return status;
}

int32_t hk_lowest_sparse(const struct hk_columns *matrix, double bound, int64_t count,
                         struct hk_budget *budget, struct hk_lowest *lowest) {
  const int64_t n = matrix->size, most = n < HOOKE_MODES_SPARSE + count ? n : HOOKE_MODES_SPARSE + count;
  struct search s = {.n = n, .bound = bound, .budget = budget, .seed = 1};
  int64_t wanted = 0, others = 0, have = 0;
  if (!hk_cholmod) return hk_fail(HOOKE_NOT_BUILT, NULL, "modes of so many unknowns need CHOLMOD");
  int32_t status = invert(matrix, bound, budget, &s.inverse);
  s.product = hk_new(n, sizeof(double));
  if (status == HOOKE_OK && s.product == NULL) status = HOOKE_NO_MEMORY;
  while (status == HOOKE_OK && others < count && wanted < most) {
    const int64_t next = wanted == 0 ? count : 2 * wanted + count;
    wanted = next < most ? next : most;
    status = grow(&s, wanted);
    if (status == HOOKE_OK) status = settle(&s, have, wanted);
    have = s.block;
    others = 0;
    for (int64_t k = 0; k < wanted && status == HOOKE_OK; k++)
      others += fabs(s.value[k]) > HOOKE_MODES_ZERO * bound;
  }
  if (status == HOOKE_OK) status = take(n, wanted, s.value, s.basis, bound, count, lowest);
  release(&s.inverse);
  hk_free(s.basis);
  hk_free(s.product);
  hk_free(s.value);
  hk_free(s.before);
  return status;
}

int32_t hk_lowest_find(const struct hk_columns *matrix, double bound, int64_t count, struct hk_budget *budget,
                       struct hk_lowest *lowest) {
  const int64_t most = hk_cholmod ? HOOKE_MODES_DENSE : HOOKE_MODES_DENSE_ALONE;
  if (matrix->size > most) return hk_lowest_sparse(matrix, bound, count, budget, lowest);
  if (hk_budget_ends(budget, "modes")) return HOOKE_STOPPED;
  return hk_lowest_dense(matrix, bound, count, lowest);
}
