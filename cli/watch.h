/* Handles Ctrl-C, and shows progress with the remaining time on a terminal. */
#pragma once

#include "setup.h"

#include <time.h>

#define HOOKE_BETWEEN_LOOKS 0.01 /* [s] of signals during a run */

struct cli_watch {
  int32_t show; /* standard error is a terminal, and output is not quiet */
  int32_t shown;
  struct timespec start, last;
};

/* From here on a request to end the program sets a flag, which stays; repeated ones do not kill. */
void cli_watch_start(struct cli_watch *watch, const struct cli_arguments *arguments);

/* Reports the fraction done, 0 to 1, of `what` (NULL: not said); returns 1 if the work is to stop. It is a
 * hooke_progress of the library, with the watch as its context. */
int32_t cli_watch_progress(double done, const char *what, void *watch);

/* Runs a measurement (state NULL: from the start) and shows its progress. */
int32_t cli_watch_run(const struct cli_arguments *arguments, hooke_measurement *measurement,
                      hooke_state *state);

/* Makes a measurement of this kind by the verb's own options, and runs it in this way. A failure is reported
 * and returned as exit code; else there are results, and `outcome` says how it ended. */
int cli_watch_measure(const struct cli_arguments *arguments, const char *kind, const struct cli_setup *setup,
                      hooke_state *state, hooke_measurement **made, int32_t *outcome);

/* Clears the line of progress. Signals stay caught, so that results can still be saved. */
void cli_watch_end(struct cli_watch *watch);

/* 1 if a signal came. */
int32_t cli_watch_interrupted(void);

/* `code` or, where that is HOOKE_EXIT_DONE and a signal came, its exit code, reported: nothing is written. */
int cli_watch_check(const struct cli_arguments *arguments, int code);
