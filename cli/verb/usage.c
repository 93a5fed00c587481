#include "describe.h"
#include "os.h"
#include "pages.h"
#include "print.h"

#include <ctype.h>
#include <string.h>

enum { WIDTH = 100, OPTIONS = 28, KINDS = 13, EXITS = 12, NAMES_SIZE = 4 * HOOKE_DOC_SIZE };

/* The text begins at column `indent`, below a head that reaches it. */
static void print_item(FILE *file, int32_t indent, const char *head, const char *text) {
  const int32_t length = (int32_t)strlen(head);
  if (length + 2 > indent)
    fprintf(file, "%s\n%*s", head, indent, "");
  else
    fprintf(file, "%-*s", indent, head);
  cli_print_wrapped(file, indent, indent, WIDTH, text);
}

static void print_option(FILE *file, char letter, const char *name, const char *value, const char *doc) {
  char head[2 * HOOKE_FLAG_SIZE + 8], begin[] = {' ', ' ', '-', letter, ',', ' ', '\0'};
  snprintf(head, sizeof head, "%s--%s%s%s", letter ? begin : "      ", name, value && value[0] ? " " : "",
           value ? value : "");
  print_item(file, OPTIONS, head, doc);
}

static void print_exits(FILE *file) {
  char text[HOOKE_DOC_SIZE] = "exit codes:";
  for (int k = 0; cli_exits[k].meaning; k++)
    cli_append(text, sizeof text, "%s %d %s", k ? "," : "", (int)cli_exits[k].code, cli_exits[k].meaning);
  fputc('\n', file);
  cli_print_wrapped(file, 0, EXITS, WIDTH, text);
}

void cli_usage_print(FILE *file, const struct cli_program *program) {
  fprintf(file, "usage: hooke VERB SCENE [options]\n\n%c%s.\n\nverbs:\n",
          toupper((unsigned char)program->summary[0]), program->summary + 1);
  for (const struct cli_verb *const *verb = program->verbs; *verb; verb++)
    fprintf(file, "  %-10s %s\n", (*verb)->name, (*verb)->summary);
  fputs("\nmethods:\n", file);
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    fprintf(file, "  %-17s %s%s\n", name, hooke_method_summary(name),
            hooke_method_is_built(name) ? "" : " (not in this build)");
  }
  fputs("\nhooke VERB --help   the options of a verb, with units and defaults\n\nin place of a verb:\n",
        file);
  for (const struct cli_program_row *row = program->rows; row->name; row++)
    print_option(file, row->letter, row->name, row->value, row->doc);
  print_exits(file);
}

/* ---- of a verb ---- */

static void print_kinds(FILE *file, const char *verb) {
  char head[HOOKE_FLAG_SIZE];
  fputs("\nkinds:\n", file);
  for (int64_t i = 0; hooke_part_kind(i, "name"); i++) {
    snprintf(head, sizeof head, "  %s", hooke_part_kind(i, "name"));
    print_item(file, KINDS, head, hooke_part_kind(i, "summary"));
  }
  fprintf(file, "\nhooke %s KIND --help   the options of a kind, with units and defaults\n", verb);
}

/* The family of an option, if it is another than that of the one before; it moves `last` on. */
static const char *new_family(const struct cli_argument *argument, const char **last, const char **doc) {
  const char *family = cli_describe_family(argument, doc), *before = *last;
  *last = family;
  return family && before && strcmp(family, before) == 0 ? NULL : family;
}

/* The options of a table, NULL: of none; nothing if the verb takes none of them. */
static void print_table(FILE *file, const struct cli_arguments *arguments, const hooke_options *table,
                        const char *title) {
  const char *family, *last = NULL, *doc;
  for (int32_t i = 0, count = 0; i < arguments->count; i++) {
    struct cli_description option;
    if (arguments->all[i].table != table) continue;
    if (count++ == 0) fprintf(file, "\n%s:\n", title);
    family = new_family(&arguments->all[i], &last, &doc);
    if (family) fprintf(file, "  %s: %s\n", family, doc);
    cli_describe(&arguments->all[i], &option);
    print_option(file, option.letter, option.flag, option.value, option.doc);
  }
}

/* Their names alone; a family is named once. */
static void print_names(FILE *file, const struct cli_arguments *arguments, const hooke_options *table,
                        const char *title) {
  const char *last = NULL, *doc;
  char text[NAMES_SIZE] = "";
  for (int32_t i = 0; i < arguments->count; i++) {
    const char *flag = arguments->all[i].flag, *before = last;
    if (arguments->all[i].table != table) continue;
    if (!text[0]) cli_append(text, sizeof text, "%s:", title);
    const int again = !new_family(&arguments->all[i], &last, &doc) && before && last;
    cli_append(text, sizeof text, " %s%s", again ? "" : "--", again ? flag + strlen(last) : flag);
  }
  if (text[0]) cli_print_wrapped(file, 0, 2, WIDTH, text);
}

