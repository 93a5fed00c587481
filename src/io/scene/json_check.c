/* The syntax of JSON. A text ends with a NUL, at which every search stops. */
#include "io/scene/json.h"

#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "core/table/option.h"
#include "core/utf8.h"

#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 32, SHORT_ESCAPE = 6, LONGEST_ESCAPE = 12, SAFE_LENGTH = 300 };

struct scan {
  const char *at, *end;
  int32_t depth;
};

static const char digits[] = "0123456789";
static const char bare[] = "0123456789+-._abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* ---- faults ---- */

/* Shows a word or an escape, or the beginning of a text. */
static void show(const struct scan *scan, char *shown) {
  const int32_t quoted = *scan->at == '"', escape = *scan->at == '\\';
  const char *after = scan->at + (quoted || escape);
  int64_t length = after - scan->at + (int64_t)(quoted ? strcspn(after, "\"\n") : strspn(after, bare));
  if (quoted && scan->at[length] == '"') length++;
  if (escape && length > SHORT_ESCAPE) length = SHORT_ESCAPE;
  if (length == 0) length = hk_utf8_character(scan->at, scan->end - scan->at);
  hk_option_show(scan->at, length, shown);
}

/* Fails with what is at the place, which is not `allowed` there. */
static int32_t refuse(const struct scan *scan, const char *allowed) {
  static const char byte_order_mark[] = "\xEF\xBB\xBF";
  char shown[HOOKE_OPTION_SHOWN] = "a comment";
  if (scan->at == scan->end)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "the text ends too early; allowed: one whole JSON object");
  if (*scan->at == '\0') return hk_fail(HOOKE_BAD_VALUE, NULL, "a NUL byte; allowed: JSON in UTF-8");
  if (hk_utf8_character(scan->at, scan->end - scan->at) == 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "byte 0x%02x is not UTF-8; allowed: JSON in UTF-8",
                   (unsigned char)*scan->at);
  if (strncmp(scan->at, byte_order_mark, strlen(byte_order_mark)) == 0)
    strcpy(shown, "a byte order mark");
  else if (*scan->at != '/')
    show(scan, shown);
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s is not JSON here; allowed: %s", shown, allowed);
}

/* ---- texts ---- */

/* The number in \uXXXX; 0 if this is none. */
static uint32_t read_hexadecimal(const char *at) {
  static const char all[] = "0123456789abcdefABCDEF";
  uint32_t number = 0;
  if (strspn(at, "\\") != 1 || at[1] != 'u' || strspn(at + 2, all) < 4) return 0;
  for (int k = 2; k < 6; k++) {
    const uint32_t digit = (uint32_t)(strchr(all, at[k]) - all);
    number = 16 * number + (digit < 16 ? digit : digit - 6);
  }
  return number;
}

/* The character of an escape of `length` characters; 0 if it is none, is U+0000, or half of a pair. */
static uint32_t read_escape(const char *at, int64_t *length) {
  static const char names[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
  const char *name = at[1] ? strchr(names, at[1]) : NULL;
  *length = 2;
  if (name) return (unsigned char)meant[name - names];
  const uint32_t first = read_hexadecimal(at);
  *length = SHORT_ESCAPE;
  if (first < 0xD800 || first > 0xDFFF) return first;
  const uint32_t second = first < 0xDC00 ? read_hexadecimal(at + 6) : 0;
  *length = LONGEST_ESCAPE;
  return second >= 0xDC00 && second <= 0xDFFF ? 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00) : 0;
}

static int32_t scan_text(struct scan *scan) {
  for (scan->at++; *scan->at != '"';) {
    const unsigned char c = (unsigned char)*scan->at;
    int64_t length = hk_utf8_character(scan->at, scan->end - scan->at);
    if (c == '\0' || length == 0) return refuse(scan, "");
    if (c < ' ')
      return hk_fail(HOOKE_BAD_VALUE, NULL, "control character 0x%02x in a text; allowed: \\u%04x", c, c);
    if (c == '\\' && read_escape(scan->at, &length) == 0)
      return refuse(scan, "an escape of a character, which is neither U+0000 nor half of a pair");
    scan->at += length;
  }
  scan->at++;
  return HOOKE_OK;
}

static char *add_character(char *to, uint32_t c) {
  static const unsigned char lead[] = {0, 0, 0xC0, 0xE0, 0xF0};
  const int bytes = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
  for (int k = bytes - 1; k > 0; k--, c >>= 6)
    to[k] = (char)(0x80 | (c & 0x3F));
  to[0] = (char)(lead[bytes] | c);
  return to + bytes;
}

static void decode(char *text) {
  for (char *at = text; (at = strchr(at, '"')) != NULL; at++) {
    char *to = ++at;
    while (*at != '"') {
      int64_t length = 1;
      if (*at == '\\')
        to = add_character(to, read_escape(at, &length));
      else
        *to++ = *at;
      at += length;
    }
    memset(to, '\0', (size_t)(at + 1 - to));
  }
}

/* ---- numbers and words ---- */

static int32_t refuse_number(const char *token, int64_t length, const char *what, const char *allowed) {
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(token, length, shown);
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s %s; allowed: %s", shown, what, allowed);
}

/* JSON (RFC 8259) has fewer numbers than hk_number_parse(): digits stand before a point and after it, and no
 * zero before them. `junk` is set if this is none. */
