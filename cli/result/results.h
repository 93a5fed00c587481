/* What a verb measures of a scene, and the way that these verbs go. */
#pragma once

#include "setup.h"

enum { HOOKE_MOST_METHODS = 32 };

struct cli_results {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  const char *method[HOOKE_MOST_METHODS]; /* those of --methods a,b,c, or all of this build; all different */
  int32_t method_count;
  hooke_state *from; /* where the measurement starts; NULL: at the start of the scene */
  hooke_measurement *found;
  int32_t outcome; /* of measuring */
  char *command;   /* that the results lead to, for free(); NULL: none */
};

/* Checks --methods, the other arguments, the file of -o and the page of --report, loads the scene, makes it
 * ready, measures by the verb's own options, and tells, of failures too. Returns the exit code. */
int cli_results_make(const struct cli_arguments *arguments, const struct cli_verb *verb);

/* The state that --at names, FILE:FRAME, or FILE alone for its last frame; the start without it. */
int cli_results_at(struct cli_results *results);
