/* Soundness of a run: its step must stay clear of the stability limit, and its energy must not grow by
 * itself. */
#pragma once

#include "measure/spectrum/node_blocks.h"

#include "hooke/state.h"

/* States at which the limit itself is predicted: the first, and the one whose bound is least, each where the
 * step is not clear of the bound; with rigid bodies, of which no bound is known, the first and the last. */
enum { HOOKE_SOUNDNESS_STATES = 2 };
struct hk_soundness_state {
  double bound;  /* [s]; 0: none is known, infinity: the step is clear of it */
  double *q, *v; /* 3n each */
  double t;
};

struct hk_soundness {
  const hooke_system *system;
  const char *method;
  double step;                  /* NaN: nothing limits it [s] */
  struct hk_node_blocks blocks; /* without a system: no bound is to be known */
  struct hk_soundness_state at[HOOKE_SOUNDNESS_STATES];
  /* smallest stable step at a state where the step is not clear of it [s]; otherwise infinity */
  double least_limit;
  int32_t unknown_limit;         /* 1: at some state it is not known */
  double scale, gravity0, swing; /* energy scale, as in the definition of "diverged" [J] */
  int64_t count, capacity;
  double *time, *energy; /* of the recorded states */
};

/* Starts at `state`, with memory for `capacity` states; must be released in either case. HOOKE_NO_MEMORY. */
int32_t hk_soundness_begin(struct hk_soundness *soundness, const hooke_system *system, const char *method,
                           double step, const hooke_state *state, int64_t capacity);
/* Records another state, such as a frame; those beyond the capacity are ignored. */
void hk_soundness_see(struct hk_soundness *soundness, const hooke_state *state);
/* Finds the limits, within the budget; without it the bounds are the limits. HOOKE_NO_MEMORY. */
int32_t hk_soundness_find_limits(struct hk_soundness *soundness, struct hk_budget *budget);
void hk_soundness_release(struct hk_soundness *soundness);

/* Counted work of the bounds so far [s]. */
double hk_soundness_work(const struct hk_soundness *soundness);

/* Rise of energy over the last half of the recorded states, as a fraction of the scale: the slope of a
 * least-squares line times its duration if the slope is over three times its standard error; otherwise 0. NaN
 * if energy comes from outside (callbacks, drives) or there are fewer than eight states. */
double hk_soundness_rise(const struct hk_soundness *soundness);

/* Slope of the least-squares line through `count` points, and its standard error, as if the points scattered
 * about the line independently and alike: curvature is not accounted for. */
double hk_fit_slope(int64_t count, const double *x, const double *y, double *error);

/* 1 if the step is clear of every limit that was found, and no energy grows by itself. */
int32_t hk_soundness_holds(const struct hk_soundness *soundness);

/* Fraction of energy from which on a run counts as gaining energy by itself, and fraction of the stable step
 * that may be taken. */
extern const double hk_soundness_most_rise, hk_soundness_limit_share;
