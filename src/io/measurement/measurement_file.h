/* Measurements as files. */
#ifndef HOOKE_IO_MEASUREMENT_MEASUREMENT_FILE_H
#define HOOKE_IO_MEASUREMENT_MEASUREMENT_FILE_H

#include "io/file/text.h"
#include "measure/measurement.h"

/* The options that a kind takes; NULL for a kind that is not there. */
const struct hk_option_table *hk_measurement_options(const char *kind);

int32_t hk_measurement_write_csv(const hooke_measurement *measurement, const char *path);
int32_t hk_measurement_write_json(const hooke_measurement *measurement, const char *path);
int32_t hk_measurement_write_h5(const hooke_measurement *measurement, const char *path);
/* HOOKE_BAD_VALUE for a kind that has no page. */
int32_t hk_measurement_write_page(const hooke_measurement *measurement, const char *path);

/* As members of a JSON object under `key` (NULL: of an array): all tables, or one: a record as an object, or
 * null where it has no row, rows as an array. Series are left out. */
void hk_measurement_add_tables(struct hk_text *text, const hooke_measurement *measurement);
void hk_measurement_add_table(struct hk_text *text, const hooke_measurement *measurement, const char *table);
/* The members of one row alone. */
void hk_measurement_add_row(struct hk_text *text, const hooke_measurement *measurement,
                            const struct hk_table *table, int64_t row);

#endif
