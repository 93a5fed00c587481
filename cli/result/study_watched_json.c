/* Watched quantities and statistics as JSON. */
#include "study_watched.h"

#include <math.h>

static void print_quantity(struct hooke_json *json, const hooke_study *study, const char *quantity) {
  hooke_json_open(json, NULL, '{');
  hooke_json_text(json, "quantity", quantity);
  hooke_json_text(json, "unit", hooke_study_unit(study, quantity));
}

static void print_watched(struct hooke_json *json, const hooke_study *study, int64_t row, const char *what,
                          const char *key) {
  const int64_t count = (int64_t)hooke_study_figure(study, "watched");
  if (count == 0) return;
  hooke_json_open(json, "watched", '[');
  for (int64_t k = 0; k < count; k++) {
    const char *quantity = hooke_study_nth(study, "watched", k);
    print_quantity(json, study, quantity);
    hooke_json_number(json, key, hooke_study_of(study, row, what, quantity));
    hooke_json_close(json);
  }
  hooke_json_close(json);
}

void hooke_study_watched_print_reference(struct hooke_json *json, const hooke_study *study) {
  print_watched(json, study, -1, "agreement", "agreement");
}

void hooke_study_watched_print_row(struct hooke_json *json, const void *study, int64_t row) {
  print_watched(json, study, row, "watched", "error");
}

/* ---- statistics ---- */

static void print_source(struct hooke_json *json, const hooke_study *study, const char *method,
                         const char *quantity) {
  static const char *const numbers[] = {"step", "rtol", "members", "failed", "mean", "spread", "bias"};
  hooke_json_open(json, method, '{');
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    hooke_json_number(json, numbers[k], hooke_study_statistic(study, method, quantity, numbers[k]));
  hooke_json_close(json);
}

static void print_quantities(struct hooke_json *json, const struct hooke_study_results *results) {
  const hooke_study *study = results->study;
  hooke_json_open(json, "quantities", '[');
  for (int64_t k = 0; k < (int64_t)hooke_study_figure(study, "quantities"); k++) {
    const char *quantity = hooke_study_nth(study, "quantity", k);
    print_quantity(json, study, quantity);
    print_source(json, study, "reference", quantity);
    hooke_json_open(json, "methods", '{');
    for (int32_t m = 0; m < results->methods.count; m++) {
      /* a method without a row that finished was not run */
      if (!isnan(hooke_study_statistic(study, results->methods.name[m], quantity, "members")))
        print_source(json, study, results->methods.name[m], quantity);
    }
    hooke_json_close(json);
    hooke_json_close(json);
  }
  hooke_json_close(json);
}

void hooke_study_statistics_print_json(struct hooke_json *json, const struct hooke_study_results *results) {
  const hooke_study *study = results->study;
  if (!(hooke_study_figure(study, "members") > 0.0)) {
    hooke_json_text(json, "statistics", NULL);
    return;
  }
  hooke_json_open(json, "statistics", '{');
  hooke_json_number(json, "from", hooke_study_figure(study, "statistics_from"));
  hooke_json_number(json, "until", hooke_study_figure(study, "statistics_until"));
  hooke_json_number(json, "members", hooke_study_figure(study, "members"));
  hooke_json_number(json, "noise", hooke_study_figure(study, "noise"));
  hooke_json_number(json, "seed", hooke_study_figure(study, "seed"));
  print_quantities(json, results);
  hooke_json_close(json);
}
