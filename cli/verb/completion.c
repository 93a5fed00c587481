#include "describe.h"
#include "pages.h"

#include <string.h>

/* Each asks the program for what may stand at the cursor. bash parts --option=value at the sign. */
static const char *const shells[][2] = {
    {"bash",
     "# bash completion of hooke, made by hooke --completion bash\n"
     "_hooke() {\n"
     "  local current=${COMP_WORDS[COMP_CWORD]} kind endings file word words=\n"
     "  [[ $current == = ]] && current=\n"
     "  COMPREPLY=()\n"
     "  {\n"
     "    read -r kind endings\n"
     "    if [[ $kind == files ]]; then # and folders\n"
     "      while IFS= read -r file; do\n"
     "        [[ -d $file || ! $endings || \" $endings \" == *\" ${file##*.} \"* ]] && COMPREPLY+=(\"$file\")\n"
     "      done < <(compgen -f -- \"$current\")\n"
     "      compopt -o filenames 2>/dev/null\n"
     "    else\n"
     "      while IFS=$'\\t' read -r word file; do words+=\"$word \"; done\n"
     "      COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
     "      [[ $kind == list ]] && compopt -o nospace 2>/dev/null\n"
     "    fi\n"
     "  } < <(\"${1/#\\~/$HOME}\" --complete \"${COMP_WORDS[@]:1:COMP_CWORD}\" 2>/dev/null)\n"
     "}\n"
     "complete -F _hooke hooke\n"},
    {"zsh",
     "#compdef hooke\n"
     "# zsh completion of hooke, made by hooke --completion zsh\n"
     "_hooke() {\n"
     "  local -a lines=(\"${(@f)$(${~words[1]} --complete \"${(@)words[2,CURRENT]}\" 2>/dev/null)}\")\n"
     "  local -a kind=(${=lines[1]}) list=(\"${(@)${(@)lines[2,-1]//:/\\\\:}/$'\\t'/:}\")\n"
     "  case $kind[1] in\n"
     "    files) compset -P '--*='; _files ${kind[2]:+-g \"*.(${(j:|:)kind[2,-1]})\"} ;;\n"
     "    list) _describe word list -S '' ;;\n"
     "    words) _describe word list ;;\n"
     "  esac\n"
     "}\n"
     "if [[ $funcstack[1] == _hooke ]]; then _hooke \"$@\"; else compdef _hooke hooke; fi\n"},
    {"fish", "# fish completion of hooke, made by hooke --completion fish\n"
             "function __hooke\n"
             "  set -l words (commandline -opc) (commandline -ct)\n"
             "  set -l lines ($words[1] --complete $words[2..] 2>/dev/null)\n"
             "  set -l kind (string split ' ' -- $lines[1])\n"
             "  if test \"$kind[1]\" != files\n"
             "    printf '%s\\n' $lines[2..]\n"
             "  else if set -q kind[2]\n"
             "    __fish_complete_suffix .$kind[2]\n"
             "  else\n"
             "    __fish_complete_path $words[-1]\n"
             "  end\n"
             "end\n"
             "complete -c hooke -f -k -a '(__hooke)'\n"},
};

int cli_completion_print(const struct cli_program *program, const char *shell) {
  (void)program;
  for (size_t k = 0; k < sizeof shells / sizeof shells[0]; k++) {
    if (strcmp(shells[k][0], shell) != 0) continue;
    fputs(shells[k][1], stdout);
    return HOOKE_EXIT_DONE;
  }
  return HOOKE_EXIT_USAGE;
}

/* ---- what may stand at the cursor ---- */

/* Words between blanks, each after the first `length` bytes of `before`. */
static void put_words(const char *words, const char *before, int length) {
  for (int size; *(words += strspn(words, " ")); words += size) {
    size = (int)strcspn(words, " ");
    printf("%.*s%.*s\t\n", length, before, size, words);
  }
}

static void put_first(const struct cli_program *program) {
  for (const struct cli_verb *const *verb = program->verbs; *verb; verb++)
    printf("%s\t%s\n", (*verb)->name, (*verb)->summary);
  for (const struct cli_program_row *row = program->rows; row->is.name; row++)
    printf("--%s\t%s\n", row->is.name, row->is.doc);
}

