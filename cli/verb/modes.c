/* hooke modes: frequencies, damping and shapes of the small motions about a state. */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <math.h>
#include <stdio.h>

enum { INDENT = 14, NAMED = 2 };

static const struct cli_column columns[] = {{"omega", "omega", "[rad/s]", 12, "%.6g", NULL, NULL, 0},
                                            {"frequency", "frequency", "[Hz]", 12, "%.6g", NULL, NULL, 0},
                                            {"growth", "growth", "[1/s]", 12, "%.6g", NULL, NULL, 0},
                                            {"damping_ratio", "damping", "ratio", 11, "%.4g", NULL, NULL, 0},
                                            {"mass_x", "mass along x", "[kg]", 14, "%.4g", NULL, NULL, 0},
                                            {"mass_y", "y", "[kg]", 11, "%.4g", NULL, NULL, 0},
                                            {"mass_z", "z", "[kg]", 11, "%.4g", NULL, NULL, 0},
                                            {.what = NULL}};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static double size_of(const hooke_measurement *m, int64_t row) {
  return fabs(hooke_measurement_number(m, "groups", row, "share"));
}

/* The groups with the largest shares. */
static void print_groups(const hooke_measurement *m, int64_t mode, int64_t groups) {
  double below = INFINITY;
  for (int k = 0; k < NAMED; k++) {
    int64_t most = -1;
    for (int64_t g = mode * groups; g < (mode + 1) * groups; g++) {
      const double size = size_of(m, g);
      if (size >= 0.005 && size < below && (most < 0 || size > size_of(m, most))) most = g;
    }
    if (most < 0) return;
    below = size_of(m, most);
    cli_say("%s%s %.0f %%", k == 0 ? "   " : ", ", hooke_measurement_text(m, "groups", most, "name"),
            100.0 * hooke_measurement_number(m, "groups", most, "share"));
  }
}

static void print_table(const hooke_measurement *m) {
  const int64_t count = hooke_measurement_row_count(m, "rows");
  const int64_t groups = count > 0 ? hooke_measurement_row_count(m, "groups") / count : 0;
  struct cli_column shown[COLUMNS];
  cli_rows_known(m, columns, shown);
  for (int line = 0; line < 2; line++) {
    printf(line == 0 ? "\nmode" : "\n    ");
    for (const struct cli_column *column = shown; column->what; column++)
      printf("%*s", column->width, line == 0 ? column->head : column->unit);
    printf(line == 0 ? "   stiffness" : "");
  }
  for (int64_t row = 0; row < count; row++) {
    printf("\n%4lld", (long long)row);
    for (const struct cli_column *column = shown; column->what; column++)
      cli_rows_print_as(column->width, hooke_measurement_number(m, "rows", row, column->what), column->format,
                        NULL, NULL);
    print_groups(m, row, groups);
  }
  printf("\n");
}

static int tell(struct cli_results *l) {
  char text[HOOKE_NUMBER_SIZE];
  int code = HOOKE_EXIT_DONE;
  if (l->arguments->json) {
    if (cli_claims_print_json(l->arguments, "scene", l->found) != HOOKE_OK)
      code = cli_report_missing_words(l->arguments);
  } else {
    cli_say("%s, at t = %s s\n", cli_setup_title(l->arguments, &l->setup),
            cli_format_rounded(cli_number(l->found, "modes", "time"), text));
    cli_claims_print(l->arguments, l->found, INDENT, NULL);
    if (hooke_measurement_row_count(l->found, "rows") > 0) print_table(l->found);
  }
  cli_print_flush();
  if (l->outcome == HOOKE_STOPPED) {
    cli_report_words(l->arguments, "interrupted before the modes were found");
    return HOOKE_EXIT_INTERRUPTED;
  }
  return cli_setup_write_report(l->arguments, &l->setup, l->found, code);
}

static const struct cli_verb_row own_rows[] = {
    HOOKE_AT,
    HOOKE_FROM_REST,
    {"report", 0, "FILE.html",
     "writes the modes as one page to read offline, on which they play, replacing it"},
};

const struct cli_verb cli_verb_modes = {
    .name = "modes",
    .summary = "frequencies, damping ratios and shapes of the small motions about a state",
    .text =
        "Finds the lowest modes of free motion about the positions of a state, from the stiffness as it is "
        "there: compressed springs push aside, slack ones do nothing, gravity and tensions turn bodies. "
        "Modes that grow come first. Motions without stiffness are counted and named, not listed. The "
        "state should be at rest; a message says what force is left.",
    .example = "hooke modes cloth.json --count 4",
    HOOKE_VERB_ROWS(own_rows),
    .options = "modes",
    .takes_no_run = 1,
    .ready = cli_results_at,
    .tell = tell,
};
