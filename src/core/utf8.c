#include "core/utf8.h"

#include <string.h>

int64_t hk_utf8_character(const char *text, int64_t length) {
  const unsigned char *c = (const unsigned char *)text;
  if (c[0] < 0x80) return 1;
  const int64_t bytes = c[0] >= 0xC2 && c[0] <= 0xDF   ? 2
                        : (c[0] & 0xF0) == 0xE0        ? 3
                        : c[0] >= 0xF0 && c[0] <= 0xF4 ? 4
                                                       : 0;
  if (bytes == 0 || bytes > length) return 0;
  const unsigned char lowest = c[0] == 0xE0 ? 0xA0 : c[0] == 0xF0 ? 0x90 : 0x80;
  const unsigned char highest = c[0] == 0xED ? 0x9F : c[0] == 0xF4 ? 0x8F : 0xBF;
  if (c[1] < lowest || c[1] > highest) return 0;
  for (int64_t k = 2; k < bytes; k++)
    if ((c[k] & 0xC0) != 0x80) return 0;
  return bytes;
}

uint32_t hk_utf8_control(const char *text, int64_t bytes) {
  static const struct {
    uint32_t first, last;
  } control[] = {{0, 0x1F},        {0x7F, 0x9F},     {0x61C, 0x61C},
                 {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}};
  const unsigned char *c = (const unsigned char *)text;
  uint32_t point = c[0];
  if (bytes == 2) point = (c[0] & 0x1Fu) << 6 | (c[1] & 0x3Fu);
  if (bytes == 3) point = (c[0] & 0xFu) << 12 | (c[1] & 0x3Fu) << 6 | (c[2] & 0x3Fu);
  for (size_t k = 0; bytes >= 1 && bytes <= 3 && k < sizeof control / sizeof control[0]; k++)
    if (point >= control[k].first && point <= control[k].last) return point;
  return 0;
}

void hk_utf8_make_plain(char *text) {
  char *end = text;
  for (int64_t left = (int64_t)strlen(text), bytes; left > 0; left -= bytes, text += bytes) {
    bytes = hk_utf8_character(text, left);
    const int64_t kept = bytes == 0 || hk_utf8_control(text, bytes) ? 0 : bytes;
    memmove(end, kept ? text : "?", (size_t)(kept ? kept : 1));
    end += kept ? kept : 1;
    if (bytes == 0) bytes = 1;
  }
  *end = '\0';
}
