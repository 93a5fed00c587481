/* What is watched in a study, and its statistics, as JSON for its page. */
#ifndef HOOKE_IO_TABLE_STUDY_WATCHED_H
#define HOOKE_IO_TABLE_STUDY_WATCHED_H

#include "hooke/study.h"
#include "io/file/text.h"

/* "watched": of a row the errors, with row -1 name, unit and agreement of each quantity. */
void hk_study_watched_add(struct hk_text *text, const hooke_study *study, int64_t row);
/* "statistics": {...}, or null. */
void hk_study_statistics_add(struct hk_text *text, const hooke_study *study);

#endif
