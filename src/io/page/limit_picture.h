/* The scene on the page of a limit: springs as lines, and the limiting mode. */
#ifndef HOOKE_IO_PAGE_LIMIT_PICTURE_H
#define HOOKE_IO_PAGE_LIMIT_PICTURE_H

#include "io/file/text.h"
#include "measure/limit/limit.h"

/* Adds "picture": the springs drawn, first the limiting ones, and their ends, at the analysed positions.
 * Failures go to the text's status. */
void hk_limit_picture_add(struct hk_text *data, const struct hk_limit *limit);

#endif
