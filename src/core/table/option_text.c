/* Texts of messages: allowed values of a row, known names, the closest match for an unknown one. */
#include "core/table/option.h"

#include "core/number.h"
#include "core/print.h"
#include "core/status.h"
#include "core/utf8.h"

#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 48, LIST_SIZE = 640 };

const char *hk_option_next_word(const char **rest, int64_t *length) {
  const char *at = *rest ? *rest : "";
  while (*at == ' ')
    at++;
  const char *word = at;
  while (*at && *at != ' ')
    at++;
  *rest = at;
  *length = at - word;
  return *length ? word : NULL;
}

int32_t hk_option_has_word(const char *words, const char *word, int64_t length) {
  int64_t candidate_length = 0;
  for (const char *candidate; (candidate = hk_option_next_word(&words, &candidate_length));)
    if (candidate_length == length && memcmp(candidate, word, (size_t)length) == 0) return 1;
  return 0;
}

static void add_words(const char *words, const char *quote, char *text, int64_t size) {
  int64_t length = 0, following = 0;
  const char *rest = words;
  const char *word = hk_option_next_word(&rest, &length);
  for (int first = 1; word; first = 0) {
    const char *next = hk_option_next_word(&rest, &following);
    const char *joint = first ? "" : next ? ", " : " or ";
    hk_append(text, (size_t)size, "%s%s%.*s%s", joint, quote, (int)length, word, quote);
    word = next;
    length = following;
  }
}

void hk_option_show(const char *text, int64_t length, char *shown) {
  int64_t used = 0, most = HOOKE_OPTION_SHOWN - 4;
  for (int64_t at = 0; at < length;) {
    const int64_t bytes = hk_utf8_character(text + at, length - at), count = bytes > 0 ? bytes : 1;
    if (used + count > most) {
      memcpy(shown + used, "...", 3);
      used += 3;
      break;
    }
    const int plain = bytes > 0 && !hk_utf8_control(text + at, bytes);
    memcpy(shown + used, plain ? text + at : "?", (size_t)(plain ? bytes : 1));
    used += plain ? bytes : 1;
    at += count;
  }
  shown[used] = '\0';
}

static void add_bounds(const struct hk_option_row *row, char *text, int64_t size) {
  if (!(row->low < row->high)) return;
  char low[HOOKE_NUMBER_SIZE], high[HOOKE_NUMBER_SIZE];
  hk_number_print(row->low, low);
  hk_number_print(row->high, high);
  /* bounds that only keep arithmetic finite are not shown */
  int has_low = row->low > -1e300, has_high = row->high < 1e300;
  if (has_low) hk_append(text, (size_t)size, " %s %s", row->above_low ? ">" : ">=", low);
  if (has_high) hk_append(text, (size_t)size, "%s<= %s", has_low ? " and " : " ", high);
}

static void add_count(const struct hk_option_row *row, char *text, int64_t size) {
  long long columns = row->columns > 1 ? row->columns : 1;
  long long least = row->min_count / columns, most = row->max_count / columns;
  const char *what = columns > 1 ? "row" : row->whole ? "whole number" : "number";
  int plural = 1;
  if (most == 0 && least == 0)
    hk_append(text, (size_t)size, "any number of %ss", what);
  else if (most == 0 && least == 1)
    hk_append(text, (size_t)size, "one or more %ss", what);
  else if (most == 0)
    hk_append(text, (size_t)size, "%lld or more %ss", least, what);
  else if (least == most) {
    plural = most != 1;
    hk_append(text, (size_t)size, plural ? "%lld %ss" : "%lld %s", most, what);
  } else
    hk_append(text, (size_t)size, "%lld to %lld %ss", least, most, what);
  if (columns > 1)
    hk_append(text, (size_t)size, " of %lld %s%s", columns, row->whole ? "whole numbers" : "numbers",
              plural ? " each" : "");
}

static void add_members(const struct hk_option_row *row, char *text, int64_t size) {
  hk_append(text, (size_t)size, "an object of ");
  for (int32_t k = 0; k < row->family->row_count; k++)
    hk_append(text, (size_t)size, "%s%s", k ? ", " : "", row->family->rows[k].name);
}

