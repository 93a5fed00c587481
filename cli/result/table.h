/* Tables of a measurement as JSON: every column by its name. */
#ifndef HOOKE_CLI_TABLE_H
#define HOOKE_CLI_TABLE_H

#include "print.h"

#include <hooke/measurement.h>

/* The members of one row, in an open object. Series are omitted. */
void cli_table_print_row(struct cli_json *json, const hooke_measurement *measurement, const char *table,
                         int64_t row);

#endif
