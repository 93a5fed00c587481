/* The highest order of cvode-bdf, adapted during a run. */
#ifndef HOOKE_INTEGRATE_METHOD_CVODE_ORDER_H
#define HOOKE_INTEGRATE_METHOD_CVODE_ORDER_H

#include "integrate/solve/sundials_problem.h"

struct hk_order_choice {
  int32_t low;               /* 1: order 2 is currently the highest */
  int64_t steps, looks;      /* since the order was last chosen: steps, and windows of steps examined */
  int64_t window_steps;      /* steps in the current window, and its start time */
  double window_begun;       /* [s] */
  int64_t short_windows;     /* in a row */
  int64_t quiet_until;       /* no check before so many steps */
  int64_t quiet_next;        /* and their number the next time that orders 3 to 5 return */
  double frequency, damping; /* angular frequency [rad/s] and damping ratio of the fastest modes */
  double *scratch;           /* two vectors of unknowns */
};

/* Creates own->choice if there is a choice: the options leave max_order open and rtol is not tight.
 * HOOKE_NO_MEMORY. */
int32_t hk_order_choice_create(hooke_integrator *integrator);
void hk_order_choice_release(struct hk_order_choice *choice);

/* Restarts at time t with orders up to 5. */
void hk_order_choice_begin(struct hk_order_choice *choice, double t);
/* Counts a step that reached time t: 1 if a check is due. */
int32_t hk_order_choice_is_due(struct hk_order_choice *choice, double t);
/* Checks, with the solution y at the integrator's time; if that changes `low` the solver has to restart from
 * there. HOOKE_STOPPED by a callback. */
int32_t hk_order_choice_look(hooke_integrator *integrator, const double *y);

#endif
