/* The energy balance along a run: the work from outside is the change of energy plus the heat of damping and
 * drag,
 *
 *   E(t) - E(a) = W - D,   W = integral of -(force of the springs on driven particles . their velocity), and
 *                              of the power of forces that follow time, as loads and wind do,
 *                          D = integral of hooke_system_dissipated_power(),
 *
 * with E of hooke_system_energy(), which excludes constrained particles. The integrals are sums over steps by
 * the trapezoidal rule; the residual E(t) - E(a) - W + D scales with the error of the method and of that
 * rule. */
#pragma once

#include "hooke/state.h"

struct hk_balance {
  const hooke_system *system;
  double (*dissipated_power)(const hooke_system *system, double t, const double *q, const double *v);
  double energy, work, heat; /* [J]: at the start; since then */
  double residual, scale;    /* [J] at the last state: the residual; the largest of the energies so far */
  double time, power_in, power_out;
  int64_t points;
  double *force, *rows; /* NULL: nothing is driven or calls back; rows of a call */
};

/* Starts at `state`; must be released in each case. HOOKE_NO_MEMORY, HOOKE_STOPPED. */
int32_t hk_balance_begin(struct hk_balance *balance, const hooke_system *system, const hooke_state *state);
/* Adds the state after another step. */
int32_t hk_balance_step(struct hk_balance *balance, const hooke_state *state);
/* Computes the residual there. */
void hk_balance_close(struct hk_balance *balance, const hooke_state *state);
void hk_balance_release(struct hk_balance *balance);

/* Bound on rounding [J]. */
double hk_balance_floor(const struct hk_balance *balance);

/* A residual that is the error of a method decreases as the step is halved; a fault does not. From `count`
 * residuals at some step and at half of it: the largest of the first, and its bound, four times their largest
 * difference plus the floor. At first order the difference is half of the residual. 1 if it is within the
 * bound. */
int32_t hk_balance_holds(int64_t count, const double *coarse, const double *fine, double floor,
                         double *largest, double *bound);
