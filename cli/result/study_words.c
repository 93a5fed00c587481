/* The results of a study in words. */
#include "claims.h"
#include "rows.h"
#include "study_results.h"
#include "study_watched.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INDENT = 16, WIDTH = 110, TIMES = 5 };

static char mark_of(const hooke_measurement *study, int64_t row, const char *what) {
  if (strcmp(what, "error") == 0)
    return hooke_measurement_number(study, "rows", row, "near_floor") == 1.0 ? '*' : ' ';
  if (strcmp(what, "energy_drift") == 0)
    return hooke_measurement_number(study, "rows", row, "near_energy_floor") == 1.0 ? '*' : ' ';
  return hooke_measurement_number(study, "rows", row, "timed_alone") == 0.0 ? '+' : ' ';
}

static struct cli_rows rows_of(const struct cli_study_results *results) {
  return (struct cli_rows){.source = results->study,
                           .count = hooke_measurement_row_count(results->study, "rows"),
                           .columns = cli_rows_of_runs,
                           .grouped = !results->once,
                           .status = 1,
                           .mark = mark_of};
}

/* ---- errors over time ---- */

/* At a few evenly spaced frames, including the last. */
static void print_errors(const struct cli_rows *rows, int32_t width) {
  int64_t count;
  const double *time = hooke_measurement_series(rows->source, "reference", 0, "time", &count);
  const int64_t last = count - 1, frames = last < TIMES ? last : TIMES;
  printf("\nerror [m]\n%-*s", width, "at t [s] =");
  for (int64_t i = 1; i <= frames; i++)
    cli_rows_print_cell(10, time[last * i / frames]);
  printf("\n");
  for (int64_t row = 0; row < rows->count; row++) {
    const double *error = hooke_measurement_series(rows->source, "rows", row, "error_at", NULL);
    cli_print_padded(stdout, width, hooke_measurement_text(rows->source, "rows", row, "method"));
    for (int64_t i = 1; i <= frames; i++)
      cli_rows_print_cell(10, error ? error[last * i / frames] : (double)NAN);
    printf("\n");
  }
}

/* ---- orders ---- */

static void print_order(const hooke_measurement *study, int64_t row, int32_t width) {
  const double order = hooke_measurement_number(study, "orders", row, "order");
  const char *note = hooke_measurement_text(study, "orders", row, "note");
  char seen[HOOKE_NUMBER_SIZE] = "-", interval[HOOKE_NUMBER_SIZE] = "-";
  if (!isnan(order)) {
    snprintf(seen, sizeof seen, "%.2f", order);
    snprintf(interval, sizeof interval, "%.2f to %.2f", hooke_measurement_number(study, "orders", row, "low"),
             hooke_measurement_number(study, "orders", row, "high"));
  }
  cli_print_padded(stdout, width, hooke_measurement_text(study, "orders", row, "method"));
  printf(" %7s %16s", seen, interval);
  cli_rows_print_cell(7, hooke_measurement_number(study, "orders", row, "theory"));
  printf(note[0] ? "  " : "\n");
  if (note[0]) cli_print_wrapped(stdout, width + 35, width + 35, WIDTH + 20, note);
}

static void print_orders(const hooke_measurement *study, int32_t width) {
  int32_t any = 0;
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "orders"); row++) {
    if (isnan(hooke_measurement_number(study, "orders", row, "theory"))) continue; /* of no fixed step */
    if (!any) printf("\n%-*s %7s %16s %7s\n", width, "order", "seen", "95 % interval", "theory");
    any = 1;
    print_order(study, row, width);
  }
  if (any)
    printf("95 %% interval: of the slope of a straight line, as if errors scattered about it by chance\n");
}

/* Legend of the columns, and of the marks that occur. */
static void print_legend(const struct cli_rows *rows, const hooke_measurement *study, int32_t once) {
  int32_t shared = 0, marked = 0;
  double spread = 0.0;
  for (int64_t row = 0; row < rows->count; row++) {
    shared |= rows->mark(rows->source, row, "wall_seconds") == '+';
    marked |=
        rows->mark(rows->source, row, "error") == '*' || rows->mark(rows->source, row, "energy_drift") == '*';
    spread = fmax(spread, hooke_measurement_number(study, "rows", row, "wall_median") /
                              hooke_measurement_number(study, "rows", row, "wall_seconds"));
  }
  printf("\nerror: the root mean square over free particles of the distance to the reference; farthest: the "
         "largest distance of\na particle, which a wanted error is held against; wall time: ");
  if (once)
    printf("of one run");
  else
    printf("the least of several runs, whose median is up to %.0f %% longer",
           fmax(0.0, 100.0 * (spread - 1.0)));
  printf("\n%s%s", marked ? "*: within ten times of the floor\n" : "",
         shared ? "+: other rows ran beside it, so its time may be too long\n" : "");
}

void cli_study_results_print(const struct cli_study_results *results) {
  const struct cli_arguments *arguments = results->arguments;
  const struct cli_rows rows = rows_of(results);
  int32_t width = cli_rows_method_width(&rows);
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, %s s\n", cli_setup_title(arguments, &results->setup),
          cli_format_rounded(cli_number(results->study, "study", "duration"), text));
  const int met = cli_number(results->study, "recommendation", "met") == 1.0;
  cli_claims_print(arguments, results->study, INDENT, met ? results->command : NULL);
  if (rows.count > 0) {
    if (results->once) print_errors(&rows, width);
    printf("\n");
    cli_rows_print(&rows, width);
    print_legend(&rows, results->study, results->once);
    cli_study_watched_print(results, width);
  }
  if (rows.count > 0 && !results->once) print_orders(results->study, width);
  if (rows.count > 0 && !arguments->quiet && !cli_arguments_text(arguments, "want")) {
    printf("\nwhich one to take: %s the error that you can live with, such as --want 1mm\n",
           results->once ? "'hooke study' with" : "add");
  }
  if (!results->once) cli_study_statistics_print(results, width);
}
