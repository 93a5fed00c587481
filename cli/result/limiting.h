/* Limiting springs, in words and as JSON. */
#ifndef HOOKE_CLI_LIMITING_H
#define HOOKE_CLI_LIMITING_H

#include "print.h"

#include <hooke/measurement.h>

/* The first rows of the table "blame", a line each. */
void cli_limiting_print(const hooke_measurement *measurement);

/* The table "blame" under its name; "spring" has the ends of a spring as a pair, null for a force. */
void cli_limiting_json(struct cli_json *json, const hooke_measurement *measurement);

#endif
