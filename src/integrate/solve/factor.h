/* A sparse Cholesky factor of the symmetric positive definite part S of the equations of an implicit step,
 *   M + beta c + sum over springs of (alpha kappa + beta gamma) u u^T + max(0, alpha T/r) (I - u u^T)
 *     + sum over the elements of other forces of alpha K + beta C,
 * over the free particles, computed by CHOLMOD. The part that depends only on the connectivity is computed
 * once. */
#pragma once

#include "kernel/spring/tangent_loops.h"
#include "model/force/force.h"

#include <stdint.h>

struct hk_factor;

/* HOOKE_NOT_BUILT if the build has none, and the options of a run ask for it. */
int32_t hk_factor_require(const hooke_options *options);

/* Finds order and sizes if there are at most `most` numbers: HOOKE_OK with *factor NULL if there are more,
 * and in a build without CHOLMOD. `supernodal` 1: by the BLAS, on which its bits then depend, where that is
 * an optimised one (model/blas.h). Its numbers and products are counted as those of a simplicial one.
 * HOOKE_NO_MEMORY. */
int32_t hk_factor_create(const hooke_system *system, int64_t most, int32_t supernodal,
                         struct hk_factor **factor);
void hk_factor_destroy(struct hk_factor *factor);

/* Memory of a factor that may be supernodal in total [bytes], or of finding that it has more numbers than
 * `most`. HOOKE_NO_MEMORY.
 */
int32_t hk_factor_foretell(const hooke_system *system, int64_t most, int64_t *bytes);
int64_t hk_factor_memory(const struct hk_factor *factor); /* bytes, so far */
int64_t hk_factor_numbers(const struct hk_factor *factor);
double hk_factor_products(const struct hk_factor *factor); /* multiplications to compute it */

/* Allocates memory for the numbers, once, before they are computed: many factors are analysed and never
 * computed. HOOKE_NO_MEMORY. */
int32_t hk_factor_reserve(struct hk_factor *factor);

/* From the diagonal blocks of S, xx, yy, zz, xy, xz, yz with n numbers each, and the off-diagonal parts. 1; 0
 * if rounding or non-finite numbers make it not positive; HOOKE_NO_MEMORY. */
struct hk_factor_parts {
  const struct hk_tangent *tangent;
  const struct hk_element *element; /* of forces with variable K and C; those of others are looked up */
  double alpha, beta;
};
int32_t hk_factor_compute(struct hk_factor *factor, const double *diagonal,
                          const struct hk_factor_parts *parts);

/* With S = L L^T: ordered = L^-1 all, and all = L^-T ordered, between vectors of all particles, x, y and z
 * apart, where constrained ones become 0, and the order of the factor, 3 numbers a free particle. */
void hk_factor_forward(const struct hk_factor *factor, const double *all, double *ordered);
void hk_factor_backward(const struct hk_factor *factor, const double *ordered, double *all);
