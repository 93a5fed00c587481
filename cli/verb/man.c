#include "describe.h"
#include "pages.h"
#include "print.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LINE = 70, DATE_SIZE = 16 }; /* the first one begins with the name */

/* The first `length` bytes of a text as roff; a point in front of it begins no request. */
static const char *escape(const char *text, size_t length, char roff[HOOKE_DOC_SIZE]) {
  static const char *const escapes[] = {"\\\\e", "-\\-", "'\\(aq", "^\\(ha", "~\\(ti", "`\\(ga", NULL};
  snprintf(roff, HOOKE_DOC_SIZE, "%s", text[0] == '.' ? "\\&" : "");
  for (const char *at = text; at < text + length; at++) {
    const char *const *found = escapes;
    while (*found && **found != *at)
      found++;
    cli_append(roff, HOOKE_DOC_SIZE, "%.*s", *found ? HOOKE_DOC_SIZE : 1, *found ? *found + 1 : at);
  }
  return roff;
}

/* Words in lines, which end in `broken` where they go on. */
static void put_lines(const char *text, const char *broken) {
  size_t column = 0, length;
  char word[HOOKE_DOC_SIZE];
  for (; *(text += strspn(text, " ")); text += length) {
    length = strcspn(text, " ");
    const size_t width = strlen(escape(text, length, word));
    const int fits = column + 1 + width <= LINE;
    printf("%s%s", column == 0 ? "" : fits ? " " : broken, word);
    column = (column > 0 && fits ? column + 1 : 0) + width;
  }
  putchar('\n');
}

static void put_text(const char *text) {
  put_lines(text, "\n");
}

static void put_command(const char *command) {
  printf(".PP\n.RS 4\n.EX\n");
  put_lines(command, " \\e\n  ");
  printf(".EE\n.RE\n");
}

static void put_item(const char *name, const char *doc) {
  char roff[HOOKE_DOC_SIZE];
  printf(".TP\n\\fB%s\\fR\n", escape(name, strlen(name), roff));
  put_text(doc);
}

static void put_option(const struct cli_verb_row *row) {
  char roff[HOOKE_DOC_SIZE], begin[] = {'\\', '-', row->letter, ',', ' ', '\0'};
  printf(".TP\n\\fB%s\\-\\-%s\\fR", row->letter ? begin : "", escape(row->name, strlen(row->name), roff));
  if (row->value) printf(" \\fI%s\\fR", escape(row->value, strlen(row->value), roff));
  putchar('\n');
  put_text(row->doc);
}

/* Of a table; NULL: those that have none. */
static void put_options(const struct cli_arguments *arguments, const hooke_options *table) {
  struct cli_description option;
  for (int32_t i = 0; i < arguments->count; i++)
    if (arguments->all[i].table == table) put_option(cli_describe(&arguments->all[i], &option));
}

static void put_synopsis(const struct cli_program *program) {
  for (const struct cli_verb *const *verb = program->verbs; *verb; verb++)
    printf("\\fBhooke %s\\fR \\fI%s\\fR\n[options]\n.br\n", (*verb)->name, cli_arguments_operand(*verb));
  for (const struct cli_program_row *row = program->rows; row->is.name; row++)
    printf("%s\\fBhooke \\-\\-%s%s%s\\fR\n", row == program->rows ? "" : ".br\n", row->is.name,
           row->is.value ? " " : "", row->is.value ? row->is.value : "");
}

static void put_description(const struct cli_program *program) {
  put_text(program->text);
  for (const struct cli_verb *const *verb = program->verbs; *verb; verb++)
    put_item((*verb)->name, (*verb)->summary);
  printf(".SS Methods\n");
  for (int64_t i = 0; i < hooke_method_count(); i++)
    put_item(hooke_method_name(i), hooke_method_summary(hooke_method_name(i)));
}

/* ---- options ---- */

/* A verb, or one of its kinds. */
static int put_verb(const struct cli_verb *verb, const char *kind, const char *text) {
  struct cli_arguments arguments = {.verb = verb};
  char words[HOOKE_DOC_SIZE];
  const int code = cli_arguments_collect(verb, kind, &arguments);
  const hooke_options *table = kind ? arguments.of_kind : arguments.more;
  printf(".SS hooke %s %s [options]\n", verb->name, kind ? kind : cli_arguments_operand(verb));
  put_text(text);
  for (int32_t i = 0; !kind && i < verb->row_count; i++)
    put_option(&verb->rows[i]);
  if (table) put_options(&arguments, table);
  if (kind) {
    printf(".PP\nFor example:\n");
    put_command(cli_describe_example(&arguments, words));
  } else if (verb->without) {
    printf(".PP\nOf the options of a run it does not take:\n");
    snprintf(words, sizeof words, "%s.", verb->without);
    put_text(words);
  }
  cli_arguments_destroy(&arguments);
  return code;
}

