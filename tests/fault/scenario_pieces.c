#include "scenarios.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 512 };

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
  TRY(a, hooke_options_create("rope", &options));
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
  TRY(a, hooke_options_create("run", &options));
  if (method) TRY(a, hooke_options_set_text(options, "method", method));
  if (step > 0.0) TRY(a, hooke_options_set_number(options, "step", step));
  TRY(a, hooke_options_set_number(options, "duration", duration));
  if (every > 0.0) TRY(a, hooke_options_set_number(options, "every", every));
  return options;
end:
  hooke_options_destroy(options);
  return NULL;
}

hooke_measurement *make_study(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *methods) {
  hooke_options *options = NULL;
  hooke_measurement *study = NULL;
  if (run == NULL) return NULL;
  TRY(a, hooke_options_create("study", &options));
  TRY(a, hooke_options_set_text(options, "methods", methods));
  TRY(a, hooke_options_set_number(options, "points", 6));
  TRY(a, hooke_measurement_create("study", system, run, options, &study));
end:
  hooke_options_destroy(options);
  return study;
}

hooke_measurement *make_comparison(struct attempt *a, const hooke_system *system, const hooke_options *run,
                                   const char *methods) {
  hooke_options *options = NULL;
  hooke_measurement *comparison = NULL;
  if (run == NULL) return NULL;
  TRY(a, hooke_options_create("study", &options));
  TRY(a, hooke_options_set_text(options, "methods", methods));
  TRY(a, hooke_options_set_number(options, "once", 1));
  TRY(a, hooke_measurement_create("study", system, run, options, &comparison));
end:
  hooke_options_destroy(options);
  return comparison;
}

hooke_measurement *make_needs(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              int32_t refine) {
  hooke_options *options = NULL;
  hooke_measurement *needs = NULL;
  if (run == NULL) return NULL;
  TRY(a, hooke_options_create("needs", &options));
  TRY(a, hooke_options_set_number(options, "want", 1e-2));
  TRY(a, hooke_options_set_number(options, "refine", refine));
  TRY(a, hooke_measurement_create("needs", system, run, options, &needs));
end:
  hooke_options_destroy(options);
  return needs;
}

hooke_measurement *make_limit(struct attempt *a, const hooke_system *system, const hooke_options *run,
                              const char *flag) {
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  if (system == NULL) return NULL;
  TRY(a, hooke_options_create("limit", &options));
  if (flag) TRY(a, hooke_options_set_number(options, flag, 1));
  TRY(a, hooke_options_set_number(options, "accuracy", 0.1));
  TRY(a, hooke_options_set_text(options, "methods", "symplectic-euler,rk4"));
  TRY(a, hooke_measurement_create("limit", system, run, options, &limit));
end:
  hooke_options_destroy(options);
  return limit;
}

void take_state(struct attempt *a, const hooke_state *state) {
  attempt_number(a, hooke_state_time(state));
  attempt_numbers(a, hooke_state_size(state), hooke_state_position(state));
  if (hooke_state_velocity(state)) attempt_numbers(a, hooke_state_size(state), hooke_state_velocity(state));
}

/* ---- files ---- */

const char *path_of(const struct attempt *a, const char *name) {
  static _Thread_local char path[2][PATH_SIZE];
  static _Thread_local int turn;
  turn = !turn;
  snprintf(path[turn], PATH_SIZE, "%s/%s", strncmp(name, "out.", 4) == 0 ? a->out : a->folder, name);
  return path[turn];
}

void read_back(struct attempt *a, const char *path, const hooke_system *system, int64_t frames) {
  static double numbers[3 * 2000];
  hooke_record *record = NULL;
  hooke_state *state = NULL;
  int64_t rows, columns;
  TRY(a, hooke_record_open(path, &record));
  TRY(a, hooke_state_create(system, &state));
  if (hooke_record_count(record, "frames") != frames)
    attempt_wrong(a, "%lld frames were written, and %lld are there", (long long)frames,
                  (long long)hooke_record_count(record, "frames"));
  for (int64_t k = 0; k < frames; k++) {
    TRY(a, hooke_record_read(record, k, state));
    take_state(a, state);
  }
  TRY(a, hooke_record_size(record, "kinetic_energy", &rows, &columns));
  TRY(a, hooke_record_numbers(record, "kinetic_energy", numbers));
  attempt_numbers(a, frames, numbers);
  TRY(a, hooke_record_numbers(record, "mass", numbers));
  attempt_number(a, numbers[0]);
  attempt_text(a, hooke_record_text(record, "status"));
  attempt_text(a, hooke_record_text(record, "scene"));
  attempt_text(a, hooke_options_text(hooke_record_options(record), "method"));
end:
  hooke_state_destroy(state);
  hooke_record_close(record);
}
