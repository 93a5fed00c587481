/* Tables "rows" in words: a line a method, with columns of numbers. */
#ifndef HOOKE_CLI_ROWS_H
#define HOOKE_CLI_ROWS_H

#include "hooke.h"
#include "print.h"

#include <stdint.h>

struct cli_column {
  const char *what, *head, *unit; /* the column of the table, and two lines above it */
  int width;
  const char *format;          /* of a number, such as "%.4g" */
  const char *infinite, *zero; /* words in place of them; NULL: as a number */
  int32_t marked;              /* a mark may follow */
};

struct cli_rows {
  const hooke_measurement *source;  /* with a table "rows" */
  const struct cli_column *columns; /* ends with a `what` of NULL */
  int32_t grouped;                  /* 1: an empty line before each method but the first */
  int32_t status;                   /* 1: the column of that name ends the line */
  /* marks after a column of a row; NULL: no space for marks */
  char (*mark)(const hooke_measurement *source, int64_t row, const char *what);
};

/* The only row of a table: a number, NaN if not known, and a text, NULL likewise. */
double cli_number(const hooke_measurement *measurement, const char *table, const char *column);
const char *cli_text(const hooke_measurement *measurement, const char *table, const char *column);

enum { HOOKE_METHOD_WIDTH = 10 }; /* the least, of a column of methods */

/* Width of a column of texts, at least `least`. */
int32_t cli_rows_width(const hooke_measurement *measurement, const char *table, const char *column,
                       size_t least);

/* A number in `width` columns to 4 digits, "-" if there is none; the second in another format, with other
 * words in place of infinity and 0 (NULL: as numbers). */
void cli_rows_print_cell(int32_t width, double value);
void cli_rows_print_as(int32_t width, double value, const char *format, const char *infinite,
                       const char *zero);

/* A table of all rows. */
void cli_rows_print(const struct cli_rows *rows, int32_t method_width);

#endif
