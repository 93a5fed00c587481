/* What every verb starts from: the scene with the options given, committed, and its initial state. */
#ifndef HOOKE_CLI_SETUP_H
#define HOOKE_CLI_SETUP_H

#include "arguments.h"

struct cli_setup {
  hooke_scene *scene;
  const hooke_system *system; /* the scene's */
  hooke_options *options;     /* the scene's, with what was given on the command line */
  hooke_state *state;
};

/* Loads, applies, commits; failures are reported and come back as exit code. The caller destroys the set-up
 * in either case. */
int cli_setup_load(const struct cli_arguments *arguments, struct cli_setup *setup);
void cli_setup_destroy(struct cli_setup *setup);

/* Reports what a run by `method` lacks: a duration, a step, the method itself in this build; the first
 * function a duration alone. */
int cli_setup_require_duration(const struct cli_arguments *arguments, const struct cli_setup *setup);
int cli_setup_require(const struct cli_arguments *arguments, const struct cli_setup *setup,
                      const char *method);

/* `output` (NULL: none) is another file than `input`, which is called `what` in the message. */
int cli_setup_check_apart(const struct cli_arguments *arguments, const char *input, const char *what,
                          const char *output);
/* Before any work: FILE of -o (NULL: none) is not the scene itself, no run is writing it, and for the second
 * function this build can write it as HDF5. */
int cli_setup_check_other_file(const struct cli_arguments *arguments, const char *output);
int cli_setup_check_output(const struct cli_arguments *arguments, const char *output);

/* The number in `base` ("m" or "s") given as --`name`, an option of studies, whose table knows what is
 * allowed, where the verb has it as words; `value` stays as it is where it is not given. A failure is
 * reported and gives the exit code. */
int cli_setup_read_study(const struct cli_arguments *arguments, const char *name, const char *base,
                         double *value);

#endif
