/* Converts JSON to options according to the option tables. */
#include "io/scene/scene_json.h"

#include "core/memory.h"
#include "core/status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 160, TEXT_SIZE = 512 };

/* Describes a value: a number or a word as it is written, "an array of 2". */
static void describe(const char *value, char *text) {
  char shown[HOOKE_OPTION_SHOWN];
  const char *words = hk_json_text(value), *mark = words ? "\"" : "";
  if (*value == '{') {
    snprintf(text, TEXT_SIZE, "an object");
  } else if (*value == '[') {
    snprintf(text, TEXT_SIZE, "an array of %lld", (long long)hk_json_count(value));
  } else {
    hk_option_show(words ? words : value, words ? (int64_t)strlen(words) : hk_json_length(value), shown);
    snprintf(text, TEXT_SIZE, "%s%s%s", mark, shown, mark);
  }
}

int32_t hk_scene_refuse(const char *value, const char *where, const char *allowed) {
  char given[TEXT_SIZE];
  describe(value, given);
  return hk_fail(HOOKE_BAD_VALUE, where, "%s is not allowed; allowed: %s", given, allowed);
}

int32_t hk_scene_refuse_for_row(const char *value, const char *where, const struct hk_option_row *row) {
  char allowed[HOOKE_OPTION_ALLOWED];
  return hk_scene_refuse(value, where, hk_option_allowed(row, allowed));
}

int32_t hk_scene_require(const char *value, char first, const char *where, const char *allowed) {
  return hk_json_is(value, first) ? HOOKE_OK : hk_scene_refuse(value, where, allowed);
}

