#include "io/page/base64.h"

enum { TRIPLES = 1024 }; /* at a time */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int64_t hk_base64_length(int64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/* Three bytes as four digits; missing bytes give no digits. */
static void put(const uint8_t *bytes, int64_t left, char *text) {
  const uint32_t second = left > 1 ? bytes[1] : 0, third = left > 2 ? bytes[2] : 0;
  const uint32_t word = (uint32_t)bytes[0] << 16 | second << 8 | third;
  text[0] = digits[word >> 18];
  text[1] = digits[word >> 12 & 63];
  text[2] = left > 1 ? digits[word >> 6 & 63] : '=';
  text[3] = left > 2 ? digits[word & 63] : '=';
}

void hk_base64_add(struct hk_text *text, const uint8_t *bytes, int64_t count) {
  char piece[4 * TRIPLES];
  for (int64_t at = 0; at < count;) {
    int64_t length = 0;
    for (; at < count && length < (int64_t)sizeof piece; at += 3, length += 4)
      put(bytes + at, count - at, piece + length);
    hk_text_add(text, piece, length);
  }
}
