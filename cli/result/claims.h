/* What a measurement says of its result, as the library composes it. */
#ifndef HOOKE_CLI_CLAIMS_H
#define HOOKE_CLI_CLAIMS_H

#include "arguments.h"
#include "print.h"

/* Prints the claims beside their keys, from column `indent` on, with --quiet the first alone; and after the
 * first the command that it leads to (NULL: none). */
void cli_claims_print(const struct cli_arguments *arguments, const hooke_measurement *measurement,
                      int32_t indent, const char *command);

/* The text of the claim with this key; NULL if there is none. */
const char *cli_claim(const hooke_measurement *measurement, const char *key);

/* Prints the whole document of the measurement, after the name of the file under `key` (NULL: without).
 * HOOKE_NO_MEMORY if something is left out. */
int32_t cli_claims_print_json(const struct cli_arguments *arguments, const char *key,
                              hooke_measurement *measurement);

/* In words the first rows of the table "blame", of the limiting springs, a line each. */
void cli_limiting_print(const hooke_measurement *measurement);

#endif
