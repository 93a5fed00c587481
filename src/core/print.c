#include "core/print.h"

#include "core/keep_errno.h"
#include "core/os/os_text.h"

#include <stdio.h>
#include <string.h>

int hk_print_list(char *text, size_t size, const char *format, va_list args) {
  HOOKE_KEEP_ERRNO;
  const struct hk_os_locale plain = hk_os_begin_plain(0);
  const int length = vsnprintf(text, size, format, args);
  hk_os_end_plain(plain);
  return length;
}

int hk_print(char *text, size_t size, const char *format, ...) {
  va_list args;
  va_start(args, format);
  const int length = hk_print_list(text, size, format, args);
  va_end(args);
  return length;
}

void hk_append(char *text, size_t size, const char *format, ...) {
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  if (used < size) hk_print_list(text + used, size - used, format, args);
  va_end(args);
}

const char *hk_print_error(int error, char *text) {
  HOOKE_KEEP_ERRNO;
  const struct hk_os_locale plain = hk_os_begin_plain(1);
  if (hk_os_describe_error(error, text, HOOKE_ERROR_SIZE) != 0)
    snprintf(text, HOOKE_ERROR_SIZE, "error %d", error);
  hk_os_end_plain(plain);
  return text;
}
