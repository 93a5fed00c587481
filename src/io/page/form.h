/* Files installed with the library, in share/hooke, and forms: those of them with {{marks}} for parts to
 * insert: files, which have a dot in their name, and what a page adds by itself. */
#pragma once

#include "io/file/text.h"

/* Appends the contents of share/hooke/<name> to `text`. HOOKE_NOT_BUILT if the file does not exist,
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_data_folder_read(const char *name, struct hk_text *text);

/* Adds the part called `name` to the page. */
typedef int32_t (*hk_form_part)(const char *name, struct hk_text *page, void *ctx);

/* Adds share/hooke/<form> to `page`, with its marks replaced by their parts, in order; files alone if `add`
 * is NULL. HOOKE_NOT_BUILT if a file does not exist, HOOKE_IO_FAILED, HOOKE_NO_MEMORY, and the failures of
 * `add`. */
int32_t hk_form_fill(const char *form, hk_form_part add, void *ctx, struct hk_text *page);
