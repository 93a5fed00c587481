/* Units of numbers in texts: "1ms", "0.5 cm", "2kN". */
#pragma once

#include "core/number.h"

struct hk_unit {
  const char *base; /* NULL: no unit */
  int32_t exponent; /* 10^exponent base, or */
  double factor;    /* factor base, unless 0 */
};

/* `bases` are the units of an option's row: "s", or "N (strain law), N/m (length law)". */

/* The unit with this name, of one of `bases`. */
struct hk_unit hk_unit_find(const char *bases, const char *name, int64_t length);

/* Writes the names of all units of `bases`: "s, ms, us, ns, ps, fs, min, h"; "" if `bases` has no other unit.
 */
void hk_unit_list(const char *bases, char *list, int64_t size);

/* Lengths in characters of the number that `text` begins with (0: none), and of that number, blanks and a
 * unit. Both are equal where no unit follows. A name that is not a unit of `bases` ends at a comma, a
 * semicolon or a blank. */
struct hk_quantity {
  int64_t number, whole;
};
struct hk_quantity hk_unit_scan(const char *bases, const char *text, int64_t length);

/* Parses `length` characters of a number in `unit` into the base unit. The exponent of the number is changed,
 * so that 3um is 3e-6 to the bit; a factor is multiplied. */
enum hk_number_result hk_unit_parse(const char *text, int64_t length, const struct hk_unit *unit,
                                    double *value);
