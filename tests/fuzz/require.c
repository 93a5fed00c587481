#include "fuzz.h"

#include "hooke/base.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void hooke_fuzz_require(int holds, const char *what) {
  if (holds) return;
  fprintf(stderr, "does not hold: %s\nlast message: %s\n", what, hooke_last_error());
  abort();
}

/* Bytes of the character that begins here; 0 if it is invalid (RFC 3629). */
static size_t character(const unsigned char *at) {
  if (at[0] < 0x80) return 1;
  const size_t length = at[0] >= 0xC2 && at[0] <= 0xDF   ? 2
                        : at[0] >= 0xE0 && at[0] <= 0xEF ? 3
                        : at[0] >= 0xF0 && at[0] <= 0xF4 ? 4
                                                         : 0;
  for (size_t k = 1; k < length; k++)
    if ((at[k] & 0xC0) != 0x80) return 0;
  if ((at[0] == 0xE0 && at[1] < 0xA0) || (at[0] == 0xED && at[1] > 0x9F) || (at[0] == 0xF0 && at[1] < 0x90) ||
      (at[0] == 0xF4 && at[1] > 0x8F))
    return 0;
  return length;
}

/* C0 and C1 controls, line ends, and characters that change the direction of writing. */
static int steers(const unsigned char *at) {
  const int general = at[0] == 0xE2 && at[1] == 0x80, more = at[0] == 0xE2 && at[1] == 0x81;
  return at[0] < 32 || at[0] == 127 || (at[0] == 0xC2 && at[1] < 0xA0) || (at[0] == 0xD8 && at[1] == 0x9C) ||
         (general && (at[2] == 0x8E || at[2] == 0x8F || (at[2] >= 0xA8 && at[2] <= 0xAE))) ||
         (more && at[2] >= 0xA6 && at[2] <= 0xA9);
}

void hooke_fuzz_require_lines(int most) {
  const unsigned char *at = (const unsigned char *)hooke_last_error();
  int lines = 1;
  hooke_fuzz_require(*at != '\0', "a failure has a message");
  while (*at) {
    const size_t length = character(at);
    const int ends = *at == '\n' && at[1] != '\0' && at[1] != '\n';
    hooke_fuzz_require(length > 0, "a message is UTF-8");
    hooke_fuzz_require(ends || !steers(at), "a message is text without control characters");
    lines += ends;
    at += length;
  }
  hooke_fuzz_require(lines <= most, "a message has no more lines than faults are told");
}

void hooke_fuzz_require_message(void) {
  hooke_fuzz_require_lines(1);
}
