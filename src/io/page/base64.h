/* Bytes as text (RFC 4648). */
#ifndef HOOKE_IO_PAGE_BASE64_H
#define HOOKE_IO_PAGE_BASE64_H

#include "io/file/text.h"

/* Length of `bytes` bytes as text. */
int64_t hk_base64_length(int64_t bytes);

void hk_base64_add(struct hk_text *text, const uint8_t *bytes, int64_t count);

#endif
