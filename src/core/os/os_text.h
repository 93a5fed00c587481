/* Locales and messages as systems have them: os_text_posix.c is for POSIX, os_text_windows.c for Windows. */
#pragma once

#include <stddef.h>

/* Replaces the thread's locale, which is the caller's, by "C" for a moment. `needed` 0: only if it has
 * another decimal point. */
struct hk_os_locale {
  void *plain, *callers; /* NULL: nothing was replaced */
  int mode;
};
struct hk_os_locale hk_os_begin_plain(int needed);
void hk_os_end_plain(struct hk_os_locale locale);

/* Describes an errno value in at most `size` bytes. Returns 0, or another number if it has no description. */
int hk_os_describe_error(int error, char *text, size_t size);
