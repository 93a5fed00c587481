#include "core/number.h"

#include "core/keep_errno.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINT_SIZE = 16, SHORT_NUMBER = 96 };

/* Decimal point of this thread's locale, which may be several bytes long. */
static size_t decimal_point(char *point) {
  char probe[POINT_SIZE];
  int length = snprintf(probe, sizeof probe, "%.1f", 0.0);
  size_t bytes = length >= 3 && length < POINT_SIZE ? (size_t)length - 2 : 0;
  memcpy(point, probe + 1, bytes);
  point[bytes] = '\0';
  return bytes;
}

static int64_t skip_digits(const char *text, int64_t at, int64_t length) {
  while (at < length && text[at] >= '0' && text[at] <= '9')
    at++;
  return at;
}

static int64_t skip_sign(const char *text, int64_t at, int64_t length) {
  return at + (at < length && (text[at] == '-' || text[at] == '+'));
}

int64_t hk_number_scan(const char *text, int64_t length, int64_t *mantissa) {
  const int64_t start = skip_sign(text, 0, length);
  int64_t at = skip_digits(text, start, length), digits = at - start;
  if (at < length && text[at] == '.') {
    const int64_t after = skip_digits(text, at + 1, length);
    digits += after - at - 1;
    at = after;
  }
  *mantissa = digits > 0 ? at : 0;
  if (digits == 0 || at == length || (text[at] != 'e' && text[at] != 'E')) return *mantissa;
  const int64_t exponent = skip_sign(text, at + 1, length), end = skip_digits(text, exponent, length);
  return end > exponent ? end : at;
}

/* 1 if no digit is other than 0. */
static int is_zero(const char *text, int64_t mantissa) {
  for (int64_t k = 0; k < mantissa; k++)
    if (text[k] >= '1' && text[k] <= '9') return 0;
  return 1;
}

enum hk_number_result hk_number_parse(const char *text, int64_t length, double *value) {
  HOOKE_KEEP_ERRNO;
  int64_t mantissa = 0;
  if (hk_number_scan(text, length, &mantissa) != length || mantissa == 0) return HOOKE_NUMBER_JUNK;
  const char *found = memchr(text, '.', (size_t)mantissa);
  const int64_t point = found ? found - text : -1;
  char buffer[SHORT_NUMBER + POINT_SIZE], *copy = buffer, *after;
  if (length >= SHORT_NUMBER) copy = hk_new(length + POINT_SIZE, 1);
  if (copy == NULL) return HOOKE_NUMBER_NO_MEMORY;
  memcpy(copy, text, (size_t)length);
  copy[length] = '\0';
  double number = strtod(copy, &after);
  if (point >= 0 && after != copy + length) { /* the locale has another point */
    const size_t bytes = decimal_point(copy + point);
    memcpy(copy + point + bytes, text + point + 1, (size_t)(length - point - 1));
    copy[length - 1 + (int64_t)bytes] = '\0';
    number = strtod(copy, NULL);
  }
  if (copy != buffer) hk_free(copy);
  if (!isfinite(number)) return HOOKE_NUMBER_TOO_LARGE;
  if (number == 0 && !is_zero(text, mantissa)) return HOOKE_NUMBER_TOO_SMALL;
  *value = number;
  return HOOKE_NUMBER_FINE;
}

void hk_number_print(double value, char *text) {
  HOOKE_KEEP_ERRNO;
  int precision = 15;
  do {
    snprintf(text, HOOKE_NUMBER_SIZE, "%.*g", precision, value);
  } while (++precision <= 17 && isfinite(value) && strtod(text, NULL) != value);
  char point[POINT_SIZE];
  size_t bytes = decimal_point(point);
  char *found = bytes ? strstr(text, point) : NULL;
  if (found) {
    *found = '.';
    memmove(found + 1, found + bytes, strlen(found + bytes) + 1);
  }
}
