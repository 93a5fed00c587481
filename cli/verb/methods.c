#include "methods.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

/* The method that `word` begins with, up to `length`; NULL if there is none. */
static const char *find_method(const char *word, size_t length) {
  char given[HOOKE_FLAG_SIZE];
  snprintf(given, sizeof given, "%.*s", (int)(length < sizeof given ? length : sizeof given - 1), word);
  const char *meant = hooke_method_meant(given);
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    if (strcmp(hooke_method_name(i), meant) == 0) return hooke_method_name(i);
  }
  return NULL;
}

static int add_method(const struct cli_arguments *arguments, struct cli_methods *methods, const char *name) {
  if (!hooke_method_is_built(name)) {
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT,
                      "%s is not in this build of hooke; 'hooke --version' says what it was built with",
                      name);
  }
  for (int32_t i = 0; i < methods->count; i++) {
    if (methods->name[i] == name) {
      return cli_report(arguments, HOOKE_EXIT_USAGE, "--methods: %s is named twice", name);
    }
  }
  if (methods->count < HOOKE_MOST_METHODS) methods->name[methods->count++] = name;
  return HOOKE_EXIT_DONE;
}

int cli_methods_choose(const struct cli_arguments *arguments, struct cli_methods *methods) {
  const char *word = cli_arguments_text(arguments, "methods");
  methods->count = 0;
  if (!word) {
    for (int64_t i = 0; i < hooke_method_count() && methods->count < HOOKE_MOST_METHODS; i++) {
      const char *name = hooke_method_name(i);
      if (hooke_method_is_built(name)) methods->name[methods->count++] = name;
    }
    return HOOKE_EXIT_DONE;
  }
  for (;;) {
    size_t length = strcspn(word, ",");
    const char *name = find_method(word, length);
    int code = name ? add_method(arguments, methods, name)
                    : cli_report_unknown_method(arguments, "methods", word, length);
    if (code != HOOKE_EXIT_DONE || !word[length]) return code;
    word += length + 1;
  }
}
