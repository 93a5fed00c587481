/* Values as typed on the command line, converted to the syntax of option tables. */
#ifndef HOOKE_CLI_VALUE_H
#define HOOKE_CLI_VALUE_H

#include "arguments.h"

/* 1 if repeating the option adds to the previous value: rows of numbers, and lists of words and numbers. */
int32_t cli_value_adds_up(const struct cli_argument *argument);

/* Converts `argument->text` to `argument->value`: units of length and time to SI, "64x64" for integers to
 * "64,64", rows "1,0,0;0,0,1" to one list. A failure is reported and returned as exit code. */
int cli_value_read(const struct cli_arguments *arguments, struct cli_argument *argument);

/* Sets `argument->value` in its table. */
int cli_value_set(const struct cli_arguments *arguments, const struct cli_argument *argument);

enum { HOOKE_EXAMPLE_SIZE = 128 };

/* The example of a row in command-line syntax ("1,0,0;0,0,1", "16x16"), "" if it has none. Returns `text`. */
const char *cli_value_example(const hooke_options *table, int64_t row, char text[HOOKE_EXAMPLE_SIZE]);

#endif
