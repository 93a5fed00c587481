#include "form.h"
#include "os.h"

/* clang-format off */
#define OPTION             "  <letter:-<letter>, ><!letter:    >--<name><value: <value>><to/28><doc>\n"
#define OPTIONS(of, title) "<options:<" of ":<first:\n" title ":\n>" \
                           "<family:  <family>: <family_doc>\n>" OPTION ">>"
#define NAMES(of, title)   "<options:<" of ":<first:\n<to/2>" title ":> <member:<member>><!member:--<name>>>>"
#define KINDS              "\nkinds:\n<kinds:  <name><to/13><doc>\n>" \
                           "\nhooke <verb> KIND --help   the options of a kind, with units and defaults\n"
#define EXAMPLE            "<options:<!later:<command>>>"
#define EXITS              "\n<to/12>exit codes:<exits:<later:,> <name> <doc>>\n"
#define USAGE              "usage: hooke <verb> <kind><!kind:<operand>> [options]\n\n"

static const char all[] =
    "usage: hooke VERB SCENE [options]\n\n"
    "<sentence>.\n\n"
    "verbs:\n"
    "<verbs:  <name><tab/13><doc>\n>"
    "\nmethods:\n"
    "<methods:  <name><tab/20><doc><missing: (not in this build)>\n>"
    "\nhooke VERB --help   the options of a verb, with units and defaults\n\n"
    "in place of a verb:\n"
    "<rows:" OPTION ">" EXITS;

static const char complete[] =
    USAGE
    "<to/0><text>\n"
    "<bare:" KINDS ">"
    "<!bare:"
    "\noptions:\n"
    "<options:<own:" OPTION "><shared:" OPTION ">>"
    OPTIONS("part", "options of a <kind>")
    OPTIONS("more", "options of the <takes_kind:scene><!takes_kind:<verb>>")
    OPTIONS("run", "options of the run, <kind:for the scene to hold (defaults: where it does not)><!kind:"
                   "instead of what the scene's \"run\" says (defaults: where neither says anything)>")
    OPTIONS("limits", "what a scene may do")
    "<!input:\nnumbers may have a unit:\n<options:<units:  <units>\n>>>"
    ">"
    "<kind:\nexample:\n  " EXAMPLE "\n>" EXITS;

static const char names[] =
    USAGE
    "<sentence>.\n"
    "<bare:" KINDS ">"
    "<!bare:"
    "\n<to/2>options:<options:<own: --<name>><shared: --<name>>>"
    NAMES("part", "<kind>") NAMES("more", "<own_table>") NAMES("run", "run") NAMES("limits", "limits")
    "\n\nexample: <kind:" EXAMPLE "><!kind:<example>>\n"
    "hooke <verb><kind: <kind>> --help all   what they mean, with units and defaults\n"
    ">";
/* clang-format on */

static int print(FILE *file, const char *text, const struct cli_program *program,
                 const struct cli_arguments *arguments) {
  static const char *const escapes[] = {NULL};
  const struct cli_form form = {text, escapes, 0};
  return cli_form_print(file, &form, program, arguments);
}

int cli_usage_print(FILE *file, const struct cli_program *program) {
  return print(file, all, program, NULL);
}

int cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments) {
  return print(file, arguments->help > 1 ? complete : names, NULL, arguments);
}

/* ---- version ---- */

static void print_part(const char *name, const char *what) {
  const char *fact = hooke_build_fact(what);
  printf("%-13s %s\n", name, fact && fact[0] ? fact : "not in this build");
}

int cli_version_print(const struct cli_program *program, const char *value) {
  (void)program, (void)value;
  printf("hooke %s\n%-13s %d\n", hooke_version(), "ABI", (int)hooke_abi());
  print_part("SUNDIALS", "sundials");
  print_part("CHOLMOD", "cholmod");
  print_part("LAPACK", "lapack");
  print_part("GSL", "gsl");
  print_part("ARPACK-NG", "arpack");
  print_part("HDF5", "hdf5");
  print_part("Chart.js", "chartjs");
  print_part("three.js", "threejs");
  print_part("instructions", "instructions");
  printf("%-13s %d on this machine\n", "threads", (int)cli_os_processors());
  print_part("licence", "licence");
  return HOOKE_EXIT_DONE;
}
