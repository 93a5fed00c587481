/* Converts JSON to options according to the option tables. */
#include "io/scene/scene_json.h"

#if HOOKE_HAVE_JANSSON

#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 160, TEXT_SIZE = 512 };

/* Describes a value: "the number 3", "an array of 2". */
static void describe(const json_t *value, char *text) {
  char shown[(int)HOOKE_OPTION_SHOWN + HOOKE_NUMBER_SIZE];
  text[0] = '\0';
  switch (json_typeof(value)) {
  case JSON_OBJECT:
    snprintf(text, TEXT_SIZE, "an object");
    break;
  case JSON_ARRAY:
    snprintf(text, TEXT_SIZE, "an array of %zu", json_array_size(value));
    break;
  case JSON_STRING:
    hk_option_show(json_string_value(value), (int64_t)json_string_length(value), shown);
    snprintf(text, TEXT_SIZE, "\"%s\"", shown);
    break;
  case JSON_INTEGER:
    snprintf(text, TEXT_SIZE, "%lld", (long long)json_integer_value(value));
    break;
  case JSON_REAL:
    hk_number_print(json_real_value(value), shown);
    /* 3.0 is not accepted as the integer 3 */
    snprintf(text, TEXT_SIZE, "%s%s", shown, strpbrk(shown, ".e") ? "" : ".0");
    break;
  case JSON_TRUE:
    snprintf(text, TEXT_SIZE, "true");
    break;
  case JSON_FALSE:
    snprintf(text, TEXT_SIZE, "false");
    break;
  case JSON_NULL:
    snprintf(text, TEXT_SIZE, "null");
    break;
  }
}

int32_t hk_scene_refuse(const json_t *value, const char *place, const char *allowed) {
  char given[TEXT_SIZE];
  describe(value, given);
  return hk_fail(HOOKE_BAD_VALUE, place, "%s is not allowed; allowed: %s", given, allowed);
}

static int32_t refuse_for_row(const json_t *value, const char *place, const struct hk_option_row *row) {
  char allowed[TEXT_SIZE], with_unit[TEXT_SIZE + NAME_SIZE];
  hk_option_describe(row, allowed, sizeof allowed);
  const char *unit = row->unit ? row->unit : "";
  snprintf(with_unit, sizeof with_unit, "%s%s%s%s", allowed, unit[0] ? " [" : "", unit, unit[0] ? "]" : "");
  return hk_scene_refuse(value, place, with_unit);
}

int32_t hk_scene_require_object(const json_t *value, const char *place) {
  return json_is_object(value) ? HOOKE_OK : hk_scene_refuse(value, place, "an object { ... }");
}

int32_t hk_scene_require_array(const json_t *value, const char *place, const char *allowed) {
  return json_is_array(value) ? HOOKE_OK : hk_scene_refuse(value, place, allowed);
}

int32_t hk_scene_require_text(const json_t *value, const char *place) {
  return json_is_string(value) ? HOOKE_OK : hk_scene_refuse(value, place, "a text");
}

