/* What `hooke check` tells of bending, of altitude springs, and of the numbers that parts derived from their
 * materials. */
#ifndef HOOKE_CLI_DERIVED_H
#define HOOKE_CLI_DERIVED_H

#include "print.h"

#include "hooke.h"

/* The keys "triples", "bending_groups", "tetrahedra", "altitude_groups" and "derived". */
void cli_derived_json(struct cli_json *json, const hooke_system *system);

/* The same in lines; nothing where there is nothing. */
void cli_derived_words(const hooke_system *system);

#endif
