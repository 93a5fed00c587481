/* Lengths and times with a unit: "1mm", "0.5 cm", "5min". */
#ifndef HOOKE_CLI_UNIT_H
#define HOOKE_CLI_UNIT_H

#include <stdint.h>

enum { HOOKE_UNIT_LIST_SIZE = 64, HOOKE_UNIT_WORD_SIZE = 24 };

/* 1 if numbers in `base` ("m" or "s") may be given in other units. */
int32_t cli_unit_has_others(const char *base);

/* Writes the units allowed instead of `base`, "s, ms, us, ns, min, h", and returns `list`. */
const char *cli_unit_list(const char *base, char list[HOOKE_UNIT_LIST_SIZE]);

/* `text` with every number with a unit converted to `base`, as if the number had been written with another
 * exponent, so that 3um is 3e-6 to the bit; minutes and hours are multiplied. Anything else is unchanged, for
 * the option table to refuse. The caller frees it. NULL without memory, or for an unknown unit, which is then
 * in `word`. */
char *cli_unit_read(const char *text, const char *base, char word[HOOKE_UNIT_WORD_SIZE]);

#endif
