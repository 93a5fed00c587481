/* Soundness of a run: its step must stay clear of the stability limit, and its energy must not grow by
 * itself. */
#ifndef HOOKE_MEASURE_ESTIMATE_SOUNDNESS_H
#define HOOKE_MEASURE_ESTIMATE_SOUNDNESS_H

#include "measure/spectrum/node_blocks.h"

#include "hooke/state.h"

struct hk_soundness {
  const hooke_system *system;
  const char *method;
  double step;                  /* NaN for an error-controlled method [s] */
  struct hk_node_blocks blocks; /* released for a method without a limit */
  /* smallest stable step at a state where the step is not clear of it [s]; otherwise infinity */
  double least_limit;
  /* at the last state whose limit was computed; 1 before and after the patience is used up */
  double limit_over_bound;
  double patience;               /* remaining time for limits, where the step is not clear of the bound [s] */
  double scale, gravity0, swing; /* energy scale, as in the definition of "diverged" [J] */
  int32_t by_limit;              /* 1: with rigid bodies, of which no bound is known */
  int32_t unknown_limit;         /* 1: at some state their limit is not known, or patience had ended */
  int64_t count, capacity;
  double *time, *energy; /* of the recorded states */
};

/* Starts at `state`, with memory for `capacity` states and `patience` [s] for limits; must be released in
 * either case. HOOKE_NO_MEMORY. */
int32_t hk_soundness_begin(struct hk_soundness *soundness, const hooke_system *system, const char *method,
                           double step, double patience, const hooke_state *state, int64_t capacity);
/* Records another state, such as a frame; those beyond the capacity are ignored. */
void hk_soundness_see(struct hk_soundness *soundness, const hooke_state *state);
void hk_soundness_release(struct hk_soundness *soundness);

/* Rise of energy over the last half of the recorded states, as a fraction of the scale: the slope of a
 * least-squares line times its duration if the slope is over three times its standard error; otherwise 0. NaN
 * if energy comes from outside (callbacks, drives) or there are fewer than eight states. */
double hk_soundness_rise(const struct hk_soundness *soundness);

/* Fraction of energy from which on a run counts as gaining energy by itself, and fraction of the stable step
 * that may be taken. */
extern const double hk_soundness_most_rise, hk_soundness_limit_share;

#endif
