#include "man.h"

#include "describe.h"
#include "print.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LINE = 76, COMMAND = 64, TEXT_SIZE = 8 * HOOKE_DOC_SIZE, DATE_SIZE = 16 };

/* ---- roff text ---- */

/* Adds `words` escaped, so that every character is literal and no line begins with a request. */
static void escape(char text[TEXT_SIZE], const char *words) {
  size_t used = strlen(text);
  for (const char *at = words; *at && used + 8 < TEXT_SIZE; at++) {
    const int32_t first = at == words || at[-1] == ' ';
    const char *as = *at == '\\'           ? "\\e"
                     : *at == '-'          ? "\\-"
                     : *at == '\''         ? "\\(aq"
                     : *at == '^'          ? "\\(ha"
                     : *at == '~'          ? "\\(ti"
                     : *at == '`'          ? "\\(ga"
                     : *at == '.' && first ? "\\&."
                                           : NULL;
    const char as_is[2] = {*at, '\0'};
    used += (size_t)snprintf(text + used, TEXT_SIZE - used, "%s", as ? as : as_is);
  }
}

static void print_paragraph(const char *words) {
  char text[TEXT_SIZE] = "";
  escape(text, words);
  cli_print_wrapped(stdout, 0, 0, LINE, text);
}

/* A command line, broken over several lines if it is long. */
static void print_command(const char *command) {
  int32_t column = 0;
  printf(".PP\n.RS 4\n.EX\n");
  while (*command) {
    const int32_t length = (int32_t)strcspn(command, " ");
    char word[HOOKE_DOC_SIZE], text[TEXT_SIZE] = "";
    snprintf(word, sizeof word, "%.*s", length, command);
    escape(text, word);
    if (column > 0 && column + length > COMMAND) {
      printf(" \\e\n  ");
      column = 0;
    }
    printf("%s%s", column > 0 ? " " : "", text);
    column += length + 1;
    command += length + (command[length] == ' ');
  }
  printf("\n.EE\n.RE\n");
}

/* One line: literal words, and placeholders. */
static void print_typed(const char *bold, const char *italic) {
  char text[TEXT_SIZE] = "\\fB";
  escape(text, bold);
  cli_append(text, sizeof text, "%s", italic[0] ? "\\fR \\fI" : "");
  escape(text, italic);
  printf("%s\\fR\n", text);
}

/* An item of a list: its head in bold, then its text. */
static void print_item(const char *bold, const char *italic, const char *words) {
  printf(".TP\n");
  print_typed(bold, italic);
  print_paragraph(words);
}

static void print_title(const char *name) {
  printf(".SH ");
  for (; *name; name++)
    putchar(toupper((unsigned char)*name));
  putchar('\n');
}

/* ---- options ---- */

static void print_option(const struct cli_argument *argument) {
  struct cli_description is;
  char flag[HOOKE_FLAG_SIZE + 8] = "";
  cli_describe(argument, &is);
  if (is.letter) snprintf(flag, sizeof flag, "-%c, ", is.letter);
  snprintf(flag + strlen(flag), sizeof flag - strlen(flag), "--%s", is.flag);
  print_item(flag, is.value, is.doc);
}

/* A verb's own options, or the common ones. */
static void print_own(const struct cli_arguments *arguments, int32_t shared) {
  const struct cli_verb *verb = arguments->verb;
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_verb_row *own = arguments->all[i].own;
    if (!own) continue;
    const int32_t of_verb = verb->rows && own >= verb->rows && own < verb->rows + verb->row_count;
    if (of_verb != shared) print_option(&arguments->all[i]);
  }
}

static void print_table(const struct cli_arguments *arguments, const hooke_options *table) {
  for (int32_t i = 0; table && i < arguments->count; i++) {
    if (arguments->all[i].table == table) print_option(&arguments->all[i]);
  }
}

/* ---- verbs ---- */

static void print_heading(const struct cli_verb *verb, const char *operand) {
  printf(".SS hooke %s %s [options]\n", verb->name, operand);
}

/* Functions here that describe a verb return an exit code; failures are reported already. */
static int print_kind(const struct cli_verb *verb, int64_t kind) {
  struct cli_arguments arguments = {.verb = verb};
  char example[HOOKE_DOC_SIZE], words[2 * HOOKE_DOC_SIZE];
  const int code = cli_arguments_collect(verb, hooke_part_kind(kind, "name"), &arguments);
  if (code == HOOKE_EXIT_DONE) {
    print_heading(verb, hooke_part_kind(kind, "name"));
    snprintf(words, sizeof words, "Makes a %s: %s.", hooke_part_kind(kind, "name"),
             hooke_part_kind(kind, "summary"));
    print_paragraph(words);
    print_table(&arguments, arguments.of_kind);
    printf(".PP\nFor example:\n");
    print_command(cli_describe_example(&arguments, example));
  }
  cli_arguments_destroy(&arguments);
  return code;
}

static int print_verb(const struct cli_verb *verb) {
  struct cli_arguments arguments = {.verb = verb};
  char words[HOOKE_DOC_SIZE];
  int code = cli_arguments_collect(verb, NULL, &arguments);
  if (code == HOOKE_EXIT_DONE) {
    print_heading(verb, cli_describe_operand(verb));
    print_paragraph(verb->text);
    print_own(&arguments, 0);
    print_table(&arguments, arguments.more);
    if (verb->without) {
      snprintf(words, sizeof words, "Of the options of a run it does not take: %s.", verb->without);
      printf(".PP\n");
      print_paragraph(words);
    }
  }
  cli_arguments_destroy(&arguments);
  for (int64_t kind = 0; code == HOOKE_EXIT_DONE && verb->takes_kind && hooke_part_kind(kind, "name"); kind++)
    code = print_kind(verb, kind);
  return code;
}

