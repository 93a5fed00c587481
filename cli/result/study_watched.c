/* Watched quantities of a study and its ensemble, in words. */
#include "rows.h"
#include "study_watched.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL = 16, WIDTH = 110, CELL = 11, SETTING = 12, HEAD_SIZE = 128 };

/* A bias below this many standard errors is compatible with chance. */
static const double SEEN = 2.0;
static const int MEMBERS_ADVISED = 16;

/* Of the table "statistics", whose rows are those of each method, the reference first, times these. */
static int64_t quantity_count(const hooke_measurement *study) {
  const int64_t count = hooke_measurement_row_count(study, "statistics");
  int64_t quantities = 0;
  while (quantities < count &&
         strcmp(hooke_measurement_text(study, "statistics", quantities, "method"), "reference") == 0)
    quantities++;
  return quantities;
}

/* "57.y [m]", from a row of a table. */
static const char *head_of(const hooke_measurement *study, const char *table, int64_t row,
                           char head[HEAD_SIZE]) {
  const char *unit = hooke_measurement_text(study, table, row, "unit");
  snprintf(head, HEAD_SIZE, "%.100s%s%s%s", hooke_measurement_text(study, table, row, "quantity"),
           unit[0] ? " [" : "", unit, unit[0] ? "]" : "");
  return head;
}

/* Right-aligned text in a column. */
static void print_right(int width, const char *text) {
  for (int k = (int)strlen(text); k < width; k++)
    fputc(' ', stdout);
  cli_print_text(stdout, text);
}

static void print_setting(int width, double step, double rtol) {
  char setting[HOOKE_NUMBER_SIZE];
  snprintf(setting, sizeof setting, "%s%.4g", isnan(step) ? "rtol " : "", isnan(step) ? rtol : step);
  print_right(width, setting);
}

/* ---- watched quantities ---- */

static int print_head(const hooke_measurement *study, int64_t quantity) {
  char head[HEAD_SIZE];
  const int length = (int)strlen(head_of(study, "watched", quantity, head)),
            width = length < CELL ? CELL : length;
  printf("  ");
  print_right(width, head);
  return width;
}

/* A number, marked if it is within ten times the accuracy of the reference. */
static void print_error(int width, double value, double agreement) {
  char cell[HOOKE_NUMBER_SIZE] = "-";
  if (!isnan(value)) snprintf(cell, sizeof cell, "%.4g", value);
  printf(" %*s%c", width, cell, value <= 10.0 * agreement ? '*' : ' ');
}

/* The errors of a row; the agreements if it is -1. */
static void print_cells(const hooke_measurement *study, int64_t row, const int *width) {
  const int64_t count = hooke_measurement_row_count(study, "watched");
  for (int64_t k = 0; k < count; k++) {
    const double agreement = hooke_measurement_number(study, "watched", k, "agreement");
    if (row < 0)
      print_error(width[k], agreement, -1.0);
    else
      print_error(width[k], hooke_measurement_number(study, "watched_errors", row * count + k, "error"),
                  agreement);
  }
  printf("\n");
}

void cli_study_watched_print(const struct cli_study_results *results, int32_t method_width) {
  const hooke_measurement *study = results->study;
  const int64_t count = hooke_measurement_row_count(study, "watched");
  int *width = count > 0 ? calloc((size_t)count, sizeof *width) : NULL;
  if (width == NULL) return;
  printf("\n%-*s %*s", method_width, "error in", SETTING, "step [s]");
  for (int64_t k = 0; k < count; k++)
    width[k] = print_head(study, k);
  printf("\n%-*s %*s", method_width, "agreement", SETTING, "");
  print_cells(study, -1, width);
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "rows"); row++) {
    cli_print_padded(stdout, method_width, hooke_measurement_text(study, "rows", row, "method"));
    printf(" ");
    print_setting(SETTING, hooke_measurement_number(study, "rows", row, "step"),
                  hooke_measurement_number(study, "rows", row, "rtol"));
    print_cells(study, row, width);
  }
  printf("the largest differences from the reference, in a period (-: none is seen) that of the two periods; "
         "*: within ten times of the agreement\n");
  free(width);
}

/* ---- statistics ---- */

static double statistic(const hooke_measurement *study, int64_t row, const char *what) {
  return hooke_measurement_number(study, "statistics", row, what);
}

static void print_bias(const hooke_measurement *study, int64_t row) {
  const double bias = statistic(study, row, "bias");
  if (strcmp(hooke_measurement_text(study, "statistics", row, "method"), "reference") == 0)
    printf("\n");
  else if (statistic(study, row, "failed") > 0.0)
    printf("  unknown: a run did not come to its end\n");
  else if (isnan(bias))
    printf("  unknown\n");
  else if (fabs(bias) < SEEN)
    printf("  none seen (%+.1f)\n", bias);
  else
    printf("  %+.3g standard errors\n", bias);
}

static void print_source(const hooke_measurement *study, int32_t method_width, int64_t row) {
  printf("  ");
  cli_print_padded(stdout, method_width + 1, hooke_measurement_text(study, "statistics", row, "method"));
  print_setting(SETTING, statistic(study, row, "step"), statistic(study, row, "rtol"));
  printf(" %5.0f", statistic(study, row, "members"));
  cli_rows_print_cell(CELL, statistic(study, row, "mean"));
  cli_rows_print_cell(CELL, statistic(study, row, "spread"));
  print_bias(study, row);
}

/* One of `count` quantities. */
static void print_quantity(const hooke_measurement *study, int32_t method_width, int64_t quantity,
                           int64_t count) {
  const int64_t rows = hooke_measurement_row_count(study, "statistics");
  char head[HEAD_SIZE];
  cli_say("%s\n", head_of(study, "statistics", quantity, head));
  for (int64_t row = quantity; row < rows; row += count)
    print_source(study, method_width, row);
}

static void print_ensemble(const struct cli_study_results *results, int32_t method_width) {
  const hooke_measurement *study = results->study;
  if (isnan(cli_number(study, "ensemble", "from"))) return;
  printf("\nstatistics\n");
  printf("  %-*s %*s %5s %*s %*s  %s\n", method_width, "method", SETTING, "step [s]", "runs", CELL, "mean",
         CELL, "spread", "bias");
  const int64_t count = quantity_count(study);
  for (int64_t k = 0; k < count; k++)
    print_quantity(study, method_width, k, count);
  printf("spread: the standard deviation of the runs; bias: the difference from the reference's mean, in "
         "standard errors of it;\nbelow %.0f none is seen, and where there is none, one figure in twenty is "
         "above, more with few runs\n",
         SEEN);
}

void cli_study_statistics_print(const struct cli_study_results *results, int32_t method_width) {
  const hooke_measurement *study = results->study;
  const int32_t asked = cli_arguments_text(results->arguments, "ensemble") != NULL;
  if (hooke_measurement_row_count(study, "ensemble") > 0) {
    print_ensemble(results, method_width);
  } else if (!results->trusts_all && !asked && hooke_measurement_row_count(study, "rows") > 0 &&
             !results->arguments->quiet) {
    printf("\n");
    cli_print_fact(LABEL, WIDTH, "statistics", "--ensemble %d tells means and spreads beyond %.6g s",
                   MEMBERS_ADVISED, cli_number(study, "reference", "trusted_until"));
  }
}
