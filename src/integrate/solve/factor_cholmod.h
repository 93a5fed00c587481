/* Sparse Cholesky factors by CHOLMOD (Chen, Davis, Hager and Rajamanickam 2008). Simplicial ones call no
 * BLAS, so their bits depend on the numbers alone; supernodal ones do, and their bits depend on it. */
#pragma once

#include <stdint.h>

/* The upper triangle of a square matrix by columns, rows ascending. */
struct hk_columns {
  int32_t size;
  int32_t *start; /* size + 1 */
  int32_t *row;
  double *number; /* or NULL */
};

/* A column of a factor from its diagonal on, rows ascending. */
struct hk_factor_column {
  int32_t count;
  const int32_t *row;
  const double *number;
};

/* In the order of the matrix, the first two; or for solutions alone, by BLAS and in any order. */
enum { HOOKE_FACTOR_SIMPLICIAL, HOOKE_FACTOR_SUPERNODAL, HOOKE_FACTOR_FOR_SOLUTIONS };

struct hk_cholmod;

struct hk_cholmod_calls {
  /* order[k]: the column that is eliminated as number k, to reduce fill-in (approximate minimum degree,
   * Amestoy, Davis and Duff 1996). 0 without memory. */
  int32_t (*order)(const struct hk_columns *matrix, int32_t *order);
  /* For factors of one HOOKE_FACTOR_*. NULL without memory. */
  struct hk_cholmod *(*create)(const struct hk_columns *matrix, int32_t kind);
  void (*destroy)(struct hk_cholmod *cholmod);         /* NULL is allowed */
  int64_t (*memory)(const struct hk_cholmod *cholmod); /* maximum bytes so far */
  int64_t (*room)(const struct hk_cholmod *cholmod);   /* bytes of the numbers of a factor */
  /* Number of nonzeros in each column of the factor, of any kind. */
  const int32_t *(*counts)(const struct hk_cholmod *cholmod);
  /* Of the matrix with `shift` added to its diagonal. 1; 0 if that is not positive; HOOKE_NO_MEMORY.
   * Non-finite numbers may be reported as either. */
  int32_t (*compute)(struct hk_cholmod *cholmod, const struct hk_columns *matrix, double shift);
  /* Of L of the last computation, L L^T the matrix; CHOLMOD's memory, valid until the next one. Supernodal
   * ones have zeros between their nonzeros. Columns are asked for in order, `supernode` is 0 at first. */
  struct hk_factor_column (*column)(const struct hk_cholmod *cholmod, int32_t k, int32_t *supernode);
  /* Replaces so many right sides, in rows, by solutions. HOOKE_NO_MEMORY. */
  int32_t (*solve)(struct hk_cholmod *cholmod, int64_t count, double *rows);
};

extern const struct hk_cholmod_calls *const hk_cholmod; /* NULL: this build is without it */