/* The common options, from a verb that takes them all. */
static int print_options(const struct cli_program *program) {
  const struct cli_verb all = {.name = program->verbs[0]->name};
  struct cli_arguments arguments = {.verb = &all};
  char words[HOOKE_DOC_SIZE];
  print_title("options");
  print_paragraph("In place of a verb:");
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    const char letter[] = {'-', row->letter, ',', ' ', '\0'};
    snprintf(words, sizeof words, "%s--%s", row->letter ? letter : "", row->name);
    print_item(words, row->value ? row->value : "", row->doc);
  }
  const int code = cli_arguments_collect(&all, NULL, &arguments);
  if (code == HOOKE_EXIT_DONE) {
    printf(".PP\nAll verbs take:\n");
    print_own(&arguments, 1);
    printf(".SS Options of a run\n");
    print_paragraph("Verbs that take a scene take these, too, instead of what the scene's \"run\" says; "
                    "defaults are for where "
                    "neither says anything. make writes them there.");
    print_table(&arguments, arguments.run);
    printf(".PP\n");
    print_paragraph(
        "A number in [s], [m], [kg], [N] and so on may have another unit: 5ms, 0.5 cm, 200g, 2kN. The "
        "message about an unknown unit lists those that are allowed.");
    printf(".SS What a scene may do\n");
    print_paragraph(
        "Verbs that take a scene refuse one that needs more memory than there is, or names files outside its "
        "folder, unless told otherwise.");
    print_table(&arguments, arguments.limits);
  }
  cli_arguments_destroy(&arguments);
  return code;
}

/* ---- the page ---- */

static const char *const files[][2] = {
    {"*.json",
     "Scenes: particles, springs, parts and the options of a run, in JSON. A scene - is standard input."},
    {"*.h5", "Trajectories and comparisons, in HDF5 after the H5MD convention. A trajectory stands for its "
             "scene, with "
             "the options of its run, wherever a scene is taken."},
    {"*.html", "Reports, each one page to read offline."},
    {"*.csv", "Rows of a study."},
};
enum { FILE_COUNT = sizeof files / sizeof files[0] };

static void print_top(const struct cli_program *program) {
  const char *epoch = getenv("SOURCE_DATE_EPOCH");
  const time_t now = epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
  char date[DATE_SIZE] = "";
  struct tm parts;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d", &parts);
  printf(".TH HOOKE 1 %s \"hooke %s\" \"User Commands\"\n", date, hooke_version());
  print_title("name");
  char words[HOOKE_DOC_SIZE];
  snprintf(words, sizeof words, "hooke - %s", program->summary);
  print_paragraph(words);
}

static void print_synopsis(const struct cli_program *program) {
  print_title("synopsis");
  for (int32_t i = 0; program->verbs[i]; i++) {
    char words[HOOKE_DOC_SIZE];
    snprintf(words, sizeof words, "hooke %s", program->verbs[i]->name);
    print_typed(words, cli_describe_operand(program->verbs[i]));
    printf("[options]\n.br\n");
  }
  for (const struct cli_program_row *row = program->rows; row->name; row++) {
    char words[HOOKE_DOC_SIZE];
    snprintf(words, sizeof words, "hooke --%s%s%s", row->name, row->value ? " " : "",
             row->value ? row->value : "");
    print_typed(words, "");
    if (row[1].name) printf(".br\n");
  }
}

static void print_description(const struct cli_program *program) {
  print_title("description");
  print_paragraph(program->text);
  for (int32_t i = 0; program->verbs[i]; i++)
    print_item(program->verbs[i]->name, "", program->verbs[i]->summary);
  printf(".SS Methods\n");
  for (int64_t i = 0; hooke_method_name(i); i++)
    print_item(hooke_method_name(i), "", hooke_method_summary(hooke_method_name(i)));
}

static void print_end(const struct cli_program *program) {
  const char *words;
  char code[HOOKE_DOC_SIZE];
  int32_t number;
  print_title("exit status");
  for (int32_t i = 0; (words = cli_describe_exit(i, &number)); i++) {
    snprintf(code, sizeof code, "%d", (int)number);
    print_item(code, "", words);
  }
  print_title("files");
  for (int32_t i = 0; i < FILE_COUNT; i++)
    print_item(files[i][0], "", files[i][1]);
  print_title("examples");
  for (int32_t i = 0; program->verbs[i]; i++) {
    if (!program->verbs[i]->example) continue;
    if (i > 0) printf(".PP\n");
    print_paragraph(program->verbs[i]->summary);
    print_command(program->verbs[i]->example);
  }
  print_title("see also");
  print_paragraph("h5dump(1), python3(1)");
}

int cli_man_print(const struct cli_program *program, const char *value) {
  (void)value;
  int code = HOOKE_EXIT_DONE;
  print_top(program);
  print_synopsis(program);
  print_description(program);
  print_title("verbs");
  for (int32_t i = 0; program->verbs[i] && code == HOOKE_EXIT_DONE; i++)
    code = print_verb(program->verbs[i]);
  if (code == HOOKE_EXIT_DONE) code = print_options(program);
  if (code == HOOKE_EXIT_DONE) print_end(program);
  return code;
}
