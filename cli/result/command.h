/* Commands to type: the current one with other settings, and suggestions for a run that ended early. */
#pragma once

#include "arguments.h"
#include "print.h"

/* Adds the current command as one of `verb`, with the options of a run that are set in `changes` (NULL: none)
 * replacing its own, and without the options that only show how a run diverges. For another verb than the
 * current one, only the given options of a run are kept. */
void cli_command_add(struct cli_string *text, const struct cli_arguments *arguments, const char *verb,
                     const hooke_options *changes);

/* The command of `needs` that asks with a want [m]; none if that is NaN. HOOKE_NO_MEMORY */
int32_t cli_command_ask_needs(const struct cli_arguments *arguments, double want, struct cli_string *command);

/* Labels a diagnosis with the command of each advice, the column "command"; none where the scene has to
 * change. HOOKE_NO_MEMORY */
int32_t cli_advice_label(const struct cli_arguments *arguments, hooke_measurement *why);

/* Prints all suggestions, each with a line of words and its command. */
void cli_advice_print(const hooke_measurement *why);
