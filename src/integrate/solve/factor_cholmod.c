#include "integrate/solve/factor_cholmod.h"

#if HOOKE_HAVE_CHOLMOD

#include "core/memory.h"
#include "core/status.h"

#include <cholmod.h>
#include <string.h>

struct hk_cholmod {
  cholmod_common common;
  cholmod_factor *factor;
};

/* Prints nothing, and tries only `ordering`. */
static void start(cholmod_common *common, int ordering, int supernodal) {
  cholmod_start(common);
  common->print = 0;
  common->useGPU = 0;
  common->supernodal = supernodal;
  common->final_ll = 1;
  common->nmethods = 1;
  common->method[0].ordering = ordering;
  common->postorder = ordering != CHOLMOD_NATURAL;
}

static cholmod_sparse view(const struct hk_columns *matrix) {
  const size_t size = (size_t)matrix->size;
  return (cholmod_sparse){.nrow = size,
                          .ncol = size,
                          .nzmax = (size_t)matrix->start[size],
                          .p = matrix->start,
                          .i = matrix->row,
                          .x = matrix->number,
                          .stype = 1,
                          .itype = CHOLMOD_INT,
                          .xtype = matrix->number ? CHOLMOD_REAL : CHOLMOD_PATTERN,
                          .dtype = CHOLMOD_DOUBLE,
                          .sorted = 1,
                          .packed = 1};
}

static int32_t find_order(const struct hk_columns *matrix, int32_t *order) {
  cholmod_common common;
  cholmod_sparse sparse = view(matrix);
  start(&common, CHOLMOD_AMD, CHOLMOD_SIMPLICIAL);
  cholmod_factor *found = cholmod_analyze(&sparse, &common);
  for (int32_t k = 0; found && k < matrix->size; k++)
    order[k] = ((const int *)found->Perm)[k];
  const int32_t fine = found != NULL;
  cholmod_free_factor(&found, &common);
  cholmod_finish(&common);
  return fine;
}

static void destroy(struct hk_cholmod *x) {
  if (x == NULL) return;
  cholmod_free_factor(&x->factor, &x->common);
  cholmod_finish(&x->common);
  hk_free(x);
}

static struct hk_cholmod *create(const struct hk_columns *matrix, int32_t kind) {
  struct hk_cholmod *x = hk_new(1, sizeof *x);
  if (x == NULL) return NULL;
  cholmod_sparse sparse = view(matrix);
  if (kind == HOOKE_FACTOR_FOR_SOLUTIONS)
    start(&x->common, CHOLMOD_AMD, CHOLMOD_AUTO);
  else
    start(&x->common, CHOLMOD_NATURAL,
          kind == HOOKE_FACTOR_SUPERNODAL ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL);
  x->factor = cholmod_analyze(&sparse, &x->common);
  if (x->factor) return x;
  destroy(x);
  return NULL;
}

static int64_t memory(const struct hk_cholmod *x) {
  return (int64_t)x->common.memory_usage;
}

static int64_t room(const struct hk_cholmod *x) {
  const cholmod_factor *l = x->factor;
  size_t bytes = (l->xsize + l->maxcsize) * sizeof(double); /* of supernodes; a simplicial one has none */
  for (size_t k = 0; k < l->n && !l->is_super; k++)
    bytes += (size_t)((const int32_t *)l->ColCount)[k] * (sizeof(double) + sizeof(int32_t));
  return (int64_t)bytes;
}

static const int32_t *counts(const struct hk_cholmod *x) {
  return x->factor->ColCount;
}

static int32_t no_memory(const struct hk_cholmod *x) {
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a factor of %d unknowns", (int)x->factor->n);
}

static int32_t compute(struct hk_cholmod *x, const struct hk_columns *matrix, double shift) {
  cholmod_sparse sparse = view(matrix);
  double both[2] = {shift, 0.0};
  const int fine = cholmod_factorize_p(&sparse, both, NULL, 0, x->factor, &x->common);
  if (x->common.status == CHOLMOD_OUT_OF_MEMORY) return no_memory(x);
  return fine && x->common.status == CHOLMOD_OK;
}

static struct hk_factor_column column(const struct hk_cholmod *x, int32_t k, int32_t *supernode) {
  const cholmod_factor *l = x->factor;
  const double *number = l->x;
  if (!l->is_super) {
    const int32_t start = ((const int32_t *)l->p)[k], count = ((const int32_t *)l->ColCount)[k];
    return (struct hk_factor_column){count, (const int32_t *)l->i + start, number + start};
  }
  const int32_t *first = l->super, *start = l->pi;
  while (first[*supernode + 1] <= k)
    ++*supernode;
  const int32_t s = *supernode, place = k - first[s], rows = start[s + 1] - start[s];
  number += ((const int32_t *)l->px)[s] + (int64_t)place * (rows + 1);
  return (struct hk_factor_column){rows - place, (const int32_t *)l->s + start[s] + place, number};
}

static int32_t solve(struct hk_cholmod *x, int64_t count, double *rows) {
  const size_t n = x->factor->n, numbers = n * (size_t)count;
  cholmod_dense right = {.nrow = n,
                         .ncol = (size_t)count,
                         .nzmax = numbers,
                         .d = n,
                         .x = rows,
                         .xtype = CHOLMOD_REAL,
                         .dtype = CHOLMOD_DOUBLE};
  cholmod_dense *found = cholmod_solve(CHOLMOD_A, x->factor, &right, &x->common);
  if (found == NULL) return no_memory(x);
  memcpy(rows, found->x, numbers * sizeof(double));
  cholmod_free_dense(&found, &x->common);
  return HOOKE_OK;
}

static const struct hk_cholmod_calls calls = {find_order, create,  destroy, memory, room,
                                              counts,     compute, column,  solve};
const struct hk_cholmod_calls *const hk_cholmod = &calls;

#else

const struct hk_cholmod_calls *const hk_cholmod = 0;

#endif
