#include "usage.h"
#include "describe.h"
#include "os.h"
#include "print.h"
#include "report.h"

#include <ctype.h>
#include <string.h>

enum { DOC_COLUMN = 28, WIDTH = 100 };

static void print_exits(FILE *file) {
  char text[HOOKE_DOC_SIZE] = "exit codes:";
  const char *meaning;
  int32_t code;
  for (int32_t i = 0; (meaning = cli_describe_exit(i, &code)); i++)
    cli_append(text, sizeof text, "%s %d %s", i ? "," : "", (int)code, meaning);
  fputc('\n', file);
  cli_print_wrapped(file, 0, 12, WIDTH, text);
}

/* "  -o, --output FILE", then the text from column DOC_COLUMN on. */
static void print_row(FILE *file, char letter, const char *flag, const char *value, const char *doc) {
  char head[2 * HOOKE_FLAG_SIZE];
  char letters[8] = "    ";
  if (letter) snprintf(letters, sizeof letters, "-%c, ", letter);
  snprintf(head, sizeof head, "  %s--%s%s%s", letters, flag, value ? " " : "", value ? value : "");
  int32_t column = (int32_t)strlen(head);
  fputs(head, file);
  if (column + 2 > DOC_COLUMN) {
    fprintf(file, "\n%*s", DOC_COLUMN, "");
  } else {
    fprintf(file, "%*s", DOC_COLUMN - column, "");
  }
  cli_print_wrapped(file, DOC_COLUMN, DOC_COLUMN, WIDTH, doc);
}

void cli_usage_print_all(FILE *file, const struct cli_program *program) {
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
    print_row(file, row->letter, row->name, row->value, row->doc);
  print_exits(file);
}

static void print_option(FILE *file, const struct cli_argument *argument) {
  struct cli_description is;
  cli_describe(argument, &is);
  print_row(file, is.letter, is.flag, is.value[0] ? is.value : NULL, is.doc);
}

/* The rows of a table, under their heading. */
static void print_table(FILE *file, const struct cli_arguments *arguments, const hooke_options *table) {
  char title[HOOKE_DOC_SIZE];
  const char *last = NULL, *doc = "";
  if (!table) return;
  fprintf(file, "\n%s:\n", cli_describe_table(arguments, table, title));
  for (int32_t i = 0; i < arguments->count; i++) {
    if (arguments->all[i].table != table) continue;
    const char *family = cli_describe_family(&arguments->all[i], &doc);
    if (family && family != last) fprintf(file, "  %s: %s\n", family, doc);
    last = family;
    print_option(file, &arguments->all[i]);
  }
}

static void print_kinds(FILE *file, const struct cli_verb *verb) {
  fputs("\nkinds:\n", file);
  for (int64_t i = 0; hooke_part_kind(i, "name"); i++) {
    fprintf(file, "  %-10s ", hooke_part_kind(i, "name"));
    cli_print_wrapped(file, 13, 13, WIDTH, hooke_part_kind(i, "summary"));
  }
  fprintf(file, "\nhooke %s KIND --help   the options of a kind, with units and defaults\n", verb->name);
}

static const char *units_of(const struct cli_argument *argument) {
  return argument->table ? hooke_options_row(argument->table, argument->row, "units") : "";
}

/* Lists the units of all options, those of a kind once. HOOKE_NO_MEMORY */
static int32_t print_units(FILE *file, const struct cli_arguments *arguments) {
  fputs("\nnumbers may have a unit:\n", file);
  for (int32_t i = 0; i < arguments->count; i++) {
    const char *units = units_of(&arguments->all[i]);
    if (!units) return HOOKE_NO_MEMORY;
    int32_t again = !units[0];
    for (int32_t k = 0; k < i && !again; k++)
      again = strcmp(units_of(&arguments->all[k]), units) == 0;
    if (!again) fprintf(file, "  %s\n", units);
  }
  return HOOKE_OK;
}

