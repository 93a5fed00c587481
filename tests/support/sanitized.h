/* Builds with a sanitizer take ten times as long: there a test may run a share of its cases, unless
 * HOOKE_LONG is set; and in any build with HOOKE_SHORT, for tests whose every case runs elsewhere. */
#pragma once

#include <stdint.h>
#include <stdlib.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HOOKE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HOOKE_SANITIZED 1
#endif
#endif
#ifndef HOOKE_SANITIZED
#define HOOKE_SANITIZED 0
#endif

/* True if large cases are replaced by small ones. */
static inline int short_of_time(void) {
  return HOOKE_SANITIZED || getenv("HOOKE_SHORT") != NULL;
}

/* True if case `k` = 0, 1, ... is skipped: all but every `share`-th. */
static inline int left_out(int64_t k, int64_t share) {
  if (k % share == 0) return 0;
  return getenv("HOOKE_SHORT") != NULL || (HOOKE_SANITIZED && getenv("HOOKE_LONG") == NULL);
}
