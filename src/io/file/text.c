#include "io/file/text.h"

#include "core/memory.h"
#include "core/number.h"
#include "core/utf8.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const int64_t FIRST_CAPACITY = 1 << 16;

void hk_text_add(struct hk_text *text, const char *bytes, int64_t length) {
  if (text->status != HOOKE_OK) return;
  if (length > text->capacity - text->length) {
    int64_t capacity = text->capacity > 0 ? 2 * text->capacity : FIRST_CAPACITY;
    if (capacity < text->length + length) capacity = text->length + length;
    text->status = hk_grow((void **)&text->bytes, text->length, capacity, 1);
    if (text->status != HOOKE_OK) return;
    text->capacity = capacity;
  }
  memcpy(text->bytes + text->length, bytes, (size_t)length);
  text->length += length;
}

void hk_text_say(struct hk_text *text, const char *words) {
  hk_text_add(text, words, (int64_t)strlen(words));
}

void hk_text_release(struct hk_text *text) {
  hk_free(text->bytes);
  *text = (struct hk_text){.bytes = NULL};
}

/* ---- CSV ---- */

void hk_text_quoted(struct hk_text *text, const char *words) {
  hk_text_say(text, "\"");
  for (; *words; words++)
    hk_text_add(text, *words == '"' ? "\"\"" : words, *words == '"' ? 2 : 1);
  hk_text_say(text, "\"");
}

void hk_text_cell(struct hk_text *text, const char *words) {
  if (words == NULL) return;
  if (strpbrk(words, ",\"\r\n"))
    hk_text_quoted(text, words);
  else
    hk_text_say(text, words);
}

/* ---- JSON ---- */

/* Escapes "<", so that no text ends the enclosing element or begins a comment, and characters that control
 * terminals. */
static void add_quoted(struct hk_text *text, const char *words) {
  hk_text_say(text, "\"");
  const char *at = words;
  for (int64_t left = (int64_t)strlen(words), bytes; left > 0; left -= bytes) {
    bytes = hk_utf8_character(at, left);
    uint32_t escape = hk_utf8_control(at, bytes);
    if (strchr("\"\\<", *at)) escape = (unsigned char)*at;
    if (bytes == 0) bytes = 1;
    at += bytes;
    if (escape == 0) continue;
    char escaped[12];
    snprintf(escaped, sizeof escaped, "\\u%04x", (unsigned)escape);
    hk_text_add(text, words, at - bytes - words);
    hk_text_say(text, escaped);
    words = at;
  }
  hk_text_add(text, words, at - words);
  hk_text_say(text, "\"");
}

static void begin(struct hk_text *text, const char *key) {
  const char last = text->length > 0 ? text->bytes[text->length - 1] : '{';
  if (!strchr("{[>", last)) hk_text_say(text, text->is_spaced ? ", " : ",");
  if (key == NULL) return;
  add_quoted(text, key);
  hk_text_say(text, text->is_spaced ? ": " : ":");
}

void hk_text_open(struct hk_text *text, const char *key, char bracket) {
  begin(text, key);
  hk_text_add(text, &bracket, 1);
}

void hk_text_close(struct hk_text *text, char bracket) {
  hk_text_add(text, &bracket, 1);
}

/* "-0" would be read as an integer, and integers have a single 0 */
void hk_text_number(struct hk_text *text, const char *key, double value) {
  char number[HOOKE_NUMBER_SIZE] = "null";
  if (isfinite(value)) hk_number_print(value, number);
  if (value == 0.0 && signbit(value)) strcpy(number, "-0.0");
  begin(text, key);
  hk_text_say(text, number);
}

void hk_text_numbers(struct hk_text *text, const char *key, int64_t count, const double *value) {
  hk_text_open(text, key, '[');
  for (int64_t k = 0; k < count; k++)
    hk_text_number(text, NULL, value[k]);
  hk_text_close(text, ']');
}

void hk_text_wholes(struct hk_text *text, const char *key, int64_t count, const int64_t *value) {
  hk_text_open(text, key, '[');
  for (int64_t k = 0; k < count; k++)
    hk_text_number(text, NULL, (double)value[k]);
  hk_text_close(text, ']');
}

void hk_text_flag(struct hk_text *text, const char *key, int32_t flag) {
  begin(text, key);
  hk_text_say(text, flag ? "true" : "false");
}

void hk_text_word(struct hk_text *text, const char *key, const char *word) {
  begin(text, key);
  if (word)
    add_quoted(text, word);
  else
    hk_text_say(text, "null");
}