/* HOOKE_NO_MEMORY */
static int32_t print_options(FILE *file, const struct cli_arguments *arguments) {
  fputs("\noptions:\n", file);
  for (int32_t i = 0; i < arguments->count; i++) {
    if (arguments->all[i].own) print_option(file, &arguments->all[i]);
  }
  print_table(file, arguments, arguments->of_kind);
  print_table(file, arguments, arguments->more);
  if (arguments->verb->input) return HOOKE_OK;
  print_table(file, arguments, arguments->run);
  print_table(file, arguments, arguments->limits);
  return print_units(file, arguments);
}

/* The options of a table (NULL: the verb's own) by their names alone; of a family in one word. */
static void print_names(FILE *file, const struct cli_arguments *arguments, const hooke_options *table,
                        const char *title) {
  char text[4 * HOOKE_DOC_SIZE] = "";
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    const char *doc, *family = cli_describe_family(argument, &doc);
    if (argument->table != table) continue;
    if (!family || strstr(text, family) == NULL)
      cli_append(text, sizeof text, " --%s", argument->flag);
    else
      cli_append(text, sizeof text, " .%s", argument->flag + strlen(family) + 1);
  }
  fprintf(file, "%s: ", title);
  cli_print_wrapped(file, (int32_t)strlen(title) + 2, 2, WIDTH, text);
}

/* `hooke VERB --help all` */
static int32_t print_complete(FILE *file, const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  char example[HOOKE_DOC_SIZE];
  int32_t status = HOOKE_OK;
  cli_print_wrapped(file, 0, 0, WIDTH, verb->text);
  if (verb->takes_kind && !kind) {
    print_kinds(file, verb);
  } else {
    status = print_options(file, arguments);
  }
  if (kind) fprintf(file, "\nexample:\n  %s\n", cli_describe_example(arguments, example));
  print_exits(file);
  return status;
}

static void print_short(FILE *file, const struct cli_arguments *arguments, const char *kind) {
  const struct cli_verb *verb = arguments->verb;
  char example[HOOKE_DOC_SIZE];
  fprintf(file, "%c%s.\n", toupper((unsigned char)verb->summary[0]), verb->summary + 1);
  if (verb->takes_kind && !kind) {
    print_kinds(file, verb);
    return;
  }
  fputc('\n', file);
  print_names(file, arguments, NULL, "options");
  if (arguments->of_kind) print_names(file, arguments, arguments->of_kind, kind);
  if (arguments->more) print_names(file, arguments, arguments->more, verb->options);
  if (!verb->input) print_names(file, arguments, arguments->run, "run");
  if (arguments->limits) print_names(file, arguments, arguments->limits, "limits");
  fprintf(file, "\nexample: %s\n", kind ? cli_describe_example(arguments, example) : verb->example);
  fprintf(file, "hooke %s%s%s --help all   what they mean, with units and defaults\n", verb->name,
          kind ? " " : "", kind ? kind : "");
}

int cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments) {
  const struct cli_verb *verb = arguments->verb;
  const char *kind = verb->takes_kind ? arguments->scene : NULL;
  int32_t status = HOOKE_OK;
  fprintf(file, "usage: hooke %s %s [options]\n\n", verb->name, kind ? kind : cli_describe_operand(verb));
  if (arguments->help > 1)
    status = print_complete(file, arguments, kind);
  else
    print_short(file, arguments, kind);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report(arguments, cli_exit_code(status), "out of memory");
}

/* ---- version ---- */

static void print_part(FILE *file, const char *name, const char *what) {
  const char *fact = hooke_build_fact(what);
  fprintf(file, "%-13s %s\n", name, fact && fact[0] ? fact : "not in this build");
}

void cli_usage_print_version(FILE *file) {
  fprintf(file, "hooke %s\n%-13s %d\n", hooke_version(), "ABI", (int)hooke_abi());
  print_part(file, "SUNDIALS", "sundials");
  print_part(file, "CHOLMOD", "cholmod");
  print_part(file, "LAPACK", "lapack");
  print_part(file, "GSL", "gsl");
  print_part(file, "ARPACK-NG", "arpack");
  print_part(file, "HDF5", "hdf5");
  print_part(file, "Chart.js", "chartjs");
  print_part(file, "three.js", "threejs");
  print_part(file, "instructions", "instructions");
  fprintf(file, "%-13s %d on this machine\n", "threads", (int)cli_os_processors());
  print_part(file, "licence", "licence");
}
