/* Values set in the text of a scene before it is read: "run.step=1ms", "cloth.structural.stiffness=50". */
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "io/scene/scene_json.h"

#include <string.h>

enum { NAMES_SIZE = 4096, DEEPEST_KEY = 8 };

/* ---- the value as JSON ---- */

/* True if what stands between `before` and `after` is one value of JSON, and not several members. */
static int is_json(const char *before, const char *value, const char *after) {
  const size_t size = strlen(before) + strlen(value) + strlen(after) + 1;
  char *text = hk_new((int64_t)size, 1), *json = NULL;
  const char *at;
  if (text) hk_print(text, size, "%s%s%s", before, value, after);
  const int is = text && hk_json_open(text, (int64_t)size - 1, &json, &at) == HOOKE_OK &&
                 hk_json_count(hk_json_find(json, "", 0)) == 1;
  hk_free(json);
  hk_free(text);
  return is;
}

static void add_quoted(char *text, size_t size, const char *words) {
  hk_append(text, size, "\"");
  for (const char *c = words; *c; c++)
    hk_append(text, size, (unsigned char)*c < ' ' ? "\\u%04x" : *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
  hk_append(text, size, "\"");
}

/* Numbers between commas are an array; what is no JSON is a text: a word, or a number with a unit. */
static void add_value(char *text, size_t size, const char *value) {
  if (is_json("{\"v\":", value, "}"))
    hk_append(text, size, "%s", value);
  else if (is_json("{\"v\":[", value, "]}"))
    hk_append(text, size, "[%s]", value);
  else
    add_quoted(text, size, value);
}

/* ---- the place ---- */

/* The object called `path` up to a dot, of which `path` is then what follows; NULL: none. Lists all names. */
static const char *find_named(const char *root, const char **path, char *names, int *count) {
  const char *found = NULL;
  size_t longest = 0;
  for (const char *key = hk_json_first(root); key; key = hk_json_next(key)) {
    const char *item = hk_json_is(hk_json_member(key), '[') ? hk_json_first(hk_json_member(key)) : NULL;
    for (; item; item = hk_json_is(item, '{') ? hk_json_next(item) : NULL) {
      const char *name = hk_json_text(hk_json_get(item, "name"));
      const size_t length = name ? strlen(name) : 0;
      if (length == 0) continue;
      hk_append(names, NAMES_SIZE, " %s", name);
      if (strncmp(*path, name, length) != 0 || (*path)[length] != '.' || length < longest) continue;
      *count = length > longest ? 1 : *count + 1;
      longest = length;
      found = item;
    }
  }
  if (found) *path += longest + 1;
  return found;
}

/* The keys of a scene, in front of the names. */
static void list_keys(char *names) {
  const struct hk_option_table *top = hk_scene_table(0);
  hk_append(names, NAMES_SIZE, "run");
  for (int32_t k = 0; k < top->row_count; k++)
    hk_append(names, NAMES_SIZE, " %s", top->rows[k].name);
  hk_append(names, NAMES_SIZE, " particles");
}

static const char *find_start(const char *root, const char *whole, const char **path) {
  char names[NAMES_SIZE] = "", first[HOOKE_OPTION_SHOWN];
  int count = 0;
  list_keys(names);
  const size_t keys = strlen(names);
  const char *found = find_named(root, path, names, &count);
  if (count > 1) hk_fail(HOOKE_BAD_VALUE, whole, "%d groups have this name; allowed: a name of one", count);
  if (found) return count > 1 ? NULL : found;
  hk_print(first, sizeof first, "%.*s", (int)strcspn(whole, "."), whole);
  names[keys] = '\0'; /* a name without keys sets nothing */
  if (hk_option_has_word(names, first, (int64_t)strlen(first))) return root;
  if (keys + 1 < NAMES_SIZE && names[keys + 1]) names[keys] = ' ';
  hk_option_unknown(NULL, names, whole, "key or name", first);
  return NULL;
}

/* ---- one change ---- */

/* Writes over the value at `path`, or adds it and the objects that it needs. */
static int32_t splice(const char *text, const char *json, const char *object, const char *path,
                      const char *value, const char *whole, char *out, size_t size) {
  char key[HOOKE_OPTION_SHOWN];
  const char *found = NULL, *end;
  int depth = 0;
  for (;; path += strlen(key) + 1) {
    hk_print(key, sizeof key, "%.*s", (int)strcspn(path, "."), path);
    if (!hk_json_is(object, '{'))
      return hk_fail(HOOKE_BAD_VALUE, whole,
                     "\"%s\" is no key of an object; allowed: a key of a named part, group, "
                     "anchor or body, or of the scene",
                     key);
    found = hk_json_get(object, key);
    if (found == NULL || path[strlen(key)] == '\0') break;
    object = found;
  }
  const char *from = found ? found : object + 1;
  end = found ? hk_json_end(found) : from;
  memcpy(out, text, (size_t)(from - json));
  out += from - json;
  size -= (size_t)(from - json);
  *out = '\0';
  while (found == NULL) {
    add_quoted(out, size, key);
    path += strlen(key);
    hk_append(out, size, *path ? ": {" : ": ");
    if (*path == '\0') break;
    if (++depth > DEEPEST_KEY) return hk_fail(HOOKE_BAD_VALUE, whole, "has too many keys");
    path++;
    hk_print(key, sizeof key, "%.*s", (int)strcspn(path, "."), path);
  }
  add_value(out, size, value);
  while (depth-- > 0)
    hk_append(out, size, "}");
  if (found == NULL && hk_json_first(object)) hk_append(out, size, ", ");
  strcpy(out + strlen(out), text + (end - json));
  return HOOKE_OK;
}

static int32_t set_one(hooke_scene *scene, char *change) {
  char *value = strchr(change, '='), *json = NULL, *out;
  const char *path = change, *at;
  if (value == NULL || value == change)
    return hk_fail(HOOKE_BAD_VALUE, "set", "\"%s\" is not allowed; allowed: PATH=VALUE, such as run.step=1ms",
                   change);
  *value++ = '\0';
  int32_t status = hk_json_open(scene->text, scene->length, &json, &at);
  if (status != HOOKE_OK) return HOOKE_OK; /* reading the text tells it with its place */
  const size_t size = (size_t)scene->length + 6 * strlen(value) + 6 * strlen(change) + 64;
  out = hk_new((int64_t)size, 1);
  const char *object = out ? find_start(hk_json_find(json, "", 0), change, &path) : NULL;
  status = !out ? HOOKE_NO_MEMORY : !object ? HOOKE_BAD_VALUE : HOOKE_OK;
  if (status == HOOKE_OK) status = splice(scene->text, json, object, path, value, change, out, size);
  hk_free(json);
  if (status != HOOKE_OK) {
    hk_free(out);
    return status;
  }
  hk_free(scene->text);
  scene->text = out;
  scene->length = (int64_t)strlen(out);
  return HOOKE_OK;
}

int32_t hk_scene_set(hooke_scene *scene) {
  int32_t status = HOOKE_OK;
  for (char *line = scene->set, *next; line && *line && status == HOOKE_OK; line = next) {
    next = line + strcspn(line, "\n");
    if (*next) *next++ = '\0';
    status = set_one(scene, line);
  }
  return status;
}
