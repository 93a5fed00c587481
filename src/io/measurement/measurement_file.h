/* Measurements as files. */
#pragma once

#include "io/file/text.h"
#include "measure/measurement.h"

/* Option table of a kind; NULL for an unknown kind. */
const struct hk_option_table *hk_measurement_options(const char *kind);

int32_t hk_measurement_write_csv(const hooke_measurement *measurement, const char *path);
int32_t hk_measurement_write_json(const hooke_measurement *measurement, const char *path);
int32_t hk_measurement_write_h5(const hooke_measurement *measurement, const char *path);
/* HOOKE_BAD_VALUE for a kind without a page. */
int32_t hk_measurement_write_page(const hooke_measurement *measurement, const char *path);

/* Members of a JSON object, for pages: those of the whole document but for the table `except` (NULL: none),
 * or those of one row. A record is an object, or null if it has no row; rows are an array. Series are left
 * out. */
void hk_measurement_add_all(struct hk_text *text, const hooke_measurement *measurement, const char *except);
void hk_measurement_add_row(struct hk_text *text, const hooke_measurement *measurement, const char *table,
                            int64_t row);
