/* hooke compare: a study that runs each method once. */
#include "arguments.h"
#include "report.h"
#include "results.h"

static int do_compare(const struct cli_arguments *arguments) {
  const int32_t status = hooke_options_set_number(arguments->more, "once", 1.0);
  return status == HOOKE_OK ? cli_results_make(arguments, &cli_verb_study)
                            : cli_report_status(arguments, status);
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "FILE",
     "writes the rows to FILE.csv, or tables and, in runs made again, all motions to FILE.h5, replacing it"},
    {"report", 0, "FILE.html", "writes diagrams and table as one page to read offline, replacing it"},
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_compare = {
    .name = "compare",
    .summary = "the scene by each method against a reference that checks itself",
    .text = "Runs the scene by each method, makes a reference by two tight runs that check each other, "
            "and prints how far each method is from it over time, as long as the two agree, how "
            "far its energy drifts, and what it costs. A method that diverges stays as a row. "
            "Tables are rounded; --json and FILE have every digit.",
    .example = "hooke compare cloth.json --methods symplectic-euler,cvode-adams",
    HOOKE_VERB_ROWS(own_rows),
    .options = "study",
    .hidden = "points steps tolerances want budget ensemble seed once",
    .without = "method checkpoint",
    .function = do_compare,
};
