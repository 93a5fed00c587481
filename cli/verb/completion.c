#include "completion.h"

#include <stdio.h>
#include <string.h>

static int print_one(const struct cli_verb *verb, const char *kind,
                     void (*print)(const struct cli_arguments *arguments, const char *kind)) {
  struct cli_arguments arguments = {.verb = verb};
  const int code = cli_arguments_collect(verb, kind, &arguments);
  if (code == HOOKE_EXIT_DONE) print(&arguments, kind);
  cli_arguments_destroy(&arguments);
  return code;
}

int cli_completion_each(const struct cli_program *program,
                        void (*print)(const struct cli_arguments *arguments, const char *kind)) {
  int code = HOOKE_EXIT_DONE;
  for (int32_t i = 0; program->verbs[i] && code == HOOKE_EXIT_DONE; i++) {
    const struct cli_verb *verb = program->verbs[i];
    if (!verb->takes_kind) code = print_one(verb, NULL, print);
    for (int64_t k = 0; code == HOOKE_EXIT_DONE && verb->takes_kind && hooke_part_kind(k, "name"); k++)
      code = print_one(verb, hooke_part_kind(k, "name"), print);
  }
  return code;
}

void cli_completion_escape(const char *text, const char *special) {
  for (; *text; text++) {
    if (strchr(special, *text)) putchar('\\');
    fputs(*text == '\'' ? "'\\'" : "", stdout); /* a quote ends the string, and begins it again */
    putchar(*text);
  }
}

int cli_completion_print(const struct cli_program *program, const char *shell) {
  static const struct {
    const char *shell;
    int (*print)(const struct cli_program *program);
  } rows[] = {{"bash", cli_completion_bash}, {"zsh", cli_completion_zsh}, {"fish", cli_completion_fish}};
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    if (strcmp(rows[k].shell, shell) == 0) return rows[k].print(program);
  }
  return HOOKE_EXIT_USAGE;
}
