/* Pages: a frame filled with the style, the drawing library, the data, the body and the scripts. The files of
 * a page in share/hooke are <name>.html, <name>.js and <name>_tables.js. */
#include "io/page/report.h"

#include "core/os/os.h"
#include "core/status.h"
#include "io/page/form.h"
#include "io/file/atomic_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* ---- facts that all pages show ---- */

static void add_machine(struct hk_text *text) {
  struct hk_os_machine machine;
  if (text->status == HOOKE_OK && hk_os_describe_machine(&machine) != 0)
    text->status = hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to describe the machine");
  if (text->status != HOOKE_OK) return;
  hk_text_open(text, "machine", '{');
  hk_text_word(text, "processor", machine.processor[0] ? machine.processor : NULL);
  hk_text_number(text, "cores", machine.cores > 0 ? (double)machine.cores : (double)NAN);
  hk_text_word(text, "system", machine.system);
  hk_text_close(text, '}');
}

static void add_versions(struct hk_text *text) {
  static const char *const facts[] = {"sundials", "cholmod", "blas",    "lapack",       "gsl",
                                      "hdf5",     "chartjs", "threejs", "instructions", "licence"};
  hk_text_open(text, "versions", '{');
  hk_text_word(text, "hooke", hooke_version());
  for (int k = 0; k < (int)(sizeof facts / sizeof facts[0]); k++)
    hk_text_word(text, facts[k], hooke_build_fact(facts[k]));
  hk_text_close(text, '}');
}

static void add_date(struct hk_text *text) {
  char date[32] = "";
  const time_t now = time(NULL);
  struct tm parts;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &parts);
  hk_text_word(text, "date", date);
}

void hk_report_add_facts(struct hk_text *text) {
  add_date(text);
  add_machine(text);
  add_versions(text);
}

/* ---- pages ---- */

static const struct page {
  const char *kind;
  const char *name; /* of its files */
  const char *more; /* a file of scripts that it shares with another; NULL: none */
  const char *own;  /* the table that it adds by itself; NULL: none */
  int32_t (*add)(struct hk_text *data, const hooke_measurement *measurement);
} pages[] = {
    {"study", "study", NULL, NULL, hk_study_page_add},
    {"limit", "limit", "mode.js", "rows", hk_limit_page_add},
    {"needs", "needs", NULL, NULL, hk_needs_page_add},
    {"why", "why", "mode.js", NULL, hk_why_page_add},
    {"modes", "modes", NULL, NULL, hk_modes_page_add},
    {"rest", "modes", NULL, NULL, hk_rest_page_add},
};

static const struct page *find(const hooke_measurement *m) {
  for (size_t k = 0; k < sizeof pages / sizeof pages[0]; k++)
    if (strcmp(pages[k].kind, m->kind->name) == 0) return &pages[k];
  return NULL;
}

static int32_t add_data(struct hk_text *data, const hooke_measurement *m) {
  hk_text_open(data, NULL, '{');
  hk_text_word(data, "scene", m->label[HOOKE_LABEL_TITLE]);
  if (m->label[HOOKE_LABEL_COMMAND]) hk_text_word(data, "command", m->label[HOOKE_LABEL_COMMAND]);
  hk_report_add_facts(data);
  hk_measurement_add_all(data, m, find(m)->own);
  const int32_t status = find(m)->add(data, m);
  hk_text_close(data, '}');
  return status;
}

/* A file with the name of the page, and `ending`. */
static int32_t add_own(struct hk_text *page, const hooke_measurement *m, const char *ending) {
  char name[64];
  snprintf(name, sizeof name, "%s%s", find(m)->name, ending);
  return hk_data_folder_read(name, page);
}

/* Fills {{name}} in the form. */
static int32_t add_part(const char *name, struct hk_text *page, void *ctx) {
  const hooke_measurement *m = ctx;
  const char *more = find(m)->more;
  if (strcmp(name, "data") == 0) return add_data(page, m);
  if (strcmp(name, "body") == 0) return add_own(page, m, ".html");
  if (strcmp(name, "diagrams") == 0) return add_own(page, m, ".js");
  if (strcmp(name, "tables") == 0) return add_own(page, m, "_tables.js");
  return more ? hk_data_folder_read(more, page) : HOOKE_OK;
}

int32_t hk_measurement_write_page(const hooke_measurement *m, const char *path) {
  struct hk_text page = {.bytes = NULL};
  if (find(m) == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "path", "%s: there is no page for a %s", path, m->kind->name);
  if (!hooke_build_fact("chartjs")[0])
    return hk_fail(HOOKE_NOT_BUILT, NULL,
                   "reports need Chart.js (on Debian: apt-get install libjs-chart.js, then configure again), "
                   "and this build of the library is without it");
  int32_t status = hk_form_fill("page.html", add_part, (void *)(uintptr_t)m, &page);
  if (status == HOOKE_OK) status = hk_file_write(path, page.bytes, page.length);
  hk_text_release(&page);
  return status;
}
