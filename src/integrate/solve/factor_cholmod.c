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

static struct hk_cholmod *create(const struct hk_columns *matrix, int32_t for_solutions) {
  struct hk_cholmod *x = hk_new(1, sizeof *x);
  if (x == NULL) return NULL;
  cholmod_sparse sparse = view(matrix);
  if (for_solutions)
    start(&x->common, CHOLMOD_AMD, CHOLMOD_AUTO);
  else
    start(&x->common, CHOLMOD_NATURAL, CHOLMOD_SIMPLICIAL);
  x->factor = cholmod_analyze(&sparse, &x->common);
  if (x->factor) return x;
  destroy(x);
  return NULL;
}

static int64_t memory(const struct hk_cholmod *x) {
  return (int64_t)x->common.memory_usage;
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

static struct hk_columns factor(const struct hk_cholmod *x) {
  return (struct hk_columns){(int32_t)x->factor->n, x->factor->p, x->factor->i, x->factor->x};
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

static const struct hk_cholmod_calls calls = {find_order, create,  destroy, memory,
                                              counts,     compute, factor,  solve};
const struct hk_cholmod_calls *const hk_cholmod = &calls;

#else

const struct hk_cholmod_calls *const hk_cholmod = 0;

#endif
