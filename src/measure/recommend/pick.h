/* Picks a method and its step or tolerance for a wanted error: a reference no tighter than needed, and for
 * each method the few runs that find its cheapest row within the wanted error. This is the one place that
 * recommends a run, by these rules:
 *
 * - No step is above 0.9 of the limit: of the bound at every frame, and of the prediction where it is above
 *   0.9 of the bound (soundness.h). No run's energy grows by itself.
 * - The run has met the wanted error twice: from the start, and from one displaced at random by as much as
 *   rounding does, so that it does not rest on a motion that only the exact start has.
 * - Costs are counted work; of methods whose costs are within 1.2 the first one in the table of methods.
 *
 * All of that takes at most ten times the work of the picked run, or the counted equal of 2 s. Where it does
 * not suffice for a reference of the whole run, the beginning is studied, for the same fraction of the error:
 * errors grow at least in proportion to time. */
#pragma once

#include "measure/trial/reference.h"

/* A row that was run: a method with a step or tolerance. */
struct hk_pick_row {
  const char *method;  /* NULL: none */
  double value;        /* step [s] or rtol */
  double error, rms;   /* what the want is held against, and the root mean square of distances [m], over the
                        * judged frames */
  double work;         /* counted, for the studied duration [s] */
  double wall_seconds; /* as measured, once */
};

struct hk_pick {
  const hooke_system *system;
  hooke_options *run;           /* options of the runs: duration and frames as studied */
  const struct hk_wants *wants; /* what errors are of */
  double want;                  /* over the whole run, as in `wants` */
  double duration, fraction;    /* of the run [s]; studied part of it */
  double unit;                  /* largest step that fits frames and duration [s] */
  int32_t method_count;         /* methods allowed; 0: any */
  const char *const *methods;
  struct hk_reference reference;
  struct hk_pick_row best;   /* the cheapest that meets the want, or else the closest */
  struct hk_pick_row second; /* the cheapest by another method that meets it */
  int32_t met;               /* 1: `best` meets it, over the studied and judged time */
  double quickest;           /* counted work of the quickest run known before any is judged [s] */
  double work;               /* counted, of all runs and limits so far [s] */
  hooke_progress *progress;
  void *ctx;
};

/* Picks for `want` of what is wanted, which has to outlive the pick, among `count` methods, which have to
 * outlive the pick (0: any that is built). `run` has the duration and all other options of methods. Must be
 * released in either case. HOOKE_BAD_VALUE, also where no run tells whether a list is met; HOOKE_NO_MEMORY;
 * HOOKE_STOPPED, with the best row so far. */
int32_t hk_pick_run(struct hk_pick *pick, const hooke_system *system, const hooke_options *run,
                    const struct hk_wants *wants, double want, int32_t count, const char *const *methods,
                    hooke_progress *progress, void *ctx);
void hk_pick_release(struct hk_pick *pick);

/* Time up to which the reference can be trusted, from the start of the run [s]. */
double hk_pick_trusted(const struct hk_pick *pick);

/* Options of a run by a method with a step or tolerance, which the caller destroys in either case. */
int32_t hk_pick_options(const hooke_options *run, const char *method, double value, hooke_options **out);

/* In words, if the times of this machine would reverse the two best by more than 2; "" if not. */
void hk_pick_say_reversal(const struct hk_pick *pick, char *text, int32_t size);
