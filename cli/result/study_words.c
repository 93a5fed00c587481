/* The results of a study in words, and as JSON. */
#include "rows.h"
#include "study_results.h"
#include "study_watched.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LABEL = 16, WIDTH = 110, TIMES = 5 };

/* Differences that grow more than this are called chaotic if the integrators part. */
static const double CHAOTIC = 1e3;

#define print_fact(...) cli_print_fact(LABEL, WIDTH, __VA_ARGS__)

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

/* ---- the reference ---- */

/* Reason why errors are not judged over the whole run. */
static void print_why_not_all(const hooke_measurement *study, const char *time) {
  const char *ended = cli_text(study, "reference", "ended");
  const int32_t hurried = strcmp(ended, "time") == 0;
  const char *format =
      cli_number(study, "reference", "trusted_until") >= cli_number(study, "reference", "checked_until")
          ? "its share of the budget left no time to check the reference beyond %s s. Errors and energy "
            "drift are those up to %s s; a larger --budget or a shorter --duration checks all of it."
      : strcmp(ended, "parted") == 0
          ? "the two integrators part after %s s. Errors and energy drift are those up to %s s; 'hooke "
            "study' tells how much small differences grow, and whether tighter tolerances know more."
      : hurried
          ? "at the tolerances that their share of the budget leaves time for, the two integrators part "
            "after %s s. Errors and energy drift are those up to %s s; a larger --budget may know more."
      : cli_number(study, "reference", "growth_seen") > CHAOTIC
          ? "this motion is chaotic: small differences grow so much that the two integrators part after %s s "
            "even where rounding alone sets them apart, and where the particles are later cannot be computed "
            "to the wanted digits. Errors and energy drift are those up to %s s."
          : "the two integrators part after %s s, although differences do not "
            "grow much: rounding keeps them from the wanted digits even at their "
            "tightest tolerances. Errors and energy drift are those up to %s s.";
  print_fact("WARNING", format, time, time);
}

static void print_growth(const hooke_measurement *study) {
  const double most = cli_number(study, "reference", "growth"),
               seen = cli_number(study, "reference", "growth_seen");
  if (isnan(seen)) return;
  if (isnan(most)) {
    print_fact("growth", "a displacement of the start grows %.3g times; others may grow more", seen);
  } else if (cli_number(study, "reference", "growth_probability") == 1.0) {
    print_fact("growth", "a small displacement of the start grows at most %.3g times", most);
  } else {
    print_fact("growth",
               "a small displacement of the start grows at most %.3g times, with a probability of 1 - "
               "1e-%.0f; random ones grow %.3g times",
               most, cli_number(study, "reference", "displacements"), seen);
  }
}

static void print_trust(const struct cli_study_results *results, double agreement) {
  const hooke_measurement *study = results->study;
  double until = cli_number(study, "reference", "trusted_until");
  double duration = cli_number(study, "study", "duration");
  char time[HOOKE_NUMBER_SIZE], all[HOOKE_NUMBER_SIZE];
  cli_format_rounded(until, time);
  cli_format_rounded(duration, all);
  int32_t parted = until < cli_number(study, "reference", "checked_until");
  if (isnan(agreement))
    print_fact("agreement",
               "not known: the two part before the first frame after the start, so no error is known");
  else
    print_fact("agreement",
               "%.3g m%s: no error below that means anything; those within ten times of it are marked *, as "
               "is energy drift within ten times of %.3g J",
               agreement, parted ? ", until they part" : "",
               cli_number(study, "reference", "energy_agreement"));
  print_fact("trusted until", results->trusts_all ? "%s s, the whole run" : "%s s of %s s", time, all);
  print_growth(study);
  if (!results->trusts_all) print_why_not_all(study, time);
}

