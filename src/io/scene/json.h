/* JSON that is read where it lies: a value is the place in the text where it begins. */
#pragma once

#include "hooke/base.h"

static inline const char *hk_json_skip_blanks(const char *at) {
  while (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')
    at++;
  return at;
}

/* ---- json_check.c ---- */

/* Checks that a text, which ends with a NUL that `length` does not count, is one JSON object in UTF-8 (RFC
 * 8259), whose numbers a double can hold and whose texts have no U+0000. `json` is then a copy, which the
 * caller frees and the functions below read: values are where they were, and every text is decoded and ends
 * with a NUL. On failure `at` is the place of the fault: the end, if the text only ends too early.
 * HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_json_open(const char *text, int64_t length, char **json, const char **at);

/* True if no end makes JSON of this beginning of a text. */
int32_t hk_json_is_hopeless(const char *text, int64_t length);

/* ---- json_walk.c ---- */

/* 1 if there is a value, which begins with `first`: one of { [ " t f n. */
int32_t hk_json_is(const char *value, char first);
int32_t hk_json_is_number(const char *value);
/* 1 for a number without point and exponent; it fits 64 bits. */
int32_t hk_json_is_integer(const char *value);

int64_t hk_json_integer(const char *value);
/* HOOKE_NO_MEMORY, for very long numbers. */
int32_t hk_json_number(const char *value, double *number);

/* Number of characters of a number or a word. */
int64_t hk_json_length(const char *value);

/* A text; NULL if the value is no text, or is NULL. */
const char *hk_json_text(const char *value);

/* The first element of an array, or the first key of an object, and the next one; NULL if there is none.
 * Other values have none. */
const char *hk_json_first(const char *value);
const char *hk_json_next(const char *item);

/* What follows a value. */
const char *hk_json_end(const char *value);

int64_t hk_json_count(const char *array);

/* The value of a key, and that of the first key of this name; NULL if there is none, or `object` is no
 * object. */
const char *hk_json_member(const char *key);
const char *hk_json_get(const char *object, const char *key);

/* The value at a path such as "springs[2].stiffness[3]", or at the longest beginning of it that exists; with
 * `key` not 0, its key. */
const char *hk_json_find(const char *text, const char *path, int32_t key);

/* Line and column (from 1, in characters) of a place in a text. */
void hk_json_line(const char *text, const char *at, int64_t *line, int64_t *column);
