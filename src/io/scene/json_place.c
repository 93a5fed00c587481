#include "io/scene/json_place.h"

#include <stdlib.h>
#include <string.h>

/* All functions take a position in the text and return a later one, never past `end`. */

static const char *skip_space(const char *at, const char *end) {
  while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r'))
    at++;
  return at;
}

static const char *skip_string(const char *at, const char *end) {
  for (at++; at < end && *at != '"'; at++)
    if (*at == '\\') at++;
  return at < end ? at + 1 : end;
}

static const char *skip_value(const char *at, const char *end) {
  int64_t depth = 0;
  while (at < end) {
    if (*at == '"') {
      at = skip_string(at, end);
    } else if (*at == '{' || *at == '[') {
      depth++;
      at++;
    } else if (*at == '}' || *at == ']') {
      if (depth == 0) return at;
      depth--;
      at++;
    } else if (depth == 0 && *at == ',') {
      return at;
    } else {
      at++;
    }
    if (depth == 0 && at < end && (at[-1] == '"' || at[-1] == '}' || at[-1] == ']')) return at;
  }
  return end;
}

/* The next member or element after a value; NULL at the end of the object or array. */
static const char *next_item(const char *at, const char *end) {
  at = skip_space(at, end);
  return at < end && *at == ',' ? skip_space(at + 1, end) : NULL;
}

static const char *first_item(const char *at, const char *end) {
  at = skip_space(at + 1, end);
  return at < end && *at != '}' && *at != ']' ? at : NULL;
}

static const char *value_of_member(const char *key, const char *end) {
  const char *at = skip_space(skip_string(key, end), end);
  return at < end && *at == ':' ? skip_space(at + 1, end) : at;
}

/* Length of the key in the text if `path` begins with it, -1 if not. */
static int64_t match_key(const char *key, const char *end, const char *path) {
  int64_t length = skip_string(key, end) - key - 2;
  if (length < 0 || strlen(path) < (size_t)length || memcmp(key + 1, path, (size_t)length) != 0) return -1;
  char after = path[length];
  return after == '\0' || after == '.' || after == '[' ? length : -1;
}

/* The key of an object that matches most of `path`; NULL if none does. */
static const char *find_key(const char *object, const char *end, const char **path) {
  const char *best = NULL;
  int64_t longest = -1;
  for (const char *key = first_item(object, end); key && *key == '"';) {
    int64_t length = match_key(key, end, *path);
    if (length > longest) {
      longest = length;
      best = key;
    }
    key = next_item(skip_value(value_of_member(key, end), end), end);
  }
  if (best) *path += longest;
  return best;
}

static const char *find_element(const char *array, const char *end, const char **path) {
  char *after;
  long long index = strtoll(*path + 1, &after, 10);
  const char *element = first_item(array, end);
  while (element && index-- > 0)
    element = next_item(skip_value(element, end), end);
  if (element) *path = *after == ']' ? after + 1 : after;
  return element;
}

const char *hk_json_find(const char *text, int64_t length, const char *path, int32_t key) {
  const char *end = text + length;
  const char *value = skip_space(text, end);
  while (*path && value < end) {
    const char *found = NULL;
    if (*path == '[' && *value == '[') {
      found = find_element(value, end, &path);
    } else if (*path != '[' && *value == '{') {
      if (*path == '.') path++;
      found = find_key(value, end, &path);
      if (found && *path == '\0' && key) return found;
      if (found) found = value_of_member(found, end);
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
