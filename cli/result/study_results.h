/* Results of a study, printed in words and as JSON. */
#ifndef HOOKE_CLI_STUDY_RESULTS_H
#define HOOKE_CLI_STUDY_RESULTS_H

#include "methods.h"
#include "rows.h"
#include "setup.h"

struct cli_study_results {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  struct cli_methods methods;
  hooke_measurement *study;
  int32_t interrupted;
  char *command; /* the recommended run, or the closest one; NULL: none */
};

/* 1 for a study that runs each method once. */
int32_t cli_study_results_once(const struct cli_study_results *results);

/* The rows as a table. */
struct cli_rows cli_study_results_rows(const struct cli_study_results *results);

/* 1 if there is a recommendation: one that meets the wanted error or, in a study that was completed, the
 * closest to it. */
int32_t cli_study_results_recommend(const struct cli_study_results *results);

void cli_study_results_print(const struct cli_study_results *results);
void cli_study_results_print_json(const struct cli_study_results *results);

/* 1 if the reference, and with it every error, is trusted up to the end of the run. */
int32_t cli_study_results_trust_all(const hooke_measurement *study);

#endif
