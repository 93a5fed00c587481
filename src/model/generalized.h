/* Problems of coordinates, q'' = W f(t, q, v) and x' = phi(t, x), as systems: each row of x y z holds three
 * coordinates, the last row is filled up with zeros, and the callback force is f, which the system scales by
 * W, of particles of mass 1, or phi of an overdamped system with drag 1. So all that takes a system takes
 * these. */
#pragma once

#include "hooke/state.h"

struct hk_generalized {
  int64_t size;
  hooke_force *force;
  hooke_force_product *product; /* may be NULL */
  hooke_rate *rate;             /* of a first-order problem, which has no other callback */
  void *ctx;
  double *inverse_mass; /* those of all rows; NULL of a first-order problem */
};

/* hooke_system_create_second_order() of `size` coordinates; `start` NULL: zeros. */
int32_t hk_generalized_create(int64_t size, hooke_force *force, hooke_force_product *product, void *ctx,
                              int64_t mass_count, const double *inverse_mass, const hooke_state *start,
                              hooke_system **system);
void hk_generalized_destroy(struct hk_generalized *generalized);

/* 1 for a problem x' = phi(t, x). */
int32_t hk_is_first_order(const hooke_system *system);

/* Numbers in q that the caller knows of: 3n, or the coordinates of a problem. */
int64_t hk_system_numbers(const hooke_system *system);

/* " m" after a length in a sentence, or "" where coordinates have units of their own. */
const char *hk_metres(const hooke_system *system);

/* HOOKE_UNSUITED for a problem of coordinates; `what` begins the sentence: "a page ", or "". */
int32_t hk_system_require_scene(const hooke_system *system, const char *place, const char *what);
