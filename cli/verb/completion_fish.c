#include "completion.h"

#include "describe.h"

#include <stdio.h>

/* The beginning of a line that holds after a verb, and after a kind. */
static void print_after(const char *verb, const char *kind) {
  printf("complete -c hooke -n '__fish_seen_subcommand_from %s", verb);
  if (kind) printf("; and __fish_seen_subcommand_from %s", kind);
  printf("'");
}

static void print_doc(const char *doc) {
  printf(" -d '");
  cli_completion_escape(doc, "\\");
  printf("'\n");
}

/* fish knows no endings of files but by its function. */
static void print_files(const char *ending) {
  if (ending[0])
    printf(" -k -x -a '(__fish_complete_suffix .%s)'", ending);
  else
    printf(" -r -F");
}

static void print_option(const struct cli_argument *argument, const char *verb, const char *kind) {
  struct cli_description is;
  char words[HOOKE_DOC_SIZE];
  int32_t many;
  const char *ending = cli_describe_file(argument);
  cli_describe(argument, &is);
  cli_describe_words(argument, words, &many);
  print_after(verb, kind);
  printf(" -l %s", is.flag);
  if (is.letter) printf(" -s %c", is.letter);
  if (is.value[0] && ending)
    print_files(ending);
  else if (is.value[0])
    printf(words[0] ? " -x -a '%s'" : " -x", words);
  print_doc(is.doc);
}

static void print_verb(const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  if (!kind) {
    print_after(verb->name, NULL);
    printf(" -k -x -a '(__fish_complete_suffix %s)'\n", verb->input ? ".h5" : ".json");
  }
  for (int32_t i = 0; i < arguments->count; i++)
    print_option(&arguments->all[i], verb->name, kind);
}

static void print_kinds(const struct cli_verb *verb) {
  for (int64_t k = 0; verb->takes_kind && hooke_part_kind(k, "name"); k++) {
    print_after(verb->name, NULL);
    printf(" -a %s", hooke_part_kind(k, "name"));
    print_doc(hooke_part_kind(k, "summary"));
  }
}

int cli_completion_fish(const struct cli_program *program) {
  printf("# fish completion of hooke, made by hooke --completion fish\n\ncomplete -c hooke -f\n");
  for (int32_t i = 0; program->verbs[i]; i++) {
    printf("complete -c hooke -n __fish_use_subcommand -a %s", program->verbs[i]->name);
    print_doc(program->verbs[i]->summary);
    print_kinds(program->verbs[i]);
  }
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    printf("complete -c hooke -n __fish_use_subcommand -l %s", row->name);
    if (row->letter) printf(" -s %c", row->letter);
    if (row->words) printf(" -x -a '%s'", row->words);
    print_doc(row->doc);
  }
  return cli_completion_each(program, print_verb);
}
