/* Forms: files in share/hooke that are pages but for {{marks}}, where parts are put in. */
#ifndef HOOKE_IO_PAGE_FORM_H
#define HOOKE_IO_PAGE_FORM_H

#include "io/file/text.h"

/* Adds the part called `name` to the page. */
typedef int32_t (*hk_form_part)(const char *name, struct hk_text *page, void *ctx);

/* Adds share/hooke/<form> to `page`, with its parts in place of their marks, in their order. HOOKE_NOT_BUILT
 * if the form is not there, HOOKE_IO_FAILED, HOOKE_NO_MEMORY, and what `add` returns. */
int32_t hk_form_fill(const char *form, hk_form_part add, void *ctx, struct hk_text *page);

#endif
