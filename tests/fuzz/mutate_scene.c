/* Mutates scenes: parses them, changes a few values, keys or elements, and prints them again. Allowed keys
 * and values come from the library's option tables, so that new options are covered automatically. */
#include "fuzz.h"

#include "hooke/parts.h"
#include "hooke/trajectory.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t out_size, unsigned int seed);

enum { KINDS = 5, NAME_SIZE = 96, MOST_ELEMENTS = 6 };

/* ---- chance ---- */

static uint64_t chance;

static uint64_t draw(uint64_t below) {
  chance ^= chance << 13;
  chance ^= chance >> 7;
  chance ^= chance << 17;
  return (chance >> 16) % below;
}

static double any_number(void) {
  static const double special[] = {0.0,   -0.0,   1.0,    -1.0,  0.5,     2.0,   1e-3, 1e3,    1e300, -1e300,
                                   1e308, 1e-308, 5e-324, 1e-12, 1.0 / 3, 1e100, 9.81, 1e-160, 1e160, 0.1};
  switch (draw(4)) {
  case 0:
    return special[draw(sizeof special / sizeof special[0])];
  case 1:
    return (double)draw(7) - 2.0;
  case 2:
    return ((double)draw(2000001) - 1e6) / 1e6;
  default:
    return ((double)draw(1 << 20) + 1.0) / (double)(1 + draw(1 << 10));
  }
}

static json_int_t any_whole(void) {
  static const json_int_t special[] = {0,          1,          2,          -1,           3,
                                       INT32_MAX,  INT32_MIN,  2147483648, 1073741824,   46341,
                                       65536,      100000,     INT64_MAX,  INT64_MIN,    4294967296,
                                       1000000000, 4611686018, 1 << 20,    INT32_MAX - 1};
  return draw(4) ? (json_int_t)draw(6) : special[draw(sizeof special / sizeof special[0])];
}

/* ---- values that suit a row of a table ---- */

static json_t *number_of(const hooke_options *table, int64_t row) {
  const double low = hooke_options_row_number(table, row, "low");
  const int whole = hooke_options_row_number(table, row, "whole") == 1.0;
  if (whole && draw(16) == 0) return json_integer(any_whole());
  if (whole) return json_integer((json_int_t)draw(5) + (low >= 2.0 ? (json_int_t)low : low >= 1.0));
  double number = any_number();
  if (low >= 0.0 && number < 0.0 && draw(8)) number = -number;
  if (draw(3) == 0) return json_integer((json_int_t)draw(9) + 1);
  return json_real(number);
}

static json_t *one_word(const char *words) {
  size_t count = 0, length;
  for (const char *at = words; *(at += strspn(at, " ")); at += strcspn(at, " "))
    count++;
  if (count == 0) return json_string("");
  for (size_t k = draw(count) + 1; k > 1; k--) {
    words += strspn(words, " ");
    words += strcspn(words, " ");
  }
  words += strspn(words, " ");
  length = strcspn(words, " ");
  return json_stringn(words, length);
}

static json_t *numbers_of(const hooke_options *table, int64_t row) {
  const double least = hooke_options_row_number(table, row, "min_count");
  const double most = hooke_options_row_number(table, row, "max_count");
  const double wide = hooke_options_row_number(table, row, "columns");
  const char *words = hooke_options_row(table, row, "words");
  const int64_t columns = wide > 1.0 ? (int64_t)wide : 1;
  if (words[0] && draw(2)) return one_word(words);
  if (columns == 1 && least == 1.0 && draw(3)) return number_of(table, row);
  int64_t count = (least > 0.0 ? (int64_t)least : 0) / columns;
  if (!(most >= least) || most > least) count += (int64_t)draw(4);
  if (draw(32) == 0) count += 1;
  json_t *array = json_array();
  for (int64_t k = 0; k < count; k++) {
    json_t *line = columns > 1 ? json_array() : NULL;
    for (int64_t c = 0; line && c < columns; c++)
      json_array_append_new(line, number_of(table, row));
    json_array_append_new(array, line ? line : number_of(table, row));
  }
  if (words[0] && hooke_options_row_number(table, row, "word_lists") == 1.0 && draw(3) == 0)
    json_array_insert_new(array, draw(json_array_size(array) + 1), one_word(words));
  return array;
}

static json_t *any_text(const char *name) {
  static const char *const texts[] = {"",         "a",       "rope0",   "cloth0", "tetrahedron.obj",
                                      "bad.obj",  "rows.h5", "/frames", "/mass",  "..",
                                      "\xc3\xa9", "\x1b[2J", "\"\\\n",  "a.b[0]"};
  if (strcmp(name, "method") == 0 && draw(8))
    return json_string(hooke_method_name((int64_t)draw((uint64_t)hooke_method_count())));
  return json_string(texts[draw(sizeof texts / sizeof texts[0])]);
}

