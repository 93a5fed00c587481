/* What a study gave of watched quantities, and of its ensemble, for a person. */
#include "study_watched.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL = 16, WIDTH = 110, CELL = 11, SETTING = 12, HEAD_SIZE = 128, TEXT_SIZE = 512 };

/* A bias below this many standard errors is one that chance makes. */
static const double SEEN = 2.0;
static const int MEMBERS_ADVISED = 16;

const char *cli_study_nth(const hooke_study *study, const char *what, int64_t number) {
  char word[HOOKE_STUDY_WORD_SIZE];
  snprintf(word, sizeof word, "%s:%lld", what, (long long)number);
  const char *text = hooke_study_reference(study, word);
  return text ? text : "";
}

double cli_study_of(const hooke_study *study, int64_t row, const char *what, const char *quantity) {
  char word[HOOKE_STUDY_WORD_SIZE];
  snprintf(word, sizeof word, "%s:%s", what, quantity);
  return row < 0 ? hooke_study_figure(study, word) : hooke_study_number(study, row, word);
}

const char *cli_study_unit(const hooke_study *study, const char *quantity) {
  char word[HOOKE_STUDY_WORD_SIZE];
  snprintf(word, sizeof word, "unit:%s", quantity);
  const char *unit = hooke_study_reference(study, word);
  return unit ? unit : "";
}

/* "57.y [m]" */
static const char *head_of(const hooke_study *study, const char *quantity, char head[HEAD_SIZE]) {
  const char *unit = cli_study_unit(study, quantity);
  snprintf(head, HEAD_SIZE, "%.100s%s%s%s", quantity, unit[0] ? " [" : "", unit, unit[0] ? "]" : "");
  return head;
}

static void print_words(const char *label, const char *text) {
  printf("%-*s", LABEL, label);
  cli_print_wrapped(stdout, LABEL, LABEL, WIDTH, text);
}

/* Text on the right of a column. */
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

static int print_head(const hooke_study *study, const char *quantity) {
  char head[HEAD_SIZE];
  const int length = (int)strlen(head_of(study, quantity, head)), width = length < CELL ? CELL : length;
  printf("  ");
  print_right(width, head);
  return width;
}

/* A number, marked where it is within ten times of what the reference is known to. */
static void print_error(int width, double value, double agreement) {
  char cell[HOOKE_NUMBER_SIZE] = "-";
  if (!isnan(value)) snprintf(cell, sizeof cell, "%.4g", value);
  printf(" %*s%c", width, cell, value <= 10.0 * agreement ? '*' : ' ');
}

static void print_cells(const hooke_study *study, int64_t row, const int *width) {
  for (int64_t k = 0; k < (int64_t)hooke_study_figure(study, "watched"); k++) {
    const char *quantity = cli_study_nth(study, "watched", k);
    const double agreement = cli_study_of(study, -1, "agreement", quantity);
    if (row < 0)
      print_error(width[k], agreement, -1.0);
    else
      print_error(width[k], cli_study_of(study, row, "watched", quantity), agreement);
  }
  printf("\n");
}

void cli_study_watched_print(const struct cli_study_results *results, int32_t method_width) {
  const hooke_study *study = results->study;
  const int64_t count = (int64_t)hooke_study_figure(study, "watched");
  int *width = count > 0 ? calloc((size_t)count, sizeof *width) : NULL;
  if (width == NULL) return;
  printf("\n%-*s %*s", method_width, "error in", SETTING, "step [s]");
  for (int64_t k = 0; k < count; k++)
    width[k] = print_head(study, cli_study_nth(study, "watched", k));
  printf("\n%-*s %*s", method_width, "agreement", SETTING, "");
  print_cells(study, -1, width);
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    printf("%-*s", method_width, hooke_study_text(study, row, "method"));
    printf(" ");
    print_setting(SETTING, hooke_study_number(study, row, "step"), hooke_study_number(study, row, "rtol"));
    print_cells(study, row, width);
  }
  printf(
      "the largest differences from the reference, in a period (-: none is seen) that of the two periods; *: "
      "within ten times of the agreement\n");
  free(width);
}

/* ---- statistics ---- */

static double statistic(const hooke_study *study, const char *method, const char *quantity,
                        const char *what) {
  return hooke_study_statistic(study, method, quantity, what);
}

