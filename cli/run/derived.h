/* Output of `hooke check` on the groups of every force, and the numbers that parts derived from their
 * materials. */
#ifndef HOOKE_CLI_DERIVED_H
#define HOOKE_CLI_DERIVED_H

#include "print.h"

#include "hooke.h"

/* The keys "springs", "groups", "triples", "bending_groups", "tetrahedra", "altitude_groups" and "derived".
 */
void cli_derived_json(struct cli_json *json, const hooke_system *system);

/* The same in lines, but for springs; nothing if there are none. */
void cli_derived_words(const hooke_system *system);

#endif
