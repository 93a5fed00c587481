/* The common start of verbs: checks files, loads the scene with the given options, and creates its initial
 * state. */
#pragma once

#include "arguments.h"
#include "describe.h"
#include "force.h"

struct cli_setup {
  hooke_scene *read, *scene;  /* the scene as read, and as it is run, which --from-rest makes another one */
  const hooke_system *system; /* the scene's */
  hooke_options *options;     /* the scene's, with the options of the command line */
  hooke_state *state;
  struct cli_force force; /* of the system */
};

/* 1 for a text that begins like a scene, and for standard input; the message of another file tells of itself.
 */
int32_t cli_setup_is_scene(const char *path);

/* Loads, applies options, commits, and refuses to write over a file that it has read; failures are reported
 * and returned as exit code. The caller destroys the set-up in either case. */
int cli_setup_load(const struct cli_arguments *arguments, struct cli_setup *setup);
void cli_setup_destroy(struct cli_setup *setup);

/* Brings the state to where the search for a rest, a measurement, ended. */
void cli_setup_take_rest(struct cli_setup *setup, const hooke_measurement *rest);
/* The scene that starts at the state, committed; the caller owns it. */
int32_t cli_setup_scene_at_state(const struct cli_setup *setup, hooke_scene **scene);

/* The title of the scene, or the name of its file. */
const char *cli_setup_title(const struct cli_arguments *arguments, const struct cli_setup *setup);

/* Refuses `output` (NULL: none) if the scene was read from it, or it cannot be written. */
int cli_setup_check_read(const struct cli_arguments *arguments, const struct cli_setup *setup,
                         const char *output);

/* Reports what a run by `method` (NULL: any) lacks: a duration, a step, the method itself in this build. */
int cli_setup_require(const struct cli_arguments *arguments, const struct cli_setup *setup,
                      const char *method);

/* Makes step, `every` and duration fit one another, as hooke_step_fit() does, and reports each change in a
 * line; with --strict nothing is changed. That there is no step is reported, or with `may_lack` left to what
 * comes. */
int cli_setup_fit(const struct cli_arguments *arguments, struct cli_setup *setup, int32_t may_lack);

/* Checks that `output` (NULL: none) is another file than `input`, which is called `what` in the message. */
int cli_setup_check_apart(const struct cli_arguments *arguments, const char *input, const char *what,
                          const char *output);
/* Before any work: checks that this build can write `output` (NULL: none), a file of HDF5. */
int cli_setup_check_output(const struct cli_arguments *arguments, const char *output);

/* Refuses `file` (NULL: none), given to `flag`, if it ends like another kind than the option writes, and says
 * what writes that kind; with the scene it is known whether it can be written. */
int cli_setup_check_ending(const struct cli_arguments *arguments, const char *flag, const char *file);
/* The same for --report, which also needs the drawing library in this build. */
int cli_setup_check_report(const struct cli_arguments *arguments);
/* Writes the page of --report, if it was given, with the title of the scene. Returns `code`, or that of a
 * page that could not be written. */
int cli_setup_write_report(const struct cli_arguments *arguments, const struct cli_setup *setup,
                           hooke_measurement *measurement, int code);
