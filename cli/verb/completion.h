/* Completion for shells. */
#ifndef HOOKE_CLI_COMPLETION_H
#define HOOKE_CLI_COMPLETION_H

#include "program.h"

/* Prints a script for bash: verbs, kinds, options and their words, and files. Returns the exit code; failures
 * are reported already. */
int cli_completion_print_bash(const struct cli_program *program);

#endif
