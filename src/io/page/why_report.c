/* The page of an explanation: what it shows, as JSON. */
#include "core/status.h"
#include "io/measurement/measurement_file.h"
#include "io/page/measurement_pages.h"
#include "io/page/why_frames.h"

#include <math.h>

void hk_why_page_add(struct hk_text *data, const void *measurement) {
  const hooke_measurement *m = measurement;
  const struct hk_why *why = m->object;
  if (why->cause == NULL) {
    data->status = hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to report: no explanation was found");
    return;
  }
  hk_measurement_add_all(data, m);
  hk_text_open(data, "rows", '[');
  hk_text_open(data, NULL, '{');
  hk_text_word(data, "method", why->method);
  hk_limit_page_add_reach(data, why->system, why->method);
  hk_text_close(data, '}');
  hk_text_close(data, ']');
  if (why->start.state && !isnan(why->step)) hk_why_frames_add(data, why, m->run);
}
