/* Limiting springs, in words. */
#ifndef HOOKE_CLI_LIMITING_H
#define HOOKE_CLI_LIMITING_H

#include <hooke/measurement.h>

/* The first rows of the table "blame", a line each. */
void cli_limiting_print(const hooke_measurement *measurement);

#endif
