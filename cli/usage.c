#include "usage.h"
#include "print.h"
#include "report.h"
#include "unit.h"

#include <ctype.h>
#include <string.h>
#include <unistd.h>

enum { DOC_COLUMN = 28, WIDTH = 100, DOC_SIZE = 1024 };

static const char exit_codes[] =
    "exit codes: 0 done, 2 wrong usage, 3 bad input, 4 diverged, 5 could not read or write,\n"
    "            6 not in this build, 130 interrupted\n";

void hooke_usage_print_all(FILE *file, const struct hooke_verb *const *verbs) {
  fputs("usage: hooke VERB SCENE [options]\n\n"
        "Integrates mass-spring systems and says how accurate each method is for what it costs.\n\n"
        "verbs:\n",
        file);
  for (; *verbs; verbs++)
    fprintf(file, "  %-10s %s\n", (*verbs)->name, (*verbs)->summary);
  fputs("\nmethods:\n", file);
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    fprintf(file, "  %-17s %s%s\n", name, hooke_method_summary(name),
            hooke_method_is_built(name) ? "" : " (not in this build)");
  }
  fprintf(file,
          "\nhooke VERB --help   the options of a verb, with units and defaults\n"
          "hooke --version     the version, and what it was built with\n\n%s",
          exit_codes);
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
  hooke_print_wrapped(file, DOC_COLUMN, DOC_COLUMN, WIDTH, doc);
}

static void print_option(FILE *file, const struct hooke_argument *argument) {
  const hooke_options *table = argument->table;
  const char *type = hooke_options_row(table, argument->row, "type");
  const char *unit = hooke_options_row(table, argument->row, "unit");
  const char *allowed = hooke_options_row(table, argument->row, "allowed");
  const char *fallback = hooke_options_row(table, argument->row, "default");
  char value[HOOKE_FLAG_SIZE];
  char doc[DOC_SIZE], methods[DOC_SIZE / 4] = "";
  size_t length = strcspn(type, " ");
  if (length >= sizeof value) length = sizeof value - 1;
  for (size_t i = 0; i < length; i++)
    value[i] = (char)toupper((unsigned char)type[i]);
  value[length] = '\0';
  if (strcmp(argument->name, "method") == 0 || strcmp(argument->name, "methods") == 0) {
    hooke_report_methods(methods, sizeof methods);
    allowed = methods;
  }
  snprintf(doc, sizeof doc, "%s%s%s%s; %s; default: %s", unit[0] ? "[" : "", unit, unit[0] ? "] " : "",
           hooke_options_row(table, argument->row, "doc"), allowed, fallback[0] ? fallback : "none");
  print_row(file, 0, argument->flag, strcmp(type, "flag") == 0 ? NULL : value, doc);
}

/* The rows of a table, after `title`. */
static void print_table(FILE *file, const struct hooke_arguments *arguments, const hooke_options *table,
                        const char *title) {
  if (!table) return;
  fprintf(file, "\n%s:\n", title);
  for (int32_t i = 0; i < arguments->count; i++) {
    if (arguments->all[i].table == table) print_option(file, &arguments->all[i]);
  }
}

void hooke_usage_print_verb(FILE *file, const struct hooke_arguments *arguments) {
  const struct hooke_verb *verb = arguments->verb;
  fprintf(file, "usage: hooke %s %s [options]\n\n", verb->name, verb->input ? verb->input : "SCENE");
  hooke_print_wrapped(file, 0, 0, WIDTH, verb->text);
  fputs("\noptions:\n", file);
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct hooke_verb_row *own = arguments->all[i].own;
    if (own) print_row(file, own->letter, own->name, own->value, own->doc);
  }
  char title[HOOKE_FLAG_SIZE], times[HOOKE_UNIT_LIST_SIZE], lengths[HOOKE_UNIT_LIST_SIZE];
  snprintf(title, sizeof title, "options of the %s", verb->name);
  print_table(file, arguments, arguments->more, title);
  if (!verb->input) {
    print_table(file, arguments, arguments->run,
                "options of the run, instead of what the scene's \"run\" says (defaults: where neither says "
                "anything)");
    fprintf(file, "\nnumbers in [s] and [m] may have a unit: %s; %s\n", hooke_unit_list("s", times),
            hooke_unit_list("m", lengths));
  }
  fprintf(file, "\n%s", exit_codes);
}

/* ---- version ---- */

static void print_part(FILE *file, const char *name, const char *what) {
  const char *fact = hooke_build_fact(what);
  fprintf(file, "%-13s %s\n", name, fact && fact[0] ? fact : "not in this build");
}

void hooke_usage_print_version(FILE *file) {
  long threads = sysconf(_SC_NPROCESSORS_ONLN);
  fprintf(file, "hooke %s\n%-13s %d\n", hooke_version(), "ABI", (int)hooke_abi());
  print_part(file, "SUNDIALS", "sundials");
  print_part(file, "CHOLMOD", "cholmod");
  print_part(file, "GSL", "gsl");
  print_part(file, "ARPACK-NG", "arpack");
  print_part(file, "HDF5", "hdf5");
  print_part(file, "jansson", "jansson");
  print_part(file, "Chart.js", "chartjs");
  print_part(file, "three.js", "threejs");
  print_part(file, "instructions", "instructions");
  fprintf(file, "%-13s %ld on this machine\n", "threads", threads > 0 ? threads : 1);
  print_part(file, "licence", "licence");
}
