/* The value of one option: parsing and checks. */
#pragma once

#include "core/table/option.h"

/* Numbers and words; a single number needs no block of its own. All zeros: no value. */
struct hk_option_value {
  int64_t count;
  double one;
  double *many;     /* NULL unless count > 1 */
  char *words;      /* text, or words separated by blanks; NULL: none */
  const char *unit; /* base of the units that the text named: "N"; NULL: plain numbers */
};

/* Parses a number for a row, with or without one of its units. All numbers of an option that have a unit have
 * it of one kind: `base`, NULL before the first. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_option_parse_number(const struct hk_option_row *row, const char *where, const char *text,
                               int64_t length, double *number, const char **base);

void hk_option_value_clear(struct hk_option_value *value);
int32_t hk_option_value_copy(const struct hk_option_value *from, struct hk_option_value *to);
const double *hk_option_value_numbers(const struct hk_option_value *value);

/* Converts `count` numbers, or a text, to the value of a row. `where` is the option's name for messages.
 * HOOKE_BAD_VALUE, HOOKE_NO_MEMORY; `value` is then empty. */
int32_t hk_option_value_from_numbers(const struct hk_option_row *row, const char *where, int64_t count,
                                     const double *numbers, struct hk_option_value *value);
int32_t hk_option_value_from_text(const struct hk_option_row *row, const char *where, const char *text,
                                  struct hk_option_value *value);
