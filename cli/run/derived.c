#include "derived.h"

#include <inttypes.h>
#include <stdio.h>

static const char *text_of(const hooke_system *system, int64_t number, const char *what) {
  return hooke_system_derived_text(system, number, what);
}

void cli_derived_json(struct cli_json *json, const hooke_system *system) {
  cli_json_count(json, "triples", hooke_system_count(system, "bending"));
  cli_json_open(json, "bending_groups", '[');
  for (int64_t i = 0; i < hooke_system_group_count(system, "bending"); i++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "name", hooke_system_group_name(system, "bending", i));
    cli_json_count(json, "triples", hooke_system_group_size(system, "bending", i));
    cli_json_close(json);
  }
  cli_json_close(json);
  cli_json_count(json, "tetrahedra", hooke_system_count(system, "altitude"));
  cli_json_open(json, "altitude_groups", '[');
  for (int64_t i = 0; i < hooke_system_group_count(system, "altitude"); i++) {
    cli_json_open(json, NULL, '{');
    cli_json_text(json, "name", hooke_system_group_name(system, "altitude", i));
    cli_json_count(json, "tetrahedra", hooke_system_group_size(system, "altitude", i));
    cli_json_close(json);
  }
  cli_json_close(json);
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

static void print_derived(const hooke_system *system) {
  char number[HOOKE_NUMBER_SIZE];
  if (hooke_system_count(system, "derived") == 0) return;
  printf("derived from the options of parts:\n");
  for (int64_t i = 0; i < hooke_system_count(system, "derived"); i++) {
    const char *family = text_of(system, i, "family"), *unit = text_of(system, i, "unit");
    printf("  ");
    cli_print_text(stdout, text_of(system, i, "part"));
    printf("%s%s: ", family ? "." : "", family ? family : "");
    cli_print_text(stdout, text_of(system, i, "name"));
    printf(" %s%s%s\n", cli_format_rounded(hooke_system_derived_value(system, i), number), unit[0] ? " " : "",
           unit);
  }
}

static void print_group(int64_t size, const char *name) {
  printf("  %10" PRId64 " ", size);
  cli_print_text(stdout, name[0] ? name : "(no name)");
  printf("\n");
}

void cli_derived_words(const hooke_system *system) {
  if (hooke_system_group_count(system, "bending") > 0)
    printf("triples      %" PRId64 "\n", hooke_system_count(system, "bending"));
  for (int64_t i = 0; i < hooke_system_group_count(system, "bending"); i++)
    print_group(hooke_system_group_size(system, "bending", i), hooke_system_group_name(system, "bending", i));
  if (hooke_system_group_count(system, "altitude") > 0)
    printf("tetrahedra   %" PRId64 "\n", hooke_system_count(system, "altitude"));
  for (int64_t i = 0; i < hooke_system_group_count(system, "altitude"); i++)
    print_group(hooke_system_group_size(system, "altitude", i),
                hooke_system_group_name(system, "altitude", i));
  print_derived(system);
}
