/* The position of rest: f(t, q, 0) = 0 with the time held. Pseudo-transient continuation: steps of backward
 * Euler, each from rest, which become longer while they succeed. A step over h solves
 *   M (q' - q)/h^2 = f(t, q', 0)
 * and so is short and downhill at first, and a correction of Newton's method at last; M/h^2 keeps the matrix
 * regular where nothing resists. Where the forces have an energy no step may raise it. Driven particles and
 * obstacles stay where they are at that time, and friction is left out. */
#pragma once

#include "hooke/system.h"
#include "measure/trial/budget.h"

/* Why there is no rest. */
enum hk_rest_lack {
  HOOKE_RESTS,
  HOOKE_FALLS,     /* a force remains, however far the scene moves */
  HOOKE_NO_WAY_ON, /* no step leads closer */
  HOOKE_TOO_LONG,  /* so much counted work, or so many steps, and none */
  HOOKE_REST_SPENT /* the budget is used up */
};

struct hk_rest {
  enum hk_rest_lack lack;
  double residual;      /* the largest force on a free particle or a body [N] */
  double largest_force; /* the largest force along a spring, in absolute value [N] */
  double fall[3];       /* direction of the force that remains; its length is 1 */
  double moved;         /* how far the farthest particle has come [m] */
  int32_t has_energy;   /* 1: the steps descended */
  int64_t steps, failures, iterations, force_evaluations;
};

/* From q (3n, in rows) to where forces are in equilibrium; q is where the search ended in any case, and
 * `rest` tells where that is. Stops where the budget (NULL: none) says so. HOOKE_STOPPED, HOOKE_NO_MEMORY,
 * and the failures of an integrator. */
int32_t hk_rest_find(const hooke_system *system, double t, double *q, struct hk_budget *budget,
                     struct hk_rest *rest);
