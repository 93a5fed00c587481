/* Text in the same words in every locale and thread: a decimal point, and errors of the system in English. */
#ifndef HOOKE_CORE_PRINT_H
#define HOOKE_CORE_PRINT_H

#include <stdarg.h>
#include <stddef.h>

/* Like snprintf() and vsnprintf(), which numbers with a fraction do not go through anywhere else. */
int hk_print(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
int hk_print_list(char *text, size_t size, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* Writes what a value of errno means into `text`, which has room for HOOKE_ERROR_SIZE characters, and returns
 * it. */
enum { HOOKE_ERROR_SIZE = 128 };
const char *hk_print_error(int error, char *text);

#endif