static int32_t check_number(const char *token, int64_t length, int32_t *junk) {
  const char *first = token + (*token == '-'), *after = first + strspn(first, digits);
  double value;
  *junk =
      after == first || (*first == '0' && after > first + 1) || (*after == '.' && !strspn(after + 1, digits));
  if (*junk) return HOOKE_OK;
  if (after == token + length) {
    errno = 0;
    strtoll(token, NULL, 10);
    if (errno != ERANGE) return HOOKE_OK;
    return refuse_number(token, length, "is too large",
                         "whole numbers of 64 bits, or with a point or exponent");
  }
  if (*after == '.') after += 1 + strspn(after + 1, digits);
  if (after == token + length && length < SAFE_LENGTH) return HOOKE_OK; /* most are not parsed twice */
  const enum hk_number_result result = hk_number_parse(token, length, &value);
  if (result == HOOKE_NUMBER_TOO_LARGE)
    return refuse_number(token, length, "is beyond the largest number", "up to 1.797e308");
  if (result == HOOKE_NUMBER_TOO_SMALL)
    return refuse_number(token, length, "would become 0", "0, or numbers from 4.94e-324 up");
  *junk = result == HOOKE_NUMBER_JUNK;
  return result == HOOKE_NUMBER_NO_MEMORY ? HOOKE_NO_MEMORY : HOOKE_OK;
}

/* A word that reaches the end may go on there. */
static int32_t scan_word(struct scan *scan) {
  HOOKE_KEEP_ERRNO;
  const int64_t length = (int64_t)strspn(scan->at, bare);
  int32_t junk = 1, status = HOOKE_OK;
  if (scan->at + length == scan->end)
    scan->at = scan->end;
  else if (hk_option_has_word("true false null", scan->at, length))
    junk = 0;
  else
    status = check_number(scan->at, length, &junk);
  if (junk) return refuse(scan, "a finite decimal number, \"text\", true, false, null, [ or {");
  if (status == HOOKE_OK) scan->at += length;
  return status;
}

/* ---- arrays and objects ---- */

static int32_t scan_value(struct scan *scan, char within);

static int32_t scan_member(struct scan *scan) {
  int32_t status = *scan->at == '"' ? scan_text(scan) : refuse(scan, "the \"key\" of a value");
  if (status != HOOKE_OK) return status;
  scan->at = hk_json_skip_blanks(scan->at);
  if (*scan->at != ':') return refuse(scan, ":");
  scan->at++;
  scan->at = hk_json_skip_blanks(scan->at);
  return scan_value(scan, '{');
}

static int32_t scan_items(struct scan *scan, char open, char close) {
  int32_t status = HOOKE_OK;
  do {
    scan->at++;
    scan->at = hk_json_skip_blanks(scan->at);
    if (*scan->at == close) return refuse(scan, "no comma before it");
    status = open == '{' ? scan_member(scan) : scan_value(scan, '[');
    if (status != HOOKE_OK) return status;
    scan->at = hk_json_skip_blanks(scan->at);
  } while (*scan->at == ',');
  if (*scan->at != close) return refuse(scan, open == '{' ? ", or }" : ", or ]");
  scan->at++;
  return HOOKE_OK;
}

/* No scene needs empty brackets in an array, and one that goes on with millions of them is refused early. */
static int32_t scan_brackets(struct scan *scan, char within) {
  const char open = *scan->at, close = open == '{' ? '}' : ']';
  if (++scan->depth > DEEPEST)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "nested %d levels deep; allowed: up to %d", DEEPEST + 1, DEEPEST);
  const char *inside = hk_json_skip_blanks(scan->at + 1);
  int32_t status = HOOKE_OK;
  if (*inside != close) {
    status = scan_items(scan, open, close);
  } else {
    scan->at = inside;
    if (within == '[')
      return hk_fail(HOOKE_BAD_VALUE, NULL,
                     "nothing between %c and %c; allowed in an array: values that are not empty", open,
                     close);
    scan->at++;
  }
  scan->depth--;
  return status;
}

static int32_t scan_value(struct scan *scan, char within) {
  if (*scan->at == '{' || *scan->at == '[') return scan_brackets(scan, within);
  return *scan->at == '"' ? scan_text(scan) : scan_word(scan);
}

static int32_t check(const char *text, int64_t length, const char **at) {
  struct scan scan = {hk_json_skip_blanks(text), text + length, 0};
  *at = scan.at;
  if (scan.at == scan.end)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "is empty; allowed: one JSON object, starting with {");
  int32_t status =
      *scan.at == '{' ? scan_value(&scan, '\0') : refuse(&scan, "one JSON object, starting with {");
  if (status == HOOKE_OK) scan.at = hk_json_skip_blanks(scan.at);
  if (status == HOOKE_OK && scan.at < scan.end)
    status =
        hk_fail(HOOKE_BAD_VALUE, NULL, "text after the end; allowed: one JSON object and nothing after it");
  *at = scan.at;
  return status;
}

int32_t hk_json_is_hopeless(const char *text, int64_t length) {
  const char *at;
  return check(text, length, &at) == HOOKE_BAD_VALUE && at + LONGEST_ESCAPE < text + length;
}

int32_t hk_json_open(const char *text, int64_t length, char **json, const char **at) {
  *json = NULL;
  const int32_t status = check(text, length, at);
  if (status != HOOKE_OK) return status;
  *json = hk_copy_text(text);
  if (*json == NULL) return HOOKE_NO_MEMORY;
  decode(*json);
  return HOOKE_OK;
}
