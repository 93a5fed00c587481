#include "check.h"
#include "hash.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check_status_at(int32_t found, int32_t expected, const char *call, const char *file, int line) {
  if (found == expected) return;
  print_error("%s\n  returned %d (%s), expected %d (%s)\n  message: %s\n", call, found,
              hooke_status_name(found), expected, hooke_status_name(expected), hooke_last_error());
  _fail(file, line);
}

void check_between_at(double value, double low, double high, const char *what, const char *file, int line) {
  if (value >= low && value <= high) return;
  print_error("%s = %.17g is not between %.17g and %.17g\n", what, value, low, high);
  _fail(file, line);
}

void check_close_at(double value, double expected, double tolerance, const char *what, const char *file,
                    int line) {
  if (fabs(value - expected) <= tolerance) return;
  print_error("%s = %.17g differs from %.17g by %.3g, allowed is %.3g\n", what, value, expected,
              fabs(value - expected), tolerance);
  _fail(file, line);
}

void check_message_at(const char *text, const char *file, int line) {
  if (strstr(hooke_last_error(), text) != NULL) return;
  print_error("the message\n  %s\ndoes not contain \"%s\"\n", hooke_last_error(), text);
  _fail(file, line);
}

void check_same_bits_at(int64_t count, const double *found, const double *expected, const char *what,
                        const char *file, int line) {
  const int64_t k = first_difference(count, found, expected);
  if (k < 0) return;
  print_error("%s: number %lld is %.17g (%a), expected %.17g (%a); hash %016llx, expected %016llx\n", what,
              (long long)k, found[k], found[k], expected[k], expected[k],
              (unsigned long long)hash_doubles(count, found, HASH_START),
              (unsigned long long)hash_doubles(count, expected, HASH_START));
  _fail(file, line);
}

void check_failed(const char *format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  print_error("%s\n", text);
  fail();
}

void *new_block(int64_t count, int64_t size) {
  void *block = calloc((size_t)(count > 0 ? count : 1), (size_t)size);
  assert_non_null(block);
  return block;
}

double *new_doubles(int64_t count) {
  return new_block(count, (int64_t)sizeof(double));
}

double largest_difference(int64_t count, const double *a, const double *b) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++) {
    const double difference = fabs(a[k] - b[k]);
    if (!(difference <= most)) most = difference;
  }
  return most;
}
