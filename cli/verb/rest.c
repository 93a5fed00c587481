/* hooke rest: where a scene is at rest. */
#include "measured.h"
#include "print.h"
#include "report.h"
#include "results.h"

#include <math.h>
#include <string.h>

enum { INDENT = 12 };

/* ---- words ---- */

static void print_watched(const hooke_measurement *found) {
  for (int64_t row = 0; row < hooke_measurement_row_count(found, "watched"); row++)
    if (!isnan(hooke_measurement_number(found, "watched", row, "value")))
      cli_say("%-24s%.6g %s\n", hooke_measurement_text(found, "watched", row, "quantity"),
              hooke_measurement_number(found, "watched", row, "value"),
              hooke_measurement_text(found, "watched", row, "unit"));
}

static void print_words(const struct cli_results *r) {
  cli_say("%s\n", cli_setup_title(r->arguments, &r->setup));
  cli_claims_print(r->arguments, r->found, INDENT, NULL);
  print_watched(r->found);
  if (cli_arguments_text(r->arguments, "final")) cli_print_final(r->setup.state);
}

static int32_t print_json(const struct cli_results *r) {
  cli_print_json("{'scene': %s", r->arguments->scene);
  const int32_t status = cli_print_members(", ", r->found, NULL, 0);
  if (cli_arguments_text(r->arguments, "final")) cli_print_final_json(r->setup.state);
  cli_print_json("}\n");
  return status;
}

static int32_t is_at_rest(const struct cli_results *r) {
  const char *status = cli_text(r->found, "rest", "status");
  return status && strcmp(status, "at rest") == 0;
}

/* Writes the scene that starts there, if there is a rest. */
static int write_scene(struct cli_results *r) {
  const char *output = cli_arguments_text(r->arguments, "output");
  hooke_scene *scene = NULL;
  if (!output || !is_at_rest(r)) return HOOKE_EXIT_DONE;
  int32_t status = cli_setup_scene_at_state(&r->setup, &scene);
  if (status == HOOKE_OK)
    status = hooke_scene_write(output, hooke_scene_system(scene), hooke_scene_text(scene, "title"),
                               hooke_scene_run_options(scene));
  hooke_scene_destroy(scene);
  if (status == HOOKE_OK) return HOOKE_EXIT_DONE;
  cli_report_words(r->arguments, "%s", hooke_last_error());
  return cli_exit_code(status);
}

static int tell(struct cli_results *r) {
  cli_setup_take_rest(&r->setup, r->found);
  int code = write_scene(r);
  if (!r->arguments->json)
    print_words(r);
  else if (print_json(r) != HOOKE_OK)
    code = cli_report_missing_words(r->arguments);
  cli_print_flush();
  if (r->outcome == HOOKE_STOPPED) return cli_report(r->arguments, HOOKE_EXIT_INTERRUPTED, "interrupted");
  if (code == HOOKE_EXIT_DONE && !is_at_rest(r)) code = HOOKE_EXIT_NOT_MET;
  return cli_setup_write_report(r->arguments, &r->setup, r->found, code);
}

static const struct cli_verb_row own_rows[] = {
    {"output", 'o', "REST.json", "writes the scene, its parts kept, that starts at rest, replacing it"},
    {"report", 0, "FILE.html",
     "writes the scene at rest, with its tensions and modes, as one page to read offline, replacing it"},
    {"final", 0, NULL, "prints the position [m] and velocity [m/s] of every particle at rest, too"},
};

const struct cli_verb cli_verb_rest = {
    .name = "rest",
    .summary = "where a scene is at rest, and whether its energy is least there",
    .text =
        "Moves the particles from where they are to where all forces are in equilibrium, at the time of the "
        "start and without motion: what the scene prescribes in time stays at its value there, and friction "
        "is left out. Says how large a force remains, whether small displacements raise the energy, and "
        "what is watched. The exit code is 7 if there is no rest, or none was found.",
    .example = "hooke rest cloth.json",
    HOOKE_VERB_ROWS(own_rows),
    .options = "rest",
    .takes_no_run = 1,
    .ready = cli_results_at,
    .tell = tell,
};
