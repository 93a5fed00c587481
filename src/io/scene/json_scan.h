/* Checks of the text of a scene before it is parsed. */
#ifndef HOOKE_IO_SCENE_JSON_SCAN_H
#define HOOKE_IO_SCENE_JSON_SCAN_H

#include "hooke/base.h"

/* Checks a text that arrives in chunks, so that a bad one is refused before it is in memory: not UTF-8, NUL
 * bytes, not an object, nested too deep, full of empty brackets, too large for the memory. `line` and
 * `column` (from 1, in characters) are those of the last character seen. Starts as zeros. */
struct hk_json_guard {
  int64_t line, column, depth;
  int32_t started, in_string, escaped;
  uint64_t arrays;                      /* one bit a level, the innermost lowest: 1 for an array */
  char last;                            /* last character that is not a blank, outside of strings */
  int32_t pending;                      /* missing bytes of a character */
  unsigned char first, lowest, highest; /* its first byte, and the range of its next byte */
  int64_t values, lists, objects;       /* maximum so far */
  double memory_limit;                  /* [bytes] memory that the parsed text may need; 0: the machine's */
};

/* Maximum memory [bytes] for parsing `length` bytes of text, checked so far. */
double hk_json_guard_bytes(const struct hk_json_guard *guard, int64_t length);

int32_t hk_json_guard_feed(struct hk_json_guard *guard, const char *bytes, int64_t count);
int32_t hk_json_guard_end(const struct hk_json_guard *guard);

/* Checks numbers and bare words: refuses numbers that a double cannot hold or that would become 0, and words
 * such as NaN. On failure `at` is its position. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_json_check_tokens(const char *text, int64_t length, const char **at);

#endif
