#include "io/scene/json_scan.h"

#include "core/number.h"
#include "core/table/option.h"
#include "core/status.h"

#include <string.h>

enum { DEEPEST = 32, SAFE_DIGITS = 18, SAFE_LENGTH = 300 };

static int is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* ---- scanning ---- */

static int32_t refuse_byte(unsigned char c) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "byte 0x%02x is not UTF-8; allowed: JSON in UTF-8", c);
}

/* Checks the bytes of one character (RFC 3629: no surrogates, no overlong forms). */
static int32_t follow_utf8(struct hk_json_guard *guard, unsigned char c) {
  if (guard->pending) {
    if (c < guard->lowest || c > guard->highest) return refuse_byte(guard->first);
    guard->pending--;
    guard->lowest = 0x80;
    guard->highest = 0xBF;
    return HOOKE_OK;
  }
  guard->column++;
  if (c < 0x80) return HOOKE_OK;
  guard->first = c;
  guard->lowest = c == 0xE0 ? 0xA0 : c == 0xF0 ? 0x90 : 0x80;
  guard->highest = c == 0xED ? 0x9F : c == 0xF4 ? 0x8F : 0xBF;
  if (c >= 0xC2 && c <= 0xDF)
    guard->pending = 1;
  else if (c >= 0xE0 && c <= 0xEF)
    guard->pending = 2;
  else if (c >= 0xF0 && c <= 0xF4)
    guard->pending = 3;
  else
    return refuse_byte(c);
  return HOOKE_OK;
}

static int32_t refuse_start(char c) {
  if ((unsigned char)c == 0xEF)
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "starts with a byte order mark or text; allowed: one JSON object, starting with {");
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(&c, (unsigned char)c < 0x80, shown);
  return hk_fail(HOOKE_BAD_VALUE, NULL, "starts with \"%s\"; allowed: one JSON object, starting with {",
                 shown);
}

/* Refuses empty arrays and objects inside an array: no scene needs them, and millions of them would fill the
 * memory. */
static int32_t follow_bracket(struct hk_json_guard *guard, char c) {
  if (c == '{' || c == '[') {
    if (++guard->depth > DEEPEST)
      return hk_fail(HOOKE_BAD_VALUE, NULL, "nested %d levels deep; allowed: up to %d", DEEPEST + 1, DEEPEST);
    guard->arrays = guard->arrays << 1 | (c == '[');
    guard->lists += c == '[';
    guard->objects += c == '{';
  } else if (c == '}' || c == ']') {
    if ((guard->arrays & 1) != (c == ']'))
      return hk_fail(HOOKE_BAD_VALUE, NULL, "%c closes nothing; allowed: brackets in pairs", c);
    guard->depth--;
    guard->arrays >>= 1;
    if ((guard->arrays & 1) && (guard->last == '[' || guard->last == '{'))
      return hk_fail(HOOKE_BAD_VALUE, NULL,
                     "nothing between %c and %c; allowed in an array: values that are not empty", guard->last,
                     c);
  }
  return HOOKE_OK;
}

static int32_t follow_structure(struct hk_json_guard *guard, char c) {
  if (guard->in_string) {
    if (guard->escaped)
      guard->escaped = 0;
    else if (c == '\\')
      guard->escaped = 1;
    else if (c == '"')
      guard->in_string = 0;
    return HOOKE_OK;
  }
  if (is_space(c)) return HOOKE_OK;
  if (!guard->started && c != '{') return refuse_start(c);
  if (guard->started && guard->depth == 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "text after the end; allowed: one JSON object and nothing after it");
  guard->started = 1;
  if (c == '"') guard->in_string = 1;
  guard->values += c == ',' || c == '[' || c == '{';
  int32_t status = follow_bracket(guard, c);
  guard->last = c;
  return status;
}

int32_t hk_json_guard_feed(struct hk_json_guard *guard, const char *bytes, int64_t count) {
  if (guard->line == 0) guard->line = 1;
  for (int64_t k = 0; k < count; k++) {
    char c = bytes[k];
    if (follow_utf8(guard, (unsigned char)c)) return HOOKE_BAD_VALUE;
    if (c == '\0') return hk_fail(HOOKE_BAD_VALUE, NULL, "a NUL byte; allowed: JSON in UTF-8");
    if (follow_structure(guard, c)) return HOOKE_BAD_VALUE;
    if (c == '\n') {
      guard->line++;
      guard->column = 0;
    }
  }
  return HOOKE_OK;
}

