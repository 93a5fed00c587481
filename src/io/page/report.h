/* Pages of measurements: a common frame, filled with the body, the scripts and the data of one kind. */
#pragma once

#include "io/measurement/measurement_file.h"

/* Members of the JSON object of a page, beside the tables of the measurement. */
int32_t hk_needs_page_add(struct hk_text *data, const hooke_measurement *measurement);
int32_t hk_study_page_add(struct hk_text *data, const hooke_measurement *measurement);
int32_t hk_limit_page_add(struct hk_text *data, const hooke_measurement *measurement);
int32_t hk_modes_page_add(struct hk_text *data, const hooke_measurement *measurement);
int32_t hk_rest_page_add(struct hk_text *data, const hooke_measurement *measurement);
int32_t hk_why_page_add(struct hk_text *data, const hooke_measurement *measurement);
/* Adds "reach": the edge of what is stable by h times frequency and h times decay, as x, y in turn, where a
 * method has one. */
void hk_limit_page_add_reach(struct hk_text *data, const hooke_system *system, const char *method);

/* Adds date, machine and versions. */
void hk_report_add_facts(struct hk_text *data);
