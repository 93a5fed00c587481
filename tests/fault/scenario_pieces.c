#include "scenarios.h"
#include "hash.h"
#include "small.h"

#include <dirent.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

const struct scenario *scenario_at(int32_t k) {
  static const struct scenario *const lists[] = {creating, loading, running, measuring, writing, resuming};
  for (size_t list = 0; list < sizeof lists / sizeof lists[0]; list++) {
    for (const struct scenario *scenario = lists[list]; scenario->name; scenario++) {
      if (scenario_is_built(scenario) && k-- == 0) return scenario;
    }
  }
  return NULL;
}

struct attempt scenario_attempt(const char *folder) {
  return (struct attempt){.folder = folder, .out = folder, .hash = HASH_START};
}

int open_folder(char folder[128]) {
  snprintf(folder, 128, "%s/hooke-fault-XXXXXX", P_tmpdir);
  if (mkdtemp(folder) == NULL) return -1;
  prepare_scenes(folder);
  return 0;
}

int close_folder(const char *folder) {
  char path[512];
  DIR *all = opendir(folder);
  if (all == NULL) return -1;
  for (struct dirent *entry; (entry = readdir(all)) != NULL;) {
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    snprintf(path, sizeof path, "%.250s/%s", folder, entry->d_name);
    unlink(path);
  }
  closedir(all);
  return rmdir(folder);
}

void release(struct made *made) {
  hooke_measurement_destroy(made->second);
  hooke_measurement_destroy(made->measurement);
  hooke_state_destroy(made->other);
  hooke_state_destroy(made->state);
  hooke_integrator_destroy(made->integrator);
  hooke_options_destroy(made->options);
  hooke_options_destroy(made->run);
  hooke_system_destroy(made->system);
}

hooke_system *make_rope(struct attempt *a, double segments) {
  hooke_system *system = NULL;
  hooke_options *options = make_options(a, "rope",
                                        "from=0,0,0 to=1,0.1,0 segments=%.17g mass=0.5 stretch.stiffness=30 "
                                        "stretch.damping=0.01 pinned=start",
                                        segments);
  if (options == NULL) return NULL;
  TRY(a, hooke_system_create(&system));
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

hooke_system *make_oscillator(struct attempt *a) {
  const double position[] = {0, 0, 0, 1.1, 0, 0}, mass = 1.0;
  const int64_t ends[] = {0, 1}, first = 0;
  hooke_system *system = NULL;
  hooke_options *springs = make_options(a, "springs", "stiffness=100 damping=0.5 rest_length=1");
  if (springs == NULL) return NULL;
  TRY(a, hooke_system_create(&system));
  TRY(a, hooke_system_add_particles(system, 2, position, NULL, 1, &mass, NULL));
  TRY(a, hooke_system_pin(system, 1, &first));
  TRY(a, hooke_system_add_springs(system, "spring", 1, ends, springs));
  TRY(a, hooke_system_commit(system));
  hooke_options_destroy(springs);
  return system;
end:
  hooke_options_destroy(springs);
  hooke_system_destroy(system);
  return NULL;
}

hooke_options *make_options(struct attempt *a, const char *name, const char *words, ...) {
  char text[256];
  va_list values;
  hooke_options *options = NULL;
  va_start(values, words);
  vsnprintf(text, sizeof text, words, values);
  va_end(values);
  if (a->gave_up) return NULL;
  TRY(a, hooke_options_create(name, &options));
  TRY(a, try_words(options, text));
  return options;
end:
  hooke_options_destroy(options);
  return NULL;
}

hooke_measurement *make_measurement(struct attempt *a, const char *kind, const hooke_system *system,
                                    const hooke_options *run, const char *words) {
  hooke_options *options = make_options(a, kind, "%s", words);
  hooke_measurement *measurement = NULL;
  if (options == NULL) return NULL;
  TRY(a, hooke_measurement_create(kind, system, run, options, &measurement));
end:
  hooke_options_destroy(options);
  return measurement;
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
  static _Thread_local double numbers[3 * 2000];
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
