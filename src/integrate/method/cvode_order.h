/* The highest order of cvode-bdf, chosen while a run goes on. */
#ifndef HOOKE_INTEGRATE_METHOD_CVODE_ORDER_H
#define HOOKE_INTEGRATE_METHOD_CVODE_ORDER_H

#include "integrate/solve/sundials_problem.h"

struct hk_order_choice {
  int32_t low;           /* 1: order 2 is the highest for now */
  int64_t steps, looks;  /* since the order was last chosen: steps, windows of steps that were looked at */
  int64_t window_steps;  /* steps in the window that is filling, and the time at which it began */
  double window_begun;   /* [s] */
  int64_t short_windows; /* in a row */
  int64_t quiet_until;   /* no looking before so many steps */
  int64_t quiet_next;    /* and how many it will be the next time that orders 3 to 5 come back */
  double frequency, damping; /* angular frequency [rad/s] and damping ratio of the fastest modes */
  double *scratch;           /* two vectors of unknowns */
};

/* Makes own->choice if there is anything to choose: the options leave max_order open and rtol is not tight.
 * HOOKE_NO_MEMORY. */
int32_t hk_order_choice_create(hooke_integrator *integrator);
void hk_order_choice_release(struct hk_order_choice *choice);

/* Starts anew at time t with orders up to 5. */
void hk_order_choice_begin(struct hk_order_choice *choice, double t);
/* Counts a step that reached time t: 1 if it is time to look. */
int32_t hk_order_choice_is_due(struct hk_order_choice *choice, double t);
/* Looks, with the solution y at the integrator's time; where that changes `low` the solver is to start again
 * from there. HOOKE_STOPPED by a callback. */
int32_t hk_order_choice_look(hooke_integrator *integrator, const double *y);

#endif
