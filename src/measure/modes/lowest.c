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

/* ---- few, by CHOLMOD ---- */

/* Vectors beside twice those that are wanted, so that equal eigenvalues and the ends of clusters all come;
 * and the most rounds. */
enum { MORE = 8, ROUNDS = 500 };
/* Change of eigenvalues between rounds, against each and against the bound. */
static const double SETTLED = 1e-12, ROUNDING = 1e-14;

struct search {
  const struct hk_columns *matrix;
  struct hk_cholmod *factor; /* of K + shift I */
  struct hk_budget *budget;
  double bound;
  int64_t n, block;
  double *basis, *product, *value, *before;
  uint64_t seed;
};

/* With the smallest of some shifts that makes it positive. */
static int32_t factorise(struct search *s) {
  int32_t found = 0;
  s->factor = hk_cholmod->create(s->matrix, HOOKE_FACTOR_FOR_SOLUTIONS);
  if (s->factor == NULL)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a factor of %lld unknowns", (long long)s->n);
  for (double part = 1e-10; found == 0 && part < 1e3; part *= 4.0) {
    if (hk_budget_ends(s->budget, "factor")) return HOOKE_STOPPED;
    found = hk_cholmod->compute(s->factor, s->matrix, s->bound > 0.0 ? part * s->bound : 1.0);
  }
  if (found == HOOKE_NO_MEMORY) return found;
  return found == 1 ? HOOKE_OK : hk_fail(HOOKE_SOLVER_FAILED, NULL, "the stiffness has no factor");
}

/* Multiplications of a factor at most, some ten seconds. */
static const double MOST_PRODUCTS = 2e10;

int32_t hk_lowest_sign(const struct hk_columns *matrix, double bound, struct hk_budget *budget,
                       int32_t *sign) {
  struct hk_cholmod *factor = hk_cholmod ? hk_cholmod->create(matrix, HOOKE_FACTOR_FOR_SOLUTIONS) : NULL;
  double products = 0.0;
  *sign = 0;
  if (hk_cholmod == NULL) return HOOKE_OK;
  if (factor == NULL) return HOOKE_NO_MEMORY;
  for (int32_t k = 0; k < matrix->size; k++)
    products += 0.5 * hk_cholmod->counts(factor)[k] * hk_cholmod->counts(factor)[k];
  int32_t status = hk_budget_ends(budget, "factor") ? HOOKE_STOPPED : HOOKE_OK;
  if (status == HOOKE_OK && products <= MOST_PRODUCTS) {
    const int32_t found = hk_cholmod->compute(factor, matrix, HOOKE_MODES_ZERO * bound);
    *sign = found == 1 ? 1 : -1;
    if (found == HOOKE_NO_MEMORY) status = found;
  }
  hk_cholmod->destroy(factor);
  return status;
}

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

/* The block becomes its sums with these rows of factors, one number of all at a time. */
static void combine(struct search *s, const double *factor, double *sum) {
  const int64_t m = s->block;
  for (int64_t i = 0; i < s->n; i++) {
    for (int64_t k = 0; k < m; k++) {
      sum[k] = 0.0;
      for (int64_t c = 0; c < m; c++)
        sum[k] += factor[k * m + c] * s->basis[c * s->n + i];
    }
    for (int64_t k = 0; k < m; k++)
      s->basis[k * s->n + i] = sum[k];
  }
}

/* The inverse clears stiff motions away, and the matrix itself, which the shift hides, combines what is left,
 * in ascending order (subspace iteration, Bathe and Wilson 1972). */
static int32_t go_round(struct search *s) {
  const int64_t n = s->n, m = s->block;
  double *h = hk_new(2 * m * m + m, sizeof(double)), *vector = h + m * m;
  if (h == NULL) return HOOKE_NO_MEMORY;
  int32_t status = hk_cholmod->solve(s->factor, m, s->basis);
  for (int64_t k = 0; k < m && status == HOOKE_OK; k++) {
    orthonormalise(s, k);
    hk_columns_multiply(s->matrix, s->basis + k * n, s->product);
    for (int64_t j = 0; j <= k; j++)
      h[j * m + k] = h[k * m + j] = hk_dot(n, s->basis + j * n, s->product);
    if (hk_budget_ends(s->budget, "modes")) status = HOOKE_STOPPED;
  }
  if (status == HOOKE_OK) status = hk_dense_symmetric(m, h, s->value, vector);
  if (status == HOOKE_OK) {
    turn_around(m, 1, s->value);
    turn_around(m, m, vector);
    combine(s, vector, vector + m * m);
  }
  hk_free(h);
  return status;
}

/* The `wanted` lowest, beginning with the vectors that are there. */
static int32_t settle(struct search *s, int64_t wanted) {
  const int64_t have = s->block, m = 2 * wanted + MORE < s->n ? 2 * wanted + MORE : s->n;
  int32_t settled = 0, status = hk_grow((void **)&s->basis, have * s->n, m * s->n, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&s->value, have, m, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&s->before, have, m, sizeof(double));
  if (status != HOOKE_OK) return status;
  s->block = m;
  for (int64_t k = have * s->n; k < m * s->n; k++)
    s->basis[k] = hk_random_uniform(&s->seed);
  for (int64_t k = 0; k < m; k++)
    s->value[k] = INFINITY;
  for (int round = 0; round < ROUNDS && !settled && status == HOOKE_OK; round++) {
    memcpy(s->before, s->value, (size_t)m * sizeof(double));
    status = go_round(s);
    settled = status == HOOKE_OK;
    for (int64_t k = 0; k < wanted && settled; k++)
      settled = fabs(s->value[k] - s->before[k]) <= SETTLED * fabs(s->value[k]) + ROUNDING * s->bound;
  }
  if (status == HOOKE_OK && !settled)
    return hk_fail(HOOKE_SOLVER_FAILED, NULL, "the lowest %lld modes were not found", (long long)wanted);
  return status;
}

int32_t hk_lowest_sparse(const struct hk_columns *matrix, double bound, int64_t count,
                         struct hk_budget *budget, struct hk_lowest *lowest) {
  const int64_t n = matrix->size, most = n < HOOKE_MODES_SPARSE + count ? n : HOOKE_MODES_SPARSE + count;
  struct search s = {.matrix = matrix, .n = n, .bound = bound, .budget = budget, .seed = 1};
  int64_t wanted = 0, others = 0;
  if (!hk_cholmod) return hk_fail(HOOKE_NOT_BUILT, NULL, "modes of so many unknowns need CHOLMOD");
  int32_t status = factorise(&s);
  s.product = hk_new(n, sizeof(double));
  if (status == HOOKE_OK && s.product == NULL) status = HOOKE_NO_MEMORY;
  while (status == HOOKE_OK && others < count && wanted < most) {
    const int64_t next = wanted == 0 ? count : 2 * wanted + count;
    wanted = next < most ? next : most;
    status = settle(&s, wanted);
    others = 0;
    for (int64_t k = 0; k < wanted && status == HOOKE_OK; k++)
      others += fabs(s.value[k]) > HOOKE_MODES_ZERO * bound;
  }
  if (status == HOOKE_OK) status = take(n, wanted, s.value, s.basis, bound, count, lowest);
  hk_cholmod->destroy(s.factor);
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
