/* Text of others in messages: UTF-8 of one line. */
#ifndef HOOKE_CORE_UTF8_H
#define HOOKE_CORE_UTF8_H

#include <stdint.h>

/* Bytes of the character of UTF-8 (RFC 3629) that `text` begins with; 0 if it begins with none. */
int64_t hooke_utf8_character(const char *text, int64_t length);

/* 1 for a byte that moves a terminal's cursor or changes its colours: below 32, and 127. */
int hooke_utf8_is_control(char c);

/* Puts '?' for every control character and for every byte that is of no character. */
void hooke_utf8_make_plain(char *text);

#endif
