#include "core/table/option_value.h"

#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "core/table/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ALLOWED_SIZE = 512 };

static const double largest_whole = 9007199254740992.0; /* 2^53: every smaller whole number is exact */

void hk_option_value_clear(struct hk_option_value *value) {
  hk_free(value->many);
  hk_free(value->words);
  memset(value, 0, sizeof *value);
}

int32_t hk_option_value_copy(const struct hk_option_value *from, struct hk_option_value *to) {
  struct hk_option_value copy = {.count = from->count, .one = from->one, .unit = from->unit};
  if (from->words && (copy.words = hk_copy_text(from->words)) == NULL) return HOOKE_NO_MEMORY;
  if (from->many) {
    copy.many = hk_new(from->count, sizeof(double));
    if (copy.many == NULL) {
      hk_option_value_clear(&copy);
      return HOOKE_NO_MEMORY;
    }
    memcpy(copy.many, from->many, (size_t)from->count * sizeof(double));
  }
  *to = copy;
  return HOOKE_OK;
}

const double *hk_option_value_numbers(const struct hk_option_value *value) {
  if (value->count == 0) return NULL;
  return value->many ? value->many : &value->one;
}

static int32_t refuse_text(const struct hk_option_row *row, const char *where, const char *text) {
  char may[HOOKE_OPTION_ALLOWED], shown[HOOKE_OPTION_SHOWN];
  hk_option_show(text, (int64_t)strlen(text), shown);
  return hk_fail(HOOKE_BAD_VALUE, where, "\"%s\" is not allowed; allowed: %s", shown,
                 hk_option_allowed(row, may));
}

/* The place of number `index` of `count`: "position[3][0]", "mass[3]", or that of the option. */
static void print_where(const struct hk_option_row *row, const char *where, int64_t count, int64_t index,
                        char *item) {
  long long at = (long long)index, columns = row->columns;
  if (columns > 1)
    snprintf(item, ALLOWED_SIZE, "%s[%lld][%lld]", where, at / columns, at % columns);
  else if (count > 1)
    snprintf(item, ALLOWED_SIZE, "%s[%lld]", where, at);
  else
    snprintf(item, ALLOWED_SIZE, "%s", where);
}

static int32_t check_number(const struct hk_option_row *row, const char *where, int64_t count, int64_t index,
                            double number) {
  int bounded = row->low < row->high;
  int fits = isfinite(number);
  if (bounded && (number < row->low || number > row->high)) fits = 0;
  if (bounded && row->above_low && number == row->low) fits = 0;
  if (row->whole && (number != rint(number) || fabs(number) > largest_whole)) fits = 0;
  if (row->type == HOOKE_OPTION_FLAG && number != 0 && number != 1) fits = 0;
  if (fits) return HOOKE_OK;
  char may[HOOKE_OPTION_ALLOWED], shown[HOOKE_NUMBER_SIZE], item[ALLOWED_SIZE];
  hk_number_print(number, shown);
  print_where(row, where, count, index, item);
  const int hidden = bounded && number > row->high && row->high >= 1e300; /* a bound that is not listed */
  return hk_fail(HOOKE_BAD_VALUE, item, "%s is not allowed; allowed: %s%s", shown,
                 hk_option_allowed(row, may), hidden ? ", up to 1e300" : "");
}

static int32_t check_count(const struct hk_option_row *row, const char *where, int64_t count) {
  int64_t least = row->type == HOOKE_OPTION_NUMBERS ? row->min_count : 1;
  int64_t most = row->type == HOOKE_OPTION_NUMBERS ? row->max_count : 1;
  int fits = count >= least && (most == 0 || count <= (most < 0 ? 0 : most));
  if (row->columns > 1 && count % row->columns != 0) fits = 0;
  if (fits) return HOOKE_OK;
  char may[HOOKE_OPTION_ALLOWED];
  int rows = row->columns > 1 && count % row->columns == 0;
  long long given = rows ? count / row->columns : count;
  return hk_fail(HOOKE_BAD_VALUE, where, "%lld %s%s given; allowed: %s", given, rows ? "row" : "number",
                 given == 1 ? "" : "s", hk_option_allowed(row, may));
}

/* A whole number has a single zero. */
static void drop_signs_of_zero(struct hk_option_value *value) {
  value->one += 0.0;
  for (int64_t k = 0; value->many && k < value->count; k++)
    value->many[k] += 0.0;
}

