/* The page of a study: a template with the style, the drawing library, the data and the script put in. */
#include "io/report.h"

#include "core/memory.h"
#include "core/status.h"
#include "hooke/io.h"
#include "io/place.h"
#include "io/share.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#if HOOKE_HAVE_CHARTJS

/* ---- the page ---- */

struct request {
  const hooke_study *study;
  const char *scene, *command;
};

/* What stands in the template as {{name}}: the data, or a file that is installed with it. */
static int32_t add_part(struct hooke_text *page, const char *mark, const struct request *request) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(mark, "}"), mark);
  if (strcmp(name, "data") != 0) return hooke_share_read(name, page);
  hooke_report_add_data(page, request->study, request->scene, request->command);
  return page->status;
}

static int32_t fill(struct hooke_text *page, const struct hooke_text *form, const struct request *request) {
  const char *from = form->bytes, *mark;
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && (mark = strstr(from, "{{")) != NULL) {
    hooke_text_add(page, from, mark - from);
    status = add_part(page, mark + 2, request);
    from = mark + strcspn(mark, "}");
    from += strspn(from, "}");
  }
  if (status == HOOKE_OK) hooke_text_add(page, from, (int64_t)strlen(from));
  return status == HOOKE_OK ? page->status : status;
}

static int32_t make_page(struct hooke_text *page, const struct request *request) {
  struct hooke_text form = {.bytes = NULL};
  int32_t status = hooke_share_read("study.html", &form);
  hooke_text_add(&form, "", 1); /* ends it */
  if (status == HOOKE_OK) status = form.status;
  if (status == HOOKE_OK) status = fill(page, &form, request);
  hooke_text_release(&form);
  return status;
}

/* ---- the file ---- */

static int32_t write_page(const char *path, const char *temporary, const struct hooke_text *page) {
  unlink(temporary);
  FILE *file = fopen(temporary, "wx");
  if (file == NULL) return hooke_place_fail(path, "create the file", errno);
  int error = 0;
  if (fwrite(page->bytes, 1, (size_t)page->length, file) != (size_t)page->length || fflush(file) != 0)
    error = errno;
  if (fclose(file) != 0 && error == 0) error = errno;
  return error ? hooke_place_fail(path, "write", error) : HOOKE_OK;
}

int32_t hooke_study_write_report(const hooke_study *study, const char *path, const char *scene,
                                 const char *command) {
  const struct request request = {study, scene, command};
  struct hooke_text page = {.bytes = NULL};
  char *place = NULL, *temporary = NULL;
  int32_t status = make_page(&page, &request);
  if (status == HOOKE_OK) status = hooke_place_find(path, &place, &temporary);
  if (status == HOOKE_OK) status = write_page(path, temporary, &page);
  if (status == HOOKE_OK) status = hooke_place_take(place, &temporary);
  if (temporary) unlink(temporary);
  hooke_free(temporary);
  hooke_free(place);
  hooke_text_release(&page);
  return status;
}

#else

int32_t hooke_study_write_report(const hooke_study *study, const char *path, const char *scene,
                                 const char *command) {
  (void)study, (void)path, (void)scene, (void)command;
  return hooke_fail(
      HOOKE_NOT_BUILT, NULL,
      "reports need Chart.js (on Debian: apt-get install libjs-chart.js, then configure again), and "
      "this build of the library is without it");
}

#endif
