/* What a study says of watched quantities and of its ensemble. */
#include "measure/study/study.h"

#include "core/figure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What stands behind `word` in `what`, NULL if that is another word. */
static const char *behind(const char *what, const char *word) {
  const size_t length = strlen(word);
  return strncmp(what, word, length) == 0 ? what + length : NULL;
}

static const struct hk_watched *item_at(const struct hk_watched_list *list, const char *number) {
  char *end;
  const long long k = strtoll(number, &end, 10);
  return number[0] >= '0' && number[0] <= '9' && *end == '\0' && k < list->count ? &list->item[k] : NULL;
}

static const struct hk_watched_list *all_quantities(const hooke_study *study) {
  return study->ensemble ? &study->ensemble->quantities : &study->watched;
}

const char *hk_study_watched_text(const hooke_study *study, const char *what) {
  const char *number = behind(what, "watched:"), *text = behind(what, "unit:");
  const struct hk_watched *item = NULL;
  if (number) item = item_at(&study->watched, number);
  if ((number = behind(what, "quantity:")) && study->ensemble)
    item = item_at(&study->ensemble->quantities, number);
  if (item) return item->text;
  const struct hk_watched_list *all = all_quantities(study);
  const int64_t k = text ? hk_watched_find(all, text) : -1;
  return k < 0 ? NULL : hk_watched_unit(&all->item[k]);
}

double hk_study_watched_figure(const hooke_study *study, const char *what) {
  const struct hk_ensemble *e = study->ensemble;
  const char *quantity = behind(what, "agreement:");
  if (quantity) return hk_watched_series_figure(&study->reference.frames.watched, quantity);
  const struct hk_figure figures[] = {
      {"watched", (double)study->watched.count},
      {"quantities", e ? (double)e->quantities.count : 0.0},
      {"members", e ? (double)e->members : 0.0},
      {"statistics_from", e ? e->from : NAN},
      {"statistics_until", e ? e->until : NAN},
      {"noise", e ? e->noise : NAN},
      {"seed", hooke_options_number(study->options, "seed")},
  };
  return HOOKE_FIGURE(figures, what);
}
