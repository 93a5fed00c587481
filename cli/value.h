/* Values as typed on the command line. */
#ifndef HOOKE_CLI_VALUE_H
#define HOOKE_CLI_VALUE_H

#include "arguments.h"

/* 1 if repeating the option adds to the previous value: rows of numbers, and lists of words and numbers. */
int32_t cli_value_adds_up(const struct cli_argument *argument);

/* Takes `argument->text` as `argument->value`, or adds it there. A failure is reported and returned as exit
 * code. */
int cli_value_read(const struct cli_arguments *arguments, struct cli_argument *argument);

/* Sets `argument->value` in its table. */
int cli_value_set(const struct cli_arguments *arguments, const struct cli_argument *argument);

#endif
