/* What a report of a study is made of. */
#ifndef HOOKE_IO_REPORT_H
#define HOOKE_IO_REPORT_H

#include "hooke/study.h"
#include "io/text.h"

/* Adds all that the page shows as one JSON object; `scene` and `command` as in hooke_study_write_report(). */
void hooke_report_add_data(struct hooke_text *text, const hooke_study *study, const char *scene,
                           const char *command);

#endif