void hk_option_describe(const struct hk_option_row *row, char *text, int64_t size) {
  text[0] = '\0';
  switch (row->type) {
  case HOOKE_OPTION_NUMBER:
    hk_append(text, (size_t)size, row->whole ? "a whole number" : "a number");
    add_bounds(row, text, size);
    if (row->family) hk_append(text, (size_t)size, ", or ");
    if (row->family) add_members(row, text, size);
    break;
  case HOOKE_OPTION_NUMBERS:
    if (row->max_count >= 0) {
      add_count(row, text, size);
      add_bounds(row, text, size);
      if (row->words) hk_append(text, (size_t)size, row->word_lists ? ", or any of " : " or ");
    }
    add_words(row->words, "\"", text, size);
    break;
  case HOOKE_OPTION_FLAG:
    hk_append(text, (size_t)size, "true or false");
    break;
  case HOOKE_OPTION_CHOICE:
    add_words(row->words, "\"", text, size);
    break;
  case HOOKE_OPTION_TEXT:
    hk_append(text, (size_t)size, "a text");
    break;
  case HOOKE_OPTION_FAMILY:
    add_members(row, text, size);
    break;
  }
}

const char *hk_option_allowed(const struct hk_option_row *row, char text[HOOKE_OPTION_ALLOWED]) {
  hk_option_describe(row, text, HOOKE_OPTION_ALLOWED);
  if (row->unit && row->unit[0]) hk_append(text, HOOKE_OPTION_ALLOWED, " [%s]", row->unit);
  if (row->wants) hk_append(text, HOOKE_OPTION_ALLOWED, ", or a list QUANTITY=VALUE,...");
  return text;
}

/* Edit distance: number of single-character changes that turn one name into the other. */
static int32_t distance(const char *a, const char *b) {
  int32_t row[NAME_SIZE + 1];
  int32_t n = (int32_t)strlen(b);
  if (n > NAME_SIZE || strlen(a) > NAME_SIZE) return NAME_SIZE;
  for (int32_t k = 0; k <= n; k++)
    row[k] = k;
  for (int32_t i = 1; a[i - 1]; i++) {
    int32_t diagonal = row[0];
    row[0] = i;
    for (int32_t k = 1; k <= n; k++) {
      int32_t replaced = diagonal + (a[i - 1] != b[k - 1]);
      int32_t shorter = row[k] < row[k - 1] ? row[k] : row[k - 1];
      diagonal = row[k];
      row[k] = replaced < shorter + 1 ? replaced : shorter + 1;
    }
  }
  return row[n];
}

struct nearest {
  char name[NAME_SIZE];
  int32_t distance;
};

static void consider(struct nearest *nearest, const char *wanted, const char *name, int64_t length) {
  char candidate[NAME_SIZE];
  snprintf(candidate, sizeof candidate, "%.*s", (int)length, name);
  int32_t far = distance(wanted, candidate);
  if (far < nearest->distance && far < (int32_t)strlen(candidate)) {
    nearest->distance = far;
    memcpy(nearest->name, candidate, sizeof candidate);
  }
}

int32_t hk_option_unknown(const struct hk_option_table *table, const char *others, const char *where,
                          const char *what, const char *name) {
  char list[LIST_SIZE] = "", shown[HOOKE_OPTION_SHOWN];
  struct nearest nearest = {.distance = strlen(name) > 5 ? 4 : 3};
  int64_t length = 0;
  const char *joint = "";
  for (const char *rest = others, *word; (word = hk_option_next_word(&rest, &length)); joint = ", ") {
    hk_append(list, sizeof list, "%s%.*s", joint, (int)length, word);
    consider(&nearest, name, word, length);
  }
  for (int32_t k = 0; table && k < table->row_count; k++, joint = ", ") {
    hk_append(list, sizeof list, "%s%s", joint, table->rows[k].name);
    consider(&nearest, name, table->rows[k].name, (int64_t)strlen(table->rows[k].name));
  }
  hk_option_show(name, (int64_t)strlen(name), shown);
  if (nearest.name[0])
    return hk_fail(HOOKE_BAD_VALUE, where, "unknown %s \"%s\"; did you mean \"%s\"? allowed: %s", what, shown,
                   nearest.name, list);
  return hk_fail(HOOKE_BAD_VALUE, where, "unknown %s \"%s\"; allowed: %s", what, shown, list);
}
