/* Results of `hooke needs`, for the files that print them. */
#ifndef HOOKE_CLI_NEEDS_RESULTS_H
#define HOOKE_CLI_NEEDS_RESULTS_H

#include "print.h"
#include "setup.h"

struct cli_needs_results {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *needs;
  int32_t refine;      /* 1: resolutions instead of ingredients */
  const char *written; /* file of the lean scene, NULL: none */
  char *command;       /* command that runs it; NULL: none */
};

enum { HOOKE_NEEDS_TRUST = 256 };
/* States until when the results hold; 0: to the end, and nothing is printed. */
int32_t cli_needs_results_trust(const hooke_measurement *needs, char text[HOOKE_NEEDS_TRUST]);
void cli_needs_results_print(const struct cli_needs_results *results);
void cli_needs_results_print_json(const struct cli_needs_results *results);

#endif
