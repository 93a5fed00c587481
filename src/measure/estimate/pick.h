/* Picks a method and its step or tolerance for a wanted error: a reference no tighter than needed, and for
 * each method the few runs that find its cheapest row within the wanted error. Without time for the whole
 * run, its beginning is studied, for the same fraction of the error: errors grow at least in proportion to
 * time. */
#ifndef HOOKE_MEASURE_ESTIMATE_PICK_H
#define HOOKE_MEASURE_ESTIMATE_PICK_H

#include "measure/trial/reference.h"

/* A row that was run: a method with a step or tolerance. */
struct hk_pick_row {
  const char *method; /* NULL: none */
  double value;       /* step [s] or rtol */
  double error,
      rms;        /* largest distance of a free particle, and root mean square, over the judged frames [m] */
  double seconds; /* for the studied duration */
};

struct hk_pick {
  const hooke_system *system;
  hooke_options *run;     /* options of the runs: duration and frames as studied */
  double want;            /* over the whole run [m] */
  double duration, share; /* of the run [s]; studied part of it */
  double unit;            /* largest step that fits frames and duration [s] */
  const char *method;     /* the only method allowed; NULL: any */
  struct hk_reference reference;
  struct hk_pick_row best; /* the cheapest that meets the want, or else the closest */
  int32_t met;             /* 1: `best` meets it, over the studied and judged time */
  double evaluation;       /* of a force evaluation, approximate [s] */
  double begun, deadline;  /* wall-clock time [s] */
  hooke_progress *progress;
  void *ctx;
};

/* Picks. `run` has the duration and all other options of methods. Must be released in either case.
 * HOOKE_BAD_VALUE, HOOKE_NOT_BUILT without SUNDIALS, HOOKE_STOPPED, HOOKE_NO_MEMORY. */
int32_t hk_pick_run(struct hk_pick *pick, const hooke_system *system, const hooke_options *run, double want,
                    const char *method, hooke_progress *progress, void *ctx);
void hk_pick_release(struct hk_pick *pick);

/* Time up to which the reference can be trusted, from the start of the run [s]. */
double hk_pick_trusted(const struct hk_pick *pick);

/* Searches all methods for the cheapest row within the wanted error, and stores it in `best` (pick_search.c).
 */
int32_t hk_pick_search(struct hk_pick *pick);
/* Options of a run by a method with a step or tolerance. */
int32_t hk_pick_options(const hooke_options *run, const char *method, double value, hooke_options **out);

#endif
