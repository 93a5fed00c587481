/* What a study gave of watched quantities, and of its ensemble. */
#ifndef HOOKE_CLI_STUDY_WATCHED_H
#define HOOKE_CLI_STUDY_WATCHED_H

#include "study_results.h"

/* The errors of what is watched, a line a row of the study; nothing if nothing is. */
void cli_study_watched_print(const struct cli_study_results *results, int32_t method_width);
/* Means, spreads and biases where the motion cannot be judged; or what asks for them. */
void cli_study_statistics_print(const struct cli_study_results *results, int32_t method_width);

/* "watched": [...] of the reference, with agreements, and of a row, with errors; nothing if nothing is
 * watched. */
void cli_study_watched_print_reference(struct cli_json *json, const hooke_study *study);
void cli_study_watched_print_row(struct cli_json *json, const void *study, int64_t row);
/* "statistics": {...} or null */
void cli_study_statistics_print_json(struct cli_json *json, const struct cli_study_results *results);

/* hooke_study_reference() of "<what>:<number>", "" where there is none, and of "unit:<quantity>";
 * hooke_study_number() of "<what>:<quantity>", with row -1 hooke_study_figure(). */
enum { HOOKE_STUDY_WORD_SIZE = 600 };
const char *cli_study_nth(const hooke_study *study, const char *what, int64_t number);
const char *cli_study_unit(const hooke_study *study, const char *quantity);
double cli_study_of(const hooke_study *study, int64_t row, const char *what, const char *quantity);

#endif
