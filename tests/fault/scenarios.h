/* What is done while faults strike. Scenarios that a build lacks a library for are not in its list. */
#ifndef FAULT_SCENARIOS_H
#define FAULT_SCENARIOS_H

#include "attempt.h"

#include "hooke.h"

struct scenario {
  const char *name;
  void (*run)(struct attempt *a, const void *with);
  const void *with;
  int32_t share;     /* of its points one in so many is tried; HOOKE_LONG: each, sanitized a share */
  const char *needs; /* of hooke_build_fact(), words between blanks; NULL: nothing */
  const char *file;  /* what it writes in its folder; NULL: nothing */
};

extern const struct scenario creating[], loading[], running[], measuring[], writing[];

int32_t scenario_is_built(const struct scenario *scenario);

/* Files that scenarios read, made once in `folder`. */
void prepare_scenes(const char *folder);

/* ---- pieces ---- */

/* A rope of `segments` that hangs from its start, committed. NULL if the attempt is over. */
hooke_system *make_rope(struct attempt *a, double segments);
hooke_options *make_run(struct attempt *a, const char *method, double step, double duration, double every);
void take_state(struct attempt *a, const hooke_state *state);

#endif
