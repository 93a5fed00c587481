/* The page of needs: its contents as JSON. */
#include "io/measurement/measurement_file.h"
#include "io/page/measurement_pages.h"
#include "io/page/needs_picture.h"
#include "measure/needs/needs.h"

/* Ingredients that were not tested. */
static void add_waiting(struct hk_text *data, const struct hk_needs *needs) {
  hk_text_open(data, "waiting", '[');
  for (int64_t row = hk_needs_known_rows(needs); row < needs->row_count; row++)
    hk_text_word(data, NULL, needs->row[row].without);
  hk_text_close(data, ']');
}

void hk_needs_page_add(struct hk_text *data, const void *measurement) {
  const hooke_measurement *m = measurement;
  hk_measurement_add_row(data, m, "needs", 0);
  hk_text_number(data, "particles", (double)hooke_system_particle_count(m->system));
  hk_measurement_add_table(data, m, "full");
  hk_measurement_add_table(data, m, "rows");
  add_waiting(data, m->object);
  hk_measurement_add_table(data, m, "lean");
  hk_text_word(data, "command", m->label[HOOKE_LABEL_COMMAND]);
  hk_measurement_add_table(data, m, "parts");
  hk_needs_picture_add(data, m->object);
}
