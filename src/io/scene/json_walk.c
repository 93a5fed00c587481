/* Values of a text that was checked and decoded: its texts end with a NUL, and go on with NULs up to their
 * end. */
#include "io/scene/json.h"

#include "core/number.h"
#include "core/status.h"

#include <stdlib.h>
#include <string.h>

static const char after_word[] = ",]} \t\r\n";

/* ---- one value ---- */

int32_t hk_json_is(const char *value, char first) {
  return value && *value == first;
}

int32_t hk_json_is_number(const char *value) {
  return value && (*value == '-' || (*value >= '0' && *value <= '9'));
}

int32_t hk_json_is_integer(const char *value) {
  return hk_json_is_number(value) && !strchr(".eE", value[strspn(value, "-0123456789")]);
}

int64_t hk_json_integer(const char *value) {
  return strtoll(value, NULL, 10);
}

/* Integers have a single 0. */
int32_t hk_json_number(const char *value, double *number) {
  if (hk_json_is_integer(value)) {
    *number = (double)hk_json_integer(value);
    return HOOKE_OK;
  }
  const enum hk_number_result result = hk_number_parse(value, hk_json_length(value), number);
  return result == HOOKE_NUMBER_FINE ? HOOKE_OK : hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a number");
}

int64_t hk_json_length(const char *value) {
  return (int64_t)strcspn(value, after_word);
}

const char *hk_json_text(const char *value) {
  return hk_json_is(value, '"') ? value + 1 : NULL;
}

/* ---- arrays and objects ---- */

static const char *skip_text(const char *at) {
  at += strlen(at);
  while (*at == '\0')
    at++;
  return at;
}

const char *hk_json_end(const char *at) {
  int32_t depth = 0;
  do {
    if (*at == '"') {
      at = skip_text(at);
      continue;
    }
    depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
    at += depth > 0 || *at == '}' || *at == ']' ? 1 : hk_json_length(at);
  } while (depth > 0);
  return at;
}

/* What follows a bracket, comma or colon. */
static const char *follow(const char *mark) {
  return hk_json_skip_blanks(mark + 1);
}

const char *hk_json_first(const char *value) {
  if (!hk_json_is(value, '{') && !hk_json_is(value, '[')) return NULL;
  const char *inside = follow(value);
  return *inside == ']' || *inside == '}' ? NULL : inside;
}

const char *hk_json_next(const char *item) {
  item = hk_json_skip_blanks(hk_json_end(item));
  if (*item == ':') return hk_json_next(follow(item));
  return *item == ',' ? follow(item) : NULL;
}

int64_t hk_json_count(const char *array) {
  int64_t count = 0;
  for (const char *item = hk_json_first(array); item; item = hk_json_next(item))
    count++;
  return count;
}

const char *hk_json_member(const char *key) {
  return follow(hk_json_skip_blanks(skip_text(key)));
}

const char *hk_json_get(const char *object, const char *key) {
  for (const char *at = hk_json_is(object, '{') ? hk_json_first(object) : NULL; at; at = hk_json_next(at))
    if (strcmp(at + 1, key) == 0) return hk_json_member(at);
  return NULL;
}

/* ---- places ---- */

/* The key that matches most of `path`, which then goes on behind it; of equal ones the last, which is
 * refused. */
static const char *find_key(const char *object, const char **path) {
  const char *best = NULL;
  size_t longest = 0;
  for (const char *key = hk_json_first(object); key; key = hk_json_next(key)) {
    const size_t length = strlen(key + 1);
    if (strncmp(*path, key + 1, length) != 0 || !strchr(".[", (*path)[length]) || length < longest) continue;
    longest = length;
    best = key;
  }
  if (best) *path += longest;
  return best;
}

static const char *find_element(const char *array, const char **path) {
  char *after;
  long long index = strtoll(*path + 1, &after, 10);
  const char *element = hk_json_first(array);
  while (element && index-- > 0)
    element = hk_json_next(element);
  if (element) *path = *after == ']' ? after + 1 : after;
  return element;
}

const char *hk_json_find(const char *text, const char *path, int32_t key) {
  const char *value = hk_json_skip_blanks(text);
  while (*path) {
    const char *found = NULL;
    if (*path == '[' && *value == '[') {
      found = find_element(value, &path);
    } else if (*path != '[' && *value == '{') {
      if (*path == '.') path++;
      found = find_key(value, &path);
      if (found && *path == '\0' && key) return found;
      if (found) found = hk_json_member(found);
    }
    if (found == NULL) break;
    value = found;
  }
  return value;
}

void hk_json_line(const char *text, const char *at, int64_t *line, int64_t *column) {
  *line = 1;
  *column = 1;
  for (const char *c = text; c < at; c++) {
    if (*c == '\n') {
      (*line)++;
      *column = 1;
    } else if (((unsigned char)*c & 0xC0) != 0x80) {
      (*column)++;
    }
  }
}
