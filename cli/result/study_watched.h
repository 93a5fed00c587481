/* What a study gave of watched quantities, and of its ensemble. */
#ifndef HOOKE_CLI_STUDY_WATCHED_H
#define HOOKE_CLI_STUDY_WATCHED_H

#include "study_results.h"

/* The errors of what is watched, a line a row of the study; nothing if nothing is. */
void cli_study_watched_print(const struct cli_study_results *results, int32_t method_width);
/* Means, spreads and biases where the motion cannot be judged; or what asks for them. */
void cli_study_statistics_print(const struct cli_study_results *results, int32_t method_width);

/* Quantities that the table "statistics" has: its rows are those of each method, the reference first, times these. */
int64_t cli_study_quantity_count(const hooke_measurement *study);

#endif