/* Returns 1 if there is the kind `word`; lists all of them for NULL. */
static int look_at_kinds(const char *word) {
  int is_one = 0;
  const char *kind;
  for (int64_t i = 0; (kind = hooke_part_kind(i, "name")) != NULL; i++) {
    is_one |= word && strcmp(word, kind) == 0;
    if (!word) printf("%s\t%s\n", kind, hooke_part_kind(i, "summary"));
  }
  return is_one;
}

static void put_options(const struct cli_arguments *arguments) {
  struct cli_description option;
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_verb_row *row = cli_describe(&arguments->all[i], &option);
    if (row->letter) printf("-%c\t%s\n", row->letter, row->doc);
    printf("--%s\t%s\n", row->name, row->doc);
  }
}

static const struct cli_argument *find_option(const struct cli_arguments *arguments, const char *word) {
  const size_t length = strcspn(word, "=");
  for (int32_t i = 0; word[0] == '-' && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    char flag[HOOKE_FLAG_SIZE + 2];
    snprintf(flag, sizeof flag, "--%s", argument->flag);
    if (strlen(flag) == length && strncmp(flag, word, length) == 0) return argument;
    if (length == 2 && argument->own && argument->own->letter == word[1]) return argument;
  }
  return NULL;
}

/* The last words are "--option value", "--option=value", or the same parted at the sign, which may be the
 * last; a flag has a value after the sign alone. Returns 0 if they are something else. */
static int put_values(const struct cli_arguments *arguments, char **words, int count) {
  const char *last = words[count - 1], *option = words[count - 2], *value = last;
  const char *sign = strncmp(last, "--", 2) == 0 ? strchr(last, '=') : NULL;
  if (sign)
    option = last, value = sign + 1;
  else if (strcmp(last, "=") == 0)
    sign = last = value = "";
  else if (strcmp(option, "=") == 0 && count > 2)
    sign = option = words[count - 3];
  const struct cli_argument *argument = find_option(arguments, option);
  const int is_switch = argument && (argument->own ? !argument->own->value : cli_argument_is_flag(argument));
  if (!argument || (is_switch && !sign)) return 0;
  char text[HOOKE_DOC_SIZE];
  int32_t many;
  const char *ending = cli_describe_file(argument), *comma = strrchr(value, ',');
  cli_describe_words(argument, text, &many);
  printf("%s%s\n", ending ? "files " : many ? "list" : "words", ending ? ending : "");
  put_words(text, last, (int)((many && comma ? comma + 1 : value) - last));
  return 1;
}

int cli_complete(const struct cli_program *program, const struct cli_verb *verb, int count, char **words) {
  if (count < 2) {
    printf("words\n");
    put_first(program);
    return HOOKE_EXIT_DONE;
  }
  for (const struct cli_program_row *row = program->rows; count == 2 && row->is.name; row++) {
    if (!row->words || strncmp(words[0], "--", 2) != 0 || strcmp(words[0] + 2, row->is.name) != 0) continue;
    printf("words\n");
    put_words(row->words, "", 0);
  }
  if (!verb) return HOOKE_EXIT_DONE;
  if (verb->takes_kind && count == 2) {
    printf("words\n--help\t\n");
    look_at_kinds(NULL);
  }
  const char *kind = verb->takes_kind ? words[1] : NULL;
  if (kind && (count == 2 || !look_at_kinds(kind))) return HOOKE_EXIT_DONE;
  struct cli_arguments arguments = {.verb = verb};
  const int code = cli_arguments_collect(verb, kind, &arguments);
  if (code == HOOKE_EXIT_DONE && !put_values(&arguments, words, count)) {
    const int is_file = words[count - 1][0] != '-' && !kind;
    printf(is_file ? "files %sh5\n" : "%swords\n", is_file && !verb->input ? "json " : "");
    if (!is_file) put_options(&arguments);
  }
  cli_arguments_destroy(&arguments);
  return code;
}
