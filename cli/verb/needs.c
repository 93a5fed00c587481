/* hooke needs: the ingredients that a scene needs for a wanted accuracy, and a lean scene without the rest.
 */
#include "claims.h"
#include "os.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check(const struct cli_arguments *arguments) {
  const char *output = cli_arguments_text(arguments, "output");
  if (!cli_arguments_text(arguments, "want")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "no want: give the error that you can live with, such as --want 1mm");
  }
  if (output && cli_arguments_asks(arguments, "refine")) {
    return cli_report(
        arguments, HOOKE_EXIT_USAGE,
        "-o and --refine: a lean scene is written from the table of ingredients; leave one out");
  }
  return output ? cli_setup_check_ending(arguments, "-o", output) : HOOKE_EXIT_DONE;
}

static int require(struct cli_results *results) {
  return cli_setup_require(results->arguments, &results->setup, NULL);
}

/* ---- the lean scene ---- */

/* HOOKE_NO_MEMORY */
static int32_t make_command(const char *file, char **command) {
  size_t size;
  FILE *stream = cli_os_open_text(command, &size);
  if (stream) {
    fputs("hooke run ", stream);
    cli_print_quoted(stream, file);
  }
  return cli_print_end(stream, command);
}

static int write_lean(struct cli_results *results) {
  const char *output = cli_arguments_text(results->arguments, "output");
  const hooke_system *lean = hooke_needs_lean(results->found);
  if (!output || !lean) return HOOKE_EXIT_DONE;
  const int32_t status = hooke_scene_write(output, lean, hooke_scene_text(results->setup.scene, "title"),
                                           hooke_needs_lean_run(results->found));
  if (status != HOOKE_OK) {
    cli_report_words(results->arguments, "%s", hooke_last_error());
    return cli_exit_code(status);
  }
  int32_t made = make_command(output, &results->command);
  if (made == HOOKE_OK) made = hooke_measurement_label(results->found, "command", results->command);
  if (made == HOOKE_OK) made = hooke_measurement_label(results->found, "output", output);
  return made == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_missing_words(results->arguments);
}

/* Results are printed also when a file fails. */
static int tell(struct cli_results *results) {
  int code = write_lean(results);
  if (results->arguments->json && cli_claims_print_json(results->arguments, NULL, results->found) != HOOKE_OK)
    code = cli_report_missing_words(results->arguments);
  if (!results->arguments->json) cli_needs_results_print(results);
  cli_print_flush();
  code = cli_setup_write_report(results->arguments, &results->setup, results->found, code);
  if (results->outcome != HOOKE_STOPPED) return code;
  cli_report_words(results->arguments, "interrupted; kept: what is known so far");
  return code == HOOKE_EXIT_DONE ? HOOKE_EXIT_INTERRUPTED : code;
}

static int do_needs(const struct cli_arguments *arguments) {
  return cli_results_make(arguments, "needs", check, require, tell);
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "LEAN.json", "writes the lean scene, replacing it"},
    {"report", 0, "FILE.html", "writes table and pictures as one page to read offline, replacing it"},
};

const struct cli_verb cli_verb_needs = {
    .name = "needs",
    .summary = "what a scene needs for a wanted accuracy, and a lean scene without the rest",
    .text = "Leaves out one ingredient after another (spring groups and families, damping, drag, gravity, "
            "idle springs, what touches nothing, resistance to compression, the deformation of parts, which "
            "become rigid bodies, half the resolution), runs each variant with errors of the time step a "
            "tenth of --want, and prints by how much the watched positions change and what it saves. Then "
            "leaves out together what is not needed, checks the lean scene against the full one, and "
            "compares what each takes at its cheapest within --want. Ctrl-C prints what is known so far.",
    .example = "hooke needs cloth.json --want 1cm -o lean.json",
    HOOKE_VERB_ROWS(own_rows),
    .options = "needs",
    .without = "step checkpoint",
    .function = do_needs,
};
