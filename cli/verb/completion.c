#include "form.h"

#include <stdio.h>
#include <string.h>

/* The pattern of an option in a case, and the condition of a verb and a kind. */
#define BASH_PATTERN "        --<name><letter: | -<letter>>) "
#define FISH_AFTER                                                                                           \
  "complete -c hooke -n '__fish_seen_subcommand_from <verb><kind:; and __fish_seen_subcommand_from <kind>>'"
#define FISH_DOC " -d '<doc/\\>'\n"
#define ZSH_ITEM "<name>:<doc/\\:>'\n"
#define ZSH_ACTION                                                                                           \
  "<list:_values -s , word <list>><choice:(<choice>)><ending:_files -g \"*.<ending>\"><file:_files>"
#define ZSH_DOC "[<doc/\\[]>]<value::value:" ZSH_ACTION ">' \\\n"

static const char bash[] =
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
    "  fi\n"
    "  if ((COMP_CWORD == 1)); then\n"
    "    _hooke_words \"<verbs:<verb> ><rows:<later: >--<name>>\"\n"
    "    return\n"
    "  fi\n"
    "<rows:<words:"
    "  if [[ $verb == --<name> ]]; then\n"
    "    _hooke_words \"<words>\"\n"
    "    return\n"
    "  fi\n"
    ">>"
    "<verbs:<takes_kind:" /* the kind is the second word */
    "  if [[ $verb == <verb> ]]; then\n"
    "    if ((COMP_CWORD == 2)); then\n"
    "      _hooke_words \"<kinds:<kind> >--help\"\n"
    "      return\n"
    "    fi\n"
    "    what=\"<verb> ${COMP_WORDS[2]}\"\n"
    "  fi\n"
    ">>"
    "  case $what in\n"
    "<verbs:<takers:"
    "    \"<verb><kind: <kind>>\")\n"
    "<!kind:      operand=\"<!input:json >h5\"\n>"
    "      options=\"<options:<later: ><letter:-<letter> >--<name>>\"\n"
    "      case $previous in\n"
    "<options:" /* a flag takes its word only after the equals sign */
    "<switch:" BASH_PATTERN "if [[ $sign ]]; then _hooke_words \"<switch>\"; return; fi ;;\n>"
    "<list:" BASH_PATTERN "_hooke_list \"<list>\"; return ;;\n>"
    "<choice:" BASH_PATTERN "_hooke_words \"<choice>\"; return ;;\n>"
    "<ending:" BASH_PATTERN "_hooke_files <ending>; return ;;\n>"
    "<file:" BASH_PATTERN "_hooke_files; return ;;\n>"
    "<open:" BASH_PATTERN "return ;;\n>"
    ">"
    "      esac\n"
    "      ;;\n"
    ">>"
    "  esac\n"
    "  if [[ $current == -* || ! $operand ]]; then\n"
    "    _hooke_words \"$options\"\n"
    "  else\n"
    "    _hooke_files $operand\n"
    "  fi\n"
    "}\n"
    "complete -F _hooke hooke\n";

/* fish knows no endings of files but by its function. */
static const char fish[] =
    "# fish completion of hooke, made by hooke --completion fish\n\n"
    "complete -c hooke -f\n"
    "<verbs:complete -c hooke -n __fish_use_subcommand -a <verb>" FISH_DOC
    "<kinds:complete -c hooke -n '__fish_seen_subcommand_from <verb>' -a <name>" FISH_DOC ">>"
    "<rows:complete -c hooke -n __fish_use_subcommand -l <name><letter: -s <letter>>"
    "<words: -x -a '<words>'>" FISH_DOC ">"
    "<verbs:<takers:"
    "<!kind:" FISH_AFTER " -k -x -a '(__fish_complete_suffix .<!input:json><input:h5>)'\n>"
    "<options:" FISH_AFTER " -l <name><letter: -s <letter>>"
    "<ending: -k -x -a '(__fish_complete_suffix .<ending>)'><file: -r -F><list: -x -a '<list>'>"
    "<choice: -x -a '<choice>'><open: -x>" FISH_DOC ">>>";

static const char zsh[] =
    "#compdef hooke\n"
    "# zsh completion of hooke, made by hooke --completion zsh\n\n"
    "_hooke() {\n"
    "  local what=$words[2] skip=1\n"
    "  local -a list\n"
    "  list=(\n"
    "<verbs:    '" ZSH_ITEM ">"
    "<rows:    '--" ZSH_ITEM ">"
    "  )\n"
    "  if ((CURRENT == 2)); then _describe verb list; return; fi\n"
    "<rows:<words:  if [[ $what == --<name> ]]; then compadd <words>; return; fi\n>>"
    "<verbs:<takes_kind:"
    "  if [[ $words[2] == <verb> ]]; then\n"
    "    list=(\n"
    "<kinds:    '" ZSH_ITEM ">"
    "    )\n"
    "    if ((CURRENT == 3)); then _describe kind list; return; fi\n"
    "    what=\"<verb> $words[3]\" skip=2\n"
    "  fi\n"
    ">>"
    "  shift skip words\n"
    "  ((CURRENT -= skip))\n"
    "  case $what in\n"
    "<verbs:<takers:"
    "    '<verb><kind: <kind>>')\n"
    "      _arguments -s \\\n"
    "<options:        '--<name><value:=>" ZSH_DOC "<letter:        '-<letter><value:+>" ZSH_DOC ">>"
    "<!kind:        '1:file:_files -g \"*.(<!input:json|>h5)\"' \\\n>"
    "        && return\n"
    "      ;;\n"
    ">>"
    "  esac\n"
    "}\n\n"
    "if [[ $funcstack[1] == _hooke ]]; then _hooke \"$@\"; else compdef _hooke hooke; fi\n";

int cli_completion_print(const struct cli_program *program, const char *shell) {
  static const char *const escapes[] = {"''\\''", NULL}; /* a quote ends the string, and begins it again */
  static const struct {
    const char *shell;
    struct cli_form form;
  } rows[] = {{"bash", {bash, escapes, 0}}, {"zsh", {zsh, escapes, 0}}, {"fish", {fish, escapes, 0}}};
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    if (strcmp(rows[k].shell, shell) == 0) return cli_form_print(stdout, &rows[k].form, program, NULL);
  }
  return HOOKE_EXIT_USAGE;
}
