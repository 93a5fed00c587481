#include "measured.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 110, MOST_LIMITING = 5, LABEL = 12, CELL_SIZE = 24 };

void cli_claims_print(const struct cli_arguments *arguments, const hooke_measurement *measurement,
                      int32_t indent, const char *command) {
  int64_t count = hooke_measurement_row_count(measurement, "claims");
  if (arguments->quiet && count > 1) count = 1;
  for (int64_t row = 0; row < count; row++) {
    cli_print_fact(indent, WIDTH, hooke_measurement_text(measurement, "claims", row, "key"), "%s",
                   hooke_measurement_text(measurement, "claims", row, "text"));
    if (row == 0 && command) cli_say("%*s%s\n", indent, "", command);
  }
}

const char *cli_claim(const hooke_measurement *measurement, const char *key) {
  const int64_t row = hooke_measurement_find(measurement, "claims", "key", key);
  return hooke_measurement_text(measurement, "claims", row, "text");
}

int32_t cli_claims_print_json(const struct cli_arguments *arguments, const char *key,
                              hooke_measurement *measurement) {
  cli_print_json("{");
  if (key) cli_print_json("%s: %s", key, arguments->scene);
  const int32_t status = cli_print_members(key ? ", " : "", measurement, NULL, 0);
  cli_print_json("}\n");
  return status;
}

/* ---- limiting springs ---- */

static double number(const hooke_measurement *m, int64_t row, const char *what) {
  return hooke_measurement_number(m, "blame", row, what);
}

static void print_limiting(const hooke_measurement *m, int64_t row) {
  const char *force = hooke_measurement_text(m, "blame", row, "force");
  const char *group = hooke_measurement_text(m, "blame", row, "group");
  const double share = number(m, row, "share");
  printf("%-*s", LABEL, row ? "" : "blame");
  printf(isnan(share) ? "      -" : "%5.1f %%", 100.0 * share);
  if (force)
    printf("  %s", force);
  else
    printf("  spring %.0f, between particles %.0f and %.0f", number(m, row, "number"),
           number(m, row, "first"), number(m, row, "second"));
  cli_say("%s%s\n", group[0] ? ", group " : "", group);
}

void cli_limiting_print(const hooke_measurement *m) {
  const int64_t count = hooke_measurement_row_count(m, "blame");
  for (int64_t row = 0; row < count && row < MOST_LIMITING; row++)
    print_limiting(m, row);
  if (count > MOST_LIMITING) printf("%-*sand others with less\n", LABEL, "");
}

/* ---- tables ---- */

static const char *method_of(const struct cli_rows *rows, int64_t row) {
  return hooke_measurement_text(rows->source, "rows", row, "method");
}

double cli_number(const hooke_measurement *measurement, const char *table, const char *column) {
  return hooke_measurement_number(measurement, table, 0, column);
}

const char *cli_text(const hooke_measurement *measurement, const char *table, const char *column) {
  return hooke_measurement_text(measurement, table, 0, column);
}

int32_t cli_rows_width(const hooke_measurement *measurement, const char *table, const char *column,
                       size_t least) {
  for (int64_t row = 0; row < hooke_measurement_row_count(measurement, table); row++) {
    const size_t length = strlen(hooke_measurement_text(measurement, table, row, column));
    if (length > least) least = length;
  }
  return (int32_t)least;
}

const char *cli_quantity(const hooke_measurement *measurement, const char *table, int64_t row,
                         char head[HOOKE_HEAD_SIZE]) {
  const char *unit = hooke_measurement_text(measurement, table, row, "unit");
  snprintf(head, HOOKE_HEAD_SIZE, "%.100s%s%s%s", hooke_measurement_text(measurement, table, row, "quantity"),
           unit[0] ? " [" : "", unit, unit[0] ? "]" : "");
  return head;
}

void cli_rows_print_as(int32_t width, double value, const char *format, const char *infinite,
                       const char *zero) {
  const char *word = isnan(value) ? "-" : isinf(value) ? infinite : value == 0.0 ? zero : NULL;
  char cell[CELL_SIZE];
  snprintf(cell, sizeof cell, format, value);
  printf(" %*s", width, word ? word : cell);
}

void cli_rows_print_cell(int32_t width, double value) {
  cli_rows_print_as(width, value, "%.4g", NULL, NULL);
}

static int32_t is_known(const hooke_measurement *measurement, const char *column) {
  for (int64_t row = 0; row < hooke_measurement_row_count(measurement, "rows"); row++)
    if (!isnan(hooke_measurement_number(measurement, "rows", row, column))) return 1;
  return 0;
}

void cli_rows_known(const hooke_measurement *measurement, const struct cli_column *columns,
                    struct cli_column *known) {
  for (; columns->what; columns++)
    if (is_known(measurement, columns->what)) *known++ = *columns;
  known->what = NULL;
}

static void print_head(const struct cli_rows *rows, int32_t method_width, int32_t second) {
  printf("%-*s", method_width, second ? "" : "method");
  for (const struct cli_column *column = rows->columns; column->what; column++) {
    printf(" %*s", column->width, second ? column->unit : column->head);
    if (rows->mark && column->marked && column[1].what) printf(" ");
  }
  printf("\n");
}

static void print_row(const struct cli_rows *rows, int64_t row, int32_t method_width) {
  cli_print_padded(stdout, method_width, method_of(rows, row));
  for (const struct cli_column *column = rows->columns; column->what; column++) {
    cli_rows_print_as(column->width, hooke_measurement_number(rows->source, "rows", row, column->what),
                      column->format, column->infinite, column->zero);
    if (rows->mark && column->marked) printf("%c", rows->mark(rows->source, row, column->what));
  }
  if (rows->status) cli_say("  %s", hooke_measurement_text(rows->source, "rows", row, "status"));
  printf("\n");
}

void cli_rows_print(const struct cli_rows *rows, int32_t method_width) {
  print_head(rows, method_width, 0);
  print_head(rows, method_width, 1);
  for (int64_t row = 0; row < hooke_measurement_row_count(rows->source, "rows"); row++) {
    if (rows->grouped && row > 0 && strcmp(method_of(rows, row), method_of(rows, row - 1)) != 0) printf("\n");
    print_row(rows, row, method_width);
  }
}
