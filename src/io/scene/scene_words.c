#include "io/scene/scene_words.h"

#include <stdio.h>
#include <string.h>

void hk_scene_add_numbers(struct hk_text *text, const char *key, int64_t count, int32_t columns,
                          const double *value) {
  const int64_t width = columns > 0 ? columns : count;
  hk_text_open(text, key, '[');
  for (int64_t first = 0; first < count; first += width) {
    if (columns > 0) hk_text_open(text, NULL, '[');
    for (int64_t k = first; k < first + width; k++)
      hk_text_number(text, NULL, value[k]);
    if (columns > 0) hk_text_close(text, ']');
  }
  hk_text_close(text, ']');
}

/* Words mixed with numbers, one or an array of them. */
static void add_list(struct hk_text *text, const struct hk_option_row *row, const char *words, int64_t count,
                     const double *number) {
  const int32_t single = strchr(words, ' ') == NULL;
  if (count == 0 && single) {
    hk_text_word(text, row->name, words);
    return;
  }
  hk_text_open(text, row->name, '[');
  int64_t length;
  for (const char *at; (at = hk_option_next_word(&words, &length));) {
    char word[32];
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    hk_text_word(text, NULL, word);
  }
  for (int64_t k = 0; k < count; k++)
    hk_text_number(text, NULL, number[k]);
  hk_text_close(text, ']');
}

static void add_value(struct hk_text *text, const hooke_options *options, const char *name,
                      const struct hk_option_row *row) {
  const int64_t count = hooke_options_number_count(options, name);
  const double *number = hooke_options_numbers(options, name);
  const char *words = hooke_options_text(options, name);
  if (row->type == HOOKE_OPTION_FLAG) {
    hk_text_flag(text, row->name, number[0] != 0.0);
  } else if (row->type == HOOKE_OPTION_NUMBER) {
    hk_text_number(text, row->name, number[0]);
  } else if (row->type != HOOKE_OPTION_NUMBERS) {
    hk_text_word(text, row->name, words);
  } else if (words[0]) {
    add_list(text, row, words, count, number);
  } else if (count == 1 && row->min_count == 1 && row->max_count != 1) {
    hk_text_number(text, row->name, number[0]);
  } else {
    hk_scene_add_numbers(text, row->name, count, row->columns, number);
  }
}

static void add_table(struct hk_text *text, const hooke_options *options, const struct hk_option_table *table,
                      const char *prefix, const char *left_out) {
  for (int32_t k = 0; k < table->row_count; k++) {
    const struct hk_option_row *row = &table->rows[k];
    char name[128];
    snprintf(name, sizeof name, "%s%s", prefix, row->name);
    if (!hooke_options_is_set(options, name) || (left_out && strcmp(name, left_out) == 0)) continue;
    if (row->type != HOOKE_OPTION_FAMILY) {
      add_value(text, options, name, row);
      continue;
    }
    hk_text_open(text, row->name, '{');
    snprintf(name, sizeof name, "%s%s.", prefix, row->name);
    add_table(text, options, row->family, name, left_out);
    hk_text_close(text, '}');
  }
}

void hk_scene_add_options(struct hk_text *text, const hooke_options *options, const char *left_out) {
  add_table(text, options, hk_options_table(options), "", left_out);
}
