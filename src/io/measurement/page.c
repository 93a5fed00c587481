/* The pages of measurements, one a kind. */
#include "core/status.h"
#include "io/measurement/measurement_file.h"
#include "io/page/measurement_pages.h"
#include "io/page/report.h"

#include <string.h>

static const struct page {
  const char *kind, *more;
  void (*add_data)(struct hk_text *data, const void *measurement);
} pages[] = {
    {"study", NULL, hk_study_page_add},
    {"limit", "mode.js", hk_limit_page_add},
    {"needs", NULL, hk_needs_page_add},
    {"why", "mode.js", hk_why_page_add},
    {NULL, NULL, NULL},
};

int32_t hk_measurement_write_page(const hooke_measurement *m, const char *path) {
  for (size_t k = 0; pages[k].kind; k++) {
    if (strcmp(pages[k].kind, m->kind->name) != 0) continue;
    const struct hk_report report = {pages[k].more, m->kind->name, m->label[HOOKE_LABEL_TITLE],
                                     pages[k].add_data, m};
    return hk_report_write(&report, path);
  }
  return hk_fail(HOOKE_BAD_VALUE, "path", "%s: there is no page for a %s", path, m->kind->name);
}