int32_t hk_option_value_from_numbers(const struct hk_option_row *row, const char *where, int64_t count,
                                     const double *numbers, struct hk_option_value *value) {
  memset(value, 0, sizeof *value);
  if (row->type == HOOKE_OPTION_CHOICE || row->type == HOOKE_OPTION_TEXT ||
      row->type == HOOKE_OPTION_FAMILY) {
    char may[HOOKE_OPTION_ALLOWED];
    return hk_fail(HOOKE_BAD_VALUE, where, "a number is not allowed; allowed: %s",
                   hk_option_allowed(row, may));
  }
  if (check_count(row, where, count)) return HOOKE_BAD_VALUE;
  for (int64_t k = 0; k < count; k++)
    if (check_number(row, where, count, k, numbers[k])) return HOOKE_BAD_VALUE;
  if (count > 1) {
    value->many = hk_new(count, sizeof(double));
    if (value->many == NULL) return HOOKE_NO_MEMORY;
    memcpy(value->many, numbers, (size_t)count * sizeof(double));
  }
  value->count = count;
  value->one = count ? numbers[0] : 0;
  if (row->whole) drop_signs_of_zero(value);
  return HOOKE_OK;
}

static int32_t refuse_unit(const struct hk_option_row *row, const char *where, const char *name,
                           int64_t length) {
  char shown[HOOKE_OPTION_SHOWN], list[ALLOWED_SIZE];
  hk_option_show(name, length, shown);
  hk_unit_list(row->unit, list, sizeof list);
  return hk_fail(HOOKE_BAD_VALUE, where,
                 "there is no unit '%s' here; allowed: %s; a number without one is in %s", shown, list,
                 row->unit);
}

/* Parses a number, with or without a unit, which is then in `unit`. */
static enum hk_number_result parse_quantity(const char *bases, const char *text, int64_t length,
                                            double *number, const char **wrong, struct hk_unit *unit) {
  *wrong = NULL;
  *unit = (struct hk_unit){NULL, 0, 0.0};
  if (bases == NULL) return hk_number_parse(text, length, number);
  const struct hk_quantity found = hk_unit_scan(bases, text, length);
  if (found.whole == found.number || found.whole < length) return hk_number_parse(text, length, number);
  const char *name = text + found.number;
  while (*name == ' ' || *name == '\t')
    name++;
  *unit = hk_unit_find(bases, name, text + length - name);
  if (unit->base == NULL) {
    *wrong = name;
    return HOOKE_NUMBER_JUNK;
  }
  return hk_unit_parse(text, found.number, unit, number);
}

int32_t hk_option_parse_number(const struct hk_option_row *row, const char *where, const char *text,
                               int64_t length, double *number, const char **base) {
  char shown[HOOKE_OPTION_SHOWN], may[HOOKE_OPTION_ALLOWED];
  const char *wrong;
  struct hk_unit unit;
  enum hk_number_result result = parse_quantity(row->unit, text, length, number, &wrong, &unit);
  hk_option_show(text, length, shown);
  if (wrong) return refuse_unit(row, where, wrong, text + length - wrong);
  if (unit.base && *base && strcmp(unit.base, *base) != 0)
    return hk_fail(HOOKE_BAD_VALUE, where, "%s after a number in %s; allowed: one kind of unit", shown,
                   *base);
  if (unit.base) *base = unit.base;
  switch (result) {
  case HOOKE_NUMBER_FINE:
    return HOOKE_OK;
  case HOOKE_NUMBER_NO_MEMORY:
    return HOOKE_NO_MEMORY;
  case HOOKE_NUMBER_TOO_LARGE:
    return hk_fail(HOOKE_BAD_VALUE, where, "%s is beyond the largest number, 1.8e308; allowed: %s", shown,
                   hk_option_allowed(row, may));
  case HOOKE_NUMBER_TOO_SMALL:
    return hk_fail(HOOKE_BAD_VALUE, where, "%s is so small that it would become 0; allowed: %s", shown,
                   hk_option_allowed(row, may));
  case HOOKE_NUMBER_JUNK:
    break;
  }
  return hk_fail(HOOKE_BAD_VALUE, where, "\"%s\" is not allowed; allowed: %s", shown,
                 hk_option_allowed(row, may));
}

static int is_blank(char c) {
  return c == ' ' || c == '\t';
}

/* Numbers that come in rows have a semicolon between rows, sizes an x between numbers: "64x64". */
static int is_between(const struct hk_option_row *row, char c) {
  return c == ',' || (c == ';' && row->columns > 1) || (c == 'x' && row->whole && row->words == NULL);
}

/* Reads the next item of a list "1, 2 3". Returns 0 at the end, else what is behind the item (empty between
 * two commas), a blank for the end. */
static int next_piece(const struct hk_option_row *row, const char **rest, const char *end, const char **piece,
                      int64_t *length) {
  const char *at = *rest;
  while (is_blank(*at))
    at++;
  if (*at == '\0') return 0;
  *piece = at;
  at += row->unit ? hk_unit_scan(row->unit, at, end - at).whole : 0; /* blanks may stand in and before it */
  while (*at && !is_between(row, *at) && !is_blank(*at))
    at++;
  *length = at - *piece;
  while (is_blank(*at))
    at++;
  /* a trailing comma is followed by one more, empty item */
  const int between = is_between(row, *at);
  *rest = at + between;
  return between ? *at : ' ';
}

