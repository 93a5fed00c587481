/* The error of a run: the one that is wanted (--want), and the one it has. */
#ifndef HOOKE_CLI_WANT_H
#define HOOKE_CLI_WANT_H

#include "run_results.h"

/* Reads --want, refuses it beside a step or a tolerance of the command line, and picks a method and its step
 * or tolerance, with words on what was picked. Without --want nothing. */
int cli_want_pick(struct cli_run *run);

/* Has the error of the run that is over measured; without --want by --no-estimate not at all. */
int32_t cli_want_measure(struct cli_run *run);

/* 1 if the wanted error was not met and something finer is set in the options of the run. */
int32_t cli_want_goes_on(struct cli_run *run);

/* One line for a person on the error the run has; and warnings about energy. */
void cli_want_print(const struct cli_run *run);
/* The keys "error" and "want". */
void cli_want_print_json(const struct cli_run *run, struct cli_json *json);

/* The exit code of a run that came to its end. */
int cli_want_exit_code(const struct cli_run *run);

#endif
