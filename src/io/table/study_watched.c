#include "io/table/study_watched.h"

#include "measure/study/study.h"

#include <stddef.h>

static void add_quantity(struct hk_text *text, const struct hk_watched *item) {
  hk_text_open(text, NULL, '{');
  hk_text_word(text, "quantity", item->text);
  hk_text_word(text, "unit", hk_watched_unit(item));
}

void hk_study_watched_add(struct hk_text *text, const hooke_study *study, int64_t row) {
  const struct hk_watched_series *series =
      row < 0 ? &study->reference.frames.watched : &study->row[row].trial.watched;
  hk_text_open(text, "watched", '[');
  for (int64_t k = 0; series->list && k < series->list->count; k++) {
    if (row >= 0) {
      hk_text_number(text, NULL, series->figure[k]);
      continue;
    }
    add_quantity(text, &series->list->item[k]);
    hk_text_number(text, "agreement", series->figure[k]);
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

/* ---- statistics ---- */

static void add_source(struct hk_text *text, const hooke_study *study, const char *method,
                       const char *quantity) {
  static const char *const numbers[] = {"step", "rtol", "members", "failed", "mean", "spread", "bias"};
  hk_text_open(text, method, '{');
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    hk_text_number(text, numbers[k], hooke_study_statistic(study, method, quantity, numbers[k]));
  hk_text_close(text, '}');
}

void hk_study_statistics_add(struct hk_text *text, const hooke_study *study) {
  const struct hk_ensemble *e = study->ensemble;
  if (e == NULL) {
    hk_text_word(text, "statistics", NULL);
    return;
  }
  hk_text_open(text, "statistics", '{');
  hk_text_number(text, "from", e->from);
  hk_text_number(text, "until", e->until);
  hk_text_number(text, "members", (double)e->members);
  hk_text_number(text, "noise", e->noise);
  hk_text_open(text, "quantities", '[');
  for (int64_t q = 0; q < e->quantities.count; q++) {
    const char *quantity = e->quantities.item[q].text;
    add_quantity(text, &e->quantities.item[q]);
    hk_text_open(text, "sources", '{');
    add_source(text, study, "reference", quantity);
    for (int64_t s = 1; s < e->source_count; s++)
      add_source(text, study, study->method[e->source[s].method], quantity);
    hk_text_close(text, '}');
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
  hk_text_close(text, '}');
}
