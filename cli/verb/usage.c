#include "describe.h"
#include "os.h"
#include "pages.h"
#include "print.h"

#include <ctype.h>
#include <string.h>

enum { WIDTH = 100, OPTIONS = 28, KINDS = 13, EXITS = 12, NAMES_SIZE = 4 * HOOKE_DOC_SIZE };

/* The text begins in a column of its own, below a head that reaches it. */
static void print_option(FILE *file, const struct cli_verb_row *row) {
  char head[2 * HOOKE_FLAG_SIZE + 8], begin[] = {' ', ' ', '-', row->letter, ',', ' ', '\0'};
  const int length = snprintf(head, sizeof head, "%s--%s%s%s", row->letter ? begin : "      ", row->name,
                              row->value ? " " : "", row->value ? row->value : "");
  fprintf(file, length + 2 > OPTIONS ? "%s\n%*s" : "%s%*s", head,
          length + 2 > OPTIONS ? OPTIONS : OPTIONS - length, "");
  cli_print_wrapped(file, OPTIONS, OPTIONS, WIDTH, row->doc);
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
  for (const struct cli_program_row *row = program->rows; row->is.name; row++)
    print_option(file, &row->is);
  print_exits(file);
}

/* ---- of a verb ---- */

static void print_kinds(FILE *file, const char *verb) {
  fputs("\nkinds:\n", file);
  for (int64_t i = 0; hooke_part_kind(i, "name"); i++) {
    fprintf(file, "  %-10s ", hooke_part_kind(i, "name"));
    cli_print_wrapped(file, KINDS, KINDS, WIDTH, hooke_part_kind(i, "summary"));
  }
  fprintf(file, "\nhooke %s KIND --help   the options of a kind, with units and defaults\n", verb);
}

/* The options of a table, NULL: of none; nothing if the verb takes none of them. */
static void print_table(FILE *file, const struct cli_arguments *arguments, const hooke_options *table,
                        const char *title) {
  const char *last = "", *doc;
  for (int32_t i = 0, count = 0; i < arguments->count; i++) {
    struct cli_description option;
    if (arguments->all[i].table != table) continue;
    if (count++ == 0) fprintf(file, "\n%s:\n", title);
    const char *family = cli_describe_family(&arguments->all[i], &doc);
    if (family[0] && strcmp(family, last) != 0) fprintf(file, "  %s: %s\n", family, doc);
    print_option(file, cli_describe(&arguments->all[i], &option));
    last = family;
  }
}

/* Their names alone; those of a family have it only once before them. */
static void print_names(FILE *file, const struct cli_arguments *arguments, const hooke_options *table,
                        const char *title) {
  const char *last = "", *doc;
  char text[NAMES_SIZE] = "";
  for (int32_t i = 0; i < arguments->count; i++) {
    if (arguments->all[i].table != table) continue;
    const char *flag = arguments->all[i].flag, *family = cli_describe_family(&arguments->all[i], &doc);
    const int again = family[0] && strcmp(family, last) == 0;
    cli_append(text, sizeof text, " %s%s", again ? "" : "--", again ? flag + strlen(family) : flag);
    last = family;
  }
  if (!text[0]) return;
  const int32_t length = fprintf(file, "%s: ", title);
  cli_print_wrapped(file, length, 2, WIDTH, text);
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

/* All that there is to know, or names alone. */
static void print_tables(FILE *file, const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  char of_kind[HOOKE_FLAG_SIZE], of_more[HOOKE_FLAG_SIZE];
  const struct {
    const hooke_options *table; /* NULL, but for the first: there is none */
    const char *title, *name;
  } tables[] = {{NULL, "options", "options"},
                {arguments->of_kind, of_kind, kind},
                {arguments->more, of_more, verb->options},
                {arguments->run,
                 kind ? "options of the run, for the scene to hold (defaults: where it does not)"
                      : "options of the run, instead of what the scene's \"run\" says (defaults: where "
                        "neither says anything)",
                 "run"},
                {arguments->limits, "what a scene may do", "limits"}};
  snprintf(of_kind, sizeof of_kind, "options of a %s", kind ? kind : "");
  snprintf(of_more, sizeof of_more, "options of the %s", kind ? "scene" : verb->name);
  for (size_t k = 0; k < sizeof tables / sizeof tables[0]; k++) {
    if (k > 0 && !tables[k].table) continue;
    if (arguments->help > 1)
      print_table(file, arguments, tables[k].table, tables[k].title);
    else
      print_names(file, arguments, tables[k].table, tables[k].name);
  }
}

void cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments) {
  const struct cli_verb *verb = arguments->verb;
  const char *summary = verb->summary, *kind = arguments->of_kind ? arguments->scene : NULL;
  const int all = arguments->help > 1, bare = verb->takes_kind && !kind;
  char command[HOOKE_DOC_SIZE];
  fprintf(file, "usage: hooke %s %s [options]\n\n", verb->name, kind ? kind : cli_arguments_operand(verb));
  if (all)
    cli_print_wrapped(file, 0, 0, WIDTH, verb->text);
  else
    fprintf(file, "%c%s.\n", toupper((unsigned char)summary[0]), summary + 1);
  if (!all && !bare) fputc('\n', file);
  if (bare)
    print_kinds(file, verb->name);
  else
    print_tables(file, arguments, kind);
  if (all && !bare && !verb->input) print_units(file, arguments);
  if (!bare && (kind || !all))
    fprintf(file, all ? "\nexample:\n  %s\n" : "\nexample: %s\n",
            kind ? cli_describe_example(arguments, command) : verb->example);
  if (all)
    print_exits(file);
  else if (!bare)
    fprintf(file, "hooke %s%s%s --help all   what they mean, with units and defaults\n", verb->name,
            kind ? " " : "", kind ? kind : "");
}

/* ---- version ---- */

int cli_version_print(const struct cli_program *program, const char *value) {
  static const char *const parts[][3] = {
      {"SUNDIALS", "sundials"}, {"CHOLMOD", "cholmod"},  {"BLAS", "blas", "no optimised one"},
      {"LAPACK", "lapack"},     {"GSL", "gsl"},          {"HDF5", "hdf5"},
      {"Chart.js", "chartjs"},  {"three.js", "threejs"}, {"instructions", "instructions"},
      {"licence", "licence"}};
  (void)program, (void)value;
  printf("hooke %s\n%-13s %d\n", hooke_version(), "ABI", (int)hooke_abi());
  printf("%-13s %d on this machine\n", "threads", (int)cli_os_processors());
  for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
    const char *fact = hooke_build_fact(parts[k][1]);
    const char *none = parts[k][2] ? parts[k][2] : "not in this build";
    printf("%-13s %s\n", parts[k][0], fact && fact[0] ? fact : none);
  }
  return HOOKE_EXIT_DONE;
}
