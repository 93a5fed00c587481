/* Decimal numbers as text, independent of the locale. */
#pragma once

#include "hooke/base.h"

enum hk_number_result {
  HOOKE_NUMBER_FINE,
  HOOKE_NUMBER_JUNK, /* not a decimal number from first to last character (nor nan, inf or hexadecimal) */
  HOOKE_NUMBER_TOO_LARGE, /* beyond the largest double */
  HOOKE_NUMBER_TOO_SMALL, /* not zero, but would be rounded to zero */
  HOOKE_NUMBER_NO_MEMORY
};

/* Length of the number that `text` of `length` characters begins with, and of its sign, digits and point; 0:
 * it begins with none. */
int64_t hk_number_scan(const char *text, int64_t length, int64_t *mantissa);

/* Parses `length` characters: sign, digits with at most one point, exponent; no blanks. Sets `value` on
 * success. */
enum hk_number_result hk_number_parse(const char *text, int64_t length, double *value);

/* Writes the shortest text that reads back to the same bits; `text` has room for HOOKE_NUMBER_SIZE
 * characters. */
enum { HOOKE_NUMBER_SIZE = 40 };
void hk_number_print(double value, char *text);
