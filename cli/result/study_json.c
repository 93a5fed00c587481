/* The results of a study as JSON. */
#include "study_results.h"
#include "study_watched.h"

#include <math.h>
#include <stdio.h>

static void print_reference(struct hooke_json *json, const hooke_study *study) {
  static const char *const parts[] = {"method", "check"};
  static const char *const numbers[] = {"growth", "growth_probability", "growth_seen", "displacements",
                                        "energy_agreement"};
  hooke_json_open(json, "reference", '{');
  hooke_json_open(json, "methods", '[');
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    const char *name = hooke_study_reference(study, parts[i]);
    if (name && name[0]) hooke_json_text(json, NULL, name);
  }
  hooke_json_close(json);
  hooke_json_number(json, "agreement", hooke_study_figure(study, "agreement"));
  hooke_json_number(json, "trusted_until", hooke_study_figure(study, "trusted_until"));
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    hooke_json_number(json, numbers[i], hooke_study_figure(study, numbers[i]));
  hooke_json_text(json, "ended", hooke_study_reference(study, "ended"));
  hooke_study_watched_print_reference(json, study);
  hooke_json_close(json);
}

static void print_orders(struct hooke_json *json, const struct hooke_study_results *results) {
  static const char *const numbers[] = {"order", "low", "high", "theory"};
  hooke_json_open(json, "orders", '{');
  for (int32_t i = 0; i < results->methods.count; i++) {
    const char *method = results->methods.name[i];
    if (hooke_method_is_adaptive(method) != 0) continue;
    hooke_json_open(json, method, '{');
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
      hooke_json_number(json, numbers[k], hooke_study_order(results->study, method, numbers[k]));
    hooke_json_text(json, "note", hooke_study_order_note(results->study, method));
    hooke_json_close(json);
  }
  hooke_json_close(json);
}

static void print_margin(struct hooke_json *json, const hooke_study *study) {
  static const char *const numbers[] = {"error_low", "error_high", "limit_share", "error_stiffness",
                                        "error_start"};
  static const char *const flags[] = {"holds_stiffness", "holds_start"};
  hooke_json_open(json, "margin", '{');
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    hooke_json_number(json, numbers[i], hooke_study_recommendation_number(study, numbers[i]));
  for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
    const double flag = hooke_study_recommendation_number(study, flags[i]);
    if (isnan(flag))
      hooke_json_text(json, flags[i], NULL);
    else
      hooke_json_flag(json, flags[i], flag == 1.0);
  }
  hooke_json_close(json);
}

static void print_recommendation(struct hooke_json *json, const struct hooke_study_results *results) {
  static const char *const numbers[] = {"step", "rtol", "error", "wall_seconds"};
  const hooke_study *study = results->study;
  if (!hooke_study_results_recommend(results)) {
    hooke_json_text(json, "recommendation", NULL);
    return;
  }
  const int32_t met = hooke_study_recommendation_number(study, "met") == 1.0;
  hooke_json_open(json, "recommendation", '{');
  hooke_json_number(json, "want", hooke_study_recommendation_number(study, "want"));
  hooke_json_text(json, "method", hooke_study_recommendation_text(study, "method"));
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    hooke_json_number(json, numbers[i], hooke_study_recommendation_number(study, numbers[i]));
  hooke_json_text(json, "command", met ? results->command : NULL);
  if (met && !hooke_study_results_trust_all(study))
    hooke_json_text(json, "met", NULL); /* beyond that time nobody can know */
  else
    hooke_json_flag(json, "met", met);
  hooke_json_text(json, "note", hooke_study_recommendation_text(study, "note"));
  hooke_json_number(json, "atol", hooke_study_recommendation_number(study, "atol"));
  hooke_json_number(json, "force_evaluations", hooke_study_recommendation_number(study, "force_evaluations"));
  print_margin(json, study);
  hooke_json_close(json);
}

void hooke_study_results_print_json(const struct hooke_study_results *results) {
  const struct hooke_rows rows = hooke_study_results_rows(results);
  struct hooke_json json;
  hooke_json_begin(&json, stdout);
  hooke_json_text(&json, "scene", results->arguments->scene);
  hooke_json_number(&json, "duration", hooke_options_number(results->setup.options, "duration"));
  print_reference(&json, results->study);
  hooke_rows_print_json(&json, &rows);
  print_orders(&json, results);
  print_recommendation(&json, results);
  hooke_study_statistics_print_json(&json, results);
  hooke_json_flag(&json, "budget_spent", hooke_study_figure(results->study, "budget_spent") == 1.0);
  hooke_json_end(&json);
}
