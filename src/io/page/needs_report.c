/* The page of needs: its contents as JSON. */
#include "io/measurement/measurement_file.h"
#include "io/page/measurement_pages.h"
#include "io/page/needs_picture.h"
#include "measure/needs/needs.h"

void hk_needs_page_add(struct hk_text *data, const void *measurement) {
  const hooke_measurement *m = measurement;
  hk_measurement_add_all(data, m);
  hk_text_number(data, "particles", (double)hooke_system_particle_count(m->system));
  hk_text_word(data, "command", m->label[HOOKE_LABEL_COMMAND]);
  hk_needs_picture_add(data, m->object);
}
