/* What every verb starts from: the scene with the options given, committed, and its initial state. */
#ifndef HOOKE_CLI_SETUP_H
#define HOOKE_CLI_SETUP_H

#include "arguments.h"

struct hooke_setup {
  hooke_scene *scene;
  const hooke_system *system; /* the scene's */
  hooke_options *options;     /* the scene's, with what was given on the command line */
  hooke_state *state;
};

/* Loads, applies, commits; failures are reported and come back as exit code. The caller destroys the set-up
 * in either case. */
int hooke_setup_load(const struct hooke_arguments *arguments, struct hooke_setup *setup);
void hooke_setup_destroy(struct hooke_setup *setup);

/* Reports what a run by `method` lacks: a duration, a step, the method itself in this build. */
int hooke_setup_require(const struct hooke_arguments *arguments, const struct hooke_setup *setup,
                        const char *method);

/* Before any work: this build can write FILE of -o, and it is not the scene itself. */
int hooke_setup_check_output(const struct hooke_arguments *arguments, const char *output);

#endif
