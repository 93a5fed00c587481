#include "derived.h"

#include <inttypes.h>
#include <stdio.h>

static const char *text_of(const hooke_system *system, int64_t number, const char *what) {
  return hooke_system_derived_text(system, number, what);
}

void hooke_derived_json(struct hooke_json *json, const hooke_system *system) {
  hooke_json_count(json, "triples", hooke_system_bending_count(system));
  hooke_json_open(json, "bending_groups", '[');
  for (int64_t i = 0; i < hooke_system_bending_group_count(system); i++) {
    hooke_json_open(json, NULL, '{');
    hooke_json_text(json, "name", hooke_system_bending_group_name(system, i));
    hooke_json_count(json, "triples", hooke_system_bending_group_size(system, i));
    hooke_json_close(json);
  }
  hooke_json_close(json);
  hooke_json_count(json, "tetrahedra", hooke_system_altitude_count(system));
  hooke_json_open(json, "altitude_groups", '[');
  for (int64_t i = 0; i < hooke_system_altitude_group_count(system); i++) {
    hooke_json_open(json, NULL, '{');
    hooke_json_text(json, "name", hooke_system_altitude_group_name(system, i));
    hooke_json_count(json, "tetrahedra", hooke_system_altitude_group_size(system, i));
    hooke_json_close(json);
  }
  hooke_json_close(json);
  hooke_json_open(json, "derived", '[');
  for (int64_t i = 0; i < hooke_system_derived_count(system); i++) {
    hooke_json_open(json, NULL, '{');
    hooke_json_text(json, "part", text_of(system, i, "part"));
    hooke_json_text(json, "family", text_of(system, i, "family"));
    hooke_json_text(json, "name", text_of(system, i, "name"));
    hooke_json_number(json, "value", hooke_system_derived_value(system, i));
    hooke_json_text(json, "unit", text_of(system, i, "unit"));
    hooke_json_close(json);
  }
  hooke_json_close(json);
}

static void print_derived(const hooke_system *system) {
  char number[HOOKE_NUMBER_SIZE];
  if (hooke_system_derived_count(system) == 0) return;
  printf("derived from the options of parts:\n");
  for (int64_t i = 0; i < hooke_system_derived_count(system); i++) {
    const char *family = text_of(system, i, "family"), *unit = text_of(system, i, "unit");
    printf("  ");
    hooke_print_text(stdout, text_of(system, i, "part"));
    printf("%s%s: %s %s%s%s\n", family ? "." : "", family ? family : "", text_of(system, i, "name"),
           hooke_format_rounded(hooke_system_derived_value(system, i), number), unit[0] ? " " : "", unit);
  }
}

static void print_group(int64_t size, const char *name) {
  printf("  %10" PRId64 " ", size);
  hooke_print_text(stdout, name[0] ? name : "(no name)");
  printf("\n");
}

void hooke_derived_words(const hooke_system *system) {
  if (hooke_system_bending_group_count(system) > 0)
    printf("triples      %" PRId64 "\n", hooke_system_bending_count(system));
  for (int64_t i = 0; i < hooke_system_bending_group_count(system); i++)
    print_group(hooke_system_bending_group_size(system, i), hooke_system_bending_group_name(system, i));
  if (hooke_system_altitude_group_count(system) > 0)
    printf("tetrahedra   %" PRId64 "\n", hooke_system_altitude_count(system));
  for (int64_t i = 0; i < hooke_system_altitude_group_count(system); i++)
    print_group(hooke_system_altitude_group_size(system, i), hooke_system_altitude_group_name(system, i));
  print_derived(system);
}
