#include "io/page/form.h"

#include "io/file/share.h"

#include <stdio.h>
#include <string.h>

static int32_t fill(const char *from, hooke_form_part add, void *ctx, struct hooke_text *page) {
  const char *mark;
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && (mark = strstr(from, "{{")) != NULL) {
    char name[64];
    hooke_text_add(page, from, mark - from);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(mark + 2, "}"), mark + 2);
    status = add(name, page, ctx);
    from = mark + strcspn(mark, "}");
    from += strspn(from, "}");
  }
  if (status == HOOKE_OK) hooke_text_add(page, from, (int64_t)strlen(from));
  return status == HOOKE_OK ? page->status : status;
}

int32_t hooke_form_fill(const char *form, hooke_form_part add, void *ctx, struct hooke_text *page) {
  struct hooke_text text = {.bytes = NULL};
  int32_t status = hooke_share_read(form, &text);
  hooke_text_add(&text, "", 1); /* ends it */
  if (status == HOOKE_OK) status = text.status;
  if (status == HOOKE_OK) status = fill(text.bytes, add, ctx, page);
  hooke_text_release(&text);
  return status;
}
