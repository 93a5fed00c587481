/* Foreign text in messages: the replaced characters, and the others unchanged. */
#include "core/utf8.h"

#include "check.h"

#include <stdio.h>
#include <string.h>

static void put(uint32_t point, char text[8]) {
  if (point < 0x80)
    snprintf(text, 8, "%c", (int)point);
  else if (point < 0x800)
    snprintf(text, 8, "%c%c", (int)(0xC0 | point >> 6), (int)(0x80 | (point & 0x3F)));
  else if (point < 0x10000)
    snprintf(text, 8, "%c%c%c", (int)(0xE0 | point >> 12), (int)(0x80 | (point >> 6 & 0x3F)),
             (int)(0x80 | (point & 0x3F)));
  else
    snprintf(text, 8, "%c%c%c%c", (int)(0xF0 | point >> 18), (int)(0x80 | (point >> 12 & 0x3F)),
             (int)(0x80 | (point >> 6 & 0x3F)), (int)(0x80 | (point & 0x3F)));
}

static int is_control(uint32_t point) {
  return point < 0x20 || (point >= 0x7F && point <= 0x9F) || point == 0x61C || point == 0x200E ||
         point == 0x200F || (point >= 0x2028 && point <= 0x202E) || (point >= 0x2066 && point <= 0x2069);
}

TEST(only_control_characters_are_replaced) {
  for (uint32_t point = 1; point <= 0x10FFFF; point++) {
    if (point >= 0xD800 && point <= 0xDFFF) continue;
    char character[8], text[16], wanted[16];
    put(point, character);
    snprintf(text, sizeof text, "a%sb", character);
    snprintf(wanted, sizeof wanted, "a%sb", is_control(point) ? "?" : character);
    hk_utf8_make_plain(text);
    assert_string_equal(text, wanted);
  }
}

TEST(bytes_of_no_character_are_replaced_one_by_one) {
  static const char *const pairs[][2] = {{"\x9b", "?"},
                                         {"a\xc2", "a?"},
                                         {"\xe2\x80", "??"},
                                         {"\xed\xa0\x80", "???"},
                                         {"\xc0\x9b"
                                          "c",
                                          "??c"},
                                         {"\xf5\x80\x80\x80", "????"}};
  for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++) {
    char text[16];
    snprintf(text, sizeof text, "%s", pairs[k][0]);
    hk_utf8_make_plain(text);
    assert_string_equal(text, pairs[k][1]);
  }
}
