/* What a measurement found, in words and as JSON: its claims, as the library composes them, numbers, and
 * tables. */
#pragma once

#include "arguments.h"
#include "print.h"

/* Prints the claims beside their keys, from column `indent` on, with --quiet the first alone; and after the
 * first the command that it leads to (NULL: none). */
void cli_claims_print(const struct cli_arguments *arguments, const hooke_measurement *measurement,
                      int32_t indent, const char *command);

/* The text of the claim with this key; NULL if there is none. */
const char *cli_claim(const hooke_measurement *measurement, const char *key);

/* Prints the whole document of the measurement, after the name of the file under `key` (NULL: without).
 * HOOKE_NO_MEMORY if something is left out. */
int32_t cli_claims_print_json(const struct cli_arguments *arguments, const char *key,
                              hooke_measurement *measurement);

/* In words the first rows of the table "blame", of the limiting springs, a line each. */
void cli_limiting_print(const hooke_measurement *measurement);

/* ---- tables "rows": a line a method, with columns of numbers ---- */

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

/* "57.y [m]", from a row of a table with a `quantity` and a `unit`. */
enum { HOOKE_HEAD_SIZE = 128 };
const char *cli_quantity(const hooke_measurement *measurement, const char *table, int64_t row,
                         char head[HOOKE_HEAD_SIZE]);

/* The columns, which end with a `what` of NULL, in which some row has a number; `known` has room for all. */
void cli_rows_known(const hooke_measurement *measurement, const struct cli_column *columns,
                    struct cli_column *known);

/* A table of all rows. */
void cli_rows_print(const struct cli_rows *rows, int32_t method_width);
