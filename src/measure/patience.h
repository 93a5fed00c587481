/* How long an inquiry may go on: until its time is up, or until the caller wants an end. */
#ifndef HOOKE_MEASURE_PATIENCE_H
#define HOOKE_MEASURE_PATIENCE_H

#include "hooke/measure.h"

struct hooke_patience {
  double begun, until; /* by hooke_clock_seconds() */
  hooke_progress *progress;
  void *ctx;
  int32_t spent, stopped; /* there was an end: the time was up, the caller wanted it */
};

/* `seconds` from now on; infinity for no end. */
struct hooke_patience hooke_patience_of(double seconds, hooke_progress *progress, void *ctx);

/* Tells the caller of `what`; 1 if there is to be an end, as it is at every call after the first that says so. Without patience
 * (NULL) there is none. */
int32_t hooke_patience_ends(struct hooke_patience *patience, const char *what);

#endif
