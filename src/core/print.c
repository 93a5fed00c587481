#include "core/print.h"

#include "core/keep_errno.h"

#include <langinfo.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

/* Replaces the thread's locale, which is the caller's, by "C" for a moment; C libraries need no memory for
 * that. */
struct plain {
  locale_t locale, callers;
};

static struct plain begin_plain(int needed) {
  struct plain plain = {.locale = needed ? newlocale(LC_ALL_MASK, "C", (locale_t)0) : (locale_t)0};
  if (plain.locale) plain.callers = uselocale(plain.locale);
  return plain;
}

static void end_plain(struct plain plain) {
  if (plain.locale == (locale_t)0) return;
  uselocale(plain.callers);
  freelocale(plain.locale);
}

int hk_print_list(char *text, size_t size, const char *format, va_list args) {
  HOOKE_KEEP_ERRNO;
  /* glibc leaks a few bytes in newlocale() if LOCPATH is set: call it only where needed */
  const struct plain plain = begin_plain(strcmp(nl_langinfo(RADIXCHAR), ".") != 0);
  const int length = vsnprintf(text, size, format, args);
  end_plain(plain);
  return length;
}

int hk_print(char *text, size_t size, const char *format, ...) {
  va_list args;
  va_start(args, format);
  const int length = hk_print_list(text, size, format, args);
  va_end(args);
  return length;
}

const char *hk_print_error(int error, char *text) {
  HOOKE_KEEP_ERRNO;
  const struct plain plain = begin_plain(1);
  if (strerror_r(error, text, HOOKE_ERROR_SIZE) != 0) snprintf(text, HOOKE_ERROR_SIZE, "error %d", error);
  end_plain(plain);
  return text;
}