static json_t *value_of(const hooke_options *table, int64_t row) {
  const char *type = hooke_options_row(table, row, "type");
  if (strcmp(type, "number") == 0) return number_of(table, row);
  if (strcmp(type, "numbers") == 0) return numbers_of(table, row);
  if (strcmp(type, "flag") == 0) return json_boolean(draw(2));
  if (strcmp(type, "choice") == 0) return one_word(hooke_options_row(table, row, "words"));
  if (strcmp(type, "family") == 0) return json_object();
  return any_text(hooke_options_row(table, row, "name"));
}

/* Sets the key of a row; a member "structural.stiffness" is set inside an object of its family, which is
 * created. */
static void set_row(json_t *object, const hooke_options *table, int64_t row) {
  const char *name = hooke_options_row(table, row, "name"), *dot;
  char family[NAME_SIZE];
  while ((dot = strchr(name, '.')) != NULL) {
    snprintf(family, sizeof family, "%.*s", (int)(dot - name), name);
    json_t *inner = json_object_get(object, family);
    if (!json_is_object(inner)) json_object_set_new(object, family, inner = json_object());
    object = inner;
    name = dot + 1;
  }
  json_object_set_new(object, name, value_of(table, row));
}

/* Sets required options, in present families only, and now and then an optional one. */
static void fill(json_t *object, const hooke_options *table, uint64_t more) {
  const int64_t rows = hooke_options_row_count(table);
  for (int64_t row = 0; row < rows; row++) {
    const int required = hooke_options_row_number(table, row, "required") == 1.0 &&
                         (hooke_options_row(table, row, "family")[0] == '\0' || draw(2));
    if (required && json_object_get(object, hooke_options_row(table, row, "name")) == NULL)
      set_row(object, table, row);
  }
  for (; more > 0; more--)
    set_row(object, table, (int64_t)draw((uint64_t)rows));
}

/* ---- the pieces of a scene ---- */

static hooke_options *table[KINDS + 5];
enum { SCENE = KINDS, PARTICLES, DRIVEN, SPRINGS, RUN };

static void create_tables(void) {
  for (int64_t k = 0; k < KINDS; k++)
    hooke_options_create(hooke_part_kind(k, "name"), &table[k]);
  hooke_options_create("scene", &table[SCENE]);
  hooke_options_create("particles", &table[PARTICLES]);
  hooke_options_create("driven", &table[DRIVEN]);
  hooke_options_create("springs", &table[SPRINGS]);
  hooke_options_create("run", &table[RUN]);
}

static json_t *any_particle(void) {
  if (draw(6)) return json_integer((json_int_t)draw(4));
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s%d", hooke_part_kind((int64_t)draw(KINDS), "name"), (int)draw(2));
  return json_pack("[s, I]", draw(4) ? name : "p", (json_int_t)draw(5));
}

static json_t *any_dataset(void) {
  static const char *const names[] = {"/position", "/mass", "/pairs", "/list", "/odd", "/frames", "/none"};
  return json_pack("{s: s, s: s}", "file", draw(8) ? "rows.h5" : "bad.obj", "dataset",
                   names[draw(sizeof names / sizeof names[0])]);
}

static json_t *any_list(uint64_t count, int pairs) {
  json_t *array = json_array();
  for (uint64_t k = 0; k < count; k++)
    json_array_append_new(array,
                          pairs ? json_pack("[o, o]", any_particle(), any_particle()) : any_particle());
  return array;
}

static void fill_particles(json_t *object) {
  fill(object, table[PARTICLES], draw(2));
  json_t *rows = json_array();
  for (uint64_t k = draw(4) + 1; k > 0; k--)
    json_array_append_new(rows, json_pack("[f, f, f]", any_number(), any_number(), (double)k));
  json_object_set_new(object, "position", rows);
  if (draw(3)) json_object_set_new(object, "mass", json_real((double)draw(8) + 0.5));
}

static void fill_part(json_t *object) {
  const char *kind = json_string_value(json_object_get(object, "kind"));
  int64_t k = 0;
  while (kind && k < KINDS && strcmp(hooke_part_kind(k, "name"), kind) != 0)
    k++;
  if (kind == NULL || k == KINDS) {
    k = (int64_t)draw(KINDS);
    json_object_set_new(object, "kind", json_string(hooke_part_kind(k, "name")));
  }
  fill(object, table[k], draw(3));
  if (draw(2) && !json_object_get(object, "density")) json_object_set_new(object, "mass", json_integer(1));
  if (strcmp(hooke_part_kind(k, "name"), "mesh") == 0 && draw(2)) {
    json_object_del(object, "vertices");
    json_object_del(object, "triangles");
    json_object_set_new(object, "file", json_string("tetrahedron.obj"));
  }
  if (draw(16) == 0) json_object_set_new(object, "name", any_text("name"));
}