double hk_json_guard_bytes(const struct hk_json_guard *guard, int64_t length) {
  /* measured with jansson 2.14: the text takes up to three times its size while it grows, and its strings
   * take memory again */
  static const double per_value = 64.0, per_list = 144.0, per_object = 400.0, per_byte = 4.0;
  return per_value * (double)guard->values + per_list * (double)guard->lists +
         per_object * (double)guard->objects + per_byte * (double)length;
}

int32_t hk_json_guard_end(const struct hk_json_guard *guard) {
  if (guard->pending) return refuse_byte(guard->first);
  if (!guard->started)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "is empty; allowed: one JSON object, starting with {");
  return HOOKE_OK;
}

/* ---- tokens ---- */

static int is_digit(char c) {
  return c >= '0' && c <= '9';
}

static int is_bare(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '+' ||
         c == '-' || c == '.';
}

static int64_t skip_digits(const char *token, int64_t at, int64_t length) {
  while (at < length && is_digit(token[at]))
    at++;
  return at;
}

/* RFC 8259; `real` is set if there is a point or an exponent. */
static int is_json_number(const char *token, int64_t length, int *real) {
  int64_t at = token[0] == '-', start = at;
  *real = 0;
  at = skip_digits(token, at, length);
  if (at == start || (token[start] == '0' && at > start + 1)) return 0;
  if (at < length && token[at] == '.') {
    *real = 1;
    start = at + 1;
    at = skip_digits(token, start, length);
    if (at == start) return 0;
  }
  if (at < length && (token[at] == 'e' || token[at] == 'E')) {
    *real = 1;
    at++;
    if (at < length && (token[at] == '+' || token[at] == '-')) at++;
    start = at;
    at = skip_digits(token, start, length);
    if (at == start) return 0;
  }
  return at == length;
}

/* True if an integer without leading zeros fits 64 bits. */
static int fits_64_bits(const char *token, int64_t length) {
  int negative = token[0] == '-';
  int64_t digits = length - negative;
  const char *most = negative ? "9223372036854775808" : "9223372036854775807";
  if (digits != SAFE_DIGITS + 1) return digits <= SAFE_DIGITS;
  return strncmp(token + negative, most, SAFE_DIGITS + 1) <= 0;
}

static int32_t check_real(const char *token, int64_t length, const char *shown) {
  if (length < SAFE_LENGTH && !memchr(token, 'e', (size_t)length) && !memchr(token, 'E', (size_t)length))
    return HOOKE_OK;
  double value;
  switch (hk_number_parse(token, length, &value)) {
  case HOOKE_NUMBER_TOO_LARGE:
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s is beyond the largest number; allowed: up to 1.797e308", shown);
  case HOOKE_NUMBER_TOO_SMALL:
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s would become 0; allowed: 0, or numbers from 4.94e-324 up",
                   shown);
  case HOOKE_NUMBER_NO_MEMORY:
    return HOOKE_NO_MEMORY;
  case HOOKE_NUMBER_FINE:
  case HOOKE_NUMBER_JUNK:
    break;
  }
  return HOOKE_OK;
}

static int32_t check_token(const char *token, int64_t length) {
  int real = 0;
  if (hk_option_has_word("true false null", token, length)) return HOOKE_OK;
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(token, length, shown);
  if (!is_json_number(token, length, &real))
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "%s is not JSON; allowed: a finite decimal number, \"text\", true, false or null", shown);
  if (real) return check_real(token, length, shown);
  if (fits_64_bits(token, length)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s is too large; allowed: whole numbers of 64 bits, or with a point or exponent", shown);
}

static int32_t refuse_stray(const char *c, const char *end) {
  if (*c == '/')
    return hk_fail(HOOKE_BAD_VALUE, NULL, "a comment is not JSON; allowed: only JSON (RFC 8259)");
  int64_t length = 1;
  while (c + length < end && ((unsigned char)c[length] & 0xC0) == 0x80)
    length++;
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(c, length, shown);
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s is not JSON; allowed: { } [ ] : , numbers, \"text\", true, false, null", shown);
}

int32_t hk_json_check_tokens(const char *text, int64_t length, const char **at) {
  const char *end = text + length;
  for (const char *c = text; c < end; c++) {
    if (*c == '"') {
      for (c++; c < end && *c != '"'; c++)
        if (*c == '\\') c++;
    } else if (is_bare(*c)) {
      *at = c;
      while (c < end && is_bare(*c))
        c++;
      int32_t status = check_token(*at, c - *at);
      if (status) return status;
      c--;
    } else if (!is_space(*c) && !strchr("{}[]:,", *c)) {
      *at = c;
      return refuse_stray(c, end);
    }
  }
  return HOOKE_OK;
}
