/* Several trajectories as one page, the page of each in a frame of its own. */
#include "io/page/view/view.h"

#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/page/form.h"
#include "io/trajectory/record.h"

/* As texts in an array. */
static int32_t add_pages(const char *name, struct hk_text *list, void *ctx) {
  const hooke_measurement *m = ctx;
  const struct hk_view *view = m->object;
  int32_t status = HOOKE_OK;
  (void)name;
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
  return status;
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
  if (status == HOOKE_OK)
    status = view->beside_count > 0 ? hk_form_fill("views.html", add_pages, (void *)(uintptr_t)m, &text)
                                    : hk_view_add_page(m, &text);
  if (status == HOOKE_OK) status = hk_file_write(path, text.bytes, text.length);
  hk_text_release(&text);
  return status;
}