/* Rows that a semicolon ends are told of by their numbers; `first` is that of the row, and moves on. */
static int32_t end_row(const struct hk_option_row *row, const char *where, int64_t count, int64_t *first) {
  char may[HOOKE_OPTION_ALLOWED];
  const int64_t given = count - *first;
  if (given != row->columns)
    return hk_fail(HOOKE_BAD_VALUE, where, "row [%lld] has %lld number%s; allowed: %s",
                   (long long)(*first / row->columns), (long long)given, given == 1 ? "" : "s",
                   hk_option_allowed(row, may));
  *first = count;
  return HOOKE_OK;
}

/* Fills `numbers` and `words`, which have room for all items of the text, and the counts and the unit of
 * `found`. */
static int32_t split_list(const struct hk_option_row *row, const char *where, const char *text,
                          struct hk_option_value *found, double *numbers, char *words, int64_t *word_count) {
  const char *piece = NULL, *end = text + strlen(text);
  int64_t length = 0, first = 0;
  size_t used = 0;
  int behind, last = ' ';
  for (const char *rest = text; (behind = next_piece(row, &rest, end, &piece, &length)) != 0;) {
    last = behind;
    if (hk_option_has_word(row->words, piece, length)) {
      if (used) words[used++] = ' ';
      memcpy(words + used, piece, (size_t)length);
      used += (size_t)length;
      (*word_count)++;
      continue;
    }
    char item[ALLOWED_SIZE];
    const int64_t index = found->count + *word_count;
    print_where(row, where, index == 0 && *rest == '\0' ? 1 : index + 2, index, item);
    int32_t status = hk_option_parse_number(row, item, piece, length, &numbers[found->count], &found->unit);
    if (status) return status;
    found->count++;
    if (behind == ';' && end_row(row, where, found->count, &first)) return HOOKE_BAD_VALUE;
  }
  words[used] = '\0';
  if (strchr(text, ';') && end_row(row, where, found->count, &first)) return HOOKE_BAD_VALUE;
  if (last != ' ') return refuse_text(row, where, text);
  if (*word_count && !row->word_lists && *word_count + found->count > 1) return refuse_text(row, where, text);
  return HOOKE_OK;
}

static int32_t list_from_text(const struct hk_option_row *row, const char *where, const char *text,
                              struct hk_option_value *value) {
  int64_t capacity = (int64_t)strlen(text) + 1;
  double *numbers = hk_new(capacity / 2 + 1, sizeof(double));
  char *words = hk_new(capacity, 1);
  struct hk_option_value found = {0};
  int64_t word_count = 0;
  int32_t status = numbers && words ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = split_list(row, where, text, &found, numbers, words, &word_count);
  if (status == HOOKE_OK && (word_count == 0 || found.count > 0))
    status = hk_option_value_from_numbers(row, where, found.count, numbers, value);
  if (status == HOOKE_OK) value->unit = found.unit;
  if (status == HOOKE_OK && word_count > 0) {
    value->words = words;
    words = NULL;
  }
  hk_free(numbers);
  hk_free(words);
  return status;
}

static int32_t word_from_text(const struct hk_option_row *row, const char *where, const char *text,
                              struct hk_option_value *value) {
  if (row->type == HOOKE_OPTION_CHOICE && !hk_option_has_word(row->words, text, (int64_t)strlen(text)))
    return refuse_text(row, where, text);
  value->words = hk_copy_text(text);
  return value->words ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hk_option_value_from_text(const struct hk_option_row *row, const char *where, const char *text,
                                  struct hk_option_value *value) {
  memset(value, 0, sizeof *value);
  switch (row->type) {
  case HOOKE_OPTION_NUMBER: {
    double number = 0;
    const char *unit = NULL;
    if (row->family && !text[0]) return HOOKE_OK;
    if (row->wants && strpbrk(text, "=%,")) return word_from_text(row, where, text, value);
    int32_t status = hk_option_parse_number(row, where, text, (int64_t)strlen(text), &number, &unit);
    if (status == HOOKE_OK) status = hk_option_value_from_numbers(row, where, 1, &number, value);
    if (status == HOOKE_OK) value->unit = unit;
    return status;
  }
  case HOOKE_OPTION_NUMBERS:
    if (row->family && !text[0]) return HOOKE_OK;
    return list_from_text(row, where, text, value);
  case HOOKE_OPTION_FLAG: {
    int yes = strcmp(text, "true") == 0 || strcmp(text, "1") == 0;
    if (!yes && strcmp(text, "false") != 0 && strcmp(text, "0") != 0) return refuse_text(row, where, text);
    value->count = 1;
    value->one = yes;
    return HOOKE_OK;
  }
  case HOOKE_OPTION_CHOICE:
  case HOOKE_OPTION_TEXT:
    return word_from_text(row, where, text, value);
  case HOOKE_OPTION_FAMILY:
    return text[0] ? refuse_text(row, where, text) : HOOKE_OK;
  }
  return refuse_text(row, where, text);
}
