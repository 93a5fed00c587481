/* Tables as CSV, in the same bytes whatever the locale. */
#include "core/number.h"
#include "hooke/io.h"
#include "io/file/place.h"
#include "io/file/text.h"
#include "measure/study/study.h"

#include <math.h>
#include <string.h>

static void add(struct hk_text *text, const char *words) {
  hk_text_add(text, words, (int64_t)strlen(words));
}

/* A name in quotes, with those in it doubled. */
static void add_name(struct hk_text *text, const char *name) {
  add(text, ",\"");
  for (; *name; name++)
    hk_text_add(text, *name == '"' ? "\"\"" : name, *name == '"' ? 2 : 1);
  add(text, "\"");
}

static void add_number(struct hk_text *text, double value) {
  char number[HOOKE_NUMBER_SIZE] = "";
  if (isfinite(value)) hk_number_print(value, number);
  add(text, ",");
  add(text, number);
}

static void add_watched(struct hk_text *text, const hooke_study *study, int64_t row) {
  for (int64_t k = 0; k < study->watched.count; k++)
    add_number(text, hk_watched_series_figure(&study->row[row].trial.watched, study->watched.item[k].text));
}

static void add_row(struct hk_text *text, const hooke_study *study, int64_t row) {
  add(text, hooke_study_text(study, row, "method"));
  for (int k = 0; k < HOOKE_STUDY_ROW_NUMBERS; k++)
    add_number(text, hooke_study_number(study, row, hk_study_row_number[k]));
  add_watched(text, study, row);
  add(text, ",");
  add(text, hooke_study_text(study, row, "status"));
  add(text, "\n");
}

int32_t hooke_study_write_csv(const hooke_study *study, const char *path) {
  struct hk_text text = {.bytes = NULL};
  add(&text, "method");
  for (int k = 0; k < HOOKE_STUDY_ROW_NUMBERS; k++) {
    add(&text, ",");
    add(&text, hk_study_row_number[k]);
  }
  for (int64_t k = 0; k < study->watched.count; k++)
    add_name(&text, study->watched.item[k].text);
  add(&text, ",status\n");
  for (int64_t row = 0; row < hooke_study_row_count(study); row++)
    add_row(&text, study, row);
  const int32_t status =
      text.status == HOOKE_OK ? hk_place_write(path, text.bytes, text.length) : text.status;
  hk_text_release(&text);
  return status;
}
