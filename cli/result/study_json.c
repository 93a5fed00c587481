/* The results of a study as JSON. */
#include "study_results.h"
#include "study_watched.h"
#include "table.h"

#include <stdio.h>
#include <string.h>

static void print_reference(struct cli_json *json, const hooke_measurement *study) {
  static const char *const parts[] = {"method", "check"};
  cli_json_open(json, "reference", '{');
  cli_json_open(json, "methods", '[');
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    const char *name = hooke_measurement_text(study, "reference", 0, parts[i]);
    if (name) cli_json_text(json, NULL, name);
  }
  cli_json_close(json);
  cli_table_print_row(json, study, "reference", 0);
  if (hooke_measurement_row_count(study, "watched") > 0) cli_table_print(json, "watched", study, "watched");
  cli_json_close(json);
}

/* Errors of a row in the watched quantities. */
static void print_watched(struct cli_json *json, const hooke_measurement *study, int64_t row) {
  const int64_t count = hooke_measurement_row_count(study, "watched");
  if (count <= 0) return;
  cli_json_open(json, "watched", '[');
  for (int64_t k = 0; k < count; k++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "unit", hooke_measurement_text(study, "watched", k, "unit"));
    cli_table_print_row(json, study, "watched_errors", row * count + k);
    cli_json_close(json);
  }
  cli_json_close(json);
}

static void print_rows(struct cli_json *json, const hooke_measurement *study) {
  cli_json_open(json, "rows", '[');
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "rows"); row++) {
    cli_json_open(json, NULL, '{');
    cli_table_print_row(json, study, "rows", row);
    print_watched(json, study, row);
    cli_json_close(json);
  }
  cli_json_close(json);
}

static void print_orders(struct cli_json *json, const hooke_measurement *study) {
  cli_json_open(json, "orders", '{');
  for (int64_t row = 0; row < hooke_measurement_row_count(study, "orders"); row++) {
    const char *method = hooke_measurement_text(study, "orders", row, "method");
    if (hooke_method_is_adaptive(method) != 0) continue;
    cli_json_open(json, method, '{');
    cli_table_print_row_but(json, study, "orders", row, "method");
    cli_json_close(json);
  }
  cli_json_close(json);
}

/* "met" is null if the reference is not trusted to the end: beyond that time errors are unknown. */
static void print_recommendation(struct cli_json *json, const struct cli_study_results *results) {
  const hooke_measurement *study = results->study;
  if (!results->recommends) {
    cli_json_text(json, "recommendation", NULL);
    return;
  }
  const int32_t met = hooke_measurement_number(study, "recommendation", 0, "met") == 1.0;
  const int32_t any = hooke_measurement_number(study, "reference", 0, "trusted_until") > 0.0;
  const int32_t unknown = (met || !any) && !results->trusts_all;
  cli_json_open(json, "recommendation", '{');
  cli_table_print_row_but(json, study, "recommendation", 0, unknown ? "met" : NULL);
  if (unknown) cli_json_text(json, "met", NULL);
  cli_json_text(json, "command", met ? results->command : NULL);
  cli_table_print(json, "margin", study, "margin");
  cli_json_close(json);
}

/* ---- statistics ---- */

static void print_source(struct cli_json *json, const hooke_measurement *study, int64_t row) {
  cli_json_open(json, hooke_measurement_text(study, "statistics", row, "method"), '{');
  cli_table_print_row(json, study, "statistics", row);
  cli_json_close(json);
}

/* One of `count` quantities. */
static void print_quantity(struct cli_json *json, const hooke_measurement *study, int64_t quantity,
                           int64_t count) {
  cli_json_open(json, NULL, '{');
  cli_json_text(json, "quantity", hooke_measurement_text(study, "statistics", quantity, "quantity"));
  cli_json_text(json, "unit", hooke_measurement_text(study, "statistics", quantity, "unit"));
  print_source(json, study, quantity);
  cli_json_open(json, "methods", '{');
  for (int64_t row = quantity + count; row < hooke_measurement_row_count(study, "statistics"); row += count)
    print_source(json, study, row);
  cli_json_close(json);
  cli_json_close(json);
}

static void print_statistics(struct cli_json *json, const hooke_measurement *study) {
  if (hooke_measurement_row_count(study, "ensemble") < 1) {
    cli_json_text(json, "statistics", NULL);
    return;
  }
  cli_json_open(json, "statistics", '{');
  cli_table_print_row(json, study, "ensemble", 0);
  cli_json_open(json, "quantities", '[');
  const int64_t count = cli_study_quantity_count(study);
  for (int64_t k = 0; k < count; k++)
    print_quantity(json, study, k, count);
  cli_json_close(json);
  cli_json_close(json);
}

void cli_study_results_print_json(const struct cli_study_results *results) {
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "scene", results->arguments->scene);
  cli_json_number(&json, "duration", hooke_measurement_number(results->study, "study", 0, "duration"));
  print_reference(&json, results->study);
  print_rows(&json, results->study);
  print_orders(&json, results->study);
  print_recommendation(&json, results);
  print_statistics(&json, results->study);
  cli_table_print_row_but(&json, results->study, "study", 0, "duration");
  cli_json_end(&json);
}
