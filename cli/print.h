/* Prints numbers that read back to the same bits, JSON, and text that is safe on a terminal. */
#pragma once

#include "hooke.h"

#include <stdint.h>
#include <stdio.h>

enum { HOOKE_NUMBER_SIZE = 32 };

/* For display: writes the number to 6 digits into `text` and returns it. Numbers of lower accuracy are
 * printed with fewer. */
const char *cli_format_rounded(double value, char text[HOOKE_NUMBER_SIZE]);

/* For programs and for commands: as above, with the fewest digits that read back to the same double. */
const char *cli_format_number(double value, char text[HOOKE_NUMBER_SIZE]);

/* Adds to a text of `size` characters, as far as there is space. */
void cli_append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Prints foreign text (a title, a name or a file name) on one line: '?' for each character that could control
 * a terminal, end a line or change the direction of writing, and for bytes that are not UTF-8. All such text
 * is printed by this function, by the ones below or as JSON. Returns the number of characters printed. */
int32_t cli_print_text(FILE *file, const char *text);

/* Words of which some are foreign, like printf() on standard output; line ends stay where the format begins
 * or ends with them. */
void cli_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, padded with blanks to `width` characters. */
void cli_print_padded(FILE *file, int32_t width, const char *text);

/* Flushes standard output, so that words on standard error come after it. Returns 0 or the errno of the first
 * failure. */
int cli_print_flush(void);

/* A text that grows; begins as zeros. */
struct cli_string {
  char *bytes;    /* for free(); NULL: none yet */
  int32_t status; /* HOOKE_NO_MEMORY: something is left out */
};
void cli_string_add(struct cli_string *string, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a text as one word of a shell command, quoted if necessary; as $'...' if cli_print_text() would change
 * it. The second prints it. */
void cli_string_quote(struct cli_string *string, const char *text);
void cli_print_quoted(FILE *file, const char *text);

/* Text broken at blanks before column `width`; lines after the first start at column `indent`. */
void cli_print_wrapped(FILE *file, int32_t column, int32_t indent, int32_t width, const char *text);

/* A label, with text as of printf(), wrapped, beside it, from column `indent` on. */
void cli_print_fact(int32_t indent, int32_t width, const char *label, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A piece of JSON on standard output: the format itself, with ' for ", and values in it by %g (a number; null
 * if it is not finite), %d or PRId64 (a number of things; null if it is below 0) and %s (a text in quotes;
 * null if it is NULL; bytes that are not UTF-8 become U+FFFD, and characters that cli_print_text() replaces
 * are escaped); by nothing else. */
void cli_print_json(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The member "set" with a comma after it, values as the library takes them, if these options of loading a
 * scene (NULL: none) have it. It may change the last error. */
void cli_print_json_set(const hooke_options *limits);
/* After `before`, what hooke_measurement_json() says, without the brackets around it. HOOKE_NO_MEMORY, with
 * nothing printed. */
int32_t cli_print_members(const char *before, hooke_measurement *measurement, const char *table, int64_t row);

/* Position and velocity of every particle: a line each, or the member "final" of a document. */
void cli_print_final(hooke_state *state);
void cli_print_final_json(hooke_state *state);
