#include "io/page/base64.h"

enum { TRIPLES = 1024 }; /* at a time */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int64_t hk_base64_length(int64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/* Three bytes are four digits; missing bytes give no digits. */
void hk_base64_add(struct hk_text *text, const uint8_t *bytes, int64_t count) {
  char piece[4 * TRIPLES];
  for (int64_t at = 0; at < count;) {
    int64_t length = 0;
    for (; at < count && length < (int64_t)sizeof piece; at += 3) {
      uint32_t word = 0;
      for (int k = 0; k < 3; k++)
        word = word << 8 | (at + k < count ? bytes[at + k] : 0);
      for (int k = 0; k < 4; k++)
        piece[length++] = at + k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    hk_text_add(text, piece, length);
  }
}
