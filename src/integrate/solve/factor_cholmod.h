/* Sparse Cholesky factors by CHOLMOD (Chen, Davis, Hager and Rajamanickam 2008). Its simplicial ones: they call no BLAS,
 * so their bits depend on the numbers alone. */
#ifndef HOOKE_INTEGRATE_SOLVE_FACTOR_CHOLMOD_H
#define HOOKE_INTEGRATE_SOLVE_FACTOR_CHOLMOD_H

#include <stdint.h>

/* Of a square matrix by columns, rows ascending: the upper triangle of a symmetric one, or a lower triangle. */
struct hooke_columns {
  int32_t size;
  int32_t *start; /* size + 1; of a factor only the first `size` */
  int32_t *row;
  double *number; /* or NULL */
};

struct hooke_cholmod;

int32_t hooke_cholmod_is_built(void);

/* order[k]: the column that is eliminated as number k, so that little fills in (approximate minimum degree, Amestoy, Davis
 * and Duff 1996). 0 without memory. */
int32_t hooke_cholmod_order(const struct hooke_columns *matrix, int32_t *order);

/* For factors in the order that the matrix is in. NULL without memory. */
struct hooke_cholmod *hooke_cholmod_create(const struct hooke_columns *matrix);
void hooke_cholmod_destroy(struct hooke_cholmod *cholmod);

/* Of each column of the factor: how many numbers it has. */
const int32_t *hooke_cholmod_counts(const struct hooke_cholmod *cholmod);

/* 1; 0 where the matrix proves not to be positive; HOOKE_NO_MEMORY. Numbers that are not finite may come out as such. */
int32_t hooke_cholmod_compute(struct hooke_cholmod *cholmod, const struct hooke_columns *matrix);

/* L as it was last computed, L L^T the matrix; CHOLMOD's memory, valid until then. */
struct hooke_columns hooke_cholmod_factor(const struct hooke_cholmod *cholmod);

#endif
