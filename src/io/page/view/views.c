/* Several trajectories as one page, the page of each in a frame of its own. */
#include "io/page/view/view.h"

#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/data_folder.h"
#include "io/file/inputs.h"
#include "io/page/form.h"
#include "io/trajectory/record.h"

#include <string.h>

static int32_t list_pages(const hooke_measurement *m, struct hk_text *list) {
  const struct hk_view *view = m->object;
  int32_t status = HOOKE_OK;
  hk_text_open(list, NULL, '[');
  for (int32_t k = 0; k <= view->beside_count && status == HOOKE_OK; k++) {
    struct hk_text page = {.bytes = NULL};
    status = hk_view_add_page(k == 0 ? m : view->beside[k - 1], &page);
    hk_text_add(&page, "", 1); /* ends it */
    if (status == HOOKE_OK) status = page.status;
    if (status == HOOKE_OK) hk_text_word(list, NULL, page.bytes);
    hk_text_release(&page);
  }
  hk_text_close(list, ']');
  return status == HOOKE_OK ? list->status : status;
}

static int32_t add_part(const char *name, struct hk_text *text, void *ctx) {
  if (strcmp(name, "pages") != 0) return hk_data_folder_read(name, text);
  struct hk_text list = {.bytes = NULL};
  const int32_t status = list_pages(ctx, &list);
  if (status == HOOKE_OK) hk_text_add(text, list.bytes, list.length);
  hk_text_release(&list);
  return status == HOOKE_OK ? text->status : status;
}

static int32_t add_pages(const hooke_measurement *m, struct hk_text *text) {
  return hk_form_fill("views.html", add_part, (void *)(uintptr_t)m, text);
}

int32_t hooke_view_add(hooke_measurement *m, const hooke_measurement *other) {
  if (m->kind != &hk_view_kind || other->kind != &hk_view_kind)
    return hk_fail(HOOKE_BAD_VALUE, "view", "a %s beside a %s; allowed: views", other->kind->name,
                   m->kind->name);
  struct hk_view *view = m->object;
  if (view->beside_count == HOOKE_VIEW_MOST_BESIDE)
    return hk_fail(HOOKE_BAD_VALUE, "other", "is one too many; allowed: %d beside the first",
                   HOOKE_VIEW_MOST_BESIDE);
  view->beside[view->beside_count++] = other;
  return HOOKE_OK;
}

int32_t hk_view_write(const hooke_measurement *m, const char *path) {
  struct hk_text text = {.bytes = NULL};
  const struct hk_view *view = m->object;
  int32_t status = hk_input_refuse(hk_record_path(view->record), path);
  for (int32_t k = 0; status == HOOKE_OK && k < view->beside_count; k++)
    status = hk_input_refuse(hk_record_path(((const struct hk_view *)view->beside[k]->object)->record), path);
  if (status == HOOKE_OK) status = view->beside_count > 0 ? add_pages(m, &text) : hk_view_add_page(m, &text);
  if (status == HOOKE_OK) status = hk_file_write(path, text.bytes, text.length);
  hk_text_release(&text);
  return status;
}
