#include "core/os/os_text.h"

#include <langinfo.h>
#include <locale.h>
#include <string.h>

/* C libraries need no memory for "C"; but glibc leaks a few bytes in newlocale() if LOCPATH is set, so it is
 * called only where needed. */
struct hk_os_locale hk_os_begin_plain(int needed) {
  struct hk_os_locale locale = {.plain = NULL};
  if (!needed && strcmp(nl_langinfo(RADIXCHAR), ".") == 0) return locale;
  locale.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (locale.plain) locale.callers = uselocale(locale.plain);
  return locale;
}

void hk_os_end_plain(struct hk_os_locale locale) {
  if (locale.plain == NULL) return;
  uselocale(locale.callers);
  freelocale(locale.plain);
}

int hk_os_describe_error(int error, char *text, size_t size) {
  return strerror_r(error, text, size);
}
