#include "print.h"

#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDED_DIGITS = 6, SAID_SIZE = 16384 };

const char *cli_format_rounded(double value, char text[HOOKE_NUMBER_SIZE]) {
  snprintf(text, HOOKE_NUMBER_SIZE, "%.*g", ROUNDED_DIGITS, value);
  return text;
}

const char *cli_format_number(double value, char text[HOOKE_NUMBER_SIZE]) {
  /* every decimal survives to 15 digits, except subnormal numbers, which have fewer */
  for (int digits = fabs(value) < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
    snprintf(text, HOOKE_NUMBER_SIZE, "%.*g", digits, value);
    if (strtod(text, NULL) == value) break;
  }
  return text;
}

void cli_append(char *text, size_t size, const char *format, ...) {
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  if (used < size) vsnprintf(text + used, size - used, format, args);
  va_end(args);
}

/* ---- foreign text ---- */

/* Length of the UTF-8 character at `text` (1 to 4); 0 if the bytes are invalid: of no character, of an
 * overlong form, a surrogate, or past U+10FFFF. */
static int32_t read_character(const char *text, uint32_t *point) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned char *byte = (const unsigned char *)text;
  const int32_t length = byte[0] < 0x80 ? 1 : byte[0] >= 0xf0 ? 4 : byte[0] >= 0xe0 ? 3 : 2;
  *point = length == 1 ? byte[0] : byte[0] & (0xffu >> (length + 1));
  if (length > 1 && (byte[0] < 0xc0 || byte[0] > 0xf7)) return 0;
  for (int32_t i = 1; i < length; i++) {
    if ((byte[i] & 0xc0) != 0x80) return 0;
    *point = *point << 6 | (byte[i] & 0x3fu);
  }
  return *point < least[length] || *point > 0x10ffff || (*point >= 0xd800 && *point <= 0xdfff) ? 0 : length;
}

/* The length of a character that does not control a terminal, end a line or change the direction of writing;
 * 0 if it does, or there is none. */
static int32_t plain_length(const char *text) {
  static const struct {
    uint32_t first, last;
  } table[] = {{0, 0x1f}, {0x7f, 0x9f}, {0x61c, 0x61c}, {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x2069}};
  uint32_t point;
  const int32_t length = read_character(text, &point);
  for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
    if (length > 0 && point >= table[i].first && point <= table[i].last) return 0;
  return length;
}

/* Length of the character at `text`, or of the byte in its place. */
static int32_t any_length(const char *text) {
  uint32_t point;
  const int32_t length = read_character(text, &point);
  return length > 0 ? length : 1;
}

/* Prints the first character of `text`, or an invalid byte, with '?' in place of unsafe ones; returns its
 * length. */
static int32_t print_character(FILE *file, const char *text) {
  const int32_t plain = plain_length(text);
  fwrite(plain ? text : "?", 1, plain ? (size_t)plain : 1, file);
  return any_length(text);
}

static int32_t is_plain(const char *text) {
  while (*text && plain_length(text))
    text += plain_length(text);
  return *text == '\0';
}

int32_t cli_print_text(FILE *file, const char *text) {
  int32_t count = 0;
  for (; *text; count++)
    text += print_character(file, text);
  return count;
}

void cli_say(const char *format, ...) {
  char text[SAID_SIZE];
  const size_t lines = strspn(format, "\n"), length = strlen(format);
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  const int ends = length > lines && format[length - 1] == '\n';
  if (ends && text[strlen(text) - 1] == '\n') text[strlen(text) - 1] = '\0';
  fprintf(stdout, "%.*s", (int)lines, text);
  cli_print_text(stdout, text + lines);
  if (ends) fputc('\n', stdout);
}

void cli_print_padded(FILE *file, int32_t width, const char *text) {
  for (int32_t count = cli_print_text(file, text); count < width; count++)
    fputc(' ', file);
}

void cli_string_add(struct cli_string *string, const char *format, ...) {
  const size_t used = string->bytes ? strlen(string->bytes) : 0;
  va_list args, again;
  va_start(args, format);
  va_copy(again, args);
  const size_t size = (size_t)vsnprintf(NULL, 0, format, args) + 1;
  char *longer = realloc(string->bytes, used + size);
  if (longer)
    vsnprintf(longer + used, size, format, again);
  else
    string->status = HOOKE_NO_MEMORY;
  if (longer) string->bytes = longer;
  va_end(again);
  va_end(args);
}

/* $'...', with bytes by number unless they are plain characters. */
static void escape(struct cli_string *string, const char *text) {
  cli_string_add(string, "$'");
  for (int32_t length; *text; text += length) {
    length = any_length(text);
    if (*text == '\n')
      cli_string_add(string, "\\n");
    else if (plain_length(text))
      cli_string_add(string, "%s%.*s", *text == '\'' || *text == '\\' ? "\\" : "", length, text);
    else
      for (int32_t i = 0; i < length; i++)
        cli_string_add(string, "\\%03o", (unsigned)(unsigned char)text[i]);
  }
  cli_string_add(string, "'");
}

