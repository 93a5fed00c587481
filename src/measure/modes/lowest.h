/* The lowest eigenvalues of a symmetric matrix, positive or not, and all that are 0. */
#pragma once

#include "integrate/solve/factor_cholmod.h"
#include "measure/trial/budget.h"

/* An eigenvalue is 0 within this part of the bound of all. Up to so many unknowns all are found, by LAPACK
 * (more where the build has no CHOLMOD); beyond, as many as there is room for. */
#define HOOKE_MODES_ZERO 1e-12
enum { HOOKE_MODES_DENSE = 400, HOOKE_MODES_DENSE_ALONE = 4000, HOOKE_MODES_SPARSE = 100 };

struct hk_lowest {
  int64_t count; /* of those that are not 0, ascending */
  double *value, *vector;
  int64_t zero_count; /* of those found; their vectors are rows, too, orthonormal */
  double *zero;
  int32_t complete; /* 1: no other is 0 or below */
};

/* Up to `count` of those that are not 0. HOOKE_NOT_BUILT, HOOKE_NO_MEMORY, HOOKE_SOLVER_FAILED,
 * HOOKE_STOPPED. */
int32_t hk_lowest_find(const struct hk_columns *matrix, double bound, int64_t count, struct hk_budget *budget,
                       struct hk_lowest *lowest);
/* The same by one of its two ways. */
int32_t hk_lowest_dense(const struct hk_columns *matrix, double bound, int64_t count,
                        struct hk_lowest *lowest);
int32_t hk_lowest_sparse(const struct hk_columns *matrix, double bound, int64_t count,
                         struct hk_budget *budget, struct hk_lowest *lowest);
/* `sign` becomes -1 if an eigenvalue is below 0, and 1 if none is, by one factor; 0 where that has too many
 * numbers, or the build has no CHOLMOD. HOOKE_NO_MEMORY, HOOKE_STOPPED. */
int32_t hk_lowest_sign(const struct hk_columns *matrix, double bound, struct hk_budget *budget,
                       int32_t *sign);
void hk_lowest_release(struct hk_lowest *lowest);
