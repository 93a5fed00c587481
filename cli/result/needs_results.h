/* Results of `hooke needs`, for the files that print them. */
#ifndef HOOKE_CLI_NEEDS_RESULTS_H
#define HOOKE_CLI_NEEDS_RESULTS_H

#include "setup.h"

struct cli_needs_results {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *needs;
  int32_t refine; /* 1: resolutions instead of ingredients */
  char *command;  /* command that runs it; NULL: none */
};

void cli_needs_results_print(const struct cli_needs_results *results);

#endif