static const char *units_of(const struct cli_argument *argument) {
  return argument->table ? hooke_options_row(argument->table, argument->row, "units") : "";
}

static void print_units(FILE *file, const struct cli_arguments *arguments) {
  fputs("\nnumbers may have a unit:\n", file);
  for (int32_t i = 0; i < arguments->count; i++) {
    const char *units = units_of(&arguments->all[i]);
    int32_t k = 0;
    while (strcmp(units_of(&arguments->all[k]), units) != 0)
      k++;
    if (units[0] && k == i) fprintf(file, "  %s\n", units);
  }
}

static void print_complete(FILE *file, const struct cli_arguments *arguments) {
  const char *kind = arguments->of_kind ? arguments->scene : NULL;
  char title[HOOKE_FLAG_SIZE], command[HOOKE_DOC_SIZE];
  print_table(file, arguments, NULL, "options");
  snprintf(title, sizeof title, "options of a %s", kind ? kind : "");
  if (kind) print_table(file, arguments, arguments->of_kind, title);
  snprintf(title, sizeof title, "options of the %s", kind ? "scene" : arguments->verb->name);
  if (arguments->more) print_table(file, arguments, arguments->more, title);
  print_table(file, arguments, arguments->run,
              kind ? "options of the run, for the scene to hold (defaults: where it does not)"
                   : "options of the run, instead of what the scene's \"run\" says (defaults: where neither "
                     "says anything)");
  if (arguments->limits) print_table(file, arguments, arguments->limits, "what a scene may do");
  if (!arguments->verb->input) print_units(file, arguments);
  if (kind) fprintf(file, "\nexample:\n  %s\n", cli_describe_example(arguments, command));
}

static void print_short(FILE *file, const struct cli_arguments *arguments) {
  const struct cli_verb *verb = arguments->verb;
  const char *kind = arguments->of_kind ? arguments->scene : NULL;
  char command[HOOKE_DOC_SIZE];
  fputc('\n', file);
  print_names(file, arguments, NULL, "options");
  if (kind) print_names(file, arguments, arguments->of_kind, kind);
  if (arguments->more) print_names(file, arguments, arguments->more, verb->options);
  print_names(file, arguments, arguments->run, "run");
  if (arguments->limits) print_names(file, arguments, arguments->limits, "limits");
  fprintf(file, "\nexample: %s\n", kind ? cli_describe_example(arguments, command) : verb->example);
  fprintf(file, "hooke %s%s%s --help all   what they mean, with units and defaults\n", verb->name,
          kind ? " " : "", kind ? kind : "");
}

void cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments) {
  const struct cli_verb *verb = arguments->verb;
  const char *summary = verb->summary, *kind = arguments->of_kind ? arguments->scene : NULL;
  const int all = arguments->help > 1;
  fprintf(file, "usage: hooke %s %s [options]\n\n", verb->name, kind ? kind : cli_describe_operand(verb));
  if (all)
    cli_print_wrapped(file, 0, 0, WIDTH, verb->text);
  else
    fprintf(file, "%c%s.\n", toupper((unsigned char)summary[0]), summary + 1);
  if (verb->takes_kind && !kind)
    print_kinds(file, verb->name);
  else
    (all ? print_complete : print_short)(file, arguments);
  if (all) print_exits(file);
}

/* ---- version ---- */

int cli_version_print(const struct cli_program *program, const char *value) {
  static const char *const parts[][2] = {
      {"SUNDIALS", "sundials"}, {"CHOLMOD", "cholmod"},  {"LAPACK", "lapack"},
      {"GSL", "gsl"},           {"ARPACK-NG", "arpack"}, {"HDF5", "hdf5"},
      {"Chart.js", "chartjs"},  {"three.js", "threejs"}, {"instructions", "instructions"},
      {"licence", "licence"}};
  (void)program, (void)value;
  printf("hooke %s\n%-13s %d\n", hooke_version(), "ABI", (int)hooke_abi());
  printf("%-13s %d on this machine\n", "threads", (int)cli_os_processors());
  for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
    const char *fact = hooke_build_fact(parts[k][1]);
    printf("%-13s %s\n", parts[k][0], fact && fact[0] ? fact : "not in this build");
  }
  return HOOKE_EXIT_DONE;
}