static int put_kinds(const struct cli_verb *verb) {
  char text[HOOKE_DOC_SIZE];
  int code = HOOKE_EXIT_DONE;
  const char *kind;
  for (int64_t i = 0; (kind = hooke_part_kind(i, "name")) != NULL && code == HOOKE_EXIT_DONE; i++) {
    snprintf(text, sizeof text, "Makes a %s: %s.", kind, hooke_part_kind(i, "summary"));
    code = put_verb(verb, kind, text);
  }
  return code;
}

static int put_common(const struct cli_program *program) {
  static const struct cli_verb none = {.name = "run"};
  struct cli_arguments arguments = {.verb = &none};
  const int code = cli_arguments_collect(&none, NULL, &arguments);
  printf(".SH OPTIONS\nIn place of a verb:\n");
  for (const struct cli_program_row *row = program->rows; row->is.name; row++)
    put_option(&row->is);
  printf(".PP\nAll verbs take:\n");
  put_options(&arguments, NULL);
  printf(".SS Options of a run\n");
  put_text("Verbs that take a scene take these, too, instead of what the scene's \"run\" says; defaults are "
           "for where neither says anything. make writes them there.");
  put_options(&arguments, arguments.run);
  printf(".PP\n");
  put_text("A number in [s], [m], [kg], [N] and so on may have another unit: 5ms, 0.5 cm, 200g, 2kN. The "
           "message about an unknown unit lists those that are allowed.");
  printf(".SS What a scene may do\n");
  put_text("Verbs that take a scene refuse one that needs more memory than there is, or names files outside "
           "its folder, unless told otherwise.");
  put_options(&arguments, arguments.limits);
  cli_arguments_destroy(&arguments);
  return code;
}

/* ---- the end ---- */

static void put_end(const struct cli_program *program) {
  char code[DATE_SIZE];
  printf(".SH EXIT STATUS\n");
  for (int k = 0; cli_exits[k].meaning; k++) {
    snprintf(code, sizeof code, "%d", (int)cli_exits[k].code);
    put_item(code, cli_exits[k].meaning);
  }
  printf(".SH FILES\n");
  put_item("*.json",
           "Scenes: particles, springs, parts and the options of a run, in JSON. A scene - is standard "
           "input.");
  put_item("*.h5",
           "Trajectories and comparisons, in HDF5 after the H5MD convention. A trajectory stands for its "
           "scene, with the options of its run, wherever a scene is taken.");
  put_item("*.html", "Reports, each one page to read offline.");
  put_item("*.csv", "Rows of a study.");
  printf(".SH EXAMPLES\n");
  for (const struct cli_verb *const *verb = program->verbs; *verb; verb++) {
    if (verb != program->verbs) printf(".PP\n");
    put_text((*verb)->summary);
    put_command((*verb)->example);
  }
  printf(".SH SEE ALSO\nh5dump(1), python3(1)\n");
}

int cli_man_print(const struct cli_program *program, const char *value) {
  const char *epoch = getenv("SOURCE_DATE_EPOCH");
  const time_t now = epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
  char date[DATE_SIZE] = "";
  struct tm parts;
  (void)value;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d", &parts);
  printf(".TH HOOKE 1 %s \"hooke %s\" \"User Commands\"\n", date, hooke_version());
  printf(".SH NAME\nhooke \\- ");
  put_text(program->summary);
  printf(".SH SYNOPSIS\n");
  put_synopsis(program);
  printf(".SH DESCRIPTION\n");
  put_description(program);
  printf(".SH VERBS\n");
  int code = HOOKE_EXIT_DONE;
  for (const struct cli_verb *const *verb = program->verbs; *verb && code == HOOKE_EXIT_DONE; verb++) {
    code = put_verb(*verb, NULL, (*verb)->text);
    if (code == HOOKE_EXIT_DONE && (*verb)->takes_kind) code = put_kinds(*verb);
  }
  if (code == HOOKE_EXIT_DONE) code = put_common(program);
  if (code == HOOKE_EXIT_DONE) put_end(program);
  return code;
}
