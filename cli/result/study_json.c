/* The results of a study as JSON. */
#include "study_results.h"
#include "study_watched.h"

#include <math.h>
#include <stdio.h>

static void print_reference(struct cli_json *json, const hooke_study *study) {
  static const char *const parts[] = {"method", "check"};
  static const char *const numbers[] = {"growth", "growth_probability", "growth_seen", "displacements",
                                        "energy_agreement"};
  cli_json_open(json, "reference", '{');
  cli_json_open(json, "methods", '[');
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    const char *name = hooke_study_reference(study, parts[i]);
    if (name && name[0]) cli_json_text(json, NULL, name);
  }
  cli_json_close(json);
  cli_json_number(json, "agreement", hooke_study_figure(study, "agreement"));
  cli_json_number(json, "trusted_until", hooke_study_figure(study, "trusted_until"));
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    cli_json_number(json, numbers[i], hooke_study_figure(study, numbers[i]));
  cli_json_text(json, "ended", hooke_study_reference(study, "ended"));
  cli_study_watched_print_reference(json, study);
  cli_json_close(json);
}

static void print_orders(struct cli_json *json, const struct cli_study_results *results) {
  static const char *const numbers[] = {"order", "low", "high", "theory"};
  cli_json_open(json, "orders", '{');
  for (int32_t i = 0; i < results->methods.count; i++) {
    const char *method = results->methods.name[i];
    if (hooke_method_is_adaptive(method) != 0) continue;
    cli_json_open(json, method, '{');
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
      cli_json_number(json, numbers[k], hooke_study_order(results->study, method, numbers[k]));
    cli_json_text(json, "note", hooke_study_order_note(results->study, method));
    cli_json_close(json);
  }
  cli_json_close(json);
}

static void print_margin(struct cli_json *json, const hooke_study *study) {
  static const char *const numbers[] = {"error_low", "error_high", "limit_share", "error_stiffness",
                                        "error_start"};
  static const char *const flags[] = {"holds_stiffness", "holds_start"};
  cli_json_open(json, "margin", '{');
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    cli_json_number(json, numbers[i], hooke_study_recommendation_number(study, numbers[i]));
  for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
    const double flag = hooke_study_recommendation_number(study, flags[i]);
    if (isnan(flag))
      cli_json_text(json, flags[i], NULL);
    else
      cli_json_flag(json, flags[i], flag == 1.0);
  }
  cli_json_close(json);
}

static void print_recommendation(struct cli_json *json, const struct cli_study_results *results) {
  static const char *const numbers[] = {"step", "rtol", "error", "wall_seconds"};
  const hooke_study *study = results->study;
  if (!cli_study_results_recommend(results)) {
    cli_json_text(json, "recommendation", NULL);
    return;
  }
  const int32_t met = hooke_study_recommendation_number(study, "met") == 1.0;
  cli_json_open(json, "recommendation", '{');
  cli_json_number(json, "want", hooke_study_recommendation_number(study, "want"));
  cli_json_text(json, "method", hooke_study_recommendation_text(study, "method"));
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    cli_json_number(json, numbers[i], hooke_study_recommendation_number(study, numbers[i]));
  cli_json_text(json, "command", met ? results->command : NULL);
  if (met && !cli_study_results_trust_all(study))
    cli_json_text(json, "met", NULL); /* beyond that time nobody can know */
  else
    cli_json_flag(json, "met", met);
  cli_json_text(json, "note", hooke_study_recommendation_text(study, "note"));
  cli_json_number(json, "atol", hooke_study_recommendation_number(study, "atol"));
  cli_json_number(json, "force_evaluations", hooke_study_recommendation_number(study, "force_evaluations"));
  print_margin(json, study);
  cli_json_close(json);
}

void cli_study_results_print_json(const struct cli_study_results *results) {
  const struct cli_rows rows = cli_study_results_rows(results);
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "scene", results->arguments->scene);
  cli_json_number(&json, "duration", hooke_options_number(results->setup.options, "duration"));
  print_reference(&json, results->study);
  cli_rows_print_json(&json, &rows);
  print_orders(&json, results);
  print_recommendation(&json, results);
  cli_study_statistics_print_json(&json, results);
  cli_json_flag(&json, "budget_spent", hooke_study_figure(results->study, "budget_spent") == 1.0);
  cli_json_end(&json);
}
