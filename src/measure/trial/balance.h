/* The balance of energy along a run: what driven particles put in is what the energy changes by and what
 * damping and drag turn into heat,
 *
 *   E(t) - E(a) = W - D,   W = integral of -(force of the springs on driven particles . their velocity),
 *                          D = integral of hooke_system_dissipated_power(),
 *
 * E as hooke_system_energy() has it, which leaves constrained particles out. The integrals are sums over
 * steps by the trapezoidal rule; what is left over, E(t) - E(a) - W + D, goes with the error of the method and of that
 * rule. */
#ifndef HOOKE_MEASURE_TRIAL_BALANCE_H
#define HOOKE_MEASURE_TRIAL_BALANCE_H

#include "hooke/state.h"

struct hk_balance {
  const hooke_system *system;
  double (*dissipated_power)(const hooke_system *system, const double *q, const double *v);
  double energy, work, heat; /* [J]: at the start; since then */
  double residual, scale; /* [J] at the last state: what is left over; the largest of the energies so far */
  double time, power_in, power_out;
  int64_t points;
  double *force; /* NULL: nothing is driven */
};

/* Starts at `state`; to be released in each case. HOOKE_NO_MEMORY, HOOKE_STOPPED. */
int32_t hk_balance_begin(struct hk_balance *balance, const hooke_system *system, const hooke_state *state);
/* Takes the state after another step. */
int32_t hk_balance_step(struct hk_balance *balance, const hooke_state *state);
/* Finds what is left over there. */
void hk_balance_close(struct hk_balance *balance, const hooke_state *state);
void hk_balance_release(struct hk_balance *balance);

/* What rounding leaves at most [J]. */
double hk_balance_floor(const struct hk_balance *balance);

/* A residual that is the error of a method gets smaller as the step is halved; what is wrong does not. Of
 * `count` residuals at some step and at half of it: the largest of the first, and the bound that it has to
 * keep, four times their largest difference and the floor. Of first order the difference is half of the
 * residual. 1 if it is kept. */
int32_t hk_balance_holds(int64_t count, const double *coarse, const double *fine, double floor,
                         double *largest, double *bound);

#endif
