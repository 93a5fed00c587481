/* A growing direction, iterated towards the mode of the largest eigenvalue of M^-1 (a K + b C) at given
 * positions by products only (the power method): K and C as in linearised.h, computed from the springs
 * directly, in the memory of two vectors. Every iterate gives a lower bound of that eigenvalue, so that a
 * step is proven to be above its limit long before the limit is known. */
#pragma once

#include "measure/trial/budget.h"
#include "model/particles.h"

struct hk_growing {
  const hooke_system *system;
  double t;                 /* of the positions that are asked about */
  double *x, *out;          /* 3n, in rows of x y z; x.Mx = 1 after an iteration */
  struct hk_budget *budget; /* when it ends every quotient is 0 */
};

/* Bytes of memory. */
double hk_growing_bytes(const hooke_system *system);

/* Starts with the direction `v` (3n) or, if that is 0 at all free particles, with an arbitrary one.
 * HOOKE_NO_MEMORY. */
int32_t hk_growing_create(const hooke_system *system, const double *v, struct hk_budget *budget,
                          struct hk_growing *growing);
void hk_growing_release(struct hk_growing *growing);

/* x.(a K + b C)x / x.Mx at q, which is at most the largest eigenvalue. */
double hk_growing_quotient(struct hk_growing *growing, const double *q, double a, double b);

/* Iterates until that quotient exceeds `most`, rises by less than a relative `rise`, or after `turns`
 * iterations; returns it. */
double hk_growing_turn(struct hk_growing *growing, const double *q, double a, double b, double most,
                       double rise, int64_t turns);

/* 1 if the direction can prove a step of `method` too large: the rule of its limit is one of a symmetric
 * eigenvalue; returns its `a`, `b` and `most` for a step h. A quotient above `most` by a factor f proves a
 * step of h over the root of f to be too large, too. */
int32_t hk_growing_rule(const hooke_system *system, const char *method, double h, double *a, double *b,
                        double *most);
