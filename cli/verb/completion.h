/* Completion for shells. */
#ifndef HOOKE_CLI_COMPLETION_H
#define HOOKE_CLI_COMPLETION_H

#include "arguments.h"
#include "program.h"

/* Prints a script for the shell "bash", "zsh" or "fish": verbs, kinds, options and their words, and files.
 * Returns the exit code, HOOKE_EXIT_USAGE for another shell; other failures are reported already. */
int cli_completion_print(const struct cli_program *program, const char *shell);

/* ---- one file a shell ---- */

/* Calls `print` for every verb, or for every kind of a verb that takes one (else `kind` is NULL). */
int cli_completion_each(const struct cli_program *program,
                        void (*print)(const struct cli_arguments *arguments, const char *kind));

/* Prints a text that stands between single quotes, with \ before every character of `special`. */
void cli_completion_escape(const char *text, const char *special);

int cli_completion_bash(const struct cli_program *program);
int cli_completion_zsh(const struct cli_program *program);
int cli_completion_fish(const struct cli_program *program);

#endif
