/* The results of a study in words. */
#include "study_results.h"
#include "study_watched.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LABEL = 16, WIDTH = 110, TEXT_SIZE = 1024, TIMES = 5 };

/* Differences that grow more than this are called chaotic if the integrators part. */
static const double CHAOTIC = 1e3;

static void print_fact(const char *label, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A label, with words that wrap beside it. */
static void print_fact(const char *label, const char *format, ...) {
  char text[TEXT_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  cli_print_fact(LABEL, WIDTH, label, text);
}

/* ---- the reference ---- */

/* Reason why errors are not judged over the whole run. */
static void print_why_not_all(const hooke_measurement *study, const char *time) {
  const char *ended = hooke_measurement_text(study, "reference", 0, "ended");
  const int32_t hurried = strcmp(ended, "time") == 0;
  const char *format =
      hooke_measurement_number(study, "reference", 0, "trusted_until") >=
              hooke_measurement_number(study, "reference", 0, "checked_until")
          ? "its share of the budget left no time to check the reference beyond %s s. Errors and energy "
            "drift are those "
            "up to %s s; a larger --budget or a shorter --duration checks all of it."
      : strcmp(ended, "parted") == 0
          ? "the two integrators part after %s s. Errors and energy drift are those up to %s s; 'hooke "
            "study' "
            "tells how much small differences grow, and whether tighter tolerances know more."
      : hurried ? "at the tolerances that their share of the budget leaves time for, the two integrators "
                  "part after %s s. Errors "
                  "and energy drift are those up to %s s; a larger --budget may know more."
      : hooke_measurement_number(study, "reference", 0, "growth_seen") > CHAOTIC
          ? "this motion is chaotic: small differences grow so much that the two integrators part after %s s "
            "even where rounding alone sets them apart, and where the particles are later cannot be computed "
            "to the wanted digits. Errors and energy drift are those up to %s s."
          : "the two integrators part after %s s, although differences do not grow much: rounding keeps them "
            "from the wanted digits even at their tightest tolerances. Errors and energy drift are those up "
            "to %s s.";
  print_fact("WARNING", format, time, time);
}

static void print_growth(const hooke_measurement *study) {
  const double most = hooke_measurement_number(study, "reference", 0, "growth"),
               seen = hooke_measurement_number(study, "reference", 0, "growth_seen");
  if (isnan(seen)) return;
  if (isnan(most)) {
    print_fact("growth", "a displacement of the start grows %.3g times; others may grow more", seen);
  } else if (hooke_measurement_number(study, "reference", 0, "growth_probability") == 1.0) {
    print_fact("growth", "a small displacement of the start grows at most %.3g times", most);
  } else {
    print_fact(
        "growth",
        "a small displacement of the start grows at most %.3g times, with a probability of 1 - 1e-%.0f; "
        "random ones grow %.3g times",
        most, hooke_measurement_number(study, "reference", 0, "displacements"), seen);
  }
}

static void print_trust(const hooke_measurement *study, double agreement) {
  double until = hooke_measurement_number(study, "reference", 0, "trusted_until");
  double duration = hooke_measurement_number(study, "study", 0, "duration");
  const int32_t whole = cli_study_results_trust_all(study);
  char time[HOOKE_NUMBER_SIZE], all[HOOKE_NUMBER_SIZE];
  cli_format_rounded(until, time);
  cli_format_rounded(duration, all);
  int32_t parted = until < hooke_measurement_number(study, "reference", 0, "checked_until");
  if (isnan(agreement))
    print_fact("agreement",
               "not known: the two part before the first frame after the start, so no error is known");
  else
    print_fact("agreement",
               "%.3g m%s: no error below that means anything; those within ten times of it are marked *, "
               "as is energy drift within ten times of %.3g J",
               agreement, parted ? ", until they part" : "",
               hooke_measurement_number(study, "reference", 0, "energy_agreement"));
  print_fact("trusted until", whole ? "%s s, the whole run" : "%s s of %s s", time, all);
  print_growth(study);
  if (!whole) print_why_not_all(study, time);
}

static void print_reference(const hooke_measurement *study) {
  const double agreement = hooke_measurement_number(study, "reference", 0, "agreement");
  if (isnan(hooke_measurement_number(study, "reference", 0, "trusted_until"))) {
    print_fact("reference", "not finished, so there is nothing to measure against");
    return;
  }
  print_fact("reference", "%s, checked by %s; they share the forces and nothing else",
             hooke_measurement_text(study, "reference", 0, "method"),
             hooke_measurement_text(study, "reference", 0, "check"));
  print_trust(study, agreement);
  const char *passages = hooke_measurement_text(study, "reference", 0, "zero_passages");
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

static void print_order(const hooke_measurement *study, const char *method, int32_t width) {
  const int64_t row = hooke_measurement_find(study, "orders", "method", method);
  const double order = hooke_measurement_number(study, "orders", row, "order");
  const char *note = hooke_measurement_text(study, "orders", row, "note");
  char seen[HOOKE_NUMBER_SIZE] = "-", interval[HOOKE_NUMBER_SIZE] = "-";
  if (!isnan(order)) {
    snprintf(seen, sizeof seen, "%.2f", order);
    snprintf(interval, sizeof interval, "%.2f to %.2f", hooke_measurement_number(study, "orders", row, "low"),
             hooke_measurement_number(study, "orders", row, "high"));
  }
  printf("%-*s %7s %16s", width, method, seen, interval);
  cli_rows_print_cell(7, hooke_measurement_number(study, "orders", row, "theory"));
  if (note && note[0]) {
    printf("  ");
    cli_print_wrapped(stdout, width + 35, width + 35, WIDTH + 20, note);
  } else {
    printf("\n");
  }
}

static void print_orders(const struct cli_study_results *results, int32_t width) {
  int32_t any = 0;
  for (int32_t i = 0; i < results->methods.count; i++) {
    const char *method = results->methods.name[i];
    if (hooke_method_is_adaptive(method) != 0) continue;
    if (hooke_measurement_find(results->study, "orders", "method", method) < 0)
      continue; /* not of this scene */
    if (!any) printf("\n%-*s %7s %16s %7s\n", width, "order", "seen", "95 % interval", "theory");
    any = 1;
    print_order(results->study, method, width);
  }
  if (any)
    printf("95 %% interval: of the slope of a straight line, as if errors scattered about it by chance\n");
}

/* ---- the recommendation ---- */

/* The margin of the recommendation under small changes of the scene. */
static void print_change(const hooke_measurement *study, const char *change, const char *holds,
                         const char *error) {
  const double held = hooke_measurement_number(study, "margin", 0, holds);
  const double off = hooke_measurement_number(study, "margin", 0, error);
  if (isnan(held))
    print_fact("", "%s: not known in this time", change);
  else if (isnan(off))
    print_fact("", "%s: no longer, a run did not come to its end or was not judged", change);
  else
    print_fact("", "%s: %s, its error is %.3g m then", change,
               held == 1.0 ? "still at most that" : "no longer", off);
}

static void print_margin(const hooke_measurement *study) {
  const double share = hooke_measurement_number(study, "margin", 0, "limit_share");
  char limit[64] = "";
  if (!isnan(share) && !isinf(share) && share > 0.0)
    snprintf(limit, sizeof limit, "; its step is %.2g of the largest stable one at the start", share);
  print_fact("margin", "error between %.3g and %.3g m, by the agreement of the reference%s",
             hooke_measurement_number(study, "margin", 0, "error_low"),
             hooke_measurement_number(study, "margin", 0, "error_high"), limit);
  print_change(study, "stiffness 10 % more or less", "holds_stiffness", "error_stiffness");
  print_change(study, "all started faster or slower along (1, 1, 1) by 10 % of the largest speed",
               "holds_start", "error_start");
}

/* No command: nothing is recommended. */
static void print_closest(const hooke_measurement *study) {
  const double step = hooke_measurement_number(study, "recommendation", 0, "step");
  char value[HOOKE_NUMBER_SIZE];
  cli_format_rounded(isnan(step) ? hooke_measurement_number(study, "recommendation", 0, "rtol") : step,
                     value);
  print_fact("closest", "%s, %s %s%s", hooke_measurement_text(study, "recommendation", 0, "method"),
             isnan(step) ? "rtol" : "step", value, isnan(step) ? "" : " s");
}

static void print_recommendation(const struct cli_study_results *results) {
  const hooke_measurement *study = results->study;
  double want = hooke_measurement_number(study, "recommendation", 0, "want");
  int32_t met = hooke_measurement_number(study, "recommendation", 0, "met") == 1.0;
  char text[HOOKE_NUMBER_SIZE], time[HOOKE_NUMBER_SIZE];
  cli_format_rounded(want, text);
  cli_format_rounded(hooke_measurement_number(study, "recommendation", 0, "until"), time);
  printf("\n");
  if (met) {
    print_fact("recommendation", "the cheapest run found whose error is at most %s m up to %s s%s:", text,
               time, cli_study_results_trust_all(study) ? "" : "; of what comes later nobody can know");
  } else {
    print_fact("recommendation", "none for an error of at most %s m: %s", text,
               hooke_measurement_text(study, "recommendation", 0, "note"));
  }
  if (!results->command) return;
  if (met) {
    cli_say("%*s%s\n", LABEL, "", results->command);
  } else {
    print_closest(study);
  }
  print_fact("", "error %.3g m, wall time %.3g s (median %.3g s), %.0f force evaluations, as measured",
             hooke_measurement_number(study, "recommendation", 0, "error"),
             hooke_measurement_number(study, "recommendation", 0, "wall_seconds"),
             hooke_measurement_number(study, "recommendation", 0, "wall_median"),
             hooke_measurement_number(study, "recommendation", 0, "force_evaluations"));
  if (met && hooke_measurement_text(study, "recommendation", 0, "note")[0])
    print_fact("", "%s", hooke_measurement_text(study, "recommendation", 0, "note"));
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
  const struct cli_rows rows = cli_study_results_rows(results);
  const int32_t once = cli_study_results_once(results);
  int32_t width = cli_rows_method_width(&rows);
  char text[HOOKE_NUMBER_SIZE];
  cli_say("%s, %s s\n", cli_setup_title(arguments, &results->setup),
          cli_format_rounded(hooke_measurement_number(results->study, "study", 0, "duration"), text));
  print_reference(results->study);
  if (rows.count > 0) {
    if (once) print_errors(&rows, width);
    printf("\n");
    cli_rows_print(&rows, width);
    print_legend(&rows, results->study, once);
    cli_study_watched_print(results, width);
  }
  if (hooke_measurement_number(results->study, "study", 0, "budget_spent") == 1.0)
    printf("the budget is spent: what it left no time for is missing\n");
  if (rows.count > 0 && !once) print_orders(results, width);
  if (cli_study_results_recommend(results)) {
    print_recommendation(results);
  } else if (rows.count > 0 && !arguments->quiet && !cli_arguments_text(arguments, "want")) {
    printf("\nwhich one to take: %s the error that you can live with, such as --want 1mm\n",
           once ? "'hooke study' with" : "add");
  }
  if (!once) cli_study_statistics_print(results, width);
}