static void fill_springs(json_t *object) {
  fill(object, table[SPRINGS], draw(3));
  if (!json_object_get(object, "between") || draw(3) == 0)
    json_object_set_new(object, "between", any_list(draw(4), 1));
  if (draw(16) == 0) json_object_set_new(object, "name", any_text("name"));
}

static void fill_driven(json_t *object) {
  static const char *const keys[2][3] = {{"amplitude", "frequency", "phase"}, {"time", "position", "time"}};
  const uint64_t motion = draw(2);
  fill(object, table[DRIVEN], 0);
  json_object_set_new(object, "motion", json_string(motion ? "table" : "harmonic"));
  for (int k = 0; k < 3; k++) {
    if (draw(12)) json_object_del(object, keys[1 - motion][k]);
    for (int64_t row = 0; draw(12) && row < hooke_options_row_count(table[DRIVEN]); row++)
      if (strcmp(hooke_options_row(table[DRIVEN], row, "name"), keys[motion][k]) == 0)
        set_row(object, table[DRIVEN], row);
  }
  if (motion && draw(4)) {
    json_object_set_new(object, "time", json_pack("[i, f, i]", 0, 0.5, 1));
    json_object_set_new(
        object, "position",
        json_pack("[[i,i,i],[i,f,i],[i,i,f]]", 0, 0, 0, 0, any_number(), 0, 1, 0, any_number()));
  }
  if (!json_object_get(object, "particles") || draw(3) == 0)
    json_object_set_new(object, "particles", any_list(draw(3) + 1, 0));
}

/* An element of the list under a key, sometimes a new one. */
static json_t *element(json_t *root, const char *key) {
  json_t *array = json_object_get(root, key);
  if (!json_is_array(array)) json_object_set_new(root, key, array = json_array());
  const size_t count = json_array_size(array);
  json_t *found =
      count > 0 && (count >= MOST_ELEMENTS || draw(3)) ? json_array_get(array, draw(count)) : NULL;
  if (json_is_object(found)) return found;
  if (count < MOST_ELEMENTS) json_array_append_new(array, json_object());
  found = json_array_get(array, json_array_size(array) - 1);
  return json_is_object(found) ? found : NULL;
}

static json_t *member(json_t *root, const char *key) {
  json_t *object = json_object_get(root, key);
  if (!json_is_object(object)) json_object_set_new(root, key, object = json_object());
  return object;
}

static void grow(json_t *root) {
  json_t *object;
  json_object_set_new(root, "hooke", json_integer(1));
  switch (draw(8)) {
  case 0:
    set_row(root, table[SCENE], (int64_t)draw((uint64_t)hooke_options_row_count(table[SCENE])));
    break;
  case 1:
    fill_particles(member(root, "particles"));
    break;
  case 2:
    object = element(root, "springs");
    if (object) fill_springs(object);
    break;
  case 3:
    object = element(root, "driven");
    if (object) fill_driven(object);
    break;
  case 4:
    set_row(member(root, "run"), table[RUN], (int64_t)draw((uint64_t)hooke_options_row_count(table[RUN])));
    break;
  default:
    object = element(root, "parts");
    if (object) fill_part(object);
  }
}

/* ---- any JSON ---- */

static json_t *any_json(int depth) {
  json_t *value;
  switch (draw(depth > 2 ? 6 : 8)) {
  case 0:
    return json_integer(any_whole());
  case 1:
    return json_real(any_number());
  case 2:
    return any_text("");
  case 3:
    return json_boolean(draw(2));
  case 4:
    return draw(4) ? json_integer(1) : json_null();
  case 5:
    return any_dataset();
  case 6:
    value = json_array();
    for (uint64_t k = draw(4) + 1; k > 0; k--)
      json_array_append_new(value, any_json(depth + 1));
    return value;
  default:
    value = json_object();
    json_object_set_new(value, "stiffness", any_json(depth + 1));
    return value;
  }
}

static json_t *tweak(const json_t *value) {
  switch (json_typeof(value)) {
  case JSON_INTEGER:
    return draw(4) ? json_integer((json_int_t)((uint64_t)json_integer_value(value) + draw(5) - 2))
                   : json_real(any_number());
  case JSON_REAL:
    return draw(3) ? json_real(any_number()) : json_integer((json_int_t)draw(4));
  case JSON_TRUE:
    return json_false();
  case JSON_FALSE:
    return json_true();
  default:
    return any_json(0);
  }
}

