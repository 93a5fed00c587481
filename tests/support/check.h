/* Assertions with two-sided bounds and the library's own words. They fail the running cmocka test. */
#pragma once

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hooke.h"
#include "owned.h"

/* A test of the program, which runs all that its file has, in their order. */
#define TEST(name)                                                                                           \
  static void name(void **prepared);                                                                         \
  __attribute__((constructor)) static void add_##name(void) {                                                \
    check_add_test(__COUNTER__, #name, name);                                                                \
  }                                                                                                          \
  static void name(__attribute__((unused)) void **prepared)

/* What goes before and after every test of the program, which finds what `set_up` made in `*prepared`. */
#define AROUND_EACH(set_up, tear_down)                                                                       \
  __attribute__((constructor)) static void add_around_each(void) {                                           \
    check_around_each((set_up), (tear_down));                                                                \
  }

/* What goes before the first test and after the last. */
#define AROUND_ALL(set_up, tear_down)                                                                        \
  __attribute__((constructor)) static void add_around_all(void) {                                            \
    check_around_all((set_up), (tear_down));                                                                 \
  }
/* The call returned exactly this status; prints the library's message otherwise. */
#define check_status(call, status) check_status_at((call), (status), #call, __FILE__, __LINE__)
#define check_ok(call)             check_status((call), HOOKE_OK)

/* low <= value <= high; a NaN fails. */
#define check_between(value, low, high) check_between_at((value), (low), (high), #value, __FILE__, __LINE__)

/* |value - expected| <= tolerance; a NaN fails. */
#define check_close(value, expected, tolerance)                                                              \
  check_close_at((value), (expected), (tolerance), #value, __FILE__, __LINE__)

/* The last message of the library contains this text. */
#define check_message(text) check_message_at((text), __FILE__, __LINE__)

/* Two arrays are the same to the bit; names the first number that differs. */
#define check_same_bits(count, found, expected)                                                              \
  check_same_bits_at((count), (found), (expected), #found, __FILE__, __LINE__)

void check_add_test(int32_t place, const char *name, CMUnitTestFunction test);
void check_around_each(CMFixtureFunction set_up, CMFixtureFunction tear_down);
void check_around_all(CMFixtureFunction set_up, CMFixtureFunction tear_down);
/* For a program with a main() of its own; 0 if all passed. */
int check_run_tests(void);

void check_status_at(int32_t found, int32_t expected, const char *call, const char *file, int line);
void check_between_at(double value, double low, double high, const char *what, const char *file, int line);
void check_close_at(double value, double expected, double tolerance, const char *what, const char *file,
                    int line);
void check_message_at(const char *text, const char *file, int line);
void check_same_bits_at(int64_t count, const double *found, const double *expected, const char *what,
                        const char *file, int line);

/* Fails the test with a message of its own. */
__attribute__((format(printf, 1, 2))) void check_failed(const char *format, ...);

/* The largest |a - b| of two arrays. */
double largest_difference(int64_t count, const double *a, const double *b);

/* Memory that fails the test when there is none; zeroed. Release it with free(). */
double *new_doubles(int64_t count);
void *new_block(int64_t count, int64_t size);
