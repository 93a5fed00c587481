/* Text that does not depend on locale or thread: a decimal point, and system errors in English. */
#pragma once

#include <stdarg.h>
#include <stddef.h>

/* Like snprintf() and vsnprintf(); all numbers with a fraction are formatted here. */
int hk_print(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
int hk_print_list(char *text, size_t size, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));
/* Adds to a text of `size` characters, as far as there is space. */
void hk_append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Writes the description of an errno value into `text` (HOOKE_ERROR_SIZE characters) and returns it. */
enum { HOOKE_ERROR_SIZE = 128 };
const char *hk_print_error(int error, char *text);
