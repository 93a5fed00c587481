#include "completion.h"

#include "describe.h"

#include <stdio.h>
#include <string.h>

static const char head[] =
    "# bash completion of hooke, made by hooke --completion bash\n"
    "\n"
    "_hooke_words() { # the words that may stand here\n"
    "  COMPREPLY=($(compgen -W \"$1\" -- \"$current\"))\n"
    "}\n"
    "\n"
    "_hooke_list() { # the same, with commas between\n"
    "  local before=\n"
    "  [[ $current == *,* ]] && before=${current%,*},\n"
    "  COMPREPLY=($(compgen -P \"$before\" -W \"$1\" -- \"${current##*,}\"))\n"
    "  compopt -o nospace 2>/dev/null\n"
    "}\n"
    "\n"
    "_hooke_files() { # folders, and files with one of these endings; without any, all files\n"
    "  local file ending\n"
    "  while IFS= read -r file; do\n"
    "    if [[ -d $file || $# -eq 0 ]]; then\n"
    "      COMPREPLY+=(\"$file\")\n"
    "      continue\n"
    "    fi\n"
    "    for ending; do\n"
    "      [[ $file == *.\"$ending\" ]] && COMPREPLY+=(\"$file\")\n"
    "    done\n"
    "  done < <(compgen -f -- \"$current\")\n"
    "  compopt -o filenames 2>/dev/null\n"
    "}\n"
    "\n"
    "_hooke() {\n"
    "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
    "  local verb=${COMP_WORDS[1]-} what=${COMP_WORDS[1]-} sign= options= operand=\n"
    "  COMPREPLY=()\n"
    "  # bash parts --option=value at the sign\n"
    "  if [[ $current == = ]]; then\n"
    "    current= sign=1\n"
    "  elif [[ $previous == = ]]; then\n"
    "    previous=${COMP_WORDS[COMP_CWORD - 2]} sign=1\n"
    "  fi\n";

/* ---- one verb ---- */

static void print_flags(const struct cli_arguments *arguments) {
  printf("      options=\"");
  for (int32_t i = 0; i < arguments->count; i++) {
    struct cli_description is;
    cli_describe(&arguments->all[i], &is);
    if (is.letter) printf("-%c ", is.letter);
    printf("--%s%s", is.flag, i + 1 < arguments->count ? " " : "\"\n");
  }
}

static void print_pattern(const struct cli_description *is) {
  printf("--%s", is->flag);
  if (is->letter) printf(" | -%c", is->letter);
}

/* Completion after an option: a list of words, or a file. */
static void print_value(const struct cli_argument *argument) {
  struct cli_description is;
  char words[HOOKE_DOC_SIZE];
  const char *ending = cli_describe_file(argument);
  int32_t many;
  cli_describe(argument, &is);
  cli_describe_words(argument, words, &many);
  if (!words[0] && !ending) return;
  printf("        ");
  print_pattern(&is);
  if (!is.value[0]) { /* a flag takes its word only after the equals sign */
    printf(") if [[ $sign ]]; then _hooke_words \"%s\"; return; fi ;;\n", words);
  } else if (words[0]) {
    printf(") %s \"%s\"; return ;;\n", many ? "_hooke_list" : "_hooke_words", words);
  } else {
    printf(") _hooke_files%s%s; return ;;\n", ending[0] ? " " : "", ending);
  }
}

/* Other options with a value have no completion. */
static void print_unknown(const struct cli_arguments *arguments) {
  int32_t count = 0;
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    struct cli_description is;
    char words[HOOKE_DOC_SIZE];
    int32_t many;
    cli_describe(argument, &is);
    if (!is.value[0] || cli_describe_words(argument, words, &many)[0] || cli_describe_file(argument))
      continue;
    printf("%s", count++ ? " | " : "        ");
    print_pattern(&is);
  }
  if (count) printf(") return ;;\n");
}

static void print_verb(const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  printf("    \"%s%s%s\")\n", verb->name, kind ? " " : "", kind ? kind : "");
  if (!kind) printf("      operand=\"%s\"\n", verb->input ? "h5" : "json h5");
  print_flags(arguments);
  printf("      case $previous in\n");
  for (int32_t i = 0; i < arguments->count; i++)
    print_value(&arguments->all[i]);
  print_unknown(arguments);
  printf("      esac\n      ;;\n");
}

/* ---- the program ---- */

static void print_first_word(const struct cli_program *program) {
  printf("  if ((COMP_CWORD == 1)); then\n    _hooke_words \"");
  for (int32_t i = 0; program->verbs[i]; i++)
    printf("%s ", program->verbs[i]->name);
  for (const struct cli_program_row *row = program->rows; row->name; row++)
    printf("--%s%s", row->name, row[1].name ? " " : "\"\n    return\n  fi\n");
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    if (row->words)
      printf("  if [[ $verb == --%s ]]; then\n    _hooke_words \"%s\"\n    return\n  fi\n", row->name,
             row->words);
  }
}

/* The kind is the second word of a verb that takes one. */
static void print_kinds(const struct cli_verb *verb) {
  if (!verb->takes_kind) return;
  printf("  if [[ $verb == %s ]]; then\n    if ((COMP_CWORD == 2)); then\n      _hooke_words \"", verb->name);
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++)
    printf("%s ", hooke_part_kind(k, "name"));
  printf("--help\"\n      return\n    fi\n    what=\"%s ${COMP_WORDS[2]}\"\n  fi\n", verb->name);
}

int cli_completion_bash(const struct cli_program *program) {
  fputs(head, stdout);
  print_first_word(program);
  for (int32_t i = 0; program->verbs[i]; i++)
    print_kinds(program->verbs[i]);
  printf("  case $what in\n");
  const int code = cli_completion_each(program, print_verb);
  if (code != HOOKE_EXIT_DONE) return code;
  printf("  esac\n"
         "  if [[ $current == -* || ! $operand ]]; then\n"
         "    _hooke_words \"$options\"\n"
         "  else\n"
         "    _hooke_files $operand\n"
         "  fi\n"
         "}\n"
         "complete -F _hooke hooke\n");
  return HOOKE_EXIT_DONE;
}
