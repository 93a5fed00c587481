/* Any q'' = W f(t, q, v) of generalized coordinates, as a system of particles of mass 1: each row of x y z
 * holds three coordinates, the last row is filled up with zeros, and its callback force is f, which the
 * system scales by W. So all that takes a system takes these. */
#ifndef HOOKE_INTEGRATE_GENERALIZED_H
#define HOOKE_INTEGRATE_GENERALIZED_H

#include "hooke/system.h"

struct hk_generalized {
  int64_t size;
  hooke_force *force;
  hooke_force_product *product; /* may be NULL */
  void *ctx;
  double *inverse_mass; /* those of all rows */
  hooke_system *system; /* committed */
};

/* Copies `mass_count` inverse masses, 1 or `size`. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_generalized_create(int64_t size, hooke_force *force, hooke_force_product *product, void *ctx,
                              int64_t mass_count, const double *inverse_mass, struct hk_generalized **out);
void hk_generalized_destroy(struct hk_generalized *coordinates); /* NULL is allowed */

#endif
