/* A run that blew up, told on standard error in four lines: what happened, what to try, where to see more,
 * and what is kept. */
#pragma once

#include "run_results.h"

/* The first line alone with --quiet. */
void cli_blow_up_tell(const struct cli_run *run);

/* Adds the command that explains the run: by its output, else by the scene with the options of the run; those
 * that --want chose are named. */
void cli_blow_up_add_why(struct cli_string *text, const struct cli_run *run);
