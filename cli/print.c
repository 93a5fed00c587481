#include "print.h"

#include "hooke.h"

#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDED_DIGITS = 6 };

const char *hooke_format_rounded(double value, char text[HOOKE_NUMBER_SIZE]) {
  snprintf(text, HOOKE_NUMBER_SIZE, "%.*g", ROUNDED_DIGITS, value);
  return text;
}

const char *hooke_format_number(double value, char text[HOOKE_NUMBER_SIZE]) {
  /* to 15 digits every decimal survives, but in subnormal numbers, which have fewer */
  for (int digits = fabs(value) < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
    snprintf(text, HOOKE_NUMBER_SIZE, "%.*g", digits, value);
    if (strtod(text, NULL) == value) break;
  }
  return text;
}

void hooke_print_text(FILE *file, const char *text) {
  for (; *text; text++) {
    unsigned char byte = (unsigned char)*text;
    fputc((byte < 0x20 && byte != '\n') || byte == 0x7f ? '?' : byte, file);
  }
}

void hooke_print_quoted(FILE *file, const char *text) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,:=+-@%";
  if (text[0] && strspn(text, plain) == strlen(text)) {
    hooke_print_text(file, text);
    return;
  }
  fputc('\'', file);
  for (; *text; text++) {
    char one[2] = {*text, '\0'};
    if (*text == '\'') {
      fputs("'\\''", file);
    } else {
      hooke_print_text(file, one);
    }
  }
  fputc('\'', file);
}

int hooke_print_flush(void) {
  static int first; /* what could not be written is not held back any longer */
  errno = 0;
  if (fflush(stdout) != 0 && first == 0) first = errno;
  return first;
}

int32_t hooke_print_end(FILE *stream, char **text) {
  const int fine = stream && !ferror(stream);
  if (stream && fclose(stream) == 0 && fine && *text) return HOOKE_OK;
  free(*text);
  *text = NULL;
  return HOOKE_NO_MEMORY;
}

void hooke_print_wrapped(FILE *file, int32_t column, int32_t indent, int32_t width, const char *text) {
  int32_t fresh = 1; /* no blank before the first word of a line */
  while (*text) {
    text += strspn(text, " ");
    int32_t length = (int32_t)strcspn(text, " ");
    if (length == 0) break;
    if (!fresh && column + 1 + length > width) {
      fprintf(file, "\n%*s", indent, "");
      column = indent;
      fresh = 1;
    }
    fprintf(file, "%s%.*s", fresh ? "" : " ", length, text);
    column += length + (fresh ? 0 : 1);
    fresh = 0;
    text += length;
  }
  fputc('\n', file);
}

/* ---- JSON ---- */

/* Length of the UTF-8 character at `text` (1 to 4), 0 if the bytes are none. */
static int32_t utf8_length(const unsigned char *text) {
  if (text[0] < 0x80) return 1;
  int32_t length = text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
  if (text[0] < 0xc2 || text[0] > 0xf4) return 0;
  for (int32_t i = 1; i < length; i++) {
    if ((text[i] & 0xc0) != 0x80) return 0;
  }
  /* overlong forms, surrogates, and what lies past U+10FFFF */
  if (text[0] == 0xe0 && text[1] < 0xa0) return 0;
  if (text[0] == 0xed && text[1] > 0x9f) return 0;
  if (text[0] == 0xf0 && text[1] < 0x90) return 0;
  if (text[0] == 0xf4 && text[1] > 0x8f) return 0;
  return length;
}

static void write_string(FILE *file, const char *text) {
  const unsigned char *at = (const unsigned char *)text;
  fputc('"', file);
  while (*at) {
    int32_t length = utf8_length(at);
    if (length == 0) {
      fputs("\\ufffd", file);
      length = 1;
    } else if (*at == '"' || *at == '\\') {
      fprintf(file, "\\%c", *at);
    } else if (*at == '\n') {
      fputs("\\n", file);
    } else if (*at == '\t') {
      fputs("\\t", file);
    } else if (*at < 0x20 || *at == 0x7f) {
      fprintf(file, "\\u%04x", *at);
    } else {
      fwrite(at, 1, (size_t)length, file);
    }
    at += length;
  }
  fputc('"', file);
}

static void write_key(struct hooke_json *json, const char *key) {
  if (json->depth > 0) {
    int32_t *filled = &json->filled[json->depth - 1];
    if (*filled) fputs(", ", json->file);
    *filled = 1;
  }
  if (key) {
    write_string(json->file, key);
    fputs(": ", json->file);
  }
}

void hooke_json_begin(struct hooke_json *json, FILE *file) {
  memset(json, 0, sizeof *json);
  json->file = file;
  hooke_json_open(json, NULL, '{');
}

void hooke_json_end(struct hooke_json *json) {
  while (json->depth > 0)
    hooke_json_close(json);
  fputc('\n', json->file);
}

void hooke_json_open(struct hooke_json *json, const char *key, char bracket) {
  write_key(json, key);
  fputc(bracket, json->file);
  json->bracket[json->depth] = bracket;
  json->filled[json->depth] = 0;
  json->depth++;
}

void hooke_json_close(struct hooke_json *json) {
  json->depth--;
  fputc(json->bracket[json->depth] == '{' ? '}' : ']', json->file);
}

void hooke_json_number(struct hooke_json *json, const char *key, double value) {
  char text[HOOKE_NUMBER_SIZE];
  write_key(json, key);
  fputs(isfinite(value) ? hooke_format_number(value, text) : "null", json->file);
}

void hooke_json_flag(struct hooke_json *json, const char *key, int32_t value) {
  write_key(json, key);
  fputs(value ? "true" : "false", json->file);
}

void hooke_json_count(struct hooke_json *json, const char *key, int64_t value) {
  write_key(json, key);
  fprintf(json->file, "%" PRId64, value);
}

void hooke_json_text(struct hooke_json *json, const char *key, const char *text) {
  write_key(json, key);
  if (text) {
    write_string(json->file, text);
  } else {
    fputs("null", json->file);
  }
}

void hooke_json_vectors(struct hooke_json *json, const char *key, int64_t rows, const double *xyz) {
  hooke_json_open(json, key, '[');
  for (int64_t row = 0; row < rows; row++) {
    hooke_json_open(json, NULL, '[');
    for (int64_t i = 0; i < 3; i++)
      hooke_json_number(json, NULL, xyz[3 * row + i]);
    hooke_json_close(json);
  }
  hooke_json_close(json);
}
