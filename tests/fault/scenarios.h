/* The scenarios for faults. Scenarios for which a build lacks a library are not in its list. */
#ifndef FAULT_SCENARIOS_H
#define FAULT_SCENARIOS_H

#include "attempt.h"

#include "hooke.h"

struct scenario {
  const char *name;
  void (*run)(struct attempt *a, const void *with);
  const void *with;
  int32_t share;     /* of its points one in so many is tried; HOOKE_LONG: each; with a sanitizer a share */
  const char *needs; /* of hooke_build_fact(), words separated by blanks; NULL: nothing */
  const char *files; /* files that it writes, then files that it may leave, separated by blanks; NULL: none */
};

/* `typing` and `typing_to_files`: command lines of the program. */
extern const struct scenario creating[], loading[], running[], measuring[], writing[], resuming[], typing[],
    typing_to_files[];

int32_t scenario_is_built(const struct scenario *scenario);

/* Input files of scenarios, created once in `folder`. */
void prepare_scenes(const char *folder);

/* ---- pieces ---- */

/* A committed rope of `segments` that hangs from its start. NULL if the attempt is over. */
hooke_system *make_rope(struct attempt *a, double segments);
hooke_options *make_run(struct attempt *a, const char *method, double step, double duration, double every);

/* A measurement before its run; system and run may be NULL if the attempt is over. */
hooke_measurement *make_study(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *methods);
hooke_measurement *make_comparison(struct attempt *a, const hooke_system *system, const hooke_options *run,
                                   const char *methods);
hooke_measurement *make_needs(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              int32_t refine);
hooke_measurement *make_limit(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *flag);
void take_state(struct attempt *a, const hooke_state *state);

/* Path of an input file or, for names in "out.", of an output file. Valid until the next call but one. */
const char *path_of(const struct attempt *a, const char *name);

/* Adds frames, sums and texts of a trajectory of so many frames of the system. */
void read_back(struct attempt *a, const char *path, const hooke_system *system, int64_t frames);

#endif
