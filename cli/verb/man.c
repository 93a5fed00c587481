#include "form.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { DATE_SIZE = 16 };

#define NAMED         ".TP\n\\fB<name>\\fR\n<doc>\n"
#define OPTION        ".TP\n\\fB<letter:\\-<letter>, >\\-\\-<name><value:\\fR \\fI<value>>\\fR\n<doc>\n"
#define COMMAND(what) ".PP\n.RS 4\n.EX\n<" what ">\n.EE\n.RE\n"

/* clang-format off */
static const char page[] =
    ".SH NAME\n"
    "hooke \\- <summary>\n"
    ".SH SYNOPSIS\n"
    "<verbs:\\fBhooke <verb>\\fR \\fI<operand>\\fR\n[options]\n.br\n>"
    "<rows:<later:.br\n>\\fBhooke \\-\\-<name><value: <value>>\\fR\n>"
    ".SH DESCRIPTION\n"
    "<text>\n"
    "<verbs:" NAMED ">"
    ".SS Methods\n"
    "<methods:" NAMED ">"
    ".SH VERBS\n"
    "<verbs:"
    ".SS hooke <verb> <operand> [options]\n"
    "<text>\n"
    "<options:<own:" OPTION ">>"
    "<options:<more:" OPTION ">>"
    "<without:.PP\nOf the options of a run it does not take: <without>.\n>"
    "<kinds:"
    ".SS hooke <verb> <kind> [options]\n"
    "Makes a <kind>: <doc>.\n"
    "<options:<part:" OPTION ">>"
    "<options:<!later:.PP\nFor example:\n" COMMAND("command") ">>"
    ">>"
    ".SH OPTIONS\n"
    "In place of a verb:\n"
    "<rows:" OPTION ">"
    ".PP\n"
    "All verbs take:\n"
    "<common:"
    "<options:<shared:" OPTION ">>"
    ".SS Options of a run\n"
    "Verbs that take a scene take these, too, instead of what the scene\\(aqs \"run\" says; defaults are "
    "for where neither says anything. make writes them there.\n"
    "<options:<run:" OPTION ">>"
    ".PP\n"
    "A number in [s], [m], [kg], [N] and so on may have another unit: 5ms, 0.5 cm, 200g, 2kN. The message "
    "about an unknown unit lists those that are allowed.\n"
    ".SS What a scene may do\n"
    "Verbs that take a scene refuse one that needs more memory than there is, or names files outside its "
    "folder, unless told otherwise.\n"
    "<options:<limits:" OPTION ">>"
    ">"
    ".SH EXIT STATUS\n"
    "<exits:" NAMED ">"
    ".SH FILES\n"
    ".TP\n\\fB*.json\\fR\n"
    "Scenes: particles, springs, parts and the options of a run, in JSON. A scene \\- is standard input.\n"
    ".TP\n\\fB*.h5\\fR\n"
    "Trajectories and comparisons, in HDF5 after the H5MD convention. A trajectory stands for its scene, "
    "with the options of its run, wherever a scene is taken.\n"
    ".TP\n\\fB*.html\\fR\n"
    "Reports, each one page to read offline.\n"
    ".TP\n\\fB*.csv\\fR\n"
    "Rows of a study.\n"
    ".SH EXAMPLES\n"
    "<verbs:<example:<later:.PP\n><doc>\n" COMMAND("example") ">>"
    ".SH SEE ALSO\n"
    "h5dump(1), python3(1)\n";
/* clang-format on */

int cli_man_print(const struct cli_program *program, const char *value) {
  static const char *const escapes[] = {"\\\\e", "-\\-", "'\\(aq", "^\\(ha", "~\\(ti", "`\\(ga", NULL};
  static const struct cli_form form = {page, escapes, 1};
  const char *epoch = getenv("SOURCE_DATE_EPOCH");
  const time_t now = epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
  char date[DATE_SIZE] = "";
  struct tm parts;
  (void)value;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d", &parts);
  printf(".TH HOOKE 1 %s \"hooke %s\" \"User Commands\"\n", date, hooke_version());
  return cli_form_print(stdout, &form, program, NULL);
}