/* True if a key needs no quoting in a place. */
static int is_plain(const char *key) {
  size_t length = strlen(key);
  return length > 0 && length < HOOKE_OPTION_SHOWN &&
         strspn(key, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == length;
}

static int32_t unknown_key(struct hk_scene_reader *reader, const struct hk_option_table *table,
                           const char *others, const char *key) {
  reader->at_key = is_plain(key);
  return hk_option_unknown(table, others, is_plain(key) ? key : NULL, "key", key);
}

/* ---- one value ---- */

static int is_word_of(const json_t *value, const struct hk_option_row *row) {
  return json_is_string(value) &&
         hk_option_has_word(row->words, json_string_value(value), (int64_t)json_string_length(value));
}

int32_t hk_scene_place_number(int32_t status, const json_t *array, const char *name) {
  const char *place = hk_fail_place();
  size_t length = strlen(name);
  if (status != HOOKE_BAD_VALUE || !json_is_array(array) || strncmp(place, name, length) != 0) return status;
  if (place[length] != '[' && place[length] != '\0') return status;
  long long number = place[length] ? strtoll(place + length + 1, NULL, 10) : 0;
  for (size_t k = 0; k < json_array_size(array); k++) {
    if (json_is_string(json_array_get(array, k)) || number-- > 0) continue;
    char found[NAME_SIZE];
    snprintf(found, sizeof found, "%s[%zu]", name, k);
    return hk_fail(status, found, "%s", hk_fail_message());
  }
  return status;
}

static int32_t set_numbers(struct hk_scene_reader *reader, const json_t *value,
                           const struct hk_option_row *row, const char *name, hooke_options *options) {
  double *numbers = NULL;
  int64_t count = 0;
  const char *unit = NULL;
  int32_t status = hk_scene_read_numbers(reader, value, row, &numbers, &count, &unit);
  if (status) return hk_fail_within(status, "%s", name);
  status = hk_options_set_in_unit(options, name, count, numbers, unit);
  hk_free(numbers);
  if (status == HOOKE_OK) hk_scene_forget_values(value);
  /* one number in brackets is still an element */
  int element = json_is_array(value) && count == 1 && row->min_count <= 1;
  return element ? hk_scene_place_number(status, value, name) : status;
}

/* Mixed words and numbers: the numbers first, then the words one by one. */
static int32_t set_mixed(struct hk_scene_reader *reader, const json_t *value, const struct hk_option_row *row,
                         const char *name, hooke_options *options) {
  json_t *only_numbers = json_array();
  if (only_numbers == NULL) return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %s", name);
  int32_t status = HOOKE_OK;
  for (size_t k = 0; status == HOOKE_OK && k < json_array_size(value); k++) {
    json_t *item = json_array_get(value, k);
    if (is_word_of(item, row)) continue;
    if (!json_is_integer(item)) {
      refuse_for_row(item, NULL, row);
      status = hk_fail_within(HOOKE_BAD_VALUE, "%s[%zu]", name, k);
    } else if (json_array_append(only_numbers, item)) {
      status = hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %s", name);
    }
  }
  if (status == HOOKE_OK) {
    status = set_numbers(reader, only_numbers, row, name, options);
    if (status) hk_scene_place_number(status, value, name);
  }
  json_decref(only_numbers);
  for (size_t k = 0; status == HOOKE_OK && k < json_array_size(value); k++)
    if (is_word_of(json_array_get(value, k), row))
      status = hk_options_add_word(options, name, json_string_value(json_array_get(value, k)));
  return status;
}

static int32_t read_numbers_row(struct hk_scene_reader *reader, const json_t *value,
                                const struct hk_option_row *row, const char *name, hooke_options *options) {
  if (is_word_of(value, row)) return hooke_options_set_text(options, name, json_string_value(value));
  if (row->word_lists && json_is_array(value)) return set_mixed(reader, value, row, name, options);
  int is_one = json_is_number(value) || hk_scene_is_quantity(value, row);
  int may_be_one = is_one && row->columns <= 1 && row->min_count == 1;
  if (json_is_array(value) || json_is_object(value) || may_be_one)
    return set_numbers(reader, value, row, name, options);
  return refuse_for_row(value, name, row);
}

static int32_t read_object(struct hk_scene_reader *reader, const json_t *object,
                           const struct hk_option_table *table, const char *prefix, const char *others,
                           hooke_options *options);

static int32_t read_family(struct hk_scene_reader *reader, const json_t *value,
                           const struct hk_option_row *row, const char *name, hooke_options *options) {
  if (!json_is_object(value)) return refuse_for_row(value, name, row);
  char prefix[NAME_SIZE + 2];
  snprintf(prefix, sizeof prefix, "%s.", name);
  int32_t status = hooke_options_set_text(options, name, "");
  return status ? status : read_object(reader, value, row->family, prefix, NULL, options);
}

static int32_t read_row(struct hk_scene_reader *reader, const json_t *value, const struct hk_option_row *row,
                        const char *name, hooke_options *options) {
  switch (row->type) {
  case HOOKE_OPTION_NUMBER:
    if (hk_scene_is_quantity(value, row))
      return hooke_options_set_text(options, name, json_string_value(value));
    if (row->whole ? !json_is_integer(value) : !json_is_number(value)) break;
    return hooke_options_set_number(options, name, json_number_value(value));
  case HOOKE_OPTION_NUMBERS:
    return read_numbers_row(reader, value, row, name, options);
  case HOOKE_OPTION_FLAG:
    if (!json_is_boolean(value)) break;
    return hooke_options_set_number(options, name, json_is_true(value));
  case HOOKE_OPTION_CHOICE:
  case HOOKE_OPTION_TEXT:
    if (!json_is_string(value)) break;
    return hooke_options_set_text(options, name, json_string_value(value));
  case HOOKE_OPTION_FAMILY:
    return read_family(reader, value, row, name, options);
  }
  return refuse_for_row(value, name, row);
}

/* ---- whole objects ---- */

static int32_t read_object(struct hk_scene_reader *reader, const json_t *object,
                           const struct hk_option_table *table, const char *prefix, const char *others,
                           hooke_options *options) {
  const char *key;
  json_t *value;
  json_object_foreach((json_t *)object, key, value) {
    if (hk_option_has_word(others, key, (int64_t)strlen(key))) continue;
    const struct hk_option_row *row = strchr(key, '.') ? NULL : hk_options_find(table, key);
    char name[NAME_SIZE];
    int32_t status;
    if (row) {
      snprintf(name, sizeof name, "%s%s", prefix, row->name);
      status = read_row(reader, value, row, name, options);
    } else {
      status = unknown_key(reader, table, others, key);
      if (prefix[0]) hk_fail_within(status, "%.*s", (int)strlen(prefix) - 1, prefix);
    }
    status = hk_scene_note(reader, status);
    if (status) return status;
  }
  return HOOKE_OK;
}

int32_t hk_scene_read_some_options(struct hk_scene_reader *reader, const json_t *object, const char *others,
                                   hooke_options *options) {
  const int64_t before = reader->faults;
  const int32_t status = read_object(reader, object, hk_options_table(options), "", others, options);
  if (status != HOOKE_OK || reader->faults == before) return status;
  reader->noted = 1;
  return HOOKE_BAD_VALUE;
}

int32_t hk_scene_read_options(struct hk_scene_reader *reader, const json_t *object, const char *others,
                              hooke_options *options) {
  int32_t status = hk_scene_read_some_options(reader, object, others, options);
  return status ? status : hk_options_check_required(options);
}

#else
typedef int hk_scene_json_values_without_jansson;
#endif
