/* Foreign text in messages, made a single line of valid UTF-8. */
#pragma once

#include <stdint.h>

/* Number of bytes of the UTF-8 character (RFC 3629) that `text` begins with; 0 if it begins with none. */
int64_t hk_utf8_character(const char *text, int64_t length);

/* The character of `bytes` bytes if it controls a terminal (U+0000 to U+001F, U+007F to U+009F), ends a line
 * (U+2028, U+2029) or turns the direction of writing (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to
 * U+2069); 0 if not. Texts have no U+0000. */
uint32_t hk_utf8_control(const char *text, int64_t bytes);

/* Replaces every such character, and every byte that is part of no character, by '?'. */
void hk_utf8_make_plain(char *text);
