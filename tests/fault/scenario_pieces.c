#include "scenarios.h"

#include <stdio.h>
#include <string.h>

int32_t scenario_is_built(const struct scenario *scenario) {
  char word[16];
  int length = 0;
  for (const char *at = scenario->needs; at && *at; at += length) {
    at += strspn(at, " ");
    length = (int)strcspn(at, " ");
    snprintf(word, sizeof word, "%.*s", length, at);
    if (hooke_build_fact(word)[0] == '\0') return 0;
  }
  return 1;
}

hooke_system *make_rope(struct attempt *a, double segments) {
  hooke_system *system = NULL;
  hooke_options *options = NULL;
  TRY(a, hooke_system_create(&system));
  TRY(a, hooke_part_options_create("rope", &options));
  TRY(a, hooke_options_set_numbers(options, "from", 3, (double[]){0, 0, 0}));
  TRY(a, hooke_options_set_numbers(options, "to", 3, (double[]){1, 0.1, 0}));
  TRY(a, hooke_options_set_number(options, "segments", segments));
  TRY(a, hooke_options_set_number(options, "mass", 0.5));
  TRY(a, hooke_options_set_number(options, "stretch.stiffness", 30));
  TRY(a, hooke_options_set_number(options, "stretch.damping", 0.01));
  TRY(a, hooke_options_set_text(options, "pinned", "start"));
  TRY(a, hooke_system_add_part(system, "rope", "line", options, NULL, NULL));
  TRY(a, hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  TRY(a, hooke_system_commit(system));
  hooke_options_destroy(options);
  return system;
end:
  hooke_options_destroy(options);
  hooke_system_destroy(system);
  return NULL;
}

hooke_options *make_run(struct attempt *a, const char *method, double step, double duration, double every) {
  hooke_options *options = NULL;
  TRY(a, hooke_run_options_create(&options));
  if (method) TRY(a, hooke_options_set_text(options, "method", method));
  if (step > 0.0) TRY(a, hooke_options_set_number(options, "step", step));
  TRY(a, hooke_options_set_number(options, "duration", duration));
  if (every > 0.0) TRY(a, hooke_options_set_number(options, "every", every));
  return options;
end:
  hooke_options_destroy(options);
  return NULL;
}

void take_state(struct attempt *a, const hooke_state *state) {
  attempt_number(a, hooke_state_time(state));
  attempt_numbers(a, hooke_state_size(state), hooke_state_position(state));
  if (hooke_state_velocity(state)) attempt_numbers(a, hooke_state_size(state), hooke_state_velocity(state));
}
