/* Contents of the pages of measurements, as members of a JSON object; the context is the measurement. */
#ifndef HOOKE_IO_PAGE_MEASUREMENT_PAGES_H
#define HOOKE_IO_PAGE_MEASUREMENT_PAGES_H

#include "hooke/system.h"
#include "io/file/text.h"

void hk_needs_page_add(struct hk_text *data, const void *measurement);
void hk_study_page_add(struct hk_text *data, const void *measurement);
void hk_why_page_add(struct hk_text *data, const void *measurement);
/* Adds "reach": the edge of what is stable by h times frequency and h times decay, as x, y in turn, where a
 * method has one. */
void hk_limit_page_add_reach(struct hk_text *data, const hooke_system *system, const char *method);
void hk_limit_page_add(struct hk_text *data, const void *measurement);

#endif
