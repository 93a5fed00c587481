/* Results of a study, printed in words. */
#ifndef HOOKE_CLI_STUDY_RESULTS_H
#define HOOKE_CLI_STUDY_RESULTS_H

#include "setup.h"

struct cli_study_results {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *study;
  int32_t once;       /* 1: each method runs once */
  int32_t outcome;    /* of measuring */
  int32_t trusts_all; /* 1: the reference, and with it every error, is trusted up to the end of the run */
  char *command;      /* the recommended run, or the closest one; NULL: none */
};

void cli_study_results_print(const struct cli_study_results *results);

#endif
