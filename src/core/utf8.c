#include "core/utf8.h"

#include <string.h>

int64_t hooke_utf8_character(const char *text, int64_t length) {
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

int hooke_utf8_is_control(char c) {
  return (unsigned char)c < 32 || c == 127;
}

void hooke_utf8_make_plain(char *text) {
  for (int64_t left = (int64_t)strlen(text), bytes; left > 0; left -= bytes, text += bytes) {
    bytes = hooke_utf8_character(text, left);
    if (bytes == 0 || hooke_utf8_is_control(*text)) *text = '?';
    if (bytes == 0) bytes = 1;
  }
}