static void print_reference(const struct cli_study_results *results) {
  const hooke_measurement *study = results->study;
  const double agreement = cli_number(study, "reference", "agreement");
  if (isnan(cli_number(study, "reference", "trusted_until"))) {
    print_fact("reference", "not finished, so there is nothing to measure against");
    return;
  }
  print_fact("reference", "%s, checked by %s; they share the forces and nothing else",
             cli_text(study, "reference", "method"), cli_text(study, "reference", "check"));
  print_trust(results, agreement);
  const char *passages = cli_text(study, "reference", "zero_passages");
  if (passages[0]) print_fact("WARNING", "%s", passages);
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

/* ---- the recommendation ---- */

/* The margin of the recommendation under small changes of the scene. */
static void print_change(const hooke_measurement *study, const char *change, const char *holds,
                         const char *error) {
  const double held = cli_number(study, "margin", holds);
  const double off = cli_number(study, "margin", error);
  if (isnan(held))
    print_fact("", "%s: not known in this time", change);
  else if (isnan(off))
    print_fact("", "%s: no longer, a run did not come to its end or was not judged", change);
  else
    print_fact("", "%s: %s, its error is %.3g m then", change,
               held == 1.0 ? "still at most that" : "no longer", off);
}

static void print_margin(const hooke_measurement *study) {
  const double share = cli_number(study, "margin", "limit_share");
  char limit[64] = "";
  if (!isnan(share) && !isinf(share) && share > 0.0)
    snprintf(limit, sizeof limit, "; its step is %.2g of the largest stable one at the start", share);
  print_fact("margin", "error between %.3g and %.3g m, by the agreement of the reference%s",
             cli_number(study, "margin", "error_low"), cli_number(study, "margin", "error_high"), limit);
  print_change(study, "stiffness 10 % more or less", "holds_stiffness", "error_stiffness");
  print_change(study, "all started faster or slower along (1, 1, 1) by 10 % of the largest speed",
               "holds_start", "error_start");
}

/* No command: nothing is recommended. */
static void print_closest(const hooke_measurement *study) {
  const double step = cli_number(study, "recommendation", "step");
  char value[HOOKE_NUMBER_SIZE];
  cli_format_rounded(isnan(step) ? cli_number(study, "recommendation", "rtol") : step, value);
  print_fact("closest", "%s, %s %s%s", cli_text(study, "recommendation", "method"),
             isnan(step) ? "rtol" : "step", value, isnan(step) ? "" : " s");
}

static void print_recommendation(const struct cli_study_results *results) {
  const hooke_measurement *study = results->study;
  double want = cli_number(study, "recommendation", "want");
  int32_t met = cli_number(study, "recommendation", "met") == 1.0;
  char text[HOOKE_NUMBER_SIZE], time[HOOKE_NUMBER_SIZE];
  cli_format_rounded(want, text);
  cli_format_rounded(cli_number(study, "recommendation", "until"), time);
  printf("\n");
  if (met) {
    print_fact("recommendation", "the cheapest run found whose error is at most %s m up to %s s%s:", text,
               time, results->trusts_all ? "" : "; of what comes later nobody can know");
  } else {
    print_fact("recommendation", "none for an error of at most %s m: %s", text,
               cli_text(study, "recommendation", "note"));
  }
  if (!results->command) return;
  if (met) {
    cli_say("%*s%s\n", LABEL, "", results->command);
  } else {
    print_closest(study);
  }
  print_fact("", "error %.3g m, wall time %.3g s (median %.3g s), %.0f force evaluations, as measured",
             cli_number(study, "recommendation", "error"),
             cli_number(study, "recommendation", "wall_seconds"),
             cli_number(study, "recommendation", "wall_median"),
             cli_number(study, "recommendation", "force_evaluations"));
  if (met && cli_text(study, "recommendation", "note")[0])
    print_fact("", "%s", cli_text(study, "recommendation", "note"));
  if (met) print_margin(study);
}

/* Legend of the columns, and of the marks that occur. */
static void print_legend(const struct cli_rows *rows, const hooke_measurement *study, int32_t once) {
  int32_t shared = 0;
  double spread = 0.0;
  for (int64_t row = 0; row < rows->count; row++) {
    shared |= rows->mark(rows->source, row, "wall_seconds") == '+';
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
  printf("%s\n", shared ? "; +: other rows ran beside it, so its time may be too long" : "");
}

void cli_study_results_print(const struct cli_study_results *results) {
  const struct cli_arguments *arguments = results->arguments;
  const struct cli_rows rows = rows_of(results);
  int32_t width = cli_rows_method_width(&rows);
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, %s s\n", cli_setup_title(arguments, &results->setup),
          cli_format_rounded(cli_number(results->study, "study", "duration"), text));
  print_reference(results);
  if (rows.count > 0) {
    if (results->once) print_errors(&rows, width);
    printf("\n");
    cli_rows_print(&rows, width);
    print_legend(&rows, results->study, results->once);
    cli_study_watched_print(results, width);
  }
  if (cli_number(results->study, "study", "budget_spent") == 1.0)
    printf("the budget is spent: what it left no time for is missing\n");
  if (rows.count > 0 && !results->once) print_orders(results->study, width);
  if (results->recommends) {
    print_recommendation(results);
  } else if (rows.count > 0 && !arguments->quiet && !cli_arguments_text(arguments, "want")) {
    printf("\nwhich one to take: %s the error that you can live with, such as --want 1mm\n",
           results->once ? "'hooke study' with" : "add");
  }
  if (!results->once) cli_study_statistics_print(results, width);
}

int32_t cli_study_results_print_json(const struct cli_study_results *results) {
  static const char *const tables[] = {"reference", "rows", "orders"};
  hooke_measurement *study = results->study;
  const int met = cli_number(study, "recommendation", "met") == 1.0;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "scene", results->arguments->scene);
  cli_json_measured(&json, NULL, study, "study", 0);
  for (size_t k = 0; k < sizeof tables / sizeof tables[0]; k++)
    cli_json_measured(&json, tables[k], study, tables[k], -1);
  if (results->recommends) {
    cli_json_open(&json, "recommendation", '{');
    cli_json_measured(&json, NULL, study, "recommendation", 0);
    cli_json_text(&json, "command", met ? results->command : NULL);
    cli_json_close(&json);
  } else {
    cli_json_text(&json, "recommendation", NULL);
  }
  cli_json_measured(&json, "statistics", study, "ensemble", -1);
  return cli_json_end(&json);
}
