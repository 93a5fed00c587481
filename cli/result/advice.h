/* Suggestions for a run that ended early: commands to type. */
#ifndef HOOKE_CLI_ADVICE_H
#define HOOKE_CLI_ADVICE_H

#include "arguments.h"

/* Command of the run with the changes of advice `place`; NULL if the scene has to change. The caller frees
 * it. HOOKE_NO_MEMORY, with NULL. */
int32_t cli_advice_command(const struct cli_arguments *arguments, const hooke_measurement *why, int64_t place,
                           char **command);

/* Prints all suggestions, each with a line of words and a command. HOOKE_NO_MEMORY if one of those is missing. */
int32_t cli_advice_print(const struct cli_arguments *arguments, const hooke_measurement *why);

#endif
