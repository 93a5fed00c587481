#include "io/page/form.h"

#include "io/file/data_folder.h"

#include <stdio.h>
#include <string.h>

static int32_t fill(const char *from, hk_form_part add, void *ctx, struct hk_text *page) {
  const char *mark;
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && (mark = strstr(from, "{{")) != NULL) {
    char name[64];
    hk_text_add(page, from, mark - from);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(mark + 2, "}"), mark + 2);
    if (strchr(name, '.'))
      status = hk_data_folder_read(name, page);
    else if (add)
      status = add(name, page, ctx);
    from = mark + strcspn(mark, "}");
    from += strspn(from, "}");
  }
  if (status == HOOKE_OK) hk_text_say(page, from);
  return status == HOOKE_OK ? page->status : status;
}

int32_t hk_form_fill(const char *form, hk_form_part add, void *ctx, struct hk_text *page) {
  struct hk_text text = {.bytes = NULL};
  int32_t status = hk_data_folder_read(form, &text);
  hk_text_add(&text, "", 1); /* ends it */
  if (status == HOOKE_OK) status = text.status;
  if (status == HOOKE_OK) status = fill(text.bytes, add, ctx, page);
  hk_text_release(&text);
  return status;
}
