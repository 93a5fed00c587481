/* Is a run to be trusted? Its step must stay clear of the stability limit, and its energy must not grow by
 * itself. */
#ifndef HOOKE_MEASURE_ESTIMATE_SOUNDNESS_H
#define HOOKE_MEASURE_ESTIMATE_SOUNDNESS_H

#include "measure/spectrum/node_blocks.h"

#include "hooke/state.h"

struct hk_soundness {
  const hooke_system *system;
  const char *method;
  double step;                  /* NaN for an error-controlled method [s] */
  struct hk_node_blocks blocks; /* without memory for a method that has no limit */
  /* smallest stable step at a state where the step is not clear of it [s]; else infinity */
  double least_limit;
  /* at the last state whose limit was asked for; 1 before and after patience ended */
  double limit_over_bound;
  double patience; /* left for limits, where the step is not clear of the bound [s]; after it bounds decide */
  double scale, gravity0, swing; /* energies of the scene, as in the definition of "diverged" [J] */
  int64_t count, capacity;
  double *time, *energy; /* of the states seen */
};

/* Begins at `state`, with memory for `capacity` states and `patience` [s] for limits; to be released in
 * either case. HOOKE_NO_MEMORY. */
int32_t hk_soundness_begin(struct hk_soundness *soundness, const hooke_system *system, const char *method,
                           double step, double patience, const hooke_state *state, int64_t capacity);
/* Takes another state, such as a frame; those beyond the capacity are left out. */
void hk_soundness_see(struct hk_soundness *soundness, const hooke_state *state);
void hk_soundness_release(struct hk_soundness *soundness);

/* How far the energy rises over the last half of the states seen, as a share of the scale: the slope of a
 * least-squares line times the time it covers, where the slope is over three times its standard error; else
 * 0. NaN where energy comes from outside (callbacks, drives) or there are fewer than eight states. */
double hk_soundness_rise(const struct hk_soundness *soundness);

/* The share from which on a run gains energy by itself, and the share of the stable step that may be
 * taken. */
extern const double hk_soundness_most_rise, hk_soundness_limit_share;

#endif
