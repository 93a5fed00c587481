/* Watched quantities and statistics as JSON. */
#include "study_watched.h"

#include <math.h>

static void print_quantity(struct cli_json *json, const hooke_study *study, const char *quantity) {
  cli_json_open(json, NULL, '{');
  cli_json_text(json, "quantity", quantity);
  cli_json_text(json, "unit", cli_study_unit(study, quantity));
}

static void print_watched(struct cli_json *json, const hooke_study *study, int64_t row, const char *what,
                          const char *key) {
  const int64_t count = (int64_t)hooke_study_figure(study, "watched");
  if (count == 0) return;
  cli_json_open(json, "watched", '[');
  for (int64_t k = 0; k < count; k++) {
    const char *quantity = cli_study_nth(study, "watched", k);
    print_quantity(json, study, quantity);
    cli_json_number(json, key, cli_study_of(study, row, what, quantity));
    cli_json_close(json);
  }
  cli_json_close(json);
}

void cli_study_watched_print_reference(struct cli_json *json, const hooke_study *study) {
  print_watched(json, study, -1, "agreement", "agreement");
}

void cli_study_watched_print_row(struct cli_json *json, const void *study, int64_t row) {
  print_watched(json, study, row, "watched", "error");
}

/* ---- statistics ---- */

static void print_source(struct cli_json *json, const hooke_study *study, const char *method,
                         const char *quantity) {
  static const char *const numbers[] = {"step", "rtol", "members", "failed", "mean", "spread", "bias"};
  cli_json_open(json, method, '{');
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    cli_json_number(json, numbers[k], hooke_study_statistic(study, method, quantity, numbers[k]));
  cli_json_close(json);
}

static void print_quantities(struct cli_json *json, const struct cli_study_results *results) {
  const hooke_study *study = results->study;
  cli_json_open(json, "quantities", '[');
  for (int64_t k = 0; k < (int64_t)hooke_study_figure(study, "quantities"); k++) {
    const char *quantity = cli_study_nth(study, "quantity", k);
    print_quantity(json, study, quantity);
    print_source(json, study, "reference", quantity);
    cli_json_open(json, "methods", '{');
    for (int32_t m = 0; m < results->methods.count; m++) {
      /* a method without a row that finished was not run */
      if (!isnan(hooke_study_statistic(study, results->methods.name[m], quantity, "members")))
        print_source(json, study, results->methods.name[m], quantity);
    }
    cli_json_close(json);
    cli_json_close(json);
  }
  cli_json_close(json);
}

void cli_study_statistics_print_json(struct cli_json *json, const struct cli_study_results *results) {
  const hooke_study *study = results->study;
  if (!(hooke_study_figure(study, "members") > 0.0)) {
    cli_json_text(json, "statistics", NULL);
    return;
  }
  cli_json_open(json, "statistics", '{');
  cli_json_number(json, "from", hooke_study_figure(study, "statistics_from"));
  cli_json_number(json, "until", hooke_study_figure(study, "statistics_until"));
  cli_json_number(json, "members", hooke_study_figure(study, "members"));
  cli_json_number(json, "noise", hooke_study_figure(study, "noise"));
  cli_json_number(json, "seed", hooke_study_figure(study, "seed"));
  print_quantities(json, results);
  cli_json_close(json);
}
