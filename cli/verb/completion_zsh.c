#include "completion.h"

#include "describe.h"

#include <stdio.h>

/* The action of _arguments after a value: a list of words, files, or nothing. */
static void print_action(const struct cli_argument *argument) {
  char words[HOOKE_DOC_SIZE];
  int32_t many;
  const char *ending = cli_describe_file(argument);
  cli_describe_words(argument, words, &many);
  if (words[0] && many)
    printf("_values -s , word %s", words);
  else if (words[0])
    printf("(%s)", words);
  else if (ending && ending[0])
    printf("_files -g \"*.%s\"", ending);
  else if (ending)
    printf("_files");
}

static void print_option(const struct cli_argument *argument, const char *name, const char *sign) {
  struct cli_description is;
  cli_describe(argument, &is);
  printf("        '%s%s[", name, is.value[0] ? sign : "");
  cli_completion_escape(is.doc, "\\[]");
  printf("]");
  if (is.value[0]) {
    printf(":value:");
    print_action(argument);
  }
  printf("' \\\n");
}

static void print_verb(const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  printf("    '%s%s%s')\n      _arguments -s \\\n", verb->name, kind ? " " : "", kind ? kind : "");
  for (int32_t i = 0; i < arguments->count; i++) {
    struct cli_description is;
    char name[HOOKE_FLAG_SIZE + 2];
    cli_describe(&arguments->all[i], &is);
    snprintf(name, sizeof name, "--%s", is.flag);
    print_option(&arguments->all[i], name, "=");
    snprintf(name, sizeof name, "-%c", is.letter);
    if (is.letter) print_option(&arguments->all[i], name, "+");
  }
  if (!kind) printf("        '1:file:_files -g \"*.(%s)\"' \\\n", verb->input ? "h5" : "json|h5");
  printf("        && return\n      ;;\n");
}

static void print_list(const char *name, const char *summary) {
  printf("    '%s:", name);
  cli_completion_escape(summary, "\\:");
  printf("'\n");
}

static void print_kinds(const struct cli_verb *verb) {
  if (!verb->takes_kind) return;
  printf("  if [[ $words[2] == %s ]]; then\n    list=(\n", verb->name);
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++)
    print_list(hooke_part_kind(k, "name"), hooke_part_kind(k, "summary"));
  printf("    )\n    if ((CURRENT == 3)); then _describe kind list; return; fi\n"
         "    what=\"%s $words[3]\" skip=2\n  fi\n",
         verb->name);
}

int cli_completion_zsh(const struct cli_program *program) {
  printf("#compdef hooke\n# zsh completion of hooke, made by hooke --completion zsh\n\n"
         "_hooke() {\n  local what=$words[2] skip=1\n  local -a list\n  list=(\n");
  for (int32_t i = 0; program->verbs[i]; i++)
    print_list(program->verbs[i]->name, program->verbs[i]->summary);
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    char name[HOOKE_FLAG_SIZE];
    snprintf(name, sizeof name, "--%s", row->name);
    print_list(name, row->doc);
  }
  printf("  )\n  if ((CURRENT == 2)); then _describe verb list; return; fi\n");
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    if (row->words) printf("  if [[ $what == --%s ]]; then compadd %s; return; fi\n", row->name, row->words);
  }
  for (int32_t i = 0; program->verbs[i]; i++)
    print_kinds(program->verbs[i]);
  printf("  shift skip words\n  ((CURRENT -= skip))\n  case $what in\n");
  const int code = cli_completion_each(program, print_verb);
  printf(
      "  esac\n}\n\nif [[ $funcstack[1] == _hooke ]]; then _hooke \"$@\"; else compdef _hooke hooke; fi\n");
  return code;
}
