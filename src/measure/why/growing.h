/* A direction in which motion grows, turned towards the mode of the largest eigenvalue of M^-1 (a K + b C) at
 * given positions by products alone (the power method): K and C as in linearised.h, from the springs as they
 * are, in the memory of two vectors. What it gives is a lower bound of that eigenvalue at every turn, so that
 * a step is proven to be above its limit long before the limit is known. */
#ifndef HOOKE_MEASURE_WHY_GROWING_H
#define HOOKE_MEASURE_WHY_GROWING_H

#include "measure/trial/patience.h"
#include "model/system.h"

struct hk_growing {
  const hooke_system *system;
  double *x, *out;              /* 3n, in rows of x y z; x.Mx = 1 after a turn */
  struct hk_patience *patience; /* whose end makes every quotient 0 */
};

/* Bytes that it takes. */
double hk_growing_bytes(const hooke_system *system);

/* Begins with the direction `v` (3n), or, where that is 0 wherever particles are free, with one of no
 * meaning. HOOKE_NO_MEMORY. */
int32_t hk_growing_create(const hooke_system *system, const double *v, struct hk_patience *patience,
                          struct hk_growing *growing);
void hk_growing_release(struct hk_growing *growing);

/* x.(a K + b C)x / x.Mx at q, which is not above the largest eigenvalue. */
double hk_growing_quotient(struct hk_growing *growing, const double *q, double a, double b);

/* Turns until that quotient is above `most`, until it rises by less than a relative `rise`, or until there
 * were `turns`; returns it. */
double hk_growing_turn(struct hk_growing *growing, const double *q, double a, double b, double most,
                       double rise, int64_t turns);

/* 1 if the direction can prove a step of `method` too large: the rule of its limit is one of a symmetric
 * eigenvalue; its `a`, `b` and `most` for a step h then. A quotient above `most` by a factor f proves a step
 * of h over the root of f to be too large, too. */
int32_t hk_growing_rule(const hooke_system *system, const char *method, double h, double *a, double *b,
                        double *most);

#endif
