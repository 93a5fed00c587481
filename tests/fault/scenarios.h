/* The scenarios for faults. Scenarios for which a build lacks a library are not in its list. */
#pragma once

#include "attempt.h"

#include "hooke.h"
#include "small.h"

#include <stddef.h>

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

/* A new folder with the input files of scenarios; 0 on success. */
int open_folder(char folder[128]);
int close_folder(const char *folder);

/* Those of all lists but `typing`, one after the other: k = 0, 1, ...; NULL past the last. */
const struct scenario *scenario_at(int32_t k);

/* Without faults, and with its output in the folder of its input. */
struct attempt scenario_attempt(const char *folder);

/* Input files of scenarios, created once in `folder`. */
void prepare_scenes(const char *folder);

/* One of them; it need not look at `with`. */
#define SCENARIO(name) static void name(struct attempt *a, __attribute__((unused)) const void *with)

/* ---- pieces ---- */

/* What a scenario has made so far, NULL for the rest. */
struct made {
  hooke_system *system;
  hooke_options *run, *options;
  hooke_integrator *integrator;
  hooke_state *state, *other;
  hooke_measurement *measurement, *second;
};
void release(struct made *made);

/* A committed rope of `segments` that hangs from its start. All of these give NULL if the attempt is over. */
hooke_system *make_rope(struct attempt *a, double segments);
/* A mass that swings on a spring along x, the other end pinned. */
hooke_system *make_oscillator(struct attempt *a);
/* Options of that name, set by words (small.h), which are a format. */
__attribute__((format(printf, 3, 4))) hooke_options *make_options(struct attempt *a, const char *name,
                                                                  const char *words, ...);
/* A measurement before its run. */
hooke_measurement *make_measurement(struct attempt *a, const char *kind, const hooke_system *system,
                                    const hooke_options *run, const char *words);
void take_state(struct attempt *a, const hooke_state *state);

/* Path of an input file or, for names in "out.", of an output file. Valid until the next call but one. */
const char *path_of(const struct attempt *a, const char *name);

/* Adds frames, sums and texts of a trajectory of so many frames of the system. */
void read_back(struct attempt *a, const char *path, const hooke_system *system, int64_t frames);
