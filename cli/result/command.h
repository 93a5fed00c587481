/* Commands to type: the current one with other settings, and suggestions for a run that ended early. */
#ifndef HOOKE_CLI_COMMAND_H
#define HOOKE_CLI_COMMAND_H

#include "arguments.h"

#include <stdio.h>

/* An option of a run, for a command to print. */
struct cli_setting {
  const char *name, *text; /* text NULL: to be left out */
};

/* Prints the current command as one of `verb`, with `settings`, which a NULL name ends, replacing its own,
 * and without the options that only show how a run diverges.
 * For another verb than the current one, only the given options of a run are kept. */
void cli_command_print(FILE *file, const struct cli_arguments *arguments, const char *verb,
                       const struct cli_setting *settings);

/* The same, as a run, in a text for free(). HOOKE_NO_MEMORY, with NULL. */
int32_t cli_command_make(const struct cli_arguments *arguments, const struct cli_setting *settings,
                         char **command);

/* Labels a diagnosis with the command of each advice, the column "command"; none where the scene has to
 * change. HOOKE_NO_MEMORY */
int32_t cli_advice_label(const struct cli_arguments *arguments, hooke_measurement *why);

/* Prints all suggestions, each with a line of words and its command. */
void cli_advice_print(const hooke_measurement *why);

#endif
