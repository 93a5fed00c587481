#include "describe.h"
#include "print.h"

#include "report.h"

#include <ctype.h>
#include <string.h>

const struct cli_exit_row cli_exits[] = {
    {HOOKE_EXIT_DONE, "done"},
    {HOOKE_EXIT_USAGE, "wrong usage"},
    {HOOKE_EXIT_BAD_INPUT, "bad input"},
    {HOOKE_EXIT_DIVERGED, "diverged"},
    {HOOKE_EXIT_IO, "could not read or write"},
    {HOOKE_EXIT_NOT_BUILT, "not in this build"},
    {HOOKE_EXIT_NOT_MET, "the wanted error was not reached, or nobody can know"},
    {HOOKE_EXIT_INTERNAL, "a defect of hooke"},
    {HOOKE_EXIT_INTERRUPTED, "interrupted"},
    {0, NULL},
};

static int32_t takes_methods(const struct cli_argument *argument) {
  return strcmp(argument->name, "method") == 0 || strcmp(argument->name, "methods") == 0;
}

static const char *property(const struct cli_argument *argument, const char *name) {
  return hooke_options_row(argument->table, argument->row, name);
}

/* ---- options ---- */

/* Says that an option is required, or gives its default. */
static void add_default(char *doc, const struct cli_argument *argument) {
  const char *fallback = property(argument, "default"), *family = property(argument, "family"),
             *example = property(argument, "example");
  if (hooke_options_row_number(argument->table, argument->row, "required") == 0.0 || fallback[0]) {
    cli_append(doc, HOOKE_DOC_SIZE, "; default: %s", fallback[0] ? fallback : "none");
    return;
  }
  cli_append(doc, HOOKE_DOC_SIZE, family[0] ? "; needed for any %s" : "; required", family);
  if (example[0]) cli_append(doc, HOOKE_DOC_SIZE, ", such as %s", example);
}

const struct cli_verb_row *cli_describe(const struct cli_argument *argument,
                                        struct cli_description *description) {
  if (argument->own) return argument->own;
  const char *type = property(argument, "type"), *unit = property(argument, "unit");
  const int is_flag = cli_argument_is_flag(argument);
  char methods[HOOKE_DOC_SIZE / 4];
  *description = (struct cli_description){
      .is = {argument->flag, 0, is_flag ? NULL : description->value, description->doc}};
  for (size_t i = 0; type[i] && type[i] != ' '; i++)
    description->value[i] = (char)toupper((unsigned char)type[i]);
  if (takes_methods(argument)) cli_report_methods(methods, sizeof methods);
  cli_append(description->doc, HOOKE_DOC_SIZE, "%s%s%s%s; %s", unit[0] ? "[" : "", unit, unit[0] ? "] " : "",
             property(argument, "doc"), takes_methods(argument) ? methods : property(argument, "allowed"));
  add_default(description->doc, argument);
  return &description->is;
}

const char *cli_describe_family(const struct cli_argument *argument, const char **doc) {
  const char *family = argument->table ? property(argument, "family") : "";
  for (int64_t row = 0; family[0] && row < hooke_options_row_count(argument->table); row++) {
    if (strcmp(hooke_options_row(argument->table, row, "name"), family) == 0)
      *doc = hooke_options_row(argument->table, row, "doc");
  }
  return family;
}

const char *cli_describe_words(const struct cli_argument *argument, char words[HOOKE_DOC_SIZE],
                               int32_t *many) {
  words[0] = '\0';
  *many = strcmp(argument->name, "methods") == 0 || (argument->table && cli_argument_adds_up(argument));
  for (int64_t i = 0; takes_methods(argument) && i < hooke_method_count(); i++)
    cli_append(words, HOOKE_DOC_SIZE, "%s%s", i ? " " : "", hooke_method_name(i));
  if (words[0] || !argument->table) return words;
  cli_append(words, HOOKE_DOC_SIZE, "%s",
             cli_argument_is_flag(argument) ? "true false" : property(argument, "words"));
  return words;
}

/* A verb's own options show it by the name of their value: FILE, FILE.html. */
const char *cli_describe_file(const struct cli_argument *argument) {
  const char *value = argument->own ? argument->own->value : NULL, *dot = value ? strchr(value, '.') : NULL;
  if (argument->table) return strcmp(argument->name, "file") == 0 ? "" : NULL;
  if (dot) return dot + 1;
  return value && strncmp(value, "FILE", 4) == 0 ? "" : NULL;
}

/* ---- verbs ---- */

/* Required options, one of several with an example, and the first family. */
const char *cli_describe_example(const struct cli_arguments *arguments, char command[HOOKE_DOC_SIZE]) {
  const char *first = "";
  command[0] = '\0';
  cli_append(command, HOOKE_DOC_SIZE, "hooke %s %s", arguments->verb->name, arguments->scene);
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (argument->table != arguments->of_kind) continue;
    const char *family = property(argument, "family"), *example = property(argument, "example");
    if (!example[0]) continue;
    if (!first[0]) first = family;
    if (family[0] == '\0' || strcmp(family, first) == 0)
      cli_append(command, HOOKE_DOC_SIZE, strchr(example, ';') ? " --%s '%s'" : " --%s %s", argument->flag,
                 example);
  }
  return command;
}
