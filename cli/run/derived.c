#include "derived.h"

#include <inttypes.h>
#include <stdio.h>

static const char *text_of(const hooke_system *system, int64_t number, const char *what) {
  return hooke_system_derived_text(system, number, what);
}

/* Forces, what their members are called, and the key of the list of their groups. */
static const struct {
  const char *force, *members, *groups;
} kinds[] = {{"springs", "springs", "groups"},
             {"bending", "triples", "bending_groups"},
             {"altitude", "tetrahedra", "altitude_groups"}};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

void cli_derived_json(struct cli_json *json, const hooke_system *system) {
  for (int k = 0; k < KIND_COUNT; k++) {
    cli_json_count(json, kinds[k].members, hooke_system_count(system, kinds[k].force));
    cli_json_open(json, kinds[k].groups, '[');
    for (int64_t i = 0; i < hooke_system_group_count(system, kinds[k].force); i++) {
      cli_json_open(json, NULL, '{');
      cli_json_text(json, "name", hooke_system_group_name(system, kinds[k].force, i));
      cli_json_count(json, kinds[k].members, hooke_system_group_size(system, kinds[k].force, i));
      cli_json_close(json);
    }
    cli_json_close(json);
  }
  cli_json_open(json, "derived", '[');
  for (int64_t i = 0; i < hooke_system_count(system, "derived"); i++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "part", text_of(system, i, "part"));
    cli_json_text(json, "family", text_of(system, i, "family"));
    cli_json_text(json, "name", text_of(system, i, "name"));
    cli_json_number(json, "value", hooke_system_derived_value(system, i));
    cli_json_text(json, "unit", text_of(system, i, "unit"));
    cli_json_close(json);
  }
  cli_json_close(json);
}

void cli_derived_words(const hooke_system *system) {
  for (int k = 1; k < KIND_COUNT; k++) {
    const char *force = kinds[k].force;
    if (hooke_system_group_count(system, force) > 0)
      printf("%-12s %" PRId64 "\n", kinds[k].members, hooke_system_count(system, force));
    for (int64_t i = 0; i < hooke_system_group_count(system, force); i++) {
      const char *name = hooke_system_group_name(system, force, i);
      cli_say("  %10" PRId64 " %s\n", hooke_system_group_size(system, force, i),
              name[0] ? name : "(no name)");
    }
  }
  if (hooke_system_count(system, "derived") == 0) return;
  printf("derived from the options of parts:\n");
  for (int64_t i = 0; i < hooke_system_count(system, "derived"); i++) {
    const char *family = text_of(system, i, "family"), *unit = text_of(system, i, "unit");
    cli_say("  %s%s%s: %s %.6g%s%s\n", text_of(system, i, "part"), family ? "." : "", family ? family : "",
            text_of(system, i, "name"), hooke_system_derived_value(system, i), unit[0] ? " " : "", unit);
  }
}
