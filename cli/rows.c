#include "rows.h"
#include "print.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELL_SIZE = 24 };

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
