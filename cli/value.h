/* Values as people type them, made into what an option table takes. */
#ifndef HOOKE_CLI_VALUE_H
#define HOOKE_CLI_VALUE_H

#include "arguments.h"

/* 1 if giving the option again adds to what was given before: rows of numbers, and lists of words and
 * numbers. */
int32_t cli_value_adds_up(const struct cli_argument *argument);

/* Puts `argument->text` into `argument->value`: units of length and time made SI, "64x64" for whole numbers
 * as "64,64", rows "1,0,0;0,0,1" as one list. A failure is reported and gives the exit code. */
int cli_value_read(const struct cli_arguments *arguments, struct cli_argument *argument);

/* Gives `argument->value` to its table. */
int cli_value_set(const struct cli_arguments *arguments, const struct cli_argument *argument);

enum { HOOKE_EXAMPLE_SIZE = 128 };

/* The example of a row as it is typed ("1,0,0;0,0,1", "16x16"), "" if it has none. Returns `text`. */
const char *cli_value_example(const hooke_options *table, int64_t row, char text[HOOKE_EXAMPLE_SIZE]);

#endif
