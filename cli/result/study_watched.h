/* Watched quantities of a study, and its ensemble. */
#ifndef HOOKE_CLI_STUDY_WATCHED_H
#define HOOKE_CLI_STUDY_WATCHED_H

#include "study_results.h"

/* Errors of watched quantities, a line a row of the study; nothing if none are watched. */
void cli_study_watched_print(const struct cli_study_results *results, int32_t method_width);
/* Means, spreads and biases where the motion cannot be judged; or how to obtain them. */
void cli_study_statistics_print(const struct cli_study_results *results, int32_t method_width);

#endif
