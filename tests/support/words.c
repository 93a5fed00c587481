#include "words.h"

#include "check.h"
#include "small.h"

#include <stdio.h>
#include <string.h>

int32_t try_words(hooke_options *options, const char *words) {
  char name[64], value[128];
  int length;
  int32_t status = HOOKE_OK;
  for (; status == HOOKE_OK && sscanf(words, " %63[^=]=%127s%n", name, value, &length) == 2; words += length)
    status = hooke_options_set_text(options, name, value);
  return status == HOOKE_OK && words[strspn(words, " ")] != '\0' ? HOOKE_BAD_VALUE : status;
}

static hooke_options *formatted(const char *name, const char *words, va_list values) {
  char text[1024];
  check_between(vsnprintf(text, sizeof text, words, values), 0.0, sizeof text - 1.0);
  return options_with(name, "%s", text);
}

hooke_system *small_part(hooke_system *system, const char *kind, const char *name, const char *words, ...) {
  va_list values;
  va_start(values, words);
  owned_options *options = formatted(kind, words, values);
  va_end(values);
  if (system == NULL) check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_part(system, kind, name, options, NULL, NULL));
  return system;
}

void small_group(hooke_system *system, const char *kind, const char *name, int64_t count,
                 const int64_t *members, const char *words, ...) {
  va_list values;
  va_start(values, words);
  owned_options *options = formatted(kind, words, values);
  va_end(values);
  check_ok((strcmp(kind, "anchors") == 0 ? hooke_system_add_anchors
            : strcmp(kind, "altitude") == 0
                ? hooke_system_add_altitude
                : hooke_system_add_springs)(system, name, count, members, options));
}

hooke_system *small_falling(hooke_system *system) {
  const double down[] = {0, -9.81, 0};
  check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  return system;
}
