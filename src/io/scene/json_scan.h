/* What is checked in the text of a scene before it is parsed. */
#ifndef HOOKE_IO_SCENE_JSON_SCAN_H
#define HOOKE_IO_SCENE_JSON_SCAN_H

#include "hooke/base.h"

/* Follows a text that comes in pieces, so that a hopeless one is refused before it is in memory: not UTF-8,
 * NUL bytes, not an object, nested too deep, full of empty brackets, too much for the memory. `line` and
 * `column` (from 1, in characters) are those of the last character seen. All zeros is the start. */
struct hk_json_guard {
  int64_t line, column, depth;
  int32_t started, in_string, escaped;
  uint64_t arrays;                      /* one bit a level, the innermost lowest: 1 for an array */
  char last;                            /* the last character that is not a blank, outside of texts */
  int32_t pending;                      /* bytes still missing of a character */
  unsigned char first, lowest, highest; /* its first byte, and what its next byte may be */
  int64_t values, lists, objects;       /* at most, so far */
  double memory_limit; /* [bytes] that the text may need when it is parsed; 0: what the machine has */
};

/* What `length` bytes of text, followed so far, need at most when they are parsed [bytes]. */
double hk_json_guard_bytes(const struct hk_json_guard *guard, int64_t length);

int32_t hk_json_guard_feed(struct hk_json_guard *guard, const char *bytes, int64_t count);
int32_t hk_json_guard_end(const struct hk_json_guard *guard);

/* Checks numbers and bare words: numbers that a double cannot hold, or that would become 0, and words such as
 * NaN. On failure `at` is where it is. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_json_check_tokens(const char *text, int64_t length, const char **at);

#endif
