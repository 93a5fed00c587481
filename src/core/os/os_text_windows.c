#include "core/os/os_text.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

/* The locale becomes the thread's own before it is changed. */
struct hk_os_locale hk_os_begin_plain(int needed) {
  struct hk_os_locale locale = {.plain = NULL};
  if (!needed && strcmp(localeconv()->decimal_point, ".") == 0) return locale;
  locale.mode = _configthreadlocale(_ENABLE_PER_THREAD_LOCALE);
  locale.callers = _strdup(setlocale(LC_ALL, NULL));
  if (locale.callers) locale.plain = setlocale(LC_ALL, "C");
  return locale;
}

void hk_os_end_plain(struct hk_os_locale locale) {
  if (locale.plain) setlocale(LC_ALL, locale.callers);
  if (locale.mode > 0) _configthreadlocale(locale.mode);
  free(locale.callers);
}

int hk_os_describe_error(int error, char *text, size_t size) {
  return strerror_s(text, size, error);
}