/* True if a key needs no quoting in a place. */
static int is_plain(const char *key) {
  size_t length = strlen(key);
  return length > 0 && length < HOOKE_OPTION_SHOWN &&
         strspn(key, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == length;
}

/* Of a key that is unknown, or known and given again. */
static int32_t refuse_key(struct hk_scene_reader *reader, const struct hk_option_table *table,
                          const char *others, const char *key, int32_t known) {
  reader->at_key = is_plain(key);
  if (known) return hk_fail(HOOKE_BAD_VALUE, key, "is given twice; allowed: each key once");
  return hk_option_unknown(table, others, is_plain(key) ? key : NULL, "key", key);
}

/* ---- one value ---- */

int32_t hk_scene_place_number(int32_t status, const char *array, const char *name) {
  const char *where = hk_fail_where();
  size_t length = strlen(name);
  if (status != HOOKE_BAD_VALUE || !hk_json_is(array, '[') || strncmp(where, name, length) != 0)
    return status;
  if (where[length] != '[' && where[length] != '\0') return status;
  long long number = where[length] ? strtoll(where + length + 1, NULL, 10) : 0, k = 0;
  for (const char *item = hk_json_first(array); item; item = hk_json_next(item), k++) {
    if (hk_json_is(item, '"') || number-- > 0) continue;
    char found[NAME_SIZE];
    snprintf(found, sizeof found, "%s[%lld]", name, k);
    return hk_fail(status, found, "%s", hk_fail_message());
  }
  return status;
}

/* The numbers first, then the words among them one by one. */
static int32_t set_numbers(struct hk_scene_reader *reader, const char *value, const struct hk_option_row *row,
                           const char *name, hooke_options *options) {
  double *numbers = NULL;
  int64_t count = 0;
  const char *unit = NULL;
  int32_t status = hk_scene_read_numbers(reader, value, row, &numbers, &count, &unit);
  if (status) return hk_fail_within(status, "%s", name);
  status = hk_options_set_in_unit(options, name, count, numbers, unit);
  hk_free(numbers);
  /* one number in brackets is still an element */
  if (row->word_lists || (count == 1 && row->min_count <= 1)) hk_scene_place_number(status, value, name);
  const char *item = row->word_lists ? hk_json_first(value) : NULL;
  for (; item && status == HOOKE_OK; item = hk_json_next(item))
    if (hk_scene_is_word(item, row)) status = hk_options_add_word(options, name, hk_json_text(item));
  return status;
}

static int32_t read_numbers(struct hk_scene_reader *reader, const char *value,
                            const struct hk_option_row *row, const char *name, hooke_options *options) {
  if (hk_scene_is_word(value, row)) return hooke_options_set_text(options, name, hk_json_text(value));
  const int32_t single = row->type == HOOKE_OPTION_NUMBER,
                list = hk_json_is(value, '[') || hk_json_is(value, '{');
  const int32_t one =
      hk_scene_is_quantity(value, row) || (row->whole ? hk_json_is_integer(value) : hk_json_is_number(value));
  const int32_t may_be_one = single || (row->columns <= 1 && row->min_count == 1);
  if (one ? may_be_one : list && !single) return set_numbers(reader, value, row, name, options);
  return hk_scene_refuse_for_row(value, name, row);
}

static int32_t read_object(struct hk_scene_reader *reader, const char *object,
                           const struct hk_option_table *table, const char *prefix, const char *others,
                           hooke_options *options);

static int32_t read_family(struct hk_scene_reader *reader, const char *value, const struct hk_option_row *row,
                           const char *name, hooke_options *options) {
  char prefix[NAME_SIZE + 2];
  snprintf(prefix, sizeof prefix, "%s.", name);
  int32_t status = hooke_options_set_text(options, name, "");
  return status ? status : read_object(reader, value, row->family, prefix, NULL, options);
}

static int32_t read_row(struct hk_scene_reader *reader, const char *value, const struct hk_option_row *row,
                        const char *name, hooke_options *options) {
  const int32_t object = row->family && hk_json_is(value, '{');
  if (object && !(row->type == HOOKE_OPTION_NUMBERS && hk_json_get(value, "file")))
    return read_family(reader, value, row, name, options);
  switch (row->type) {
  case HOOKE_OPTION_NUMBER:
  case HOOKE_OPTION_NUMBERS:
    return read_numbers(reader, value, row, name, options);
  case HOOKE_OPTION_FLAG:
    if (*value != 't' && *value != 'f') break;
    return hooke_options_set_number(options, name, *value == 't');
  case HOOKE_OPTION_CHOICE:
  case HOOKE_OPTION_TEXT:
    if (!hk_json_is(value, '"')) break;
    return hooke_options_set_text(options, name, hk_json_text(value));
  case HOOKE_OPTION_FAMILY:
    break;
  }
  return hk_scene_refuse_for_row(value, name, row);
}

/* ---- whole objects ---- */

static int32_t read_object(struct hk_scene_reader *reader, const char *object,
                           const struct hk_option_table *table, const char *prefix, const char *others,
                           hooke_options *options) {
  for (const char *at = hk_json_first(object); at; at = hk_json_next(at)) {
    const char *key = at + 1, *value = hk_json_member(at);
    const struct hk_option_row *row = strchr(key, '.') ? NULL : hk_options_find(table, key);
    const int32_t known = row || hk_option_has_word(others, key, (int64_t)strlen(key));
    char name[NAME_SIZE];
    int32_t status = HOOKE_OK;
    if (!known || hk_json_get(object, key) != value) {
      status = refuse_key(reader, table, others, key, known);
      if (prefix[0]) hk_fail_within(status, "%.*s", (int)strlen(prefix) - 1, prefix);
    } else if (row) {
      snprintf(name, sizeof name, "%s%s", prefix, row->name);
      status = read_row(reader, value, row, name, options);
    }
    status = hk_scene_note(reader, status);
    if (status) return status;
  }
  return HOOKE_OK;
}

int32_t hk_scene_read_options(struct hk_scene_reader *reader, const char *object, const char *others,
                              hooke_options *options) {
  const int64_t before = reader->faults;
  const int32_t status = read_object(reader, object, hk_options_table(options), "", others, options);
  if (status != HOOKE_OK) return status;
  if (reader->faults == before) return hk_options_check_required(options);
  reader->noted = 1;
  return HOOKE_BAD_VALUE;
}
