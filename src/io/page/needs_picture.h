/* The full system and the lean one on the page of needs: springs as lines, at the last judged frame. */
#ifndef HOOKE_IO_PAGE_NEEDS_PICTURE_H
#define HOOKE_IO_PAGE_NEEDS_PICTURE_H

#include "io/file/text.h"

struct hk_needs;

/* Adds "picture": the watched particles in both systems, and the springs between them; nothing without a lean
 * system. Failures go to the text's status. */
void hk_needs_picture_add(struct hk_text *data, const struct hk_needs *needs);

#endif
