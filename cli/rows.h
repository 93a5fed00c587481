/* The rows of a comparison or a study: a method with a step or tolerance, its errors and its cost. */
#ifndef HOOKE_CLI_ROWS_H
#define HOOKE_CLI_ROWS_H

#include "hooke.h"
#include "print.h"

#include <stdint.h>

struct cli_rows {
  const hooke_measurement *source; /* with a table "rows" */
  int64_t count;
  int32_t grouped; /* 1: an empty line before each method but the first */
  /* marks after "error" and "wall_seconds" of a row; NULL: no space for marks */
  char (*mark)(const hooke_measurement *source, int64_t row, const char *what);
};

/* Width of the column of methods. */
int32_t cli_rows_method_width(const struct cli_rows *rows);

/* A number in `width` columns to 4 digits, "-" if there is none. */
void cli_rows_print_cell(int32_t width, double value);

/* A table of all rows. */
void cli_rows_print(const struct cli_rows *rows, int32_t method_width);

#endif
