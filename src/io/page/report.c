/* Pages: a frame filled with the style, the drawing library, the data, the body and the scripts. */
#include "io/page/report.h"

#include "core/status.h"
#include "io/page/form.h"
#include "io/file/atomic_file.h"
#include "io/file/data_folder.h"

#include <stdio.h>
#include <string.h>

#if HOOKE_HAVE_CHARTJS

/* ---- the page ---- */

static int32_t add_data(struct hk_text *page, const struct hk_report *report) {
  struct hk_text data = {.bytes = NULL};
  hk_text_open(&data, NULL, '{');
  hk_text_word(&data, "scene", report->scene);
  hk_report_add_facts(&data);
  report->add_data(&data, report->ctx);
  hk_text_close(&data, '}');
  if (data.status == HOOKE_OK) hk_text_add(page, data.bytes, data.length);
  const int32_t status = data.status != HOOKE_OK ? data.status : page->status;
  hk_text_release(&data);
  return status;
}

/* A file with the report's name, and `ending`. */
static int32_t add_own(struct hk_text *page, const struct hk_report *report, const char *ending) {
  char name[64];
  snprintf(name, sizeof name, "%s%s", report->name, ending);
  return hk_data_folder_read(name, page);
}

/* Fills {{name}} in the form: a part of the report, or a file that all reports share. */
static int32_t add_part(const char *name, struct hk_text *page, void *ctx) {
  const struct hk_report *report = ctx;
  if (strcmp(name, "data") == 0) return add_data(page, report);
  if (strcmp(name, "body") == 0) return add_own(page, report, ".html");
  if (strcmp(name, "more") == 0) return report->more ? hk_data_folder_read(report->more, page) : HOOKE_OK;
  if (strcmp(name, "diagrams") == 0) return add_own(page, report, ".js");
  if (strcmp(name, "tables") == 0) return add_own(page, report, "_tables.js");
  return hk_data_folder_read(name, page);
}

int32_t hk_report_write(const struct hk_report *report, const char *path) {
  struct hk_text page = {.bytes = NULL};
  struct hk_report copy = *report;
  int32_t status = hk_form_fill("page.html", add_part, &copy, &page);
  if (status == HOOKE_OK) status = hk_file_write(path, page.bytes, page.length);
  hk_text_release(&page);
  return status;
}

#else

int32_t hk_report_write(const struct hk_report *report, const char *path) {
  (void)report, (void)path;
  return hk_fail(
      HOOKE_NOT_BUILT, NULL,
      "reports need Chart.js (on Debian: apt-get install libjs-chart.js, then configure again), and "
      "this build of the library is without it");
}

#endif
