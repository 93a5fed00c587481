/* The page of modes: the scene as a picture, on which they play. */
#include "core/status.h"
#include "io/page/picture.h"
#include "io/page/report.h"
#include "measure/modes/modes.h"

int32_t hk_modes_page_add(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_modes *modes = m->object;
  struct hk_picture p;
  int32_t status = hk_picture_create(m->system, &p);
  if (status == HOOKE_OK) {
    if (!hk_picture_take_families(&p, HOOKE_PICTURE_SPRINGS)) hk_picture_show_evenly(&p);
    hk_text_open(data, "rows", '[');
    hk_text_close(data, ']');
    hk_text_open(data, "picture", '{');
    hk_picture_add(data, &p);
    hk_picture_add_vectors(data, "position", modes->position, p.list, p.shown_count);
    hk_text_close(data, '}');
  }
  hk_picture_release(&p);
  return status;
}
