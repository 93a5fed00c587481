#include "rows.h"
#include "print.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELL_SIZE = 24, LEAST_WIDTH = 10 };

static const struct column {
  const char *what, *head, *unit;
  int width;
  int32_t counts; /* an integer, printed in full */
  int32_t marked; /* a mark may follow */
} columns[] = {{"step", "step", "[s]", 9, 0, 0},
               {"rtol", "rtol", "", 9, 0, 0},
               {"error", "error", "max [m]", 10, 0, 1},
               {"error_final", "error", "end [m]", 10, 0, 0},
               {"error_max", "farthest", "particle [m]", 12, 0, 0},
               {"energy_drift", "energy", "drift [J]", 10, 0, 1},
               {"steps", "steps", "", 9, 1, 0},
               {"force_evaluations", "force", "evaluations", 11, 1, 0},
               {"wall_seconds", "wall time", "[s]", 10, 0, 1}};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

static const char *method_of(const struct cli_rows *rows, int64_t row) {
  return hooke_measurement_text(rows->source, "rows", row, "method");
}

int32_t cli_rows_method_width(const struct cli_rows *rows) {
  size_t width = LEAST_WIDTH;
  for (int64_t row = 0; row < rows->count; row++) {
    size_t length = strlen(method_of(rows, row));
    if (length > width) width = length;
  }
  return (int32_t)width;
}

void cli_rows_print_cell(int32_t width, double value) {
  char cell[CELL_SIZE] = "-";
  if (!isnan(value)) snprintf(cell, sizeof cell, "%.4g", value);
  printf(" %*s", width, cell);
}

static void print_head(const struct cli_rows *rows, int32_t method_width, int32_t second) {
  printf("%-*s", method_width, second ? "" : "method");
  for (int i = 0; i < COLUMN_COUNT; i++) {
    printf(" %*s", columns[i].width, second ? columns[i].unit : columns[i].head);
    if (rows->mark && columns[i].marked && i + 1 < COLUMN_COUNT) printf(" ");
  }
  printf("\n");
}

static void print_row(const struct cli_rows *rows, int64_t row, int32_t method_width) {
  cli_print_padded(stdout, method_width, method_of(rows, row));
  for (int i = 0; i < COLUMN_COUNT; i++) {
    double value = hooke_measurement_number(rows->source, "rows", row, columns[i].what);
    if (columns[i].counts) {
      printf(" %*.0f", columns[i].width, value);
    } else {
      cli_rows_print_cell(columns[i].width, value);
    }
    if (rows->mark && columns[i].marked) printf("%c", rows->mark(rows->source, row, columns[i].what));
  }
  printf("  ");
  cli_print_text(stdout, hooke_measurement_text(rows->source, "rows", row, "status"));
  printf("\n");
}

void cli_rows_print(const struct cli_rows *rows, int32_t method_width) {
  print_head(rows, method_width, 0);
  print_head(rows, method_width, 1);
  for (int64_t row = 0; row < rows->count; row++) {
    if (rows->grouped && row > 0 && strcmp(method_of(rows, row), method_of(rows, row - 1)) != 0) printf("\n");
    print_row(rows, row, method_width);
  }
}