/* A random walk down; the value at its end is changed, removed or doubled. */
static void change(json_t *node) {
  for (;;) {
    const size_t count = json_is_object(node) ? json_object_size(node) : json_array_size(node);
    if (count == 0) return;
    size_t k = draw(count);
    const char *key = NULL;
    json_t *child;
    if (json_is_object(node)) {
      void *member = json_object_iter(node);
      while (k-- > 0)
        member = json_object_iter_next(node, member);
      key = json_object_iter_key(member);
      child = json_object_iter_value(member);
    } else {
      child = json_array_get(node, k);
    }
    const int inner = (json_is_object(child) && json_object_size(child)) || json_array_size(child);
    if (inner && draw(6)) {
      node = child;
      continue;
    }
    const uint64_t what = draw(8);
    if (key) {
      char name[NAME_SIZE];
      snprintf(name, sizeof name, "%s%s", key, what == 1 ? "_" : "");
      if (what <= 1) json_object_del(node, name);
      if (what == 1) json_object_set_new(node, name, any_json(0));
      if (what > 1) json_object_set_new(node, name, tweak(child));
    } else if (what == 0) {
      json_array_remove(node, k);
    } else if (what <= 2) {
      json_array_insert_new(node, draw(count + 1), json_deep_copy(child));
    } else {
      json_array_set_new(node, k, tweak(child));
    }
    return;
  }
}

/* ---- what libFuzzer calls ---- */

static void start(unsigned int seed) {
  if (table[0] == NULL) create_tables();
  chance = (uint64_t)seed * UINT64_C(0x9e3779b97f4a7c15) + 1;
  draw(2);
}

/* 0 if the result is too long. */
static size_t print(json_t *root, uint8_t *data, size_t max_size) {
  const size_t indent = draw(16) == 0 ? JSON_INDENT(1) : JSON_COMPACT;
  const size_t length = json_dumpb(root, (char *)data, max_size, indent);
  return length <= max_size ? length : 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed) {
  start(seed);
  if (draw(12) == 0) return LLVMFuzzerMutate(data, size, max_size);
  json_t *root = json_loadb((const char *)data, size, 0, NULL);
  if (root == NULL && draw(3)) return LLVMFuzzerMutate(data, size, max_size);
  if (!json_is_object(root) || draw(200) == 0) {
    json_decref(root);
    root = json_object();
    for (uint64_t k = draw(5) + 1; k > 0; k--)
      grow(root);
  }
  for (uint64_t k = draw(3) + 1; k > 0; k--) {
    if (draw(2))
      grow(root);
    else
      change(root);
  }
  uint8_t *text = malloc(max_size);
  const size_t length = text ? print(root, text, max_size) : 0;
  if (length > 0) memcpy(data, text, length);
  free(text);
  json_decref(root);
  return length > 0 ? length : LLVMFuzzerMutate(data, size, max_size);
}

static size_t mutate_copy(const uint8_t *a, size_t size, uint8_t *out, size_t out_size, unsigned int seed) {
  if (size > out_size) size = out_size;
  memcpy(out, a, size);
  return LLVMFuzzerCustomMutator(out, size, out_size, seed);
}

/* A key of the second scene replaces that of the first; libFuzzer calls this as often as the mutation of one
 * scene. */
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t out_size, unsigned int seed) {
  start(seed);
  if (draw(6)) return mutate_copy(a, a_size, out, out_size, seed + 1);
  json_t *to = json_loadb((const char *)a, a_size, 0, NULL),
         *from = json_loadb((const char *)b, b_size, 0, NULL);
  size_t length = 0;
  if (json_is_object(to) && json_is_object(from) && json_object_size(from) > 0) {
    void *member = json_object_iter(from);
    for (size_t k = draw(json_object_size(from)); k > 0; k--)
      member = json_object_iter_next(from, member);
    const char *key = json_object_iter_key(member);
    json_t *value = json_object_iter_value(member), *there = json_object_get(to, key);
    if (json_is_array(value) && json_is_array(there) && draw(2))
      json_array_append_new(there, json_deep_copy(json_array_get(value, 0)));
    else
      json_object_set_new(to, key, json_deep_copy(value));
    length = print(to, out, out_size);
  }
  json_decref(to);
  json_decref(from);
  if (length > 0) return length;
  length = a_size < out_size ? a_size : out_size;
  memcpy(out, a, length);
  return length;
}