void cli_string_quote(struct cli_string *string, const char *text) {
  static const char bare[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,:=+-@%";
  if (!is_plain(text)) {
    escape(string, text);
  } else if (text[0] && strspn(text, bare) == strlen(text)) {
    cli_string_add(string, "%s", text);
  } else {
    cli_string_add(string, "'");
    for (; *text; text++)
      cli_string_add(string, *text == '\'' ? "'\\''" : "%c", *text);
    cli_string_add(string, "'");
  }
}

void cli_print_quoted(FILE *file, const char *text) {
  struct cli_string quoted = {.bytes = NULL};
  cli_string_quote(&quoted, text);
  if (quoted.bytes) fputs(quoted.bytes, file);
  free(quoted.bytes);
}

int cli_print_flush(void) {
  static int first; /* output that could not be written is discarded */
  errno = 0;
  if (fflush(stdout) != 0 && first == 0) first = errno;
  return first;
}

void cli_print_wrapped(FILE *file, int32_t column, int32_t indent, int32_t width, const char *text) {
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
    if (!fresh) fputc(' ', file);
    for (const char *word = text; word < text + length;)
      word += print_character(file, word);
    column += length + (fresh ? 0 : 1);
    fresh = 0;
    text += length;
  }
  fputc('\n', file);
}

void cli_print_fact(int32_t indent, int32_t width, const char *label, const char *format, ...) {
  char text[SAID_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  printf("%-*s", indent, label);
  cli_print_wrapped(stdout, indent, indent, width, text);
}

/* ---- JSON ---- */

static void write_string(const char *text) {
  uint32_t point;
  fputs(text ? "\"" : "null", stdout);
  for (const char *at = text; at && *at; at += any_length(at)) {
    if (read_character(at, &point) == 0)
      fputs("\\ufffd", stdout);
    else if (plain_length(at) == 0)
      printf("\\u%04x", (unsigned)point);
    else
      printf("%s%.*s", *at == '"' || *at == '\\' ? "\\" : "", plain_length(at), at);
  }
  if (text) fputc('"', stdout);
}

void cli_print_json(const char *format, ...) {
  char text[HOOKE_NUMBER_SIZE];
  va_list args;
  va_start(args, format);
  for (; *format; format++) {
    if (*format != '%') {
      fputc(*format == '\'' ? '"' : *format, stdout);
      continue;
    }
    const size_t longer = strspn(++format, "lI64"); /* of PRId64 */
    format += longer;
    if (*format == 's') {
      write_string(va_arg(args, const char *));
    } else if (*format == 'g') {
      const double value = va_arg(args, double);
      fputs(isfinite(value) ? cli_format_number(value, text) : "null", stdout);
    } else {
      const int64_t count = longer ? va_arg(args, int64_t) : va_arg(args, int);
      printf(count < 0 ? "null" : "%" PRId64, count);
    }
  }
  va_end(args);
}

/* Whether the library takes it as JSON: what it then refuses is the key before it. */
static int is_json(const char *before, const char *value, const char *after) {
  struct cli_string text = {0};
  hooke_scene *none = NULL;
  cli_string_add(&text, "{\"hooke\":1,\"set\":%s%s%s}", before, value, after);
  if (text.bytes) (void)hooke_scene_parse(text.bytes, (int64_t)strlen(text.bytes), "set", NULL, NULL, &none);
  const int is = text.bytes && strncmp(hooke_last_error(), "set:1:12:", 9) == 0;
  free(text.bytes);
  return is;
}

/* Values between commas are an array; what is no JSON is a text. */
static void print_set(const char *value) {
  const int alone = is_json("", value, ""), listed = is_json("[", value, "]");
  if (alone && (listed || *value == '[')) /* and not a value with other members */
    fputs(value, stdout);
  else if (listed)
    printf("[%s]", value);
  else
    write_string(value);
}

void cli_print_json_set(const hooke_options *limits) {
  struct cli_string copy = {0};
  const char *before = "{";
  if (limits) cli_string_add(&copy, "%s", hooke_options_text(limits, "set"));
  for (char *path = copy.bytes, *next; path && *path; path = next, before = ", ") {
    next = path + strcspn(path, "\n");
    if (*next) *next++ = '\0';
    char *value = path + strcspn(path, "=");
    if (*value) *value++ = '\0';
    cli_print_json(before[0] == '{' ? "'set': {%s: " : ", %s: ", path);
    print_set(value);
  }
  if (before[0] == ',') cli_print_json("}, ");
  free(copy.bytes);
}

int32_t cli_print_members(const char *before, hooke_measurement *measurement, const char *table,
                          int64_t row) {
  const char *text = hooke_measurement_json(measurement, table, row);
  if (!text) return HOOKE_NO_MEMORY;
  fputs(before, stdout);
  fwrite(text + 1, 1, strlen(text) - 2, stdout);
  return HOOKE_OK;
}

/* ---- states ---- */

static void print_vectors(const char *key, int64_t rows, const double *xyz) {
  cli_print_json("%s: [", key);
  for (int64_t row = 0; row < rows; row++, xyz += 3)
    cli_print_json(row ? ", [%g, %g, %g]" : "[%g, %g, %g]", xyz[0], xyz[1], xyz[2]);
  cli_print_json("]");
}

void cli_print_final_json(hooke_state *state) {
  cli_print_json(", 'final': {");
  print_vectors("position", hooke_state_size(state) / 3, hooke_state_position(state));
  cli_print_json(", ");
  print_vectors("velocity", hooke_state_size(state) / 3, hooke_state_velocity(state));
  cli_print_json("}");
}

void cli_print_final(hooke_state *state) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  char text[HOOKE_NUMBER_SIZE];
  printf("\nparticle x y z [m] vx vy vz [m/s]\n");
  for (int64_t i = 0; i < hooke_state_size(state) / 3; i++) {
    printf("%" PRId64, i);
    for (int64_t k = 0; k < 6; k++)
      printf(" %s", cli_format_number(k < 3 ? q[3 * i + k] : v[3 * i + k - 3], text));
    printf("\n");
  }
  cli_print_flush();
}
