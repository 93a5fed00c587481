/* The error of a run: the wanted one (--want), and the estimated one. */
#ifndef HOOKE_CLI_WANT_H
#define HOOKE_CLI_WANT_H

#include "run_results.h"

/* Reads --want, refuses it beside a step or a tolerance on the command line, and picks a method and its step
 * or tolerance, which it reports. Does nothing without --want. */
int cli_want_pick(struct cli_run *run);

/* Estimates the error of the finished run; not without --want under --no-estimate. */
int32_t cli_want_measure(struct cli_run *run);

/* 1 if the wanted error was not met and something finer is set in the options of the run. */
int32_t cli_want_goes_on(struct cli_run *run);

/* What the estimate says of the run. */
void cli_want_print(const struct cli_run *run);
/* The keys "error" and "want", as JSON, each with a comma after it. */
void cli_want_print_json(const struct cli_run *run);

/* Exit code of a finished run. */
int cli_want_exit_code(const struct cli_run *run);

#endif
