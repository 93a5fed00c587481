/* What to do about a run that ended early: commands to type. */
#ifndef HOOKE_CLI_ADVICE_H
#define HOOKE_CLI_ADVICE_H

#include "arguments.h"

#include <stdio.h>

/* The run again with what advice `place` changes; NULL where it is the scene that has to change. The caller
 * frees it. HOOKE_NO_MEMORY, and it is NULL. */
int32_t cli_advice_command(const struct cli_arguments *arguments, const hooke_measurement *why, int64_t place,
                           char **command);

/* Up to `most` pieces of advice, a line in words and a line to type for each. HOOKE_NO_MEMORY if one of those
 * is missing. */
int32_t cli_advice_print(FILE *file, const struct cli_arguments *arguments, const hooke_measurement *why,
                         int64_t most);

#endif
