/* hooke rest: where a scene is at rest. */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INDENT = 12 };

static int make_ready(struct cli_results *r) {
  r->from = r->setup.state;
  return HOOKE_EXIT_DONE;
}

/* ---- words ---- */

static void print_watched(const hooke_measurement *found) {
  for (int64_t row = 0; row < hooke_measurement_row_count(found, "watched"); row++)
    cli_say("%-24s%.6g %s\n", hooke_measurement_text(found, "watched", row, "quantity"),
            hooke_measurement_number(found, "watched", row, "value"),
            hooke_measurement_text(found, "watched", row, "unit"));
}

static void print_words(const struct cli_results *r) {
  cli_say("%s\n", cli_setup_title(r->arguments, &r->setup));
  cli_claims_print(r->arguments, r->found, INDENT, NULL);
  print_watched(r->found);
}

static int tell(struct cli_results *r) {
  int code = HOOKE_EXIT_DONE;
  const char *status = cli_text(r->found, "rest", "status");
  if (!r->arguments->json)
    print_words(r);
  else if (cli_claims_print_json(r->arguments, "scene", r->found) != HOOKE_OK)
    code = cli_report_missing_words(r->arguments);
  cli_print_flush();
  if (r->outcome == HOOKE_STOPPED) return cli_report(r->arguments, HOOKE_EXIT_INTERRUPTED, "interrupted");
  if (code == HOOKE_EXIT_DONE && (!status || strcmp(status, "at rest") != 0)) code = HOOKE_EXIT_NOT_MET;
  return code;
}

static int do_rest(const struct cli_arguments *arguments) {
  return cli_results_make(arguments, "rest", NULL, make_ready, tell);
}

static const struct cli_verb_row own_rows[] = {
    {"final", 0, NULL, "prints the position [m] of every particle at rest, too"},
};

const struct cli_verb cli_verb_rest = {
    .name = "rest",
    .summary = "where a scene is at rest, and whether its energy is least there",
    .text =
        "Moves the particles from where they are to where all forces are in equilibrium, at the time of the start "
        "and without motion: what the scene prescribes in time stays at its value there, and friction is left out. "
        "Says how large a force remains, whether small displacements raise the energy, and what is watched. The "
        "exit code is 7 if there is no rest, or none was found.",
    .example = "hooke rest cloth.json",
    HOOKE_VERB_ROWS(own_rows),
    .options = "rest",
    .without = "method step duration every checkpoint rtol atol threads",
    .function = do_rest,
};
