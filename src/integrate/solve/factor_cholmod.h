/* Sparse Cholesky factors by CHOLMOD (Chen, Davis, Hager and Rajamanickam 2008). Simplicial ones call no
 * BLAS, so their bits depend on the numbers alone. */
#pragma once

#include <stdint.h>

/* A square matrix by columns, rows ascending: the upper triangle of a symmetric one, or a lower triangle. */
struct hk_columns {
  int32_t size;
  int32_t *start; /* size + 1; of a factor only the first `size` */
  int32_t *row;
  double *number; /* or NULL */
};

struct hk_cholmod;

struct hk_cholmod_calls {
  /* order[k]: the column that is eliminated as number k, to reduce fill-in (approximate minimum degree,
   * Amestoy, Davis and Duff 1996). 0 without memory. */
  int32_t (*order)(const struct hk_columns *matrix, int32_t *order);
  /* For simplicial factors in the order of the matrix; or for solutions alone, by BLAS and in any order. NULL
   * without memory. */
  struct hk_cholmod *(*create)(const struct hk_columns *matrix, int32_t for_solutions);
  void (*destroy)(struct hk_cholmod *cholmod);         /* NULL is allowed */
  int64_t (*memory)(const struct hk_cholmod *cholmod); /* maximum bytes so far */
  /* Number of nonzeros in each column of the factor. */
  const int32_t *(*counts)(const struct hk_cholmod *cholmod);
  /* Of the matrix with `shift` added to its diagonal. 1; 0 if that is not positive; HOOKE_NO_MEMORY.
   * Non-finite numbers may be reported as either. */
  int32_t (*compute)(struct hk_cholmod *cholmod, const struct hk_columns *matrix, double shift);
  /* L of the last computation, L L^T the matrix; CHOLMOD's memory, valid until the next one. */
  struct hk_columns (*factor)(const struct hk_cholmod *cholmod);
  /* Replaces so many right sides, in rows, by solutions. HOOKE_NO_MEMORY. */
  int32_t (*solve)(struct hk_cholmod *cholmod, int64_t count, double *rows);
};

extern const struct hk_cholmod_calls *const hk_cholmod; /* NULL: this build is without it */
