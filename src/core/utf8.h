/* Text of others in messages: UTF-8 of one line. */
#ifndef HOOKE_CORE_UTF8_H
#define HOOKE_CORE_UTF8_H

#include <stdint.h>

/* Bytes of the character of UTF-8 (RFC 3629) that `text` begins with; 0 if it begins with none. */
int64_t hk_utf8_character(const char *text, int64_t length);

/* The character, of `bytes` bytes, if it is one that commands a terminal (U+0000 to U+001F, U+007F to
 * U+009F), ends a line (U+2028, U+2029) or turns the direction of writing (U+061C, U+200E, U+200F, U+202A to
 * U+202E, U+2066 to U+2069); 0 if not. Texts have no U+0000. */
uint32_t hk_utf8_control(const char *text, int64_t bytes);

/* Puts '?' for every such character and for every byte that is of no character. */
void hk_utf8_make_plain(char *text);

#endif
