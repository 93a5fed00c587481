/* Growing text, and JSON in it. */
#pragma once

#include "hooke/base.h"

/* Starts as zeros. A failure is kept in `status`; later additions are ignored. */
struct hk_text {
  char *bytes; /* not terminated */
  int64_t length, capacity;
  int32_t is_spaced; /* 1: with blanks between the parts of JSON */
  int32_t status;
};

void hk_text_add(struct hk_text *text, const char *bytes, int64_t length);
void hk_text_say(struct hk_text *text, const char *words);
void hk_text_release(struct hk_text *text);

/* A text in CSV: always in quotes, or only where it would break the line; NULL is nothing. */
void hk_text_quoted(struct hk_text *text, const char *words);
void hk_text_cell(struct hk_text *text, const char *words);

/* JSON, from the start of a text or of an element of a page: `key` is NULL in an array. Non-finite numbers
 * and NULL texts become null. Any text is safe inside a <script> element. */
void hk_text_open(struct hk_text *text, const char *key, char bracket);
void hk_text_close(struct hk_text *text, char bracket);
void hk_text_number(struct hk_text *text, const char *key, double value);
void hk_text_word(struct hk_text *text, const char *key, const char *word);
void hk_text_flag(struct hk_text *text, const char *key, int32_t flag);
/* Arrays of numbers. */
void hk_text_numbers(struct hk_text *text, const char *key, int64_t count, const double *value);
void hk_text_wholes(struct hk_text *text, const char *key, int64_t count, const int64_t *value);

/* Appends to `laid` the one JSON value in `json`, in a readable layout. */
void hk_text_lay_out(const struct hk_text *json, struct hk_text *laid);
