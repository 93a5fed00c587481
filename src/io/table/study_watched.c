#include "io/table/study_watched.h"

#include "measure/study/study.h"

#include <stddef.h>

static void add_quantity(struct hooke_text *text, const struct hooke_watched *item) {
  hooke_text_open(text, NULL, '{');
  hooke_text_word(text, "quantity", item->text);
  hooke_text_word(text, "unit", hooke_watched_unit(item));
}

void hooke_study_watched_add(struct hooke_text *text, const hooke_study *study, int64_t row) {
  const struct hooke_watched_series *series =
      row < 0 ? &study->reference.frames.watched : &study->row[row].trial.watched;
  hooke_text_open(text, "watched", '[');
  for (int64_t k = 0; series->list && k < series->list->count; k++) {
    if (row >= 0) {
      hooke_text_number(text, NULL, series->figure[k]);
      continue;
    }
    add_quantity(text, &series->list->item[k]);
    hooke_text_number(text, "agreement", series->figure[k]);
    hooke_text_close(text, '}');
  }
  hooke_text_close(text, ']');
}

/* ---- statistics ---- */

static void add_source(struct hooke_text *text, const hooke_study *study, const char *method,
                       const char *quantity) {
  static const char *const numbers[] = {"step", "rtol", "members", "failed", "mean", "spread", "bias"};
  hooke_text_open(text, method, '{');
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    hooke_text_number(text, numbers[k], hooke_study_statistic(study, method, quantity, numbers[k]));
  hooke_text_close(text, '}');
}

void hooke_study_statistics_add(struct hooke_text *text, const hooke_study *study) {
  const struct hooke_ensemble *e = study->ensemble;
  if (e == NULL) {
    hooke_text_word(text, "statistics", NULL);
    return;
  }
  hooke_text_open(text, "statistics", '{');
  hooke_text_number(text, "from", e->from);
  hooke_text_number(text, "until", e->until);
  hooke_text_number(text, "members", (double)e->members);
  hooke_text_number(text, "noise", e->noise);
  hooke_text_open(text, "quantities", '[');
  for (int64_t q = 0; q < e->quantities.count; q++) {
    const char *quantity = e->quantities.item[q].text;
    add_quantity(text, &e->quantities.item[q]);
    hooke_text_open(text, "sources", '{');
    add_source(text, study, "reference", quantity);
    for (int64_t s = 1; s < e->source_count; s++)
      add_source(text, study, study->method[e->source[s].method], quantity);
    hooke_text_close(text, '}');
    hooke_text_close(text, '}');
  }
  hooke_text_close(text, ']');
  hooke_text_close(text, '}');
}
