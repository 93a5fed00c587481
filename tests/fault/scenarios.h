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
  const char
      *files; /* what it writes in its folder, then what it may leave beside, between blanks; NULL: nothing */
};

/* `typing` and `typing_to_files`: what the program does with words that are typed. */
extern const struct scenario creating[], loading[], running[], measuring[], writing[], resuming[], typing[],
    typing_to_files[];

int32_t scenario_is_built(const struct scenario *scenario);

/* Files that scenarios read, made once in `folder`. */
void prepare_scenes(const char *folder);

/* ---- pieces ---- */

/* A rope of `segments` that hangs from its start, committed. NULL if the attempt is over. */
hooke_system *make_rope(struct attempt *a, double segments);
hooke_options *make_run(struct attempt *a, const char *method, double step, double duration, double every);

/* Not yet run, over a system and a run that may be NULL, for an attempt that is over. */
hooke_measurement *make_study(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *methods);
hooke_measurement *make_comparison(struct attempt *a, const hooke_system *system, const hooke_options *run,
                                   const char *methods);
hooke_measurement *make_needs(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              int32_t refine);
hooke_measurement *make_limit(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *flag);
void take_state(struct attempt *a, const hooke_state *state);

/* Of what is read, or, named "out.", written. Stays until the next but one. */
const char *path_of(const struct attempt *a, const char *name);

/* Frames, sums and texts of a trajectory of so many frames of the system. */
void read_back(struct attempt *a, const char *path, const hooke_system *system, int64_t frames);

#endif
