/* Printing: numbers that read back to the same bits, JSON, and text that is safe on a terminal. */
#ifndef HOOKE_CLI_PRINT_H
#define HOOKE_CLI_PRINT_H

#include <stdint.h>
#include <stdio.h>

enum { HOOKE_NUMBER_SIZE = 32, HOOKE_JSON_DEPTH = 8 };

/* For people: writes the number to 6 digits into `text` and returns it. What is known to fewer is printed with fewer. */
const char *hooke_format_rounded(double value, char text[HOOKE_NUMBER_SIZE]);

/* For programs and for commands to type: as above, with the fewest digits that read back to the same double. */
const char *hooke_format_number(double value, char text[HOOKE_NUMBER_SIZE]);

/* Text from outside, a title, a name or a file name, on one line: '?' for each character by which it could steer a terminal,
 * end a line or turn the direction of writing, and for bytes that are not UTF-8. All such text is printed here, by what
 * follows or as JSON. The number of characters printed. */
int32_t hooke_print_text(FILE *file, const char *text);

/* The same, and blanks up to `width` characters. */
void hooke_print_padded(FILE *file, int32_t width, const char *text);

/* Writes what is held back of standard output, so that words on standard error come after it. 0, or the number of the system's
 * error: the first one there was. */
int hooke_print_flush(void);

/* Closes a stream of open_memstream(), which may be NULL. HOOKE_NO_MEMORY, and `text` is NULL, unless it holds all. */
int32_t hooke_print_end(FILE *stream, char **text);

/* Text as one word of a shell command, quoted if it has to be; as $'...' where hooke_print_text() would change it. */
void hooke_print_quoted(FILE *file, const char *text);

/* Text broken at blanks before column `width`; lines after the first start at column `indent`. */
void hooke_print_wrapped(FILE *file, int32_t column, int32_t indent, int32_t width, const char *text);

/* A JSON value being written, on one line. `key` is NULL inside arrays. */
struct hooke_json {
  FILE *file;
  int32_t depth;
  char bracket[HOOKE_JSON_DEPTH];
  int32_t filled[HOOKE_JSON_DEPTH];
};

void hooke_json_begin(struct hooke_json *json, FILE *file);
/* Closes what is open and ends the line. */
void hooke_json_end(struct hooke_json *json);
void hooke_json_open(struct hooke_json *json, const char *key, char bracket); /* '{' or '[' */
void hooke_json_close(struct hooke_json *json);
/* null if the number is not finite */
void hooke_json_number(struct hooke_json *json, const char *key, double value);
void hooke_json_flag(struct hooke_json *json, const char *key, int32_t value); /* true or false */
void hooke_json_count(struct hooke_json *json, const char *key, int64_t value);
/* null if `text` is NULL; bytes that are not UTF-8 become U+FFFD, and what hooke_print_text() replaces is escaped */
void hooke_json_text(struct hooke_json *json, const char *key, const char *text);
/* `rows` rows of x y z as an array of arrays */
void hooke_json_vectors(struct hooke_json *json, const char *key, int64_t rows, const double *xyz);

#endif