static void print_bias(const hooke_study *study, const char *method, const char *quantity) {
  const double bias = statistic(study, method, quantity, "bias");
  const double failed = statistic(study, method, quantity, "failed");
  if (strcmp(method, "reference") == 0)
    printf("\n");
  else if (failed > 0.0)
    printf("  unknown: a run did not come to its end\n");
  else if (isnan(bias))
    printf("  unknown\n");
  else if (fabs(bias) < SEEN)
    printf("  none seen (%+.1f)\n", bias);
  else
    printf("  %+.3g standard errors\n", bias);
}

/* Nothing of a method without a row that finished. */
static void print_source(const hooke_study *study, int32_t method_width, const char *method,
                         const char *quantity) {
  const double step = statistic(study, method, quantity, "step"),
               rtol = statistic(study, method, quantity, "rtol");
  if (isnan(step) && isnan(rtol)) return;
  printf("  %-*s ", method_width, method);
  print_setting(SETTING, step, rtol);
  printf(" %5.0f", statistic(study, method, quantity, "members"));
  cli_rows_print_cell(CELL, statistic(study, method, quantity, "mean"));
  cli_rows_print_cell(CELL, statistic(study, method, quantity, "spread"));
  print_bias(study, method, quantity);
}

static void print_quantity(const struct cli_study_results *results, int32_t method_width,
                           const char *quantity) {
  char head[HEAD_SIZE];
  cli_print_text(stdout, head_of(results->study, quantity, head));
  printf("\n");
  print_source(results->study, method_width, "reference", quantity);
  for (int32_t m = 0; m < results->methods.count; m++)
    print_source(results->study, method_width, results->methods.name[m], quantity);
}

static void print_ensemble(const struct cli_study_results *results, int32_t method_width) {
  const hooke_study *study = results->study;
  char text[TEXT_SIZE];
  if (isnan(hooke_study_figure(study, "statistics_from"))) {
    snprintf(text, sizeof text, "none came to its end, of %.0f runs of each method%s",
             hooke_study_figure(study, "members"),
             hooke_study_figure(study, "budget_spent") == 1.0 ? "; a larger --budget leaves time for them"
                                                              : "");
    printf("\n");
    print_words("statistics", text);
    return;
  }
  snprintf(text, sizeof text,
           "of means over %.6g s to %.6g s, where positions cannot be computed; of %.0f runs of each method, "
           "whose "
           "starts differ by noise of %.3g m",
           hooke_study_figure(study, "statistics_from"), hooke_study_figure(study, "statistics_until"),
           hooke_study_figure(study, "members"), hooke_study_figure(study, "noise"));
  printf("\n");
  print_words("statistics", text);
  printf("  %-*s %*s %5s %*s %*s  %s\n", method_width, "method", SETTING, "step [s]", "runs", CELL, "mean",
         CELL, "spread", "bias");
  for (int64_t k = 0; k < (int64_t)hooke_study_figure(study, "quantities"); k++)
    print_quantity(results, method_width, cli_study_nth(study, "quantity", k));
  printf("spread: the standard deviation of the runs; bias: the difference from the reference's mean, in "
         "standard errors of it;\nbelow %.0f none is seen, and where there is none, one figure in twenty is "
         "above, more with few runs\n",
         SEEN);
}

void cli_study_statistics_print(const struct cli_study_results *results, int32_t method_width) {
  const hooke_study *study = results->study;
  const double until = hooke_study_figure(study, "trusted_until");
  const int32_t whole = cli_study_results_trust_all(study);
  const char *asked = cli_arguments_text(results->arguments, "ensemble");
  char text[TEXT_SIZE];
  if (hooke_study_figure(study, "members") > 0.0) {
    print_ensemble(results, method_width);
  } else if (asked && whole) {
    printf("\n");
    print_words("statistics", "none are needed: errors are known over the whole run");
  } else if (!whole && !asked && hooke_study_row_count(study) > 0 && !results->arguments->quiet) {
    snprintf(text, sizeof text, "--ensemble %d tells means and spreads beyond %.6g s", MEMBERS_ADVISED,
             until);
    printf("\n");
    print_words("statistics", text);
  }
}
